/// Calibration: which values of chosen keys make the model meet measurements, and which of them
/// the measurements do not tell.
///
/// Parameters p_k with bounds are scaled to u_k = (p_k - lower_k) / (upper_k - lower_k). Target i
/// gives residuals r_i = (got - wanted) / tolerance; a bound or a trend counts only while it is
/// broken, r_i = max(0, c_i). Sought is the least sum of w_i r_i^2 plus, for parameters with a
/// `spread`, ((p_k - start_k) / spread_k)^2.  docs/theory/calibration.md
#ifndef BT_CALIBRATION_CALIBRATION_H
#define BT_CALIBRATION_CALIBRATION_H

#include "calibration/parameter_set.h"
#include "study/measured.h"
#include "study/study.h"

#include <stdatomic.h>

enum {
    BT_PARAMETER_MAX = 16,
    BT_TARGET_MAX = 64,
    BT_CASE_MAX = 128,
    BT_OVERRIDE_MAX = 16,
    BT_STEPS_MAX = 200,
};

typedef struct bt_parameter {
    char path[BT_PATH_MAX];
    char typed[64]; ///< the start (or lower bound) as typed: its unit is used in reports
    const bt_field* field;
    size_t offset;              ///< in bt_parameter_set
    double lower, upper, start; ///< SI
    double spread;              ///< how far it is believed to lie from start, SI; 0: no belief
} bt_parameter;

typedef struct bt_override {
    const bt_field* field;
    size_t offset; ///< in bt_parameter_set
    double value;  ///< SI
} bt_override;

/// A landing, then the rigs in the order of bt_rig_kind.
typedef enum bt_simulated_case_kind {
    BT_CASE_LANDING,
    BT_CASE_NOSE_DROP,
    BT_CASE_MAIN_DROP,
    BT_CASE_HOOK_REBOUND,
    BT_CASE_NOSE_STATIC,
    BT_CASE_MAIN_STATIC,
    BT_CASE_KINDS,
} bt_simulated_case_kind;

/// One run of the model. Targets that ask the same run share it.
typedef struct bt_simulated_case {
    bt_simulated_case_kind kind;
    int override_count;
    bt_override overrides[BT_OVERRIDE_MAX];
} bt_simulated_case;

typedef enum bt_target_kind {
    BT_TARGET_VALUE,
    BT_TARGET_AT_MOST,
    BT_TARGET_AT_LEAST,
    BT_TARGET_INCREASING, ///< each value above the one before by the tolerance at least
    BT_TARGET_DECREASING,
    BT_TARGET_CONSTANT, ///< each value within the tolerance of the first
    BT_TARGET_CURVE,
} bt_target_kind;

typedef struct bt_target {
    bt_target_kind kind;
    char name[192];    ///< "bounce_height, landing.sink_speed 6.3 m/s"
    char typed[64];    ///< the wanted value as typed: its unit is used in reports
    const char* token; ///< unit of what is compared
    int metric;        ///< row of the metrics of the simulated case's kind; not for a curve
    int case_count;
    int cases[BT_LIST_MAX]; ///< one, or one per value of a trend
    double wanted;          ///< SI; not for a trend or a curve
    double tolerance;       ///< SI, or a share of what is wanted
    bool relative;          ///< tolerance is a share
    double weight;
    bt_measured* measured; ///< curve; owned
    int first_row, row_count;
    bt_where where;
} bt_target;

typedef struct bt_calibration {
    bt_parameter_set base; ///< the study with the calibration file's common overrides
    bool rigs_only;        ///< the study describes no landing
    int parameter_count;
    bt_parameter parameters[BT_PARAMETER_MAX];
    int case_count;
    bt_simulated_case cases[BT_CASE_MAX];
    int target_count;
    bt_target targets[BT_TARGET_MAX];
    int row_count;   ///< residuals of all targets
    int steps;       ///< most improvements of the fit
    int starts;      ///< points that the fit begins from; the first is `start`
    int threads;     ///< 0: one per core
    char* file_name; ///< owned: what `where` names
} bt_calibration;

/// Reads a calibration file against a study. All errors are collected as bt_study_read does.
/// BT_ERR_INPUT, BT_ERR_IO (both said in diag), BT_ERR_MEMORY. On BT_OK: bt_calibration_destroy.
BT_CHECKED bt_status bt_calibration_read(const char* path, const bt_study* study,
                                         bt_calibration* calibration, bt_diag* diag);
void bt_calibration_destroy(bt_calibration* calibration);

/// How one target was met.
typedef struct bt_target_fit {
    double got;      ///< SI; of a trend its last value, of a curve the root mean square error
    double residual; ///< in tolerances; the worst of a trend, the root mean square of a curve
    bool met;        ///< residual within 1
} bt_target_fit;

typedef struct bt_fit {
    double value[BT_PARAMETER_MAX]; ///< SI
    double start_cost, cost;        ///< half the weighted sum of squares
    int steps, evaluations;         ///< improvements; sets of parameters that were tried
    bool converged;
    int landings; ///< runs of the model, rigs included
    bt_target_fit targets[BT_TARGET_MAX], before[BT_TARGET_MAX];

    /// Change of each target in tolerances when a parameter moves over its whole range.
    double sensitivity[BT_TARGET_MAX][BT_PARAMETER_MAX];

    /// Singular values of that matrix (all residual rows), largest first, and their directions in
    /// the space of scaled parameters. A direction is identified by the criterion of a parameter
    /// (below): where all directions are, every parameter is.
    double singular[BT_PARAMETER_MAX], direction[BT_PARAMETER_MAX][BT_PARAMETER_MAX];
    int identified_directions;
    /// From the covariance (J^T J + 12 I)^-1, which takes tolerances for standard deviations and
    /// the bounds for all that was known before.
    double standard_error[BT_PARAMETER_MAX]; ///< SI
    double correlation[BT_PARAMETER_MAX][BT_PARAMETER_MAX];
    bool identified[BT_PARAMETER_MAX]; ///< standard error below half of the one before any data
} bt_fit;

/// Told after each improvement: steps so far and the cost.
typedef void bt_fit_progress(void* user, int step, double cost);

/// Finds the best parameters and judges them. Deterministic for any number of threads.
/// `stop` (may be NULL): once not 0 the best so far is returned with BT_ERR_INTERRUPTED.
/// BT_ERR_INPUT: the model cannot be run at the start, said in diag; BT_ERR_MEMORY.
BT_CHECKED bt_status bt_calibration_fit(const bt_calibration* calibration, bt_fit* fit,
                                        const atomic_int* stop, bt_fit_progress* progress,
                                        void* user, bt_diag* diag);

/// The calibrated values as an overlay: lines "PATH: VALUE # [calibrated] ...", with what they were
/// calibrated against in comments. The caller frees *text. BT_ERR_MEMORY.
BT_CHECKED bt_status bt_calibration_overlay(const bt_calibration* calibration, const bt_fit* fit,
                                            char** text, size_t* size);

/// A value in the unit that `typed` ends in, with it: "70.2 deg".
void bt_calibration_text(double value, const char* typed, char* text, size_t size);

#endif
