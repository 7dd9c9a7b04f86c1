/// Stopping at a width: what a study asks for, and what that costs its intervals.
///
/// Whoever looks again and again and stops when the interval is narrow stops too early when few
/// errors happened to be seen. The limits of a Poisson count (statistics/weighted.h), looked at
/// after every round (rounds.h) and stopped at any width or at any coefficient of variation, keep
/// 95 % when each is a limit at 98.4 %: computed without sampling in tests/unit/test_stop.c.
#ifndef BT_RELIABILITY_STOP_H
#define BT_RELIABILITY_STOP_H

#include "reliability/widths.h"

/// Whether the study goes on until its intervals are narrow (reliability.half_width, .cov).
bool bt_stop_wanted(const bt_study* study);

/// The most that the truth lies beyond either end of an interval: 0.025, or 0.016 where the study
/// may have been stopped by its own intervals.
double bt_stop_tail(const bt_study* study);

/// Whether all conditions are as narrow as the study asks.
bool bt_stop_reached(const bt_study* study, const bt_width* width);

/// Whether the rule fits the design: only landings drawn from the conditions come in rounds.
/// BT_ERR_INPUT, said in diag.
BT_CHECKED bt_status bt_stop_check(const bt_study* study, bt_diag* diag);

#endif
