/// Verification rigs: what a laboratory does to one leg or to the hook  [Peng2023 Sec. 3].
#ifndef BT_RIGS_RIGS_H
#define BT_RIGS_RIGS_H

#include "landing/params.h"

// clang-format off
#define BT_DROP_REFERENCE_FIELDS(F)                                                                \
    F(REAL, stroke_max, m, OPTIONAL, 0, 0, 10, "Tables 1-2", "measured largest strut stroke; 0: none") \
    F(REAL, sinkage_max, m, OPTIONAL, 0, 0, 10, "Tables 1-2", "measured largest sinkage of the centre of gravity; 0: none") \
    F(REAL, tyre_compression_max, m, OPTIONAL, 0, 0, 5, "Table 1", "measured largest tyre compression; 0: none") \
    F(REAL, tyre_force_max, N, OPTIONAL, 0, 0, 1e9, "Tables 1-2", "measured peak vertical tyre load; 0: none") \
    F(REAL, strut_force_max, N, OPTIONAL, 0, 0, 1e9, "", "measured largest load of the strut; 0: none") \
    F(PLAIN, efficiency, _, OPTIONAL, 0, 0, 2, "", "measured efficiency of the strut; 0: none") \
    F(REAL, strut_energy, J, OPTIONAL, 0, 0, 1e9, "", "measured energy that the strut takes up; 0: none") \
    F(REAL, tyre_energy, J, OPTIONAL, 0, 0, 1e9, "", "measured energy stored in the tyre; 0: none") \
    F(PLAIN, tyre_efficiency, _, OPTIONAL, 0, 0, 2, "", "measured efficiency of the tyre; 0: none") \
    F(PLAIN, tolerance, _, OPTIONAL, 0.03, 0, 1, "Tables 1-2", "error that is accepted, as a share") \
    F(PLAIN, stroke_max_tolerance, _, OPTIONAL, 0, 0, 1, "", "the same for one value; 0: `tolerance` holds") \
    F(PLAIN, sinkage_max_tolerance, _, OPTIONAL, 0, 0, 1, "", "as above") \
    F(PLAIN, tyre_compression_max_tolerance, _, OPTIONAL, 0, 0, 1, "", "as above") \
    F(PLAIN, tyre_force_max_tolerance, _, OPTIONAL, 0, 0, 1, "", "as above") \
    F(PLAIN, strut_force_max_tolerance, _, OPTIONAL, 0, 0, 1, "", "as above") \
    F(PLAIN, efficiency_tolerance, _, OPTIONAL, 0, 0, 1, "", "as above") \
    F(PLAIN, strut_energy_tolerance, _, OPTIONAL, 0, 0, 1, "", "as above") \
    F(PLAIN, tyre_energy_tolerance, _, OPTIONAL, 0, 0, 1, "", "as above") \
    F(PLAIN, tyre_efficiency_tolerance, _, OPTIONAL, 0, 0, 1, "", "as above")
BT_DECLARE_GROUP(drop_reference, BT_DROP_REFERENCE_FIELDS)

#define BT_DROP_FIELDS(F)                                                                          \
    F(REAL, mass, kg, REQUIRED, 9100, 1, 1e6, "Sec. 3.1", "everything that falls, leg included") \
    F(REAL, sink_speed, mps, REQUIRED, 6, 0, 20, "Sec. 3.1", "vertical speed at touchdown; not needed where drop_height is given") \
    F(REAL, drop_height, m, OPTIONAL, 0, 0, 50, "", "height of a free fall h before touchdown, sink_speed = sqrt(2 g h); 0: sink_speed holds") \
    F(PLAIN, lift_ratio, _, OPTIONAL, 1, 0, 2, "", "lift over weight after touchdown; 0: free drop") \
    F(REAL, belt_speed, mps, OPTIONAL, 0, -150, 150, "", "speed of the belt under the wheel, backward positive (spin-up); 0: platform at rest") \
    F(REAL, gravity, mps2, OPTIONAL, 9.80665, 0, 100, "", "acceleration of gravity") \
    F(REAL, duration, s, OPTIONAL, 0.4, 1e-3, 60, "", "simulated time after touchdown [assumed]") \
    F(REAL, step, s, OPTIONAL, 3e-4, 1e-7, 1e-2, "", "largest time step, shortened where damping or stiffness of the unsprung mass asks for it; the metrics change by less than 0.01 % when it is halved") \
    F(GROUP, reference, drop_reference, OPTIONAL, 0, 0, 0, "Tables 1-2", "the measurement to compare with")
BT_DECLARE_GROUP(drop, BT_DROP_FIELDS)

#define BT_REBOUND_REFERENCE_FIELDS(F)                                                             \
    F(REAL, rebound_height, m, OPTIONAL, 0, 0, 10, "Table 3", "measured height of the first bounce; 0: none") \
    F(REAL, bounce_distance, m, OPTIONAL, 0, 0, 1e3, "", "measured length of the first bounce; 0: none") \
    F(REAL, impact_force, N, OPTIONAL, 0, 0, 1e9, "Table 3", "measured peak load of the first impact; 0: none") \
    F(REAL, damper_stroke_max, m, OPTIONAL, 0, 0, 10, "", "measured largest stroke of the damper; 0: none") \
    F(PLAIN, tolerance, _, OPTIONAL, 0.05, 0, 1, "Table 3", "error that is accepted, as a share")
BT_DECLARE_GROUP(rebound_reference, BT_REBOUND_REFERENCE_FIELDS)

#define BT_REBOUND_FIELDS(F)                                                                       \
    F(REAL, sink_speed, mps, REQUIRED, 3.6, 0.01, 20, "Sec. 3.3", "sinking velocity of the basket at first contact") \
    F(REAL, rim_speed, mps, REQUIRED, 47.5, 0, 150, "Sec. 3.3", "speed of the disc's rim under the hook, backward positive") \
    F(REAL, pitch, rad, OPTIONAL, 0, -0.35, 0.35, "Sec. 3.3", "angle of the basket's fuselage axis, nose up positive") \
    F(REAL, coating_stiffness, Npm15, OPTIONAL, 0, 0, 1e15, "Sec. 3.3", "Hertz stiffness of the disc's coating, in series with the hook's deck_contact; 0: none") \
    F(REAL, basket_mass, kg, OPTIONAL, 600, 1, 1e6, "", "mass of the basket without the hook [assumed]") \
    F(PLAIN, lift_ratio, _, OPTIONAL, 1, 0, 2, "", "share of the weight that the basket's balance carries [assumed]") \
    F(REAL, buffer_stiffness, Npm, OPTIONAL, 8.6e3, 0, 1e9, "", "spring that stops the basket, from first contact on [assumed]") \
    F(REAL, buffer_damping, Npmps, OPTIONAL, 4.5e3, 0, 1e9, "", "damper that stops the basket, from first contact on [assumed]") \
    F(REAL, gravity, mps2, OPTIONAL, 9.80665, 0, 100, "", "acceleration of gravity") \
    F(REAL, duration, s, OPTIONAL, 0.5, 1e-3, 60, "", "longest simulated time; the run ends with the second impact [assumed]") \
    F(REAL, step, s, OPTIONAL, 2e-4, 1e-7, 1e-2, "", "time step while the hook is clear of the disc [assumed]") \
    F(REAL, contact_step, s, OPTIONAL, 2e-5, 1e-7, 1e-3, "", "time step at the disc [assumed]") \
    F(GROUP, reference, rebound_reference, OPTIONAL, 0, 0, 0, "Table 3", "the measurement to compare with")
BT_DECLARE_GROUP(rebound, BT_REBOUND_FIELDS)

#define BT_STATIC_REFERENCE_FIELDS(F)                                                              \
    F(REAL, load_extended, N, OPTIONAL, 0, 0, 1e9, "", "measured load at which the strut leaves its stop; 0: none") \
    F(REAL, load_compressed, N, OPTIONAL, 0, 0, 1e9, "", "measured load at the end of the stroke; 0: none") \
    F(REAL, energy, J, OPTIONAL, 0, 0, 1e9, "", "measured work of the press; 0: none") \
    F(PLAIN, tolerance, _, OPTIONAL, 0.03, 0, 1, "", "error that is accepted, as a share; holds for the points of `curve` too")
BT_DECLARE_GROUP(static_reference, BT_STATIC_REFERENCE_FIELDS)

#define BT_STATIC_FIELDS(F)                                                                        \
    F(REAL, stroke, m, OPTIONAL, 0, 0, 10, "", "how far the strut is pressed together; 0: stroke_max") \
    F(REAL, speed, mps, OPTIONAL, 1e-3, 1e-6, 1, "", "speed of the press: the oil resists as little as it does then [assumed]") \
    F(COUNT, points, _, OPTIONAL, 400, 10, 100000, "", "steps of the press") \
    F(GROUP, reference, static_reference, OPTIONAL, 0, 0, 0, "", "the measurement to compare with")
BT_DECLARE_GROUP(static, BT_STATIC_FIELDS)

#define BT_RIGS_FIELDS(F)                                                                          \
    F(GROUP, nose_drop, drop, OPTIONAL, 0, 0, 0, "Table 1", "drop test of the nose gear") \
    F(GROUP, main_drop, drop, OPTIONAL, 0, 0, 0, "Table 2", "drop test of one main gear") \
    F(GROUP, hook_rebound, rebound, OPTIONAL, 0, 0, 0, "Table 3", "hook on a falling basket over a rotating disc") \
    F(GROUP, nose_static, static, OPTIONAL, 0, 0, 0, "", "static load over stroke of the nose gear") \
    F(GROUP, main_static, static, OPTIONAL, 0, 0, 0, "", "static load over stroke of one main gear")
BT_DECLARE_GROUP(rigs, BT_RIGS_FIELDS)
// clang-format on

typedef enum bt_rig_kind {
    BT_RIG_NOSE_DROP,
    BT_RIG_MAIN_DROP,
    BT_RIG_HOOK_REBOUND,
    BT_RIG_NOSE_STATIC,
    BT_RIG_MAIN_STATIC,
    BT_RIG_COUNT
} bt_rig_kind;

extern const char* const bt_rig_keys[]; ///< "nose_drop", "main_drop", "hook_rebound", ..., NULL

/// Whether a rig tests the nose gear; the hook's does not.
bool bt_rig_is_nose(bt_rig_kind kind);

/// One number that a rig reports.
typedef struct bt_metric {
    const char* name; ///< with its unit, as a key: "stroke_max_m"
    const char* unit; ///< token: "m"
    double value;
    double reference;     ///< NAN where there is none
    double error_percent; ///< difference of the value from the reference; NAN where there is none
    double tolerance;     ///< error that is accepted, as a share; NAN where there is no reference
    bool accepted;        ///< no reference, or an error within its tolerance
} bt_metric;

enum { BT_METRIC_MAX = 20, BT_RIG_REMARK_MAX = 8 };

/// What an element had to say of its state: the part was at the end of its range.
typedef struct bt_rig_remark {
    char element[24]; ///< "strut"
    const char* what; ///< "strut bottomed"
    double time_s;    ///< when first
} bt_rig_remark;

typedef struct bt_rig_result {
    int metric_count;
    bt_metric metrics[BT_METRIC_MAX];
    int remark_count;
    bt_rig_remark remarks[BT_RIG_REMARK_MAX];
    int64_t steps;
    double end_time_s;
} bt_rig_result;

/// One line of a rig's time histories. Names carry their units; both arrays are valid during the
/// call only.
typedef struct bt_rig_sample {
    double time_s;
    int count;
    const char* const* names;
    const double* values;
} bt_rig_sample;

/// Called at the start and after every step.
typedef void bt_rig_observer(void* user, const bt_rig_sample* sample);

enum { BT_RIG_CHANNEL_MAX = 16 };

/// The names of a rig's histories, in the order of bt_rig_sample.values.
const char* const* bt_rig_channels(bt_rig_kind kind, int* count);

/// Runs the rig of a kind on the part of the aircraft that it tests; see the two below.
BT_CHECKED bt_status bt_rig_run(bt_rig_kind kind, const bt_aircraft_params* aircraft,
                                const bt_rigs_params* rigs, bt_rig_result* result,
                                bt_rig_observer* observer, void* user, bt_diag* diag);

/// Drop of one leg, telescopic or levered: the mass falls on it in guides, the wheel turns freely
/// over a platform or belt.
///
/// Metrics: stroke_max_m; sinkage_max_m (of the dropped mass above the strut, from touchdown);
/// tyre_compression_max_m; tyre_force_max_N; strut_force_max_N; drag_force_max_N;
/// side_force_max_N (across the strut on its bearings; at the pivot of an arm); efficiency (work
/// done on the strut until its largest stroke, over peak force times that stroke); spin_up_time_s
/// (until 99 % of the belt's speed, NAN without belt or when it is not reached). strut_energy_J
/// (work done on the strut until its largest stroke); tyre_energy_J (most that the tyre stores);
/// tyre_efficiency (that energy over its peak load times compression).
///
/// Energy balance, all over the whole run: impact_energy_J (kinetic, at touchdown) + weight_work_J
/// (weight less lift, on the way) = strut_taken_J + tyre_taken_J (stored or dissipated; the tyre's
/// less what a belt gives) + left_J (kinetic, at the end) + energy_residual_J (error of the
/// integration).
///
/// @param gear      checked parameters of the leg (station and track do not matter here)
/// @param drop      checked parameters of the test
/// @param result    filled when BT_OK is returned
/// @param observer  may be NULL
/// @return BT_OK; BT_ERR_INPUT when the drop mass is not above that of the leg, BT_ERR_NUMERIC when
///         the motion diverges or an element leaves its law (all said in diag); BT_ERR_MEMORY
///
/// Tests: test_rigs.c, test_gear_drop.c.
BT_CHECKED bt_status bt_rig_run_drop(const bt_gear_params* gear, const bt_drop_params* drop,
                                     bt_rig_result* result, bt_rig_observer* observer, void* user,
                                     bt_diag* diag);

/// Static test of one strut: a press shortens it slowly, then lets it out again. Nothing moves
/// freely, so this is the law of the strut itself: gas or spring, stops, and friction fully
/// developed against the motion.
///
///     F(s) = F_a(s) + F_l(s) + F_h(s, v) +- F_f(s)
///
/// Metrics: load_extended_N and load_compressed_N (while shortening, at both ends of the stroke),
/// energy_J (work of the press), hysteresis_J (what it does not get back). Histories: stroke, load
/// while shortening, load while extending.
///
/// Arguments as bt_rig_run_drop. BT_ERR_INPUT, said in diag, when the stroke leaves no gas volume.
/// Tests: test_rigs.c, test_gear_drop.c.
BT_CHECKED bt_status bt_rig_run_static(const bt_gear_params* gear, const bt_static_params* press,
                                       bt_rig_result* result, bt_rig_observer* observer, void* user,
                                       bt_diag* diag);

/// Rebound of the hook: a basket sinks in guides with the hook on its joint and damper, until the
/// head meets the rim of a rotating disc. The rim is a plane; its speed is given to the guides
/// instead, which is the same motion seen from the rim.
///
/// Metrics: rebound_height_m and bounce_distance_m of the first bounce (NAN when the run ends in
/// the air), impact_force_N (peak of the first impact), damper_stroke_max_m, restitution (speed of
/// the head's lowest point when it leaves the disc for the first bounce over that at impact).
/// Energy balance as for the drop, seen by somebody who moves along with the rim's speed:
/// impact_energy_J + weight_work_J = damper_taken_J + buffer_taken_J + disc_taken_J (the hook's
/// contact; less what the disc gives by friction) + left_J + energy_residual_J.
///
/// Arguments and errors as bt_rig_run_drop.
BT_CHECKED bt_status bt_rig_run_rebound(const bt_hook_params* hook,
                                        const bt_rebound_params* rebound, bt_rig_result* result,
                                        bt_rig_observer* observer, void* user, bt_diag* diag);

#endif
