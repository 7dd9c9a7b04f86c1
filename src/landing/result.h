/// What is known of a landing when it is over: one table, from which come the struct, the columns
/// of the ledger, the JSON and the text of `land`, the metrics of a calibration, the report of the
/// public interface and `bolter keys --results`. A new result is one row.
///
/// Rows R(KIND, name, unit, label, shown, text):
///   KIND    OUTCOME, MODE, FLAG, COUNT (int64_t)      member name; write _ for the unit
///           REAL    double name_unit
///           LEGS    double name_unit[BT_LEG_COUNT]    columns name_nose_unit, _left_, _right_
///           BOUNCES int bounce_count and bt_bounce[]  columns bounce_count, bounce_height_m, ...
///           CONTACTS int contact_count and bt_contact[]  no columns: a table of their own
///           REMARKS bt_remarks                        one column of text
///           FAILURE failed_element, failed_quantity, failed_time_s
///           HASH    uint64_t
///   unit    SI, a token of base/units.h
///   label   of the line for people; "" leaves it out there
///   shown   the unit of that line, as people type it
///   text    meaning: what is positive, when there is none
#ifndef BT_LANDING_RESULT_H
#define BT_LANDING_RESULT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum bt_outcome { BT_MISSED, BT_ENGAGED, BT_FAILED } bt_outcome;

/// M(NAME, name, text)
#define BT_MODES(M)                                                                                \
    M(NONE, none, "failed runs")                                                                   \
    M(DIRECT, direct, "the cable went straight into the throat")                                   \
    M(ARM, arm, "the cable slid down the arm into the throat")                                     \
    M(BOUNCED_OVER, bounced_over, "the hook had bounced and crossed clear above the cable")        \
    M(PASSED_OVER, passed_over,                                                                    \
      "the hook crossed clear above the cable before it touched the deck")                         \
    M(RIDDEN_OVER, ridden_over, "the point touched the cable and went over it")                    \
    M(PASSED_BESIDE, passed_beside, "the hook passed beyond the end of the cable")                 \
    M(STOPPED, stopped, "the aircraft came to rest before it had passed the cable")

#define BT_MODE_ENUM(NAME, name, text) BT_MODE_##NAME,
typedef enum bt_mode { BT_MODES(BT_MODE_ENUM) BT_MODE_COUNT } bt_mode;

const char* bt_outcome_name(bt_outcome outcome); ///< "engaged", "missed", "failed"
const char* bt_mode_name(bt_mode mode);          ///< "direct", ...; "none"
const char* bt_mode_text(bt_mode mode);          ///< one clause for people

enum { BT_LEG_NOSE, BT_LEG_LEFT, BT_LEG_RIGHT, BT_LEG_COUNT };
extern const char* const bt_leg_names[BT_LEG_COUNT]; ///< "nose", "left", "right"

// --- remarks --------------------------------------------------------------------------------

/// What a person should know of a landing beside its outcome: a state at the edge of what the
/// model describes. M(NAME, what, element, text); the three legs stand in the order of BT_LEG_*.
#define BT_REMARKS(M)                                                                              \
    M(STRUT_BOTTOMED_NOSE, strut_bottomed, nose, "the strut has reached the end of its stroke")    \
    M(STRUT_BOTTOMED_LEFT, strut_bottomed, left, "the strut has reached the end of its stroke")    \
    M(STRUT_BOTTOMED_RIGHT, strut_bottomed, right, "the strut has reached the end of its stroke")  \
    M(TYRE_ON_RIM_NOSE, tyre_on_rim, nose, "the tyre is pressed flat against its rim")             \
    M(TYRE_ON_RIM_LEFT, tyre_on_rim, left, "the tyre is pressed flat against its rim")             \
    M(TYRE_ON_RIM_RIGHT, tyre_on_rim, right, "the tyre is pressed flat against its rim")           \
    M(HOOK_STOP_HIT, hook_stop_hit, hook, "the hook has swung against its stop")                   \
    M(TAIL_CLEARANCE, tail_clearance, fuselage, "the tail has come down to the deck")

#define BT_REMARK_ENUM(NAME, what, element, text) BT_REMARK_##NAME,
typedef enum bt_remark { BT_REMARKS(BT_REMARK_ENUM) BT_REMARK_COUNT } bt_remark;

/// Which remarks a landing earned, and when first. All zero: none.
typedef struct bt_remarks {
    uint32_t seen; ///< bit set: 1 << bt_remark
    double time_s[BT_REMARK_COUNT];
} bt_remarks;
_Static_assert(BT_REMARK_COUNT <= 32, "the remarks are bits of 32");

typedef struct bt_remark_info {
    const char *what, *element, *text;
} bt_remark_info;
extern const bt_remark_info bt_remark_table[BT_REMARK_COUNT];

/// Notes a remark; of one that was seen before, the first time stays.
void bt_remarks_note(bt_remarks* remarks, bt_remark remark, double time_s);
bool bt_remarks_has(const bt_remarks* remarks, bt_remark remark);

enum { BT_REMARKS_TEXT_SIZE = 64 * BT_REMARK_COUNT };

/// "strut_bottomed left 0.125; hook_stop_hit hook 0.25", in the order of the table; "" for none.
/// Times read back to the same double.
void bt_remarks_print(const bt_remarks* remarks, char* text, size_t size);

/// Reads that text; what no remark is called is passed over (a later version wrote it).
void bt_remarks_parse(const char* text, bt_remarks* remarks);

// --- the table ------------------------------------------------------------------------------

enum {
    BT_BOUNCE_MAX = 16,
    BT_CONTACT_MAX = 8, ///< one per wire of a deck
    BT_FAILED_TEXT_SIZE = 128,
};

// clang-format off
#define BT_BOUNCE_FIELDS(R) \
    R(REAL, height, m, "", mm, "height of the shoe above the deck at the top of the bounce; 0 without a bounce") \
    R(REAL, distance, m, "", m, "way along the deck from leaving it to touching it again") \
    R(REAL, impact_force, N, "", kN, "peak deck force of the impact that began the bounce") \
    R(FLAG, complete, _, "", _, "the hook came down on the deck again; false: the bounce was cut short")

#define BT_CONTACT_FIELDS(R) \
    R(COUNT, wire, _, "", _, "number of the wire, from 1 in the order in which they are met") \
    R(MODE, mode, _, "", _, "how it was caught or missed") \
    R(REAL, margin, m, "", mm, "cable centre above lip centre when they meet: positive catches; none beyond the end of the cable") \
    R(REAL, time, s, "", s, "first contact of hook and cable, or when the hook crossed it without one") \
    R(REAL, throat_force_peak, N, "", kN, "peak force of the cable in the throat") \
    R(REAL, tension_max, N, "", kN, "largest tension anywhere along the cable; 0 when nothing met it")

#define BT_LANDING_RESULT_FIELDS(R) \
    R(OUTCOME, outcome, _, "", _, "engaged: the throat caught the cable; missed; failed: no answer") \
    R(MODE, mode, _, "", _, "how it was caught or missed") \
    R(COUNT, wire, _, "", _, "number of the wire that was caught, from 1 in the order in which they are met; 0 for none") \
    R(CONTACTS, contacts, _, "", _, "the hook's meetings with the wires, in their order; none in a failed run") \
    R(FLAG, retained, _, "cable held", _, "the throat still held the cable when the run ended") \
    R(REAL, margin, m, "margin", mm, "cable centre above lip centre when they meet: positive catches; none in a failed run") \
    R(REAL, throat_force_peak, N, "throat force", kN, "peak force of the cable in the throat") \
    R(REAL, time_of_contact, s, "cable met", s, "first contact of hook and cable, after first deck contact; none without one") \
    R(BOUNCES, bounces, _, "", _, "bounces of the hook on the deck, in order") \
    R(REAL, hook_deck_force_peak, N, "hook on deck", kN, "peak normal force of the deck on the hook; not calibrated (docs/theory/shank.md)") \
    R(FLAG, shank_bends, _, "", _, "the shank of the hook that landed may bend") \
    R(LEGS, strut_stroke_max, m, "strut stroke", mm, "largest strut stroke") \
    R(LEGS, tyre_force_max, N, "tyre force", kN, "largest tyre force, deck and cable") \
    R(REAL, cable_tension_max, N, "cable tension", kN, "largest tension anywhere along the cable; 0 when nothing met it") \
    R(REMARKS, remarks, _, "", _, "states at the edge of what the model describes, and when first") \
    R(COUNT, steps, _, "", _, "airframe steps") \
    R(COUNT, cable_steps, _, "", _, "cable steps") \
    R(REAL, end_time, s, "", s, "end of the run, after first deck contact") \
    R(FAILURE, failed, _, "", _, "what made a failed run impossible") \
    R(HASH, state_hash, _, "", _, "of the final state: equal for runs that are equal to the bit") \
    R(REAL, wall, s, "", s, "computing time; differs from run to run")
// clang-format on

#define BT_RESULT_MEMBER_OUTCOME(name, unit) bt_outcome name;
#define BT_RESULT_MEMBER_MODE(name, unit) bt_mode name;
#define BT_RESULT_MEMBER_FLAG(name, unit) bool name;
#define BT_RESULT_MEMBER_COUNT(name, unit) int64_t name;
#define BT_RESULT_MEMBER_REAL(name, unit) double name##_##unit;
#define BT_RESULT_MEMBER_LEGS(name, unit) double name##_##unit[BT_LEG_COUNT];
#define BT_RESULT_MEMBER_BOUNCES(name, unit)                                                       \
    int bounce_count;                                                                              \
    bt_bounce name[BT_BOUNCE_MAX];
#define BT_RESULT_MEMBER_CONTACTS(name, unit)                                                      \
    int contact_count;                                                                             \
    bt_contact name[BT_CONTACT_MAX];
#define BT_RESULT_MEMBER_REMARKS(name, unit) bt_remarks name;
#define BT_RESULT_MEMBER_FAILURE(name, unit)                                                       \
    char name##_element[BT_FAILED_TEXT_SIZE], name##_quantity[BT_FAILED_TEXT_SIZE];                \
    double name##_time_s;
#define BT_RESULT_MEMBER_HASH(name, unit) uint64_t name;
#define BT_RESULT_MEMBER(KIND, name, unit, label, shown, text) BT_RESULT_MEMBER_##KIND(name, unit)

typedef struct bt_bounce {
    BT_BOUNCE_FIELDS(BT_RESULT_MEMBER)
} bt_bounce;

/// The hook's meeting with one wire.
typedef struct bt_contact {
    BT_CONTACT_FIELDS(BT_RESULT_MEMBER)
} bt_contact;

typedef struct bt_landing_result {
    BT_LANDING_RESULT_FIELDS(BT_RESULT_MEMBER)
} bt_landing_result;

// --- one scalar at a time -------------------------------------------------------------------

typedef enum bt_result_kind {
    BT_RESULT_OUTCOME,
    BT_RESULT_MODE,
    BT_RESULT_FLAG,
    BT_RESULT_INT, ///< int
    BT_RESULT_COUNT,
    BT_RESULT_REAL,
    BT_RESULT_TEXT, ///< char[BT_FAILED_TEXT_SIZE]
    BT_RESULT_REMARKS,
    BT_RESULT_HASH,
} bt_result_kind;

/// One scalar of the table: a column of the ledger and of a CSV file, a metric.
typedef struct bt_result_column {
    bt_result_kind kind;
    const char* name;     ///< "strut_stroke_max_nose_m"
    const char* quantity; ///< the same without its unit: what a metric is called
    const char* unit;     ///< token; "" where there is none
    const char* part;     ///< "nose", "left", "right"; "" else
    const char* text;     ///< meaning
    size_t offset;        ///< in bt_landing_result
    int bounce;           ///< 1, 2: of the first, of the second bounce; 0: of the landing
} bt_result_column;

extern const bt_result_column bt_result_columns[];
extern const int bt_result_column_count;

/// Of a meeting, with offsets in bt_contact: the columns of the ledger's table `contacts`.
extern const bt_result_column bt_contact_columns[];
extern const int bt_contact_column_count;

/// A REAL as a metric sees it: of a bounce that never was, or that was cut short, NAN.
double bt_result_real(const bt_result_column* column, const bt_landing_result* result);

#endif
