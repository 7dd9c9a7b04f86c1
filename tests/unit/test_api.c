/// The public interface: open, change, land.
#include "near.h"

#include "bolter/bolter.h"

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
    bt_landing_report first, second;
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
    bt_landing_report slow, fast;
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
    bt_landing_report report;
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_case_lands_and_lands_again_with_the_same_bits),
        cmocka_unit_test(a_number_that_is_set_is_the_number_that_lands),
        cmocka_unit_test(unknown_keys_and_values_out_of_range_change_nothing),
        cmocka_unit_test(numbers_that_describe_no_hook_are_refused_with_the_reason),
        cmocka_unit_test(a_file_that_is_not_there_is_an_io_error),
        cmocka_unit_test(overrides_are_read_as_on_the_command_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
