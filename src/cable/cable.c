#include "cable/cable_kernel.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* ---- parameters ---- */

#define MESH_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_mesh_params, name, __VA_ARGS__)
#define SUPPORTS_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_supports_params, name, __VA_ARGS__)
#define DECK_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_deck_params, name, __VA_ARGS__)
#define SHEAVES_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_sheaves_params, name, __VA_ARGS__)
#define CABLE_ROW(kind, name, ...) BT_ROW_##kind(bt_cable_params, name, __VA_ARGS__)

static void check_mesh(const void* params, const char* path, bt_diag* diag) {
    const bt_cable_mesh_params* p = params;
    if (p->medium_half_width_m < p->fine_half_width_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.medium_half_width: %g m lies inside the fine part; at least %g m", path,
                    p->medium_half_width_m, p->fine_half_width_m);
    if (p->medium_length_m < p->fine_length_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.medium_length: %g m is finer than the fine part; at least %g m", path,
                    p->medium_length_m, p->fine_length_m);
    if (p->coarse_length_m < p->medium_length_m)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.coarse_length: %g m is finer than the medium part; at least %g m", path,
                    p->coarse_length_m, p->medium_length_m);
}

BT_DEFINE_GROUP(cable_mesh, BT_CABLE_MESH_FIELDS, MESH_ROW, check_mesh,
                "segment lengths along the cable, symmetric about the middle")
BT_DEFINE_GROUP(cable_supports, BT_CABLE_SUPPORTS_FIELDS, SUPPORTS_ROW, NULL,
                "wire supports: leaf springs that hold the cable above the deck")
BT_DEFINE_GROUP(cable_deck, BT_CABLE_DECK_FIELDS, DECK_ROW, NULL, "cable on deck")
BT_DEFINE_GROUP(cable_sheaves, BT_CABLE_SHEAVES_FIELDS, SHEAVES_ROW, NULL,
                "deck sheaves and the purchase cable behind them")

static void place_supports(const bt_cable_params* p, bt_list* y) {
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

/// Segments that the mesh makes, for one half of the span; lengths may be NULL.
static int mesh_half(const bt_cable_mesh_params* mesh, double half_span, double* length) {
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

static void check_cable(const void* params, const char* path, bt_diag* diag) {
    const bt_cable_params* p = params;
    const bt_cable_supports_params* s = &p->supports;
    if (!(p->span_m >= 2 * s->first_m + 0.6)) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.span: %g m does not reach past the first supports at +-%g m; at least %g m",
                    path, p->span_m, s->first_m, 2 * s->first_m + 0.6);
        return;
    }
    const int count = 2 * mesh_half(&p->mesh, 0.5 * p->span_m, NULL);
    if (count < 4 || count > BT_CABLE_SEGMENTS_MAX)
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.mesh: gives %d segments or more; between 4 and %d are possible (coarser "
                    "lengths or narrower parts)",
                    path, count, (int)BT_CABLE_SEGMENTS_MAX);
    if (!(p->sheaves.height_m >= 0.5 * p->diameter_m))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.sheaves.height: %g m puts the cable inside the deck; at least %g m (half "
                    "its diameter)",
                    path, p->sheaves.height_m, 0.5 * p->diameter_m);
    /* the heaviest bay carries its own weight; a support carries half of its two bays */
    const double weight = p->mass_kgpm * 9.80665;
    bt_list y;
    place_supports(p, &y);
    const double bay = y.count > 2 ? s->spacing_m : 0.5 * p->span_m - s->first_m;
    const double sink = weight * (s->first_m + 0.5 * bay) / s->stiffness_Npm;
    const double clear = s->height_m - sink;
    const double sag = weight * 4 * s->first_m * s->first_m / (8 * p->pretension_N);
    if (!(clear > 0))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.supports.stiffness: %g N/m lets the cable's weight press the supports to "
                    "the deck; above %g N/m",
                    path, s->stiffness_Npm, weight * (s->first_m + 0.5 * bay) / s->height_m);
    else if (!(sag < clear))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.pretension: at %g N the cable sags %g m between the first supports and "
                    "starts inside the deck; above %g N, or supports above %g m",
                    path, p->pretension_N, sag, p->pretension_N * sag / clear, sag + sink);
    /* straight from the sheave to the unloaded support next but one: it must press on the outermost
     */
    const double edge = 0.5 * p->span_m - y.value[y.count - 1];
    const double centre = s->height_m + 0.5 * p->diameter_m;
    const double pull = p->pretension_N * (p->sheaves.height_m - centre) / edge;
    const double share = 0.5 * weight * (edge + (y.count > 2 ? s->spacing_m : 2 * s->first_m));
    if (!(pull < share))
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "%s.sheaves.height: from %g m the cable starts above its outermost supports; "
                    "below %g m, or a smaller pretension",
                    path, p->sheaves.height_m, centre + share * edge / p->pretension_N);
}

BT_DEFINE_GROUP(cable, BT_CABLE_FIELDS, CABLE_ROW, check_cable,
                "the arresting cable and what holds it")

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
    place_supports(p, &def->support_y_m);
    /* unstretched: the pieces fill the span when they are stretched by the pretension */
    const double stretch = 1 + p->pretension_N / p->axial_stiffness_N;
    int half = mesh_half(&p->mesh, 0.5 * p->span_m, NULL);
    half = half < BT_CABLE_SEGMENTS_MAX / 2 ? half : BT_CABLE_SEGMENTS_MAX / 2;
    mesh_half(&p->mesh, 0.5 * p->span_m, length_m + half);
    snap_to_supports(&def->support_y_m, half, length_m + half);
    for (int i = 0; i < half; ++i) {
        length_m[half + i] /= stretch;
        length_m[half - 1 - i] = length_m[half + i];
    }
    def->count = 2 * half;
}

/* ---- model ---- */

static int padded_count(int count) {
    return (count + BT_CABLE_LANES - 1) / BT_CABLE_LANES * BT_CABLE_LANES;
}

/// Room for one vector behind the last segment, an odd number of vectors: no power of two.
static int stride_of(int count) {
    const int vectors = padded_count(count) / BT_CABLE_LANES + 1;
    return (vectors | 1) * BT_CABLE_LANES;
}

enum { MODEL_ARRAYS = 8, STATE_ARRAYS = 42 };

size_t bt_cable_memory(int count, int states) {
    const size_t array = (size_t)stride_of(count) * sizeof(double);
    return MODEL_ARRAYS * array +
           (size_t)states * (STATE_ARRAYS * array + sizeof(struct bt_cable_scalars) + 128) + 1024;
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
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "cable: the %s cannot be used", bad);
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

/* ---- state ---- */

bt_status bt_cable_state_init(const bt_cable_model* model, bt_cable_state* state, bt_arena* arena) {
    *state = (bt_cable_state){0};
    const size_t array = (size_t)model->stride * sizeof(double);
    state->block_size = STATE_ARRAYS * array + sizeof(struct bt_cable_scalars);
    state->block = bt_arena_take(arena, state->block_size);
    if (!state->block)
        return BT_ERR_MEMORY;
    double** members[STATE_ARRAYS] = {
        &state->x,        &state->y,        &state->z,          &state->e0,
        &state->e1,       &state->e2,       &state->e3,         &state->vx,
        &state->vy,       &state->vz,       &state->hx,         &state->hy,
        &state->hz,       &state->wx,       &state->wy,         &state->wz,
        &state->tx,       &state->ty,       &state->tz,         &state->fx,
        &state->fy,       &state->fz,       &state->mx,         &state->my,
        &state->mz,       &state->joint_fx, &state->joint_fy,   &state->joint_fz,
        &state->before_x, &state->before_y, &state->before_z,   &state->after_x,
        &state->after_y,  &state->after_z,  &state->support_fz, &state->support_mx,
        &state->net[0],   &state->net[1],   &state->net[2],     &state->net[3],
        &state->net[4],   &state->net[5],
    };
    for (int k = 0; k < STATE_ARRAYS; ++k)
        *members[k] = state->block + (size_t)k * (size_t)model->stride;
    state->scalars = (struct bt_cable_scalars*)(void*)(state->block + STATE_ARRAYS * model->stride);
    bt_cable_place(model, state);
    return BT_OK;
}

void bt_cable_state_copy(const bt_cable_model* model, bt_cable_state* to,
                         const bt_cable_state* from) {
    (void)model;
    memcpy(to->block, from->block, from->block_size);
}

void bt_cable_set_axis(bt_cable_state* state, int i) {
    const double a = state->e0[i], b = state->e1[i], c = state->e2[i], d = state->e3[i];
    state->tx[i] = 2 * (b * c - a * d);
    state->ty[i] = 1 - 2 * (b * b + d * d);
    state->tz[i] = 2 * (c * d + a * b);
}

/// Sag over span of a hanging rope with w = weight per length, length over span and EA:
/// parabola, 1 + (w S / H)^2 / 24 = (L / S) (1 + H / EA); H by bisection. 0 when it is tight.
static double sag_ratio(const bt_cable_model* model, double span) {
    const bt_cable_def* d = &model->def;
    const double weight = d->mass_kgpm * d->gravity_mps2 * span;
    double length = 0;
    for (int i = 0; i < model->count; ++i)
        length += 2 * model->half_m[i];
    if (d->end[0].kind != BT_CABLE_PINNED || d->end[1].kind != BT_CABLE_PINNED || !(weight > 0))
        return 0;
    double low = 1e-12 * d->axial_stiffness_N, high = d->axial_stiffness_N;
    for (int k = 0; k < 200; ++k) {
        const double h = sqrt(low * high), slope = weight / h;
        if (1 + slope * slope / 24 > length / span * (1 + h / d->axial_stiffness_N))
            low = h;
        else
            high = h;
    }
    return weight / (8 * low);
}

/// A rope much longer than the line between its ends hangs as a catenary of its length: with
/// arguments b - a .. b + a of scale p, sinh(a) / a = sqrt(L^2 - rise^2) / span, tanh(b) = rise /
/// L.
static void place_slack(const bt_cable_model* model, bt_cable_state* state, double length) {
    const double* from = model->def.end[0].anchor_m;
    const double* to = model->def.end[1].anchor_m;
    const double span = to[1] - from[1], rise = to[2] - from[2];
    const double ratio = sqrt(length * length - rise * rise) / span;
    double low = 1e-9, high = 50;
    for (int k = 0; k < 100; ++k) {
        const double a = 0.5 * (low + high);
        if (sinh(a) / a < ratio)
            low = a;
        else
            high = a;
    }
    const double p = 0.5 * span / low, first = atanh(rise / length) - low;
    for (int i = 0; i < model->count; ++i) {
        const double along = length * (model->rest_y_m[i] - from[1]) / span;
        const double at = asinh(along / p + sinh(first)), slope = atan(sinh(at));
        state->y[i] = from[1] + p * (at - first);
        state->z[i] = from[2] + p * (cosh(at) - cosh(first));
        state->e0[i] = cos(0.5 * slope);
        state->e1[i] = sin(0.5 * slope);
        bt_cable_set_axis(state, i);
    }
}

void bt_cable_place(const bt_cable_model* model, bt_cable_state* state) {
    const bt_cable_def* d = &model->def;
    memset(state->block, 0, state->block_size);
    double along[3], span = 0;
    for (int k = 0; k < 3; ++k)
        along[k] = d->end[1].anchor_m[k] - d->end[0].anchor_m[k];
    span = along[1];
    const double sag = sag_ratio(model, span);
    for (int i = 0; i < model->stride; ++i) {
        state->e0[i] = 1;
        state->ty[i] = 1;
        if (i >= model->count)
            continue;
        const double u = (model->rest_y_m[i] - d->end[0].anchor_m[1]) / span;
        state->x[i] = d->end[0].anchor_m[0] + u * along[0];
        state->y[i] = model->rest_y_m[i];
        state->z[i] = d->end[0].anchor_m[2] + u * along[2] - 4 * sag * span * u * (1 - u);
        const double slope = atan(along[2] / span - 4 * sag * (1 - 2 * u));
        state->e0[i] = cos(0.5 * slope);
        state->e1[i] = sin(0.5 * slope);
        bt_cable_set_axis(state, i);
    }
    double length = 0;
    for (int i = 0; i < model->count; ++i)
        length += 2 * model->half_m[i];
    if (sag > 0 && length > 1.2 * hypot(span, along[2]))
        place_slack(model, state, length);
    for (int k = 0; k < 2; ++k) {
        memcpy(state->scalars->anchor_m[k], d->end[k].anchor_m, sizeof d->end[k].anchor_m);
        state->scalars->anchor_e[k][0] = 1;
    }
    for (int k = 0; k < BT_LIST_MAX; ++k)
        state->scalars->support_at[k] = -1;
}
