/// What an observer of a landing may look at: everything in SI, nothing to be changed.
#ifndef BT_LANDING_VIEW_H
#define BT_LANDING_VIEW_H

#include "landing/landing.h"
#include "landing/profile.h"

enum {
    BT_BODY_FUSELAGE,
    BT_BODY_NOSE_PISTON,
    BT_BODY_LEFT_PISTON,
    BT_BODY_RIGHT_PISTON,
    BT_BODY_NOSE_WHEEL,
    BT_BODY_LEFT_WHEEL,
    BT_BODY_RIGHT_WHEEL,
    BT_BODY_HOOK,
    BT_BODY_COUNT
};
extern const char* const bt_body_names[BT_BODY_COUNT];

/// What a history keeps of every step, one row each: struct member, HDF5 dataset, CSV column,
/// column of a calibration's curve. V(KIND, group, name, unit, text):
///   KIND   REAL    double name_unit          dataset group/name_unit (a name that begins with its
///                                            group does not say it twice: hook/angle_rad)
///          VECTOR  double name_unit[3]       columns name_x_unit, _y_, _z_: x forward, y to port
///          LEGS    double name_unit[BT_LEG_COUNT]    columns nose_name_unit, left_, right_
///          ZONES   double name_unit[BT_ZONE_COUNT]   columns name_shoe_unit, _point_, ...
// clang-format off
#define BT_VIEW_FIELDS(V) \
    V(REAL, , time, s, "time since the first contact of any part with the deck") \
    V(REAL, hook, hook_angle, rad, "shank below the fuselage axis") \
    V(REAL, hook, hook_height, m, "lowest point of the head above the deck") \
    V(VECTOR, hook, hook_shoe, m, "centre of the shoe arc; the cable rests at x = 0") \
    V(VECTOR, hook, hook_lip, m, "centre of the lip") \
    V(REAL, hook, hook_deck_force, N, "normal force of the deck on the head") \
    V(REAL, hook, hook_damper_force, N, "force of the longitudinal damper") \
    V(VECTOR, hook, hook_pivot_force, N, "force of the fuselage on the hook, world") \
    V(ZONES, hook, zone_force, N, "normal force of the cable on a zone of the head") \
    V(LEGS, legs, stroke, m, "strut stroke") \
    V(LEGS, legs, strut_force, N, "strut force") \
    V(LEGS, legs, strut_side_force, N, "force across the strut, of the fuselage on the piston; of a levered leg, at the arm's pivot") \
    V(LEGS, legs, tyre_deflection, m, "tyre deflection") \
    V(LEGS, legs, tyre_force, N, "tyre force from deck and cable") \
    V(LEGS, legs, tyre_cable_force, N, "part of the tyre force that lies on the cable") \
    V(LEGS, legs, wheel_spin, radps, "wheel speed") \
    V(REAL, airframe, energy, J, "kinetic, gravity and spring energy of the airframe") \
    V(REAL, contact, cable_work, J, "work of wheels and hook on the cable, so far") \
    V(REAL, contact, friction, J, "work of friction between them, so far: it never rises")
// clang-format on

#define BT_VIEW_MEMBER_REAL(name, unit) double name##_##unit;
#define BT_VIEW_MEMBER_VECTOR(name, unit) double name##_##unit[3];
#define BT_VIEW_MEMBER_LEGS(name, unit) double name##_##unit[BT_LEG_COUNT];
#define BT_VIEW_MEMBER_ZONES(name, unit) double name##_##unit[BT_ZONE_COUNT];
#define BT_VIEW_MEMBER(KIND, group, name, unit, text) BT_VIEW_MEMBER_##KIND(name, unit)

typedef struct bt_landing_view {
    BT_VIEW_FIELDS(BT_VIEW_MEMBER)
    int64_t step;
    bool last; ///< the final call of the run

    const double* q;        ///< [7 * BT_BODY_COUNT] x y z (m), e0..e3; the cable rests at x = 0
    const double* v;        ///< [6 * BT_BODY_COUNT] m/s in the world, rad/s in the body
    const double* rotation; ///< [9 * BT_BODY_COUNT] row-major, body to world

    // what passes between the cable and wheels and hook
    const double* cable_wrench; ///< [6 * BT_BODY_COUNT] on the bodies, mean of the last step: N in
                                ///< the world, N m in the body
    double friction_most_J;     ///< the largest of one cable step, so far; -INFINITY before any

    // of wire 1, which rests at x = 0 (forces of the cable are those of all wires)
    bool cable_awake; ///< false while it still lies in its equilibrium
    int cable_count;
    const double *cable_x, *cable_y, *cable_z; ///< [cable_count] centres of the segments
    const double* cable_tension_N;             ///< [cable_count - 1] between neighbours
    const struct bt_landing_model* model;      ///< for bt_landing_cable_energy
    struct bt_landing_state* state;
} bt_landing_view;

/// One scalar of the table.
typedef struct bt_view_column {
    const char* name;     ///< "nose_stroke_m"
    const char* quantity; ///< "nose_stroke"
    const char* unit;     ///< token
    const char* text;
    size_t offset; ///< offset of a double in bt_landing_view
} bt_view_column;

extern const bt_view_column bt_view_columns[];
extern const int bt_view_column_count;
static inline double bt_view_real(const bt_view_column* column, const bt_landing_view* view) {
    return *(const double*)((const char*)view + column->offset);
}

/// Energy of the cables, their supports and deck contact, J: kinetic, elastic and gravity.
double bt_landing_cable_energy(const bt_landing_view* view);

#endif
