#include "base/units.h"

#include "base/text.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/// Exponents of m, kg, s, A, K, mol, cd and rad, in halves (Hertz stiffness is N/m^1.5). The angle
/// is kept apart so that "52" and "52 deg", "N m" and "N m/rad" cannot be mistaken for each other.
enum { DIMENSIONS = 8 };

enum { TYPED_SIZE = 1024 }; // a number alone may have 512 digits

typedef struct unit {
    /// value in SI = typed value * scale / divisor; both exact, so that 375 mm^2 is the double
    /// nearest to 375e-6
    double scale, divisor;
    signed char halves[DIMENSIONS];
} unit;

typedef struct unit_symbol {
    const char* name;
    double scale, divisor;
    signed char length, mass, time, angle;
} unit_symbol;

// lb 0.45359237 kg, ft 0.3048 m, nmi 1852 m (international); g_n 9.80665 m/s^2, so
// lbf = 4.4482216152605 N, slug = lbf s^2/ft, psi = lbf/in^2
static const unit_symbol symbols[] = {
    {"m", 1, 1, 1, 0, 0, 0},
    {"mm", 1, 1e3, 1, 0, 0, 0},
    {"dm", 1, 1e1, 1, 0, 0, 0},
    {"cm", 1, 1e2, 1, 0, 0, 0},
    {"km", 1e3, 1, 1, 0, 0, 0},
    {"um", 1, 1e6, 1, 0, 0, 0},
    {"in", 254, 1e4, 1, 0, 0, 0},
    {"inch", 254, 1e4, 1, 0, 0, 0},
    {"inches", 254, 1e4, 1, 0, 0, 0},
    {"ft", 3048, 1e4, 1, 0, 0, 0},
    {"foot", 3048, 1e4, 1, 0, 0, 0},
    {"feet", 3048, 1e4, 1, 0, 0, 0},
    {"nmi", 1852, 1, 1, 0, 0, 0},
    {"s", 1, 1, 0, 0, 1, 0},
    {"sec", 1, 1, 0, 0, 1, 0},
    {"ms", 1, 1e3, 0, 0, 1, 0},
    {"msec", 1, 1e3, 0, 0, 1, 0},
    {"us", 1, 1e6, 0, 0, 1, 0},
    {"min", 60, 1, 0, 0, 1, 0},
    {"h", 3600, 1, 0, 0, 1, 0},
    {"hr", 3600, 1, 0, 0, 1, 0},
    {"kg", 1, 1, 0, 1, 0, 0},
    {"g", 1, 1e3, 0, 1, 0, 0},
    {"t", 1e3, 1, 0, 1, 0, 0},
    {"lb", 45359237, 1e8, 0, 1, 0, 0},
    {"lbs", 45359237, 1e8, 0, 1, 0, 0},
    {"lbm", 45359237, 1e8, 0, 1, 0, 0},
    {"slugs", 44482216152605, 3048e9, 0, 1, 0, 0},
    {"slug", 44482216152605, 3048e9, 0, 1, 0, 0},
    {"N", 1, 1, 1, 1, -2, 0},
    {"kN", 1e3, 1, 1, 1, -2, 0},
    {"daN", 1e1, 1, 1, 1, -2, 0},
    {"kgf", 980665, 1e5, 1, 1, -2, 0},
    {"MN", 1e6, 1, 1, 1, -2, 0},
    {"GN", 1e9, 1, 1, 1, -2, 0},
    {"lbf", 44482216152605, 1e13, 1, 1, -2, 0},
    {"kip", 44482216152605, 1e10, 1, 1, -2, 0},
    {"Pa", 1, 1, -1, 1, -2, 0},
    {"kPa", 1e3, 1, -1, 1, -2, 0},
    {"MPa", 1e6, 1, -1, 1, -2, 0},
    {"GPa", 1e9, 1, -1, 1, -2, 0},
    {"bar", 1e5, 1, -1, 1, -2, 0},
    {"mbar", 1e2, 1, -1, 1, -2, 0},
    {"hPa", 1e2, 1, -1, 1, -2, 0},
    {"psi", 44482216152605, 64516e5, -1, 1, -2, 0},
    {"ksi", 44482216152605, 64516e2, -1, 1, -2, 0},
    {"atm", 101325, 1, -1, 1, -2, 0},
    {"mmHg", 133322387415, 1e9, -1, 1, -2, 0}, // 13.5951 g/cm^3 under g_n
    {"inHg", 3386388640341, 1e9, -1, 1, -2, 0},
    {"kn", 1852, 3600, 1, 0, -1, 0},
    {"kt", 1852, 3600, 1, 0, -1, 0},
    {"kts", 1852, 3600, 1, 0, -1, 0},
    {"knots", 1852, 3600, 1, 0, -1, 0},
    {"mph", 1609344, 3600e3, 1, 0, -1, 0},
    {"fps", 3048, 1e4, 1, 0, -1, 0},
    {"rad", 1, 1, 0, 0, 0, 1},
    {"mrad", 1, 1e3, 0, 0, 0, 1},
    {"deg", M_PI, 180, 0, 0, 0, 1},
    {"degrees", M_PI, 180, 0, 0, 0, 1},
    {"rpm", M_PI, 30, 0, 0, -1, 1},
    {"L", 1, 1e3, 3, 0, 0, 0},
    {"mL", 1, 1e6, 3, 0, 0, 0},
    {"cc", 1, 1e6, 3, 0, 0, 0},
    {"gal", 3785411784, 1e12, 3, 0, 0, 0}, // US, 231 in^3
    {"J", 1, 1, 2, 1, -2, 0},
    {"kJ", 1e3, 1, 2, 1, -2, 0},
    {"MJ", 1e6, 1, 2, 1, -2, 0},
    {"W", 1, 1, 2, 1, -3, 0},
    {"kW", 1e3, 1, 2, 1, -3, 0},
    {"MW", 1e6, 1, 2, 1, -3, 0},
    {"Hz", 1, 1, 0, 0, -1, 0},
    {"kHz", 1e3, 1, 0, 0, -1, 0},
};

typedef struct unit_token {
    const char* token; ///< as in member names: p for "per", digits are exponents, 15 is 1.5
    const char* text;  ///< SI, as people write it; its dimension is the token's
    const char* use;   ///< what a message proposes
} unit_token;

static const unit_token tokens[] = {
    {"1", "", "a plain number"},
    {"m", "m", "m, mm, cm, in or ft"},
    {"m2", "m^2", "m^2, cm^2, mm^2, in^2 or ft^2"},
    {"m3", "m^3", "m^3, L, cc, cm^3, in^3 or ft^3"},
    {"m4", "m^4", "m^4, cm^4 or mm^4"},
    {"pm", "1/m", "1/m or 1/mm"},
    {"s", "s", "s, ms, us or min"},
    {"ps", "1/s", "1/s or Hz"},
    {"Hz", "Hz", "Hz, kHz or 1/s"},
    {"kg", "kg", "kg, g, t, lb or slug"},
    {"kgm2", "kg m^2", "kg m^2 or slug ft^2"},
    {"kgm", "kg m", "kg m"},
    {"kgpm", "kg/m", "kg/m, g/m or lb/ft"},
    {"kgpm3", "kg/m^3", "kg/m^3, g/cm^3 or lb/ft^3"},
    {"N", "N", "N, daN, kN, MN, kgf, lbf or kip"},
    {"Nm", "N m", "N m, kN m or lbf ft"},
    {"Nm2", "N m^2", "N m^2, kN m^2 or lbf in^2"},
    {"Nm2s", "N m^2 s", "N m^2 s or kN m^2 s"},
    {"Nms", "N m s", "N m s or kN m s"},
    {"Ns", "N s", "N s or kN s"},
    {"Npm", "N/m", "N/m, kN/m, MN/m, N/mm, lbf/in or lbf/ft"},
    {"Npm2", "N/m^2", "N/m^2, kN/m^2, MN/m^2 or N/mm^2"},
    {"Npm3", "N/m^3", "N/m^3, kN/m^3 or MN/m^3"},
    {"Npm15", "N/m^1.5", "N/m^1.5, kN/m^1.5 or N/mm^1.5"},
    {"Nspm", "N s/m", "N s/m, kN s/m or lbf s/ft"},
    {"Npmps", "N s/m", "N s/m, kN s/m or lbf s/ft"}, // N per m/s
    {"Nspm2", "N s/m^2", "N s/m^2 or kN s/m^2"},
    {"Ns2pm2", "N s^2/m^2", "N s^2/m^2 or kN s^2/m^2"},
    {"Nmprad", "N m/rad", "N m/rad, kN m/rad, N m/deg or lbf ft/rad"},
    {"Nmsprad", "N m s/rad", "N m s/rad, kN m s/rad or lbf ft s/rad"},
    {"Nprad", "N/rad", "N/rad, kN/rad or N/deg"},
    {"Pa", "Pa", "Pa, kPa, MPa, bar, mbar or psi"},
    {"Pa_absolute", "Pa", "Pa, kPa, MPa, bar or psi (absolute), psig or barg"},
    {"Pa_gauge", "Pa", "Pa, kPa, MPa, bar or psi (gauge), psia or bara"},
    {"Paps", "Pa/s", "Pa/s or bar/s"},
    {"Pas", "Pa s", "Pa s"},
    {"mps", "m/s", "m/s, km/h, kn, ft/s or ft/min"},
    {"mps2", "m/s^2", "m/s^2 or ft/s^2"},
    {"m2ps", "m^2/s", "m^2/s or mm^2/s"},
    {"m3ps", "m^3/s", "m^3/s, L/s or L/min"},
    {"spm", "s/m", "s/m or s/ft"},
    {"rad", "rad", "deg, rad or mrad"},
    {"radps", "rad/s", "rad/s, deg/s or rpm"},
    {"radps2", "rad/s^2", "rad/s^2 or deg/s^2"},
    {"prad", "1/rad", "1/rad or 1/deg"},
    {"J", "J", "J, kJ, N m or lbf ft"},
    {"W", "W", "W, kW or N m/s"},
};

// --- the grammar of a typed unit ------------------------------------------------------------
// unit    = product { "/" factor }        after a slash one factor only: write N/(m s)
// product = factor { [" " | "*" | "." | "-"] factor }
// factor  = ( ["cu " | "sq "] symbol | "(" unit ")" | "1" ) [ ["^"] exponent ]
// exponent without "^": one digit ("m2", "s-1"); with it also 0.5, 1.5

static void multiply(unit* u, const unit* by, int halves) {
    const double power = abs(halves) / 2.0;
    const double scale = pow(by->scale, power), divisor = pow(by->divisor, power);
    u->scale *= halves > 0 ? scale : divisor;
    u->divisor *= halves > 0 ? divisor : scale;
    for (int i = 0; i < DIMENSIONS; ++i)
        u->halves[i] = (signed char)(u->halves[i] + by->halves[i] * halves / 2);
}

static const char* skip_blanks(const char* p) {
    while (*p == ' ' || *p == '\t')
        ++p;
    return p;
}

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static size_t word_length(const char* p) {
    size_t length = 0;
    while (is_letter(p[length]))
        ++length;
    return length;
}

static bool is_word(const char* p, size_t length, const char* word) {
    return strlen(word) == length && memcmp(word, p, length) == 0;
}

static const char* parse_symbol(const char* p, unit* u) {
    const size_t length = word_length(p);
    for (size_t i = 0; i < sizeof symbols / sizeof symbols[0]; ++i) {
        const unit_symbol* s = &symbols[i];
        if (is_word(p, length, s->name)) {
            *u = (unit){s->scale,
                        s->divisor,
                        {(signed char)(2 * s->length), (signed char)(2 * s->mass),
                         (signed char)(2 * s->time), 0, 0, 0, 0, (signed char)(2 * s->angle)}};
            return p + length;
        }
    }
    return NULL;
}

/// "cu in", "sq ft": the exponent stands first. 0: neither, and nothing is skipped.
static int leading_exponent(const char** p) {
    const size_t length = word_length(*p);
    const int exponent = is_word(*p, length, "cu") ? 3 : is_word(*p, length, "sq") ? 2 : 0;
    if (exponent)
        *p = skip_blanks(*p + length + ((*p)[length] == '.'));
    return exponent;
}

static const char* parse_exponent(const char* p, int* halves) {
    *halves = 2;
    if (*p >= '1' && *p <= '9') {
        *halves = 2 * (*p - '0');
        return p + 1;
    }
    if (*p == '-' && p[1] >= '1' && p[1] <= '9') {
        *halves = -2 * (p[1] - '0');
        return p + 2;
    }
    if (*p != '^')
        return p;
    double exponent;
    const char* end = bt_text_scan_number(p + 1, &exponent);
    if (end == p + 1 || !(fabs(exponent) <= 9) || 2 * exponent != floor(2 * exponent) ||
        exponent == 0)
        return NULL;
    *halves = (int)(2 * exponent);
    return end;
}

static const char* parse_unit(const char* p, unit* u, int depth);

static const char* parse_factor(const char* p, unit* into, int sign, int depth) {
    unit u = {.scale = 1, .divisor = 1};
    const int leading = leading_exponent(&p);
    if (*p == '(') {
        p = depth < 4 ? parse_unit(p + 1, &u, depth + 1) : NULL;
        if (!p || *p != ')')
            return NULL;
        ++p;
    } else if (*p == '1' && sign > 0) { // as in 1/s
        return p + 1;
    } else {
        p = parse_symbol(p, &u);
    }
    int halves;
    p = p ? parse_exponent(p, &halves) : NULL;
    if (!p || (leading && halves != 2))
        return NULL;
    if (leading)
        halves = 2 * leading;
    for (int i = 0; i < DIMENSIONS; ++i)
        if (u.halves[i] * halves % 2 != 0 || abs(into->halves[i] + u.halves[i] * halves / 2) > 60)
            return NULL;
    multiply(into, &u, sign * halves);
    return p;
}

static const char* parse_unit(const char* p, unit* u, int depth) {
    bool divided = false;
    for (p = parse_factor(skip_blanks(p), u, 1, depth); p;) {
        const char* next = skip_blanks(p);
        const bool slash = *next == '/';
        const bool joined = (*next == '.' || *next == '-') && is_letter(next[1]); // N.m, lbf-ft
        if (slash || *next == '*' || joined)
            next = skip_blanks(next + 1);
        else if (!is_letter(*next) && *next != '(')
            return next;
        if (divided && !slash)
            return NULL; // N/m s: in the denominator or not?
        divided = slash;
        p = parse_factor(next, u, slash ? -1 : 1, depth);
    }
    return NULL;
}

/// The whole of text as a unit; false when it is none.
static bool unit_from_text(const char* text, unit* u) {
    *u = (unit){.scale = 1, .divisor = 1};
    if (*skip_blanks(text) == '\0')
        return true;
    const char* end = parse_unit(text, u, 0);
    return end && *end == '\0' && isfinite(u->scale) && isfinite(u->divisor) && u->scale > 0 &&
           u->divisor > 0;
}

// --- the interface --------------------------------------------------------------------------

static const unit_token* find_token(const char* token) {
    for (size_t i = 0; i < sizeof tokens / sizeof tokens[0]; ++i)
        if (strcmp(tokens[i].token, token) == 0)
            return &tokens[i];
    return NULL;
}

const char* bt_unit_text(const char* token) {
    const unit_token* t = find_token(token);
    return t ? t->text : NULL;
}

/// The text in plain characters; itself when it is too long to be a quantity.
static const char* plain_text(const char* text, char plain[TYPED_SIZE]) {
    if (strlen(text) >= TYPED_SIZE / 2)
        return text;
    bt_text_plain(text, plain, TYPED_SIZE);
    return plain;
}

bt_status bt_number_parse(const char* text, double* value) {
    char plain[TYPED_SIZE];
    const char* start = skip_blanks(plain_text(text, plain));
    double number;
    const char* end = bt_text_scan_number(start, &number);
    if (end == start || *skip_blanks(end) != '\0' || !isfinite(number))
        return BT_ERR_INPUT;
    *value = number;
    return BT_OK;
}

static bool is_not_a_number_word(const char* text) {
    text += *text == '+' || *text == '-';
    text += *text == '.'; // YAML writes .nan
    return strncasecmp(text, "nan", 3) == 0 || strncasecmp(text, "inf", 3) == 0;
}

/// What is wrong with text whose number ends at `end`, before its unit is looked at.
static const char* number_fault(const char* start, const char* end, double number) {
    if (is_not_a_number_word(start))
        return "is not a finite number";
    if (end == start)
        return "is not a number";
    if (*end == ',')
        return "is not a number: write the decimal point as \".\"";
    if (!isfinite(number))
        return "is not a finite number";
    return NULL;
}

// --- gauge and absolute pressure ------------------------------------------------------------

static const double standard_atmosphere_Pa = 101325;

/// Cuts "psig" to "psi" and returns 'g'; '\0' where a unit does not say of which kind it is.
static char strip_pressure_kind(char* unit_text) {
    static const char* const names[] = {"psi", "bar", "kPa", "MPa", "ksi"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        const char kind = strncmp(unit_text, names[i], 3) == 0 ? unit_text[3] : '\0';
        if ((kind == 'g' || kind == 'a') && *skip_blanks(unit_text + 4) == '\0') {
            unit_text[3] = '\0';
            return kind;
        }
    }
    return '\0';
}

/// What a pressure of a kind needs to become one of the token's, Pa; NAN: the token has no kind.
static double pressure_offset(char kind, const char* token) {
    if (kind == '\0')
        return 0;
    if (strcmp(token, "Pa_absolute") == 0)
        return kind == 'g' ? standard_atmosphere_Pa : 0;
    if (strcmp(token, "Pa_gauge") == 0)
        return kind == 'g' ? 0 : -standard_atmosphere_Pa;
    return NAN;
}

// --- what was meant -------------------------------------------------------------------------

/// The symbol that a word in another case, or with an s too many, stands for; NULL. A wrong letter
/// makes another unit too easily ("grad" is no "mrad").
static const char* meant_symbol(const char* word, size_t length) {
    for (size_t i = 0; i < sizeof symbols / sizeof symbols[0]; ++i) {
        const char* name = symbols[i].name;
        const bool plural = strlen(name) + 1 == length && word[length - 1] == 's';
        if ((plural || strlen(name) == length) && strncasecmp(name, word, strlen(name)) == 0)
            return name;
    }
    return NULL;
}

/// What a word of a unit is better written as; NULL: as it is. `forces`: pounds of mass as force.
static const char* better_word(const char* word, size_t length, bool forces) {
    unit ignored;
    if (forces)
        return is_word(word, length, "lb") || is_word(word, length, "lbs") ? "lbf" : NULL;
    return length > 0 && !parse_symbol(word, &ignored) ? meant_symbol(word, length) : NULL;
}

/// ' (did you mean "kN"?)', or "" when nothing near has the wanted dimension.
static void suggest(const char* unit_text, const unit* wanted, char* text, size_t size) {
    char better[64] = "";
    unit u;
    const bool forces = unit_from_text(unit_text, &u);
    for (const char* p = unit_text; *p;) {
        const size_t length = word_length(p) ? word_length(p) : 1;
        const char* word = better_word(p, word_length(p), forces);
        bt_text_append(better, sizeof better, "%.*s", word ? (int)strlen(word) : (int)length,
                       word ? word : p);
        p += length;
    }
    *text = '\0';
    if (strcmp(better, unit_text) != 0 && unit_from_text(better, &u) &&
        memcmp(u.halves, wanted->halves, sizeof u.halves) == 0)
        snprintf(text, size, " (did you mean \"%s\"?)", better);
}

// --- a number with its unit -----------------------------------------------------------------

static const char* unit_fault(const char* unit_text, const unit* wanted, unit* typed) {
    const bool plain = memcmp(wanted->halves, (signed char[DIMENSIONS]){0}, DIMENSIONS) == 0;
    if (*unit_text == '\0')
        return plain ? NULL : "has no unit";
    if (plain)
        return "is wanted without a unit";
    if (!unit_from_text(unit_text, typed))
        return "has no known unit";
    if (memcmp(wanted->halves, typed->halves, DIMENSIONS) != 0)
        return "has a unit of another dimension";
    return NULL;
}

/// What was typed, taken apart.
typedef struct quantity {
    double number, offset; ///< SI = number * unit + offset
    char unit_text[TYPED_SIZE];
    unit unit;
} quantity;

/// What is wrong with a text as a quantity, or NULL.
static const char* take_apart(const char* start, const char* token, const unit* wanted,
                              quantity* q) {
    const char* end = bt_text_scan_number(start, &q->number);
    const char* fault = number_fault(start, end, q->number);
    if (fault)
        return fault;
    end = skip_blanks(end);
    if (strlen(end) >= sizeof q->unit_text)
        return "has no known unit";
    snprintf(q->unit_text, sizeof q->unit_text, "%s", end);
    q->offset = pressure_offset(strip_pressure_kind(q->unit_text), token);
    if (isnan(q->offset))
        return "tells gauge from absolute pressure, which means nothing here: leave out its last "
               "letter";
    fault = unit_fault(q->unit_text, wanted, &q->unit);
    if (!fault && !isfinite(q->number * q->unit.scale / q->unit.divisor))
        return "is not a finite number";
    return fault;
}

bt_status bt_unit_parse(const char* text, const char* token, double* value, char* why,
                        size_t why_size) {
    const unit_token* t = find_token(token);
    unit wanted;
    if (!t || !unit_from_text(t->text, &wanted)) {
        snprintf(why, why_size, "unit token \"%s\" is not in the table", token);
        return BT_ERR_INPUT;
    }
    char plain[TYPED_SIZE], meant[96] = "";
    quantity q = {.unit = {.scale = 1, .divisor = 1}};
    const char* start = skip_blanks(plain_text(text, plain));
    const char* fault = take_apart(start, token, &wanted, &q);
    if (!fault) {
        *value = q.number * q.unit.scale / q.unit.divisor + q.offset;
        return BT_OK;
    }
    int length = (int)strlen(start);
    while (length > 0 && (start[length - 1] == ' ' || start[length - 1] == '\t'))
        --length;
    suggest(q.unit_text, &wanted, meant, sizeof meant);
    snprintf(why, why_size, "\"%.*s\" %s%s; use %s", length < 60 ? length : 60, start, fault, meant,
             t->use);
    return BT_ERR_INPUT;
}

void bt_unit_print(double value, const char* token, char* text, size_t size) {
    char number[64];
    bt_text_print_number(value, number, sizeof number);
    const char* unit_text = bt_unit_text(token);
    snprintf(text, size, "%s%s%s", number, unit_text && *unit_text ? " " : "",
             unit_text ? unit_text : "");
}

void bt_unit_print_as(double value, const char* typed, char* text, size_t size,
                      const char** unit_text) {
    double ignored;
    char plain[TYPED_SIZE];
    const char* start = typed + strcspn(typed, "0123456789.");
    *unit_text = skip_blanks(bt_text_scan_number(start, &ignored));
    while ((unsigned char)**unit_text == 0xc2 && (unsigned char)(*unit_text)[1] == 0xa0)
        *unit_text = skip_blanks(*unit_text + 2); // blanks that do not break
    unit u;
    if (!unit_from_text(plain_text(*unit_text, plain), &u)) {
        *unit_text = "";
        u = (unit){.scale = 1, .divisor = 1};
    }
    bt_text_print_rounded(value * u.divisor / u.scale, 6, text, size);
}
