/// Forward and backward substitution with the factor.
#include "mechanics/kkt_parts.h"

/// z -= (panel of L) y
BT_KKT_INLINE void forward_panel(int rows, int n, const double* restrict b, const double y[6],
                                 double* restrict z) {
    BT_KKT_UNROLL
    for (int r = 0; r < rows; ++r) {
        double even = 0, odd = 0; // two chains
        BT_KKT_UNROLL
        for (int k = 0; k + 1 < n; k += 2) {
            even += b[n * r + k] * y[k];
            odd += b[n * r + k + 1] * y[k + 1];
        }
        if (n % 2)
            even += b[n * r + n - 1] * y[n - 1];
        z[r] -= even + odd;
    }
}

BT_KKT_INLINE void forward_node(const bt_kkt* kkt, const bt_kkt_node* node, int n,
                                const double* restrict f, double* restrict x) {
    const double* l = f + node->diagonal;
    double y[6];
    BT_KKT_UNROLL
    for (int r = 0; r < n; ++r) {
        y[r] = x[node->start + r];
        BT_KKT_UNROLL
        for (int k = 0; k < r; ++k)
            y[r] -= l[n * r + k] * y[k];
    }
    BT_KKT_UNROLL
    for (int r = 1; r < n; ++r)
        x[node->start + r] = y[r];
    for (int e = node->edge_first; e < node->edge_first + node->edge_count; ++e) {
        const bt_kkt_node* later = &kkt->nodes[kkt->edges[e].node];
        const double* b = f + kkt->edges[e].offset;
        double* z = x + later->start;
        BT_KKT_FOR_SIZE(later->dim, forward_panel(N, n, b, y, z));
    }
}

/// y -= (panel of L)^T z
BT_KKT_INLINE void backward_panel(int rows, int n, const double* restrict b,
                                  const double* restrict z, double y[6]) {
    BT_KKT_UNROLL
    for (int r = 0; r < rows; ++r)
        BT_KKT_UNROLL
    for (int k = 0; k < n; ++k)
        y[k] -= b[n * r + k] * z[r];
}

BT_KKT_INLINE void backward_node(const bt_kkt* kkt, const bt_kkt_node* node, int n,
                                 const double* restrict f, double* restrict x) {
    const double* l = f + node->diagonal;
    double y[6];
    BT_KKT_UNROLL
    for (int k = 0; k < n; ++k)
        y[k] = x[node->start + k] * l[n * k + k];
    for (int e = node->edge_first; e < node->edge_first + node->edge_count; ++e) {
        const bt_kkt_node* later = &kkt->nodes[kkt->edges[e].node];
        const double* b = f + kkt->edges[e].offset;
        const double* z = x + later->start;
        BT_KKT_FOR_SIZE(later->dim, backward_panel(N, n, b, z, y));
    }
    BT_KKT_UNROLL
    for (int k = n - 1; k > 0; --k)
        BT_KKT_UNROLL
    for (int c = 0; c < k; ++c)
        y[c] -= l[n * k + c] * y[k];
    BT_KKT_UNROLL
    for (int k = 0; k < n; ++k)
        x[node->start + k] = y[k];
}

void bt_kkt_solve(const bt_kkt* kkt, const double* factor, double* x) {
    for (int i = 0; i < kkt->node_count; ++i) {
        const bt_kkt_node* node = &kkt->nodes[kkt->sequence[i]];
        BT_KKT_FOR_SIZE(node->dim, forward_node(kkt, node, N, factor, x));
    }
    for (int i = kkt->node_count - 1; i >= 0; --i) {
        const bt_kkt_node* node = &kkt->nodes[kkt->sequence[i]];
        BT_KKT_FOR_SIZE(node->dim, backward_node(kkt, node, N, factor, x));
    }
}
