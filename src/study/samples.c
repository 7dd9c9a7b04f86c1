#include "study/samples.h"

#include "base/directory.h"
#include "study/columns.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLACE_SIZE = 288 };

/// Values while they are read.
typedef struct list {
    int count;
    double value[BT_SAMPLE_MAX], weight[BT_SAMPLE_MAX];
} list;

typedef struct reading {
    bt_reader* reader;
    const bt_study_files* files;
    bt_study* study;
    bt_input* input;
    const bt_node* node;
    const char* path;
    list* list;
} reading;

static void place_of(const reading* r, const char* key, char* place) {
    bt_reader_join(place, PLACE_SIZE, r->path, key);
}

static bool is_sequence(const reading* r, const char* key, const bt_node* node) {
    char place[PLACE_SIZE];
    if (node->kind == BT_NODE_SEQUENCE)
        return true;
    place_of(r, key, place);
    bt_reader_error(r->reader, node->where, "%s: a sequence is wanted here", place);
    return false;
}

static void read_values(const reading* r, const bt_node* node) {
    char place[PLACE_SIZE];
    if (!is_sequence(r, "values", node))
        return;
    place_of(r, "values", place);
    for (const bt_node* item = node->first; item && r->list->count < BT_SAMPLE_MAX;
         item = item->next)
        if (bt_reader_number(r->reader, r->input->field, item, place, true,
                             &r->list->value[r->list->count]))
            r->list->weight[r->list->count++] = 1;
}

// --- discrete -------------------------------------------------------------------------------

static void read_probabilities(const reading* r, const bt_node* values, const bt_node* node) {
    static const bt_field share = {.kind = BT_FIELD_PLAIN, .unit = "", .greatest = 1};
    char place[PLACE_SIZE];
    double sum = 0;
    int count = 0;
    place_of(r, "probabilities", place);
    if (!is_sequence(r, "probabilities", node))
        return;
    if (node->count != values->count) {
        bt_reader_error(r->reader, node->where, "%s: %d probabilities for %d values", place,
                        node->count, values->count);
        return;
    }
    for (const bt_node* item = node->first; item && count < BT_SAMPLE_MAX; item = item->next)
        if (bt_reader_number(r->reader, &share, item, place, true, &r->list->weight[count]))
            sum += r->list->weight[count++];
    if (count == node->count && fabs(sum - 1) > 1e-6)
        bt_reader_error(r->reader, node->where, "%s: their sum is %.9g, not 1", place, sum);
}

static void refuse_twins(const reading* r, const bt_node* values) {
    char place[PLACE_SIZE];
    place_of(r, "values", place);
    const bt_node* item = values->first;
    for (int i = 0; i < r->list->count && item; ++i, item = item->next)
        for (int k = 0; k < i; ++k)
            if (r->list->value[k] == r->list->value[i])
                bt_reader_error(r->reader, item->where, "%s: %s is given twice", place, item->text);
}

static void read_discrete(const reading* r) {
    static const char* const keys[] = {"values", "probabilities"};
    const bt_node* given[2];
    for (int i = 0; i < 2; ++i) {
        char place[PLACE_SIZE];
        given[i] = bt_node_child(r->node, keys[i]);
        place_of(r, keys[i], place);
        if (!given[i])
            bt_reader_error(r->reader, r->node->key->where, "%s: missing; discrete needs it",
                            place);
    }
    if (!given[0] || !given[1])
        return;
    read_values(r, given[0]);
    if (r->list->count == given[0]->count) {
        read_probabilities(r, given[0], given[1]);
        refuse_twins(r, given[0]);
    }
}

// --- empirical ------------------------------------------------------------------------------

/// The column that is meant; -1 after reporting.
static int find_column(const reading* r, const bt_csv* csv) {
    const bt_node* column = bt_node_child(r->node, "column");
    char names[512];
    bt_csv_list(csv, names, sizeof names);
    if (!column && csv->count == 1)
        return 0;
    for (int i = 0; i < csv->count && column; ++i)
        if (bt_csv_is_named(&csv->columns[i], column->text))
            return i;
    if (!column)
        bt_reader_error(r->reader, csv->columns[1].place,
                        "%s.column: missing; it says which of the %d columns is meant: %s", r->path,
                        csv->count, names);
    else
        bt_reader_error(r->reader, column->where, "%s.column: %s has no column \"%s\"; it has %s",
                        r->path, csv->where.file, column->text, names);
    return -1;
}

static void read_rows(const reading* r, bt_csv* csv, int column) {
    const bt_csv_heading* heading = &csv->columns[column];
    const char* const name[] = {heading->name};
    bt_diag diag = bt_reader_diag(r->reader);
    bt_where place = BT_NOWHERE;
    while (bt_csv_next(csv)) {
        double number;
        const bt_where row = bt_csv_place(csv);
        if (r->list->count == BT_SAMPLE_MAX) {
            bt_reader_error(r->reader, row, "more than %d rows; a family fits so many",
                            (int)BT_SAMPLE_MAX);
            return;
        }
        if (bt_csv_row(csv, &column, name, 1, &number, &place, &diag) != BT_OK ||
            !bt_column_value(r->reader, r->input->field, heading, number, place,
                             &r->list->value[r->list->count]))
            return;
        r->list->weight[r->list->count++] = 1;
    }
}

static void read_file(const reading* r, const bt_node* node) {
    char place[PLACE_SIZE], *text = NULL;
    place_of(r, "file", place);
    const char* file = bt_study_file(r->reader, r->files, node, place);
    bt_diag diag = bt_reader_diag(r->reader);
    bt_csv* csv = calloc(1, sizeof *csv);
    if (file && csv && bt_file_read(file, &text, NULL, &diag) == BT_OK) {
        bt_study_note_file(r->study, file);
        const int column = bt_csv_begin(csv, text, file, "sink speed [m/s]", &diag) == BT_OK
                               ? find_column(r, csv)
                               : -1;
        if (column >= 0 && bt_column_has_unit(r->reader, r->input->field, &csv->columns[column]))
            read_rows(r, csv, column);
    }
    free(text);
    free(csv);
}

static bool all_equal(const list* l) {
    for (int i = 1; i < l->count; ++i)
        if (l->value[i] != l->value[0])
            return false;
    return true;
}

static void read_empirical(const reading* r, double* bandwidth) {
    const bt_node *file = bt_node_child(r->node, "file"),
                  *values = bt_node_child(r->node, "values"),
                  *width = bt_node_child(r->node, "bandwidth");
    char place[PLACE_SIZE];
    place_of(r, "bandwidth", place);
    const int before = r->reader->errors;
    if (!file == !values) {
        bt_reader_error(r->reader, r->node->key->where, "%s: %s; empirical needs one of them",
                        r->path, file ? "file and values are both given" : "no file and no values");
        return;
    }
    if (file)
        read_file(r, file);
    else
        read_values(r, values);
    if (r->reader->errors == before && all_equal(r->list))
        bt_reader_error(r->reader, (file ? file : values)->where,
                        "%s: an empirical distribution needs two different values at least; here "
                        "%s %s",
                        r->path, r->list->count == 1 ? "is" : "are",
                        r->list->count == 0   ? "none"
                        : r->list->count == 1 ? "one"
                                              : "only equal ones");
    if (!width || r->reader->errors != before)
        return;
    if (strcmp(width->text, "auto") == 0)
        *bandwidth = bt_sample_bandwidth(r->list->value, r->list->count);
    else if (bt_reader_number(r->reader, r->input->field, width, place, false, bandwidth) &&
             !(*bandwidth > 0))
        bt_reader_error(r->reader, width->where, "%s: must be positive, or auto", place);
}

// --- together -------------------------------------------------------------------------------

void bt_sample_read(bt_reader* reader, const bt_study_files* files, bt_study* study,
                    bt_input* input, const bt_node* node, const char* path) {
    const int before = reader->errors;
    const reading r = {reader, files, study, input, node, path, calloc(1, sizeof(list))};
    bt_distribution* d = &input->distribution;
    bt_sample* sample = NULL;
    double bandwidth = 0;
    bt_status status = r.list ? BT_OK : BT_ERR_MEMORY;
    if (status == BT_OK && d->kind == BT_DISCRETE)
        read_discrete(&r);
    else if (status == BT_OK)
        read_empirical(&r, &bandwidth);
    if (status == BT_OK && reader->errors == before)
        status = bt_sample_create(r.list->value, r.list->weight, r.list->count, bandwidth, &sample);
    if (status == BT_ERR_ARG)
        bt_reader_error(reader, node->key->where,
                        "%s: 1 to %d values, and a bandwidth that is not thousands of times below "
                        "their range, are wanted",
                        path, (int)BT_SAMPLE_MAX);
    else if (status != BT_OK)
        bt_reader_error(reader, node->key->where, "%s: %s", path, bt_status_text(status));
    free(r.list);
    d->sample = sample;
    d->mean = sample ? bt_sample_mean(sample) : 0;
}
