/// The parts of the report page: each writes its member of the page's data, or nothing when the
/// study directory does not hold what it needs. Private to the page.
#ifndef BT_REPORT_PAGE_PARTS_H
#define BT_REPORT_PAGE_PARTS_H

#include "pipeline/atlas.h"
#include "report/display.h"
#include "report/page.h"

typedef struct bt_page {
    bt_json* json;
    const bt_page_subject* subject;
    bt_landings landings; ///< count 0: there is no ledger
    bt_atlas atlas;
    bt_diag* diag;
} bt_page;

/// Fills landings and atlas.
BT_CHECKED bt_status bt_page_landings_read(bt_page* page);
void bt_page_landings_write(bt_page* page); ///< inputs, modes, counts, landings

void bt_page_atlas_write(bt_page* page); ///< atlas

BT_CHECKED bt_status bt_page_playback_write(bt_page* page); ///< playback
BT_CHECKED bt_status bt_page_bounces_write(bt_page* page);  ///< bounces
BT_CHECKED bt_status bt_page_rigs_write(bt_page* page);     ///< rigs

/// surrogate and sensitivity, of STUDY/surrogate.model.
BT_CHECKED bt_status bt_page_surrogate_write(bt_page* page);

void bt_page_study_write(bt_page* page); ///< sources, study, versions

#endif
