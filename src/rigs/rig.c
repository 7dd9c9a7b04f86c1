#include "rigs/rig.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bt_status bt_rig_open(bt_rig* rig, bt_rig_observer* observer, void* user, bt_diag* diag) {
    *rig = (bt_rig){.observer = observer, .user = user, .diag = diag};
    return bt_system_create(&rig->system);
}

void bt_rig_close(bt_rig* rig) {
    bt_arena_destroy(&rig->arena);
    bt_system_destroy(rig->system);
}

bt_status bt_rig_start(bt_rig* rig, double gravity_mps2) {
    const double gravity[3] = {0, 0, -gravity_mps2};
    rig->gravity_mps2 = gravity_mps2;
    bt_system_set_gravity(rig->system, gravity);
    BT_TRY(bt_system_assemble(rig->system, rig->diag));
    BT_TRY(bt_arena_create(&rig->arena, bt_state_size(rig->system) + 64));
    return bt_state_create(rig->system, &rig->arena, &rig->state);
}

static bt_status report(const bt_rig* rig, bt_status status, const bt_failure* failure) {
    if (status == BT_ERR_NUMERIC)
        bt_diag_add(rig->diag, BT_ERROR, BT_NOWHERE,
                    "%s of %s diverged at %.6g s; a shorter step may do", failure->quantity,
                    failure->where, failure->time_s);
    return status;
}

/// An element at the end of its range, once.
static void remark(bt_rig* rig, const char* element, const char* what) {
    for (int i = 0; i < rig->remark_count; ++i)
        if (rig->remarks[i].what == what && strcmp(rig->remarks[i].element, element) == 0)
            return;
    if (rig->remark_count == BT_RIG_REMARK_MAX)
        return;
    bt_rig_remark* r = &rig->remarks[rig->remark_count++];
    *r = (bt_rig_remark){.what = what, .time_s = rig->state.time_s};
    snprintf(r->element, sizeof r->element, "%s", element);
}

/// Whether every element is within its law.
static bt_status check_laws(bt_rig* rig) {
    for (int i = 0; i < bt_system_element_count(rig->system); ++i) {
        const char* what = "";
        const bt_law law = bt_system_element_law(rig->system, &rig->state, i, &what);
        const char* name = bt_system_element_name(rig->system, i);
        if (law == BT_LAW_AT_LIMIT)
            remark(rig, name, what);
        if (law != BT_LAW_LEFT)
            continue;
        bt_diag_add(rig->diag, BT_ERROR, BT_NOWHERE,
                    "%s: %s at %.6g s, where its law has no meaning any more", name, what,
                    rig->state.time_s);
        return BT_ERR_NUMERIC;
    }
    return BT_OK;
}

/// Power of weight and outside wrenches, W.
static double weight_power(const bt_rig* rig) {
    double power = 0;
    for (int b = 0; b < rig->body_count; ++b) {
        const double *w = rig->state.applied + 6 * b, *v = rig->state.v + 6 * b;
        power -= rig->mass_kg[b] * rig->gravity_mps2 * v[2];
        for (int i = 0; i < 3; ++i)
            power += w[i] * (v[i] - rig->frame_mps[i]) + w[3 + i] * v[3 + i];
    }
    return power;
}

/// Adds the work since the last state, by the mean of the powers at both ends of the step.
static void count_energy(bt_rig* rig, double step_s) {
    bt_rig_energy* e = &rig->energy;
    double wrench[6 * BT_RIG_BODIES_MAX];
    for (int i = 0; i < bt_system_element_count(rig->system); ++i) {
        const double power =
            bt_system_element_power(rig->system, &rig->state, i, rig->frame_mps, wrench);
        e->taken[i] -= 0.5 * step_s * (power + e->power_W[i]);
        e->power_W[i] = power;
    }
    const double power = weight_power(rig);
    e->weight += 0.5 * step_s * (power + e->weight_W);
    e->weight_W = power;
}

static double kinetic_energy(const bt_rig* rig) {
    double sum = 0;
    for (int b = 0; b < rig->body_count; ++b)
        sum += bt_system_body_energy(rig->system, &rig->state, b, rig->frame_mps);
    return sum;
}

bt_status bt_rig_begin(bt_rig* rig) {
    bt_failure failure = {"the rig", "motion", rig->state.time_s};
    BT_TRY(report(rig, bt_system_evaluate(rig->system, &rig->state, &failure), &failure));
    rig->energy.impact = kinetic_energy(rig);
    count_energy(rig, 0);
    return BT_OK;
}

bt_status bt_rig_step(bt_rig* rig, double step_s) {
    bt_failure failure = {"the rig", "motion", rig->state.time_s};
    BT_TRY(report(
        rig, bt_system_step(rig->system, &rig->state, step_s, BT_INTEGRATOR_SECOND_ORDER, &failure),
        &failure));
    count_energy(rig, step_s);
    return check_laws(rig);
}

int bt_rig_add_body(bt_rig* rig, const bt_body_def* def) {
    rig->mass_kg[rig->body_count++] = def->mass_kg;
    return bt_system_add_body(rig->system, def);
}

const double* bt_rig_output(const bt_rig* rig, int element) {
    return bt_system_element_output(rig->system, &rig->state, element);
}

void bt_rig_show_at(const bt_rig* rig, double time_s, int count, const char* const* names,
                    const double* values) {
    if (!rig->observer)
        return;
    const bt_rig_sample sample = {time_s, count, names, values};
    rig->observer(rig->user, &sample);
}

void bt_rig_show(const bt_rig* rig, int count, const char* const* names, const double* values) {
    bt_rig_show_at(rig, rig->state.time_s, count, names, values);
}

void bt_rig_add(bt_rig_result* result, const char* name, const char* unit, double value,
                double reference, double tolerance) {
    bt_metric* m = &result->metrics[result->metric_count++];
    *m = (bt_metric){name, unit, value, NAN, NAN, NAN, true};
    if (!(reference > 0))
        return;
    m->tolerance = tolerance;
    m->reference = reference;
    m->error_percent = 100 * (value - reference) / reference;
    m->accepted = fabs(m->error_percent) <= 100 * tolerance;
}

void bt_rig_result_begin(const bt_rig* rig, bt_rig_result* result) {
    *result = (bt_rig_result){.steps = rig->state.steps,
                              .end_time_s = rig->state.time_s,
                              .remark_count = rig->remark_count};
    memcpy(result->remarks, rig->remarks, sizeof result->remarks);
}

void bt_rig_add_energy(const bt_rig* rig, bt_rig_result* result, int count, const int* elements,
                       const char* const* names) {
    const bt_rig_energy* e = &rig->energy;
    const double left = kinetic_energy(rig);
    double residual = e->impact + e->weight - left;
    for (int i = 0; i < bt_system_element_count(rig->system); ++i)
        residual -= e->taken[i];
    bt_rig_add(result, "impact_energy_J", "J", e->impact, 0, 0);
    bt_rig_add(result, "weight_work_J", "J", e->weight, 0, 0);
    for (int i = 0; i < count; ++i)
        bt_rig_add(result, names[i], "J", e->taken[elements[i]], 0, 0);
    bt_rig_add(result, "left_J", "J", left, 0, 0);
    bt_rig_add(result, "energy_residual_J", "J", residual, 0, 0);
}
