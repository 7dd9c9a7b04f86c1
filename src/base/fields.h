/// Fields: one table per parameter struct. From the table come the struct's members, its defaults,
/// its check, the study reader, the echo, `bolter keys`, `--set path=value` and the list of what
/// may be made random.
///
/// A table is a macro that lists rows F(KIND, name, what, need, fallback, least, greatest,
/// equation, text):
///   KIND      REAL   double, member name_unit       `what` = unit token
///             PLAIN  double without unit, member name   `what` unused, write _
///             COUNT  int64_t                        `what` unused, write _
///             FLAG   bool (fallback 0 or 1)         `what` unused, write _
///             CHOICE int index                      `what` = an array of names ending in NULL
///             LIST   bt_list of values of one unit  `what` = unit token
///             TABLE  bt_table of (x, y) rows        `what` = x unit and y unit: m__m2
///             GROUP  nested struct bt_<what>_params `what` = its prefix
///             VARIANT  one of several groups, as its key `type` says: a bt_<what>_variant
///                    `what` = its prefix
///   need      REQUIRED (a missing key is an error) or OPTIONAL (the fallback holds)
///   fallback, least, greatest   SI; for LIST the bounds hold for every value when least is below
///             greatest; the bounds of a TABLE are checked by the owner; write 0, 0, 0 for GROUP
///             and VARIANT
///   equation  "Eq. 3", or "" where the paper has none
///   text      meaning, symbol first; ends in [assumed] or [calibrated] when its fallback has no
///             source
#ifndef BT_BASE_FIELDS_H
#define BT_BASE_FIELDS_H

#include "base/diag.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { BT_LIST_MAX = 32 };

typedef struct bt_list {
    int count;
    double value[BT_LIST_MAX]; ///< SI
} bt_list;

typedef struct bt_table {
    int count;
    double x[BT_LIST_MAX], y[BT_LIST_MAX]; ///< SI
} bt_table;

typedef enum bt_field_kind {
    BT_FIELD_REAL,
    BT_FIELD_PLAIN,
    BT_FIELD_COUNT,
    BT_FIELD_FLAG,
    BT_FIELD_CHOICE,
    BT_FIELD_LIST,
    BT_FIELD_TABLE,
    BT_FIELD_GROUP,
    BT_FIELD_VARIANT,
} bt_field_kind;

typedef enum bt_need { BT_OPTIONAL, BT_REQUIRED } bt_need;

struct bt_group;
struct bt_variant;

typedef struct bt_field {
    bt_field_kind kind;
    const char* name; ///< key in the study file
    const char* unit; ///< unit token ("mps"; "m__m2" for a table; "" where there is none)
    bt_need need;
    size_t offset; ///< offset of the member in its struct
    double fallback, least, greatest;
    const char* const* choices;       ///< CHOICE only
    const struct bt_group* group;     ///< GROUP only
    const struct bt_variant* variant; ///< VARIANT only
    const char* equation;
    const char* text;
} bt_field;

typedef struct bt_group {
    const char* name; ///< "oleo"
    const char* text; ///< one line: what it describes
    size_t size;      ///< bytes of the struct
    const bt_field* fields;
    int field_count;
    /// Optional: what the ranges cannot say (volumes that fit, tables that increase). Adds its
    /// errors to diag, each text beginning with "path: ".
    void (*check)(const void* params, const char* path, bt_diag* diag);
} bt_group;

/// The types that a variant may be of, each with its own table. A type is chosen in the study by
/// the key `type`; the first is the default.
typedef struct bt_variant {
    const bt_group* const* groups; ///< in the order of type.choices
    int count;
    size_t size;   ///< bytes of bt_<what>_variant.params
    bt_field type; ///< the key `type`; its choices are the names
} bt_variant;

/// What every variant's member begins with.
typedef struct bt_variant_head {
    int type;
    _Alignas(double) unsigned char params[]; ///< values of that type's group
} bt_variant_head;

/* members */
#define BT_MEMBER_REAL(name, what) double name##_##what;
#define BT_MEMBER_PLAIN(name, what) double name;
#define BT_MEMBER_COUNT(name, what) int64_t name;
#define BT_MEMBER_FLAG(name, what) bool name;
#define BT_MEMBER_CHOICE(name, what) int name;
#define BT_MEMBER_LIST(name, what) bt_list name;
#define BT_MEMBER_TABLE(name, what) bt_table name;
#define BT_MEMBER_GROUP(name, what) bt_##what##_params name;
#define BT_MEMBER_VARIANT(name, what) bt_##what##_variant name;
#define BT_MEMBER(kind, name, what, need, fallback, least, greatest, equation, text)               \
    BT_MEMBER_##kind(name, what)

/* rows */
#define BT_ROW_(kind, name, unit, need, offset, fallback, least, greatest, choices, group,         \
                variant, eq, t)                                                                    \
    {BT_FIELD_##kind, name,    unit,  BT_##need, offset, fallback, least,                          \
     greatest,        choices, group, variant,   eq,     t},
#define BT_ROW_REAL(s, name, what, need, d, lo, hi, eq, t)                                         \
    BT_ROW_(REAL, #name, #what, need, offsetof(s, name##_##what), d, lo, hi, 0, 0, 0, eq, t)
#define BT_ROW_PLAIN(s, name, what, need, d, lo, hi, eq, t)                                        \
    BT_ROW_(PLAIN, #name, "", need, offsetof(s, name), d, lo, hi, 0, 0, 0, eq, t)
#define BT_ROW_COUNT(s, name, what, need, d, lo, hi, eq, t)                                        \
    BT_ROW_(COUNT, #name, "", need, offsetof(s, name), d, lo, hi, 0, 0, 0, eq, t)
#define BT_ROW_FLAG(s, name, what, need, d, lo, hi, eq, t)                                         \
    BT_ROW_(FLAG, #name, "", need, offsetof(s, name), d, 0, 1, 0, 0, 0, eq, t)
#define BT_ROW_CHOICE(s, name, what, need, d, lo, hi, eq, t)                                       \
    BT_ROW_(CHOICE, #name, "", need, offsetof(s, name), d, 0, 0, what, 0, 0, eq, t)
#define BT_ROW_LIST(s, name, what, need, d, lo, hi, eq, t)                                         \
    BT_ROW_(LIST, #name, #what, need, offsetof(s, name), d, lo, hi, 0, 0, 0, eq, t)
#define BT_ROW_TABLE(s, name, what, need, d, lo, hi, eq, t)                                        \
    BT_ROW_(TABLE, #name, #what, need, offsetof(s, name), d, lo, hi, 0, 0, 0, eq, t)
#define BT_ROW_GROUP(s, name, what, need, d, lo, hi, eq, t)                                        \
    BT_ROW_(GROUP, #name, "", need, offsetof(s, name), 0, 0, 0, 0, &bt_##what##_group, 0, eq, t)
#define BT_ROW_VARIANT(s, name, what, need, d, lo, hi, eq, t)                                      \
    BT_ROW_(VARIANT, #name, "", need, offsetof(s, name), 0, 0, 0, 0, 0, &bt_##what##_types, eq, t)

/// In a header: declares struct bt_<prefix>_params and its descriptor bt_<prefix>_group.
#define BT_DECLARE_GROUP(prefix, FIELDS)                                                           \
    typedef struct bt_##prefix##_params {                                                          \
        FIELDS(BT_MEMBER)                                                                          \
    } bt_##prefix##_params;                                                                        \
    extern const bt_group bt_##prefix##_group;

/// In one source file: defines the descriptor. ROW is a file-local macro
///   #define ROW(kind, name, ...) BT_ROW_##kind(bt_oleo_params, name, __VA_ARGS__)
#define BT_DEFINE_GROUP(prefix, FIELDS, ROW, check_function, about)                                \
    static const bt_field prefix##_fields[] = {FIELDS(ROW)};                                       \
    const bt_group bt_##prefix##_group = {                                                         \
        #prefix,                                                                                   \
        about,                                                                                     \
        sizeof(bt_##prefix##_params),                                                              \
        prefix##_fields,                                                                           \
        (int)(sizeof prefix##_fields / sizeof prefix##_fields[0]),                                 \
        check_function,                                                                            \
    };

/// In a header: declares bt_<prefix>_variant with room for the parameters of any type, and the
/// descriptor bt_<prefix>_types of those types.
#define BT_DECLARE_VARIANT(prefix, bytes)                                                          \
    typedef struct bt_##prefix##_variant {                                                         \
        int type;                                                                                  \
        _Alignas(double) unsigned char params[bytes];                                              \
    } bt_##prefix##_variant;                                                                       \
    extern const bt_variant bt_##prefix##_types;

/// In one source file: the value of that descriptor, from arrays of groups and of names (ending in
/// NULL) in the same order.
#define BT_VARIANT(groups, names, bytes, about)                                                    \
    {                                                                                              \
        groups, (int)(sizeof groups / sizeof groups[0]), bytes, {                                  \
            .kind = BT_FIELD_CHOICE, .name = "type", .unit = "", .choices = names, .equation = "", \
            .text = about,                                                                         \
        }                                                                                          \
    }

/// The table of the type that a variant's member is of.
const bt_group* bt_variant_group(const bt_variant* variant, const bt_variant_head* member);

/// Makes a variant's member one of a type, with that table's fallbacks.
void bt_variant_set(const bt_variant* variant, int type, bt_variant_head* member);

/// Fills a struct with its table's fallbacks, nested groups included (lists and tables: empty).
void bt_group_set_defaults(const bt_group* group, void* params);

/// Checks every value against its range, nested groups and their own checks included. Messages
/// read "path.key: value is outside least .. greatest unit". A NaN fails.
BT_CHECKED bt_status bt_group_check(const bt_group* group, const void* params, const char* path,
                                    bt_diag* diag);

/// Finds a field by its dotted path ("hook.damper.precharge"). Returns NULL when there is none.
/// *offset is that of the member in the outermost struct. Which keys a variant has depends on its
/// type in `params`; NULL: its default type.
const bt_field* bt_params_find(const bt_group* group, const void* params, const char* path,
                               size_t* offset);

/// Calls visit for every leaf field, depth first, in table order, the key `type` of a variant
/// first; stops when visit returns false. `params` as above.
typedef bool bt_field_visit(void* user, const bt_field* field, const char* path, size_t offset);
void bt_params_walk(const bt_group* group, const void* params, bt_field_visit* visit, void* user);

/// The same with every variant of its default type.
const bt_field* bt_group_find(const bt_group* group, const char* path, size_t* offset);
void bt_group_walk(const bt_group* group, bt_field_visit* visit, void* user);

/// A numeric leaf (REAL, PLAIN, COUNT) read or written as a double. PLAIN and REAL in SI.
double bt_field_get(const bt_field* field, const void* params, size_t offset);
void bt_field_set(const bt_field* field, void* params, size_t offset, double value);

#endif
