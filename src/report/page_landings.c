#include "report/page_parts.h"

#include "base/directory.h"
#include "base/units.h"
#include "report/atlas_report.h"
#include "report/packed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { DRAWN_MOST = 10000 }; ///< landings in the page; of a larger ledger every n-th catch

// --- reading ----------------------------------------------------------------------------------

bt_status bt_page_landings_read(bt_page* page) {
    const bt_study* study = page->subject->study;
    char path[BT_FILE_PATH_MAX];
    page->landings.axes = bt_design_axes(study);
    BT_TRY(bt_file_path(path, study->directory, BT_LEDGER_NAME));
    if (access(path, F_OK) != 0)
        return BT_OK;
    bt_ledger* ledger = NULL;
    BT_TRY(bt_ledger_open(path, study, BT_LEDGER_READ, &ledger, page->diag));
    const bt_status status = bt_landings_read(study, ledger, &page->landings, page->diag);
    bt_ledger_close(ledger);
    return status == BT_OK ? bt_atlas_make(&page->landings, &page->atlas) : status;
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
    const bt_landings* l = &page->landings;
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
static int choose(const bt_landings* l, int* chosen) {
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
    const bt_landings* l = &page->landings;
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
    const bt_landings* l = &page->landings;
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

void bt_page_atlas_write(bt_page* page) {
    bt_json_begin_array(page->json, "atlas");
    for (int i = 0; i < page->atlas.count; ++i) {
        const bt_miss_group* g = &page->atlas.group[i];
        char region[BT_PATH_MAX + 96];
        bt_atlas_region(page->subject->study, &page->landings, g, region, sizeof region);
        bt_json_begin_object(page->json, NULL);
        bt_json_string(page->json, "mode", bt_mode_name(g->mode));
        bt_json_string(page->json, "region", region);
        bt_json_integer(page->json, "count", g->count);
        bt_json_rounded(page->json, "share", g->share, 6);
        bt_json_rounded(page->json, "probability", g->probability, 6);
        bt_json_begin_array(page->json, "probability_ci95");
        bt_json_rounded(page->json, NULL, g->ci95.least, 6);
        bt_json_rounded(page->json, NULL, g->ci95.greatest, 6);
        bt_json_end_array(page->json);
        bt_json_integer(page->json, "run", page->landings.run[g->typical]);
        bt_json_end_object(page->json);
    }
    bt_json_end_array(page->json);
}
