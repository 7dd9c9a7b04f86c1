/// A landing recorded for the page: where every body and the cable are, what pulls and presses,
/// and what happened when, in words. docs/report.md describes the data.
#ifndef BT_REPORT_PLAYBACK_H
#define BT_REPORT_PLAYBACK_H

#include "landing/view.h"
#include "report/json.h"

enum {
    BT_PLAYBACK_ROWS_ALONE = 560, ///< rows of a landing alone in its page: at most 0.6 MB
    BT_PLAYBACK_ROWS_AMONG = 220, ///< rows of a landing among ten
    BT_PLAYBACK_NODES = 72,       ///< nodes of cable, in the page
};

typedef struct bt_playback bt_playback;

/// An empty record for at most this many rows and points of cable. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_playback_create(int rows_most, int nodes_most, bt_playback** playback);
void bt_playback_destroy(bt_playback* playback); ///< accepts NULL

/// The observer to hand to bt_lander_run, with the record as `user`.
void bt_playback_observe(void* user, const bt_landing_view* view);

/// Writes the landing as one object: rows that follow each other by 0.25 ms while hook and cable
/// meet, 1 ms while the cable moves and 2 ms before that (further apart where that would be more
/// rows than allowed); the shapes of the model's parts; events. Nothing when no step was made.
///
/// @param run   number in the ledger; -1: none
/// @param name  what it is called in the page
/// @return BT_OK; BT_ERR_MEMORY (also when memory ran out while observing); BT_ERR_INPUT (the
///         model cannot be assembled, said in diag)
BT_CHECKED bt_status bt_playback_write(bt_json* json, const bt_playback* playback, int64_t run,
                                       const char* name, const bt_model_params* model,
                                       const bt_landing_result* result, bt_diag* diag);

/// Heights of hook, lip and cable over time as text, until a little after they have met.
void bt_playback_print(const bt_playback* playback, const char* title, FILE* out);

#endif
