/// A drop test beside a recording: runs a rig of a study and compares its stroke with a CSV file
/// of time [s] and stroke [m].
///
///     drop_test STUDY.yaml RIG RECORDING.csv
#include <bolter/bolter.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ROWS_MAX = 10000, METRICS_MAX = 32 };

/// The recording, and how far the simulation lies from it.
typedef struct comparison {
    int count, next;
    double time_s[ROWS_MAX], stroke_m[ROWS_MAX];
    double before_time_s, before_stroke_m; ///< of the simulation's last line
    double squares, largest;
    int compared;
} comparison;

static void complain(void* user, const char* text) {
    (void)user;
    fprintf(stderr, "%s\n", text);
}

static int read_recording(const char* path, comparison* c) {
    char line[256];
    FILE* file = fopen(path, "r");
    if (!file)
        return -1;
    while (c->count < ROWS_MAX && fgets(line, sizeof line, file))
        if (sscanf(line, "%lf,%lf", &c->time_s[c->count], &c->stroke_m[c->count]) == 2)
            ++c->count;
    fclose(file);
    return c->count;
}

static double stroke_of(const bt_rig_line* line) {
    for (int i = 0; i < line->count; ++i)
        if (strcmp(line->names[i], "stroke_m") == 0)
            return line->values[i];
    return NAN;
}

/// Called after every step: every recorded time that was passed is compared, between two lines.
static void compare(void* user, const bt_rig_line* line) {
    comparison* c = user;
    const double stroke = stroke_of(line), step = line->time_s - c->before_time_s;
    for (; c->next < c->count && c->time_s[c->next] <= line->time_s; ++c->next) {
        const double share = step > 0 ? (c->time_s[c->next] - c->before_time_s) / step : 1;
        const double there = c->before_stroke_m + share * (stroke - c->before_stroke_m);
        const double error = there - c->stroke_m[c->next];
        c->squares += error * error;
        c->largest = fmax(c->largest, fabs(error));
        ++c->compared;
    }
    c->before_time_s = line->time_s;
    c->before_stroke_m = stroke;
}

int main(int argc, char** argv) {
    static comparison c;
    bt_rig_metric metrics[METRICS_MAX];
    bt_case* study = NULL;
    int count = 0;
    if (argc != 4 || read_recording(argv[3], &c) <= 0) {
        fprintf(stderr, "usage: drop_test STUDY.yaml RIG RECORDING.csv\n");
        return 2;
    }
    if (bt_case_open_rigs(argv[1], NULL, 0, complain, NULL, &study) != BT_OK)
        return 1;
    const bt_rig_def def = {.size = sizeof def, .rig = argv[2], .watch = compare, .user = &c};
    const bt_status status = bt_case_rig(study, &def, metrics, METRICS_MAX, &count);
    for (int i = 0; status == BT_OK && i < count; ++i)
        printf("%-24s %12.6g %s\n", metrics[i].name, metrics[i].value, metrics[i].unit);
    if (status == BT_OK && c.compared > 0)
        printf("stroke against %d recorded points: root mean square %.2g m, largest %.2g m\n",
               c.compared, sqrt(c.squares / c.compared), c.largest);
    bt_case_close(study);
    return status == BT_OK && c.compared > 0 ? 0 : 1;
}
