#include "base/units.h"
#include "calibration/calibration.h"

#include <stdio.h>

void bt_calibration_text(double value, const char* typed, char* text, size_t size) {
    char number[64];
    const char* unit = "";
    bt_unit_print_as(value, typed, number, sizeof number, &unit);
    snprintf(text, size, "%s%s%s", number, *unit ? " " : "", unit);
}

static void put_target(FILE* out, const bt_target* t, const bt_target_fit* fit) {
    char got[96];
    static const char* const wish[] = {"",           "at most ", "at least ", "increasing",
                                       "decreasing", "constant", "measured"};
    bt_calibration_text(fit->got, t->typed, got, sizeof got);
    const bool shown = t->kind <= BT_TARGET_AT_LEAST;
    fprintf(out, "#   %s: wanted %s%s, %s%s%s\n", t->name, wish[t->kind], shown ? t->typed : "",
            shown ? "got " : "",
            shown      ? got
            : fit->met ? "met"
                       : "not met",
            shown && !fit->met ? " (outside its tolerance)" : "");
}

static void put_parameter(FILE* out, const bt_parameter* p, const bt_fit* fit, int k) {
    char value[96], error[96], lower[96], upper[96];
    bt_calibration_text(fit->value[k], p->typed, value, sizeof value);
    bt_calibration_text(fit->standard_error[k], p->typed, error, sizeof error);
    bt_calibration_text(p->lower, p->typed, lower, sizeof lower);
    bt_calibration_text(p->upper, p->typed, upper, sizeof upper);
    fprintf(out, "%s: %s # [calibrated] +- %s within %s .. %s%s\n", p->path, value, error, lower,
            upper, fit->identified[k] ? "" : "; not identified by the data");
}

bt_status bt_calibration_overlay(const bt_calibration* calibration, const bt_fit* fit, char** text,
                                 size_t* size) {
    FILE* out = open_memstream(text, size);
    if (!out)
        return BT_ERR_MEMORY;
    fprintf(out, "# Calibrated by bolter with %s. Use it with any verb: --set @THIS_FILE\n",
            calibration->file_name);
    fputs("# Other values may fit as well: a calibration is no validation. Calibrated against\n",
          out);
    for (int i = 0; i < calibration->target_count; ++i)
        put_target(out, &calibration->targets[i], &fit->targets[i]);
    for (int k = 0; k < calibration->parameter_count; ++k)
        put_parameter(out, &calibration->parameters[k], fit, k);
    return fclose(out) == 0 ? BT_OK : BT_ERR_MEMORY;
}
