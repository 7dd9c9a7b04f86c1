#include "study/csv.h"

#include "base/text.h"
#include "base/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

bt_where bt_csv_place(const bt_csv* c) {
    return (bt_where){c->where.file, c->where.line, (int)(c->at - c->line_start) + 1};
}

/// Blanks, and the quotes that spreadsheets put around cells.
static void skip_blanks(bt_csv* c) {
    while (*c->at == ' ' || *c->at == '\r' || *c->at == '"' ||
           (*c->at == '\t' && c->delimiter != '\t'))
        ++c->at;
}

static bool at_line_end(const bt_csv* c) {
    return *c->at == '\n' || *c->at == '\0';
}

/// Goes to the next line that holds something; false at the end of the text.
static bool next_line(bt_csv* c, bool first) {
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

// --- the header -----------------------------------------------------------------------------

/// The delimiter of a header line: a semicolon or a tabulator wherever it stands, else a comma.
static char delimiter_of(const char* line) {
    const size_t length = strcspn(line, "\n");
    return memchr(line, ';', length) ? ';' : memchr(line, '\t', length) ? '\t' : ',';
}

static void trim_end(const char* text, size_t* length) {
    while (*length > 0 && strchr(" \t\r\"", text[*length - 1]))
        --*length;
}

/// Splits "Load cell (kN)" into name and unit; without one the whole is the name.
static void split_unit(const char* cell, size_t length, bt_csv_heading* h) {
    const char last = length > 0 ? cell[length - 1] : '\0';
    const char opening = last == ']' ? '[' : last == ')' ? '(' : '\0';
    const char* from = opening ? memchr(cell, opening, length) : NULL;
    size_t name_length = from ? (size_t)(from - cell) : length;
    trim_end(cell, &name_length);
    snprintf(h->name, sizeof h->name, "%.*s", (int)name_length, cell);
    snprintf(h->unit, sizeof h->unit, "%.*s", from ? (int)(cell + length - 1 - (from + 1)) : 0,
             from ? from + 1 : "");
}

static void read_heading(bt_csv* c, bt_csv_heading* h) {
    const char ends[] = {c->delimiter, '\n', '\0'};
    skip_blanks(c);
    h->place = bt_csv_place(c);
    size_t length = strcspn(c->at, ends);
    const char* cell = c->at;
    c->at += length;
    trim_end(cell, &length);
    split_unit(cell, length, h);
}

static bt_status refuse_header(const bt_csv_heading* h, const char* example, bt_diag* diag) {
    bt_diag_add(diag, BT_ERROR, h->place,
                "the first line must name the columns and their units, as in: %s", example);
    return BT_ERR_INPUT;
}

static bt_status read_header(bt_csv* c, const char* example, bt_diag* diag) {
    c->delimiter = delimiter_of(c->at);
    for (;;) {
        if (c->count == BT_CSV_COLUMNS_MAX) {
            bt_diag_add(diag, BT_ERROR, bt_csv_place(c), "more than %d columns",
                        (int)BT_CSV_COLUMNS_MAX);
            return BT_ERR_INPUT;
        }
        bt_csv_heading* h = &c->columns[c->count++];
        double number;
        read_heading(c, h);
        if ((!*h->name && *c->at == c->delimiter) || bt_number_parse(h->name, &number) == BT_OK)
            return refuse_header(h, example, diag);
        if (*c->at != c->delimiter)
            break;
        ++c->at;
    }
    c->count -= !*c->columns[c->count - 1].name; // a delimiter at the end of the line
    return BT_OK;
}

bt_status bt_csv_begin(bt_csv* csv, const char* text, const char* file, const char* example,
                       bt_diag* diag) {
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3; // the byte order mark that spreadsheets write
    *csv = (bt_csv){.at = text, .line_start = text, .where = {file, 1, 1}, .delimiter = ','};
    if (next_line(csv, true))
        return read_header(csv, example, diag);
    bt_diag_add(diag, BT_ERROR, csv->where, "the file is empty");
    return BT_ERR_INPUT;
}

bool bt_csv_next(bt_csv* csv) {
    return next_line(csv, false);
}

void bt_csv_list(const bt_csv* csv, char* list, size_t size) {
    *list = '\0';
    for (int i = 0; i < csv->count; ++i)
        bt_text_append(list, size, "%s%s", i ? ", " : "", csv->columns[i].name);
}

bool bt_csv_is_named(const bt_csv_heading* h, const char* wanted) {
    char whole[BT_CSV_NAME_MAX + BT_CSV_UNIT_MAX + 4];
    snprintf(whole, sizeof whole, "%s (%s)", h->name, h->unit);
    if (strcasecmp(h->name, wanted) == 0 || strcasecmp(whole, wanted) == 0)
        return true;
    snprintf(whole, sizeof whole, "%s [%s]", h->name, h->unit);
    return strcasecmp(whole, wanted) == 0;
}

// --- the rows -------------------------------------------------------------------------------

/// The number in a cell, with a decimal point, or a comma where that is no delimiter.
static const char* scan_cell(const bt_csv* c, double* value) {
    char cell[64];
    const char ends[] = {c->delimiter, '\n', '\0'};
    const size_t length = strcspn(c->at, ends);
    const char* comma = c->delimiter == ',' ? NULL : memchr(c->at, ',', length);
    if (!comma || length >= sizeof cell)
        return bt_text_scan_number(c->at, value);
    snprintf(cell, sizeof cell, "%.*s", (int)length, c->at);
    cell[comma - c->at] = '.';
    return c->at + (bt_text_scan_number(cell, value) - cell);
}

static bt_status read_number(bt_csv* c, const char* name, double* value, bt_diag* diag) {
    const char ends[] = {c->delimiter, '\n', '\r', '\0'};
    skip_blanks(c);
    const bt_where start = bt_csv_place(c);
    const char* text = c->at;
    const char* end = scan_cell(c, value);
    c->at = end;
    skip_blanks(c);
    if (end != text && isfinite(*value) && (at_line_end(c) || *c->at == c->delimiter))
        return BT_OK;
    const int length = (int)strcspn(text, ends);
    bt_diag_add(diag, BT_ERROR, start, "%s: \"%.*s\" is not a number", name,
                length < 40 ? length : 40, text);
    return BT_ERR_INPUT;
}

static void skip_cell(bt_csv* c) {
    const char ends[] = {c->delimiter, '\n', '\0'};
    c->at += strcspn(c->at, ends);
}

/// The place of a column among the chosen ones; -1.
static int chosen_at(const int* chosen, int count, int column) {
    for (int i = 0; i < count; ++i)
        if (chosen[i] == column)
            return i;
    return -1;
}

static bt_status refuse_long_row(const bt_csv* c, bt_diag* diag) {
    bt_diag_add(diag, BT_ERROR, bt_csv_place(c), "a row has %d numbers, not more%s", c->count,
                c->delimiter == ',' ? " (the decimal point is \".\")" : "");
    return BT_ERR_INPUT;
}

static bt_status read_cell(bt_csv* c, const char* name, double* number, bt_where* place,
                           bt_diag* diag) {
    skip_blanks(c);
    if (place)
        *place = bt_csv_place(c);
    return read_number(c, name, number, diag);
}

bt_status bt_csv_row(bt_csv* c, const int* chosen, const char* const* names, int count,
                     double* number, bt_where* place, bt_diag* diag) {
    int column = 0;
    for (;; ++column) {
        if (column == c->count) {
            skip_blanks(c);
            if (at_line_end(c)) // a delimiter at the end of the line
                return BT_OK;
            return refuse_long_row(c, diag);
        }
        const int i = chosen_at(chosen, count, column);
        if (i >= 0)
            BT_TRY(read_cell(c, names[i], &number[i], place ? &place[i] : NULL, diag));
        else
            skip_cell(c);
        if (*c->at != c->delimiter)
            break;
        ++c->at;
    }
    for (int i = 0; i < count; ++i)
        if (column < chosen[i]) {
            bt_diag_add(diag, BT_ERROR, bt_csv_place(c), "the row ends before %s", names[i]);
            return BT_ERR_INPUT;
        }
    return BT_OK;
}
