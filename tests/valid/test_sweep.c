// The paper's three parameter studies on the reference aircraft (Figs. 14-16), and what a sweep
// promises. The four fitted numbers of the hook make some of these hold: see aircraft.yaml.
#include "reference.h"

#include "pipeline/sweep.h"

/// The reference model with the cable out of the way and coarse: nothing touches it before the
/// first bounce is over.
static bt_model_params bouncing(void) {
    return REFERENCE("landing.distance=9 m", "deck.cable.mesh.fine_length=0.6 m",
                     "deck.cable.mesh.medium_length=0.6 m", "deck.cable.mesh.coarse_length=0.6 m");
}

static bt_sweep sweep_of(const bt_model_params* model, const char* key, const char* list,
                         int threads) {
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    const bt_field* field;
    double values[BT_SWEEP_VALUES_MAX];
    size_t offset;
    int count;
    bt_sweep sweep;
    if (bt_sweep_find(model, key, &field, &offset, &diag) != BT_OK ||
        bt_sweep_values(field, key, list, values, &count, &diag) != BT_OK ||
        bt_sweep_run(model, key, values, count, threads, NULL, &sweep, &diag) != BT_OK)
        fail_msg("%s", kept.text);
    return sweep;
}

static bt_bounce first_bounce(const bt_sweep* sweep, int row) {
    const bt_landing_result* result = &sweep->rows[row].result;
    assert_true(result->bounce_count > 0 && result->bounces[0].complete);
    return result->bounces[0];
}

static void fig14_height_grows_with_sink_speed_to_53_mm(void** state) {
    (void)state;
    const bt_model_params model = bouncing();
    bt_sweep sweep = sweep_of(&model, "landing.sink_speed", "3.6 m/s, 4 m/s, 5 m/s, 6.3 m/s", 0);
    for (int i = 0; i < sweep.count; ++i) {
        const bt_bounce bounce = first_bounce(&sweep, i);
        assert_true(bounce.distance_m <= 4); // paper: always
        if (i > 0) {
            const bt_bounce before = first_bounce(&sweep, i - 1);
            assert_true(bounce.height_m > before.height_m);
            assert_true(bounce.distance_m > before.distance_m); // paper: slightly
            assert_true(bounce.impact_force_N > before.impact_force_N);
        }
    }
    BT_ASSERT_NEAR(first_bounce(&sweep, 3).height_m, 0.053, 0.05, 0);
    bt_sweep_destroy(&sweep);
}

static void fig15_height_grows_with_pitch_to_81_mm_and_4_57_m(void** state) {
    (void)state;
    const bt_model_params model = bouncing();
    bt_sweep sweep = sweep_of(&model, "landing.pitch",
                              "0 deg, 1 deg, 2 deg, 3 deg, 4 deg, 5 deg, 6 deg, 7 deg, 8 deg", 0);
    for (int i = 1; i < sweep.count; ++i)
        assert_true(first_bounce(&sweep, i).height_m > first_bounce(&sweep, i - 1).height_m);
    BT_ASSERT_NEAR(first_bounce(&sweep, 8).height_m, 0.081, 0.05, 0);
    BT_ASSERT_NEAR(first_bounce(&sweep, 8).distance_m, 4.57, 0.05, 0);
    bt_sweep_destroy(&sweep);
}

static void fig16_height_does_not_depend_on_horizontal_speed(void** state) {
    (void)state;
    const bt_model_params model = bouncing();
    bt_sweep sweep =
        sweep_of(&model, "landing.horizontal_speed", "55 m/s, 50 m/s, 45 m/s, 40 m/s", 0);
    const bt_bounce fastest = first_bounce(&sweep, 0);
    const double share =
        (fastest.distance_m - first_bounce(&sweep, 3).distance_m) / (55 - 40); // time in the air
    for (int i = 1; i < sweep.count; ++i) {
        const bt_bounce bounce = first_bounce(&sweep, i);
        // The paper: almost unchanged. A bounce is no matter of the horizontal speed as long as
        // the shoe slides: friction then acts alike.
        BT_ASSERT_NEAR(bounce.height_m, fastest.height_m, 2e-3, 0);
        // So the distance is speed times one and the same time in the air, less what the shank
        // swings aft while the aircraft sinks.
        BT_ASSERT_NEAR(fastest.distance_m - bounce.distance_m, share * (55 - sweep.rows[i].value),
                       5e-3, 0);
        assert_true(bounce.distance_m < first_bounce(&sweep, i - 1).distance_m);
    }
    bt_sweep_destroy(&sweep);
}

static void path_tops_out_at_the_bounce(void** state) {
    (void)state;
    const bt_model_params model = bouncing();
    bt_sweep sweep = sweep_of(&model, "landing.pitch", "2 deg", 1);
    const bt_hook_path* path = &sweep.rows[0].path;
    const bt_bounce bounce = first_bounce(&sweep, 0);
    double highest = 0;
    assert_true(path->count > 100);
    BT_ASSERT_NEAR(path->travelled_m[0], 0, 0, 0);
    for (int i = 1; i < path->count; ++i) {
        assert_true(path->travelled_m[i] > path->travelled_m[i - 1]);
        if (path->travelled_m[i] < bounce.distance_m)
            highest = fmax(highest, path->height_m[i]);
    }
    // the top is found between the samples
    BT_ASSERT_NEAR(highest, bounce.height_m, 1e-3, 0);
    bt_sweep_destroy(&sweep);
}

static void rows_do_not_depend_on_threads(void** state) {
    (void)state;
    const bt_model_params model = bouncing();
    bt_sweep one = sweep_of(&model, "landing.roll", "0 deg, 1 deg, 2 deg", 1);
    bt_sweep three = sweep_of(&model, "landing.roll", "0 deg, 1 deg, 2 deg", 3);
    for (int i = 0; i < one.count; ++i) {
        assert_true(one.rows[i].result.state_hash == three.rows[i].result.state_hash);
        assert_int_equal(one.rows[i].path.count, three.rows[i].path.count);
        assert_memory_equal(one.rows[i].path.height_m, three.rows[i].path.height_m,
                            (size_t)one.rows[i].path.count * sizeof(double));
    }
    bt_sweep_destroy(&one);
    bt_sweep_destroy(&three);
}

static void assert_values_refused(const char* key, const char* list, const char* part) {
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    bt_model_params model;
    bt_group_set_defaults(&bt_model_group, &model);
    const bt_field* field;
    double values[BT_SWEEP_VALUES_MAX];
    size_t offset;
    int count;
    bt_status status = bt_sweep_find(&model, key, &field, &offset, &diag);
    if (status == BT_OK)
        status = bt_sweep_values(field, key, list, values, &count, &diag);
    assert_int_equal(status, BT_ERR_INPUT);
    if (!strstr(kept.text, part))
        fail_msg("\"%s\" does not say \"%s\"", kept.text, part);
}

static void wrong_keys_and_values_are_refused_with_the_reason(void** state) {
    (void)state;
    assert_values_refused("landing.sinkspeed", "1 m/s", "did you mean \"landing.sink_speed\"");
    assert_values_refused("landing", "1 m/s", "a key that holds one number");
    assert_values_refused("landing.sink_speed", "3.6 m/s, 4", "has no unit");
    assert_values_refused("landing.sink_speed", "3.6 m/s, , 4 m/s", "landing.sink_speed");
    assert_values_refused("landing.sink_speed", "3.6 m/s, 40 m/s", "is outside 0.01 .. 15 m/s");
    assert_values_refused("landing.sink_speed", "4 deg", "dimension");
    assert_values_refused("landing.sink_speed", "", "landing.sink_speed");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fig14_height_grows_with_sink_speed_to_53_mm),
        cmocka_unit_test(fig15_height_grows_with_pitch_to_81_mm_and_4_57_m),
        cmocka_unit_test(fig16_height_does_not_depend_on_horizontal_speed),
        cmocka_unit_test(path_tops_out_at_the_bounce),
        cmocka_unit_test(rows_do_not_depend_on_threads),
        cmocka_unit_test(wrong_keys_and_values_are_refused_with_the_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
