#include "reliability/reliability.h"

#include "base/text.h"
#include "base/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LINE = 512 };

/// The condition's mean in the unit people use: degrees for radians, SI for the rest.
static void print_value(const bt_reliability_row* row, char* text, size_t size) {
    char number[40];
    const bool angle = !strcmp(row->unit, "rad");
    bt_text_print_rounded(angle ? row->value * 180 / M_PI : row->value, 4, number, sizeof number);
    const char* unit = angle ? "deg" : bt_unit_text(row->unit);
    snprintf(text, size, unit && *unit ? "%s %s" : "%s", number, unit ? unit : "");
}

static void print_row(const bt_reliability_row* row, bt_text_sink* write, void* user) {
    char line[LINE], value[64] = "";
    if (row->parameter[0])
        print_value(row, value, sizeof value);
    snprintf(line, sizeof line, "%-26s %11s  %7.5f [%7.5f, %7.5f]",
             row->parameter[0] ? row->parameter : "all as distributed", value, row->surrogate,
             row->surrogate_ci95.least, row->surrogate_ci95.greatest);
    write(user, line);
    if (row->truth_runs > 0)
        snprintf(line, sizeof line, "  %6.4f [%6.4f, %6.4f] %4d of %-4d  %5.2f %%", row->corrected,
                 row->corrected_ci95.least, row->corrected_ci95.greatest, row->disagreements,
                 row->truth_runs, 100 * row->disagreement);
    else
        snprintf(line, sizeof line, "  %-43s", "not checked");
    write(user, line);
    snprintf(line, sizeof line, "  %6.2f %%\n", 100 * row->outside_share);
    write(user, line);
}

static void print_notes(const bt_reliability_result* result, bt_text_sink* write, void* user) {
    char line[LINE];
    int failed = result->overall.truth_failed, runs = result->overall.truth_runs;
    const bt_reliability_row* far = &result->overall; // most samples outside the box
    for (int i = 0; i < result->condition_count; ++i) {
        failed += result->condition[i].truth_failed;
        runs += result->condition[i].truth_runs;
        if (result->condition[i].outside_share > far->outside_share)
            far = &result->condition[i];
    }
    snprintf(line, sizeof line, "%lld samples of the surrogate per line, %.1f s in all\n",
             (long long)result->overall.samples, result->seconds);
    write(user, line);
    write(user, "intervals: 95 %; the surrogate's holds sampling error only, the corrected one the "
                "surrogate's error too\n");
    write(user, "disagree: true runs with another outcome than the surrogate, and their share "
                "weighted back to the distribution\n");
    if (runs > 0) {
        snprintf(line, sizeof line, "failed: %d of %d true runs%s\n", failed, runs,
                 failed ? "; the corrected intervals hold either outcome for them" : "");
        write(user, line);
    }
    if (far->outside_share > 0) {
        char value[64] = "";
        if (far->parameter[0])
            print_value(far, value, sizeof value);
        snprintf(
            line, sizeof line,
            "outside: share beyond the training box; at worst (%s %s) the surrogate would give "
            "%.5f .. %.5f were all of those missed .. engaged\n",
            far->parameter[0] ? far->parameter : "all as distributed", value, far->outside_missed,
            far->outside_engaged);
        write(user, line);
    }
}

void bt_reliability_print(const bt_reliability_result* result, bt_text_sink* write, void* user) {
    write(user, "condition                         mean  surrogate                   corrected     "
                "           disagree               outside\n");
    for (int i = 0; i < result->condition_count; ++i)
        print_row(&result->condition[i], write, user);
    print_row(&result->overall, write, user);
    print_notes(result, write, user);
}
