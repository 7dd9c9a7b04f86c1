#include "report/history.h"

#include "base/directory.h"
#include "base/text.h"
#include "base/units.h"
#include "report/hdf5_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// What is kept of every view: one row here, one dataset in the file.
typedef struct channel {
    const char *group, *name; ///< "hook", "hook_angle_rad"
    const char* unit;         ///< token
    const char *parts, *text;
    size_t offset; ///< in bt_landing_view
    int count;     ///< doubles
} channel;

#define PARTS_REAL ""
#define PARTS_VECTOR ": x, y, z"
#define PARTS_LEGS ": nose, left, right"
#define PARTS_ZONES ": shoe, point, throat, arm"
#define CHANNEL(KIND, group, name, unit, text)                                                     \
    {#group,                                                                                       \
     #name "_" #unit,                                                                              \
     #unit,                                                                                        \
     PARTS_##KIND,                                                                                 \
     text,                                                                                         \
     offsetof(bt_landing_view, name##_##unit),                                                     \
     sizeof((bt_landing_view*)0)->name##_##unit / sizeof(double)},
static const channel channels[] = {BT_VIEW_FIELDS(CHANNEL)};
enum { CHANNEL_COUNT = sizeof channels / sizeof channels[0] };
enum { Q_SIZE = 7 * BT_BODY_COUNT, V_SIZE = 6 * BT_BODY_COUNT };
static const double cable_interval_s = 1e-3;

/// A matrix that grows row by row; all rows have the width of the first.
typedef struct rows {
    double* data;
    size_t count, width, room;
} rows;

struct bt_history {
    rows channel[CHANNEL_COUNT];
    rows q, v;
    rows cable_time, cable_x, cable_y, cable_z, cable_tension;
    bool out_of_memory;
};

static void append(bt_history* history, rows* r, const double* row, size_t width) {
    if (r->count == r->room) {
        const size_t room = r->room ? 2 * r->room : 1024;
        double* data = realloc(r->data, room * width * sizeof *data);
        if (!data) {
            history->out_of_memory = true;
            return;
        }
        r->data = data;
        r->room = room;
        r->width = width;
    }
    memcpy(r->data + r->count * r->width, row, width * sizeof *row);
    ++r->count;
}

bt_status bt_history_create(bt_history** history) {
    *history = calloc(1, sizeof **history);
    return *history ? BT_OK : BT_ERR_MEMORY;
}

void bt_history_destroy(bt_history* history) {
    if (!history)
        return;
    for (int i = 0; i < CHANNEL_COUNT; ++i)
        free(history->channel[i].data);
    rows* const others[] = {
        &history->q,       &history->v,       &history->cable_time,   &history->cable_x,
        &history->cable_y, &history->cable_z, &history->cable_tension};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
        free(others[i]->data);
    free(history);
}

static void observe_cable(bt_history* h, const bt_landing_view* view) {
    const rows* time = &h->cable_time;
    const bool due = time->count == 0 || view->last ||
                     view->time_s >= time->data[time->count - 1] + cable_interval_s;
    if (!due || view->cable_count < 2)
        return;
    const size_t n = (size_t)view->cable_count;
    append(h, &h->cable_time, &view->time_s, 1);
    append(h, &h->cable_x, view->cable_x, n);
    append(h, &h->cable_y, view->cable_y, n);
    append(h, &h->cable_z, view->cable_z, n);
    append(h, &h->cable_tension, view->cable_tension_N, n - 1);
}

void bt_history_observe(void* user, const bt_landing_view* view) {
    bt_history* h = user;
    if (h->out_of_memory)
        return;
    for (int i = 0; i < CHANNEL_COUNT; ++i)
        append(h, &h->channel[i], (const void*)((const char*)view + channels[i].offset),
               (size_t)channels[i].count);
    append(h, &h->q, view->q, Q_SIZE);
    append(h, &h->v, view->v, V_SIZE);
    observe_cable(h, view);
}

/// Some columns of a matrix as one dataset, [n] when there is one column.
typedef struct dataset {
    const rows* rows;
    size_t first, count; ///< columns
    const char *name, *unit, *meaning;
} dataset;

static bool write_columns(hid_t set, const dataset* d) {
    const hsize_t shape[2] = {d->rows->count, d->rows->width ? d->rows->width : 1};
    const hsize_t start[2] = {0, d->first}, block[2] = {d->rows->count, d->count};
    const hid_t memory = H5Screate_simple(2, shape, NULL);
    bool good = memory >= 0;
    if (good && d->rows->count > 0)
        good = H5Sselect_hyperslab(memory, H5S_SELECT_SET, start, NULL, block, NULL) >= 0 &&
               H5Dwrite(set, H5T_NATIVE_DOUBLE, memory, H5S_ALL, H5P_DEFAULT, d->rows->data) >= 0;
    if (memory >= 0)
        H5Sclose(memory);
    return good && bt_hdf5_attribute(set, "unit", d->unit) &&
           bt_hdf5_attribute(set, "meaning", d->meaning);
}

static bool write_dataset(hid_t file, hid_t links, const dataset* d) {
    const hsize_t shape[2] = {d->rows->count, d->count};
    const hid_t space = H5Screate_simple(d->count == 1 ? 1 : 2, shape, NULL);
    const hid_t set = space < 0 ? -1
                                : H5Dcreate2(file, d->name, H5T_IEEE_F64LE, space, links,
                                             H5P_DEFAULT, H5P_DEFAULT);
    bool good = set >= 0 && write_columns(set, d);
    if (set >= 0)
        good &= H5Dclose(set) >= 0;
    if (space >= 0)
        H5Sclose(space);
    return good;
}

/// "hook/angle_rad" of the group hook and the name hook_angle_rad.
static bool write_channel(const channel* c, const rows* values, hid_t file, hid_t links) {
    char name[96], meaning[160];
    const size_t length = strlen(c->group);
    const bool said = strncmp(c->name, c->group, length) == 0 && c->name[length] == '_';
    snprintf(name, sizeof name, "%s%s%s", c->group, length ? "/" : "",
             c->name + (length && said ? length + 1 : 0));
    snprintf(meaning, sizeof meaning, "%s%s", c->text, c->parts);
    const dataset d = {values, 0, (size_t)c->count, name, bt_unit_text(c->unit), meaning};
    return write_dataset(file, links, &d);
}

static bool write_bodies(const bt_history* h, hid_t file, hid_t links) {
    static const struct {
        const char *name, *unit, *meaning;
        bool of_q;
        size_t first, count;
    } part[] = {
        {"position_m", "m", "centre of mass: x, y, z", true, 0, 3},
        {"attitude", "1", "Euler parameters e0, e1, e2, e3, body to deck", true, 3, 4},
        {"velocity_mps", "m/s", "velocity of the centre of mass: x, y, z", false, 0, 3},
        {"spin_radps", "rad/s", "angular velocity in body axes: x, y, z", false, 3, 3},
    };
    bool good = true;
    for (size_t body = 0; body < BT_BODY_COUNT; ++body)
        for (size_t k = 0; k < sizeof part / sizeof part[0]; ++k) {
            char name[96];
            snprintf(name, sizeof name, "bodies/%s/%s", bt_body_names[body], part[k].name);
            const dataset d = {part[k].of_q ? &h->q : &h->v,
                               part[k].first + (part[k].of_q ? 7 : 6) * body,
                               part[k].count,
                               name,
                               part[k].unit,
                               part[k].meaning};
            good = good && write_dataset(file, links, &d);
        }
    return good;
}

static bool write_cable(const bt_history* h, hid_t file, hid_t links) {
    const dataset all[] = {
        {&h->cable_time, 0, 1, "cable/time_s", "s", "time since the first contact with the deck"},
        {&h->cable_x, 0, h->cable_x.width, "cable/x_m", "m", "centres of the segments, forward"},
        {&h->cable_y, 0, h->cable_y.width, "cable/y_m", "m", "centres of the segments, to port"},
        {&h->cable_z, 0, h->cable_z.width, "cable/z_m", "m", "centres of the segments, up"},
        {&h->cable_tension, 0, h->cable_tension.width, "cable/tension_N", "N",
         "tension between neighbouring segments"},
    };
    bool good = true;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        if (all[i].rows->count > 0)
            good = good && write_dataset(file, links, &all[i]);
    return good;
}

/// What goes into a file.
typedef struct content {
    const bt_history* history;
    const bt_study* study;
    const bt_landing_result* result;
} content;

static bool write_all(hid_t file, const void* user) {
    const content* c = user;
    const bt_history* h = c->history;
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    bool good = links >= 0 && H5Pset_create_intermediate_group(links, 1) >= 0;
    good = good && bt_hdf5_attribute(file, "outcome", bt_outcome_name(c->result->outcome)) &&
           bt_hdf5_attribute(file, "mode", bt_mode_name(c->result->mode)) &&
           bt_hdf5_attribute(file, "title", c->study->title) &&
           bt_hdf5_text(file, "study", c->study->text);
    for (int i = 0; i < CHANNEL_COUNT; ++i)
        good = good && write_channel(&channels[i], &h->channel[i], file, links);
    good = good && write_bodies(h, file, links) && write_cable(h, file, links);
    if (links >= 0)
        H5Pclose(links);
    return good;
}

// --- CSV ------------------------------------------------------------------------------------

static const char csv_mark[] = "# Histories of one landing";

/// The columns of the view, which stand in the order of the channels.
static void write_csv_rows(const bt_history* h, FILE* out) {
    for (int i = 0; i < bt_view_column_count; ++i)
        fprintf(out, "%s%s [%s]", i ? "," : "", bt_view_columns[i].quantity,
                bt_unit_text(bt_view_columns[i].unit));
    fputc('\n', out);
    for (size_t row = 0; row < h->channel[0].count; ++row)
        for (int i = 0; i < CHANNEL_COUNT; ++i)
            for (int k = 0; k < channels[i].count; ++k) {
                const rows* r = &h->channel[i];
                char text[40];
                bt_text_print_number(r->data[row * r->width + (size_t)k], text, sizeof text);
                const bool last = i == CHANNEL_COUNT - 1 && k == channels[i].count - 1;
                fprintf(out, "%s%c", text, last ? '\n' : ',');
            }
}

static bt_status write_csv(const bt_history* h, const char* path, const bt_landing_result* result,
                           bt_diag* diag) {
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return BT_ERR_MEMORY;
    fprintf(out, "%s: %s, %s\n", csv_mark, bt_outcome_name(result->outcome),
            bt_mode_name(result->mode));
    write_csv_rows(h, out);
    const bool failed = ferror(out) != 0;
    bt_status status = fclose(out) != 0 || failed ? BT_ERR_MEMORY : BT_OK;
    if (status == BT_OK)
        status = bt_file_replace(path, text, size, sizeof csv_mark - 1, diag);
    free(text);
    return status;
}

// --- writing --------------------------------------------------------------------------------

static bool is_csv(const char* path) {
    const size_t length = strlen(path);
    return length >= 4 && strcmp(path + length - 4, ".csv") == 0;
}

bt_status bt_history_write(const bt_history* history, const char* path, const bt_study* study,
                           const bt_landing_result* result, bt_diag* diag) {
    if (history->out_of_memory)
        return BT_ERR_MEMORY;
    if (bt_study_reads(study, path))
        return bt_file_refuse(path, diag);
    if (is_csv(path))
        return write_csv(history, path, result, diag);
    return bt_hdf5_write(path, write_all, &(content){history, study, result}, diag);
}
