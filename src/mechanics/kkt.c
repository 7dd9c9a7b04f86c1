#include "mechanics/kkt.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ symbolic: the order */

typedef struct order_work {
    const bt_kkt_joint* joints;
    int body_count, joint_count;
    int *first, *next_a, *next_b; ///< joints of a body as linked lists over both ends
    int *depth, *parent_joint, *parent, *queue;
    int queue_count;
} order_work;

static int* ints(int count) {
    return malloc(sizeof(int) * (size_t)(count > 0 ? count : 1));
}

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

static void link_joints(order_work* w) {
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
    int* place = ints(w->body_count);
    int* end = ints(w->joint_count);
    if (!place || !end) {
        free(place);
        free(end);
        return BT_ERR_MEMORY;
    }
    link_joints(w);
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

/* ------------------------------------------------------------------ symbolic: the pattern */

typedef struct list {
    int* node;
    int count;
} list;

typedef struct pattern {
    list* later;   ///< [node_count] neighbours eliminated later, in order of elimination
    int* position; ///< [node_count] place in the sequence
    int* mark;     ///< [node_count]
} pattern;

static int by_value(const void* a, const void* b) {
    return *(const int*)a - *(const int*)b;
}

/// Positions of the later neighbours of node k: those of K and those inherited from the nodes whose
/// first later neighbour is k.
static bt_status gather(const bt_kkt* kkt, const bt_kkt_joint* joints, pattern* p, int k,
                        const list* children, int* found, int* original_blocks) {
    int count = 0;
    p->mark[k] = k;
    for (int j = 0; j < kkt->joint_count; ++j) {
        const int ends[2] = {joints[j].body_a, joints[j].body_b};
        const int node = kkt->body_count + j;
        for (int side = 0; side < 2; ++side) {
            if (ends[side] < 0 || (ends[side] != k && node != k))
                continue;
            const int other = node == k ? ends[side] : node;
            if (p->position[other] > p->position[k] && p->mark[other] != k) {
                p->mark[other] = k;
                found[count++] = p->position[other];
                ++*original_blocks;
            }
        }
    }
    for (int c = 0; c < children[k].count; ++c) {
        const list* inherited = &p->later[children[k].node[c]];
        for (int i = 0; i < inherited->count; ++i)
            if (p->mark[inherited->node[i]] != k) {
                p->mark[inherited->node[i]] = k;
                found[count++] = p->position[inherited->node[i]];
            }
    }
    qsort(found, (size_t)count, sizeof *found, by_value);
    list* mine = &p->later[k];
    mine->node = ints(count);
    if (!mine->node)
        return BT_ERR_MEMORY;
    mine->count = count;
    for (int i = 0; i < count; ++i)
        mine->node[i] = kkt->sequence[found[i]];
    return BT_OK;
}

static bt_status append(list* l, int value) {
    int* grown = realloc(l->node, sizeof(int) * (size_t)(l->count + 1));
    if (!grown)
        return BT_ERR_MEMORY;
    l->node = grown;
    l->node[l->count++] = value;
    return BT_OK;
}

/// Sorts the sequence by height in the elimination tree. This changes neither fill nor operations,
/// but neighbours in the sequence no longer wait for each other, and the processor overlaps them.
static bt_status sort_by_height(bt_kkt* kkt, pattern* p, int* old) {
    const int n = kkt->node_count;
    int* height = p->mark; // its marks are no longer needed
    int* first = calloc((size_t)n + 2, sizeof *first);
    if (!first)
        return BT_ERR_MEMORY;
    memset(height, 0, sizeof *height * (size_t)n);
    for (int i = 0; i < n; ++i) {
        const int k = old[i] = kkt->sequence[i];
        ++first[height[k] + 1];
        if (p->later[k].count) {
            const int parent = p->later[k].node[0];
            height[parent] = height[parent] > height[k] ? height[parent] : height[k] + 1;
        }
    }
    for (int h = 0; h < n; ++h)
        first[h + 1] += first[h];
    for (int i = 0; i < n; ++i)
        kkt->sequence[first[height[old[i]]]++] = old[i];
    free(first);
    return BT_OK;
}

/// Fills p->later for every node.
static bt_status eliminate(bt_kkt* kkt, const bt_kkt_joint* joints, pattern* p, list* children,
                           int* found) {
    int original = 0, all = 0;
    for (int i = 0; i < kkt->node_count; ++i)
        p->position[kkt->sequence[i]] = i;
    for (int i = 0; i < kkt->node_count; ++i)
        p->mark[i] = -1;
    for (int i = 0; i < kkt->node_count; ++i) {
        const int k = kkt->sequence[i];
        BT_TRY(gather(kkt, joints, p, k, children, found, &original));
        all += p->later[k].count;
        if (p->later[k].count)
            BT_TRY(append(&children[p->later[k].node[0]], k));
        kkt->nodes[k].constant = k < kkt->body_count && children[k].count == 0;
    }
    kkt->fill_blocks = all - original;
    return sort_by_height(kkt, p, found);
}

static int edge_to(const bt_kkt* kkt, int owner, int node) {
    const bt_kkt_node* n = &kkt->nodes[owner];
    for (int e = n->edge_first; e < n->edge_first + n->edge_count; ++e)
        if (kkt->edges[e].node == node)
            return kkt->edges[e].offset;
    return -1;
}

static void place_slot(const bt_kkt* kkt, const pattern* p, int joint_node, int body, int* offset,
                       bool* transposed) {
    *offset = -1;
    *transposed = false;
    if (body < 0)
        return;
    *transposed = p->position[body] > p->position[joint_node];
    *offset = *transposed ? edge_to(kkt, joint_node, body) : edge_to(kkt, body, joint_node);
}

/// Lays out the factor and writes the operations.
static bt_status lay_out(bt_kkt* kkt, const bt_kkt_joint* joints, const pattern* p) {
    int edges = 0, updates = 0, size = 0;
    for (int k = 0; k < kkt->node_count; ++k) {
        bt_kkt_node* node = &kkt->nodes[k];
        const int count = p->later[k].count;
        node->diagonal = size;
        size += node->dim * node->dim;
        node->edge_first = edges;
        node->edge_count = count;
        node->update_first = updates;
        node->update_count = count * (count + 1) / 2;
        edges += count;
        updates += node->update_count;
    }
    kkt->edges = calloc((size_t)edges + 1, sizeof *kkt->edges);
    kkt->updates = calloc((size_t)updates + 1, sizeof *kkt->updates);
    if (!kkt->edges || !kkt->updates)
        return BT_ERR_MEMORY;
    for (int k = 0; k < kkt->node_count; ++k)
        for (int i = 0; i < p->later[k].count; ++i) {
            const int other = p->later[k].node[i];
            kkt->edges[kkt->nodes[k].edge_first + i] = (bt_kkt_edge){other, size};
            size += kkt->nodes[other].dim * kkt->nodes[k].dim;
        }
    kkt->factor_size = size;
    for (int k = 0; k < kkt->node_count; ++k) {
        const bt_kkt_node* node = &kkt->nodes[k];
        bt_kkt_update* u = kkt->updates + node->update_first;
        for (int r = 0; r < node->edge_count; ++r)
            for (int c = 0; c <= r; ++c, ++u) {
                const int row = p->later[k].node[r], column = p->later[k].node[c];
                u->row = node->edge_first + r;
                u->column = node->edge_first + c;
                u->target = r == c ? kkt->nodes[row].diagonal : edge_to(kkt, column, row);
            }
    }
    for (int j = 0; j < kkt->joint_count; ++j) {
        bt_kkt_slot* slot = &kkt->slots[j];
        const int node = kkt->body_count + j;
        place_slot(kkt, p, node, joints[j].body_a, &slot->offset_a, &slot->transposed_a);
        place_slot(kkt, p, node, joints[j].body_b, &slot->offset_b, &slot->transposed_b);
    }
    return BT_OK;
}

static bt_status analyse(bt_kkt* kkt, const bt_kkt_joint* joints) {
    const int n = kkt->node_count;
    pattern p = {calloc((size_t)n + 1, sizeof(list)), ints(n), ints(n)};
    list* children = calloc((size_t)n + 1, sizeof(list));
    int* found = ints(n);
    bt_status status = BT_ERR_MEMORY;
    if (p.later && p.position && p.mark && children && found) {
        status = eliminate(kkt, joints, &p, children, found);
        if (status == BT_OK)
            status = lay_out(kkt, joints, &p);
    }
    for (int i = 0; i < n; ++i) {
        if (p.later)
            free(p.later[i].node);
        if (children)
            free(children[i].node);
    }
    free(p.later);
    free(p.position);
    free(p.mark);
    free(children);
    free(found);
    return status;
}

static bt_status order_nodes(bt_kkt* kkt, const bt_kkt_joint* joints) {
    const int nb = kkt->body_count, nj = kkt->joint_count;
    order_work w = {.joints = joints, .body_count = nb, .joint_count = nj};
    w.first = ints(nb);
    w.next_a = ints(nj);
    w.next_b = ints(nj);
    w.depth = ints(nb);
    w.parent_joint = ints(nb);
    w.parent = ints(nb);
    w.queue = ints(nb);
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

static bt_status take_memory(bt_kkt* kkt) {
    const size_t nb = (size_t)kkt->body_count, nj = (size_t)kkt->joint_count;
    kkt->nodes = calloc(nb + nj + 1, sizeof *kkt->nodes);
    kkt->sequence = ints(kkt->node_count);
    kkt->slots = calloc(nj + 1, sizeof *kkt->slots);
    kkt->closes_loop = calloc(nj + 1, sizeof *kkt->closes_loop);
    kkt->parent_joint = ints(kkt->body_count);
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
        status = order_nodes(kkt, joints);
    }
    if (status == BT_OK)
        status = analyse(kkt, joints);
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

/* ------------------------------------------------------------------ numeric */

#define UNROLL _Pragma("GCC unroll 6")
#define ALWAYS_INLINE static inline __attribute__((always_inline))

/// a = L D L^T in place (lower part, row-major n x n); the diagonal holds 1 / D afterwards.
/// sign: that of all pivots. False when one is not.
ALWAYS_INLINE bool factor_dense(int n, double* restrict a, double sign) {
    bool good = true;
    for (int c = 0; c < n; ++c) {
        double w[6]; // L_ck D_k
        double pivot = a[n * c + c];
        for (int k = 0; k < c; ++k) {
            w[k] = a[n * c + k];
            a[n * c + k] *= a[n * k + k];
            pivot -= w[k] * a[n * c + k];
        }
        good = good && sign * pivot > 0;
        a[n * c + c] = 1 / pivot;
        for (int r = c + 1; r < n; ++r) {
            double sum = a[n * r + c];
            for (int k = 0; k < c; ++k)
                sum -= a[n * r + k] * a[n * c + k];
            a[n * r + c] = sum; // (L D)_rc until row r is finished
        }
    }
    return good;
}

/// b := b L^-T (rows of b are right-hand sides): b = (panel of L) D.
ALWAYS_INLINE void solve_panel(int rows, int n, const double* restrict l, double* restrict b) {
    for (int c = 1; c < n; ++c)
        for (int r = 0; r < rows; ++r) {
            double sum = b[n * r + c];
            for (int k = 0; k < c; ++k)
                sum -= b[n * r + k] * l[n * c + k];
            b[n * r + c] = sum;
        }
}

/// target -= b1 D^-1 b2^T
ALWAYS_INLINE void update_block(int rows, int columns, int n, const double* restrict l,
                                const double* restrict b1, const double* restrict b2,
                                double* restrict target) {
    for (int r = 0; r < rows; ++r) {
        double w[6];
        for (int k = 0; k < n; ++k)
            w[k] = b1[n * r + k] * l[n * k + k];
        for (int c = 0; c < columns; ++c) {
            double sum = target[columns * r + c];
            for (int k = 0; k < n; ++k)
                sum -= w[k] * b2[n * c + k];
            target[columns * r + c] = sum;
        }
    }
}

static void put_block(const double* g, int rows, bool transposed, double* block) {
    if (!transposed) {
        memcpy(block, g, sizeof(double) * 6 * (size_t)rows);
        return;
    }
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < 6; ++c)
            block[rows * c + r] = g[6 * r + c];
}

static void load(const bt_kkt* kkt, const double* ga, const double* gb, double* factor) {
    memset(factor, 0, sizeof(double) * (size_t)kkt->factor_size);
    for (int b = 0; b < kkt->body_count; ++b) {
        const bt_kkt_node* node = &kkt->nodes[b];
        memcpy(factor + node->diagonal, (node->constant ? kkt->mass_factor : kkt->mass) + 36 * b,
               36 * sizeof(double));
    }
    for (int j = 0; j < kkt->joint_count; ++j) {
        const bt_kkt_node* node = &kkt->nodes[kkt->body_count + j];
        const bt_kkt_slot* slot = &kkt->slots[j];
        const int row = node->start - 6 * kkt->body_count;
        for (int i = 0; i < node->dim; ++i)
            factor[node->diagonal + (node->dim + 1) * i] = -kkt->epsilon[row + i];
        if (slot->offset_a >= 0)
            put_block(ga + 6 * row, node->dim, slot->transposed_a, factor + slot->offset_a);
        if (slot->offset_b >= 0)
            put_block(gb + 6 * row, node->dim, slot->transposed_b, factor + slot->offset_b);
    }
}

/// What a node with one later neighbour does, which in a tree is every node: the panel, the update
/// of the neighbour's pivot, and L. The panel is held by columns, so that the inner loops run over
/// neighbouring numbers.
ALWAYS_INLINE void eliminate_single(int rows, int n, const double* restrict l, double* restrict b,
                                    double* restrict target) {
    double w[6][6]; // (L D) by columns
    for (int r = 0; r < rows; ++r)
        for (int k = 0; k < n; ++k)
            w[k][r] = b[n * r + k];
    for (int c = 1; c < n; ++c)
        for (int k = 0; k < c; ++k)
            for (int r = 0; r < rows; ++r)
                w[c][r] -= w[k][r] * l[n * c + k];
    for (int r = 0; r < rows; ++r)
        for (int k = 0; k < n; ++k)
            b[n * r + k] = w[k][r] * l[n * k + k];
    for (int r = 0; r < rows; ++r) {
        double sum[6];
        for (int c = 0; c < rows; ++c)
            sum[c] = target[rows * r + c];
        for (int k = 0; k < n; ++k)
            for (int c = 0; c < rows; ++c)
                sum[c] -= b[n * r + k] * w[k][c];
        for (int c = 0; c < rows; ++c)
            target[rows * r + c] = sum[c];
    }
}

ALWAYS_INLINE void eliminate_panels(const bt_kkt* kkt, const bt_kkt_node* node, int n,
                                    const double* l, double* f) {
    const bt_kkt_edge* edges = kkt->edges + node->edge_first;
    for (int e = 0; e < node->edge_count; ++e)
        solve_panel(kkt->nodes[edges[e].node].dim, n, l, f + edges[e].offset);
    const bt_kkt_update* update = kkt->updates + node->update_first;
    for (int u = 0; u < node->update_count; ++u, ++update) {
        const bt_kkt_edge *r = &kkt->edges[update->row], *c = &kkt->edges[update->column];
        update_block(kkt->nodes[r->node].dim, kkt->nodes[c->node].dim, n, l, f + r->offset,
                     f + c->offset, f + update->target);
    }
    for (int e = 0; e < node->edge_count; ++e) {
        double* b = f + edges[e].offset;
        for (int r = 0; r < kkt->nodes[edges[e].node].dim; ++r)
            for (int k = 0; k < n; ++k)
                b[n * r + k] *= l[n * k + k];
    }
}

/// One node: its pivot block, the panel below it, what it takes from the rest.
ALWAYS_INLINE bool eliminate_node(const bt_kkt* kkt, const bt_kkt_node* node, int n, double sign,
                                  double* f) {
    double* l = f + node->diagonal;
    const bool good = node->constant || factor_dense(n, l, sign);
    if (node->edge_count == 1) {
        const bt_kkt_edge* edge = &kkt->edges[node->edge_first];
        const bt_kkt_node* later = &kkt->nodes[edge->node];
        double *b = f + edge->offset, *target = f + later->diagonal;
        if (later->dim == 6) {
            eliminate_single(6, n, l, b, target);
            return good;
        }
        if (later->dim == 5) {
            eliminate_single(5, n, l, b, target);
            return good;
        }
        if (later->dim == 4) {
            eliminate_single(4, n, l, b, target);
            return good;
        }
    }
    if (node->edge_count)
        eliminate_panels(kkt, node, n, l, f);
    return good;
}

int bt_kkt_factor(const bt_kkt* kkt, const double* ga, const double* gb, double* factor) {
    load(kkt, ga, gb, factor);
    int failed = -1;
    for (int i = 0; i < kkt->node_count; ++i) {
        const int k = kkt->sequence[i];
        const bt_kkt_node* node = &kkt->nodes[k];
        const double sign = k < kkt->body_count ? 1 : -1;
        bool good = true;
        switch (node->dim) {
        case 1:
            good = eliminate_node(kkt, node, 1, sign, factor);
            break;
        case 2:
            good = eliminate_node(kkt, node, 2, sign, factor);
            break;
        case 3:
            good = eliminate_node(kkt, node, 3, sign, factor);
            break;
        case 4:
            good = eliminate_node(kkt, node, 4, sign, factor);
            break;
        case 5:
            good = eliminate_node(kkt, node, 5, sign, factor);
            break;
        default:
            good = eliminate_node(kkt, node, 6, sign, factor);
            break;
        }
        if (!good && failed < 0)
            failed = k;
    }
    return failed;
}

/// z -= (panel of L) y
ALWAYS_INLINE void forward_panel(int rows, int n, const double* restrict b, const double y[6],
                                 double* restrict z) {
    UNROLL
    for (int r = 0; r < rows; ++r) {
        double even = 0, odd = 0; // two chains
        UNROLL
        for (int k = 0; k + 1 < n; k += 2) {
            even += b[n * r + k] * y[k];
            odd += b[n * r + k + 1] * y[k + 1];
        }
        if (n % 2)
            even += b[n * r + n - 1] * y[n - 1];
        z[r] -= even + odd;
    }
}

ALWAYS_INLINE void forward_node(const bt_kkt* kkt, const bt_kkt_node* node, int n,
                                const double* restrict f, double* restrict x) {
    const double* l = f + node->diagonal;
    double y[6];
    UNROLL
    for (int r = 0; r < n; ++r) {
        y[r] = x[node->start + r];
        UNROLL
        for (int k = 0; k < r; ++k)
            y[r] -= l[n * r + k] * y[k];
    }
    UNROLL
    for (int r = 1; r < n; ++r)
        x[node->start + r] = y[r];
    for (int e = node->edge_first; e < node->edge_first + node->edge_count; ++e) {
        const bt_kkt_node* later = &kkt->nodes[kkt->edges[e].node];
        const double* b = f + kkt->edges[e].offset;
        double* z = x + later->start;
        switch (later->dim) {
        case 4:
            forward_panel(4, n, b, y, z);
            break;
        case 5:
            forward_panel(5, n, b, y, z);
            break;
        case 6:
            forward_panel(6, n, b, y, z);
            break;
        default:
            forward_panel(later->dim, n, b, y, z);
        }
    }
}

/// y -= (panel of L)^T z
ALWAYS_INLINE void backward_panel(int rows, int n, const double* restrict b,
                                  const double* restrict z, double y[6]) {
    UNROLL
    for (int r = 0; r < rows; ++r)
        UNROLL
    for (int k = 0; k < n; ++k)
        y[k] -= b[n * r + k] * z[r];
}

ALWAYS_INLINE void backward_node(const bt_kkt* kkt, const bt_kkt_node* node, int n,
                                 const double* restrict f, double* restrict x) {
    const double* l = f + node->diagonal;
    double y[6];
    UNROLL
    for (int k = 0; k < n; ++k)
        y[k] = x[node->start + k] * l[n * k + k];
    for (int e = node->edge_first; e < node->edge_first + node->edge_count; ++e) {
        const bt_kkt_node* later = &kkt->nodes[kkt->edges[e].node];
        const double* b = f + kkt->edges[e].offset;
        const double* z = x + later->start;
        switch (later->dim) {
        case 4:
            backward_panel(4, n, b, z, y);
            break;
        case 5:
            backward_panel(5, n, b, z, y);
            break;
        case 6:
            backward_panel(6, n, b, z, y);
            break;
        default:
            backward_panel(later->dim, n, b, z, y);
        }
    }
    UNROLL
    for (int k = n - 1; k > 0; --k)
        UNROLL
    for (int c = 0; c < k; ++c)
        y[c] -= l[n * k + c] * y[k];
    UNROLL
    for (int k = 0; k < n; ++k)
        x[node->start + k] = y[k];
}

void bt_kkt_solve(const bt_kkt* kkt, const double* factor, double* x) {
    for (int i = 0; i < kkt->node_count; ++i) {
        const bt_kkt_node* node = &kkt->nodes[kkt->sequence[i]];
        switch (node->dim) {
        case 1:
            forward_node(kkt, node, 1, factor, x);
            break;
        case 2:
            forward_node(kkt, node, 2, factor, x);
            break;
        case 3:
            forward_node(kkt, node, 3, factor, x);
            break;
        case 4:
            forward_node(kkt, node, 4, factor, x);
            break;
        case 5:
            forward_node(kkt, node, 5, factor, x);
            break;
        default:
            forward_node(kkt, node, 6, factor, x);
            break;
        }
    }
    for (int i = kkt->node_count - 1; i >= 0; --i) {
        const bt_kkt_node* node = &kkt->nodes[kkt->sequence[i]];
        switch (node->dim) {
        case 1:
            backward_node(kkt, node, 1, factor, x);
            break;
        case 2:
            backward_node(kkt, node, 2, factor, x);
            break;
        case 3:
            backward_node(kkt, node, 3, factor, x);
            break;
        case 4:
            backward_node(kkt, node, 4, factor, x);
            break;
        case 5:
            backward_node(kkt, node, 5, factor, x);
            break;
        default:
            backward_node(kkt, node, 6, factor, x);
            break;
        }
    }
}

void bt_kkt_set_mass(bt_kkt* kkt, int body, double mass_kg, const double inertia_kgm2[9]) {
    double* m = kkt->mass + 36 * body;
    memset(m, 0, 36 * sizeof *m);
    for (int i = 0; i < 3; ++i) {
        m[7 * i] = mass_kg;
        UNROLL
        for (int k = 0; k < 3; ++k)
            m[6 * (3 + i) + 3 + k] = inertia_kgm2[3 * i + k];
    }
    double* l = kkt->mass_factor + 36 * body;
    memcpy(l, m, 36 * sizeof *m);
    (void)factor_dense(6, l, 1); // positive definite: checked at assembly
}
