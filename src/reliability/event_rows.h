/// The probability of every event under every condition, and by touchdown zone, each with an
/// interval: the pooled estimate with the event in the place of engagement.
///
/// An event's landings are judged by classifiers of their own, round by round; events whose
/// landings say the same, or the opposite, share one set. By zone,
///
///   P(event | zone) = P(event and zone) / P(zone),
///
/// where the zone of a landing is known, so that the classifier of "event and zone" is the event's
/// within the zone and 0 elsewhere, and P(zone) follows from the distribution of the distance.
#ifndef BT_RELIABILITY_EVENT_ROWS_H
#define BT_RELIABILITY_EVENT_ROWS_H

#include "reliability/event.h"
#include "reliability/pool_rows.h"
#include "reliability/reliability.h"

/// Fills events and zones of the result, whose conditions are there. `rows` has the weights and the
/// judged landings of the conditions; the evidence behind it was read for `events`.
/// @return BT_OK, BT_ERR_INTERRUPTED, BT_ERR_INPUT (said in diag), BT_ERR_MEMORY
BT_CHECKED bt_status bt_event_rows_fill(const bt_study* study, const bt_pool_rows* rows,
                                        const bt_event* events, int count,
                                        const bt_reliability_options* options,
                                        bt_reliability_result* result, bt_diag* diag);

#endif
