#define _GNU_SOURCE
#include "near.h"

#include "base/arithmetic.h"

#include <fenv.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

static void a_sound_processor_has_no_fault(void** state) {
    (void)state;
    assert_null(bt_arithmetic_fault());
}

static void another_rounding_mode_is_a_fault(void** state) {
    (void)state;
    fesetround(FE_UPWARD);
    const char* fault = bt_arithmetic_fault();
    fesetround(FE_TONEAREST);
    assert_non_null(fault);
    assert_non_null(strstr(fault, "round to nearest"));
}

static void flushed_denormals_are_a_fault(void** state) {
    (void)state;
#ifdef __SSE2__
    static const unsigned modes[] = {0x8000 /* results */, 0x0040 /* operands */};
    for (size_t i = 0; i < 2; ++i) {
        const unsigned before = _mm_getcsr();
        _mm_setcsr(before | modes[i]);
        const char* fault = bt_arithmetic_fault();
        _mm_setcsr(before);
        assert_non_null(fault);
        assert_non_null(strstr(fault, "denormal"));
    }
#else
    skip();
#endif
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sound_processor_has_no_fault),
        cmocka_unit_test(another_rounding_mode_is_a_fault),
        cmocka_unit_test(flushed_denormals_are_a_fault),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
