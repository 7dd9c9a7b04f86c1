/// One landing watched from outside: steps it and notes how high the hook bounces.
///
///     landing STUDY.yaml [PATH VALUE]...        values in SI
#include <bolter/bolter.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void complain(void* user, const char* text) {
    (void)user;
    fprintf(stderr, "%s\n", text);
}

/// The highest that the hook has been since it first touched the deck.
typedef struct highest {
    bool touched;
    double height_m, time_s;
} highest;

static double value_of(const bt_landing_line* line, const char* name) {
    for (int i = 0; i < line->count; ++i)
        if (strcmp(line->names[i], name) == 0)
            return line->values[i];
    return NAN;
}

static void watch(void* user, const bt_landing_line* line) {
    highest* top = user;
    const double height_m = value_of(line, "hook_height_m");
    top->touched |= value_of(line, "hook_deck_force_N") > 0;
    if (top->touched && height_m > top->height_m) {
        top->height_m = height_m;
        top->time_s = line->time_s;
    }
}

static int land(const bt_case* study) {
    bt_flight* flight = NULL;
    highest top = {0};
    bt_landing_report report = {.size = sizeof report};
    if (bt_flight_create(study, &flight) != BT_OK)
        return 1;
    do
        bt_flight_look(flight, watch, &top);
    while (bt_flight_step(flight));
    const bt_status status = bt_flight_report(flight, &report);
    bt_flight_destroy(flight);
    if (status != BT_OK || report.failed)
        return 1;
    printf("%s, %s, margin %.1f mm; the hook rose %.1f mm, %.3f s after first contact\n",
           report.engaged ? "engaged" : "missed", report.mode, 1e3 * report.margin_m,
           1e3 * top.height_m, top.time_s);
    return 0;
}

int main(int argc, char** argv) {
    bt_case* study = NULL;
    if (argc < 2 || argc % 2 != 0) {
        fprintf(stderr, "usage: landing STUDY.yaml [PATH VALUE]...\n");
        return 2;
    }
    if (bt_case_open(argv[1], NULL, 0, complain, NULL, &study) != BT_OK)
        return 1;
    int code = 0;
    for (int i = 2; i < argc && code == 0; i += 2)
        code = bt_case_set(study, argv[i], strtod(argv[i + 1], NULL)) == BT_OK ? 0 : 1;
    if (code == 0)
        code = land(study);
    bt_case_close(study);
    return code;
}
