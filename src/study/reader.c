#include "study/reader.h"

#include "base/text.h"
#include "base/units.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 256, SHOWN = 60 };

static void collect(void* user, bt_severity severity, bt_where where, const char* text) {
    bt_reader* reader = user;
    reader->errors += severity == BT_ERROR;
    if (reader->message_count == BT_MESSAGES_SHOWN_MAX) {
        reader->dropped += severity == BT_ERROR;
        return;
    }
    bt_reader_message* message = &reader->messages[reader->message_count++];
    message->severity = severity;
    message->where = where;
    snprintf(message->text, sizeof message->text, "%s", text);
    for (char* c = message->text; *c; ++c)
        if ((unsigned char)*c < ' ')
            *c = '?';
}

void bt_reader_error(bt_reader* reader, bt_where where, const char* format, ...) {
    char text[BT_MESSAGE_SIZE];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    collect(reader, BT_ERROR, where, text);
}

bt_diag bt_reader_diag(bt_reader* reader) {
    return (bt_diag){.sink = collect, .user = reader};
}

/// The number of the first message about the same file.
static int file_rank(const bt_reader* reader, const bt_reader_message* message) {
    const char* file = message->where.file ? message->where.file : "";
    for (int i = 0; i < reader->message_count; ++i) {
        const char* other = reader->messages[i].where.file;
        if (strcmp(other ? other : "", file) == 0)
            return i;
    }
    return 0;
}

static bool comes_before(const bt_reader* reader, const bt_reader_message* a,
                         const bt_reader_message* b) {
    const int rank_a = file_rank(reader, a), rank_b = file_rank(reader, b);
    if (rank_a != rank_b)
        return rank_a < rank_b;
    if (a->where.line != b->where.line)
        return a->where.line < b->where.line;
    return a->where.column < b->where.column;
}

void bt_reader_flush(bt_reader* reader, bt_diag* diag) {
    const bt_reader_message* order[BT_MESSAGES_SHOWN_MAX];
    for (int i = 0; i < reader->message_count; ++i) { // insertion keeps equals in their order
        int k = i;
        for (; k > 0 && comes_before(reader, &reader->messages[i], order[k - 1]); --k)
            order[k] = order[k - 1];
        order[k] = &reader->messages[i];
    }
    for (int i = 0; i < reader->message_count; ++i)
        bt_diag_add(diag, order[i]->severity, order[i]->where, "%s", order[i]->text);
    if (diag && reader->dropped > 0) {
        diag->errors += reader->dropped;
        bt_diag_add(diag, BT_NOTE, BT_NOWHERE, "%d more error%s not shown", reader->dropped,
                    reader->dropped == 1 ? " is" : "s are");
    }
    reader->message_count = reader->dropped = 0;
}

void bt_reader_join(char* joined, size_t size, const char* path, const char* name) {
    snprintf(joined, size, "%s%s%s", path, *path && *name ? "." : "", name);
}

// --- names ----------------------------------------------------------------------------------

static const char* kind_name(const bt_node* node) {
    return node->kind == BT_NODE_MAPPING    ? "a mapping"
           : node->kind == BT_NODE_SEQUENCE ? "a sequence"
           : *node->text                    ? "a value"
                                            : "nothing";
}

/// Reports a node of another kind than the wanted one; `example` says what would be right.
static bool is_kind(bt_reader* reader, const bt_node* node, bt_node_kind kind, const char* path,
                    const char* wanted, const char* example) {
    if (node->refused)
        return false;
    if (node->kind == kind)
        return true;
    bt_reader_error(reader, node->where, "%s: %s is wanted here, not %s%s%s", path, wanted,
                    kind_name(node), *example ? ", as in " : "", example);
    return false;
}

bool bt_reader_is_mapping(bt_reader* reader, const bt_node* node, const char* path) {
    if (!is_kind(reader, node, BT_NODE_MAPPING, *path ? path : "study", "a mapping of keys", ""))
        return false;
    for (const bt_node* child = node->first; child; child = child->next) {
        const bt_node* before = bt_node_child(node, child->key->text);
        char place[PATH_SIZE];
        bt_reader_join(place, sizeof place, path, child->key->text);
        if (before != child)
            bt_reader_error(reader, child->key->where, "%s: given twice; first in line %d", place,
                            before->key->where.line);
    }
    return true;
}

static bool is_among(const char* const* names, const char* name) {
    for (; names && *names; ++names)
        if (strcmp(*names, name) == 0)
            return true;
    return false;
}

static void look_among(bt_text_nearest* nearest, const char* const* names) {
    for (; names && *names; ++names)
        bt_text_look(nearest, *names);
}

static void append_names(char* list, size_t size, const char* const* names) {
    for (; names && *names; ++names)
        bt_text_append(list, size, "%s%s", *list ? ", " : "", *names);
}

/// "; did you mean ..." or "; known here: ...", whichever helps.
static void explain_unknown(const char* typed, const char* const* names, const char* const* more,
                            char* text, size_t size) {
    bt_text_nearest nearest = bt_text_search(typed);
    look_among(&nearest, names);
    look_among(&nearest, more);
    if (*bt_text_suggest(&nearest, text, size))
        return;
    char list[512] = "";
    append_names(list, sizeof list, names);
    append_names(list, sizeof list, more);
    snprintf(text, size, *list ? "; known here: %s" : "; there are none here", list);
}

void bt_reader_known_keys(bt_reader* reader, const bt_node* node, const char* path,
                          const char* const* names, const char* const* more) {
    for (const bt_node* child = node->first; child; child = child->next) {
        const char* key = child->key->text;
        if (child->refused || is_among(names, key) || is_among(more, key))
            continue;
        char place[PATH_SIZE], help[640];
        bt_reader_join(place, sizeof place, path, key);
        explain_unknown(key, names, more, help, sizeof help);
        bt_reader_error(reader, child->key->where, "%s: unknown key%s", place, help);
    }
}

// --- values ---------------------------------------------------------------------------------

static void report_range(bt_reader* reader, const bt_field* field, const bt_node* node,
                         const char* path) {
    char least[64], greatest[64];
    const char* unit = "";
    if (field->kind == BT_FIELD_COUNT || field->kind == BT_FIELD_PLAIN) {
        bt_text_print_number(field->least, least, sizeof least);
        bt_text_print_number(field->greatest, greatest, sizeof greatest);
    } else {
        bt_unit_print_as(field->least, node->text, least, sizeof least, &unit);
        bt_unit_print_as(field->greatest, node->text, greatest, sizeof greatest, &unit);
        unit = *unit ? unit : bt_unit_text(field->unit); // psig and the like have no scale alone
    }
    bt_reader_error(reader, node->where, "%s: %.*s is outside %s .. %s%s%s", path, SHOWN,
                    node->text, least, greatest, *unit ? " " : "", unit);
}

/// Text to SI by a unit token, without a range.
static bool read_unit(bt_reader* reader, const char* token, const bt_node* node, const char* path,
                      double* value) {
    if (!is_kind(reader, node, BT_NODE_SCALAR, path, "a value", ""))
        return false;
    char why[256];
    if (bt_unit_parse(node->text, token, value, why, sizeof why) == BT_OK)
        return true;
    bt_reader_error(reader, node->where, "%s: %s", path, why);
    return false;
}

static bool read_whole(bt_reader* reader, const bt_node* node, const char* path, double* value) {
    if (!is_kind(reader, node, BT_NODE_SCALAR, path, "a whole number", ""))
        return false;
    double number;
    if (bt_number_parse(node->text, &number) == BT_OK && number == floor(number)) {
        *value = number;
        return true;
    }
    bt_reader_error(reader, node->where, "%s: \"%.*s\" is not a whole number; write it as 42000",
                    path, SHOWN, node->text);
    return false;
}

/// The unit token of a field's values. Of a pressure, the field's text says whether it is absolute
/// or gauge; a difference of two (a standard deviation) is neither.
static const char* level_token(const bt_field* field) {
    if (field->kind == BT_FIELD_COUNT || !field->text || strcmp(field->unit, "Pa") != 0)
        return field->unit;
    return strstr(field->text, "absolute") ? "Pa_absolute"
           : strstr(field->text, "gauge")  ? "Pa_gauge"
                                           : field->unit;
}

bool bt_reader_number(bt_reader* reader, const bt_field* field, const bt_node* node,
                      const char* path, bool ranged, double* value) {
    double number;
    const char* token = field->kind == BT_FIELD_PLAIN ? "1"
                        : ranged                      ? level_token(field)
                                                      : field->unit;
    const bool read = field->kind == BT_FIELD_COUNT ? read_whole(reader, node, path, &number)
                                                    : read_unit(reader, token, node, path, &number);
    if (!read)
        return false;
    if (ranged && !(number >= field->least && number <= field->greatest)) {
        report_range(reader, field, node, path);
        return false;
    }
    *value = number;
    return true;
}

bool bt_reader_choice(bt_reader* reader, const char* const* names, const bt_node* node,
                      const char* path, int* value) {
    if (!is_kind(reader, node, BT_NODE_SCALAR, path, "a name", ""))
        return false;
    for (int i = 0; names[i]; ++i)
        if (strcmp(names[i], node->text) == 0) {
            *value = i;
            return true;
        }
    char list[512] = "", help[640];
    bt_text_nearest nearest = bt_text_search(node->text);
    append_names(list, sizeof list, names);
    look_among(&nearest, names);
    bt_reader_error(reader, node->where, "%s: \"%.*s\" is none of %s%s", path, SHOWN, node->text,
                    list, bt_text_suggest(&nearest, help, sizeof help));
    return false;
}

static void read_flag(bt_reader* reader, const bt_node* node, const char* path, bool* value) {
    if (!is_kind(reader, node, BT_NODE_SCALAR, path, "true or false", ""))
        return;
    if (strcmp(node->text, "true") == 0 || strcmp(node->text, "false") == 0)
        *value = *node->text == 't';
    else
        bt_reader_error(reader, node->where, "%s: \"%.*s\" is neither true nor false", path, SHOWN,
                        node->text);
}

static bool fits(bt_reader* reader, const bt_node* node, const char* path) {
    if (node->count <= BT_LIST_MAX)
        return true;
    bt_reader_error(reader, node->where, "%s: %d entries; at most %d are possible", path,
                    node->count, (int)BT_LIST_MAX);
    return false;
}

static void read_list(bt_reader* reader, const bt_field* field, const bt_node* node,
                      const char* path, bt_list* list) {
    if (!is_kind(reader, node, BT_NODE_SEQUENCE, path, "a sequence", "[1, 2, 5]") ||
        !fits(reader, node, path))
        return;
    const bool ranged = field->least < field->greatest;
    list->count = 0;
    for (const bt_node* item = node->first; item; item = item->next)
        if (bt_reader_number(reader, field, item, path, ranged, &list->value[list->count]))
            ++list->count;
}

/// "m__m2" to "m" and "m2".
static void split_tokens(const char* both, char* x, char* y, size_t size) {
    const char* middle = strstr(both, "__");
    snprintf(x, size, "%.*s", middle ? (int)(middle - both) : 0, both);
    snprintf(y, size, "%s", middle ? middle + 2 : "");
}

static void read_table(bt_reader* reader, const bt_field* field, const bt_node* node,
                       const char* path, bt_table* table) {
    char x[32], y[32], row[96];
    split_tokens(field->unit, x, y, sizeof x);
    snprintf(row, sizeof row, "[1 %s, 2 %s]", bt_unit_text(x), bt_unit_text(y));
    if (!is_kind(reader, node, BT_NODE_SEQUENCE, path, "a sequence of rows", row) ||
        !fits(reader, node, path))
        return;
    table->count = 0;
    for (const bt_node* item = node->first; item; item = item->next) {
        if (!is_kind(reader, item, BT_NODE_SEQUENCE, path, "a row of two values", row))
            continue;
        if (item->count != 2) {
            bt_reader_error(reader, item->where, "%s: a row has two values, as in %s; this has %d",
                            path, row, item->count);
            continue;
        }
        const bool x_read = read_unit(reader, x, item->first, path, &table->x[table->count]);
        const bool y_read = read_unit(reader, y, item->last, path, &table->y[table->count]);
        table->count += x_read && y_read;
    }
}

// --- groups ---------------------------------------------------------------------------------

static void read_variant(bt_reader* reader, const bt_variant* variant, const bt_node* node,
                         const char* path, bt_variant_head* member);

static void read_field(bt_reader* reader, const bt_field* field, const bt_node* node,
                       const char* path, void* member) {
    double number;
    switch (field->kind) {
    case BT_FIELD_REAL:
    case BT_FIELD_PLAIN:
    case BT_FIELD_COUNT:
        if (bt_reader_number(reader, field, node, path, true, &number))
            bt_field_set(field, member, 0, number);
        break;
    case BT_FIELD_FLAG:
        read_flag(reader, node, path, member);
        break;
    case BT_FIELD_CHOICE:
        bt_reader_choice(reader, field->choices, node, path, member);
        break;
    case BT_FIELD_LIST:
        read_list(reader, field, node, path, member);
        break;
    case BT_FIELD_TABLE:
        read_table(reader, field, node, path, member);
        break;
    case BT_FIELD_GROUP:
        bt_reader_group(reader, field->group, member, path, node, NULL);
        break;
    case BT_FIELD_VARIANT:
        read_variant(reader, field->variant, node, path, member);
        break;
    }
}

static void report_missing(bt_reader* reader, const bt_field* field, bt_where where,
                           const char* path) {
    const char* unit = field->kind == BT_FIELD_REAL ? bt_unit_text(field->unit) : NULL;
    bt_reader_error(reader, where, "%s: missing; wanted: %s%s%s", path, field->text,
                    unit && *unit ? ", in " : "", unit ? unit : "");
}

/// The deepest node that `path` names, seen from `node`; path may go on with ": text".
static const bt_node* find_place(const bt_node* node, const char* path) {
    for (;;) {
        const size_t length = strcspn(path, ".: ");
        const bt_node* next = NULL;
        for (const bt_node* c = node->first; c && length > 0; c = c->next)
            if (c->key && strlen(c->key->text) == length && !memcmp(c->key->text, path, length))
                next = c;
        if (!next)
            return node;
        node = next;
        if (path[length] != '.')
            return node;
        path += length + 1;
    }
}

typedef struct check_context {
    bt_reader* reader;
    const char* path;
    const bt_node* node;
} check_context;

static void place_check_error(void* user, bt_severity severity, bt_where where, const char* text) {
    const check_context* c = user;
    (void)where;
    size_t skip = strlen(c->path);
    const bool below = strncmp(text, c->path, skip) == 0;
    skip += text[skip] == '.';
    const bt_node* place = find_place(c->node, below ? text + skip : "");
    collect(c->reader, severity, place->where, text);
}

void bt_reader_check(bt_reader* reader, const bt_group* group, const void* params, const char* path,
                     const bt_node* node) {
    check_context context = {reader, path, node};
    bt_diag diag = {.sink = place_check_error, .user = &context};
    const int before = reader->errors;
    if (bt_group_check(group, params, path, &diag) != BT_OK && reader->errors == before)
        bt_reader_error(reader, node->where, "%s: not sound", path);
}

/// The group's own check alone: ranges and nested groups are already seen to.
static void check_group(bt_reader* reader, const bt_group* group, const void* params,
                        const char* path, const bt_node* node) {
    check_context context = {reader, path, node};
    bt_diag diag = {.sink = place_check_error, .user = &context};
    if (group->check)
        group->check(params, path, &diag);
}

enum { NAMES_MAX = 128 };

static void list_names(const bt_group* group, const char* names[NAMES_MAX + 1]) {
    int count = 0;
    for (; count < group->field_count && count < NAMES_MAX; ++count)
        names[count] = group->fields[count].name;
    names[count] = NULL;
}

/// Whether some unknown key is best explained as this one misspelt: then it is not missing as well.
static bool is_misspelt(const bt_node* node, const char* name, const char* const* names,
                        const char* const* also) {
    for (const bt_node* child = node->first; child; child = child->next) {
        const char* typed = child->key->text;
        bt_text_nearest nearest = bt_text_search(typed);
        if (is_among(names, typed) || is_among(also, typed))
            continue;
        look_among(&nearest, names);
        look_among(&nearest, also);
        if (bt_text_is_near(&nearest) && strcmp(nearest.name, name) == 0)
            return true;
    }
    return false;
}

void bt_reader_group(bt_reader* reader, const bt_group* group, void* params, const char* path,
                     const bt_node* node, const char* const* also) {
    const int before = reader->errors;
    const char* names[NAMES_MAX + 1];
    if (!bt_reader_is_mapping(reader, node, path))
        return;
    list_names(group, names);
    bt_reader_known_keys(reader, node, path, names, also);
    for (int i = 0; i < group->field_count; ++i) {
        const bt_field* field = &group->fields[i];
        char place[PATH_SIZE];
        bt_reader_join(place, sizeof place, path, field->name);
        const bt_node* child = bt_node_child(node, field->name);
        if (child)
            read_field(reader, field, child, place, (char*)params + field->offset);
        else if (field->need == BT_REQUIRED && !is_misspelt(node, field->name, names, also))
            report_missing(reader, field, node->key ? node->key->where : node->where, place);
    }
    if (reader->errors == before)
        check_group(reader, group, params, path, node);
}

/// Reads `type` and then the keys of that type. Nothing below a type that is none is judged.
static void read_variant(bt_reader* reader, const bt_variant* variant, const bt_node* node,
                         const char* path, bt_variant_head* member) {
    const char* const also[] = {variant->type.name, NULL};
    const bt_node* typed =
        node->kind == BT_NODE_MAPPING ? bt_node_child(node, variant->type.name) : NULL;
    if (typed) {
        char place[PATH_SIZE];
        int type = 0;
        bt_reader_join(place, sizeof place, path, variant->type.name);
        if (!bt_reader_choice(reader, variant->type.choices, typed, place, &type))
            return;
        bt_variant_set(variant, type, member);
    }
    bt_reader_group(reader, bt_variant_group(variant, member), member->params, path, node, also);
}
