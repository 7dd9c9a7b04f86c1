/// The report page: one HTML file that opens anywhere, offline. Its data are JSON in the file
/// itself, described in docs/report.md; what draws them is web/, bundled into this library.
#ifndef BT_REPORT_PAGE_H
#define BT_REPORT_PAGE_H

#include "report/playback.h"
#include "study/study.h"

#include <stdatomic.h>

/// Whether this build has the page; says in diag why not.
bool bt_page_available(bt_diag* diag);

/// What the page is about, and what is said of the program that made it.
typedef struct bt_page_subject {
    const bt_study* study;
    const char* file;       ///< the study file as it was named
    const char* build;      ///< compiler flags, or ""
    const atomic_int* stop; ///< may be NULL; once not 0: BT_ERR_INTERRUPTED
} bt_page_subject;

/// A landing to look at.
typedef struct bt_page_landing_of {
    int64_t run;      ///< number in the ledger; -1: the study's own landing
    const char* name; ///< what it is called
    const bt_model_params* model;
    const bt_landing_result* result;
} bt_page_landing_of;

/// A page with one landing to look at. An HTML file that Bolter did not write stays.
///
/// @return BT_OK; BT_ERR_INPUT (no page in this build), BT_ERR_IO, said in diag; BT_ERR_MEMORY
BT_CHECKED bt_status bt_page_landing(const bt_page_subject* subject, const char* path,
                                     const bt_playback* playback, const bt_page_landing_of* landing,
                                     bt_diag* diag);

/// The report of a study from whatever its directory holds: the answer, conditions, landings,
/// misses with typical landings to look at, sensitivity, bounces, rigs, classifier, sources. Reads
/// the ledger only; about 20 landings are computed again.
///
/// @return as bt_page_landing, or what those landings returned
BT_CHECKED bt_status bt_page_report(const bt_page_subject* subject, const char* path,
                                    bt_diag* diag);

#endif
