/// Text that does not depend on the locale of the process.
#ifndef BT_BASE_TEXT_H
#define BT_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/// Reads the decimal number at the start of text: [+-] digits [. digits] [e [+-] digits].
/// No hexadecimal, no nan, no inf. Returns the first character after it; text when there is none.
/// A number too large for a double becomes infinite.
const char* bt_text_scan_number(const char* text, double* value);

/// Writes a finite double with the fewest digits (at most 17) that read back to the same bits:
/// 24000, 0.0365, 6.5e6.
void bt_text_print_number(double value, char* text, size_t size);

/// Writes a double with `digits` significant digits (as %.*g).
void bt_text_print_rounded(double value, int digits, char* text, size_t size);

/// Copies a typed quantity with what keyboards and documents put in the place of plain characters:
/// minus signs, blanks that do not break, the micro sign, raised digits and the raised dot become
/// - blank u digits (after ^) and *. Cuts what does not fit.
void bt_text_plain(const char* typed, char* plain, size_t size);

/// The number of single-character insertions, deletions, substitutions and swaps of neighbours
/// that turn a into b. Names longer than 63 characters are taken as unlike everything.
int bt_text_distance(const char* a, const char* b);

enum { BT_TEXT_NAME_MAX = 256 };

/// A search for the name that was meant. Start it with bt_text_search.
typedef struct bt_text_nearest {
    const char* typed;           ///< the caller's
    char name[BT_TEXT_NAME_MAX]; ///< the nearest so far; ""
    int distance;
} bt_text_nearest;

bt_text_nearest bt_text_search(const char* typed);

/// Keeps the name when it is nearer than those before it; a name that does not fit is left out.
void bt_text_look(bt_text_nearest* nearest, const char* name);

/// Whether the nearest name may be what was meant: more than a third of the letters wrong is no
/// misspelling any more.
bool bt_text_is_near(const bt_text_nearest* nearest);

/// "; did you mean "length"?", or "" when the nearest name is not near. Returns text.
const char* bt_text_suggest(const bt_text_nearest* nearest, char* text, size_t size);

/// Appends formatted text at the end of a terminated buffer; cuts what does not fit.
void bt_text_append(char* buffer, size_t size, const char* format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
