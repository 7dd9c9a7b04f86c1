/// What the ranks say to each other: plain bytes, equal in every process of one binary.
#ifndef BT_CLUSTER_MESSAGES_H
#define BT_CLUSTER_MESSAGES_H

#include "campaign/backend.h"

/// Tags from rank 0 (a batch, then orders) and to it.
enum { BT_TAG_BATCH = 1, BT_TAG_ORDER, BT_TAG_RESULT, BT_TAG_BEAT };

/// What every landing of a batch shares.
typedef struct bt_batch_text {
    int64_t batch;
    int threads; ///< of each rank; 0: its share of the cores
    int axis_count;
    bt_model_params model;
    char path[BT_INPUT_MAX][BT_PATH_MAX]; ///< key of each axis
} bt_batch_text;

typedef enum bt_order_kind {
    BT_ORDER_JOB,     ///< run this
    BT_ORDER_CANCEL,  ///< forget what has not begun: it comes back as BT_ERR_INTERRUPTED
    BT_ORDER_ABANDON, ///< and give up what has
    BT_ORDER_CLOSE,   ///< the batch is over
    BT_ORDER_END,     ///< go home
    BT_ORDER_LEAVE,   ///< the same without MPI_Finalize: a rank is dead
} bt_order_kind;

typedef struct bt_order {
    int64_t batch;
    int64_t kind;
    bt_job job;
} bt_order;

typedef struct bt_delivery {
    int64_t batch;
    bt_finished finished;
} bt_delivery;

/// A worker that computes says so this often; one that is silent for so long is taken for dead.
static const double bt_beat_s = 1.0, bt_silence_s = 20.0;

/// How long a rank sleeps before it looks for messages again: MPI itself would spin on the core
/// that a landing needs.
static const double bt_look_s = 0.002;

/// Threads of a rank that shares its cores with others: at least one for those that help.
int bt_cluster_threads(int rank);

#endif
