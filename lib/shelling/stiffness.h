/* The Laplacian of continuous functions that are linear in each simplex of a mesh. Source:
 * linear finite elements. */
#ifndef ICCP_STIFFNESS_H
#define ICCP_STIFFNESS_H

#include "geometry/simplices.h"
#include "math/gram.h"

/* The stiffness matrix of all points, which is singular. */
icc_status iccp_stiffness_create(iccp_gram *gram, const iccp_simplices *mesh, const iccp_env *env);

/* Replaces the entries of such a matrix by positive weights, because obtuse and thin simplices
 * may give entries of the wrong sign. Entries off the diagonal become minus the weights, and the
 * diagonal their sums. With such a matrix each value lies between those of its neighbours. */
icc_status iccp_stiffness_to_network(iccp_gram *gram, const iccp_env *env);

/* Selects rows of a matrix and the same columns. row[i] is the new number of row i of `gram`,
 * rising, or UINT32_MAX. */
icc_status iccp_stiffness_restrict(iccp_gram *part, const iccp_gram *gram, const uint32_t *row,
                                   const iccp_env *env);

#endif
