#include "study/measured.h"

#include "base/directory.h"
#include "base/text.h"
#include "base/units.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/// A place in the text while it is read, and how the text is written.
typedef struct cursor {
    const char *at, *line_start;
    bt_where where;
    char delimiter;
} cursor;

static bt_where place(const cursor* c) {
    return (bt_where){c->where.file, c->where.line, (int)(c->at - c->line_start) + 1};
}

/// Blanks, and the quotes that spreadsheets put around cells.
static void skip_blanks(cursor* c) {
    while (*c->at == ' ' || *c->at == '\r' || *c->at == '"' ||
           (*c->at == '\t' && c->delimiter != '\t'))
        ++c->at;
}

static bool at_line_end(const cursor* c) {
    return *c->at == '\n' || *c->at == '\0';
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

// --- the header -----------------------------------------------------------------------------

typedef struct heading {
    char name[BT_MEASURED_NAME_MAX], unit[32];
    bt_where place;
} heading;

typedef struct header {
    int count;
    heading columns[BT_MEASURED_COLUMNS_MAX];
} header;

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
static void split_unit(const char* cell, size_t length, heading* h) {
    const char last = length > 0 ? cell[length - 1] : '\0';
    const char opening = last == ']' ? '[' : last == ')' ? '(' : '\0';
    const char* from = opening ? memchr(cell, opening, length) : NULL;
    size_t name_length = from ? (size_t)(from - cell) : length;
    trim_end(cell, &name_length);
    snprintf(h->name, sizeof h->name, "%.*s", (int)name_length, cell);
    snprintf(h->unit, sizeof h->unit, "%.*s", from ? (int)(cell + length - 1 - (from + 1)) : 0,
             from ? from + 1 : "");
}

static void read_heading(cursor* c, heading* h) {
    const char ends[] = {c->delimiter, '\n', '\0'};
    skip_blanks(c);
    h->place = place(c);
    size_t length = strcspn(c->at, ends);
    const char* cell = c->at;
    c->at += length;
    trim_end(cell, &length);
    split_unit(cell, length, h);
}

static bt_status refuse_header(const heading* h, bt_diag* diag) {
    bt_diag_add(
        diag, BT_ERROR, h->place,
        "the first line must name the columns and their units, as in: time [s], stroke [mm]");
    return BT_ERR_INPUT;
}

static bt_status read_header(cursor* c, header* head, bt_diag* diag) {
    c->delimiter = delimiter_of(c->at);
    for (;;) {
        if (head->count == BT_MEASURED_COLUMNS_MAX) {
            bt_diag_add(diag, BT_ERROR, place(c), "more than %d columns",
                        (int)BT_MEASURED_COLUMNS_MAX);
            return BT_ERR_INPUT;
        }
        heading* h = &head->columns[head->count++];
        double number;
        read_heading(c, h);
        if ((!*h->name && *c->at == c->delimiter) || bt_number_parse(h->name, &number) == BT_OK)
            return refuse_header(h, diag);
        if (*c->at != c->delimiter)
            break;
        ++c->at;
    }
    const heading* last = &head->columns[head->count - 1];
    head->count -= !*last->name; // a delimiter at the end of the line
    if (head->count >= 2)
        return BT_OK;
    bt_diag_add(
        diag, BT_ERROR, place(c),
        "a second column is wanted here, behind a comma, a semicolon or a tabulator, as in: "
        "time [s], stroke [mm]");
    return BT_ERR_INPUT;
}

static void list_headings(const header* head, char* list, size_t size) {
    *list = '\0';
    for (int i = 0; i < head->count; ++i)
        bt_text_append(list, size, "%s%s", i ? ", " : "", head->columns[i].name);
}

/// Whether a column is the one that is meant: by its name, or by name and unit as in the file.
static bool is_named(const heading* h, const char* wanted) {
    char whole[128];
    snprintf(whole, sizeof whole, "%s (%s)", h->name, h->unit);
    if (strcasecmp(h->name, wanted) == 0 || strcasecmp(whole, wanted) == 0)
        return true;
    snprintf(whole, sizeof whole, "%s [%s]", h->name, h->unit);
    return strcasecmp(whole, wanted) == 0;
}

/// Finds a column by its heading; -1 after saying which there are.
static int find_heading(const header* head, const char* wanted, const bt_measured_columns* columns,
                        const char* file, bt_diag* diag) {
    for (int i = 0; i < head->count; ++i)
        if (is_named(&head->columns[i], wanted))
            return i;
    char list[512];
    list_headings(head, list, sizeof list);
    bt_diag_add(diag, BT_ERROR, columns->where, "curve: %s has no column \"%s\"; it has %s", file,
                wanted, list);
    return -1;
}

static bt_status choose(const header* head, const bt_measured_columns* columns, const char* file,
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
    list_headings(head, list, sizeof list);
    bt_diag_add(diag, BT_ERROR, head->columns[2].place,
                "%d columns (%s): say which are meant, as in curve: {file: ..., x: %s, y: {stroke: "
                "%s}}",
                head->count, list, head->columns[0].name, head->columns[1].name);
    return BT_ERR_INPUT;
}

static void take_column(const heading* h, const char* name, char* to, char* unit, bt_where* where) {
    snprintf(to, BT_MEASURED_NAME_MAX, "%s", name ? name : h->name);
    snprintf(unit, sizeof h->unit, "%s", h->unit);
    *where = h->place;
}

// --- the rows -------------------------------------------------------------------------------

/// The number in a cell, with a decimal point, or a comma where that is no delimiter.
static const char* scan_cell(const cursor* c, double* value) {
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

static bt_status read_number(cursor* c, const char* name, double* value, bt_diag* diag) {
    const char ends[] = {c->delimiter, '\n', '\r', '\0'};
    skip_blanks(c);
    const bt_where start = place(c);
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

static void skip_cell(cursor* c) {
    const char ends[] = {c->delimiter, '\n', '\0'};
    c->at += strcspn(c->at, ends);
}

/// One row: the two chosen cells; the others may hold anything.
static bt_status read_cells(cursor* c, const bt_measured* m, const header* head,
                            const int chosen[2], double number[2], bt_diag* diag) {
    int column = 0;
    for (;; ++column) {
        if (column == head->count) {
            skip_blanks(c);
            if (at_line_end(c)) // a delimiter at the end of the line
                return BT_OK;
            bt_diag_add(diag, BT_ERROR, place(c), "a row has %d numbers, not more%s", head->count,
                        c->delimiter == ',' ? " (the decimal point is \".\")" : "");
            return BT_ERR_INPUT;
        }
        if (column == chosen[0])
            BT_TRY(read_number(c, m->x_name, &number[0], diag));
        if (column == chosen[1] && chosen[1] != chosen[0])
            BT_TRY(read_number(c, m->y_name, &number[1], diag));
        if (column != chosen[0] && column != chosen[1])
            skip_cell(c);
        if (*c->at != c->delimiter)
            break;
        ++c->at;
    }
    if (column >= chosen[0] && column >= chosen[1])
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, place(c), "the row ends before %s",
                column < chosen[1] ? m->y_name : m->x_name);
    return BT_ERR_INPUT;
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

static bt_status read_rows(cursor* c, bt_measured* m, const header* head, const int chosen[2],
                           bt_diag* diag) {
    int room = 0;
    while (next_line(c, false)) {
        double number[2] = {0, 0};
        const bt_where start = place(c);
        if (m->count == BT_MEASURED_ROWS_MAX) {
            bt_diag_add(diag, BT_ERROR, start, "more than %d rows", BT_MEASURED_ROWS_MAX);
            return BT_ERR_INPUT;
        }
        BT_TRY(make_room(m, &room));
        BT_TRY(read_cells(c, m, head, chosen, number, diag));
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
    header head = {0};
    int chosen[2];
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3; // the byte order mark that spreadsheets write
    cursor c = {text, text, {m->file, 1, 1}, ','};
    if (!next_line(&c, true)) {
        bt_diag_add(diag, BT_ERROR, c.where, "the file is empty");
        return BT_ERR_INPUT;
    }
    BT_TRY(read_header(&c, &head, diag));
    BT_TRY(choose(&head, columns, m->file, chosen, diag));
    take_column(&head.columns[chosen[0]], columns ? columns->x_name : NULL, m->x_name, m->x_unit,
                &m->x_place);
    take_column(&head.columns[chosen[1]], columns ? columns->y_name : NULL, m->y_name, m->y_unit,
                &m->y_place);
    return read_rows(&c, m, &head, chosen, diag);
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
