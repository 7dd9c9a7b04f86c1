/// The paper's numbers and sentences beside ours [Peng2023 Secs. 3-5].
#ifndef BT_REPORT_PAPER_H
#define BT_REPORT_PAPER_H

#include "report/table.h"
#include "study/study.h"

#include <stdatomic.h>

/// One row per number or sentence of the paper: where it stands, what it says, what the study
/// gives, the difference, whether they agree, and why they differ or what the comparison cannot
/// show. Bounces and rigs are computed; reliability and classifier are taken from the study
/// directory, and their rows say so when it does not hold them.
///
/// @param table  the caller's: bt_report_table_destroy after BT_OK
/// @return BT_OK, BT_ERR_INTERRUPTED, BT_ERR_MEMORY, or (said in diag) what the landings, the
///         rigs or the files of the study directory returned
BT_CHECKED bt_status bt_paper_table(const bt_study* study, const atomic_int* stop,
                                    bt_report_table** table, bt_diag* diag);

#endif
