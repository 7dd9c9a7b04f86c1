/// One landing: from the glide to the wire caught or missed  [Peng2023 Sec. 2, Eq. 18].
#ifndef BT_LANDING_LANDING_H
#define BT_LANDING_LANDING_H

#include "landing/params.h"

/// A distance to the cable at which the hook ends its first bounces long before anything meets the
/// cable, m.
#define BT_CLEAR_DISTANCE_M 14.0

typedef enum bt_outcome { BT_MISSED, BT_ENGAGED, BT_FAILED } bt_outcome;

typedef enum bt_mode {
    BT_MODE_NONE,         ///< failed runs
    BT_MODE_DIRECT,       ///< engaged: the cable went straight into the throat
    BT_MODE_ARM,          ///< engaged: it touched the arm first and slid down
    BT_MODE_BOUNCED_OVER, ///< missed: crossed clear of it after at least one deck contact
    BT_MODE_PASSED_OVER,  ///< missed: crossed clear of it before any deck contact
    BT_MODE_RIDDEN_OVER,  ///< missed: the point touched the cable and went over it
} bt_mode;

const char* bt_outcome_name(bt_outcome outcome); ///< "engaged", "missed", "failed"
const char* bt_mode_name(bt_mode mode);          ///< "direct", ...; "none"

enum {
    BT_BOUNCE_MAX = 16,
    BT_LANDING_SEGMENTS_MAX = 1000, ///< of cable; what the memory of one landing has room for
};

typedef struct bt_bounce {
    double height_m;       ///< of the shoe above the deck, at the top
    double distance_m;     ///< along the deck from touch to touch
    double impact_force_N; ///< peak deck force of the impact that began it
    bool complete;         ///< false: the run ended in the air
} bt_bounce;

enum { BT_LEG_NOSE, BT_LEG_LEFT, BT_LEG_RIGHT, BT_LEG_COUNT };

typedef struct bt_landing_result {
    bt_outcome outcome;
    bt_mode mode;
    bool retained;   ///< the throat still held the cable when the run ended
    double margin_m; ///< cable centre above lip centre when they meet, positive when caught; NAN if
                     ///< failed
    double throat_force_peak_N;
    double time_of_contact_s; ///< first hook-cable contact after first deck contact; NAN if none
    int bounce_count;
    bt_bounce bounces[BT_BOUNCE_MAX];
    double hook_deck_force_peak_N; ///< not calibrated: see docs/theory/shank.md
    bool shank_bends;              ///< of the hook that landed
    double strut_stroke_max_m[BT_LEG_COUNT];
    double tyre_force_max_N[BT_LEG_COUNT];
    double cable_tension_max_N;
    int64_t steps, cable_steps;
    double end_time_s;   ///< simulated time after first contact
    double wall_s;       ///< not part of the outcome; differs from run to run
    uint64_t state_hash; ///< of the final state: equal for bit-equal runs
    char failed_element[48], failed_quantity[48]; ///< failed runs only
    double failed_time_s;
} bt_landing_result;

/// A worker that runs landings one after another, with its own memory (at most 1 MB). One per
/// thread; runs share nothing.
typedef struct bt_lander bt_lander;
BT_CHECKED bt_status bt_lander_create(bt_lander** lander);
void bt_lander_destroy(bt_lander* lander);

/// Bytes that a lander holds, all in all.
size_t bt_lander_memory(const bt_lander* lander);

struct bt_landing_view; ///< landing/view.h: what an observer may look at

/// Called at the start, after every airframe step, and at the end.
typedef void bt_landing_observer(void* user, const struct bt_landing_view* view);

/// Runs one landing. The parameters must have passed bt_group_check(&bt_model_group, ...).
/// A run that diverges is a result (BT_FAILED), not an error. observer may be NULL.
/// Returns BT_OK, BT_ERR_INPUT (what the parameters describe cannot be assembled; said in diag),
/// BT_ERR_MEMORY.
BT_CHECKED bt_status bt_lander_run(bt_lander* lander, const bt_model_params* params,
                                   bt_landing_result* result, bt_landing_observer* observer,
                                   void* user, bt_diag* diag);

#endif
