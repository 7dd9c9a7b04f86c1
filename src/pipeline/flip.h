/// The nearest flips of a landing: for every input, the smallest change of it alone, up and down,
/// at which the outcome is another, found with real landings.
#ifndef BT_PIPELINE_FLIP_H
#define BT_PIPELINE_FLIP_H

#include "campaign/executor.h"
#include "surrogate/surrogate.h"

/// Changes are looked for up to so many standard deviations.
#define BT_FLIP_REACH_SD 4.0

typedef struct bt_flip {
    int axis;         ///< of the design
    bool found;       ///< the outcome changes within `reach_sd`
    double change_sd; ///< with its sign: the nearest landing with another outcome that was run;
                      ///< NAN when none was found
    double width_sd;  ///< of the last bracket: the outcome is still the same that much nearer
    double value;     ///< of the input there, SI
    double reach_sd;  ///< how far was looked: BT_FLIP_REACH_SD, or less where the distribution ends
    bt_outcome outcome; ///< of the landing at change_sd
    bt_mode mode;
    double margin_m;
} bt_flip;

enum { BT_FLIP_MAX = 2 * BT_INPUT_MAX };

typedef struct bt_flips {
    int count;
    bt_flip at[BT_FLIP_MAX]; ///< nearest first, those not found last
    int landings;            ///< that were run
} bt_flips;

/// What is asked, and what may be looked at.
typedef struct bt_flip_search {
    const bt_study* study;
    const double* x;               ///< the landing's inputs, in the order of the design's axes, SI
    bt_outcome outcome;            ///< of that landing
    const bt_surrogate* surrogate; ///< says where to look first; NULL: nobody does
    const atomic_int* stop;        ///< may be NULL
} bt_flip_search;

/// Along each input, up and down: eight landings up to a little beyond where the surrogate changes
/// its answer (up to the reach, where it does not, or where they all end alike), then bisection
/// between the first that differs and the one before. A flip back and forth between two landings
/// of the eight is not seen. A failed landing is no flip. An input is measured by the standard
/// deviation of its distribution; an axis of the design without one by that of its range.
///
/// @return BT_OK; BT_ERR_INPUT (the surrogate is of other inputs; said in diag);
///         BT_ERR_INTERRUPTED; BT_ERR_MEMORY
BT_CHECKED bt_status bt_flips_find(const bt_flip_search* search, bt_flips* flips, bt_diag* diag);

#endif
