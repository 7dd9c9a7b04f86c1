/// Time histories of one run of a rig, in memory.
#ifndef BT_RIGS_RECORD_H
#define BT_RIGS_RECORD_H

#include "rigs/rigs.h"

#include <stdbool.h>

/// Column 0 is the time, s; then the rig's channels in their order, SI.
typedef struct bt_rig_record {
    bt_rig_kind kind;
    int column_count, count, room;
    const char* names[1 + BT_RIG_CHANNEL_MAX]; ///< with their units: "stroke_m"
    double* columns[1 + BT_RIG_CHANNEL_MAX];   ///< [count] each; owned
    bool out_of_memory;
} bt_rig_record;

/// An empty record. Release with bt_rig_record_destroy.
void bt_rig_record_start(bt_rig_record* record, bt_rig_kind kind);
void bt_rig_record_destroy(bt_rig_record* record);

/// The observer to hand to bt_rig_run, with the record as `user`.
void bt_rig_record_observe(void* user, const bt_rig_sample* sample);

/// Whether a column grows from row to row, so that others are functions of it: time does.
bool bt_rig_record_grows(const bt_rig_record* record, int column);

/// A column where another one that grows has the value x, between two rows; NAN outside the record.
double bt_rig_record_at(const bt_rig_record* record, int column, int over, double x);

#endif
