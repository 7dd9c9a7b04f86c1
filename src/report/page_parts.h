/// The parts of the report page: each writes its member of the page's data, or nothing when the
/// study directory does not hold what it needs. Private to the page.
#ifndef BT_REPORT_PAGE_PARTS_H
#define BT_REPORT_PAGE_PARTS_H

#include "campaign/ledger.h"
#include "report/display.h"
#include "report/page.h"

/// The landings of a ledger, column by column.
typedef struct bt_page_landings {
    bt_axes axes;
    int count, room;
    int64_t* run;
    double* x;        ///< [count * axes.count] SI
    double* margin_m; ///< NAN where there is none
    uint8_t* mode;    ///< bt_mode
    uint8_t* outcome; ///< bt_outcome
    uint8_t* bounced; ///< 1: the hook had ended its first bounce on the deck
} bt_page_landings;

/// Misses of one mode in one part of the inputs' range.
typedef struct bt_miss_group {
    bt_mode mode;
    bool bounced;
    int axis;               ///< whose range tells them best from all landings
    double least, greatest; ///< range of that input: the middle nine tenths of the group, SI
    int count, typical;     ///< landings in it; index of the one nearest to all others' middle
} bt_miss_group;

enum { BT_MISS_GROUP_MAX = 24 };

typedef struct bt_page {
    bt_json* json;
    const bt_page_subject* subject;
    bt_page_landings landings; ///< count 0: there is no ledger
    int group_count;
    bt_miss_group group[BT_MISS_GROUP_MAX]; ///< largest first
    bt_diag* diag;
} bt_page;

BT_CHECKED bt_status bt_page_landings_read(bt_page* page);
void bt_page_landings_destroy(bt_page_landings* landings);
void bt_page_landings_write(bt_page* page); ///< inputs, modes, counts, landings

/// Fills page->group. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_page_atlas_find(bt_page* page);
void bt_page_atlas_write(bt_page* page); ///< atlas

BT_CHECKED bt_status bt_page_playback_write(bt_page* page); ///< playback
BT_CHECKED bt_status bt_page_bounces_write(bt_page* page);  ///< bounces
BT_CHECKED bt_status bt_page_rigs_write(bt_page* page);     ///< rigs

/// surrogate and sensitivity, of STUDY/surrogate.model.
BT_CHECKED bt_status bt_page_surrogate_write(bt_page* page);

void bt_page_study_write(bt_page* page); ///< sources, study, versions

#endif
