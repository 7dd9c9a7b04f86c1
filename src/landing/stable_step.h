/// How large a step each part of a landing bears: for `bolter check`, and to refuse larger ones.
#ifndef BT_LANDING_STABLE_STEP_H
#define BT_LANDING_STABLE_STEP_H

#include "base/diag.h"
#include "landing/params.h"

typedef struct bt_stable_step {
    const char* element; ///< "aircraft.hook.deck_contact"
    const char* setting; ///< the step it limits: "landing.solver.contact_step"
    double stable_s;     ///< 2 / omega of the element's stiffest state; the cable: of its kernel
    double used_s;       ///< what the study sets
} bt_stable_step;

enum { BT_STABLE_STEP_MAX = 12 };

/// Fills steps [BT_STABLE_STEP_MAX] and returns how many. omega = sqrt(k / m) with the element's
/// largest stiffness k in this landing and the smallest mass m it moves:
///
/// struts     k_l of Eq. 5 on piston and wheel (of a levered leg: what arm and wheel weigh at the
///            strut and at the axle)
/// tyres      slope of the load curve at a deflection of a tenth of the radius, on piston and wheel
/// shank      of its sprung joint, the root free about the pivot (a shank that bends)
/// down stop  k r^2 on the inertia about the pivot of the hook, or of its root where it bends; r
/// the
///            damper's lever
/// shoe       slope 3/2 K delta^1/2 of Eq. 10 at the depth of an impact at the sinking velocity,
///            delta = (5 m v^2 / (4 K))^(2/5), m the hook's effective mass at the shoe, and its
///            damping c = lambda K delta^3/2, which shortens the step to h: omega^2 h^2 + 2 (c / m)
///            h = 4
///
/// BT_ERR_INPUT (a cable that cannot be assembled, said in diag), BT_ERR_MEMORY.
BT_CHECKED bt_status bt_stable_steps(const bt_model_params* model, bt_stable_step* steps,
                                     int* count, bt_diag* diag);

/// The same without the cable, whose step follows from its mesh: cheap, cannot fail. Returns how
/// many.
int bt_airframe_stable_steps(const bt_model_params* model, bt_stable_step* steps);

#endif
