#include "base/arithmetic.h"

#include <fenv.h>
#include <float.h>

const char* bt_arithmetic_fault(void) {
    if (fegetround() != FE_TONEAREST)
        return "the processor does not round to nearest; results would differ from those of "
               "other runs";
    const volatile double least = DBL_MIN;
    const volatile double half = least / 2;
    const volatile double back = half * 2;
    if (half == 0 || back != least)
        return "the processor flushes denormal numbers to zero; results would differ from those "
               "of other runs";
    return 0;
}
