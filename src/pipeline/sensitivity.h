/// Which keys of the model decide: the same landings with one key after the other at both ends of
/// its range.
#ifndef BT_PIPELINE_SENSITIVITY_H
#define BT_PIPELINE_SENSITIVITY_H

#include "pipeline/noise.h"

enum { BT_SENSITIVITY_KEYS_MAX = 64, BT_SENSITIVITY_DISTANCES_MAX = 16 };

/// A key and how far it may be off.
typedef struct bt_sensitivity_key {
    char path[BT_PATH_MAX];
    const char* unit;     ///< as people write it; "" for none
    double value, end[2]; ///< SI: as the study sets it; low, high
} bt_sensitivity_key;

/// What is to be moved and where. Start it with {.study, .count, .change}; the calls below add.
typedef struct bt_sensitivity {
    const bt_study* study;     ///< the caller's
    int64_t count;             ///< landings per row
    double change;             ///< share of its value by which a key without a range is moved
    const atomic_int* stop;    ///< may be NULL; see bt_executor
    const bt_backend* backend; ///< NULL: threads of this process
    int key_count, distance_count;
    bt_sensitivity_key keys[BT_SENSITIVITY_KEYS_MAX];
    double distance_m[BT_SENSITIVITY_DISTANCES_MAX]; ///< landing.distance is held; none: drawn
} bt_sensitivity;

/// Adds the distances of a list, "2 m,5.5 m", at which landing.distance is held in turn. NULL adds
/// none. BT_ERR_ARG, with the reason in `why`.
BT_CHECKED bt_status bt_sensitivity_add_distances(bt_sensitivity* sensitivity, const char* list,
                                                  char* why, size_t size);

/// Adds the keys of a list, "PATH,PATH=LOW..HIGH"; NULL: those that the reference study had to
/// choose (pipeline/likely_ranges.h). A key without a range goes through its likely one, or a share
/// of its value to both sides. After the distances: a held distance may be a key. BT_ERR_ARG, with
/// the reason in `why`: no number of the model, drawn from a distribution, no range.
BT_CHECKED bt_status bt_sensitivity_add_keys(bt_sensitivity* sensitivity, const char* list,
                                             char* why, size_t size);

/// One key: the landings with it at either end of its range, against those as the study sets it.
typedef struct bt_sensitivity_effect {
    const bt_sensitivity_key* key;
    bool refused[2];    ///< the model cannot be run with the key at that end
    double engaged[2];  ///< share; NAN where refused
    double margin_m[2]; ///< mean move of the margin
    int64_t flips;      ///< outcomes changed, both ends together
} bt_sensitivity_effect;

typedef struct bt_sensitivity_result {
    double distance_m; ///< held; NAN: drawn
    double engaged;    ///< share as the study sets it
    int count;
    bt_sensitivity_effect effects[BT_SENSITIVITY_KEYS_MAX]; ///< the strongest key first
} bt_sensitivity_result;

/// Told after each key.
typedef void bt_sensitivity_watch(void* user, int done, int total);

/// Moves every key.
///
/// @param distance_m  landing.distance, held; NAN: as the study has it
/// @param watch       may be NULL
/// @return BT_OK; BT_ERR_FAILED_RUNS (of the landings as the study sets them, said in diag); what
///         bt_noise_run returns
BT_CHECKED bt_status bt_stage_sensitivity(const bt_sensitivity* sensitivity, double distance_m,
                                          bt_sensitivity_watch* watch, void* user,
                                          bt_sensitivity_result* result, bt_diag* diag);

#endif
