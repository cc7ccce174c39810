/* The inside vertices as unknowns of a linear system, in the order in which the tree reaches them.
 * Unknown 0 is the root, whose value most problems fix. Parents come before their children. So a
 * forward pass goes from the root to the leaves, and a backward pass from the leaves to the root.
 *
 * Words of this folder, stage 3 of the papers. Begin with this file, then tied.h and
 * bilaplace.h.
 * - unknown, root, leaf: an inside vertex; unknown 0; an unknown without children.
 * - reach: the share of the way to an outside neighbour at which the function is 0.
 * - eta, sigma: each edge requires f_parent >= sigma f_child with sigma = 1 + eta (inequalities.h).
 * - tied, top, members, cluster: unknowns whose values are fixed shares of the top's (tied.h).
 * - slack, multiplier, active: by how much an inequality holds, its Lagrange multiplier, and
 *   equality.
 * - energy, clamped: 1/2 |A f|^2, where A f is the Laplacian; with Laplacians outside as well
 *   (energy.h).
 * - qp: minimum energy under the inequalities, by interior_point.h, smoothing.h, polish.h and
 *   nested.h.
 * - level, row, half, run, slab: how multigrid stores a grid (mg_level.h).
 * - shell: the unknowns that the iterative solver handles at the same scale (tied_iterative.c).
 *
 * Ways (function/laplace.c calls the first three)
 * - Laplace: tied_direct.c, by the order of dissection.h, or tied_iterative.c, by tied_cg.h. Under
 *   the inequalities: active_set.h, which calls these with tied unknowns.
 * - Bi-Laplace: bilaplace.c, on laplacian_factor.h or energy.h, or bilaplace_iterative.c, on
 *   mg_cg.h.
 * - Bi-Laplace under the inequalities: bilaplace_constrained.c, which takes polish.h, then
 *   interior_point.h (on newton_qp.h), on large grids after nested.h (coarse_qp.h, smoothing.h).
 * - Multigrid: multigrid.h has the cycle, mg_sweep.h a slab of it, mg_coarse.c the coarse levels,
 *   mg_kernel.h the inner loops.
 *
 * Invariants: functions span hundreds of orders of magnitude, so values are fractions with
 * exponents (math/scaled.h) and tests are relative. All solvers give the same bits on every
 * machine. */
#ifndef ICCP_UNKNOWNS_H
#define ICCP_UNKNOWNS_H

#include "gradient/tree/cousin.h"

typedef struct iccp_unknowns {
    iccp_memory memory;
    const icc_tree *tree;   /* borrowed */
    size_t n;               /* including the root; at least 1 */
    int32_t n_neighbours;   /* of each unknown: 2 dim; also the diagonal of the Laplacian */
    const uint32_t *vertex; /* n: the grid vertex of each unknown; borrowed from the tree */
    uint32_t *parent;       /* n: a smaller unknown; ICCP_NONE for the root */
    /* n * n_neighbours: unknowns, or ICCP_NONE for a vertex outside, in the order axis 0 -, axis 0
     * +, axis 1 -, .. */
    uint32_t *neighbour;
    /* n * n_neighbours, or NULL: 1 everywhere. The share of the way to a neighbour outside at which
     * the function is 0, in (0, 1] */
    double *reach;
} iccp_unknowns;

/* Numbers the unknowns. O(vertices * dim) time. Needs 4 + 8 dim bytes per unknown and, while it
 * runs, 4 bytes per vertex. */
icc_status iccp_unknowns_create(iccp_unknowns *unknowns, const icc_tree *tree, const iccp_env *env);

/* Moves the zeros from the outside vertices onto the boundary itself, where edges of the grid cross
 * it. Edges to an outside vertex without a crossing keep theirs. The grid has a domain. */
icc_status iccp_unknowns_reach_boundary(iccp_unknowns *unknowns, const iccp_env *env);

/* Returns what a neighbour in direction d of unknown k adds to the diagonal of the Laplacian. For a
 * neighbour outside, that is the slope of a line to the zero. */
static inline double iccp_unknowns_slope(const iccp_unknowns *unknowns, size_t k, int32_t d)
{
    return unknowns->reach == NULL
               ? 1
               : 1 / unknowns->reach[k * (size_t)unknowns->n_neighbours + (size_t)d];
}

void iccp_unknowns_free(iccp_unknowns *unknowns);

#endif
