#include "elements/friction.h"

void bt_friction_force(double mu_N, double slip_speed_mps, const double velocity[3],
                       double force[3]) {
    const double speed =
        sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]);
    // phi(x) / x is 3/2 at rest: no division by the speed there.
    const double x = speed / slip_speed_mps;
    const double share = x < 1 ? 0.5 * (3 - x * x) / slip_speed_mps : 1 / speed;
    for (int i = 0; i < 3; ++i)
        force[i] = -mu_N * share * velocity[i];
}
