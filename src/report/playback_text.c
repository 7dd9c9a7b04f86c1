#include "report/figure_text.h"
#include "report/playback_record.h"

#include <math.h>
#include <stdlib.h>

enum { SHOWN = 3 };
static const double after_s = 0.005; ///< of the passage of the lip

/// The first row well after the lip has passed the cable, or the end.
static size_t shown_rows(const bt_playback* p) {
    double end = INFINITY;
    for (size_t i = 0; i < p->count; ++i) {
        if (isinf(end) && p->curve[i * BT_CURVE_COUNT + BT_CURVE_CABLE_AHEAD] <= 0)
            end = p->time_s[i] + after_s;
        if (p->time_s[i] > end)
            return i;
    }
    return p->count;
}

static void print(const bt_playback* p, const char* title, size_t rows, double* height, FILE* out) {
    static const int curve[SHOWN] = {BT_CURVE_CABLE_HEIGHT, BT_CURVE_LIP + 2, BT_CURVE_HOOK_HEIGHT};
    static const char* const label[SHOWN] = {"centre of the cable where the hook comes",
                                             "lip of the hook", "lowest point of the hook"};
    bt_series series[SHOWN];
    for (int k = 0; k < SHOWN; ++k) {
        double* y = height + (size_t)k * rows;
        for (size_t i = 0; i < rows; ++i)
            y[i] = 1e3 * (double)p->curve[i * BT_CURVE_COUNT + (size_t)curve[k]];
        series[k] = (bt_series){
            .label = label[k], .style = BT_SERIES_LINE, .count = (int)rows, .x = p->time_s, .y = y};
    }
    const bt_figure figure = {.title = title,
                              .x_label = "time from first contact, s",
                              .y_label = "height above the deck, mm",
                              .x_free = true,
                              .series_count = SHOWN,
                              .series = series};
    bt_figure_print(&figure, out);
}

void bt_playback_print(const bt_playback* p, const char* title, FILE* out) {
    const size_t rows = shown_rows(p);
    double* height = malloc((SHOWN * rows + 1) * sizeof *height);
    if (height && !p->out_of_memory)
        print(p, title, rows, height, out);
    free(height);
}
