#include "study/study.h"

#include "base/text.h"
#include "base/units.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 6, CELL = 96, PATH_SIZE = 256, LINE = 1024 };

/// The chapters that are field tables, and what else they hold.
typedef struct chapter {
    const char* name;
    const bt_group* group;
    const char* also; ///< rows for keys that no table has
} chapter;

static const chapter chapters[] = {
    {"aircraft", &bt_aircraft_group, NULL},
    {"deck", &bt_deck_group, NULL},
    {"landing", &bt_landing_group, NULL},
    {"campaign", &bt_campaign_group,
     "Further keys: `bounds` maps paths of the model to ranges, the axes of the design\n"
     "(`landing.sink_speed: [0.9 m/s, 6.3 m/s]`); `levels` maps paths to the number of points\n"
     "along an axis of the design full_factorial (`landing.pitch: 9`).\n"},
    {"surrogate", &bt_surrogate_group, NULL},
    {"reliability", &bt_reliability_group,
     "Further key: `conditions` maps paths of `uncertainty` to the means that are gone through\n"
     "one by one (`landing.pitch: [1 deg, 2 deg]`).\n"},
    {"rigs", &bt_rigs_group,
     "Further key: `curve` in a rig's `reference` names CSV files of measured curves, relative to\n"
     "the file that names them (`curve: stroke.csv`, `curve: [stroke.csv, load.csv]`); their "
     "first\n"
     "line names two columns of the rig's history and their units (`time [ms], stroke [mm]`).\n"},
};
enum { CHAPTERS = sizeof chapters / sizeof chapters[0] };

typedef struct writer {
    bt_text_sink* write;
    void* user;
} writer;

static void put(const writer* w, const char* format, ...) __attribute__((format(printf, 2, 3)));

static void put(const writer* w, const char* format, ...) {
    char text[LINE];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    w->write(w->user, text);
}

// --- one row --------------------------------------------------------------------------------

/// "m, m^2" for a table.
static void print_units(const bt_field* field, char* text, size_t size) {
    const char* middle = strstr(field->unit, "__");
    if (!middle) {
        const char* unit = bt_unit_text(field->unit);
        snprintf(text, size, "%s", unit ? unit : "");
        return;
    }
    char x[32];
    snprintf(x, sizeof x, "%.*s", (int)(middle - field->unit), field->unit);
    snprintf(text, size, "%s, %s", bt_unit_text(x), bt_unit_text(middle + 2));
}

/// The fallback as it would be typed; "[]" for lists and tables.
static void print_fallback(const bt_field* field, char* text, size_t size) {
    switch (field->kind) {
    case BT_FIELD_REAL:
        bt_unit_print(field->fallback, field->unit, text, size);
        break;
    case BT_FIELD_PLAIN:
    case BT_FIELD_COUNT:
        bt_text_print_number(field->fallback, text, size);
        break;
    case BT_FIELD_FLAG:
        snprintf(text, size, "%s", field->fallback != 0 ? "true" : "false");
        break;
    case BT_FIELD_CHOICE:
        snprintf(text, size, "%s", field->choices[(int)field->fallback]);
        break;
    case BT_FIELD_LIST:
    case BT_FIELD_TABLE:
        snprintf(text, size, "[]");
        break;
    case BT_FIELD_GROUP:
    case BT_FIELD_VARIANT:
        *text = '\0';
        break;
    }
}

/// The tables below a field: one of a group, all of a variant, none of a leaf.
static const bt_group* table_below(const bt_field* field, int index) {
    if (field->kind == BT_FIELD_VARIANT)
        return index < field->variant->count ? field->variant->groups[index] : NULL;
    return field->kind == BT_FIELD_GROUP && index == 0 ? field->group : NULL;
}

/// The range of a number, the names of a choice.
static void print_range(const bt_field* field, char* text, size_t size) {
    *text = '\0';
    if (field->kind == BT_FIELD_CHOICE)
        for (int i = 0; field->choices[i]; ++i)
            bt_text_append(text, size, "%s%s", i ? ", " : "", field->choices[i]);
    if (field->kind == BT_FIELD_VARIANT)
        for (int i = 0; i < field->variant->count; ++i)
            bt_text_append(text, size, "%s%s",
                           i ? ", " : "type: ", field->variant->type.choices[i]);
    if (field->kind == BT_FIELD_FLAG)
        snprintf(text, size, "true, false");
    const bool number = field->kind <= BT_FIELD_COUNT || field->kind == BT_FIELD_LIST;
    if (!number || !(field->least < field->greatest))
        return;
    char least[40], greatest[40];
    bt_text_print_number(field->least, least, sizeof least);
    bt_text_print_number(field->greatest, greatest, sizeof greatest);
    snprintf(text, size, "%s .. %s", least, greatest);
}

static void fill_row(const bt_field* field, char cells[COLUMNS][CELL]) {
    snprintf(cells[0], CELL, "%s", field->name);
    print_units(field, cells[1], CELL);
    print_fallback(field, cells[2], CELL);
    if (field->need == BT_REQUIRED || table_below(field, 0))
        snprintf(cells[2], CELL, "%s", field->need == BT_REQUIRED ? "required" : "optional");
    print_range(field, cells[3], CELL);
    snprintf(cells[4], CELL, "%s", field->equation);
    *cells[5] = '\0';
}

// --- tables ---------------------------------------------------------------------------------

/// A pipe in a cell would end it.
static void put_cell(const writer* w, const char* text, int width) {
    char cell[LINE];
    size_t n = 0;
    for (; *text && n + 2 < sizeof cell; ++text) {
        if (*text == '|')
            cell[n++] = '\\';
        cell[n++] = *text;
    }
    cell[n] = '\0';
    put(w, "| %-*s ", width, cell);
}

/// A row of a group, or before all of them the key `type` of the variant it belongs to.
static const bt_field* row(const bt_group* group, const bt_field* type, int index) {
    if (type)
        return index == 0 ? type : &group->fields[index - 1];
    return &group->fields[index];
}

static void put_group(const writer* w, const bt_group* group, const bt_field* type) {
    static const char* const heads[COLUMNS] = {"key",   "unit",  "default",
                                               "range", "paper", "meaning"};
    const int rows = group->field_count + (type != NULL);
    int width[COLUMNS];
    char cells[COLUMNS][CELL];
    for (int c = 0; c < COLUMNS; ++c)
        width[c] = (int)strlen(heads[c]);
    for (int i = 0; i < rows; ++i) {
        fill_row(row(group, type, i), cells);
        for (int c = 0; c < COLUMNS - 1; ++c)
            if ((int)strlen(cells[c]) > width[c])
                width[c] = (int)strlen(cells[c]);
    }
    for (int c = 0; c < COLUMNS; ++c)
        put(w, "| %-*s ", width[c], heads[c]);
    put(w, "|\n");
    for (int c = 0; c < COLUMNS; ++c)
        put(w, "|%.*s", width[c] + 2,
            "----------------------------------------------------------------------------------"
            "------------------");
    put(w, "|\n");
    for (int i = 0; i < rows; ++i) {
        fill_row(row(group, type, i), cells);
        for (int c = 0; c < COLUMNS - 1; ++c)
            put_cell(w, cells[c], width[c]);
        put_cell(w, row(group, type, i)->text, 0);
        put(w, "|\n");
    }
}

/// Appends every path at which a group stands: a gear stands at two.
static void append_paths(const bt_group* in, const char* path, const bt_group* wanted, char* text,
                         size_t size) {
    if (in == wanted)
        bt_text_append(text, size, "%s%s", *text ? ", " : "", path);
    for (int i = 0; i < in->field_count; ++i) {
        const bt_field* field = &in->fields[i];
        const bt_group* table;
        for (int k = 0; (table = table_below(field, k)) != NULL; ++k) {
            char below[PATH_SIZE];
            snprintf(below, sizeof below, "%s.%s", path, field->name);
            if (field->kind == BT_FIELD_VARIANT)
                bt_text_append(below, sizeof below, " (type: %s%s)",
                               field->variant->type.choices[k], k == 0 ? ", the default" : "");
            append_paths(table, below, wanted, text, size);
        }
    }
}

typedef struct seen {
    const bt_group* groups[64];
    int count;
} seen;

static bool see(seen* s, const bt_group* group) {
    for (int i = 0; i < s->count; ++i)
        if (s->groups[i] == group)
            return false;
    if (s->count == (int)(sizeof s->groups / sizeof s->groups[0]))
        return false;
    s->groups[s->count++] = group;
    return true;
}

static void put_sections(const writer* w, const chapter* top, const bt_group* group,
                         const bt_field* type, seen* s) {
    if (!see(s, group))
        return;
    char paths[512] = "";
    append_paths(top->group, top->name, group, paths, sizeof paths);
    put(w, "\n## %s\n\n%s.\n\n", paths, group->text);
    put_group(w, group, type);
    if (group == top->group && top->also)
        put(w, "\n%s", top->also);
    for (int i = 0; i < group->field_count; ++i) {
        const bt_field* field = &group->fields[i];
        const bt_field* inner = field->kind == BT_FIELD_VARIANT ? &field->variant->type : NULL;
        const bt_group* table;
        for (int k = 0; (table = table_below(field, k)) != NULL; ++k)
            put_sections(w, top, table, inner, s);
    }
}

static void put_distributions(const writer* w) {
    put(w, "\n## uncertainty\n\n"
           "Maps paths of the model to distributions, as in\n"
           "`landing.pitch: {distribution: normal, mean: 3 deg, sd: 1.3 deg}`. A mean that is "
           "left out is the\nkey's own value; a location `lower` that is left out is 0. What each "
           "means, what `correlation:\n[[path, path, rank correlation]]` does, and how values "
           "come\nfrom a file: docs/howto-inputs.md.\n\n"
           "| distribution     | parameters |\n|------------------|------------|\n");
    for (int k = 0; k < BT_DISTRIBUTION_KINDS; ++k) {
        put(w, "| %-16s |", bt_distribution_names[k]);
        const char* const* names = bt_distribution_parameters((bt_distribution_kind)k);
        for (int i = 0; names[i]; ++i)
            put(w, "%s %s", i ? "," : "", names[i]);
        put(w, " |\n");
    }
}

void bt_study_keys(bt_text_sink* write, void* user) {
    const writer w = {write, user};
    put(&w, "# Keys of a study\n\n"
            "Made by `bolter keys` from the tables that the reader itself uses. Every value with a "
            "unit is typed\nwith one, any of the same dimension (`6.5 MPa`, `52 deg`, `90 kn`); "
            "ranges are in the unit shown.\n`title` is a text; `aircraft` and `deck` may name "
            "another file, relative to the study.\n");
    seen s = {.count = 0};
    for (int i = 0; i < CHAPTERS; ++i) {
        put_sections(&w, &chapters[i], chapters[i].group, NULL, &s);
        if (strcmp(chapters[i].name, "landing") == 0)
            put_distributions(&w);
    }
}

// --- one by one -----------------------------------------------------------------------------

typedef struct finder {
    const char *chapter, *part;
    bt_key_text_visit* visit;
    void* user;
    int count;
} finder;

static bool is_within(const char* path, const char* part) {
    const size_t length = part ? strlen(part) : 0;
    return strncmp(path, part ? part : "", length) == 0 &&
           (length == 0 || path[length] == '.' || path[length] == '\0');
}

static bool visit_field(void* user, const bt_field* field, const char* path, size_t offset) {
    finder* f = user;
    char whole[PATH_SIZE], cells[COLUMNS][CELL];
    (void)offset;
    snprintf(whole, sizeof whole, "%s.%s", f->chapter, path);
    if (field->kind == BT_FIELD_GROUP || !is_within(whole, f->part))
        return true;
    fill_row(field, cells);
    const bt_key_text key = {whole, cells[1], cells[2], cells[3], cells[4], field->text};
    f->visit(f->user, &key);
    ++f->count;
    return true;
}

int bt_study_each_key(const char* part, bt_key_text_visit* visit, void* user) {
    finder f = {.part = part, .visit = visit, .user = user};
    for (int i = 0; i < CHAPTERS; ++i) {
        f.chapter = chapters[i].name;
        bt_group_walk(chapters[i].group, visit_field, &f);
    }
    return f.count;
}

// --- defaults -------------------------------------------------------------------------------

/// Keys of which one must be given though each alone is optional: a value to start from.
static const struct {
    const bt_group* group;
    const char *key, *value;
} starts[] = {{&bt_oleo_group, "orifice_area", "300 mm^2"}};

static const char* start_value(const bt_group* group, const char* key, const char* fallback) {
    for (size_t i = 0; i < sizeof starts / sizeof starts[0]; ++i)
        if (starts[i].group == group && strcmp(starts[i].key, key) == 0)
            return starts[i].value;
    return fallback;
}

/// The key that chooses the type of a variant; the keys of its default type follow.
static void put_type(const writer* w, const bt_field* type, int depth) {
    char names[CELL];
    print_range(type, names, sizeof names);
    put(w, "%*s# %s; %s\n%*stype: %s\n", 2 * depth, "", type->text, names, 2 * depth, "",
        type->choices[0]);
}

static void put_defaults(const writer* w, const bt_group* group, int depth) {
    for (int i = 0; i < group->field_count; ++i) {
        const bt_field* field = &group->fields[i];
        char range[CELL], fallback[CELL];
        print_range(field, range, sizeof range);
        print_fallback(field, fallback, sizeof fallback);
        put(w, "%*s# %s%s%s%s%s%s%s\n", 2 * depth, "", field->text, *field->equation ? " (" : "",
            field->equation, *field->equation ? ")" : "", *range ? "; " : "", range,
            field->need == BT_REQUIRED ? "; required" : "");
        const char* value = start_value(group, field->name, fallback);
        put(w, "%*s%s:%s%s\n", 2 * depth, "", field->name, *value ? " " : "", value);
        if (field->kind == BT_FIELD_VARIANT)
            put_type(w, &field->variant->type, depth + 1);
        if (table_below(field, 0))
            put_defaults(w, table_below(field, 0), depth + 1);
    }
}

/// What has no default, as an example to be changed: without it there is nothing to run.
static const struct {
    const char *after, *text; ///< the chapter that it follows, or that it ends
} examples[] = {
    {"landing",
     "\n# which keys scatter, and how; an example: any numeric key of aircraft, deck and landing\n"
     "uncertainty:\n"
     "  landing.sink_speed: {distribution: normal, sd: 0.9 m/s}\n"
     "  landing.distance: {distribution: normal, sd: 1 m}\n"},
    {"campaign", "  # axes of the design and their ranges; an example\n"
                 "  bounds:\n"
                 "    landing.sink_speed: [0.9 m/s, 6.3 m/s]\n"
                 "    landing.distance: [0.5 m, 12.5 m]\n"},
    {"reliability", "  # means to go through one by one, each a condition; an example\n"
                    "  conditions:\n"
                    "    landing.distance: [4 m, 6 m, 8 m]\n"},
};

void bt_study_defaults(bt_text_sink* write, void* user) {
    const writer w = {write, user};
    put(&w, "# A complete study: every key with its default, or where it is required, a value to\n"
            "# start from. Ranges are in SI, angles in rad.\n\n"
            "title: Every key\n");
    for (int i = 0; i < CHAPTERS; ++i) {
        put(&w, "\n# %s\n%s:\n", chapters[i].group->text, chapters[i].name);
        put_defaults(&w, chapters[i].group, 1);
        for (size_t k = 0; k < sizeof examples / sizeof examples[0]; ++k)
            if (strcmp(chapters[i].name, examples[k].after) == 0)
                put(&w, "%s", examples[k].text);
    }
}
