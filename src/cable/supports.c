/// The wire supports under the cable.
#include "cable/cable_parts.h"

/// One-sided spring and damper under the cable where it passes each support.
void bt_cable_supports(const bt_cable_model* model, bt_cable_state* s) {
    const bt_cable_def* d = &model->def;
    struct bt_cable_scalars* scalars = s->scalars;
    for (int k = 0; k < d->support_y_m.count; ++k)
        for (int side = 0; side < 2 && scalars->support_at[k] >= 0; ++side)
            s->support_fz[scalars->support_at[k] + side] =
                s->support_mx[scalars->support_at[k] + side] = 0;
    for (int k = 0; k < d->support_y_m.count; ++k) {
        const bt_cable_passage p =
            bt_cable_pass(model, s, d->support_y_m.value[k], scalars->support_at[k]);
        scalars->support_at[k] = p.segment;
        scalars->support_force_N[k] = 0;
        if (p.segment < 0)
            continue;
        const double height = p.share[0] * p.point[0][2] + p.share[1] * p.point[1][2];
        const double rate = p.share[0] * p.rate[0][2] + p.share[1] * p.rate[1][2];
        const double depth = d->support.height_m + model->radius_m - height;
        const double force = d->support.stiffness_Npm * depth - d->support.damping_Npmps * rate;
        if (!(depth > 0 && force > 0))
            continue;
        scalars->support_force_N[k] = force;
        for (int side = 0; side < 2; ++side) {
            const int i = p.segment + side;
            s->support_fz[i] += p.share[side] * force;
            s->support_mx[i] += p.share[side] * force * (p.point[side][1] - s->y[i]);
        }
    }
}
