/// The study directory with its ledger: what every stage of the pipeline reads and writes.
///
/// study.yaml (the input as read), campaign.sqlite, surrogate.model, reliability.json and .txt,
/// figures/. One process at a time writes in it; every file appears only when it is complete.
#ifndef BT_PIPELINE_STUDY_DIRECTORY_H
#define BT_PIPELINE_STUDY_DIRECTORY_H

#include "base/directory.h"
#include "campaign/ledger.h"

typedef struct bt_study_directory {
    const bt_study* study; ///< the caller's; must outlive the directory
    bt_directory lock;
    bt_ledger* ledger;
    bt_diag* diag; ///< the caller's: what the stages have to say
} bt_study_directory;

/// Opens the directory that `study->directory` names and its ledger. For writing it also takes the
/// directory's lock and writes study.yaml there, unless the study was read from that very file.
///
/// @return BT_OK, or (said in diag) BT_ERR_IO: no ledger, another study's ledger, another process
///         at work, cannot be written. bt_study_directory_close in any case.
BT_CHECKED bt_status bt_study_directory_open(bt_study_directory* directory, const bt_study* study,
                                             bt_ledger_access how, bt_diag* diag);
void bt_study_directory_close(bt_study_directory* directory);

/// The path of a file in the directory, into a buffer of BT_FILE_PATH_MAX bytes. BT_ERR_ARG when
/// it does not fit.
BT_CHECKED bt_status bt_study_directory_file(const bt_study_directory* directory, const char* name,
                                             char* path);

#endif
