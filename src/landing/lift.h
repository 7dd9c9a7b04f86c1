/// Lift after touchdown (`landing.lift`).
///
///     L = lift_ratio m g f(t)                                       constant: f = 1
///     f = (V / V_T)^2 (alpha - alpha_0) / (alpha_T - alpha_0)       aerodynamic
///
/// V is the speed through the air (the wind over the deck added to that along the deck), alpha the
/// angle between the fuselage's axis and its way through the air, T the moment of touchdown, and
/// alpha_0 zero_lift_angle. Ground effect is taken to be that of touchdown. From dump_after on f
/// falls, linearly over dump_duration, to dump_share of itself. Before touchdown the glide is
/// steady: f = 1. Lift acts at the centre of gravity, against gravity, whatever it depends on;
/// there is no drag and no thrust.
#ifndef BT_LANDING_LIFT_H
#define BT_LANDING_LIFT_H

#include "landing/params.h"
#include "mechanics/system.h"

/// The lift of one landing.
typedef struct bt_lift {
    double point_m[3];  ///< of the fuselage, where it acts
    double touchdown_N; ///< lift_ratio m g
    bt_lift_params law;
    bt_motion_params motion;        ///< of the deck: its vertical, and its part of the way
    bool moves, rolling;            ///< the deck does; the aircraft rolls in, with the deck
    double speed2_m2ps2, angle_rad; ///< V_T^2, alpha_T - alpha_0
} bt_lift;

/// What is constant over the life of an airframe.
void bt_lift_init(bt_lift* lift, double touchdown_N, const double point_m[3]);

/// The law of a landing, whose approach velocities are those through still air over a ship that
/// does not heave. pitch: that of touchdown.
void bt_lift_prepare(bt_lift* lift, const bt_model_params* params, double pitch_rad);

/// Angle of attack at touchdown: pitch and the slope of the approach.
double bt_lift_touchdown_angle(const bt_landing_params* landing, double pitch_rad);

/// Whether lift can be scaled by the angle of attack it has at touchdown; else an error in diag.
bool bt_lift_check(const bt_landing_params* landing, const char* path, bt_diag* diag);

/// f at a time, of the motion of the fuselage (`body`).
double bt_lift_factor(const bt_lift* lift, const bt_motion* motion, int body);

/// body_b: the fuselage. data: bt_lift_element. Energy: that of a constant force; of any other
/// lift none, it is a source.
typedef struct bt_lift_element {
    const bt_lift* lift; ///< may change between landings
} bt_lift_element;
extern const bt_element_type bt_lift_type;

#endif
