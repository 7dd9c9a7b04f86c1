/// Time histories of one run of a rig, as a file.
#ifndef BT_REPORT_RIG_RECORD_H
#define BT_REPORT_RIG_RECORD_H

#include "rigs/record.h"
#include "study/study.h"

/// Writes an HDF5 file under a temporary name, then renames it: one dataset per column with the
/// attribute `unit`, the metrics and their references as attributes of the file, the study's text
/// as dataset `study`. BT_ERR_IO (said in diag), BT_ERR_MEMORY.
BT_CHECKED bt_status bt_rig_record_write(const bt_rig_record* record, const char* path,
                                         const bt_study* study, const bt_rig_result* result,
                                         bt_diag* diag);

#endif
