#include "cli/values.h"

#include "base/text.h"
#include "base/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { VALUES_MAX = 64, NINE = 9, PART = 128 };

/// FROM..TO UNIT, and what follows.
typedef struct range {
    double from, to;
    char unit[PART];
    int count;
    double step; ///< 0: by count
} range;

static const char* skip(const char* p) {
    return p + strspn(p, " \t");
}

/// Copies `length` characters without the blanks at their end.
static void copy_part(const char* from, size_t length, char* part) {
    while (length > 0 && strchr(" \t", from[length - 1]))
        --length;
    snprintf(part, PART, "%.*s", (int)(length < PART ? length : PART - 1), from);
}

/// " in N" or " by STEP" behind the unit; the unit ends there.
static bool read_tail(const char* text, range* r) {
    const char *in = strstr(text, " in "), *by = strstr(text, " by ");
    const char* tail = in ? in : by;
    copy_part(text, tail ? (size_t)(tail - text) : strlen(text), r->unit);
    r->count = NINE;
    double number = 0;
    if (!tail)
        return true;
    char what[PART], *unit = NULL;
    copy_part(skip(tail + 4), strlen(skip(tail + 4)), what);
    const char* end = bt_text_scan_number(what, &number);
    if (end == what)
        return false;
    unit = what + (skip(end) - what);
    if (in) {
        r->count = (int)number;
        return !*unit && number == floor(number) && number >= 2 && number <= VALUES_MAX;
    }
    r->step = number;
    return (!*unit || strcmp(unit, r->unit) == 0) && number != 0;
}

static bool read_range(const char* text, const char* dots, range* r) {
    char from[PART];
    copy_part(text, (size_t)(dots - text), from);
    *r = (range){0};
    if (bt_number_parse(from, &r->from) != BT_OK)
        return false;
    const char* to = skip(dots + 2);
    const char* end = bt_text_scan_number(to, &r->to);
    return end != to && read_tail(skip(end), r);
}

/// How many values a range by steps has; 0 when it does not get there.
static int count_steps(const range* r) {
    const double steps = (r->to - r->from) / r->step;
    return steps >= 0 && steps < VALUES_MAX ? (int)floor(steps * (1 + 1e-12) + 1e-9) + 1 : 0;
}

static bt_status write_range(const char* text, const char* dots, char* list, size_t size, char* why,
                             size_t why_size) {
    range r;
    const bool read = read_range(text, dots, &r);
    const int count = read && r.step != 0 ? count_steps(&r) : r.count;
    if (!read || count == 0) {
        snprintf(why, why_size,
                 "\"%s\" is not FROM..TO UNIT, FROM..TO UNIT in N or FROM..TO UNIT by STEP, with 2 "
                 "to %d values",
                 text, (int)VALUES_MAX);
        return BT_ERR_INPUT;
    }
    *list = '\0';
    for (int i = 0; i < count; ++i) {
        char number[40];
        const double value =
            r.step != 0 ? r.from + i * r.step : r.from + (r.to - r.from) * i / (count - 1);
        bt_text_print_rounded(value, 12, number, sizeof number);
        bt_text_append(list, size, "%s%s%s%s", i ? ", " : "", number, *r.unit ? " " : "", r.unit);
    }
    return BT_OK;
}

/// The unit of the first item from `item` on that has one.
static const char* next_unit(const char* item, char* unit) {
    *unit = '\0';
    while (item) {
        const size_t length = strcspn(item, ",");
        char part[PART];
        double number;
        copy_part(skip(item), length - (size_t)(skip(item) - item), part);
        const char* end = bt_text_scan_number(part, &number);
        if (end != part && *skip(end)) {
            snprintf(unit, PART, "%s", skip(end));
            break;
        }
        item = item[length] ? item + length + 1 : NULL;
    }
    return unit;
}

static void write_list(const char* text, char* list, size_t size) {
    *list = '\0';
    for (const char* item = text; item;) {
        const size_t length = strcspn(item, ",");
        char part[PART], unit[PART];
        double number;
        const size_t blanks = strspn(item, " \t") < length ? strspn(item, " \t") : length;
        copy_part(item + blanks, length - blanks, part);
        const char* end = bt_text_scan_number(part, &number);
        const bool bare = end != part && !*skip(end);
        next_unit(item, unit);
        bt_text_append(list, size, "%s%s%s%s", item == text ? "" : ", ", part,
                       bare && *unit ? " " : "", bare ? unit : "");
        item = item[length] ? item + length + 1 : NULL;
    }
}

bt_status bt_values_expand(const char* typed, char* list, size_t size, char* why, size_t why_size) {
    char text[4096];
    bt_text_plain(typed, text, sizeof text);
    if (strlen(typed) >= sizeof text / 2) {
        snprintf(why, why_size, "longer than %zu characters", sizeof text / 2);
        return BT_ERR_INPUT;
    }
    const char* dots = strstr(text, "..");
    if (dots)
        return write_range(text, dots, list, size, why, why_size);
    write_list(text, list, size);
    return BT_OK;
}
