#include "report/page_parts.h"

#include "base/directory.h"
#include "base/units.h"
#include "report/packed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { DRAWN_MOST = 10000 }; ///< landings in the page; of a larger ledger every n-th catch

// --- reading ----------------------------------------------------------------------------------

static bool resize(void** data, size_t size) {
    void* moved = realloc(*data, size);
    if (moved)
        *data = moved;
    return moved != NULL;
}

static bool grow(bt_page_landings* l) {
    if (l->count < l->room)
        return true;
    const size_t room = l->room ? 2 * (size_t)l->room : 4096;
    const size_t dims = (size_t)(l->axes.count > 0 ? l->axes.count : 1);
    if (!resize((void**)&l->run, room * sizeof *l->run) ||
        !resize((void**)&l->x, room * dims * sizeof *l->x) ||
        !resize((void**)&l->margin_m, room * sizeof *l->margin_m) ||
        !resize((void**)&l->mode, room) || !resize((void**)&l->outcome, room) ||
        !resize((void**)&l->bounced, room))
        return false;
    l->room = (int)room;
    return true;
}

typedef struct reading {
    bt_page_landings* landings;
    bool out_of_memory;
} reading;

static bool take(void* user, const bt_ledger_row* row) {
    reading* r = user;
    bt_page_landings* l = r->landings;
    if (!grow(l)) {
        r->out_of_memory = true;
        return false;
    }
    const int i = l->count++;
    l->run[i] = row->run;
    memcpy(l->x + (size_t)i * (size_t)l->axes.count, row->x, (size_t)l->axes.count * sizeof *l->x);
    l->margin_m[i] = row->result.margin_m;
    l->mode[i] = (uint8_t)row->result.mode;
    l->outcome[i] = (uint8_t)row->result.outcome;
    l->bounced[i] = row->result.bounce_count > 0 && row->result.bounces[0].complete;
    return true;
}

bt_status bt_page_landings_read(bt_page* page) {
    const bt_study* study = page->subject->study;
    char path[BT_FILE_PATH_MAX];
    page->landings.axes = bt_design_axes(study);
    BT_TRY(bt_file_path(path, study->directory, BT_LEDGER_NAME));
    if (access(path, F_OK) != 0)
        return BT_OK;
    bt_ledger* ledger = NULL;
    BT_TRY(bt_ledger_open(path, study, BT_LEDGER_READ, &ledger, page->diag));
    reading r = {.landings = &page->landings};
    bt_status status = bt_ledger_walk(ledger, take, &r, page->diag);
    bt_ledger_close(ledger);
    return r.out_of_memory ? BT_ERR_MEMORY : status;
}

void bt_page_landings_destroy(bt_page_landings* l) {
    free(l->run);
    free(l->x);
    free(l->margin_m);
    free(l->mode);
    free(l->outcome);
    free(l->bounced);
    *l = (bt_page_landings){0};
}

// --- writing ----------------------------------------------------------------------------------

static void write_inputs(bt_page* page) {
    const bt_study* study = page->subject->study;
    bt_json_begin_array(page->json, "inputs");
    for (int i = 0; i < page->landings.axes.count; ++i) {
        const bt_input* input = &study->inputs[page->landings.axes.input[i]];
        char label[BT_PATH_MAX];
        double factor;
        const char* unit = bt_display_unit(input->field, &factor);
        bt_display_label(input->path, label, sizeof label);
        bt_json_begin_object(page->json, NULL);
        bt_json_string(page->json, "path", input->path);
        bt_json_string(page->json, "label", label);
        bt_json_string(page->json, "unit", unit);
        bt_json_number(page->json, "factor", factor);
        bt_json_end_object(page->json);
    }
    bt_json_end_array(page->json);
}

static void write_counts(bt_page* page) {
    const bt_page_landings* l = &page->landings;
    int outcomes[3] = {0}, modes[BT_MODE_COUNT] = {0};
    for (int i = 0; i < l->count; ++i) {
        ++outcomes[l->outcome[i]];
        ++modes[l->mode[i]];
    }
    bt_json_begin_object(page->json, "counts");
    bt_json_integer(page->json, "landings", l->count);
    bt_json_integer(page->json, "engaged", outcomes[BT_ENGAGED]);
    bt_json_integer(page->json, "missed", outcomes[BT_MISSED]);
    bt_json_integer(page->json, "failed", outcomes[BT_FAILED]);
    bt_json_begin_object(page->json, "modes");
    for (int mode = 0; mode < BT_MODE_COUNT; ++mode)
        bt_json_integer(page->json, bt_mode_name((bt_mode)mode), modes[mode]);
    bt_json_end_object(page->json);
    bt_json_end_object(page->json);
}

/// Every landing that was not caught, and every n-th of the others.
static int choose(const bt_page_landings* l, int* chosen) {
    int caught = 0, count = 0, seen = 0;
    for (int i = 0; i < l->count; ++i)
        caught += l->outcome[i] == BT_ENGAGED;
    const int room = DRAWN_MOST - (l->count - caught);
    const int every = room > 0 ? 1 + (caught - 1) / room : caught + 1;
    for (int i = 0; i < l->count; ++i)
        if (l->outcome[i] != BT_ENGAGED ? count < DRAWN_MOST : seen++ % every == 0)
            chosen[count++] = i;
    return count;
}

static void write_columns(bt_page* page, const int* chosen, int count, double* values) {
    const bt_page_landings* l = &page->landings;
    const int dims = l->axes.count;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < dims; ++k)
            values[i * dims + k] = l->x[chosen[i] * dims + k];
    bt_json_floats(page->json, "inputs", values, (size_t)(count * dims));
    for (int i = 0; i < count; ++i)
        values[i] = l->margin_m[chosen[i]];
    bt_json_floats(page->json, "margins", values, (size_t)count);
    bt_json_text(page->json, "modes", "\"");
    for (int i = 0; i < count; ++i)
        fputc('a' + l->mode[chosen[i]], page->json->out);
    fputc('"', page->json->out);
    bt_json_begin_array(page->json, "runs");
    for (int i = 0; i < count; ++i)
        bt_json_integer(page->json, NULL, l->run[chosen[i]]);
    bt_json_end_array(page->json);
}

void bt_page_landings_write(bt_page* page) {
    const bt_page_landings* l = &page->landings;
    write_inputs(page);
    bt_json_begin_array(page->json, "modes");
    for (int mode = 0; mode < BT_MODE_COUNT; ++mode)
        bt_json_string(page->json, NULL, bt_mode_name((bt_mode)mode));
    bt_json_end_array(page->json);
    if (l->count == 0)
        return;
    write_counts(page);
    int* chosen = malloc((size_t)l->count * sizeof *chosen);
    double* values = malloc((size_t)l->count * (size_t)(l->axes.count + 1) * sizeof *values);
    if (chosen && values) {
        bt_json_begin_object(page->json, "landings");
        write_columns(page, chosen, choose(l, chosen), values);
        bt_json_end_object(page->json);
    }
    free(chosen);
    free(values);
}
