/// Units: what a person types ("6.5 MPa", "52 deg", "90 kn") to SI, by one exact factor per unit.
#ifndef BT_BASE_UNITS_H
#define BT_BASE_UNITS_H

#include "base/status.h"

#include <stddef.h>

/// A unit token as it stands in field tables and member names ("mps2") and as people write it.
/// Tokens: 1 m m2 m3 s kg kgm2 kgpm N Nm Pa mps mps2 rad radps Npm Npm2 Npmps Npm2ps2
/// (see units.c for the whole table; every token has its text and its dimension).
/// Returns the written SI form of a token ("m/s^2"; "" for token 1), NULL for an unknown token.
const char* bt_unit_text(const char* token);

/// Reads a number with its unit, both required unless the token is 1 (then a unit is an error).
///
/// @param text   for example "3.6 m/s"; leading and trailing blanks allowed
/// @param token  the dimension that is wanted, as a token
/// @param value  the value in SI; untouched on failure
/// @param why    on failure, what was wrong and what would be right, as a sentence without the
///               value's name ("\"18 foo\" has no known unit; use Pa, kPa, MPa, bar, mbar or psi")
/// @return BT_OK or BT_ERR_INPUT. Never accepts 3,6 or nan or 1e999. Independent of the locale.
BT_CHECKED bt_status bt_unit_parse(const char* text, const char* token, double* value, char* why,
                                   size_t why_size);

/// Writes a value in the SI unit of the token with the fewest digits that read back to the same
/// double ("3.6 m/s").
void bt_unit_print(double value, const char* token, char* text, size_t size);

/// Writes an SI value in the unit that `typed` ends in, rounded to 6 digits, without the unit
/// ("52" for 0.9076 when typed is "60 deg"); in SI when that unit is unknown. Points *unit at the
/// unit's text inside typed ("" when there is none).
void bt_unit_print_as(double value, const char* typed, char* text, size_t size, const char** unit);

/// Reads a plain finite number, whole text, independent of the locale. BT_ERR_INPUT otherwise.
BT_CHECKED bt_status bt_number_parse(const char* text, double* value);

#endif
