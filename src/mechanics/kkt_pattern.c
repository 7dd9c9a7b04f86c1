/// Which blocks the factor has, where they lie, and the operations that fill them.
#include "mechanics/kkt_parts.h"

#include <stdlib.h>
#include <string.h>

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
    mine->node = bt_kkt_ints(count);
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

bt_status bt_kkt_lay_out(bt_kkt* kkt, const bt_kkt_joint* joints) {
    const int n = kkt->node_count;
    pattern p = {calloc((size_t)n + 1, sizeof(list)), bt_kkt_ints(n), bt_kkt_ints(n)};
    list* children = calloc((size_t)n + 1, sizeof(list));
    int* found = bt_kkt_ints(n);
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
