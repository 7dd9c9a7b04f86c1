#include "cli/recorder.h"

#include "cli/output.h"
#include "cli/version.h"
#include "report/paraview.h"

bt_status bt_recorder_start(const char* file, bool plot, bt_recorder* r, bt_diag* diag) {
    const int kind = bt_output_kind(file);
    *r = (bt_recorder){0};
    if (kind == BT_OUTPUT_HISTORIES || kind == BT_OUTPUT_TABLE)
        BT_TRY(bt_history_create(&r->history));
    if (kind == BT_OUTPUT_PAGE && !bt_page_available(diag))
        return BT_ERR_INPUT;
    if (kind == BT_OUTPUT_PARAVIEW)
        return bt_playback_create(BT_PARAVIEW_ROWS, BT_LANDING_SEGMENTS_MAX, &r->playback);
    return kind == BT_OUTPUT_PAGE || plot
               ? bt_playback_create(BT_PLAYBACK_ROWS_ALONE, BT_PLAYBACK_NODES, &r->playback)
               : BT_OK;
}

void bt_recorder_observe(void* user, const bt_landing_view* view) {
    const bt_recorder* r = user;
    if (r->history)
        bt_history_observe(r->history, view);
    if (r->playback)
        bt_playback_observe(r->playback, view);
}

bt_status bt_recorder_write(const bt_recorder* r, const bt_command* command, const bt_study* study,
                            const char* file, const bt_page_landing_of* landing, bt_diag* diag) {
    const bt_page_subject subject = {study, command->words[0], bt_version_build(), NULL};
    switch (bt_output_kind(file)) {
    case BT_OUTPUT_HISTORIES:
    case BT_OUTPUT_TABLE:
        return bt_history_write(r->history, file, study, landing->result, diag);
    case BT_OUTPUT_PARAVIEW:
        return bt_paraview_write(file, r->playback, landing->model, diag);
    case BT_OUTPUT_PAGE:
        return bt_page_landing(&subject, file, r->playback, landing, diag);
    default:
        return BT_OK;
    }
}

void bt_recorder_end(bt_recorder* r) {
    bt_history_destroy(r->history);
    bt_playback_destroy(r->playback);
    *r = (bt_recorder){0};
}
