/// What happened when in a recorded landing, in words: for the page's scrubber and for `why`.
#ifndef BT_REPORT_TIMELINE_H
#define BT_REPORT_TIMELINE_H

#include "landing/params.h"
#include "report/playback.h"

enum { BT_TIMELINE_MOST = 40 };

typedef struct bt_moment {
    double time_s; ///< since the first contact with the deck
    char what[96];
} bt_moment;

typedef struct bt_timeline {
    int count;
    bt_moment at[BT_TIMELINE_MOST]; ///< in the order of time
} bt_timeline;

/// Touchdown, hook on the deck, tops of its bounces, wheels on the cable, the wave that these send
/// along it (at the hook's line, and back there from the first support), hook meets cable, lip
/// passes, outcome. A wave that is not back when the record ends stands after the outcome, with
/// the time at which it would be.
///
/// The wave is followed from the edge of the tyre with the speed sqrt(T / m) of a string, T the
/// tension recorded where it is, and turned back at the first support.
void bt_timeline_make(const bt_playback* playback, const bt_model_params* model,
                      const bt_landing_result* result, bt_timeline* timeline);

#endif
