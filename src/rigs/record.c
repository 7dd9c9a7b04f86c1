#include "rigs/record.h"

#include <math.h>
#include <stdlib.h>

void bt_rig_record_start(bt_rig_record* record, bt_rig_kind kind) {
    *record = (bt_rig_record){.kind = kind, .names = {"time_s"}};
    int count;
    const char* const* names = bt_rig_channels(kind, &count);
    for (int i = 0; i < count; ++i)
        record->names[1 + i] = names[i];
    record->column_count = 1 + count;
}

void bt_rig_record_destroy(bt_rig_record* record) {
    for (int i = 0; i < record->column_count; ++i)
        free(record->columns[i]);
    *record = (bt_rig_record){0};
}

static bool has_room(bt_rig_record* record) {
    if (record->count < record->room)
        return true;
    const int room = record->room ? 2 * record->room : 1024;
    for (int i = 0; i < record->column_count; ++i) {
        double* column = realloc(record->columns[i], (size_t)room * sizeof *column);
        if (!column)
            return false;
        record->columns[i] = column;
    }
    record->room = room;
    return true;
}

void bt_rig_record_observe(void* user, const bt_rig_sample* sample) {
    bt_rig_record* record = user;
    if (record->out_of_memory || !has_room(record)) {
        record->out_of_memory = true;
        return;
    }
    record->columns[0][record->count] = sample->time_s;
    for (int i = 1; i < record->column_count; ++i)
        record->columns[i][record->count] = sample->values[i - 1];
    ++record->count;
}

bool bt_rig_record_grows(const bt_rig_record* record, int column) {
    const double* x = record->columns[column];
    for (int i = 1; i < record->count; ++i)
        if (!(x[i] > x[i - 1]))
            return false;
    return true;
}

double bt_rig_record_at(const bt_rig_record* record, int column, int over, double x) {
    const double *t = record->columns[over], *y = record->columns[column];
    if (record->count < 2 || !(x >= t[0] && x <= t[record->count - 1]))
        return NAN;
    int low = 0, high = record->count - 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        *(t[middle] <= x ? &low : &high) = middle;
    }
    return y[low] + (y[high] - y[low]) * (x - t[low]) / (t[high] - t[low]);
}
