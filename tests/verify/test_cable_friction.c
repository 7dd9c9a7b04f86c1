/// Friction of wheels and hook on the cable over whole landings: what it takes, and that the
/// outcome does not hang on its regularisation.
#include "reference.h"

#include "base/rng.h"
#include "landing/view.h"
#include "tables.h"

/* ---- it only takes ---- */

enum { LANDINGS = 500 };

typedef struct seen {
    double work_J, most_J; ///< so far; of one cable step
    double worst_rise_J;   ///< from one view to the next
} seen;

static void see(void* user, const bt_landing_view* view) {
    seen* s = user;
    s->worst_rise_J = fmax(s->worst_rise_J, view->friction_J - s->work_J);
    s->work_J = view->friction_J;
    s->most_J = view->friction_most_J;
}

/// Landing i: every other one from the study's distributions, the others from anywhere in the box
/// of its design.
static bt_model_params draw(const bt_study* study, uint64_t i) {
    bt_model_params model = study->model;
    for (int k = 0; k < study->input_count; ++k) {
        const bt_input* input = &study->inputs[k];
        const double u = bt_rng_uniform(20261127, i, (uint32_t)k);
        const double x = i % 2 ? input->lower + u * (input->upper - input->lower)
                               : bt_distribution_quantile(&input->distribution, u);
        bt_field_set(input->field, &model, input->offset,
                     fmin(fmax(x, input->field->least), input->field->greatest));
    }
    return model;
}

/// Force times the mean of the slips before and after, of every cable step of every landing.
static void it_gives_no_energy_in_any_step_of_500_landings(void** state) {
    (void)state;
    static bt_study study;
    assert_int_equal(bt_study_read("studies/reference/study.yaml", NULL, 0, &study, NULL), BT_OK);
    bt_lander* lander = new_lander();
    int touched = 0;
    double least = 0, sum = 0, most = -INFINITY;
    for (uint64_t i = 0; i < LANDINGS; ++i) {
        const bt_model_params model = draw(&study, i);
        seen s = {0};
        land(lander, &model, see, &s);
        assert_true(s.worst_rise_J <= 0);
        most = fmax(most, s.most_J);
        least = fmin(least, s.work_J);
        sum += s.work_J;
        touched += s.work_J < 0;
    }
    bt_lander_destroy(lander);
    bt_study_destroy(&study);
    assert_true(touched > LANDINGS * 9 / 10);
    assert_true(most < 0);
    BT_TABLE_ROW("friction on the cable", "work in a landing, mean of 500, J", sum / LANDINGS, 0,
                 -sum / LANDINGS, "never positive");
    BT_TABLE_ROW("friction on the cable", "work in a landing, most taken, J", least, 0, -least,
                 "never positive");
}

/* ---- regularisation ---- */

/// The margin at which the label changes when the lip rises, by bisection of its height.
static double margin_at_change(bt_lander* lander, bt_model_params* model) {
    double caught = 0.024, missed = 0.034, margin_m = NAN;
    while (missed - caught > 2e-7) {
        const double middle = 0.5 * (caught + missed);
        model->aircraft.hook.profile.lip_height_m = middle;
        const bt_landing_result r = land(lander, model, NULL, NULL);
        margin_m = r.margin_m;
        if (r.outcome == BT_ENGAGED)
            caught = middle;
        else
            missed = middle;
    }
    return margin_m;
}

static void the_label_converges_with_the_slip_speed(void** state) {
    (void)state;
    bt_model_params model =
        REFERENCE("aircraft.hook.profile.throat_length=35 mm", "landing.distance=2 m");
    bt_lander* lander = new_lander();
    double* slip_mps = &model.aircraft.hook.cable_contact.slip_speed_mps;
    *slip_mps = 1e-3;
    const double exact = margin_at_change(lander, &model);
    static const double slips[] = {1, 0.1, 0.01}, within_m[] = {3e-5, 3e-6, 1e-6};
    for (int k = 0; k < 3; ++k) {
        char text[64];
        *slip_mps = slips[k];
        snprintf(text, sizeof text, "margin where the label changes, slip speed %g m/s", slips[k]);
        BT_VERIFY("friction on the cable", text, margin_at_change(lander, &model), exact,
                  within_m[k], "slip speed 1 mm/s");
    }
    bt_lander_destroy(lander);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_gives_no_energy_in_any_step_of_500_landings),
        cmocka_unit_test(the_label_converges_with_the_slip_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
