/// What is kept of a landing for -o: histories, a page, a collection for ParaView.
#ifndef BT_CLI_RECORDER_H
#define BT_CLI_RECORDER_H

#include "cli/cli.h"
#include "report/history.h"
#include "report/page.h"

/// Both NULL: nothing is kept.
typedef struct bt_recorder {
    bt_history* history;
    bt_playback* playback;
} bt_recorder;

/// Prepares for what the file is called: .h5 and .csv histories, .html a page, .pvd ParaView; NULL
/// and a directory nothing. `plot`: heights are printed too. BT_ERR_INPUT (no page in this build,
/// said in diag), BT_ERR_MEMORY; bt_recorder_end in any case.
BT_CHECKED bt_status bt_recorder_start(const char* file, bool plot, bt_recorder* recorder,
                                       bt_diag* diag);
void bt_recorder_observe(void* user, const bt_landing_view* view);

/// Writes the file.
BT_CHECKED bt_status bt_recorder_write(const bt_recorder* recorder, const bt_command* command,
                                       const bt_study* study, const char* file,
                                       const bt_page_landing_of* landing, bt_diag* diag);
void bt_recorder_end(bt_recorder* recorder);

#endif
