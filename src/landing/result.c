#include "landing/result.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char* const bt_leg_names[BT_LEG_COUNT] = {"nose", "left", "right"};

const char* bt_outcome_name(bt_outcome outcome) {
    static const char* const names[] = {"missed", "engaged", "failed"};
    return names[outcome];
}

#define MODE_NAME(NAME, name, text) #name,
#define MODE_TEXT(NAME, name, text) text,

const char* bt_mode_name(bt_mode mode) {
    static const char* const names[] = {BT_MODES(MODE_NAME)};
    return names[mode];
}

const char* bt_mode_text(bt_mode mode) {
    static const char* const texts[] = {BT_MODES(MODE_TEXT)};
    return texts[mode];
}

// --- remarks --------------------------------------------------------------------------------

#define REMARK_INFO(NAME, what, element, text) {#what, #element, text},
const bt_remark_info bt_remark_table[BT_REMARK_COUNT] = {BT_REMARKS(REMARK_INFO)};

bool bt_remarks_has(const bt_remarks* remarks, bt_remark remark) {
    return (remarks->seen >> remark & 1) != 0;
}

void bt_remarks_note(bt_remarks* remarks, bt_remark remark, double time_s) {
    if (bt_remarks_has(remarks, remark))
        return;
    remarks->seen |= 1u << remark;
    remarks->time_s[remark] = time_s;
}

void bt_remarks_print(const bt_remarks* remarks, char* text, size_t size) {
    size_t at = 0;
    *text = '\0';
    for (int i = 0; i < BT_REMARK_COUNT; ++i) {
        if (!bt_remarks_has(remarks, (bt_remark)i) || at >= size)
            continue;
        const int n =
            snprintf(text + at, size - at, "%s%s %s %.17g", at ? "; " : "", bt_remark_table[i].what,
                     bt_remark_table[i].element, remarks->time_s[i]);
        at += (size_t)n;
    }
}

static void note_by_name(bt_remarks* remarks, const char* what, const char* element,
                         double time_s) {
    for (int i = 0; i < BT_REMARK_COUNT; ++i)
        if (strcmp(what, bt_remark_table[i].what) == 0 &&
            strcmp(element, bt_remark_table[i].element) == 0)
            bt_remarks_note(remarks, (bt_remark)i, time_s);
}

void bt_remarks_parse(const char* text, bt_remarks* remarks) {
    *remarks = (bt_remarks){0};
    for (const char* at = text; at; at = strchr(at, ';')) {
        char what[48], element[48], time[32];
        at += strspn(at, "; ");
        if (sscanf(at, "%47s %47s %31[^;]", what, element, time) == 3)
            note_by_name(remarks, what, element, strtod(time, NULL));
    }
}

// --- columns --------------------------------------------------------------------------------

#define AT(member) offsetof(bt_landing_result, member)
#define PLAIN_COLUMN(kind, name, text) {BT_RESULT_##kind, #name, #name, "", "", text, AT(name), 0},
#define COLUMN_OUTCOME(name, unit, text) PLAIN_COLUMN(OUTCOME, name, text)
#define COLUMN_MODE(name, unit, text) PLAIN_COLUMN(MODE, name, text)
#define COLUMN_FLAG(name, unit, text) PLAIN_COLUMN(FLAG, name, text)
#define COLUMN_COUNT(name, unit, text) PLAIN_COLUMN(COUNT, name, text)
#define COLUMN_REMARKS(name, unit, text) PLAIN_COLUMN(REMARKS, name, text)
#define COLUMN_HASH(name, unit, text) PLAIN_COLUMN(HASH, name, text)
#define COLUMN_REAL(name, unit, text)                                                              \
    {BT_RESULT_REAL, #name "_" #unit, #name, #unit, "", text, AT(name##_##unit), 0},
#define COLUMN_LEG(name, unit, text, leg, index)                                                   \
    {BT_RESULT_REAL,                                                                               \
     #name "_" leg "_" #unit,                                                                      \
     #name "_" leg,                                                                                \
     #unit,                                                                                        \
     leg,                                                                                          \
     text ", " leg,                                                                                \
     AT(name##_##unit[index]),                                                                     \
     0},
#define COLUMN_LEGS(name, unit, text)                                                              \
    COLUMN_LEG(name, unit, text, "nose", BT_LEG_NOSE)                                              \
    COLUMN_LEG(name, unit, text, "left", BT_LEG_LEFT)                                              \
    COLUMN_LEG(name, unit, text, "right", BT_LEG_RIGHT)
#define COLUMN_FAILURE(name, unit, text)                                                           \
    {BT_RESULT_TEXT,                                                                               \
     #name "_element",                                                                             \
     #name "_element",                                                                             \
     "",                                                                                           \
     "",                                                                                           \
     text ": the element or the key",                                                              \
     AT(name##_element),                                                                           \
     0},                                                                                           \
        {BT_RESULT_TEXT,                                                                           \
         #name "_quantity",                                                                        \
         #name "_quantity",                                                                        \
         "",                                                                                       \
         "",                                                                                       \
         text ": the quantity, or the reason",                                                     \
         AT(name##_quantity),                                                                      \
         0},                                                                                       \
        {BT_RESULT_REAL,                                                                           \
         #name "_time_s",                                                                          \
         #name "_time",                                                                            \
         "s",                                                                                      \
         "",                                                                                       \
         text ": when",                                                                            \
         AT(name##_time_s),                                                                        \
         0},

/* of a bounce: prefix is its name, index its place, from 0 */
#define BOUNCE_REAL(prefix, index, name, unit, text)                                               \
    {BT_RESULT_REAL, prefix #name "_" #unit,           prefix #name, #unit, "",                    \
     text,           AT(bounces[index].name##_##unit), 1 + (index)},
#define BOUNCE_FLAG(prefix, index, name, unit, text)                                               \
    {BT_RESULT_FLAG,          prefix #name, prefix #name, "", "", text,                            \
     AT(bounces[index].name), 1 + (index)},
#define FIRST(KIND, name, unit, label, shown, text) BOUNCE_##KIND("bounce_", 0, name, unit, text)
#define SECOND(KIND, name, unit, label, shown, text)                                               \
    BOUNCE_##KIND("second_bounce_", 1, name, unit, text)
#define COLUMN_BOUNCES(name, unit, text)                                                           \
    {BT_RESULT_INT, "bounce_count", "bounce_count", "", "", text, AT(bounce_count), 0},            \
        BT_BOUNCE_FIELDS(FIRST) BT_BOUNCE_FIELDS(SECOND)

#define COLUMN_CONTACTS(name, unit, text) /* a table of their own */

#define COLUMN(KIND, name, unit, label, shown, text) COLUMN_##KIND(name, unit, text)
const bt_result_column bt_result_columns[] = {BT_LANDING_RESULT_FIELDS(COLUMN)};
const int bt_result_column_count = sizeof bt_result_columns / sizeof bt_result_columns[0];

#define CONTACT_REAL(name, unit, text)                                                             \
    {BT_RESULT_REAL,                                                                               \
     #name "_" #unit,                                                                              \
     #name,                                                                                        \
     #unit,                                                                                        \
     "",                                                                                           \
     text,                                                                                         \
     offsetof(bt_contact, name##_##unit),                                                          \
     0},
#define CONTACT_COUNT(name, unit, text)                                                            \
    {BT_RESULT_COUNT, #name, #name, "", "", text, offsetof(bt_contact, name), 0},
#define CONTACT_MODE(name, unit, text)                                                             \
    {BT_RESULT_MODE, #name, #name, "", "", text, offsetof(bt_contact, name), 0},
#define CONTACT(KIND, name, unit, label, shown, text) CONTACT_##KIND(name, unit, text)
const bt_result_column bt_contact_columns[] = {BT_CONTACT_FIELDS(CONTACT)};
const int bt_contact_column_count = sizeof bt_contact_columns / sizeof bt_contact_columns[0];

double bt_result_real(const bt_result_column* column, const bt_landing_result* result) {
    if (column->bounce > result->bounce_count ||
        (column->bounce > 0 && !result->bounces[column->bounce - 1].complete))
        return NAN;
    return *(const double*)((const char*)result + column->offset);
}
