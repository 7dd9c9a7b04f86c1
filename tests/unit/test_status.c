#include "near.h"

#include "base/status.h"

static void every_status_has_its_own_sentence(void** state) {
    (void)state;
    for (int i = 0; i < BT_STATUS_COUNT; ++i) {
        const char* text = bt_status_text((bt_status)i);
        assert_non_null(text);
        assert_true(*text != '\0');
        for (int k = 0; k < i; ++k)
            assert_string_not_equal(text, bt_status_text((bt_status)k));
    }
    assert_non_null(bt_status_text((bt_status)-1));
    assert_non_null(bt_status_text(BT_STATUS_COUNT));
}

static bt_status pass_on(bt_status status, int* reached) {
    BT_TRY(status);
    *reached = 1;
    return BT_OK;
}

static void an_error_is_passed_up_at_once(void** state) {
    (void)state;
    int reached = 0;
    assert_int_equal(pass_on(BT_ERR_IO, &reached), BT_ERR_IO);
    assert_int_equal(reached, 0);
    assert_int_equal(pass_on(BT_OK, &reached), BT_OK);
    assert_int_equal(reached, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_status_has_its_own_sentence),
        cmocka_unit_test(an_error_is_passed_up_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
