#include "base/text.h"

#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Enters the C locale on this thread; hand the result to leave_c_locale.
static locale_t enter_c_locale(void) {
    // glibc hands out a constant object for "C": nothing is allocated
    return uselocale(newlocale(LC_ALL_MASK, "C", (locale_t)0));
}

static void leave_c_locale(locale_t before) {
    freelocale(uselocale(before));
}

void bt_text_plain(const char* typed, char* plain, size_t size) {
    static const struct {
        const char *from, *to;
    } same[] = {
        {"\u2212", "-"}, {"\u00a0", " "}, {"\u202f", " "},         {"\u2009", " "},
        {"\u00b5", "u"}, {"\u03bc", "u"}, {"\u00b2", "^2"},        {"\u00b3", "^3"},
        {"\u00b7", "*"}, {"\u22c5", "*"}, {"\u207b\u00b9", "^-1"}, {"\u207b\u00b2", "^-2"},
    };
    size_t used = 0;
    while (*typed && used + 4 < size) {
        size_t k = 0;
        while (k < sizeof same / sizeof same[0] &&
               strncmp(typed, same[k].from, strlen(same[k].from)) != 0)
            ++k;
        if (k == sizeof same / sizeof same[0]) {
            plain[used++] = *typed++;
            continue;
        }
        typed += strlen(same[k].from);
        used += (size_t)snprintf(plain + used, size - used, "%s", same[k].to);
    }
    plain[used] = '\0';
}

static const char* skip_digits(const char* p) {
    while (*p >= '0' && *p <= '9')
        ++p;
    return p;
}

const char* bt_text_scan_number(const char* text, double* value) {
    const char* p = text + (*text == '+' || *text == '-');
    const char* digits = p;
    p = skip_digits(p);
    ptrdiff_t digit_count = p - digits;
    if (*p == '.') {
        const char* fraction = ++p;
        p = skip_digits(p);
        digit_count += p - fraction;
    }
    if (digit_count == 0)
        return text;
    if (*p == 'e' || *p == 'E') {
        const char* exponent = p + 1 + (p[1] == '+' || p[1] == '-');
        if (skip_digits(exponent) != exponent)
            p = skip_digits(exponent);
    }

    char number[512]; // digits beyond these cannot be told from a mistake
    const size_t length = (size_t)(p - text);
    if (length >= sizeof number)
        return text;
    memcpy(number, text, length);
    number[length] = '\0';
    const locale_t before = enter_c_locale();
    *value = strtod(number, NULL);
    leave_c_locale(before);
    return p;
}

void bt_text_print_rounded(double value, int digits, char* text, size_t size) {
    const locale_t before = enter_c_locale();
    snprintf(text, size, "%.*g", digits, value);
    leave_c_locale(before);
}

/// "6.5e+06" to "6.5e6", "1e-05" to "1e-5".
static void shorten_exponent(char* number) {
    char* e = strchr(number, 'e');
    if (!e)
        return;
    const char* from = e + 1;
    char* to = e + 1;
    if (*from == '-')
        *to++ = *from;
    ++from;
    from += strspn(from, "0");
    memmove(to, from, strlen(from) + 1);
}

void bt_text_print_number(double value, char* text, size_t size) {
    char number[64];
    int digits = 1;
    for (; digits < 17; ++digits) {
        bt_text_print_rounded(value, digits, number, sizeof number);
        double again = 0;
        bt_text_scan_number(number, &again);
        if (memcmp(&again, &value, sizeof value) == 0)
            break;
    }
    // as people write it: 24000, not 2.4e4
    if (fabs(value) < 1e6 && fabs(value) >= 1 && digits < 6)
        digits = 6;
    bt_text_print_rounded(value, digits, number, sizeof number);
    shorten_exponent(number);
    snprintf(text, size, "%s", number);
}

static int least(int a, int b) {
    return a < b ? a : b;
}

int bt_text_distance(const char* a, const char* b) {
    enum { MAX = 63 };
    const size_t length_a = strlen(a), length_b = strlen(b);
    if (length_a > MAX || length_b > MAX)
        return 2 * MAX;
    // rows i - 2, i - 1 and i of the table of distances between beginnings of a and b
    int rows[3][MAX + 1] = {{0}};
    for (size_t j = 0; j <= length_b; ++j)
        rows[0][j] = (int)j;
    for (size_t i = 1; i <= length_a; ++i) {
        int* row = rows[i % 3];
        const int* above = rows[(i - 1) % 3];
        const int* above2 = rows[(i + 1) % 3];
        row[0] = (int)i;
        for (size_t j = 1; j <= length_b; ++j) {
            row[j] = least(least(above[j], row[j - 1]) + 1, above[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least(row[j], above2[j - 2] + 1);
        }
    }
    return rows[length_a % 3][length_b];
}

bt_text_nearest bt_text_search(const char* typed) {
    return (bt_text_nearest){.typed = typed, .distance = INT_MAX};
}

void bt_text_look(bt_text_nearest* nearest, const char* name) {
    const int distance = bt_text_distance(nearest->typed, name);
    if (distance >= nearest->distance || strlen(name) >= sizeof nearest->name)
        return;
    nearest->distance = distance;
    strcpy(nearest->name, name);
}

bool bt_text_is_near(const bt_text_nearest* nearest) {
    return *nearest->name && nearest->distance <= 1 + (int)strlen(nearest->typed) / 3;
}

const char* bt_text_suggest(const bt_text_nearest* nearest, char* text, size_t size) {
    *text = '\0';
    if (bt_text_is_near(nearest))
        snprintf(text, size, "; did you mean \"%s\"?", nearest->name);
    return text;
}

void bt_text_append(char* buffer, size_t size, const char* format, ...) {
    const size_t used = strlen(buffer);
    if (used + 1 >= size)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(buffer + used, size - used, format, args);
    va_end(args);
}
