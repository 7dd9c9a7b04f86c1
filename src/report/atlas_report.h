/// The atlas of misses for people and for programs.
#ifndef BT_REPORT_ATLAS_REPORT_H
#define BT_REPORT_ATLAS_REPORT_H

#include "pipeline/atlas.h"
#include "report/table.h"

/// One row per group of misses: share of 1 - R, probability with interval, mode, region, number of
/// landings and a typical one. The texts of the study must outlive it.
bt_report_table* bt_atlas_table(const bt_study* study, const bt_landings* landings,
                                const bt_atlas* atlas);

/// "after the first bounce; distance 7.4 to 8.6 m"
void bt_atlas_region(const bt_study* study, const bt_landings* landings, const bt_miss_group* group,
                     char* text, size_t size);

#endif
