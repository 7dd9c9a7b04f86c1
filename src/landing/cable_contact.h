/// What touches the cable during one airframe step: wheels and hook. The cable takes several steps
/// of its own meanwhile; the bodies move on by their velocities and accelerations, and what the
/// cable does to them is gathered as the mean wrench of the step: equal and opposite.
#ifndef BT_LANDING_CABLE_CONTACT_H
#define BT_LANDING_CABLE_CONTACT_H

#include "cable/cable.h"
#include "cable/slide.h"
#include "elements/tyre.h"
#include "landing/profile.h"

enum { BT_SLIDES_MAX = 256 }; ///< more in one step are resolved in groups of this many

/// A rigid body as the cable meets it: its motion from the start of the airframe step, and the
/// impulses that the cable has given it since.
typedef struct bt_moving_body {
    double position_m[3], velocity_mps[3], acceleration_mps2[3];
    double rotation[9];   ///< body to world, at the start of the step
    double spin_radps[3]; ///< angular velocity, world
    double now_m[3];      ///< position at the present cable step
    double now_mps[3];    ///< velocity
    double now_rotation[9];
    double impulse_Ns[3]; ///< impulse of the forces so far
    double moment_Nms[3]; ///< moment of their torques about the centre of mass, world
} bt_moving_body;

/// Moves the body to a time after the start of the airframe step. Turns it by its spin (first
/// order; the step is short).
void bt_moving_body_to(bt_moving_body* body, double after_s);

/// Where wheels and hook slide over the cable in one cable step.
typedef struct bt_slides {
    int count;    ///< noted
    int resolved; ///< entries of `at`, from the start: those of the last bt_slides_resolve
    bt_cable_slide at[BT_SLIDES_MAX];
    bt_moving_body* body[BT_SLIDES_MAX];
} bt_slides;

/// Finds the friction at all places noted so far, gives it to cable and bodies, and forgets them.
void bt_slides_resolve(bt_slides* slides, const bt_cable_model* model, bt_cable_state* cable,
                       double step_s);

/// A tyre over the cable  [Peng2023 Eqs. 6, 7]. The tyre's width is cut into slices, one per
/// segment of cable under it; each slice is the strip model in the plane of the wheel with the
/// cable's cross-section there as a bump on the deck. The force of a slice is its share of the
/// width times the load curve at its equivalent deflection; the cable carries the share of area
/// that it bounds.
typedef struct bt_wheel_contact {
    const bt_tyre* tyre;
    double width_m;  ///< width of all tyres of the axle together
    double friction; ///< tyre on cable
    double slip_speed_mps;
    double normal_N; ///< on the cable at the last evaluation
    int hint;        ///< last segment found under the wheel
} bt_wheel_contact;

/// Adds the normal loads of one cable step (duration step_s) to the cable and their opposite to the
/// wheel, together with what the deck no longer carries because the cable does; notes where it
/// slides. bt_cable_forces comes before, bt_slides_resolve after all bodies have pressed.
void bt_wheel_contact_press(bt_wheel_contact* contact, const bt_cable_model* model,
                            bt_cable_state* cable, bt_moving_body* wheel, bt_slides* slides,
                            double step_s);

/// The hook's head on the cable. Penalty normal force with damping, Coulomb friction, per metre of
/// cable within the head's width.
typedef struct bt_hook_contact {
    const bt_profile* profile;
    double shoe_m[3];          ///< centre of the shoe arc in the hook's body frame
    double stiffness, damping; ///< N/m2, N s/m2 per metre of cable
    double friction, slip_speed_mps;
    double zone_force_N[BT_ZONE_COUNT]; ///< normal forces at the last evaluation
    double lip_m[3];                    ///< lip centre, world, at the last evaluation
    double cable_m[3];                  ///< cable centre in the hook's plane
    bool beside;                        ///< the cable does not reach as far as the hook's plane
    int hint;
} bt_hook_contact;

void bt_hook_contact_press(bt_hook_contact* contact, const bt_cable_model* model,
                           bt_cable_state* cable, bt_moving_body* hook, bt_slides* slides,
                           double step_s);

/// Clearance between the cable's surface and the part at the present body position, m: at least
/// this far apart (negative: they overlap). INFINITY beyond the cable's ends.
double bt_wheel_clearance(const bt_wheel_contact* contact, const bt_cable_model* model,
                          const bt_cable_state* cable, const bt_moving_body* wheel);
double bt_hook_clearance(bt_hook_contact* contact, const bt_cable_model* model,
                         const bt_cable_state* cable, const bt_moving_body* hook);

#endif
