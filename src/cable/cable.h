/// The arresting cable: a chain of rigid cylinders with six degrees of freedom each, joined by
/// axial, shear, bending and torsion springs and dampers  [Peng2023 Eqs. 11-17], lying on the deck
/// and its supports, held by the purchase cable behind two sheaves. docs/theory/cable.md has the
/// derivation, what differs from the paper, and the tests.
///
/// Frame: the deck frame (x forward, y to port, z up, deck z = 0); the rope runs along y from
/// segment 0 (starboard, -y) to segment count - 1 (port, +y). SI units.
#ifndef BT_CABLE_CABLE_H
#define BT_CABLE_CABLE_H

#include "base/arena.h"
#include "base/diag.h"
#include "base/fields.h"
#include "base/status.h"
#include "mechanics/frame.h"

#include <stdbool.h>
#include <stddef.h>

// clang-format off
#define BT_CABLE_MESH_FIELDS(F)                                                                    \
    F(REAL, fine_length, m, OPTIONAL, 0.05, 0.005, 2, "Eq. 11", "segment length where wheels and hook meet the cable") \
    F(REAL, fine_half_width, m, OPTIONAL, 3.0, 0, 50, "", "the fine segments lie within this distance of the middle") \
    F(REAL, medium_length, m, OPTIONAL, 0.1, 0.005, 2, "Eq. 11", "segment length outside the fine part") \
    F(REAL, medium_half_width, m, OPTIONAL, 7.0, 0, 50, "", "the medium segments lie within this distance of the middle; it should reach past the first supports") \
    F(REAL, coarse_length, m, OPTIONAL, 0.3, 0.005, 2, "Eq. 11", "segment length outside the medium part") \
    F(PLAIN, growth, _, OPTIONAL, 1.1, 1.02, 10, "", "largest ratio of neighbouring segment lengths where the length changes [assumed]")
BT_DECLARE_GROUP(cable_mesh, BT_CABLE_MESH_FIELDS)

#define BT_CABLE_SUPPORTS_FIELDS(F)                                                                \
    F(REAL, first, m, OPTIONAL, 6.0, 0.3, 50, "", "distance of the first support on each side from the middle") \
    F(REAL, spacing, m, OPTIONAL, 6.0, 0.5, 50, "", "distance between supports further out; none nearer than half of it to a sheave") \
    F(REAL, height, m, OPTIONAL, 0.103, 0.001, 1, "", "top of the unloaded support above the deck; the cable's underside lies on it") \
    F(REAL, stiffness, Npm, OPTIONAL, 50e3, 1e2, 1e7, "", "one-sided spring under the cable; it flattens to the deck [assumed]") \
    F(REAL, damping, Npmps, OPTIONAL, 100, 0, 1e5, "", "damping while the cable lies on it [assumed]")
BT_DECLARE_GROUP(cable_supports, BT_CABLE_SUPPORTS_FIELDS)

#define BT_CABLE_DECK_FIELDS(F)                                                                    \
    F(REAL, stiffness, Npm2, OPTIONAL, 5e8, 1e6, 1e12, "", "deck contact: force per metre of cable and metre of penetration [assumed]") \
    F(PLAIN, restitution, _, OPTIONAL, 0.3, 0.14, 1, "", "rebound over impact speed of a piece of cable on the deck [assumed]") \
    F(PLAIN, friction, _, OPTIONAL, 0.3, 0, 2, "", "Coulomb friction, cable on deck [assumed]") \
    F(REAL, slip_speed, mps, OPTIONAL, 0.1, 1e-4, 10, "", "sliding speed at which friction reaches 0.71 of its value [assumed]")
BT_DECLARE_GROUP(cable_deck, BT_CABLE_DECK_FIELDS)

#define BT_CABLE_SHEAVES_FIELDS(F)                                                                 \
    F(REAL, height, m, OPTIONAL, 0.1, 0, 2, "", "centre of the cable above the deck where it leaves the sheave [assumed]") \
    F(REAL, purchase_stiffness, Npm, OPTIONAL, 5e5, 0, 1e9, "", "purchase cable below deck: spring along the cable [assumed: 100 m of the same rope]") \
    F(REAL, purchase_damping, Npmps, OPTIONAL, 1.68e4, 0, 1e6, "", "purchase cable: damping along the cable [assumed: sqrt(EA mass), swallows an axial wave]")
BT_DECLARE_GROUP(cable_sheaves, BT_CABLE_SHEAVES_FIELDS)

#define BT_CABLE_FIELDS(F)                                                                         \
    F(REAL, span, m, OPTIONAL, 36.0, 2, 200, "", "distance of the two sheaves") \
    F(REAL, diameter, m, OPTIONAL, 0.0365, 0.002, 0.2, "Eq. 11", "diameter of the rope") \
    F(REAL, mass, kgpm, OPTIONAL, 5.536, 0.01, 100, "Eq. 11", "mass per metre") \
    F(REAL, axial_stiffness, N, OPTIONAL, 5.1e7, 1e3, 1e10, "Eq. 12", "K0 axial: EA") \
    F(REAL, bending_stiffness, Nm2, OPTIONAL, 150, 0, 1e5, "Eq. 14", "K0 bending: EI") \
    F(REAL, twist_stiffness, Nm2, OPTIONAL, 60, 0, 1e5, "Eq. 16", "K0 twist: GJ") \
    F(REAL, axial_damping, Ns, OPTIONAL, 40, 0, 1e5, "Eq. 13", "C0 axial; the step pays for more than 40 N s at 0.05 m segments [assumed]") \
    F(REAL, bending_damping, Nm2s, OPTIONAL, 0.03, 0, 100, "Eq. 15", "C0 bending; the step pays for more at short segments [assumed]") \
    F(REAL, twist_damping, Nm2s, OPTIONAL, 0.03, 0, 100, "Eq. 17", "C0 twist [assumed]") \
    F(PLAIN, shear_ratio, _, OPTIONAL, 0.3333333333333333, 0.01, 0.6, "", "shear over axial stiffness and damping of a joint; not in the paper [assumed]") \
    F(PLAIN, compression_ratio, _, OPTIONAL, 0.01, 0, 1, "", "stiffness in compression over that in tension: a rope does not push [assumed]") \
    F(REAL, pretension, N, OPTIONAL, 24e3, 1, 1e6, "", "tension at the sheaves at rest") \
    F(PLAIN, wheel_friction, _, OPTIONAL, 0.2, 0, 2, "", "Coulomb friction, tyre on cable; decides where wheels cross it in the air, not turning yet; 0 to 0.8 is likely [assumed]") \
    F(GROUP, mesh, cable_mesh, OPTIONAL, 0, 0, 0, "Eq. 11", "segment lengths") \
    F(GROUP, supports, cable_supports, OPTIONAL, 0, 0, 0, "", "wire supports under the cable") \
    F(GROUP, deck, cable_deck, OPTIONAL, 0, 0, 0, "", "cable on deck") \
    F(GROUP, sheaves, cable_sheaves, OPTIONAL, 0, 0, 0, "", "ends of the cable")
BT_DECLARE_GROUP(cable, BT_CABLE_FIELDS)
// clang-format on

/// What holds an end of the rope.
typedef enum bt_cable_end_kind {
    BT_CABLE_FREE,
    BT_CABLE_PINNED,  ///< held at the anchor by half a joint without bending
    BT_CABLE_CLAMPED, ///< held at the anchor by half a joint, along y
    BT_CABLE_SHEAVE,  ///< held across the rope at the anchor; along it the purchase cable pulls
} bt_cable_end_kind;

typedef struct bt_cable_end {
    bt_cable_end_kind kind;
    double anchor_m[3]; ///< where the end starts and is held; both ends at the same x
    double pretension_N, purchase_stiffness_Npm, purchase_damping_Npmps; ///< sheave only
} bt_cable_end;

/// Instruction-set level of the kernel. BT_KERNEL_BEST: the fastest this machine has.
typedef enum bt_kernel_level {
    BT_KERNEL_BEST,
    BT_KERNEL_V1,
    BT_KERNEL_V3,
    BT_KERNEL_V4
} bt_kernel_level;

/// The level that BT_KERNEL_BEST means on this machine: "v1", "v3", "v4". Landings of two levels
/// differ in the last bits.
const char* bt_cable_best_level(void);

/// A rope in general: the arresting cable is one, the verification cases are others.
typedef struct bt_cable_def {
    int count;              ///< segments, at least 2
    const double* length_m; ///< [count] unstretched; read during creation only
    double diameter_m, mass_kgpm;
    double axial_stiffness_N, bending_stiffness_Nm2, twist_stiffness_Nm2; ///< K0
    double axial_damping_Ns, bending_damping_Nm2s, twist_damping_Nm2s;    ///< C0
    double shear_ratio, compression_ratio;
    double gravity_mps2; ///< gravity of the frame in which a new state starts
    bt_cable_end end[2]; ///< at segment 0 and at segment count - 1
    bool deck;           ///< false: no deck
    bt_cable_deck_params deck_contact;
    bt_list support_y_m; ///< y of each wire support
    bt_cable_supports_params support;
    bt_kernel_level level;
} bt_cable_def;

enum {
    BT_CABLE_SEGMENTS_MAX = 4000,
    BT_CABLE_LANES = 8, ///< arrays are padded to whole vectors of this many doubles
};

struct bt_cable_state;
struct bt_cable_model;

typedef struct bt_cable_kernel {
    const char* name; ///< "v1", "v3", "v4"
    void (*joints)(const struct bt_cable_model*, struct bt_cable_state*);
    void (*resultants)(const struct bt_cable_model*, struct bt_cable_state*);
    void (*advance)(const struct bt_cable_model*, struct bt_cable_state*, double kick_s,
                    double drift_s);
} bt_cable_kernel;

/// Constant after creation. Arrays are 64-byte aligned, [stride], zero beyond their last entry.
typedef struct bt_cable_model {
    int count;        ///< segments; joints 1 .. count - 1 lie between segments joint - 1 and joint
    int padded;       ///< count rounded up to whole vectors
    int stride;       ///< doubles from one array to the next: not a power of two
    bt_cable_def def; ///< length_m is NULL
    double radius_m, contact_damping_Npm2ps;
    const double* half_m;          ///< half the unstretched length of a segment
    const double* mass_kg;         ///< mass of each segment
    const double* inverse_mass;    ///< 1/kg
    const double* inverse_tilt;    ///< 1/I_t, 1/(kg m2): about an axis across the segment
    const double* inverse_spin;    ///< 1/I_a - 1/I_t
    const double* inverse_slide;   ///< 1/kg: what friction at the underside must move
    const double* inverse_spacing; ///< [joint] 1/m: one over the mean of two lengths; 0 at the ends
    const double* rest_y_m;        ///< centres of the segments, straight and at pretension
    double stable_step_s;          ///< bt_cable_stable_step
    bt_cable_kernel kernel;
} bt_cable_model;

/// What changes. Positions and axes are at the time reached; velocities and angular momenta half a
/// step before it (leapfrog). Every pointer points into `block`; copy with bt_cable_state_copy.
typedef struct bt_cable_state {
    double *x, *y, *z;         ///< centre, m
    double *e0, *e1, *e2, *e3; ///< Euler parameters; (1, 0, 0, 0) lies along +y
    double *vx, *vy, *vz;      ///< velocity of the centre, m/s
    double *hx, *hy, *hz;      ///< angular momentum about the centre, deck frame, kg m2/s
    double *wx, *wy, *wz;      ///< angular velocity, deck frame, rad/s (follows from h)
    double *tx, *ty, *tz;      ///< unit axis toward +y (follows from e)
    double *fx, *fy, *fz;      ///< load on a segment's centre, N: set by the caller, kept
    double *mx, *my, *mz;      ///< load torque about the centre, N m: likewise
    double *joint_fx, *joint_fy, *joint_fz; ///< [joint] force on the segment before the joint, N
    double *before_x, *before_y, *before_z; ///< [joint] torque on the segment before the joint
    double *after_x, *after_y, *after_z;    ///< [joint] torque on the segment after it
    double *support_fz, *support_mx;        ///< force of the wire supports, N, and its torque, N m
    double* net[6];                         ///< scratch: resultant force and torque
    struct bt_cable_scalars {
        double time_s, last_step_s;
        bt_frame frame; ///< at the present time; the caller may change it before any step
        double anchor_m[2][3], anchor_velocity_mps[2][3]; ///< the caller may move them
        double anchor_e[2][4];                            ///< attitude a clamped end is held at
        double end_tension_N[2];                          ///< purchase tension (sheaves)
        double support_force_N[BT_LIST_MAX];
        int support_at[BT_LIST_MAX];
    } * scalars;
    double* block;
    size_t block_size; ///< bytes
} bt_cable_state;

/// The rope of the arresting cable as a general one. `length_m` receives the unstretched segment
/// lengths (Eq. 11), at most BT_CABLE_SEGMENTS_MAX; def->length_m points to it.
/// The parameters must have passed bt_group_check.
void bt_cable_def_init(bt_cable_def* def, const bt_cable_params* params, double gravity_mps2,
                       double* length_m);

/// Bytes of arena that a model and `states` states of `count` segments take at most.
size_t bt_cable_memory(int count, int states);

/// Prepares a model. BT_ERR_INPUT (count, non-finite or non-positive values; said in diag) or
/// BT_ERR_MEMORY (arena full).
BT_CHECKED bt_status bt_cable_model_init(bt_cable_model* model, const bt_cable_def* def,
                                         bt_arena* arena, bt_diag* diag);

/// Bytes of arena that a state of the model takes.
size_t bt_cable_state_size(const bt_cable_model* model);

/// Takes a state from the arena and places it as bt_cable_place does. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_cable_state_init(const bt_cable_model* model, bt_cable_state* state,
                                         bt_arena* arena);

/// Puts every segment at rest on the straight line between the anchors, without loads, time 0.
/// A rope a little longer than the line sags as a parabola, a much longer one hangs as a catenary.
void bt_cable_place(const bt_cable_model* model, bt_cable_state* state);

/// Copies everything; both states belong to the same model.
void bt_cable_state_copy(const bt_cable_model* model, bt_cable_state* to,
                         const bt_cable_state* from);
/// Whether two states are equal to the bit.
bool bt_cable_state_equal(const bt_cable_state* a, const bt_cable_state* b);

/// Static equilibrium under gravity, supports, deck, ends and the loads in the state, starting from
/// the state's shape (plane x = 0; a rope whose ends and supports are alike left and right comes
/// out mirror-symmetric to the bit). With sheaves, anchors are moved along y until the tension at
/// the sheaves is the pretension. Velocities become zero.
/// Newton's method on the forces of the stepping kernel itself.
/// @param residual_N  the largest force left on a segment (torques divided by its length); may be
///                    NULL
/// Errors: BT_ERR_NUMERIC, said in diag, when it does not come to rest or hangs clear of a support.
BT_CHECKED bt_status bt_cable_equilibrium(const bt_cable_model* model, bt_cable_state* state,
                                          double* residual_N, bt_diag* diag);

/// The largest step for which small motions stay bounded, s: from the spectral radius of joints,
/// deck contact and dampers, segment by segment. Loads of the caller that depend on position
/// should stay below the deck's stiffness per metre.
double bt_cable_stable_step(const bt_cable_model* model);

/// One step: forces at the present positions, velocities by the mean of the last and this step,
/// positions by this step (leapfrog; second order, also when the step changes).
/// Loads fx .. mz are the caller's and stay until changed. Allocates nothing, cannot fail:
/// bt_cable_is_finite tells afterwards.
void bt_cable_step(const bt_cable_model* model, bt_cable_state* state, double step_s);

/// The two halves of a step, for loads that depend on the cable's own forces: those of joints, ends
/// and supports at the present positions; then the rest of the step with them and the loads.
void bt_cable_forces(const bt_cable_model* model, bt_cable_state* state);
void bt_cable_advance(const bt_cable_model* model, bt_cable_state* state, double step_s);

/// Sets all loads to zero.
void bt_cable_clear_loads(const bt_cable_model* model, bt_cable_state* state);

/// Adds a force at a point (deck frame) to the load of one segment, with its torque.
void bt_cable_add_load(bt_cable_state* state, int segment, const double force_N[3],
                       const double point_m[3]);

/// Power of the loads at the present velocities, W. For audits.
double bt_cable_load_power(const bt_cable_model* model, const bt_cable_state* state);

/// True while every position and velocity is finite.
bool bt_cable_is_finite(const bt_cable_model* model, const bt_cable_state* state);

/// The segment whose piece of rope passes y; -1 beyond the ends. `hint` is where to look first
/// (an earlier answer, or -1).
int bt_cable_segment_at(const bt_cable_model* model, const bt_cable_state* state, double y_m,
                        int hint);

/// Centreline where it passes y: the line of the segment there; around a joint the lines of both
/// segments, shared so that it is continuous along y. Velocity (of the material there) and
/// direction (unit, toward +y) may be NULL.
/// Returns the first of the two segments nearest to y, -1 beyond the outermost centres.
int bt_cable_centreline(const bt_cable_model* model, const bt_cable_state* state, double y_m,
                        int hint, double position_m[3], double velocity_mps[3],
                        double direction[3]);

/// Tension at a joint (0 and count: the ends), N, positive when it pulls. Of the last step.
double bt_cable_tension(const bt_cable_model* model, const bt_cable_state* state, int joint);
/// The largest tension of all joints at the last step.
double bt_cable_tension_max(const bt_cable_model* model, const bt_cable_state* state);

typedef struct bt_cable_energy {
    double kinetic_J, elastic_J, gravity_J; ///< elastic: joints, ends, supports and deck;
                                            ///< gravity: centrifugal too in a frame that turns
    double momentum_kgmps[3];               ///< linear
    double angular_momentum_Nms[3];         ///< about the origin of the deck frame
} bt_cable_energy;

/// Audit at the present time: velocities are advanced from the half step with the present forces.
/// Changes only scratch and joint outputs of the state.
void bt_cable_audit(const bt_cable_model* model, bt_cable_state* state, bt_cable_energy* energy);

#endif
