#include "mechanics/kkt_parts.h"

#include <stdlib.h>

int* bt_kkt_ints(int count) {
    return malloc(sizeof(int) * (size_t)(count > 0 ? count : 1));
}

static bt_status take_memory(bt_kkt* kkt) {
    const size_t nb = (size_t)kkt->body_count, nj = (size_t)kkt->joint_count;
    kkt->nodes = calloc(nb + nj + 1, sizeof *kkt->nodes);
    kkt->sequence = bt_kkt_ints(kkt->node_count);
    kkt->slots = calloc(nj + 1, sizeof *kkt->slots);
    kkt->closes_loop = calloc(nj + 1, sizeof *kkt->closes_loop);
    kkt->parent_joint = bt_kkt_ints(kkt->body_count);
    kkt->mass = calloc(36 * nb + 1, sizeof(double));
    kkt->mass_factor = calloc(36 * nb + 1, sizeof(double));
    kkt->epsilon = calloc((size_t)kkt->constraint_count + 1, sizeof(double));
    return kkt->nodes && kkt->sequence && kkt->slots && kkt->closes_loop && kkt->parent_joint &&
                   kkt->mass && kkt->mass_factor && kkt->epsilon
               ? BT_OK
               : BT_ERR_MEMORY;
}

bt_status bt_kkt_create(bt_kkt* kkt, int body_count, const bt_kkt_joint* joints, int joint_count) {
    *kkt = (bt_kkt){.body_count = body_count,
                    .joint_count = joint_count,
                    .node_count = body_count + joint_count};
    for (int j = 0; j < joint_count; ++j)
        kkt->constraint_count += joints[j].row_count;
    kkt->order = 6 * body_count + kkt->constraint_count;
    bt_status status = take_memory(kkt);
    if (status == BT_OK) {
        for (int b = 0; b < body_count; ++b)
            kkt->nodes[b] = (bt_kkt_node){.dim = 6, .start = 6 * b};
        for (int j = 0; j < joint_count; ++j)
            kkt->nodes[body_count + j] =
                (bt_kkt_node){.dim = joints[j].row_count, .start = 6 * body_count + joints[j].row};
        status = bt_kkt_order(kkt, joints);
    }
    if (status == BT_OK)
        status = bt_kkt_lay_out(kkt, joints);
    if (status != BT_OK)
        bt_kkt_destroy(kkt);
    return status;
}

void bt_kkt_destroy(bt_kkt* kkt) {
    free(kkt->nodes);
    free(kkt->sequence);
    free(kkt->edges);
    free(kkt->updates);
    free(kkt->slots);
    free(kkt->closes_loop);
    free(kkt->parent_joint);
    free(kkt->mass);
    free(kkt->mass_factor);
    free(kkt->epsilon);
    *kkt = (bt_kkt){0};
}
