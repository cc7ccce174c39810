/* Improves the worst tetrahedra by flips and smoothing. */
#ifndef ICCP_RESHAPE_H
#define ICCP_RESHAPE_H

#include "fill/tets.h"

/* Tries flips around a tetrahedron. Makes one only if it improves the worst of the tetrahedra that
 * change. */
bool iccp_improve_tet(iccp_tets *m, uint32_t t);

/* Moves an inner point to improve the worst tetrahedron at it. */
bool iccp_smooth_point(iccp_tets *m, uint32_t p);

/* Contracts and smooths the inner points. The earlier stages put them where they were necessary,
 * not where they give a good shape. Flips all bad tetrahedra: refinement would go on and on round
 * flat ones. */
icc_status iccp_tets_clean_up(iccp_tets *m, const iccp_env *env, icc_error *err);

/* Makes some rounds of flips and smoothing. With `by_angle`, tetrahedra are better if their least
 * dihedral angle has the larger sine, and slivers are split as long as there are fewer than `most`
 * points in all. */
icc_status iccp_tets_improve(iccp_tets *m, bool by_angle, uint64_t most, const iccp_env *env,
                             icc_error *err);

#endif
