/// The cable's parameters, mesh, contacts and questions.
#include "cable/cable.h"

#include <stdio.h>
#include <stdlib.h>

#include "near.h"

#define G 9.80665

static bt_cable_params defaults(void) {
    bt_cable_params p;
    bt_group_set_defaults(&bt_cable_group, &p);
    return p;
}

typedef struct caught {
    char text[1024];
} caught;

static void keep_text(void* user, bt_severity severity, bt_where where, const char* text) {
    caught* c = user;
    (void)severity;
    (void)where;
    snprintf(c->text, sizeof c->text, "%s", text);
}

/// The parameters are refused, and the text has both pieces.
static void assert_refused(const bt_cable_params* p, const char* path, const char* remedy) {
    caught c = {""};
    bt_diag diag = {.sink = keep_text, .user = &c};
    assert_int_not_equal(bt_group_check(&bt_cable_group, p, "deck.cable", &diag), BT_OK);
    if (!strstr(c.text, path) || !strstr(c.text, remedy))
        fail_msg("\"%s\" names neither \"%s\" nor \"%s\"", c.text, path, remedy);
}

static void defaults_are_accepted(void** state) {
    (void)state;
    const bt_cable_params p = defaults();
    bt_diag diag = {0};
    assert_int_equal(bt_group_check(&bt_cable_group, &p, "cable", &diag), BT_OK);
}

static void cable_inside_the_deck_is_refused_with_the_value_that_would_do(void** state) {
    (void)state;
    bt_cable_params p = defaults();
    p.sheaves.height_m = 0.01;
    assert_refused(&p, "deck.cable.sheaves.height", "at least 0.01825 m");
    p = defaults();
    p.pretension_N = 8e3; /* sags 122 mm */
    assert_refused(&p, "deck.cable.pretension", "above 10482");
    p = defaults();
    p.supports.stiffness_Npm = 3e3;
    assert_refused(&p, "deck.cable.supports.stiffness", "above 4743");
}

static void cable_above_its_supports_is_refused_with_the_value_that_would_do(void** state) {
    (void)state;
    bt_cable_params p = defaults();
    p.sheaves.height_m = 0.3;
    assert_refused(&p, "deck.cable.sheaves.height", "below 0.20");
    /* the value named is the limit: a little less comes to rest on its supports */
    p.sheaves.height_m = 0.20;
    bt_diag diag = {0};
    assert_int_equal(bt_group_check(&bt_cable_group, &p, "cable", &diag), BT_OK);
}

static void span_inside_the_supports_and_bad_mesh_are_refused(void** state) {
    (void)state;
    bt_cable_params p = defaults();
    p.span_m = 11;
    assert_refused(&p, "deck.cable.span", "at least 12.6 m");
    p = defaults();
    p.mesh.medium_length_m = 0.02;
    assert_refused(&p, "deck.cable.mesh.medium_length", "at least 0.05 m");
    p = defaults();
    p.mesh.coarse_length_m = 0.06;
    assert_refused(&p, "deck.cable.mesh.coarse_length", "at least 0.1 m");
    p = defaults();
    p.mesh.medium_half_width_m = 1;
    assert_refused(&p, "deck.cable.mesh.medium_half_width", "at least 3 m");
}

/// Eq. 11: finite segments.
static void mesh_fills_the_span_evenly_graded_with_joints_over_the_supports(void** state) {
    (void)state;
    static double length[BT_CABLE_SEGMENTS_MAX];
    for (int k = 0; k < 3; ++k) {
        bt_cable_params p = defaults();
        p.mesh.fine_length_m = k == 1 ? 0.031 : 0.05;
        p.supports.first_m = k == 2 ? 2.51 : 6;
        p.span_m = k == 2 ? 33.3 : 36;
        bt_cable_def def;
        bt_cable_def_init(&def, &p, G, length);
        const double stretch = 1 + p.pretension_N / p.axial_stiffness_N;
        double at = -0.5 * p.span_m;
        int joints_on_supports = 0;
        for (int i = 0; i < def.count; ++i) {
            assert_true(length[i] == length[def.count - 1 - i]);
            assert_true(length[i] < 1.06 * p.mesh.coarse_length_m);
            assert_true(length[i] > 0.96 * p.mesh.fine_length_m);
            if (i > 0)
                assert_true(length[i] / length[i - 1] < 1.3 && length[i - 1] / length[i] < 1.3);
            at += length[i] * stretch;
            for (int s = 0; s < def.support_y_m.count; ++s)
                joints_on_supports += fabs(at - def.support_y_m.value[s]) < 1e-9;
        }
        BT_ASSERT_NEAR(at, 0.5 * p.span_m, 1e-12, 0);
        assert_int_equal(joints_on_supports, def.support_y_m.count);
        assert_int_equal(def.support_y_m.count, 4);
    }
}

static void model_refuses_what_cannot_be_computed(void** state) {
    (void)state;
    bt_arena arena;
    assert_int_equal(bt_arena_create(&arena, 1 << 20), BT_OK);
    static double length[BT_CABLE_SEGMENTS_MAX];
    const bt_cable_params p = defaults();
    bt_cable_def def;
    bt_cable_def_init(&def, &p, G, length);
    bt_cable_model model;
    length[3] = NAN;
    caught c = {""};
    bt_diag diag = {.sink = keep_text, .user = &c};
    assert_int_equal(bt_cable_model_init(&model, &def, &arena, &diag), BT_ERR_INPUT);
    assert_string_equal(c.text, "deck.cable: the segment length cannot be used");
    length[3] = 0.1;
    def.count = 1;
    assert_int_equal(bt_cable_model_init(&model, &def, &arena, &diag), BT_ERR_INPUT);
    bt_arena_destroy(&arena);
    bt_cable_def_init(&def, &p, G, length);
    assert_int_equal(bt_arena_create(&arena, 1 << 10), BT_OK);
    assert_int_equal(bt_cable_model_init(&model, &def, &arena, &diag), BT_ERR_MEMORY);
    bt_arena_destroy(&arena);
}

/* ---- a short stiff rope on the deck ---- */

typedef struct rod {
    bt_arena arena;
    bt_cable_model model;
    bt_cable_state state;
} rod;

/// Four free segments of 0.1 m, centres at height z.
static void rod_open(rod* r, const bt_cable_params* p, double gravity, double z) {
    static const double length[4] = {0.1, 0.1, 0.1, 0.1};
    static double unused[BT_CABLE_SEGMENTS_MAX];
    bt_cable_def def;
    bt_cable_def_init(&def, p, gravity, unused);
    def.count = 4;
    def.length_m = length;
    def.support_y_m.count = 0;
    for (int k = 0; k < 2; ++k)
        def.end[k] = (bt_cable_end){.anchor_m = {0, 0.4 * k, z}};
    assert_int_equal(bt_arena_create(&r->arena, bt_cable_memory(4, 1)), BT_OK);
    assert_int_equal(bt_cable_model_init(&r->model, &def, &r->arena, NULL), BT_OK);
    assert_int_equal(bt_cable_state_init(&r->model, &r->state, &r->arena), BT_OK);
}

static void deck_gives_the_restitution_at_any_speed(void** state) {
    (void)state;
    for (double e = 0.15; e < 1; e += 0.2)
        for (double v = 0.1; v < 50; v *= 6) {
            bt_cable_params p = defaults();
            p.deck.restitution = e;
            rod r;
            rod_open(&r, &p, 0, 0.02);
            for (int i = 0; i < 4; ++i)
                r.state.vz[i] = -v;
            const double step = 0.02 * r.model.stable_step_s;
            for (int k = 0; k < 400000 && !(r.state.vz[1] > 0 && r.state.z[1] > 0.0183); ++k)
                bt_cable_step(&r.model, &r.state, step);
            BT_ASSERT_NEAR(r.state.vz[1] / v, e, 0, 0.01);
            bt_arena_destroy(&r.arena);
        }
}

static void deck_carries_the_weight_and_never_pulls(void** state) {
    (void)state;
    const bt_cable_params p = defaults();
    rod r;
    rod_open(&r, &p, G, 0.02);
    double highest = 0;
    for (int k = 0; k < 100000; ++k) {
        bt_cable_step(&r.model, &r.state, r.model.stable_step_s);
        highest = fmax(highest, r.state.z[1]);
    }
    assert_true(highest <= 0.02);
    BT_ASSERT_NEAR(0.01825 - r.state.z[1], 5.536 * G / p.deck.stiffness_Npm2, 1e-3, 0);
    bt_arena_destroy(&r.arena);
}

static void friction_stops_sliding_along_and_makes_sliding_across_roll(void** state) {
    (void)state;
    bt_cable_params p = defaults();
    p.deck.slip_speed_mps = 1e-3;
    rod r;
    rod_open(&r, &p, G, 0.01825 - 5.536 * G / p.deck.stiffness_Npm2);
    for (int i = 0; i < 4; ++i)
        r.state.vx[i] = 1.5;
    const double step = r.model.stable_step_s;
    /* sliding: v falls by mu g t until v = 2/3 v0, then a solid cylinder rolls */
    const int early = (int)(0.1 / step), late = (int)(0.4 / step);
    for (int k = 0; k < early; ++k)
        bt_cable_step(&r.model, &r.state, step);
    BT_ASSERT_NEAR(r.state.vx[2], 1.5 - 0.3 * G * early * step, 1e-3, 0);
    for (int k = early; k < late; ++k)
        bt_cable_step(&r.model, &r.state, step);
    BT_ASSERT_NEAR(r.state.vx[2], 1.0, 2e-3, 0);
    BT_ASSERT_NEAR(r.state.wy[2] * 0.01825, 1.0, 2e-3, 0);
    bt_arena_destroy(&r.arena);

    rod_open(&r, &p, G, 0.01825 - 5.536 * G / p.deck.stiffness_Npm2);
    for (int i = 0; i < 4; ++i)
        r.state.vy[i] = 0.5;
    for (int k = 0; k < late; ++k)
        bt_cable_step(&r.model, &r.state, step);
    double slide = 0;
    for (int i = 0; i < 4; ++i)
        slide = fmax(slide, fabs(r.state.vy[i]));
    assert_true(slide < 1e-3); /* 0.5 m/s end after 0.17 s */
    bt_arena_destroy(&r.arena);
}

/* ---- the whole cable ---- */

static void cable_open(rod* r, const bt_cable_params* p) {
    static double length[BT_CABLE_SEGMENTS_MAX];
    bt_cable_def def;
    bt_cable_def_init(&def, p, G, length);
    assert_int_equal(bt_arena_create(&r->arena, bt_cable_memory(def.count, 1)), BT_OK);
    assert_int_equal(bt_cable_model_init(&r->model, &def, &r->arena, NULL), BT_OK);
    assert_int_equal(bt_cable_state_init(&r->model, &r->state, &r->arena), BT_OK);
    assert_int_equal(bt_cable_equilibrium(&r->model, &r->state, NULL, NULL), BT_OK);
}

static void supports_push_up_and_let_go(void** state) {
    (void)state;
    const bt_cable_params p = defaults();
    rod r;
    cable_open(&r, &p);
    for (int k = 0; k < 4; ++k)
        assert_true(r.state.scalars->support_force_N[k] > 300);
    for (int i = 0; i < r.model.count; ++i)
        r.state.z[i] += 0.05;
    bt_cable_step(&r.model, &r.state, 1e-6);
    for (int k = 0; k < 4; ++k)
        assert_true(r.state.scalars->support_force_N[k] == 0);
    for (int i = 0; i < r.model.count; ++i)
        assert_true(r.state.support_fz[i] == 0 && r.state.support_mx[i] == 0);
    bt_arena_destroy(&r.arena);
}

static void support_force_does_not_jump_when_the_cable_slides(void** state) {
    (void)state;
    bt_cable_params p = defaults();
    p.supports.damping_Npmps = 0;
    rod r;
    cable_open(&r, &p);
    double before = r.state.scalars->support_force_N[1], most = 0, start = before;
    for (int k = 0; k < 1000; ++k) { /* 0.5 m, across whole segments */
        for (int i = 0; i < r.model.count; ++i)
            r.state.y[i] += 5e-4;
        bt_cable_audit(&r.model, &r.state, &(bt_cable_energy){0});
        most = fmax(most, fabs(r.state.scalars->support_force_N[1] - before));
        before = r.state.scalars->support_force_N[1];
    }
    assert_true(most < 0.01 * start);
    bt_arena_destroy(&r.arena);
}

static void centreline_is_continuous_and_segment_at_finds_the_piece(void** state) {
    (void)state;
    const bt_cable_params p = defaults();
    rod r;
    cable_open(&r, &p);
    double before[3] = {0}, now[3], velocity[3], direction[3];
    int hint = -1;
    for (double y = -17.7; y < 17.7; y += 1e-3) {
        const int i = bt_cable_centreline(&r.model, &r.state, y, hint, now, velocity, direction);
        assert_true(i >= 0 && i < r.model.count - 1);
        assert_int_equal(i, bt_cable_centreline(&r.model, &r.state, y, -1, now, NULL, NULL));
        hint = i;
        if (y > -17.7)
            BT_ASSERT_NEAR(now[2], before[2], 0, 5e-5);
        BT_ASSERT_NEAR(direction[1], 1, 1e-3, 0);
        const int piece = bt_cable_segment_at(&r.model, &r.state, y, -1);
        assert_true(fabs(y - r.state.y[piece]) < 1.001 * r.model.half_m[piece]);
        memcpy(before, now, sizeof now);
    }
    assert_int_equal(bt_cable_segment_at(&r.model, &r.state, 18.1, -1), -1);
    assert_int_equal(bt_cable_segment_at(&r.model, &r.state, -17.95, -1), 0);
    assert_int_equal(bt_cable_centreline(&r.model, &r.state, 17.99, -1, now, NULL, NULL), -1);
    bt_arena_destroy(&r.arena);
}

static void equilibrium_says_when_the_cable_hangs_clear_of_a_support(void** state) {
    (void)state;
    bt_cable_params p = defaults();
    p.sheaves.height_m = 0.3;
    p.supports.height_m = 0.05;
    p.pretension_N = 60e3;
    static double length[BT_CABLE_SEGMENTS_MAX];
    bt_cable_def def;
    bt_cable_def_init(&def, &p, G, length);
    rod r;
    assert_int_equal(bt_arena_create(&r.arena, bt_cable_memory(def.count, 1)), BT_OK);
    assert_int_equal(bt_cable_model_init(&r.model, &def, &r.arena, NULL), BT_OK);
    assert_int_equal(bt_cable_state_init(&r.model, &r.state, &r.arena), BT_OK);
    caught c = {""};
    bt_diag diag = {.sink = keep_text, .user = &c};
    assert_int_equal(bt_cable_equilibrium(&r.model, &r.state, NULL, &diag), BT_ERR_NUMERIC);
    assert_non_null(strstr(c.text, "above its support at y ="));
    bt_arena_destroy(&r.arena);
}

static void supports_below_the_sheaves_still_carry_the_cable(void** state) {
    (void)state;
    bt_cable_params p = defaults();
    for (double height = 0.060; height < 0.104; height += 0.007) {
        p.supports.height_m = height;
        rod r;
        cable_open(&r, &p);
        /* the two inner supports carry about 9 m of cable each: half of 12 m and half of 6 m */
        for (int k = 0; k < r.model.def.support_y_m.count; ++k) {
            const double force = r.state.scalars->support_force_N[k];
            assert_true(force > 0);
            if (fabs(fabs(r.model.def.support_y_m.value[k]) - p.supports.first_m) < 1e-9)
                BT_ASSERT_NEAR(force, 9 * p.mass_kgpm * G, 0.04, 0); // higher sheaves take 1-3.5 %
        }
        bt_arena_destroy(&r.arena);
    }
}

static void supports_of_any_stiffness_and_height_find_their_equilibrium(void** state) {
    (void)state;
    static const double stiffness[] = {2e4, 1.2e5, 5e5, 5e6, 1e7};
    for (int k = 0; k < 5; ++k)
        for (double height = 0.070; height < 0.131; height += 0.015) {
            bt_cable_params p = defaults();
            p.supports.stiffness_Npm = stiffness[k];
            p.supports.height_m = height;
            rod r;
            cable_open(&r, &p);
            for (int i = 0; i < r.model.def.support_y_m.count; ++i)
                assert_true(r.state.scalars->support_force_N[i] > 0);
            bt_arena_destroy(&r.arena);
        }
}

static void non_finite_state_is_noticed(void** state) {
    (void)state;
    const bt_cable_params p = defaults();
    rod r;
    cable_open(&r, &p);
    assert_true(bt_cable_is_finite(&r.model, &r.state));
    r.state.vz[7] = INFINITY;
    assert_false(bt_cable_is_finite(&r.model, &r.state));
    r.state.vz[7] = NAN;
    bt_cable_step(&r.model, &r.state, 1e-5);
    assert_false(bt_cable_is_finite(&r.model, &r.state));
    bt_arena_destroy(&r.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_accepted),
        cmocka_unit_test(cable_inside_the_deck_is_refused_with_the_value_that_would_do),
        cmocka_unit_test(cable_above_its_supports_is_refused_with_the_value_that_would_do),
        cmocka_unit_test(span_inside_the_supports_and_bad_mesh_are_refused),
        cmocka_unit_test(mesh_fills_the_span_evenly_graded_with_joints_over_the_supports),
        cmocka_unit_test(model_refuses_what_cannot_be_computed),
        cmocka_unit_test(deck_gives_the_restitution_at_any_speed),
        cmocka_unit_test(deck_carries_the_weight_and_never_pulls),
        cmocka_unit_test(friction_stops_sliding_along_and_makes_sliding_across_roll),
        cmocka_unit_test(supports_push_up_and_let_go),
        cmocka_unit_test(support_force_does_not_jump_when_the_cable_slides),
        cmocka_unit_test(centreline_is_continuous_and_segment_at_finds_the_piece),
        cmocka_unit_test(equilibrium_says_when_the_cable_hangs_clear_of_a_support),
        cmocka_unit_test(supports_below_the_sheaves_still_carry_the_cable),
        cmocka_unit_test(supports_of_any_stiffness_and_height_find_their_equilibrium),
        cmocka_unit_test(non_finite_state_is_noticed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
