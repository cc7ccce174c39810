/* A multigrid V-cycle for the Laplacian (2 dim on the diagonal, -1 per neighbour) on some vertices
 * of a regular grid, 0 on all others: the preconditioner M of conjugate gradients. M is symmetric
 * positive definite; by itself, as an iteration, it need not converge. */
#ifndef ICCP_MULTIGRID_H
#define ICCP_MULTIGRID_H

#include "gradient/solver/mg_sweep.h"

enum { ICCP_MG_MAX_LEVELS = 32 };

typedef struct iccp_multigrid {
    iccp_memory memory;
    int32_t n_levels;
    iccp_mg_level level[ICCP_MG_MAX_LEVELS]; /* the finest first */
    iccp_mg_scratch scratch;
} iccp_multigrid;

/* For n >= 1 vertices of a list, each at most once; `position` receives where each of them is
 * among the entries of level[0], and may be the list itself. Some 12 bytes a vertex of a large
 * box, one more while it is being made, and 40 for each row of the bounding box; vertices outside
 * count where they are stored (mg_level.h). */
icc_status iccp_multigrid_create(iccp_multigrid *mg, const icc_grid *grid, size_t n,
                                 const uint32_t *vertex, uint32_t *position, const iccp_env *env);
void iccp_multigrid_free(iccp_multigrid *mg);

/* level[0].x = M level[0].b, in the numbering of iccp_mg_position(); b is 0 outside and must not
 * change until then. */
void iccp_multigrid_cycle(iccp_multigrid *mg);

/* The same in two halves; what is done to the finest level on the way down goes slab by slab, so
 * that the caller can do it while the slab is at hand: for s = 0 .. n_slabs + 2, once b is known up
 * to slab s (included). */
void iccp_multigrid_descend(iccp_multigrid *mg, size_t s);
void iccp_multigrid_correct(iccp_multigrid *mg);

/* The way up on the finest level, for s = 0 .. n_slabs + 1: x is final up to slab s - 2
 * (included). */
void iccp_multigrid_ascend(iccp_multigrid *mg, size_t s);

/* Bytes that are held. */
size_t iccp_multigrid_bytes(const iccp_multigrid *mg);

#endif
