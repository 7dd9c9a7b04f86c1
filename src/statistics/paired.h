/// The difference of two proportions on the same trials.
#ifndef BT_STATISTICS_PAIRED_H
#define BT_STATISTICS_PAIRED_H

#include "statistics/intervals.h"

/// Trials by what they were the first and the second time.
typedef struct bt_paired {
    int64_t both, first_only, second_only, neither;
} bt_paired;

typedef struct bt_paired_difference {
    double value;     ///< second less first, (second_only - first_only) / trials
    bt_interval ci95; ///< of it, within [-1, 1]
    double p_value;   ///< McNemar, exact and two-sided: that chance alone parts the discordant
                      ///< trials so unequally or more so; 1 when there are none
} bt_paired_difference;

/// The limits are those of the shares f and s of the two discordant kinds (Clopper and Pearson),
/// whose distances from the value are put together with their correlation (Zou and Donner,
/// Statistics in Medicine 27, 2008):
///
///   least = d - sqrt(a^2 + 2 r a b + b^2),  a = s - l_s, b = u_f - f,
///   r = sqrt(f s / ((1 - f) (1 - s))), minus the correlation of two multinomial shares
///
/// and greatest likewise.
/// No trials: NAN, [-1, 1], 1.
bt_paired_difference bt_paired_compare(const bt_paired* counts);

#endif
