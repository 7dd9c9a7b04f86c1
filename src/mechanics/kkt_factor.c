/// The factorisation K = L D L^T, block by block.
#include "mechanics/kkt_parts.h"

#include <string.h>

/// a = L D L^T in place (lower part, row-major n x n); the diagonal holds 1 / D afterwards.
/// sign: that of all pivots. False when one is not.
BT_KKT_INLINE bool factor_dense(int n, double* restrict a, double sign) {
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
BT_KKT_INLINE void solve_panel(int rows, int n, const double* restrict l, double* restrict b) {
    for (int c = 1; c < n; ++c)
        for (int r = 0; r < rows; ++r) {
            double sum = b[n * r + c];
            for (int k = 0; k < c; ++k)
                sum -= b[n * r + k] * l[n * c + k];
            b[n * r + c] = sum;
        }
}

/// target -= b1 D^-1 b2^T
BT_KKT_INLINE void update_block(int rows, int columns, int n, const double* restrict l,
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
BT_KKT_INLINE void eliminate_single(int rows, int n, const double* restrict l, double* restrict b,
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

BT_KKT_INLINE void eliminate_panels(const bt_kkt* kkt, const bt_kkt_node* node, int n,
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
BT_KKT_INLINE bool eliminate_node(const bt_kkt* kkt, const bt_kkt_node* node, int n, double sign,
                                  double* f) {
    double* l = f + node->diagonal;
    const bool good = node->constant || factor_dense(n, l, sign);
    if (node->edge_count == 1) {
        const bt_kkt_edge* edge = &kkt->edges[node->edge_first];
        const bt_kkt_node* later = &kkt->nodes[edge->node];
        double *b = f + edge->offset, *target = f + later->diagonal;
        BT_KKT_FOR_SIZE(later->dim, eliminate_single(N, n, l, b, target));
    } else if (node->edge_count)
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
        BT_KKT_FOR_SIZE(node->dim, good = eliminate_node(kkt, node, N, sign, factor));
        if (!good && failed < 0)
            failed = k;
    }
    return failed;
}

void bt_kkt_set_mass(bt_kkt* kkt, int body, double mass_kg, const double inertia_kgm2[9]) {
    double* m = kkt->mass + 36 * body;
    memset(m, 0, 36 * sizeof *m);
    for (int i = 0; i < 3; ++i) {
        m[7 * i] = mass_kg;
        BT_KKT_UNROLL
        for (int k = 0; k < 3; ++k)
            m[6 * (3 + i) + 3 + k] = inertia_kgm2[3 * i + k];
    }
    double* l = kkt->mass_factor + 36 * body;
    memcpy(l, m, 36 * sizeof *m);
    (void)factor_dense(6, l, 1); // positive definite: checked at assembly
}
