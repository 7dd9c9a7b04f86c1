#include "report/packed.h"

#include <math.h>
#include <string.h>

/// Three bytes become four characters.
typedef struct base64 {
    FILE* out;
    unsigned bits;
    int bytes; ///< gathered in `bits`, 0 .. 2
} base64;

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

static void put_byte(base64* b, unsigned byte) {
    b->bits = (b->bits << 8) | (byte & 255);
    if (++b->bytes < 3)
        return;
    const char four[4] = {digits[b->bits >> 18 & 63], digits[b->bits >> 12 & 63],
                          digits[b->bits >> 6 & 63], digits[b->bits & 63]};
    fwrite(four, 1, sizeof four, b->out);
    *b = (base64){.out = b->out};
}

static void put_rest(base64* b) {
    const int bytes = b->bytes;
    if (bytes == 0)
        return;
    const unsigned bits = b->bits << (bytes == 1 ? 16 : 8);
    const char four[4] = {digits[bits >> 18 & 63], digits[bits >> 12 & 63],
                          bytes == 2 ? digits[bits >> 6 & 63] : '=', '='};
    fwrite(four, 1, sizeof four, b->out);
}

void bt_json_floats(bt_json* json, const char* key, const double* values, size_t count) {
    bt_json_text(json, key, "\"");
    base64 b = {.out = json->out};
    for (size_t i = 0; i < count; ++i) {
        const float value = isfinite(values[i]) ? (float)values[i] : NAN;
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        for (int k = 0; k < 4; ++k)
            put_byte(&b, bits >> (8 * k));
    }
    put_rest(&b);
    fputc('"', json->out);
}

void bt_json_steps(bt_json* json, const char* key, int width, const float* values, size_t count) {
    double least = count ? (double)values[0] : 0, greatest = least;
    for (size_t i = 1; i < count; ++i) {
        least = fmin(least, (double)values[i]);
        greatest = fmax(greatest, (double)values[i]);
    }
    const double range = greatest > least ? greatest - least : 1;
    bt_json_begin_object(json, key);
    bt_json_integer(json, "width", width);
    bt_json_number(json, "least", least);
    bt_json_number(json, "greatest", least + range);
    bt_json_text(json, "steps", "\"");
    base64 b = {.out = json->out};
    for (size_t i = 0; i < count; ++i) {
        const unsigned step = (unsigned)lround(65535 * ((double)values[i] - least) / range);
        put_byte(&b, step);
        put_byte(&b, step >> 8);
    }
    put_rest(&b);
    fputc('"', json->out);
    bt_json_end_object(json);
}
