/// The keys that a sensitivity study looks at unless told otherwise, and how far each may be off.
#ifndef BT_PIPELINE_LIKELY_RANGES_H
#define BT_PIPELINE_LIKELY_RANGES_H

/// One key. low == high: a share of its value to both sides.
typedef struct bt_likely_range {
    const char* path;
    double low, high; ///< SI
} bt_likely_range;

/// What is ours to choose in the reference study, and what the paper varies; the last has no path.
/// A range stands where a value is assumed and may be off by a factor; where it comes from is said
/// in docs/sensitivity.md.
extern const bt_likely_range bt_likely_ranges[];

/// The range of a key, NULL where there is none.
const bt_likely_range* bt_likely_range_find(const char* path);

#endif
