/// Bolter as a library: open a study, change any number in it, land.
///
///     bt_case* c;
///     if (bt_case_open("study.yaml", NULL, 0, on_message, NULL, &c) == BT_OK) {
///         bt_case_set(c, "landing.sink_speed", 4.5);            // SI: m/s
///         bt_landing_report report;
///         if (bt_case_land(c, &report) == BT_OK && report.engaged)
///             printf("caught with %.1f mm to spare\n", 1e3 * report.margin_m);
///         bt_case_close(c);
///     }
///
/// The library never prints, never exits and has no mutable globals. A case belongs to one thread
/// at a time; several cases may run at once. All numbers are SI: m, kg, s, rad, N, Pa.
#ifndef BOLTER_BOLTER_H
#define BOLTER_BOLTER_H

#include "bolter/campaign.h"
#include "bolter/landing.h"
#include "bolter/reliability.h"
#include "bolter/rig.h"
#include "bolter/status.h"
#include "bolter/study.h"
#include "bolter/surrogate.h"
#include "bolter/version.h"

#endif
