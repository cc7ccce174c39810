/* Flips and smoothing: the worst tetrahedra become better. */
#ifndef ICCP_RESHAPE_H
#define ICCP_RESHAPE_H

#include "fill/tets.h"

/* Makes the worst of what is round a tetrahedron better by a flip, if one does: never worse. */
bool iccp_improve_tet(iccp_tets *m, uint32_t t);

/* Moves an inner point to where the worst tetrahedron at it is better. */
bool iccp_smooth_point(iccp_tets *m, uint32_t p);

/* Contracts and smooths the points inside, which are where they had to be, not where they should
 * be. */
icc_status iccp_tets_settle(iccp_tets *m, const iccp_env *env, icc_error *err);

/* Some rounds of flips and smoothing. */
icc_status iccp_tets_improve(iccp_tets *m, const iccp_env *env, icc_error *err);

#endif
