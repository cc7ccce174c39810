/* A multigrid V-cycle for the Laplacian (2 dim on the diagonal, -1 per neighbour) on some vertices
 * of a regular grid, with 0 on all others. It is the preconditioner M of conjugate gradients. M is
 * symmetric positive definite. As an iteration of its own, it need not converge. */
#ifndef ICCP_MULTIGRID_H
#define ICCP_MULTIGRID_H

#include "gradient/solver/mg_sweep.h"

enum { ICCP_MG_MAX_LEVELS = 32 };

typedef struct iccp_multigrid {
    iccp_memory memory;
    int32_t n_levels;
    iccp_mg_level level[ICCP_MG_MAX_LEVELS]; /* finest level first */
    iccp_mg_scratch scratch;
} iccp_multigrid;

/* Makes the levels for n >= 1 vertices of a list, each at most once. `position` receives the place
 * of each among the entries of level[0], and may be the list itself. Needs some 12 bytes per vertex
 * of a large box, one more while it is made, and 40 per row of the bounding box. Vertices outside
 * count where they are stored (mg_level.h). */
icc_status iccp_multigrid_create(iccp_multigrid *mg, const icc_grid *grid, size_t n,
                                 const uint32_t *vertex, uint32_t *position, const iccp_env *env);
void iccp_multigrid_free(iccp_multigrid *mg);

/* level[0].x = M level[0].b, in the numbering of iccp_mg_position(). b is 0 outside and must not
 * change until then. */
void iccp_multigrid_cycle(iccp_multigrid *mg);

/* The cycle in two halves. On the way down, the finest level is processed slab by slab, so the
 * caller can work on the same slab while it is in the cache. Call it for s = 0 .. n_slabs + 2,
 * after b is known up to and including slab s. */
void iccp_multigrid_descend(iccp_multigrid *mg, size_t s);
void iccp_multigrid_correct(iccp_multigrid *mg);

/* The way up on the finest level, for s = 0 .. n_slabs + 1. Afterwards x is final up to and
 * including slab s - 2. */
void iccp_multigrid_ascend(iccp_multigrid *mg, size_t s);

#endif
