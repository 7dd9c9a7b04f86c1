/// Multibody systems: rigid bodies in Euler parameters, joints as constraints, elements that make
/// forces, solved as [M Phi_q^T; Phi_q 0] [qdd; -lambda] = [F; gamma]  [Peng2023 Eq. 1].
///
/// A bt_system is the model: built once, constant after bt_system_assemble, shared by threads.
/// A bt_state is one motion of it: one block of memory, copied with memcpy.
///
/// How to build a pendulum, swing it for a second and read what holds it:
///
///     bt_system* system;
///     bt_system_create(&system);
///     bt_system_set_gravity(system, (double[]){0, 0, -9.81});
///     int bob = bt_system_add_body(system, &(bt_body_def){
///         .name = "bob", .mass_kg = 2, .inertia_kgm2 = {0.1, 0.1, 0.01},
///         .position_m = {0.6, 0, 0}, .attitude = {1, 0, 0, 0}});
///     int pivot = bt_system_add_joint(system, &(bt_joint_def){
///         .name = "pivot", .kind = BT_JOINT_REVOLUTE, .body_a = BT_GROUND, .body_b = bob,
///         .point_a_m = {0, 0, 0}, .point_b_m = {-0.6, 0, 0}, // of the ground, of the bob
///         .axis_a = {0, 1, 0}, .axis_b = {0, 1, 0}});
///     bt_system_assemble(system, &diag);           // checks, closes, orders; errors go to diag
///     bt_arena arena;
///     bt_state state;
///     bt_arena_create(&arena, bt_state_size(system));
///     bt_state_create(system, &arena, &state);
///     for (int i = 0; i < 1000; ++i)
///         bt_system_step(system, &state, 1e-3, BT_INTEGRATOR_SECOND_ORDER, &failure);
///     double force[3], torque[3];
///     bt_system_joint_load(system, &state, pivot, force, torque);
///
/// (those that return a status want it checked). Springs, dampers and torques are elements:
/// elements/spring.h and elements/torque.h, or your own bt_element_type.
///
/// Frames. World: inertial, or the frame that state->frame describes (a deck that moves);
/// velocities are relative to it. A body's frame has its origin at the centre of mass. Coordinates
/// of a body: position (x, y, z) in the world and Euler parameters (e0, e1, e2, e3), body to world.
/// Velocities: of the centre of mass in the world, angular velocity in the body frame.
/// Wrenches: force in the world at the centre of mass, torque in the body frame.
#ifndef BT_MECHANICS_SYSTEM_H
#define BT_MECHANICS_SYSTEM_H

#include "base/arena.h"
#include "base/diag.h"
#include "mechanics/frame.h"

#include <stdbool.h>
#include <stdint.h>

enum { BT_GROUND = -1 };

typedef struct bt_system bt_system;
typedef struct bt_state bt_state;

typedef struct bt_body_def {
    const char* name;       ///< copied
    double mass_kg;         ///< > 0
    double inertia_kgm2[6]; ///< xx yy zz xy xz yz about the centre of mass, body frame; positive
                            ///< definite and obeying the triangle inequality. Off-diagonal entries
                            ///< are tensor entries (xz = -integral x z dm)
    double position_m[3];
    double attitude[4];     ///< Euler parameters; normalised on entry
    double velocity_mps[3]; ///< world
    double spin_radps[3];   ///< body frame
} bt_body_def;

typedef enum bt_joint_kind {
    BT_JOINT_REVOLUTE,       ///< 5: common point, common axis
    BT_JOINT_PRISMATIC,      ///< 5: slides along the axis, no rotation
    BT_JOINT_CYLINDRICAL,    ///< 4: slides along and turns about the axis
    BT_JOINT_UNIVERSAL,      ///< 4: common point, axis (in a) stays perpendicular to axis_b (in b)
    BT_JOINT_SPHERICAL,      ///< 3: common point
    BT_JOINT_FIXED,          ///< 6
    BT_JOINT_POINT_ON_LINE,  ///< 2: point of b on the line through the point of a along the axis
    BT_JOINT_POINT_ON_PLANE, ///< 1: point of b in the plane through the point of a, normal axis
    BT_JOINT_DISTANCE,       ///< 1: distance between the two points is length_m
} bt_joint_kind;

/// A joint is given in the frames of its bodies (in the world frame for BT_GROUND). Joints may
/// close loops and may be redundant: what follows from other joints is counted and said in a note.
typedef struct bt_joint_def {
    const char* name; ///< copied
    bt_joint_kind kind;
    int body_a, body_b;
    double point_a_m[3], point_b_m[3];
    double axis_a[3], axis_b[3]; ///< normalised on entry. For UNIVERSAL the two arms of the cross.
                                 ///< For the others axis_b is the same line seen from b; all zero
                                 ///< = as the given attitudes have it. Not used by SPHERICAL,
                                 ///< FIXED and DISTANCE; POINT_ON_LINE and POINT_ON_PLANE use
                                 ///< axis_a only
    double length_m;             ///< DISTANCE only, > 0
    double attitude_ab[4];       ///< FIXED and PRISMATIC: attitude of b relative to a; all zero =
                                 ///< the one at assembly
} bt_joint_def;

/// What an element may see of the motion.
typedef struct bt_motion {
    double time_s;
    const double* q;        ///< [7 * body_count]
    const double* v;        ///< [6 * body_count]
    const double* rotation; ///< [9 * body_count] row-major, body to world, made from q
} bt_motion;

struct bt_element;

/// What the law of an element says of a state.
typedef enum bt_law {
    BT_LAW_HOLDS,
    BT_LAW_AT_LIMIT, ///< the part is at the end of its range; the law still describes it: a remark
    BT_LAW_LEFT,     ///< the law has no meaning there: what is computed is not to be used
} bt_law;

/// A kind of element: one constant table, one file. `data` of an element is a copy of what its
/// def pointed to.
typedef struct bt_element_type {
    const char* name;
    size_t data_size;
    int output_count; ///< doubles the element reports at each evaluation (stroke, force, ...)
    const char* const* output_names; ///< with unit, for example "stroke_m"
    /// Adds the element's wrenches [6 * body_count] and writes its outputs.
    void (*force)(const struct bt_element* element, const bt_motion* motion, double* wrench,
                  double* output);
    /// Stored energy, J; NULL when the element stores none.
    double (*energy)(const struct bt_element* element, const bt_motion* motion);
    /// Range of validity, from the outputs of an evaluation; NULL: the law holds everywhere. When
    /// it is not BT_LAW_HOLDS, *what says why in a few constant words ("strut bottomed").
    bt_law (*law)(const struct bt_element* element, const double* output, const char** what);
} bt_element_type;

typedef struct bt_element {
    const bt_element_type* type;
    const char* name;
    int body_a, body_b; ///< BT_GROUND allowed for one
    const void* data;
} bt_element;

BT_CHECKED bt_status bt_system_create(bt_system** system);
void bt_system_destroy(bt_system* system);

/// Each returns the index of what was added, or -1 when memory ran out (reported again by
/// bt_system_assemble). Names are copied, defs are not kept.
int bt_system_add_body(bt_system* system, const bt_body_def* def);
int bt_system_add_joint(bt_system* system, const bt_joint_def* def);
int bt_system_add_element(bt_system* system, const bt_element* def);
/// Gravity of the frame in which a new state starts, see state->frame.
void bt_system_set_gravity(bt_system* system, const double gravity_mps2[3]);

/// Checks bodies and joints, chooses the elimination order, and finds consistent initial conditions
/// next to the given ones: Newton steps that are shortest in the mass metric, so heavy bodies move
/// little. All errors of the input are reported at once; each names its body, joint or element.
/// BT_ERR_INPUT, BT_ERR_MEMORY.
BT_CHECKED bt_status bt_system_assemble(bt_system* system, bt_diag* diag);

int bt_system_constraint_count(const bt_system* system);
int bt_system_redundant_count(const bt_system* system); ///< dependent constraint rows at assembly
int bt_system_body_find(const bt_system* system, const char* name);
int bt_system_joint_find(const bt_system* system, const char* name);
int bt_system_element_find(const bt_system* system, const char* name);
const double* bt_system_element_output(const bt_system* system, const bt_state* state, int element);
/// Whether an element's law holds at its present outputs; *what (untouched when it holds) lives as
/// long as the program.
bt_law bt_system_element_law(const bt_system* system, const bt_state* state, int element,
                             const char** what);
const char* bt_system_element_name(const bt_system* system, int element);
int bt_system_element_count(const bt_system* system);

/// One motion: everything that changes, in one block.
struct bt_state {
    double time_s;
    int64_t steps;
    bt_frame frame;   ///< at the end of the coming step; yours to set, starts at rest
    double* q;        ///< [7 * body_count]
    double* v;        ///< [6 * body_count]
    double* a;        ///< [6 * body_count] accelerations at the last evaluation
    double* lambda;   ///< [constraint_count] multipliers there: M a = F + G^T lambda
    double* applied;  ///< [6 * body_count] outside wrench, mean over the coming step; yours to set
    double* output;   ///< element outputs, see bt_system_element_output
    double* rotation; ///< [9 * body_count]
    void* scratch;    ///< factors and work space
    void* block;      ///< start of the one block
    size_t block_size;
};

/// Lays a state out in the arena and sets it to the assembled initial conditions.
BT_CHECKED bt_status bt_state_create(const bt_system* system, bt_arena* arena, bt_state* state);
size_t bt_state_size(const bt_system* system); ///< bytes of arena it takes
void bt_state_copy(const bt_system* system, bt_state* to, const bt_state* from);
/// Whether two states are equal to the bit, in everything that decides how they go on.
bool bt_state_equal(const bt_system* system, const bt_state* a, const bt_state* b);

typedef enum bt_integrator {
    /// Constrained leapfrog, one force evaluation and one factorisation per step. Conservative
    /// systems keep their energy up to a bounded error, free bodies their momenta to rounding.
    /// Stable for omega h < 2 (springs) and c h / m < 1 (dampers). No memory of earlier steps but
    /// the accelerations.
    BT_INTEGRATOR_SECOND_ORDER,
    /// Classical Runge-Kutta on accelerations and projection: five factorisations or more per step,
    /// for verification. `applied` is constant over the step.
    BT_INTEGRATOR_FOURTH_ORDER,
} bt_integrator;

/// Where and why a step failed; element or body name, quantity.
typedef struct bt_failure {
    const char* where;
    const char* quantity;
    double time_s;
} bt_failure;

/// Advances by h: forces, KKT solve, advance, project. Allocates nothing. h may change from call
/// to call. BT_ERR_NUMERIC with *failure (may be NULL) filled when something is no longer finite or
/// the constraints cannot be met; the state is then of no further use. BT_ERR_ARG for h <= 0.
/// After the step state->a, lambda and output belong to its end. They contain `applied` as it was
/// during the step; the next step takes the difference into account.
BT_CHECKED bt_status bt_system_step(const bt_system* system, bt_state* state, double h_s,
                                    bt_integrator integrator, bt_failure* failure);

/// Accelerations, multipliers and outputs at the present q, v (and `applied`) without moving.
/// Enough after a change by hand that breaks no joint; bt_system_project after any other.
BT_CHECKED bt_status bt_system_evaluate(const bt_system* system, bt_state* state,
                                        bt_failure* failure);

/// After q or v were changed by hand: back onto the constraints, in the mass metric. The next step
/// evaluates accelerations anew.
BT_CHECKED bt_status bt_system_project(const bt_system* system, bt_state* state,
                                       bt_failure* failure);

/// Audit, at any time.
typedef struct bt_audit {
    /// Kinetic: of the motion seen in the frame. Potential: gravity (less the frame's
    /// acceleration), centrifugal, elements with energy. Their sum is kept in a constant frame.
    double kinetic_J, potential_J;
    double momentum_Ns[3], angular_momentum_Nms[3]; ///< likewise; about the world origin
    /// Largest constraint error over its scale. Positions: the size of the joint (largest of its
    /// arms and its bodies' radii of gyration), or 1 rad. Velocities: largest speed of its bodies.
    double position_residual, velocity_residual;
    double norm_error; ///< largest | |e| - 1 |
} bt_audit;
void bt_system_audit(const bt_system* system, const bt_state* state, bt_audit* audit);

/// Kinetic energy of one body seen from a frame that moves along, J.
double bt_system_body_energy(const bt_system* system, const bt_state* state, int body,
                             const double frame_mps[3]);

/// Power that an element puts into the bodies, W, seen from a frame that moves along at a constant
/// velocity: minus what it stores and dissipates.
/// @param wrench  [6 * body_count] work space
double bt_system_element_power(const bt_system* system, const bt_state* state, int element,
                               const double frame_mps[3], double* wrench);

/// Force and torque that joint `joint` puts on its body b at the joint point, world frame, from
/// the multipliers of the last evaluation.
void bt_system_joint_load(const bt_system* system, const bt_state* state, int joint,
                          double force_N[3], double torque_Nm[3]);

/// Kinematics of a point fixed to a body (BT_GROUND: the world). Point in the body frame.
void bt_point_position(const bt_motion* motion, int body, const double point_m[3],
                       double position_m[3]);
void bt_point_velocity(const bt_motion* motion, int body, const double point_m[3],
                       double velocity_mps[3]);
/// Adds a world force that acts at a world position to the wrench of a body.
void bt_wrench_add(const bt_motion* motion, int body, const double position_m[3],
                   const double force_N[3], double* wrench);
/// Adds a world torque.
void bt_wrench_add_torque(const bt_motion* motion, int body, const double torque_Nm[3],
                          double* wrench);

/// What lies between a point of each of two bodies, pinned to both.
typedef struct bt_link {
    double end_a[3], end_b[3]; ///< world, m
    double direction[3];       ///< unit, from a to b
    double distance_m;
    double closing_mps; ///< rate at which the distance shrinks
} bt_link;

/// Points in the bodies' frames; they must not coincide.
void bt_link_between(const bt_motion* motion, int body_a, const double point_a_m[3], int body_b,
                     const double point_b_m[3], bt_link* link);
/// Adds a force along the link to the wrenches of both bodies: positive pushes them apart.
void bt_link_push(const bt_motion* motion, int body_a, int body_b, const bt_link* link,
                  double force_N, double* wrench);

#endif
