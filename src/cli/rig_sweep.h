/// One key of a rig over values: `bolter sweep drop.yaml --key rigs.nose_drop.sink_speed ...`.
#ifndef BT_CLI_RIG_SWEEP_H
#define BT_CLI_RIG_SWEEP_H

#include "cli/cli.h"

/// Runs the rig that the key names (rigs.KIND...), or the only one of the study, once per value of
/// the list "A, B, C", prints a table of its metrics and draws one figure.
///
/// @param study  as the command gives it: only which rigs there are is taken from it
BT_CHECKED bt_status bt_rig_sweep_command(const bt_command* command, const bt_study* study,
                                          const char* key, const char* list);

/// The one rig that a study describes; a wrong use, said on stderr, when there is none or more.
BT_CHECKED bt_status bt_rig_only(const bt_command* command, const bt_study* study,
                                 bt_rig_kind* kind);

#endif
