/// Block-sparse factorisation of the saddle-point matrix
///
///     K = [ M  G^T ]      M block diagonal (6 x 6 per body), G two blocks (m x 6) per joint,
///         [ G  -E  ]      E = 0, or a tiny diagonal on joints that close loops
///
/// as K = L D L^T with unit lower L and diagonal D, without pivoting. Nodes are bodies (6) and
/// joints (m). The symbolic work is done once: an elimination order and the list of block
/// operations that it needs.
///
/// Order: a spanning tree of every connected part is eliminated from the leaves to the root, each
/// body before the joint that hangs it on its parent. Every body's pivot is then its mass
/// matrix plus positive semidefinite terms, every tree joint's pivot is negative definite (the
/// joint acts on a body all of whose other joints are already eliminated), and no block fills in.
/// A joint that closes a loop comes right after all other nodes of its loop: before that its pivot
/// would be singular by nature, so a minimum-degree order, which likes joints for their two
/// neighbours, is of no use. Only such joints fill in, along their loop, and only they can be
/// redundant: they get E.
#ifndef BT_MECHANICS_KKT_H
#define BT_MECHANICS_KKT_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/// Input of the symbolic work: one joint.
typedef struct bt_kkt_joint {
    int body_a, body_b; ///< -1: ground
    int row, row_count;
} bt_kkt_joint;

typedef struct bt_kkt_edge {
    int node;   ///< eliminated later than its owner
    int offset; ///< place of the block, dim(node) x dim(owner) row-major
} bt_kkt_edge;

typedef struct bt_kkt_update {
    int row, column; ///< edges of the owner
    int target;      ///< offset of the block changed
} bt_kkt_update;

typedef struct bt_kkt_node {
    int dim;
    int start;    ///< place of its part in a vector (bodies first, then constraint rows)
    int diagonal; ///< offset of its block, dim x dim row-major, lower part used
    int edge_first, edge_count;
    int update_first, update_count;
    bool constant; ///< a body that nothing is eliminated before: its factor never changes
} bt_kkt_node;

/// Where a joint's Jacobian goes; offset -1 for the ground.
typedef struct bt_kkt_slot {
    int offset_a, offset_b;
    bool transposed_a, transposed_b;
} bt_kkt_slot;

typedef struct bt_kkt {
    int body_count, joint_count, node_count;
    int order;          ///< rows of K
    int factor_size;    ///< doubles
    int nonzeros;       ///< entries of the lower triangle of K by blocks, diagonal blocks included
    int fill_blocks;    ///< blocks of L that K does not have
    bt_kkt_node* nodes; ///< bodies 0 .. body_count - 1, then joints
    int* sequence;      ///< [node_count]
    bt_kkt_edge* edges;
    bt_kkt_update* updates;
    bt_kkt_slot* slots; ///< [joint_count]
    bool* closes_loop;  ///< [joint_count]
    int loop_joint_count;
    int* parent_joint;   ///< [body_count] joint that hangs the body, -1 for a free root
    double* mass;        ///< [36 * body_count]
    double* mass_factor; ///< [36 * body_count] L D L^T of the mass blocks, reciprocal pivots
    double* epsilon;     ///< [constraint_count] E; zero on tree joints
    int constraint_count;
} bt_kkt;

/// Symbolic work. Masses and E are set by bt_kkt_set_mass and through `epsilon`.
BT_CHECKED bt_status bt_kkt_create(bt_kkt* kkt, int body_count, const bt_kkt_joint* joints,
                                   int joint_count);
void bt_kkt_destroy(bt_kkt* kkt); ///< accepts a zeroed one

/// Mass block of a body: mass_kg on the first three, inertia (row-major 3 x 3) on the others.
void bt_kkt_set_mass(bt_kkt* kkt, int body, double mass_kg, const double inertia_kgm2[9]);

/// Factors K for the Jacobian ga, gb [constraint_count x 6] into `factor` [factor_size].
/// Returns -1, or the node whose pivot has the wrong sign or is not finite.
int bt_kkt_factor(const bt_kkt* kkt, const double* ga, const double* gb, double* factor);

/// Solves K x = x in place; x [order].
void bt_kkt_solve(const bt_kkt* kkt, const double* factor, double* x);

#endif
