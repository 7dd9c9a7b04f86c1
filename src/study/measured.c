#include "study/measured.h"

#include "base/directory.h"
#include "base/text.h"
#include "base/units.h"
#include "study/csv.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/// Finds a column by its heading; -1 after saying which there are.
static int find_heading(const bt_csv* head, const char* wanted, const bt_measured_columns* columns,
                        const char* file, bt_diag* diag) {
    for (int i = 0; i < head->count; ++i)
        if (bt_csv_is_named(&head->columns[i], wanted))
            return i;
    char list[512];
    bt_csv_list(head, list, sizeof list);
    bt_diag_add(diag, BT_ERROR, columns->where, "curve: %s has no column \"%s\"; it has %s", file,
                wanted, list);
    return -1;
}

static bt_status choose(const bt_csv* head, const bt_measured_columns* columns, const char* file,
                        int chosen[2], bt_diag* diag) {
    if (columns && columns->y_heading) {
        chosen[0] =
            columns->x_heading ? find_heading(head, columns->x_heading, columns, file, diag) : 0;
        chosen[1] = find_heading(head, columns->y_heading, columns, file, diag);
        return chosen[0] >= 0 && chosen[1] >= 0 ? BT_OK : BT_ERR_INPUT;
    }
    chosen[0] = 0;
    chosen[1] = 1;
    if (head->count == 2)
        return BT_OK;
    char list[512];
    bt_csv_list(head, list, sizeof list);
    bt_diag_add(diag, BT_ERROR, head->columns[2].place,
                "%d columns (%s): say which are meant, as in curve: {file: ..., x: %s, y: {stroke: "
                "%s}}",
                head->count, list, head->columns[0].name, head->columns[1].name);
    return BT_ERR_INPUT;
}

static void take_column(const bt_csv_heading* h, const char* name, char* to, char* unit,
                        bt_where* where) {
    snprintf(to, BT_MEASURED_NAME_MAX, "%s", name ? name : h->name);
    snprintf(unit, sizeof h->unit, "%s", h->unit);
    *where = h->place;
}

static bt_status make_room(bt_measured* m, int* room) {
    if (m->count < *room)
        return BT_OK;
    const size_t wanted = *room ? 2 * (size_t)*room : 1024;
    double* x = realloc(m->x, wanted * sizeof *x);
    m->x = x ? x : m->x;
    double* y = realloc(m->y, wanted * sizeof *y);
    m->y = y ? y : m->y;
    *room = x && y ? (int)wanted : *room;
    return x && y ? BT_OK : BT_ERR_MEMORY;
}

static bt_status read_rows(bt_csv* c, bt_measured* m, const int chosen[2], bt_diag* diag) {
    const char* const names[] = {m->x_name, m->y_name};
    const int count = chosen[0] == chosen[1] ? 1 : 2;
    int room = 0;
    while (bt_csv_next(c)) {
        double number[2] = {0, 0};
        const bt_where start = bt_csv_place(c);
        if (m->count == BT_MEASURED_ROWS_MAX) {
            bt_diag_add(diag, BT_ERROR, start, "more than %d rows", BT_MEASURED_ROWS_MAX);
            return BT_ERR_INPUT;
        }
        BT_TRY(make_room(m, &room));
        BT_TRY(bt_csv_row(c, chosen, names, count, number, NULL, diag));
        m->x[m->count] = number[0];
        m->y[m->count] = number[1];
        if (m->ordered && m->count > 0 && number[0] < m->x[m->count - 1]) {
            m->ordered = false;
            m->fall_place = start;
        }
        ++m->count;
    }
    if (m->count >= 2)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, c->where, "two rows at least are wanted");
    return BT_ERR_INPUT;
}

static bt_status read_text(const char* text, const bt_measured_columns* columns, bt_measured* m,
                           bt_diag* diag) {
    static const char example[] = "time [s], stroke [mm]";
    bt_csv c;
    int chosen[2];
    BT_TRY(bt_csv_begin(&c, text, m->file, example, diag));
    if (c.count < 2) {
        bt_diag_add(diag, BT_ERROR, bt_csv_place(&c),
                    "a second column is wanted here, behind a comma, a semicolon or a tabulator, "
                    "as in: %s",
                    example);
        return BT_ERR_INPUT;
    }
    BT_TRY(choose(&c, columns, m->file, chosen, diag));
    take_column(&c.columns[chosen[0]], columns ? columns->x_name : NULL, m->x_name, m->x_unit,
                &m->x_place);
    take_column(&c.columns[chosen[1]], columns ? columns->y_name : NULL, m->y_name, m->y_unit,
                &m->y_place);
    return read_rows(&c, m, chosen, diag);
}

bt_status bt_measured_read(const char* path, const bt_measured_columns* columns,
                           bt_measured** measured, bt_diag* diag) {
    char* text = NULL;
    *measured = NULL;
    BT_TRY(bt_file_read(path, &text, NULL, diag));
    bt_measured* m = calloc(1, sizeof *m);
    bt_status status = BT_ERR_MEMORY;
    if (m) {
        m->file = path;
        m->ordered = true;
        m->offset = columns ? columns->offset : NULL;
        m->offset_place = columns ? columns->where : BT_NOWHERE;
        status = read_text(text, columns, m, diag);
    }
    free(text);
    if (status == BT_OK)
        *measured = m;
    else
        bt_measured_destroy(m);
    return status;
}

void bt_measured_destroy(bt_measured* measured) {
    if (!measured)
        return;
    free(measured->x);
    free(measured->y);
    free(measured);
}

/// The unit token of a history's name when its first part is `name`: "m" of "stroke_m".
static const char* token_after(const char* history, const char* name) {
    const size_t length = strlen(name);
    if (strcasecmp(history, name) == 0)
        return "1";
    if (strncasecmp(history, name, length) != 0 || history[length] != '_')
        return NULL;
    const char* token = history + length + 1;
    return bt_unit_text(token) ? token : NULL;
}

static void report_column(const char* name, bt_where where, const char* const* names, int count,
                          bt_diag* diag) {
    char list[512] = "";
    for (int i = 0; i < count; ++i) {
        const char* last = strrchr(names[i], '_');
        const bool has_unit = last && bt_unit_text(last + 1);
        bt_text_append(list, sizeof list, "%s%.*s", i ? ", " : "",
                       has_unit ? (int)(last - names[i]) : (int)strlen(names[i]), names[i]);
    }
    bt_diag_add(diag, BT_ERROR, where, "%s: no such column; the recorded ones are %s", name, list);
}

/// Finds a column and the factor from its written unit to SI.
static bt_status bind_column(const char* name, const char* unit, bt_where where,
                             const char* const* names, int count, int* column, double* factor,
                             char token_out[24], bt_diag* diag) {
    const char* token = NULL;
    for (*column = 0; *column < count; ++*column) {
        token = token_after(names[*column], name);
        if (token)
            break;
    }
    if (!token) {
        report_column(name, where, names, count, diag);
        return BT_ERR_INPUT;
    }
    char one[48], why[256];
    snprintf(token_out, 24, "%s", token);
    snprintf(one, sizeof one, "1 %s", unit);
    if (bt_unit_parse(*unit ? one : "1", token, factor, why, sizeof why) == BT_OK)
        return BT_OK;
    if (!*unit) {
        bt_diag_add(diag, BT_ERROR, where, "%s: its unit is missing; write it in brackets: %s [%s]",
                    name, name, bt_unit_text(token));
        return BT_ERR_INPUT;
    }
    bt_diag_add(diag, BT_ERROR, where, "%s: the unit of its heading is wrong: %s", name, why);
    return BT_ERR_INPUT;
}

/// A quantity that a loop or a time is measured over must not run backwards where it is time.
static bt_status check_time(const bt_measured* m, const char* name, bt_diag* diag) {
    if (m->ordered || strcmp(name, "time_s") != 0)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, m->fall_place, "%s goes back", m->x_name);
    return BT_ERR_INPUT;
}

static bt_status read_offset(const bt_measured* m, const char* token, double* offset,
                             bt_diag* diag) {
    char why[256];
    *offset = 0;
    if (!m->offset || bt_unit_parse(m->offset, token, offset, why, sizeof why) == BT_OK)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, m->offset_place, "curve: offset: %s", why);
    return BT_ERR_INPUT;
}

bt_status bt_measured_bind(bt_measured* measured, const char* const* names, int count,
                           bt_diag* diag) {
    double x_factor = 1, y_factor = 1, offset;
    char x_token[24];
    const bt_status x = bind_column(measured->x_name, measured->x_unit, measured->x_place, names,
                                    count, &measured->x_column, &x_factor, x_token, diag);
    const bt_status y = bind_column(measured->y_name, measured->y_unit, measured->y_place, names,
                                    count, &measured->y_column, &y_factor, measured->y_token, diag);
    if (x != BT_OK || y != BT_OK)
        return BT_ERR_INPUT;
    BT_TRY(check_time(measured, names[measured->x_column], diag));
    BT_TRY(read_offset(measured, x_token, &offset, diag));
    for (int i = 0; i < measured->count; ++i) {
        measured->x[i] = measured->x[i] * x_factor - offset;
        measured->y[i] *= y_factor;
    }
    return BT_OK;
}
