/// A study: the whole input as read from YAML, checked, in SI.
#ifndef BT_STUDY_STUDY_H
#define BT_STUDY_STUDY_H

#include "base/copula.h"
#include "campaign/params.h"
#include "landing/landing.h"
#include "reliability/params.h"
#include "rigs/rigs.h"
#include "study/measured.h"
#include "surrogate/params.h"

#include <stdint.h>

enum {
    BT_INPUT_MAX = BT_COPULA_MAX,
    BT_CORRELATION_MAX = 496,
    BT_CONDITION_MAX = 64,
    BT_PATH_MAX = 128
};

/// One random input, or one axis of the design.
typedef struct bt_input {
    char path[BT_PATH_MAX]; ///< "landing.sink_speed"
    const bt_field* field;  ///< its row
    size_t offset;          ///< in bt_model_params
    bool random;            ///< has a distribution (uncertainty)
    bt_distribution distribution;
    bool bounded;        ///< is an axis of the design (campaign.bounds)
    double lower, upper; ///< SI; the box of the design
    char typed[32];      ///< one of its values as it was typed: the unit for people; "" for none
    int levels;          ///< full_factorial: points along this axis (0: left to the design)
    bt_where where;
} bt_input;

/// One condition of the reliability table: one input's mean at a value  [Peng2023 Table 5].
typedef struct bt_condition {
    int input;   ///< index into inputs
    double mean; ///< SI
} bt_condition;

enum { BT_CURVES_MAX = 16, BT_FILES_READ_MAX = 8 };

/// What a study says of one rig beside its parameters.
typedef struct bt_rig_input {
    bool given; ///< the study describes this rig
    int curve_count;
    struct {
        const char* path;            ///< CSV file of a measured curve
        bt_where where;              ///< where it is named
        bt_measured_columns columns; ///< which of its columns are meant
    } curves[BT_CURVES_MAX];
} bt_rig_input;

/// A file, whatever its name.
typedef struct bt_file_identity {
    uint64_t device, inode;
} bt_file_identity;

typedef struct bt_study {
    char title[256]; ///< the file's name when it gives none
    bt_model_params model;
    bt_campaign_params campaign;
    bt_surrogate_params surrogate;
    bt_reliability_params reliability;
    bt_rigs_params rigs;
    bt_rig_input rig_inputs[BT_RIG_COUNT];
    bool
        rigs_only; ///< no landing is described: `model` holds the tested parts of the aircraft only
    int input_count;
    bt_input inputs[BT_INPUT_MAX]; ///< in the order of the model's tables
    int correlation_count;
    bt_correlation correlations[BT_CORRELATION_MAX]; ///< of random inputs (indices)
    bt_copula copula;                                ///< of all inputs, by those
    int condition_count;
    bt_condition conditions[BT_CONDITION_MAX];
    char* text;    ///< the study as one file: aircraft and deck included, --set applied,
                   ///< every key with the value used, in SI; reads back to the same bits (the
                   ///< names of measured curves are comments in it)
    uint64_t hash; ///< of what a campaign's runs depend on: model, axes and their bounds (or
                   ///< distributions), design, seed; not of the number of samples (a
                   ///< campaign may grow), threads, comments or later chapters
    char directory[4096]; ///< the study directory: -o, or the file's name without .yaml beside it
    int file_count;
    bt_file_identity files[BT_FILES_READ_MAX]; ///< that it was read from
    struct bt_node* places;                    ///< owns the file names of `where` and of curves
} bt_study;

/// Reads, checks and converts a study file with its --set overrides. All errors are collected
/// (at most 20 reported) in diag before BT_ERR_INPUT is returned. BT_ERR_IO when a file cannot be
/// read. `sets` are texts PATH=VALUE. On BT_OK the study owns its text: bt_study_destroy.
BT_CHECKED bt_status bt_study_read(const char* path, const char* const* sets, int set_count,
                                   bt_study* study, bt_diag* diag);
void bt_study_destroy(bt_study* study);

/// Whether it is the reference study (by its title): figures of others bear no number of the paper.
bool bt_study_is_reference(const bt_study* study);

/// Whether a path is one of the files that the study was read from, or a measured curve that it
/// names: by device and inode, whatever the path is called. Such a file is never written.
bool bt_study_reads(const bt_study* study, const char* path);

/// The same, but a file without `deck` and `landing` that has `rigs` may describe no more than the
/// parts of the aircraft that its rigs test (rigs_only). They need not say where on the aircraft
/// they stand.
BT_CHECKED bt_status bt_study_read_rigs(const char* path, const char* const* sets, int set_count,
                                        bt_study* study, bt_diag* diag);

/// As bt_study_read for a text in memory; `name` is its name in messages. Other files cannot be
/// named in it (BT_ERR_INPUT).
BT_CHECKED bt_status bt_study_read_text(const char* name, const char* text, size_t size,
                                        const char* const* sets, int set_count, bt_study* study,
                                        bt_diag* diag);

/// The reference of every key, or a complete commented study with every default.
/// `write` receives the text in pieces.
typedef void bt_text_sink(void* user, const char* text);
void bt_study_keys(bt_text_sink* write, void* user);
void bt_study_defaults(bt_text_sink* write, void* user);

/// One key as the reference has it: texts, valid during the call.
typedef struct bt_key_text {
    const char *path, *unit, *fallback, *range, *equation, *meaning;
} bt_key_text;

/// Calls `visit` for every key that has a value, or for those of one part only: `part` is a path
/// ("aircraft.hook", or one key's), NULL for all. Returns their number.
typedef void bt_key_text_visit(void* user, const bt_key_text* key);
int bt_study_each_key(const char* part, bt_key_text_visit* visit, void* user);

#endif
