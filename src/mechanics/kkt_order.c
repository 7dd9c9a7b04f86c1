/// Elimination order of the saddle-point matrix: from the leaves of a spanning forest to its roots.
#include "mechanics/kkt_parts.h"

#include <stdlib.h>

typedef struct order_work {
    const bt_kkt_joint* joints;
    int body_count, joint_count;
    int *first, *next_a, *next_b; ///< joints of a body as linked lists over both ends
    int *depth, *parent_joint, *parent, *queue;
    int queue_count;
} order_work;

/// The other end of joint j as seen from `body`.
static int across(const bt_kkt_joint* j, int body) {
    return j->body_a == body ? j->body_b : j->body_a;
}

/// Breadth first from the bodies already in the queue.
static void spread(order_work* w, int from) {
    for (int head = from; head < w->queue_count; ++head) {
        const int body = w->queue[head];
        for (int link = w->first[body]; link >= 0;) {
            const int j = link / 2;
            const int other = across(&w->joints[j], body);
            if (other >= 0 && w->depth[other] < 0) {
                w->depth[other] = w->depth[body] + 1;
                w->parent[other] = body;
                w->parent_joint[other] = j;
                w->queue[w->queue_count++] = other;
            }
            link = link % 2 ? w->next_b[j] : w->next_a[j];
        }
    }
}

static void link_jobt_kkt_ints(order_work* w) {
    for (int b = 0; b < w->body_count; ++b)
        w->first[b] = w->depth[b] = w->parent[b] = w->parent_joint[b] = -1;
    for (int j = w->joint_count - 1; j >= 0; --j) {
        const bt_kkt_joint* joint = &w->joints[j];
        if (joint->body_a >= 0) {
            w->next_a[j] = w->first[joint->body_a];
            w->first[joint->body_a] = 2 * j;
        }
        if (joint->body_b >= 0) {
            w->next_b[j] = w->first[joint->body_b];
            w->first[joint->body_b] = 2 * j + 1;
        }
    }
}

static int degree(const order_work* w, int body) {
    int count = 0;
    for (int link = w->first[body]; link >= 0; ++count)
        link = link % 2 ? w->next_b[link / 2] : w->next_a[link / 2];
    return count;
}

/// Spanning forest: rooted at the ground where a part touches it (the joint with most rows first,
/// so that a body hangs on what holds it best), else at the body with most joints.
static void grow_forest(order_work* w) {
    for (int rows = 6; rows >= 1; --rows)
        for (int j = 0; j < w->joint_count; ++j) {
            const bt_kkt_joint* joint = &w->joints[j];
            const int body = joint->body_a < 0 ? joint->body_b : joint->body_a;
            if ((joint->body_a >= 0 && joint->body_b >= 0) || joint->row_count != rows ||
                w->depth[body] >= 0)
                continue;
            w->depth[body] = 0;
            w->parent_joint[body] = j;
            w->queue[w->queue_count++] = body;
        }
    spread(w, 0);
    for (;;) {
        int root = -1, most = -1;
        for (int b = 0; b < w->body_count; ++b)
            if (w->depth[b] < 0 && degree(w, b) > most) {
                most = degree(w, b);
                root = b;
            }
        if (root < 0)
            return;
        w->depth[root] = 0;
        const int from = w->queue_count;
        w->queue[w->queue_count++] = root;
        spread(w, from);
    }
}

static int root_of(const order_work* w, int body) {
    while (w->parent[body] >= 0)
        body = w->parent[body];
    return body;
}

/// The node after which joint j, which closes a loop, is eliminated. A loop of bodies: the body in
/// which the paths of its ends to the root meet. A loop through the ground: the joint that holds
/// the root (the later one of two).
static int loop_end(const order_work* w, const bt_kkt_joint* joint, const int* place) {
    int a = joint->body_a < 0 ? joint->body_b : joint->body_a;
    int b = joint->body_b < 0 ? a : joint->body_b;
    const int root_a = root_of(w, a), root_b = root_of(w, b);
    if (joint->body_a < 0 || joint->body_b < 0 || root_a != root_b) {
        const int root = place[root_a] < place[root_b] ? root_a : root_b; // eliminated last
        return w->body_count + w->parent_joint[root];
    }
    while (a != b)
        if (w->depth[a] >= w->depth[b])
            a = w->parent[a];
        else
            b = w->parent[b];
    return a;
}

/// Appends a node and the joints whose loop it completes.
static void put_node(bt_kkt* kkt, const order_work* w, const int* end, int node, int* count) {
    kkt->sequence[(*count)++] = node;
    if (kkt->loop_joint_count)
        for (int j = 0; j < w->joint_count; ++j)
            if (end[j] == node)
                kkt->sequence[(*count)++] = w->body_count + j;
}

/// Writes the elimination order: bodies from the end of the queue, each followed by the joint it
/// hangs on.
static bt_status choose_order(bt_kkt* kkt, order_work* w) {
    int* place = bt_kkt_ints(w->body_count);
    int* end = bt_kkt_ints(w->joint_count);
    if (!place || !end) {
        free(place);
        free(end);
        return BT_ERR_MEMORY;
    }
    link_jobt_kkt_ints(w);
    grow_forest(w);
    for (int i = 0; i < w->queue_count; ++i)
        place[w->queue[i]] = i;
    for (int j = 0; j < w->joint_count; ++j) {
        kkt->closes_loop[j] = true;
        end[j] = -1;
    }
    for (int b = 0; b < w->body_count; ++b)
        if (w->parent_joint[b] >= 0)
            kkt->closes_loop[w->parent_joint[b]] = false;
    for (int j = 0; j < w->joint_count; ++j)
        if (kkt->closes_loop[j]) {
            end[j] = loop_end(w, &w->joints[j], place);
            ++kkt->loop_joint_count;
        }
    int count = 0;
    for (int i = w->queue_count - 1; i >= 0; --i) {
        const int body = w->queue[i];
        kkt->parent_joint[body] = w->parent_joint[body];
        put_node(kkt, w, end, body, &count);
        if (w->parent_joint[body] >= 0)
            put_node(kkt, w, end, w->body_count + w->parent_joint[body], &count);
    }
    free(place);
    free(end);
    return BT_OK;
}

bt_status bt_kkt_order(bt_kkt* kkt, const bt_kkt_joint* joints) {
    const int nb = kkt->body_count, nj = kkt->joint_count;
    order_work w = {.joints = joints, .body_count = nb, .joint_count = nj};
    w.first = bt_kkt_ints(nb);
    w.next_a = bt_kkt_ints(nj);
    w.next_b = bt_kkt_ints(nj);
    w.depth = bt_kkt_ints(nb);
    w.parent_joint = bt_kkt_ints(nb);
    w.parent = bt_kkt_ints(nb);
    w.queue = bt_kkt_ints(nb);
    bt_status status = BT_ERR_MEMORY;
    if (w.first && w.next_a && w.next_b && w.depth && w.parent_joint && w.parent && w.queue)
        status = choose_order(kkt, &w);
    free(w.first);
    free(w.next_a);
    free(w.next_b);
    free(w.depth);
    free(w.parent_joint);
    free(w.parent);
    free(w.queue);
    return status;
}
