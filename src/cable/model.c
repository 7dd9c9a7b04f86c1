/// The cable's model: constants of each segment, kernel, stable step.
#include "cable/cable_parts.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

static int padded_count(int count) {
    return (count + BT_CABLE_LANES - 1) / BT_CABLE_LANES * BT_CABLE_LANES;
}

/// Room for one vector behind the last segment, an odd number of vectors: no power of two.
static int stride_of(int count) {
    const int vectors = padded_count(count) / BT_CABLE_LANES + 1;
    return (vectors | 1) * BT_CABLE_LANES;
}

enum { MODEL_ARRAYS = 8 };

size_t bt_cable_memory(int count, int states) {
    const size_t array = (size_t)stride_of(count) * sizeof(double);
    return MODEL_ARRAYS * array +
           (size_t)states *
               (BT_CABLE_STATE_ARRAYS * array + sizeof(struct bt_cable_scalars) + 128) +
           1024;
}

static bt_cable_kernel choose_kernel(bt_kernel_level level) {
#if defined(__x86_64__)
    __builtin_cpu_init();
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd");
    if (v4 && (level == BT_KERNEL_BEST || level == BT_KERNEL_V4))
        return (bt_cable_kernel){"v4", bt_cable_joints_v4, bt_cable_resultants_v4,
                                 bt_cable_advance_v4};
    if (v3 && level != BT_KERNEL_V1)
        return (bt_cable_kernel){"v3", bt_cable_joints_v3, bt_cable_resultants_v3,
                                 bt_cable_advance_v3};
#endif
    return (bt_cable_kernel){"v1", bt_cable_joints_v1, bt_cable_resultants_v1, bt_cable_advance_v1};
}

const char* bt_cable_best_level(void) {
    return choose_kernel(BT_KERNEL_BEST).name;
}

/// Share of critical damping that gives the restitution e to a spring and damper that may not pull:
/// e = exp(-zeta / r (pi - 2 atan(zeta / r))), r = sqrt(1 - zeta^2); by bisection.
static double damping_ratio(double restitution) {
    double low = 0, high = 0.999;
    for (int k = 0; k < 60; ++k) {
        const double zeta = 0.5 * (low + high), slope = zeta / sqrt(1 - zeta * zeta);
        const double e = exp(-slope * (PI - 2 * atan(slope)));
        if (e > restitution)
            low = zeta;
        else
            high = zeta;
    }
    return 0.5 * (low + high);
}

static bt_status check_def(const bt_cable_def* def, bt_diag* diag) {
    const char* bad = NULL;
    if (def->count < 2 || def->count > BT_CABLE_SEGMENTS_MAX)
        bad = "count of segments";
    else if (!(def->diameter_m > 0) || !(def->mass_kgpm > 0) || !(def->axial_stiffness_N > 0))
        bad = "diameter, mass or axial stiffness";
    else if (!(def->shear_ratio > 0 && def->shear_ratio <= 0.6))
        bad = "shear ratio (above 0, at most 0.6)";
    else if (!(def->compression_ratio >= 0 && def->compression_ratio <= 1))
        bad = "compression ratio (0 .. 1)";
    else if (def->support_y_m.count > 0 && !(def->support.stiffness_Npm > 0))
        bad = "support stiffness";
    for (int i = 0; !bad && i < def->count; ++i)
        if (!(def->length_m[i] > 0 && isfinite(def->length_m[i])))
            bad = "segment length";
    if (!bad)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "deck.cable: the %s cannot be used", bad);
    return BT_ERR_INPUT;
}

bt_status bt_cable_model_init(bt_cable_model* model, const bt_cable_def* def, bt_arena* arena,
                              bt_diag* diag) {
    *model = (bt_cable_model){0};
    BT_TRY(check_def(def, diag));
    const int n = def->count, stride = stride_of(n);
    double* block = BT_TAKE(arena, double, MODEL_ARRAYS* stride);
    if (!block)
        return BT_ERR_MEMORY;
    double* array[MODEL_ARRAYS];
    for (int k = 0; k < MODEL_ARRAYS; ++k)
        array[k] = block + k * stride;
    model->count = n;
    model->padded = padded_count(n);
    model->stride = stride;
    model->def = *def;
    model->def.length_m = NULL;
    const double r = model->radius_m = 0.5 * def->diameter_m;
    if (!def->deck)
        model->def.deck_contact =
            (bt_cable_deck_params){.stiffness_Npm2 = 0, .restitution = 1, .slip_speed_mps = 1};
    const bt_cable_deck_params* deck = &model->def.deck_contact;
    model->contact_damping_Npm2ps =
        2 * damping_ratio(deck->restitution) * sqrt(deck->stiffness_Npm2 * def->mass_kgpm);
    double total = 0;
    for (int i = 0; i < n; ++i)
        total += def->length_m[i];
    const double start = def->end[0].anchor_m[1];
    const double stretch = (def->end[1].anchor_m[1] - start) / total;
    double at = 0;
    for (int i = 0; i < n; ++i) {
        const double l = def->length_m[i], m = def->mass_kgpm * l;
        /* l^2 / 6 instead of the cylinder's l^2 / 12: transverse waves become exact to fourth order
         */
        const double tilt = m * (r * r / 4 + l * l / 6), spin = m * r * r / 2;
        array[0][i] = 0.5 * l;
        array[1][i] = m;
        array[2][i] = 1 / m;
        array[3][i] = 1 / tilt;
        array[4][i] = 1 / spin - 1 / tilt;
        array[5][i] = 1 / m + r * r / spin;
        array[6][i] = i > 0 ? 2 / (l + def->length_m[i - 1]) : 0;
        array[7][i] = start + stretch * (at + 0.5 * l);
        at += l;
    }
    for (int i = 0; i < n / 2; ++i) /* the two halves of a symmetric rope: equal to the bit */
        if (start + def->end[1].anchor_m[1] == 0 && def->length_m[i] == def->length_m[n - 1 - i])
            array[7][n - 1 - i] = -array[7][i];
    model->half_m = array[0];
    model->mass_kg = array[1];
    model->inverse_mass = array[2];
    model->inverse_tilt = array[3];
    model->inverse_spin = array[4];
    model->inverse_slide = array[5];
    model->inverse_spacing = array[6];
    model->rest_y_m = array[7];
    model->kernel = choose_kernel(def->level);
    model->stable_step_s = bt_cable_stable_step(model);
    return BT_OK;
}

/// Largest dt with w^2 dt^2 + 2 g dt <= 4: leapfrog with the damping of the last half step.
static double step_limit(double w2, double g) {
    return (sqrt(g * g + 4 * w2) - g) / w2;
}

double bt_cable_stable_step(const bt_cable_model* model) {
    const bt_cable_def* d = &model->def;
    const double ka = d->axial_stiffness_N, ca = d->axial_damping_Ns;
    const double ks = d->shear_ratio * ka, cs = d->shear_ratio * ca;
    const double contact = d->deck_contact.stiffness_Npm2 / d->mass_kgpm;
    const double contact_damping = model->contact_damping_Npm2ps / d->mass_kgpm;
    double step = INFINITY;
    for (int i = 0; i < model->count; ++i) {
        const double l = 2 * model->half_m[i], per_m = model->inverse_mass[i];
        const double per_tilt = model->inverse_tilt[i];
        const double per_spin = model->inverse_spin[i] + per_tilt;
        const double before = model->inverse_spacing[i], after = model->inverse_spacing[i + 1];
        /* the spring of a held end is that of half a joint: as of neighbours alike */
        const double per_l = fmax(before > 0 ? before : 1 / l, after > 0 ? after : 1 / l);
        step = fmin(step, step_limit(4 * per_l * ka * per_m, 4 * per_l * ca * per_m));
        step = fmin(step, step_limit(4 * per_l * d->twist_stiffness_Nm2 * per_spin + 1e-30,
                                     4 * per_l * d->twist_damping_Nm2s * per_spin));
        /* transverse: shear, bending and deck together, over the wave number */
        for (int k = 0; k <= 16; ++k) {
            const double s2 = k / 16.0,
                         shear = per_l * (4 * s2 * per_m + l * l * (1 - s2) * per_tilt);
            const double bend = 4 * s2 * per_l * per_tilt;
            step = fmin(step,
                        step_limit(ks * shear + d->bending_stiffness_Nm2 * bend + contact,
                                   cs * shear + d->bending_damping_Nm2s * bend + contact_damping));
        }
    }
    return step;
}
