#include "report/rig_record.h"

#include "base/directory.h"
#include "base/units.h"
#include "report/hdf5_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

// --- file -------------------------------------------------------------------------------------

/// The written unit of a name with a unit token at its end: "m/s" of "stroke_rate_mps".
static const char* unit_of(const char* name) {
    const char* last = strrchr(name, '_');
    const char* unit = last ? bt_unit_text(last + 1) : NULL;
    return unit ? unit : "1";
}

static bool write_column(const bt_rig_record* record, hid_t file, int column) {
    const hsize_t count = (hsize_t)record->count;
    const hid_t space = H5Screate_simple(1, &count, NULL);
    const hid_t set = space < 0 ? -1
                                : H5Dcreate2(file, record->names[column], H5T_IEEE_F64LE, space,
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    bool good = set >= 0 &&
                H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                         record->columns[column]) >= 0 &&
                bt_hdf5_attribute(set, "unit", unit_of(record->names[column]));
    if (set >= 0)
        good &= H5Dclose(set) >= 0;
    if (space >= 0)
        H5Sclose(space);
    return good;
}

static bool write_number(hid_t file, const char* name, double value) {
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute =
        space < 0 ? -1 : H5Acreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    bool good = attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) >= 0;
    if (attribute >= 0)
        good &= H5Aclose(attribute) >= 0;
    if (space >= 0)
        H5Sclose(space);
    return good;
}

/// What goes into a file.
typedef struct content {
    const bt_rig_record* record;
    const bt_study* study;
    const bt_rig_result* result;
} content;

static bool write_all(hid_t file, const void* user) {
    const content* c = user;
    const bt_rig_record* record = c->record;
    const bt_rig_result* result = c->result;
    bool good = bt_hdf5_attribute(file, "title", c->study->title) &&
                bt_hdf5_attribute(file, "rig", bt_rig_keys[record->kind]) &&
                bt_hdf5_text(file, "study", c->study->text);
    for (int i = 0; good && i < record->column_count; ++i)
        good = write_column(record, file, i);
    for (int i = 0; good && i < result->metric_count; ++i) {
        const bt_metric* m = &result->metrics[i];
        char name[96];
        snprintf(name, sizeof name, "%s_reference", m->name);
        good = write_number(file, m->name, m->value);
        if (good && isfinite(m->reference))
            good = write_number(file, name, m->reference);
    }
    return good;
}

bt_status bt_rig_record_write(const bt_rig_record* record, const char* path, const bt_study* study,
                              const bt_rig_result* result, bt_diag* diag) {
    if (record->out_of_memory)
        return BT_ERR_MEMORY;
    if (bt_study_reads(study, path))
        return bt_file_refuse(path, diag);
    return bt_hdf5_write(path, write_all, &(content){record, study, result}, diag);
}
