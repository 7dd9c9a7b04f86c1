#include "study/measured.h"

#include "base/directory.h"
#include "base/text.h"
#include "base/units.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A place in the text while it is read.
typedef struct cursor {
    const char *at, *line_start;
    bt_where where;
} cursor;

static bt_where place(const cursor* c) {
    return (bt_where){c->where.file, c->where.line, (int)(c->at - c->line_start) + 1};
}

static void skip_blanks(cursor* c) {
    while (*c->at == ' ' || *c->at == '\t' || *c->at == '\r')
        ++c->at;
}

/// Goes to the next line that holds something; false at the end of the text.
static bool next_line(cursor* c, bool first) {
    for (;; first = false) {
        if (!first) {
            c->at += strcspn(c->at, "\n");
            if (*c->at == '\0')
                return false;
            ++c->at;
            ++c->where.line;
        }
        c->line_start = c->at;
        skip_blanks(c);
        if (*c->at != '\0' && *c->at != '\n' && *c->at != '#')
            return true;
        if (*c->at == '\0')
            return false;
    }
}

/// One heading, "stroke [mm]"; the unit may be missing.
static bt_status read_heading(cursor* c, char* name, char* unit, size_t unit_size, bt_where* where,
                              bt_diag* diag) {
    skip_blanks(c);
    *where = place(c);
    size_t length = strcspn(c->at, ",[\n\r");
    const char* start = c->at;
    c->at += length;
    while (length > 0 && (start[length - 1] == ' ' || start[length - 1] == '\t'))
        --length;
    snprintf(name, BT_MEASURED_NAME_MAX, "%.*s", (int)length, start);
    *unit = '\0';
    if (*c->at == '[') {
        const size_t width = strcspn(c->at + 1, "],\n\r");
        snprintf(unit, unit_size, "%.*s", (int)width, c->at + 1);
        c->at += 1 + width;
        if (*c->at == ']')
            ++c->at;
        skip_blanks(c);
    }
    double number;
    if (length == 0 || length >= BT_MEASURED_NAME_MAX || bt_number_parse(name, &number) == BT_OK) {
        bt_diag_add(diag, BT_ERROR, *where,
                    "the first line must name two columns and their units, as in: time [s], "
                    "stroke [mm]");
        return BT_ERR_INPUT;
    }
    return BT_OK;
}

static bt_status read_header(cursor* c, bt_measured* m, bt_diag* diag) {
    BT_TRY(read_heading(c, m->x_name, m->x_unit, sizeof m->x_unit, &m->x_place, diag));
    if (*c->at != ',') {
        bt_diag_add(diag, BT_ERROR, place(c),
                    "a comma and a second column are wanted here, as in: time [s], stroke [mm]%s",
                    *c->at == ';' ? "; semicolons and decimal commas are not read" : "");
        return BT_ERR_INPUT;
    }
    ++c->at;
    BT_TRY(read_heading(c, m->y_name, m->y_unit, sizeof m->y_unit, &m->y_place, diag));
    if (*c->at != '\n' && *c->at != '\0') {
        bt_diag_add(diag, BT_ERROR, place(c), "two columns are wanted, not more");
        return BT_ERR_INPUT;
    }
    return BT_OK;
}

static bt_status read_number(cursor* c, const char* name, double* value, bt_diag* diag) {
    skip_blanks(c);
    const char* end = bt_text_scan_number(c->at, value);
    if (end == c->at || !isfinite(*value)) {
        const int length = (int)strcspn(c->at, ",\n\r");
        bt_diag_add(diag, BT_ERROR, place(c), "%s: \"%.*s\" is not a number", name,
                    length < 40 ? length : 40, c->at);
        return BT_ERR_INPUT;
    }
    c->at = end;
    skip_blanks(c);
    return BT_OK;
}

static bt_status read_row(cursor* c, bt_measured* m, bt_diag* diag) {
    const int i = m->count;
    const bt_where start = place(c);
    BT_TRY(read_number(c, m->x_name, &m->x[i], diag));
    if (*c->at != ',') {
        bt_diag_add(diag, BT_ERROR, place(c), "a comma and the value of %s are wanted here",
                    m->y_name);
        return BT_ERR_INPUT;
    }
    ++c->at;
    BT_TRY(read_number(c, m->y_name, &m->y[i], diag));
    if (*c->at != '\n' && *c->at != '\0') {
        bt_diag_add(diag, BT_ERROR, place(c),
                    "a row has two numbers, not more (the decimal point is \".\")");
        return BT_ERR_INPUT;
    }
    if (i > 0 && !(m->x[i] > m->x[i - 1])) {
        bt_diag_add(diag, BT_ERROR, start, "%s does not increase", m->x_name);
        return BT_ERR_INPUT;
    }
    ++m->count;
    return BT_OK;
}

static bt_status read_text(const char* text, bt_measured* m, bt_diag* diag) {
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3; // the byte order mark that spreadsheets write
    cursor c = {text, text, {m->file, 1, 1}};
    if (!next_line(&c, true)) {
        bt_diag_add(diag, BT_ERROR, c.where, "the file is empty");
        return BT_ERR_INPUT;
    }
    BT_TRY(read_header(&c, m, diag));
    while (next_line(&c, false)) {
        if (m->count == BT_MEASURED_ROWS_MAX) {
            bt_diag_add(diag, BT_ERROR, place(&c), "more than %d rows", BT_MEASURED_ROWS_MAX);
            return BT_ERR_INPUT;
        }
        BT_TRY(read_row(&c, m, diag));
    }
    if (m->count >= 2)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, c.where, "two rows at least are wanted");
    return BT_ERR_INPUT;
}

bt_status bt_measured_read(const char* path, bt_measured** measured, bt_diag* diag) {
    char* text = NULL;
    *measured = NULL;
    BT_TRY(bt_file_read(path, &text, NULL, diag));
    bt_measured* m = calloc(1, sizeof *m);
    bt_status status = BT_ERR_MEMORY;
    if (m) {
        m->file = path;
        m->x = malloc(BT_MEASURED_ROWS_MAX * sizeof *m->x);
        m->y = malloc(BT_MEASURED_ROWS_MAX * sizeof *m->y);
        if (m->x && m->y)
            status = read_text(text, m, diag);
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
    if (strcmp(history, name) == 0)
        return "1";
    if (strncmp(history, name, length) != 0 || history[length] != '_')
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
    bt_diag_add(diag, BT_ERROR, where,
                "%s: no such column in this experiment's history; it has %s%s", name, list,
                strchr(name, '(') ? "; units stand in brackets, as in stroke [mm]" : "");
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
    bt_diag_add(diag, BT_ERROR, where, "%s: the unit in brackets is wrong: %s", name, why);
    return BT_ERR_INPUT;
}

bt_status bt_measured_bind(bt_measured* measured, const char* const* names, int count,
                           bt_diag* diag) {
    double x_factor = 1, y_factor = 1;
    char x_token[24];
    const bt_status x = bind_column(measured->x_name, measured->x_unit, measured->x_place, names,
                                    count, &measured->x_column, &x_factor, x_token, diag);
    const bt_status y = bind_column(measured->y_name, measured->y_unit, measured->y_place, names,
                                    count, &measured->y_column, &y_factor, measured->y_token, diag);
    if (x != BT_OK || y != BT_OK)
        return BT_ERR_INPUT;
    for (int i = 0; i < measured->count; ++i) {
        measured->x[i] *= x_factor;
        measured->y[i] *= y_factor;
    }
    return BT_OK;
}
