/// The reader of numbers with units under libFuzzer: any text is read as a finite number, or
/// refused with a reason that ends within its buffer.
///
///     fuzz_units fuzz/seeds/units
#include "base/units.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const char* const tokens[] = {"Pa_absolute", "Pa_gauge", "m3", "mps", "N", "Nm", "1"};
    char* text = malloc(size + 1);
    if (!text)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    for (size_t i = 0; i < sizeof tokens / sizeof tokens[0]; ++i) {
        double value = NAN;
        char why[128] = "";
        const bt_status status = bt_unit_parse(text, tokens[i], &value, why, sizeof why);
        if ((status == BT_OK) != (why[0] == '\0') || (status == BT_OK) != (isfinite(value) != 0))
            abort();
    }
    free(text);
    return 0;
}
