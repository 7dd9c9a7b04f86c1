/// From the keys to a rope: segment lengths, supports, ends.
#include "cable/mesh.h"

#include <math.h>

void bt_cable_place_supports(const bt_cable_params* p, bt_list* y) {
    const bt_cable_supports_params* s = &p->supports;
    const double outermost = 0.5 * p->span_m - 0.5 * s->spacing_m;
    y->count = 0;
    for (int k = 0; 2 * k + 1 < BT_LIST_MAX; ++k) {
        const double at = s->first_m + k * s->spacing_m;
        if (at > outermost && (k > 0 || at > 0.5 * p->span_m - 0.3))
            break;
        y->value[y->count++] = -at;
        y->value[y->count++] = at;
    }
}

/// Finite segments [Peng2023 Eq. 11].
int bt_cable_mesh_half(const bt_cable_mesh_params* mesh, double half_span, double* length) {
    const double fine_width = fmin(mesh->fine_half_width_m, half_span);
    const int fine_count = (int)ceil(fine_width / mesh->fine_length_m - 1e-9);
    double step = fine_count ? fine_width / fine_count : mesh->medium_length_m;
    int count = 0;
    for (; count < fine_count && count < BT_CABLE_SEGMENTS_MAX; ++count)
        if (length)
            length[count] = step;
    const double rest = half_span - fine_width;
    if (rest < 1e-9 * half_span)
        return count;
    const int first = count;
    for (double sum = 0; sum < rest * (1 - 1e-9) && count < BT_CABLE_SEGMENTS_MAX; ++count) {
        const double wanted = fine_width + sum < mesh->medium_half_width_m - 1e-9
                                  ? mesh->medium_length_m
                                  : mesh->coarse_length_m;
        step = fmin(wanted, step * mesh->growth);
        sum += step;
        if (length)
            length[count] = step;
    }
    if (length) {
        double sum = 0;
        for (int i = first; i < count; ++i)
            sum += length[i];
        for (int i = first; i < count; ++i)
            length[i] *= rest / sum;
    }
    return count;
}

/// Stretches the pieces of one half so that a joint lies at every support: a kink over a support is
/// then exact, however long the segments are.
static void snap_to_supports(const bt_list* y, int count, double* length) {
    int first = 0;
    double from = 0; /* the joint reached so far */
    for (int k = 0; k < y->count; ++k) {
        if (!(y->value[k] > 0))
            continue;
        double sum = 0;
        int last = first;
        while (last < count - 1 && (last == first || from + sum + 0.5 * length[last] < y->value[k]))
            sum += length[last++];
        const double scale = (y->value[k] - from) / sum;
        double rest = 0, rest_wanted = 0;
        for (int i = last; i < count; ++i)
            rest += length[i];
        rest_wanted = rest + sum - (y->value[k] - from);
        for (int i = first; i < last; ++i)
            length[i] *= scale;
        for (int i = last; i < count; ++i)
            length[i] *= rest_wanted / rest;
        first = last;
        from = y->value[k];
    }
}

void bt_cable_def_init(bt_cable_def* def, const bt_cable_params* p, double gravity_mps2,
                       double* length_m) {
    *def = (bt_cable_def){
        .length_m = length_m,
        .diameter_m = p->diameter_m,
        .mass_kgpm = p->mass_kgpm,
        .axial_stiffness_N = p->axial_stiffness_N,
        .bending_stiffness_Nm2 = p->bending_stiffness_Nm2,
        .twist_stiffness_Nm2 = p->twist_stiffness_Nm2,
        .axial_damping_Ns = p->axial_damping_Ns,
        .bending_damping_Nm2s = p->bending_damping_Nm2s,
        .twist_damping_Nm2s = p->twist_damping_Nm2s,
        .shear_ratio = p->shear_ratio,
        .compression_ratio = p->compression_ratio,
        .gravity_mps2 = gravity_mps2,
        .deck = true,
        .deck_contact = p->deck,
        .support = p->supports,
    };
    for (int k = 0; k < 2; ++k)
        def->end[k] = (bt_cable_end){
            .kind = BT_CABLE_SHEAVE,
            .anchor_m = {0, (k ? 0.5 : -0.5) * p->span_m, p->sheaves.height_m},
            .pretension_N = p->pretension_N,
            .purchase_stiffness_Npm = p->sheaves.purchase_stiffness_Npm,
            .purchase_damping_Npmps = p->sheaves.purchase_damping_Npmps,
        };
    bt_cable_place_supports(p, &def->support_y_m);
    /* unstretched: the pieces fill the span when they are stretched by the pretension */
    const double stretch = 1 + p->pretension_N / p->axial_stiffness_N;
    int half = bt_cable_mesh_half(&p->mesh, 0.5 * p->span_m, NULL);
    half = half < BT_CABLE_SEGMENTS_MAX / 2 ? half : BT_CABLE_SEGMENTS_MAX / 2;
    bt_cable_mesh_half(&p->mesh, 0.5 * p->span_m, length_m + half);
    snap_to_supports(&def->support_y_m, half, length_m + half);
    for (int i = 0; i < half; ++i) {
        length_m[half + i] /= stretch;
        length_m[half - 1 - i] = length_m[half + i];
    }
    def->count = 2 * half;
}
