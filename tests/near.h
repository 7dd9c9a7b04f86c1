/// What every test includes: cmocka, and a comparison for doubles (cmocka's own converts to float).
#ifndef BT_TESTS_NEAR_H
#define BT_TESTS_NEAR_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#define BT_ASSERT_NEAR(got, want, rtol, atol)                                                      \
    do {                                                                                           \
        const double got_ = (got), want_ = (want);                                                 \
        if (!(fabs(got_ - want_) <= (atol) + (rtol)*fabs(want_)))                                  \
            fail_msg("%s = %.17g, expected %.17g (rtol %g, atol %g)", #got, got_, want_,           \
                     (double)(rtol), (double)(atol));                                              \
    } while (0)

#endif
