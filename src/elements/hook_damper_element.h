/// Element `hook_damper`: the longitudinal damper of the hook between its two attachment points, so
/// that its lever arm about the hook's pivot follows from where they are  [Peng2023 Eq. 9].
#ifndef BT_ELEMENTS_HOOK_DAMPER_ELEMENT_H
#define BT_ELEMENTS_HOOK_DAMPER_ELEMENT_H

#include "elements/hook_damper.h"
#include "mechanics/system.h"

/// Data of one damper. body_a is the fuselage, body_b the hook.
///
///     s = length - |p_b - p_a|;  F(s, s') pushes the two points apart
typedef struct bt_hook_damper_mount {
    bt_hook_damper damper;
    double point_a_m[3], point_b_m[3]; ///< attachment points in a and in b
    double length_m;                   ///< distance of the points when extended (s = 0)
} bt_hook_damper_mount;

enum { BT_HOOK_DAMPER_STROKE, BT_HOOK_DAMPER_RATE, BT_HOOK_DAMPER_FORCE, BT_HOOK_DAMPER_OUTPUTS };

/// Outputs stroke_m, rate_mps, force_N. Energy: gas and stops. Law: the damper's.
extern const bt_element_type bt_hook_damper_element;

/// Where the damper is attached, from what a drawing gives.
///
/// The shank leaves the pivot aft and down at `down_stop` below the fuselage axis (-x). The damper
/// meets it at `lever` from the pivot under `angle` and lies above and behind it, `length` long, so
/// that it shortens when the hook rises. At the down stop its lever arm is lever sin(angle).
///
/// @param on_shank     [3] from the pivot, fuselage axes, hook at the down stop
/// @param on_fuselage  [3] from the pivot, fuselage axes
void bt_hook_damper_place(double down_stop_rad, double lever_m, double angle_rad, double length_m,
                          double on_shank[3], double on_fuselage[3]);

/// Shank angle below the fuselage axis at which the hook hangs on its down stop, rad: gas, stop and
/// weight in balance about the pivot.
///
/// @param weight_moment_Nm  mass times effective gravity times distance of the mass centre from the
/// pivot
/// @param pitch_rad         of the fuselage axis, nose up positive
double bt_hook_damper_hanging_angle(const bt_hook_damper* damper, double down_stop_rad,
                                    double lever_m, double angle_rad, double length_m,
                                    double weight_moment_Nm, double pitch_rad);

#endif
