/// Forces, accelerations and projection: what the integrators are made of. For this folder only.
#ifndef BT_MECHANICS_DYNAMICS_H
#define BT_MECHANICS_DYNAMICS_H

#include "mechanics/model.h"

/// Rotation matrices from q.
void bt_rotations(const bt_system* system, const double* q, double* rotation);

/// Fills *failure (may be NULL) and returns false.
bool bt_fail(bt_failure* failure, const char* where, const char* quantity, double time_s);

/// Jacobian and factor at state->q (rotations are made).
bool bt_factorise(const bt_system* system, bt_state* state, bt_failure* failure);

/// Solves K x = x for work->x with the present factor; x = (accelerations, -lambda).
void bt_solve(const bt_system* system, const bt_state* state);

/// rate = G v with the present Jacobian.
void bt_constraint_rates(const bt_system* system, const bt_work* work, const double* v,
                         double* rate);

/// work->wrench = gravity + elements + applied at (time, state->q, v); writes the outputs.
bool bt_forces(const bt_system* system, bt_state* state, double time_s, const double* v,
               bt_failure* failure);

/// omega x J omega
void bt_gyroscopic(const bt_body* body, const double omega[3], double torque[3]);

/// state->a and lambda from work->wrench at state->q, v.
bool bt_accelerations(const bt_system* system, bt_state* state, bt_failure* failure);

/// phi at q, and the largest |phi| over the size of its joint. *worst (may be NULL): its joint, -1
/// without joints.
double bt_residual(const bt_system* system, const double* q, const double* rotation, double* phi,
                   int* worst);

/// Moves one body: translation in the world, rotation vector in the body frame.
void bt_move(double q[7], const double step[6]);

/// Newton steps in the mass metric until the constraints hold to rounding. No body turns by more
/// than turn_limit_rad in a step. Returns the remaining residual; *worst its joint.
double bt_close_positions(const bt_system* system, bt_state* state, int iterations,
                          double turn_limit_rad, int* worst, bt_failure* failure);

/// What velocity errors of joint j are judged by: the largest speed of its bodies, m/s (at least
/// the joint's size turning at their rate), and their largest rate of turning, rad/s (at least
/// 1e-3).
void bt_rate_scales(const bt_system* system, const double* v, int j, double* length, double* angle);

/// v := the nearest in the mass metric with G v = 0 to rounding, with the present factor.
void bt_close_velocities(const bt_system* system, bt_state* state);

/// The residual that rounding makes at q: joints are closed down to it.
double bt_rounding(const bt_system* system, const double* q);

/// Velocity residuals above this are reduced further.
#define BT_CLOSED 1e-12

/// Residuals above this are an error.
#define BT_CLOSED_ENOUGH 1e-11

#endif
