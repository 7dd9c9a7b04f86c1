#define _GNU_SOURCE /* vasprintf */
#include "report/table.h"

#include "base/text.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

typedef enum cell_kind {
    CELL_EMPTY,
    CELL_TEXT,
    CELL_NUMBER,
    CELL_COUNT,
    CELL_FLAG,
    CELL_INTERVAL
} cell_kind;

typedef struct cell {
    cell_kind kind;
    double value;
    int64_t count;
    bt_interval limits;
    char* text; ///< owned: a text, or what people read in the place of a number
} cell;

struct bt_report_table {
    const char* title;
    const bt_column* columns;
    int column_count;
    cell* cells; ///< [rows * column_count], row by row
    size_t used, room;
    char** remarks;
    int remark_count;
    bool broken; ///< memory ran out on the way
};

bt_report_table* bt_report_table_create(const char* title, const bt_column* columns, int count) {
    bt_report_table* table = calloc(1, sizeof *table);
    if (table)
        *table = (bt_report_table){.title = title, .columns = columns, .column_count = count};
    return table;
}

void bt_report_table_destroy(bt_report_table* table) {
    if (!table)
        return;
    for (size_t i = 0; i < table->used; ++i)
        free(table->cells[i].text);
    for (int i = 0; i < table->remark_count; ++i)
        free(table->remarks[i]);
    free(table->cells);
    free(table->remarks);
    free(table);
}

// --- filling ----------------------------------------------------------------------------------

static void add(bt_report_table* table, const cell* added, const char* text) {
    if (!table || table->broken)
        return;
    if (table->used == table->room) {
        const size_t room = table->room ? 2 * table->room : 64;
        cell* larger = realloc(table->cells, room * sizeof *larger);
        table->broken = !larger;
        if (!larger)
            return;
        table->cells = larger;
        table->room = room;
    }
    cell* at = &table->cells[table->used++];
    *at = *added;
    at->text = text ? strdup(text) : NULL;
    table->broken = text && !at->text;
}

void bt_report_table_row(bt_report_table* table) {
    while (table && !table->broken && table->used % (size_t)table->column_count != 0)
        bt_report_table_empty(table); // what the row before was not given
}

void bt_report_table_empty(bt_report_table* table) {
    add(table, &(cell){.kind = CELL_EMPTY}, NULL);
}

void bt_report_table_text(bt_report_table* table, const char* text) {
    add(table, &(cell){.kind = text ? CELL_TEXT : CELL_EMPTY}, text);
}

void bt_report_table_number(bt_report_table* table, double value) {
    add(table, &(cell){.kind = isfinite(value) ? CELL_NUMBER : CELL_EMPTY, .value = value}, NULL);
}

void bt_report_table_count(bt_report_table* table, int64_t value) {
    add(table, &(cell){.kind = CELL_COUNT, .count = value}, NULL);
}

void bt_report_table_flag(bt_report_table* table, bool value) {
    add(table, &(cell){.kind = CELL_FLAG, .count = value}, NULL);
}

void bt_report_table_interval(bt_report_table* table, double value, const bt_interval* limits) {
    const bool known = isfinite(value);
    add(table, &(cell){known ? CELL_INTERVAL : CELL_EMPTY, value, 0, *limits, NULL}, NULL);
}

void bt_report_table_said(bt_report_table* table, double value, const char* text) {
    add(table, &(cell){.kind = isfinite(value) ? CELL_NUMBER : CELL_EMPTY, .value = value}, text);
}

void bt_report_table_flag_said(bt_report_table* table, bool value, const char* text) {
    add(table, &(cell){.kind = CELL_FLAG, .count = value}, text);
}

void bt_report_table_remark(bt_report_table* table, const char* format, ...) {
    if (!table || table->broken)
        return;
    char** larger = realloc(table->remarks, (size_t)(table->remark_count + 1) * sizeof *larger);
    table->broken = !larger;
    if (!larger)
        return;
    table->remarks = larger;
    va_list args;
    va_start(args, format);
    table->broken = vasprintf(&larger[table->remark_count], format, args) < 0;
    va_end(args);
    table->remark_count += !table->broken;
}

static bool complete(const bt_report_table* table) {
    return table && !table->broken && table->used % (size_t)table->column_count == 0;
}

static size_t row_count(const bt_report_table* table) {
    return table->used / (size_t)table->column_count;
}

static const cell* cell_at(const bt_report_table* table, size_t row, int column) {
    return &table->cells[row * (size_t)table->column_count + (size_t)column];
}

// --- for people -------------------------------------------------------------------------------

const char* bt_count_text(int64_t count, char text[32]) {
    char digits[24];
    const int length = snprintf(digits, sizeof digits, "%lld", (long long)count);
    int used = 0;
    for (int i = 0; i < length; ++i) {
        if (i > 0 && digits[i - 1] != '-' && (length - i) % 3 == 0)
            text[used++] = ',';
        text[used++] = digits[i];
    }
    text[used] = '\0';
    return text;
}

/// Decimals at which a positive number shows two significant digits; 0 for none.
static int two_digits(double size) {
    if (!(size > 0))
        return 0;
    const int decimals = 1 - (int)floor(log10(size));
    return decimals < 0 ? 0 : decimals;
}

int bt_interval_decimals(double value, const bt_interval* limits, int least) {
    const double below = value - limits->least, above = limits->greatest - value;
    const double part = below > 0 && (above <= 0 || below < above) ? below : above;
    int decimals = two_digits(part);
    if (decimals < least)
        decimals = least;
    return decimals > 9 ? 9 : decimals;
}

static double scale_of(const bt_column* column) {
    return column->scale == 0 ? 1 : column->scale;
}

static char* interval_text(const bt_column* column, const cell* c, char* text, size_t size) {
    const double scale = scale_of(column);
    const bt_interval limits = {scale * c->limits.least, scale * c->limits.greatest};
    const int n = bt_interval_decimals(scale * c->value, &limits, column->decimals);
    snprintf(text, size, "%.*f [%.*f, %.*f]", n, scale * c->value, n, limits.least, n,
             limits.greatest);
    return text;
}

/// What people read in a cell.
static const char* shown(const bt_column* column, const cell* c, char* text, size_t size) {
    if (c->text)
        return c->text;
    switch (c->kind) {
    case CELL_NUMBER:
        snprintf(text, size, "%.*f", column->decimals, scale_of(column) * c->value);
        return text;
    case CELL_COUNT:
        return bt_count_text(c->count, text);
    case CELL_FLAG:
        return c->count ? "yes" : "no";
    case CELL_INTERVAL:
        return interval_text(column, c, text, size);
    default:
        return "-";
    }
}

static const char* head_of(const bt_column* column, char* text, size_t size) {
    snprintf(text, size, "%s%s%s", column->head, *column->unit ? ", " : "", column->unit);
    return text;
}

/// Characters, not bytes, of a text in UTF-8.
static int width_of(const char* text) {
    int width = 0;
    for (; *text; ++text)
        width += ((unsigned char)*text & 0xc0) != 0x80;
    return width;
}

static bool is_text(const bt_report_table* table, int column) {
    return table->used > 0 && cell_at(table, 0, column)->kind == CELL_TEXT;
}

/// Characters of the widest cell; only for a column that is shown.
static int column_width(const bt_report_table* table, int column) {
    char text[160];
    int width = width_of(head_of(&table->columns[column], text, sizeof text));
    for (size_t row = 0; row < row_count(table); ++row) {
        const int w = width_of(
            shown(&table->columns[column], cell_at(table, row, column), text, sizeof text));
        width = w > width ? w : width;
    }
    return width;
}

static void put_padded(FILE* out, const char* text, int width, bool left, bool last) {
    const int blanks = width - width_of(text);
    fprintf(out, "%*s%s%*s", left ? 0 : blanks, "", text, left && !last ? blanks : 0, "");
    fputs(last ? "\n" : "  ", out);
}

static void put_remarks(const bt_report_table* table, FILE* out) {
    for (int i = 0; i < table->remark_count; ++i)
        fprintf(out, "%s\n", table->remarks[i]);
}

static int last_shown(const bt_report_table* table) {
    int last = table->column_count - 1;
    while (last > 0 && !table->columns[last].head)
        --last;
    return last;
}

/// One line for people: the heads, or a row.
static void put_line(const bt_report_table* table, FILE* out, const size_t* row) {
    char text[160];
    const int last = last_shown(table);
    for (int c = 0; c <= last; ++c) {
        const bt_column* column = &table->columns[c];
        if (column->head)
            put_padded(out,
                       row ? shown(column, cell_at(table, *row, c), text, sizeof text)
                           : head_of(column, text, sizeof text),
                       column_width(table, c), is_text(table, c), c == last);
    }
}

bt_status bt_report_table_print(const bt_report_table* table, FILE* out) {
    if (!complete(table))
        return BT_ERR_MEMORY;
    if (table->title)
        fprintf(out, "%s\n", table->title);
    put_line(table, out, NULL);
    for (size_t row = 0; row < row_count(table); ++row)
        put_line(table, out, &row);
    put_remarks(table, out);
    return BT_OK;
}

/// One line of a Markdown table: the heads, or a row.
static void put_markdown(const bt_report_table* table, FILE* out, const size_t* row) {
    char text[160];
    for (int c = 0; c < table->column_count; ++c) {
        const bt_column* column = &table->columns[c];
        if (column->head)
            fprintf(out, "| %s ",
                    row ? shown(column, cell_at(table, *row, c), text, sizeof text)
                        : head_of(column, text, sizeof text));
    }
    fputs("|\n", out);
}

bt_status bt_report_table_markdown(const bt_report_table* table, FILE* out) {
    if (!complete(table))
        return BT_ERR_MEMORY;
    if (table->title)
        fprintf(out, "%s\n\n", table->title);
    put_markdown(table, out, NULL);
    for (int c = 0; c < table->column_count; ++c)
        fputs(table->columns[c].head ? "| --- " : "", out);
    fputs("|\n", out);
    for (size_t row = 0; row < row_count(table); ++row)
        put_markdown(table, out, &row);
    fputs(table->remark_count > 0 ? "\n" : "", out);
    put_remarks(table, out);
    return BT_OK;
}

// --- for programs -----------------------------------------------------------------------------

/// A text in CSV: in quotes where it has to be (RFC 4180).
static void put_quoted(FILE* out, const char* text) {
    const bool quotes = strpbrk(text, ",\"\r\n") != NULL;
    if (quotes)
        fputc('"', out);
    for (; *text; ++text) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    if (quotes)
        fputc('"', out);
}

static void put_number(FILE* out, double value) {
    char text[40];
    bt_text_print_number(value, text, sizeof text);
    fputs(isfinite(value) ? text : "", out);
}

static void put_csv_cell(FILE* out, const bt_column* column, const cell* c) {
    if (c->kind == CELL_TEXT)
        put_quoted(out, c->text);
    if (c->kind == CELL_COUNT)
        fprintf(out, "%lld", (long long)c->count);
    if (c->kind == CELL_FLAG)
        fputs(c->count ? "true" : "false", out);
    if (c->kind == CELL_NUMBER || c->kind == CELL_INTERVAL)
        put_number(out, c->value);
    if (!column->interval)
        return;
    fputc(',', out);
    if (c->kind == CELL_INTERVAL)
        put_number(out, c->limits.least);
    fputc(',', out);
    if (c->kind == CELL_INTERVAL)
        put_number(out, c->limits.greatest);
}

bt_status bt_report_table_csv(const bt_report_table* table, FILE* out) {
    if (!complete(table))
        return BT_ERR_MEMORY;
    for (int c = 0; c < table->column_count; ++c) {
        const char* name = table->columns[c].name;
        fprintf(out, "%s%s", c ? "," : "", name);
        if (table->columns[c].interval)
            fprintf(out, ",%s_least,%s_greatest", name, name);
    }
    fputc('\n', out);
    for (size_t row = 0; row < row_count(table); ++row) {
        for (int c = 0; c < table->column_count; ++c) {
            fputs(c ? "," : "", out);
            put_csv_cell(out, &table->columns[c], cell_at(table, row, c));
        }
        fputc('\n', out);
    }
    return BT_OK;
}

static void write_limits(bt_json* json, const char* name, const cell* c) {
    char key[96];
    snprintf(key, sizeof key, "%s_ci95", name);
    const bool known = c->kind == CELL_INTERVAL;
    bt_json_begin_array(json, key);
    bt_json_number(json, NULL, known ? c->limits.least : NAN);
    bt_json_number(json, NULL, known ? c->limits.greatest : NAN);
    bt_json_end_array(json);
}

static void write_cell(bt_json* json, const bt_column* column, const cell* c) {
    switch (c->kind) {
    case CELL_TEXT:
        bt_json_string(json, column->name, c->text);
        break;
    case CELL_COUNT:
        bt_json_integer(json, column->name, c->count);
        break;
    case CELL_FLAG:
        bt_json_bool(json, column->name, c->count != 0);
        break;
    default:
        bt_json_number(json, column->name, c->kind == CELL_EMPTY ? NAN : c->value);
        break;
    }
    if (column->interval)
        write_limits(json, column->name, c);
}

bt_status bt_report_table_json(const bt_report_table* table, bt_json* json, const char* key) {
    if (!complete(table))
        return BT_ERR_MEMORY;
    bt_json_begin_array(json, key);
    for (size_t row = 0; row < row_count(table); ++row) {
        bt_json_begin_object(json, NULL);
        for (int c = 0; c < table->column_count; ++c)
            write_cell(json, &table->columns[c], cell_at(table, row, c));
        bt_json_end_object(json);
    }
    bt_json_end_array(json);
    return BT_OK;
}
