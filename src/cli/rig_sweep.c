#include "cli/rig_sweep.h"

#include "base/directory.h"
#include "base/text.h"
#include "cli/output.h"
#include "report/figure.h"
#include "report/rig_report.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VALUES_MAX = BT_SERIES_MAX, SET_SIZE = 512, METRICS_MAX = 16 };

/// What is drawn of each kind of rig: one line per value.
static const struct {
    const char *x, *y, *x_label, *y_label;
    double x_scale, y_scale;
} drawn[BT_RIG_COUNT] = {
    [BT_RIG_NOSE_DROP] = {"stroke_m", "strut_force_N", "stroke, mm", "load of the strut, kN", 1e3,
                          1e-3},
    [BT_RIG_MAIN_DROP] = {"stroke_m", "strut_force_N", "stroke, mm", "load of the strut, kN", 1e3,
                          1e-3},
    [BT_RIG_HOOK_REBOUND] = {"time_s", "hook_height_m", "time from first contact, ms",
                             "height of the head, mm", 1e3, 1e3},
    [BT_RIG_NOSE_STATIC] = {"stroke_m", "strut_force_N", "stroke, mm", "load, kN", 1e3, 1e-3},
    [BT_RIG_MAIN_STATIC] = {"stroke_m", "strut_force_N", "stroke, mm", "load, kN", 1e3, 1e-3},
};

typedef struct run {
    char label[64], set[SET_SIZE];
    bt_rig_record record;
    bt_rig_result result;
} run;

typedef struct rig_sweep {
    const bt_command* command;
    const char *key, *title;
    bt_rig_kind kind;
    int count;
    run* runs; ///< [VALUES_MAX]
    bt_diag diag;
} rig_sweep;

// --- running ----------------------------------------------------------------------------------

static bt_status run_one(rig_sweep* s, run* r) {
    bt_command command = *s->command;
    bt_study study;
    if (command.set_count == BT_SETS_MAX)
        return bt_usage_error(&command, "more than %d --set", BT_SETS_MAX - 1);
    command.sets[command.set_count++] = r->set;
    BT_TRY(bt_command_rigs(&command, &study));
    bt_rig_record_start(&r->record, s->kind);
    const bt_status status = bt_rig_run(s->kind, &study.model.aircraft, &study.rigs, &r->result,
                                        bt_rig_record_observe, &r->record, &s->diag);
    bt_study_destroy(&study);
    if (status == BT_OK && r->record.out_of_memory)
        return BT_ERR_MEMORY;
    return status == BT_ERR_NUMERIC ? BT_ERR_FAILED_RUNS : status;
}

static bt_status run_all(rig_sweep* s, const char* list) {
    for (const char* item = list; item;) {
        const size_t length = strcspn(item, ",");
        const char* start = item + strspn(item, " ");
        if (s->count == VALUES_MAX)
            return bt_usage_error(s->command, "--values: at most %d of a rig", (int)VALUES_MAX);
        run* r = &s->runs[s->count++];
        snprintf(r->label, sizeof r->label, "%.*s", (int)(length - (size_t)(start - item)), start);
        snprintf(r->set, sizeof r->set, "%s=%s", s->key, r->label);
        BT_TRY(run_one(s, r));
        item = item[length] ? item + length + 1 : NULL;
    }
    return BT_OK;
}

// --- table ------------------------------------------------------------------------------------

static bt_report_table* create_table(const rig_sweep* s, bt_column columns[1 + METRICS_MAX]) {
    const bt_rig_result* first = &s->runs[0].result;
    int count = 1;
    columns[0] = (bt_column){.name = "value", .head = "value", .unit = ""};
    for (int m = 0; m < first->metric_count && m < METRICS_MAX; ++m) {
        const bt_metric* metric = &first->metrics[m];
        const bool plain = strcmp(metric->unit, "1") == 0;
        columns[count++] = (bt_column){
            .name = metric->name, .head = metric->name, .unit = plain ? "" : metric->unit};
    }
    bt_report_table* table = bt_report_table_create(NULL, columns, count);
    for (int i = 0; i < s->count; ++i) {
        const bt_rig_result* result = &s->runs[i].result;
        bt_report_table_row(table);
        bt_report_table_text(table, s->runs[i].label);
        for (int m = 0; m + 1 < count; ++m) {
            char text[40] = "none";
            if (isfinite(result->metrics[m].value))
                bt_text_print_rounded(result->metrics[m].value, 5, text, sizeof text);
            bt_report_table_said(table, result->metrics[m].value, text);
        }
    }
    return table;
}

static bt_status put_table(const rig_sweep* s, const bt_report_table* table) {
    bt_json json = {.out = stdout};
    if (!s->command->json) {
        printf("%s: %s over %s\n", bt_rig_keys[s->kind], s->title, s->key);
        return bt_report_table_print(table, stdout);
    }
    bt_json_begin_object(&json, NULL);
    bt_json_string(&json, "rig", bt_rig_keys[s->kind]);
    bt_json_string(&json, "key", s->key);
    BT_TRY(bt_report_table_json(table, &json, "rows"));
    bt_json_end_object(&json);
    return BT_OK;
}

// --- figure -----------------------------------------------------------------------------------

static int column_of(const bt_rig_record* record, const char* name) {
    for (int i = 0; i < record->column_count; ++i)
        if (strcmp(record->names[i], name) == 0)
            return i;
    return 0;
}

static double* scaled(const bt_rig_record* record, const char* name, double scale) {
    double* column = record->columns[column_of(record, name)];
    for (int i = 0; i < record->count; ++i)
        column[i] *= scale; // the record is drawn once and goes
    return column;
}

static bt_status draw(rig_sweep* s, const bt_study* study) {
    bt_series series[VALUES_MAX];
    char name[160], folder[BT_FILE_PATH_MAX], title[400];
    snprintf(name, sizeof name, "sweep_%s", s->key);
    for (char* c = name; *c; ++c)
        if (!isalnum((unsigned char)*c))
            *c = '_';
    snprintf(title, sizeof title, "%s: %s", s->title, s->key);
    for (int i = 0; i < s->count; ++i) {
        const bt_rig_record* record = &s->runs[i].record;
        series[i] = (bt_series){.label = s->runs[i].label,
                                .count = record->count,
                                .x = scaled(record, drawn[s->kind].x, drawn[s->kind].x_scale),
                                .y = scaled(record, drawn[s->kind].y, drawn[s->kind].y_scale)};
    }
    const bt_figure figure = {.name = name,
                              .title = title,
                              .x_label = drawn[s->kind].x_label,
                              .y_label = drawn[s->kind].y_label,
                              .ordered = true,
                              .series_count = s->count,
                              .series = series};
    BT_TRY(bt_file_path(folder, study->directory, "figures"));
    BT_TRY(bt_directory_make(folder, &s->diag));
    BT_TRY(bt_figure_write(&figure, folder, &s->diag));
    if (!s->command->json && !s->command->quiet)
        printf("figure: %s/%s.png\n", folder, name);
    return BT_OK;
}

// --- together ---------------------------------------------------------------------------------

bt_status bt_rig_only(const bt_command* command, const bt_study* study, bt_rig_kind* kind) {
    char found[128] = "";
    int count = 0;
    for (int k = 0; k < BT_RIG_COUNT; ++k)
        if (study->rig_inputs[k].given) {
            *kind = (bt_rig_kind)k;
            bt_text_append(found, sizeof found, "%s%s", count++ ? ", " : "", bt_rig_keys[k]);
        }
    if (count == 1)
        return BT_OK;
    if (count == 0)
        return bt_usage_error(command, "%s describes no rig: there is no `rigs:' in it",
                              command->words[0]);
    return bt_usage_error(command, "%s describes %d rigs (%s): say which", command->words[0], count,
                          found);
}

static bt_status find_kind(const bt_command* command, const bt_study* study, const char* key,
                           bt_rig_kind* kind) {
    for (int k = 0; k < BT_RIG_COUNT; ++k) {
        char part[64];
        snprintf(part, sizeof part, "rigs.%s.", bt_rig_keys[k]);
        if (strncmp(key, part, strlen(part)) != 0)
            continue;
        *kind = (bt_rig_kind)k;
        if (study->rig_inputs[k].given)
            return BT_OK;
        return bt_usage_error(command, "--key: %s does not describe rigs.%s", command->words[0],
                              bt_rig_keys[k]);
    }
    return bt_rig_only(command, study, kind);
}

static bt_status show(rig_sweep* s, const bt_study* study) {
    bt_column columns[1 + METRICS_MAX];
    bt_report_table* table = create_table(s, columns);
    bt_status status = put_table(s, table);
    if (status == BT_OK)
        status = bt_output_table(s->command, table, &s->diag);
    bt_report_table_destroy(table);
    if (status == BT_OK && bt_output_kind(s->command->output) != BT_OUTPUT_TABLE)
        status = draw(s, study);
    return status;
}

bt_status bt_rig_sweep(const bt_command* command, const bt_study* study, const char* key,
                       const char* list) {
    rig_sweep s = {.command = command, .key = key, .title = study->title, .diag = bt_stderr_diag()};
    BT_TRY(find_kind(command, study, key, &s.kind));
    s.runs = calloc(VALUES_MAX, sizeof *s.runs);
    if (!s.runs)
        return BT_ERR_MEMORY;
    bt_status status = run_all(&s, list);
    if (status == BT_OK)
        status = show(&s, study);
    for (int i = 0; i < s.count; ++i)
        bt_rig_record_destroy(&s.runs[i].record);
    free(s.runs);
    return status;
}
