/// Wheels over a string: in the limit of small height the cable under rolling wheels does what
/// d'Alembert's solution says (it is pressed down along the wheel's profile, sends out two steps at
/// c_T, lies still behind them, comes back when a step returns from the support; in the middle the
/// two inner steps meet on the deck and rebound by its restitution), and the errors go to zero.
#include "landing/cable_contact.h"
#include "tables.h"
#include "test_cable_case.h"

/* A thin string without gravity lies straight on two stiff supports; two narrow stiff wheels press
   it to the deck. At 240 kN the speed of the wheel's profile is small beside c_T = 209 m/s. */
static const double WHEEL_RADIUS_M = 0.47, TENSION_N = 240e3, MU_KGPM = 5.536, HALF_M = 4.8,
                    SUPPORT_M = 3, WHEEL_M = 1.8, OUTER_M = 2.4, RESTITUTION = 0.3;
/* the deck is as stiff as this at a height of 4 mm, and stiffer as the height falls */
static const double HEIGHT_M = 4e-3, DECK_NPM2 = 5e10;

enum { UNDER, INNER_1, INNER_2, MIDDLE, OUTER, PLACES };
static const double PLACE_M[PLACES] = {1.8, 1.2, 0.6, 0, 2.4};

/// What was seen: times from the first touch of the undisturbed theory, heights over h_c.
typedef struct rolled {
    double press_s, touch_s, c_t;    ///< theory: time to the deck; first touch; wave speed
    double fell_to_s[3];             ///< under the wheel, to 0.9, 0.6 and 0.05 of the height
    double down_s[PLACES];           ///< half-way down
    double back_s;                   ///< half-way up again, under the wheel's track
    double profile_rms;              ///< from xi^2 / 2R, under the wheel
    double behind, behind_most;      ///< mean and largest height in the wheel's track until then
    double rebound, tension, middle; ///< of the middle; mean over T_0; when it is on the deck
} rolled;

static void string_open(rope* r, double height_m, double segment_m) {
    const double stretch = 1 + TENSION_N / 5.1e7, radius = 2e-3;
    bt_cable_def def = rope_def(2 * (int)lround(HALF_M / segment_m), 2 * HALF_M);
    def.diameter_m = 2 * radius;
    /* the mesh's own ripple must not beat on the deck: a little bending, less with each halving */
    def.bending_stiffness_Nm2 = 0.25 * TENSION_N * segment_m * segment_m;
    def.bending_damping_Nm2s = 0.6 * sqrt(TENSION_N * MU_KGPM) * pow(segment_m, 3);
    def.twist_stiffness_Nm2 = 0.01;
    def.axial_damping_Ns = 80;
    def.compression_ratio = 0.01;
    def.deck = true;
    def.deck_contact = (bt_cable_deck_params){.stiffness_Npm2 = DECK_NPM2 * HEIGHT_M / height_m,
                                              .restitution = RESTITUTION,
                                              .slip_speed_mps = 1};
    def.support_y_m = (bt_list){.count = 2, .value = {-SUPPORT_M, SUPPORT_M}};
    def.support = (bt_cable_supports_params){.height_m = height_m, .stiffness_Npm = 1e8};
    for (int k = 0; k < 2; ++k)
        def.end[k] = (bt_cable_end){.kind = BT_CABLE_PINNED,
                                    .anchor_m = {0, k ? HALF_M : -HALF_M, height_m + radius}};
    rope_open(r, &def, 2 * HALF_M / stretch);
}

/// A linear tyre as wide as a segment, so stiff that the rope follows it.
static bt_tyre narrow_wheel(double width_m, double bridging_m) {
    const double drag = 2 * sqrt(TENSION_N * MU_KGPM), mass = MU_KGPM * width_m;
    bt_tyre_params p;
    bt_tyre tyre;
    bt_group_set_defaults(&bt_tyre_group, &p);
    p.radius_m = WHEEL_RADIUS_M;
    p.width_m = width_m;
    p.law = BT_TYRE_POWER;
    p.bridging_length_m = bridging_m;
    p.power_exponent = p.power_deflection_m = 1;
    p.power_load_N = 24 * drag * drag / mass;
    bt_tyre_prepare(&p, &tyre);
    return tyre;
}

static void note(double before, double now, double level, double t, double step, double* when) {
    if (isnan(*when) && before > level && now <= level)
        *when = t - step * (level - now) / (before - now);
}

static double underside(const rope* r, double y) {
    double at[3];
    assert_true(bt_cable_centreline(&r->model, &r->state, y, -1, at, NULL, NULL) >= 0);
    return at[2] - r->model.radius_m;
}

/// Both wheels roll on, without friction, at the height at which they just press the string to the
/// deck; x is where they are.
static void roll(rope* r, bt_wheel_contact contact[2], double x, double speed_mps, double step) {
    bt_slides slides = {.count = 0};
    bt_cable_clear_loads(&r->model, &r->state);
    bt_cable_forces(&r->model, &r->state);
    for (int k = 0; k < 2 && x < 0.5 * WHEEL_RADIUS_M; ++k) {
        bt_moving_body wheel = {
            .position_m = {x, k ? WHEEL_M : -WHEEL_M, WHEEL_RADIUS_M + 2 * r->model.radius_m},
            .velocity_mps = {speed_mps, 0, 0},
            .spin_radps = {0, speed_mps / WHEEL_RADIUS_M, 0},
            .rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
        bt_moving_body_to(&wheel, 0);
        bt_wheel_contact_press(&contact[k], &r->model, &r->state, &wheel, &slides, step);
    }
    bt_cable_advance(&r->model, &r->state, step);
}

static rolled roll_over_string(double height_m, double segment_m, double speed_mps,
                               double bridging_m) {
    const double around = WHEEL_RADIUS_M + 2e-3; /* the rope's centre rolls on this radius */
    const double first = sqrt(2 * around * height_m), lead = 2e-3;
    rolled w = {.press_s = first / speed_mps,
                .touch_s = lead / speed_mps,
                .c_t = sqrt(TENSION_N * (1 + TENSION_N / 5.1e7) / MU_KGPM),
                .fell_to_s = {NAN, NAN, NAN},
                .down_s = {NAN, NAN, NAN, NAN, NAN},
                .back_s = NAN,
                .middle = NAN};
    rope r;
    string_open(&r, height_m, segment_m);
    bt_tyre tyre = narrow_wheel(segment_m, bridging_m);
    bt_wheel_contact contact[2];
    for (int k = 0; k < 2; ++k)
        contact[k] = (bt_wheel_contact){
            .tyre = &tyre, .width_m = segment_m, .slip_speed_mps = 1, .hint = -1};
    const double step = 0.9 * r.model.stable_step_s;
    const double meet_s = WHEEL_M / w.c_t, return_s = 2 * (SUPPORT_M - WHEEL_M) / w.c_t;
    double t = 0, before[PLACES] = {1, 1, 1, 1, 1};
    int profiled = 0, lying = 0, bounced = 0;
    while (t < return_s + 3 * w.press_s) {
        roll(&r, contact, speed_mps * t - first - lead, speed_mps, step);
        t += step;
        double now[PLACES];
        for (int k = 0; k < PLACES; ++k) {
            now[k] = underside(&r, PLACE_M[k]) / height_m;
            note(before[k], now[k], 0.5, t, step, &w.down_s[k]);
        }
        static const double levels[3] = {0.9, 0.6, 0.05};
        for (int k = 0; k < 3; ++k)
            note(before[UNDER], now[UNDER], levels[k], t, step, &w.fell_to_s[k]);
        note(before[MIDDLE], now[MIDDLE], 0.02, t, step, &w.middle);
        const double since = t - w.touch_s;
        if (since > 0 && since < w.press_s) {
            w.profile_rms += pow(now[UNDER] - pow(1 - since / w.press_s, 2), 2);
            ++profiled;
        } else if (since > 1.2 * w.press_s && since < 0.9 * return_s) {
            w.behind += now[UNDER];
            w.behind_most = fmax(w.behind_most, fabs(now[UNDER]));
            w.tension += bt_cable_tension(&r.model, &r.state, r.model.count / 2) / TENSION_N;
            ++lying;
        }
        if (since > meet_s + 1.5 * w.press_s && since < meet_s + 1.8 * w.press_s) {
            w.rebound += now[MIDDLE];
            ++bounced;
        }
        if (isnan(w.back_s) && since > 2 * w.press_s && now[UNDER] >= 0.5)
            w.back_s = t - step * (now[UNDER] - 0.5) / (now[UNDER] - before[UNDER]);
        memcpy(before, now, sizeof before);
    }
    rope_close(&r);
    w.profile_rms = sqrt(w.profile_rms / profiled);
    w.behind /= lying;
    w.tension /= lying;
    w.rebound /= bounced;
    return w;
}

enum { QUANTITIES = 9 };
static const char* const quantity_names[QUANTITIES] = {
    "initial downward speed over VE sqrt(2 h / R)",
    "time to the deck over sqrt(2 R h) / VE",
    "speed of the inner step over c_T",
    "speed of the outer step over c_T",
    "time of the return over 2 (s - b) / c_T",
    "time at which the middle is down over b / c_T",
    "rebound of the middle over e h",
    "mean tension over T_0",
    "height behind the steps over h",
};

/// Each over its value by the linear theory; the last is 1 + a height.
static void over_theory(const rolled* w, double out[QUANTITIES]) {
    const double middle_s = w->middle - w->down_s[UNDER];
    out[0] = w->press_s * (sqrt(0.9) - sqrt(0.6)) / (w->fell_to_s[1] - w->fell_to_s[0]);
    out[1] = (w->fell_to_s[2] - w->touch_s) / (w->press_s * (1 - sqrt(0.05)));
    out[2] =
        (PLACE_M[INNER_1] - PLACE_M[INNER_2]) / (w->down_s[INNER_2] - w->down_s[INNER_1]) / w->c_t;
    out[3] = (OUTER_M - WHEEL_M) / (w->down_s[OUTER] - w->down_s[UNDER]) / w->c_t;
    out[4] = (w->back_s - w->down_s[UNDER]) * w->c_t / (2 * (SUPPORT_M - WHEEL_M));
    out[5] = middle_s * w->c_t / WHEEL_M;
    out[6] = w->rebound / RESTITUTION;
    out[7] = w->tension;
    out[8] = 1 + w->behind;
}

static void the_linear_theory_is_met_ever_closer_as_the_height_goes_down(void** state) {
    (void)state;
    /* largest errors at 1 mm: what is left is the width of a segment, the stiffness of the wheel
       and the tension's rise */
    static const double allowed[QUANTITIES] = {1.5e-2, 2e-3, 2e-3, 5e-3, 3e-3,
                                               2e-2,   5e-2, 5e-4, 3e-3};
    double error[3][QUANTITIES], rms[3];
    for (int k = 0; k < 3; ++k) {
        const double height = 16e-3 / (1 << 2 * k);
        const rolled w = roll_over_string(height, 0.02 / (1 << k), 47.5, 0);
        rms[k] = w.profile_rms;
        over_theory(&w, error[k]);
        for (int q = 0; q < QUANTITIES; ++q) {
            char text[96];
            snprintf(text, sizeof text, "h = %g mm: %s", 1e3 * height, quantity_names[q]);
            BT_TABLE_ROW("wheels over a string", text, error[k][q], 1.0,
                         k == 2 ? allowed[q] : fabs(error[k][q] - 1), "d'Alembert");
            error[k][q] -= 1;
        }
        assert_true(w.behind_most < 0.015);
    }
    for (int q = 0; q < QUANTITIES; ++q) {
        if (!(fabs(error[2][q]) < allowed[q]))
            fail_msg("%s: error %g at 1 mm", quantity_names[q], error[2][q]);
        /* the larger errors fall with the height; those within the contact's noise only stay small
         */
        if (fabs(error[0][q]) > 1e-2 && q != 6)
            assert_true(fabs(error[2][q]) < 0.3 * fabs(error[0][q]));
    }
    assert_true(rms[2] < 0.005 && rms[1] < 0.5 * rms[0]);
}

static void it_is_met_at_every_speed_of_landing(void** state) {
    (void)state;
    for (double speed = 40; speed < 71; speed += 15) {
        const rolled w = roll_over_string(1e-3, 0.005, speed, 0);
        double ratio[QUANTITIES];
        over_theory(&w, ratio);
        char text[96];
        snprintf(text, sizeof text, "%g m/s, h = 1 mm: %s", speed, quantity_names[4]);
        BT_VERIFY("wheels over a string", text, ratio[4], 1.0, 4e-3, "d'Alembert");
        BT_ASSERT_NEAR(ratio[1], 1, 0.01, 0);
        BT_ASSERT_NEAR(ratio[2], 1, 3e-3, 0);
        BT_ASSERT_NEAR(ratio[8], 1, 4e-3, 0);
    }
}

/// A carcass makes the stiff wheel stiffer still: the string does the same but for a chatter at the
/// first touch.
static void a_carcass_changes_nothing_that_the_linear_theory_says(void** state) {
    (void)state;
    static const double allowed[QUANTITIES] = {3e-2, 1e-2, 2e-3, 5e-3, 3e-3,
                                               2e-2, 5e-2, 5e-4, 3e-3};
    const rolled w = roll_over_string(1e-3, 0.005, 47.5, 0.05);
    double ratio[QUANTITIES];
    over_theory(&w, ratio);
    for (int q = 0; q < QUANTITIES; ++q) {
        char text[96];
        snprintf(text, sizeof text, "carcass of 50 mm, h = 1 mm: %s", quantity_names[q]);
        BT_VERIFY("wheels over a string", text, ratio[q], 1.0, allowed[q], "d'Alembert");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_linear_theory_is_met_ever_closer_as_the_height_goes_down),
        cmocka_unit_test(it_is_met_at_every_speed_of_landing),
        cmocka_unit_test(a_carcass_changes_nothing_that_the_linear_theory_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
