/// The public interface: open, change, land.
#define _GNU_SOURCE
#include "near.h"

#include "bolter/bolter.h"
#include "toy_study.h"

static const char reference[] = "studies/reference/study.yaml";

static void keep_last(void* user, const char* text) {
    strncpy(user, text, 255);
}

static bt_case* open_reference(void) {
    bt_case* c = NULL;
    assert_int_equal(bt_case_open(reference, NULL, 0, NULL, NULL, &c), BT_OK);
    assert_non_null(c);
    return c;
}

static void a_case_lands_and_lands_again_with_the_same_bits(void** state) {
    (void)state;
    bt_case* c = open_reference();
    bt_landing_report first = {.size = sizeof first}, second = {.size = sizeof second};
    assert_int_equal(bt_case_land(c, &first), BT_OK);
    assert_int_equal(bt_case_land(c, &second), BT_OK);
    assert_false(first.failed);
    assert_true(first.engaged);
    assert_true(first.margin_m > 0);
    assert_true(first.bounces >= 1);
    assert_true(first.first_bounce_height_m > 0.01 && first.first_bounce_height_m < 0.1);
    assert_true(first.state_hash == second.state_hash);
    bt_case_close(c);
}

static void a_number_that_is_set_is_the_number_that_lands(void** state) {
    (void)state;
    bt_case* c = open_reference();
    double value = 0;
    assert_int_equal(bt_case_set(c, "landing.sink_speed", 5.0), BT_OK);
    assert_int_equal(bt_case_get(c, "landing.sink_speed", &value), BT_OK);
    assert_true(value == 5.0);
    bt_landing_report slow = {.size = sizeof slow}, fast = {.size = sizeof fast};
    assert_int_equal(bt_case_land(c, &fast), BT_OK);
    assert_int_equal(bt_case_set(c, "landing.sink_speed", 3.0), BT_OK);
    assert_int_equal(bt_case_land(c, &slow), BT_OK);
    assert_true(fast.first_bounce_height_m > slow.first_bounce_height_m);
    bt_case_close(c);
}

static void unknown_keys_and_values_out_of_range_change_nothing(void** state) {
    (void)state;
    bt_case* c = open_reference();
    double before = 0, after = 0;
    assert_int_equal(bt_case_get(c, "landing.pitch", &before), BT_OK);
    assert_int_equal(bt_case_set(c, "landing.pitch", 3.0), BT_ERR_ARG);
    assert_int_equal(bt_case_set(c, "landing.pitch", NAN), BT_ERR_ARG);
    assert_int_equal(bt_case_set(c, "landing.pich", 0.05), BT_ERR_ARG);
    assert_int_equal(bt_case_set(c, "landing.distance_from", 1), BT_ERR_ARG);
    assert_int_equal(bt_case_get(c, "landing.pitch", &after), BT_OK);
    assert_true(before == after);
    bt_case_close(c);
}

static void numbers_that_describe_no_hook_are_refused_with_the_reason(void** state) {
    (void)state;
    char said[256] = "";
    bt_case* c = NULL;
    assert_int_equal(bt_case_open(reference, NULL, 0, keep_last, said, &c), BT_OK);
    assert_int_equal(bt_case_set(c, "aircraft.hook.profile.throat_radius", 0.01), BT_OK);
    bt_landing_report report = {.size = sizeof report};
    assert_int_equal(bt_case_land(c, &report), BT_ERR_INPUT);
    assert_non_null(strstr(said, "throat_radius"));
    bt_case_close(c);
}

static void a_file_that_is_not_there_is_an_io_error(void** state) {
    (void)state;
    char said[256] = "";
    bt_case* c = NULL;
    assert_int_equal(bt_case_open("no/such/study.yaml", NULL, 0, keep_last, said, &c), BT_ERR_IO);
    assert_null(c);
    assert_non_null(strstr(said, "no/such/study.yaml"));
    bt_case_close(NULL);
}

static void overrides_are_read_as_on_the_command_line(void** state) {
    (void)state;
    const char* sets[] = {"landing.sink_speed=4.2 m/s"};
    const char* wrong[] = {"landing.sink_speed=4.2 kg"};
    bt_case* c = NULL;
    double value = 0;
    assert_int_equal(bt_case_open(reference, sets, 1, NULL, NULL, &c), BT_OK);
    assert_int_equal(bt_case_get(c, "landing.sink_speed", &value), BT_OK);
    assert_true(value == 4.2);
    bt_case_close(c);
    assert_int_equal(bt_case_open(reference, wrong, 1, NULL, NULL, &c), BT_ERR_INPUT);
}

static void the_library_is_of_the_version_of_its_headers(void** state) {
    (void)state;
    assert_string_equal(bt_version(), "0.2.0");
    assert_int_equal(BT_VERSION_MINOR, 2);
}

static void a_text_changes_any_key_and_numbers_set_before_stay(void** state) {
    (void)state;
    char said[256] = "";
    bt_case* c = NULL;
    double value = 0;
    assert_int_equal(bt_case_open(reference, NULL, 0, keep_last, said, &c), BT_OK);
    assert_int_equal(bt_case_set(c, "landing.sink_speed", 4.123456789012345), BT_OK);
    assert_int_equal(bt_case_set_text(c, "landing.pitch", "4 deg"), BT_OK);
    assert_int_equal(bt_case_set_text(c, "campaign.samples", "12"), BT_OK);
    assert_int_equal(bt_case_get(c, "landing.sink_speed", &value), BT_OK);
    assert_true(value == 4.123456789012345);
    assert_int_equal(bt_case_get(c, "landing.pitch", &value), BT_OK);
    BT_ASSERT_NEAR(value, 4 * 3.14159265358979323846 / 180, 1e-15, 0);
    assert_non_null(strstr(bt_case_text(c), "samples: 12"));

    assert_int_equal(bt_case_set_text(c, "landing.pitch", "4 kg"), BT_ERR_INPUT);
    assert_non_null(strstr(said, "landing.pitch"));
    assert_int_equal(bt_case_set_text(c, "landing.pich", "4 deg"), BT_ERR_INPUT);
    assert_int_equal(bt_case_get(c, "landing.pitch", &value), BT_OK);
    BT_ASSERT_NEAR(value, 4 * 3.14159265358979323846 / 180, 1e-15, 0);
    assert_int_equal(bt_case_set_text(c, "landing.pitch", "5 deg"), BT_OK);
    assert_int_equal(bt_case_get(c, "landing.pitch", &value), BT_OK);
    BT_ASSERT_NEAR(value, 5 * 3.14159265358979323846 / 180, 1e-15, 0);
    bt_case_close(c);
}

static void a_model_needs_no_file(void** state) {
    (void)state;
    bt_case* c = NULL;
    double mass = 0;
    bt_landing_report report = {.size = sizeof report};
    assert_int_equal(bt_case_open_defaults("mine.yaml", NULL, NULL, &c), BT_OK);
    assert_int_equal(bt_case_set(c, "aircraft.mass", 21000), BT_OK);
    assert_int_equal(bt_case_get(c, "aircraft.mass", &mass), BT_OK);
    assert_true(mass == 21000);
    assert_int_equal(bt_case_land(c, &report), BT_OK);
    assert_false(report.failed);
    assert_string_equal(bt_case_directory(c), "mine");
    bt_case_close(c);
}

static void a_text_in_memory_is_read_with_its_places(void** state) {
    (void)state;
    static const char text[] = "title: x\nlandin:\n  pitch: 3 deg\n";
    char said[256] = "";
    bt_case* c = NULL;
    assert_int_equal(bt_case_open_text("mine.yaml", text, strlen(text), keep_last, said, &c),
                     BT_ERR_INPUT);
    assert_null(c);
    assert_non_null(strstr(said, "mine.yaml"));
}

static bool count_key(void* user, const bt_key* key) {
    int* count = user;
    assert_true(key->path[0] && key->text[0] && key->unit && key->kind[0]);
    if (strcmp(key->path, "landing.sink_speed") == 0) {
        assert_string_equal(key->unit, "m/s");
        assert_true(key->fallback == 3.6 && key->greatest == 15);
    }
    return ++*count < 1000;
}

static void every_key_is_told_with_unit_range_and_meaning(void** state) {
    (void)state;
    int count = 0;
    bt_keys(count_key, &count);
    assert_in_range(count, 150, 999);
}

static void count_lines(void* user, const bt_rig_line* line) {
    assert_true(line->count > 3 && line->names[0]);
    ++*(int*)user;
}

static void a_rig_gives_its_metrics_and_histories(void** state) {
    (void)state;
    char said[256] = "";
    int lines = 0, count = 0, fewer = 0;
    bt_case* c = NULL;
    bt_rig_metric metrics[32], one[1];
    assert_int_equal(bt_case_open(reference, NULL, 0, keep_last, said, &c), BT_OK);
    const bt_rig_def def = {
        .size = sizeof def, .rig = "nose_drop", .watch = count_lines, .user = &lines};
    assert_int_equal(bt_case_rig(c, &def, metrics, 32, &count), BT_OK);
    assert_true(count >= 4 && lines > 100);
    assert_string_equal(metrics[0].name, "stroke_max_m");
    assert_string_equal(metrics[0].unit, "m");
    BT_ASSERT_NEAR(metrics[0].value, 0.435, 0.03, 0);
    assert_true(metrics[0].accepted);

    const bt_rig_def alone = {.size = sizeof def, .rig = "nose_drop"};
    assert_int_equal(bt_case_rig(c, &alone, one, 1, &fewer), BT_OK);
    assert_int_equal(fewer, count);
    const bt_rig_def unknown = {.size = sizeof def, .rig = "tail_drop"};
    assert_int_equal(bt_case_rig(c, &unknown, one, 1, &fewer), BT_ERR_ARG);
    assert_non_null(strstr(said, "tail_drop"));
    const bt_rig_def sizeless = {.rig = "nose_drop"};
    assert_int_equal(bt_case_rig(c, &sizeless, one, 1, &fewer), BT_ERR_ARG);
    bt_case_close(c);
}

static void the_numbers_of_a_landing_are_asked_for_by_name(void** state) {
    (void)state;
    bt_case* c = open_reference();
    double value = 0;
    bt_landing_report report = {.size = sizeof report};
    assert_int_equal(bt_case_result(c, "margin_m", &value), BT_ERR_ARG);
    assert_int_equal(bt_case_land(c, &report), BT_OK);
    assert_int_equal(bt_case_result(c, "margin_m", &value), BT_OK);
    assert_true(value == report.margin_m);
    assert_int_equal(bt_case_result(c, "strut_stroke_max_left_m", &value), BT_OK);
    assert_true(value == report.strut_stroke_max_m[1] && value > 0.1);
    assert_int_equal(bt_case_result(c, "state_hash", &value), BT_ERR_ARG);
    assert_int_equal(bt_case_result(c, "margin_mm", &value), BT_ERR_ARG);
    bt_landing_report sizeless = {0};
    assert_int_equal(bt_case_land(c, &sizeless), BT_ERR_ARG);
    bt_case_close(c);
}

static void a_table_of_landings_is_the_same_as_one_at_a_time(void** state) {
    (void)state;
    enum { N = 6 };
    static const char* const paths[] = {"landing.distance", "landing.pitch"};
    static const char* const columns[] = {"outcome", "margin_m", "mode", "bounce_count"};
    const double points[N][2] = {{2, 0.05}, {4, 0.05}, {5.5, 0.02}, {8, 0.0524}, {6, 9}, {3, 0.1}};
    double values[N][4], again[N][4];
    char said[256] = "";
    bt_case* c = NULL;
    assert_int_equal(bt_case_open(reference, NULL, 0, keep_last, said, &c), BT_OK);
    bt_batch_def def = {.size = sizeof def,
                        .path_count = 2,
                        .paths = paths,
                        .count = N,
                        .points = points[0],
                        .column_count = 4,
                        .columns = columns,
                        .threads = 2};
    assert_int_equal(bt_case_land_batch(c, &def, values[0]), BT_OK);
    def.threads = 1;
    assert_int_equal(bt_case_land_batch(c, &def, again[0]), BT_OK);
    assert_memory_equal(values, again, sizeof values);
    for (int i = 0; i < N; ++i) {
        if (i == 4) { // a pitch of 9 rad: no landing, and no error
            assert_true(isnan(values[i][0]) && isnan(values[i][1]));
            continue;
        }
        bt_landing_report report = {.size = sizeof report};
        assert_int_equal(bt_case_set(c, paths[0], points[i][0]), BT_OK);
        assert_int_equal(bt_case_set(c, paths[1], points[i][1]), BT_OK);
        assert_int_equal(bt_case_land(c, &report), BT_OK);
        assert_true(values[i][0] == report.engaged && values[i][1] == report.margin_m);
        assert_string_equal(bt_mode_label((int)values[i][2]), report.mode);
        assert_int_equal((int)values[i][3], report.bounces);
    }
    def.columns = (const char* const[]){"outcom", "margin_m", "mode", "bounce_count"};
    assert_int_equal(bt_case_land_batch(c, &def, values[0]), BT_ERR_ARG);
    assert_non_null(strstr(said, "outcom"));
    assert_null(bt_mode_label(99));
    bt_case_close(c);
}

static void keep_time(void* user, const bt_landing_line* line) {
    *(double*)user = line->time_s;
}

static void a_flight_in_ones_own_hands_lands_as_the_case_does(void** state) {
    (void)state;
    bt_case* c = open_reference();
    bt_flight *flight = NULL, *copy = NULL;
    double early_s = 0, late_s = 0;
    bt_landing_report whole = {.size = sizeof whole}, stepped = whole, copied = whole;
    assert_int_equal(bt_case_land(c, &whole), BT_OK);
    assert_int_equal(bt_flight_create(c, &flight), BT_OK);
    bt_case_close(c); // it may outlive the case
    bt_flight_look(flight, keep_time, &early_s);
    for (int step = 0; step < 100; ++step)
        assert_true(bt_flight_step(flight));
    assert_int_equal(bt_flight_copy(flight, &copy), BT_OK);
    assert_true(bt_flight_equal(flight, copy));
    assert_true(bt_flight_step(flight));
    assert_false(bt_flight_equal(flight, copy));
    while (bt_flight_step(flight))
        ;
    bt_flight_look(flight, keep_time, &late_s);
    assert_true(late_s > early_s + 0.1);
    assert_int_equal(bt_flight_report(flight, &stepped), BT_OK);
    bt_flight_destroy(flight); // and its copy may outlive it
    while (bt_flight_step(copy))
        ;
    assert_int_equal(bt_flight_report(copy, &copied), BT_OK);
    bt_flight_destroy(copy);
    assert_true(stepped.state_hash == whole.state_hash && copied.state_hash == whole.state_hash);
    assert_true(stepped.engaged == whole.engaged && stepped.margin_m == whole.margin_m);
}

static bool count_result(void* user, const bt_result_info* info) {
    assert_true(info->name[0] && info->text[0] && info->unit);
    ++*(int*)user;
    return true;
}

static void an_older_client_gets_what_it_knows(void** state) {
    (void)state;
    bt_case* c = open_reference();
    bt_landing_report report;
    memset(&report, 0x5a, sizeof report);
    report.size = offsetof(bt_landing_report, margin_m);
    assert_int_equal(bt_case_land(c, &report), BT_OK);
    assert_true(report.engaged && !report.failed);
    const unsigned char* beyond = (const unsigned char*)&report.margin_m;
    assert_int_equal(*beyond, 0x5a);
    int count = 0;
    bt_results(count_result, &count);
    assert_in_range(count, 20, 60);
    bt_case_close(c);
}

enum { RUNS = 48 };

static bool stop_after(void* user, const bt_campaign_counts* counts) {
    return counts->done < *(int64_t*)user;
}

typedef struct ledger_sum {
    int rows, engaged;
    int64_t last;
} ledger_sum;

static bool sum_row(void* user, const bt_campaign_row* row) {
    ledger_sum* sum = user;
    assert_int_equal(row->input_count, 4);
    assert_string_equal(row->inputs[0], "landing.sink_speed");
    assert_true(row->values[0] > 0 && row->values[0] < 10);
    assert_true(row->run > sum->last);
    sum->last = row->run;
    ++sum->rows;
    sum->engaged += row->report.engaged;
    return true;
}

static void see_reliability(void* user, const bt_reliability_line* line) {
    assert_true(line->corrected >= line->corrected_ci95[0]);
    assert_true(line->corrected <= line->corrected_ci95[1]);
    assert_true(line->surrogate >= 0 && line->surrogate <= 1);
    ++*(int*)user;
    assert_int_equal(line->parameter[0] == '\0', *(int*)user == 25);
}

static void a_campaign_runs_stops_goes_on_and_is_read_and_fitted(void** state) {
    (void)state;
    char* folder = toy_directory();
    char path[FOLDER_SIZE + 8];
    bt_case* c = open_reference();
    snprintf(path, sizeof path, "%s/study", folder);
    assert_int_equal(bt_case_set_directory(c, path), BT_OK);
    assert_int_equal(bt_case_set_text(c, "campaign.samples", "48"), BT_OK);
    assert_int_equal(bt_case_set_text(c, "deck.cable.mesh.medium_length", "0.3 m"), BT_OK);
    assert_int_equal(bt_case_set_text(c, "deck.cable.mesh.fine_length", "0.2 m"), BT_OK);
    assert_string_equal(bt_case_directory(c), path);

    int64_t enough = 1;
    bt_campaign_counts counts;
    const bt_campaign_def short_run = {
        .size = sizeof short_run, .progress = stop_after, .user = &enough};
    const bt_campaign_def whole = {.size = sizeof whole};
    assert_int_equal(bt_case_campaign(c, &short_run, &counts), BT_ERR_INTERRUPTED);
    assert_true(counts.done >= 1 && counts.total == RUNS);
    assert_int_equal(bt_case_campaign(c, &whole, &counts), BT_OK);
    assert_true(counts.done == RUNS && counts.before >= 1);

    ledger_sum sum = {.last = -1};
    assert_int_equal(bt_case_ledger(c, sum_row, &sum), BT_OK);
    assert_int_equal(sum.rows, RUNS);
    assert_int_equal(sum.engaged, (int)counts.engaged);

    const bt_fit_def fit = {.size = sizeof fit};
    bt_fit_report report = {.size = sizeof report};
    double point[4] = {3.6, 47.5, 0.052, 5.5}, decision = 0;
    assert_int_equal(bt_case_predict(c, point, 1, &decision), BT_ERR_ARG);
    assert_int_equal(bt_case_fit(c, &fit, &report), BT_OK);
    assert_true(report.trained_now && report.train_count + report.holdout_count == RUNS);
    assert_int_equal(bt_case_fit_inputs(c), 4);
    assert_string_equal(bt_case_fit_input(c, 3), "landing.distance");
    assert_int_equal(bt_case_predict(c, point, 1, &decision), BT_OK);
    assert_true(decision > 0);
    assert_int_equal(bt_case_fit(c, &fit, &report), BT_OK);
    assert_false(report.trained_now);

    int lines = 0;
    const bt_reliability_def reliability = {.size = sizeof reliability};
    assert_int_equal(bt_case_set_text(c, "reliability.samples", "2000"), BT_OK);
    assert_int_equal(bt_case_set_text(c, "reliability.high_fidelity_runs", "0"), BT_OK);
    assert_int_equal(bt_case_reliability(c, &reliability, see_reliability, &lines), BT_OK);
    assert_int_equal(lines, 25);
    bt_case_close(c);
    toy_directory_remove(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_of_landings_is_the_same_as_one_at_a_time),
        cmocka_unit_test(a_flight_in_ones_own_hands_lands_as_the_case_does),
        cmocka_unit_test(the_numbers_of_a_landing_are_asked_for_by_name),
        cmocka_unit_test(an_older_client_gets_what_it_knows),
        cmocka_unit_test(a_campaign_runs_stops_goes_on_and_is_read_and_fitted),
        cmocka_unit_test(the_library_is_of_the_version_of_its_headers),
        cmocka_unit_test(a_text_changes_any_key_and_numbers_set_before_stay),
        cmocka_unit_test(a_model_needs_no_file),
        cmocka_unit_test(a_text_in_memory_is_read_with_its_places),
        cmocka_unit_test(every_key_is_told_with_unit_range_and_meaning),
        cmocka_unit_test(a_rig_gives_its_metrics_and_histories),
        cmocka_unit_test(a_case_lands_and_lands_again_with_the_same_bits),
        cmocka_unit_test(a_number_that_is_set_is_the_number_that_lands),
        cmocka_unit_test(unknown_keys_and_values_out_of_range_change_nothing),
        cmocka_unit_test(numbers_that_describe_no_hook_are_refused_with_the_reason),
        cmocka_unit_test(a_file_that_is_not_there_is_an_io_error),
        cmocka_unit_test(overrides_are_read_as_on_the_command_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
