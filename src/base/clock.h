/// A steady clock: it never jumps, and only differences of its readings mean anything.
#ifndef BT_BASE_CLOCK_H
#define BT_BASE_CLOCK_H

/// Seconds since some fixed moment.
double bt_clock_s(void);

#endif
