/* The Laplacian of continuous functions that are linear in each simplex of a mesh. */
#ifndef ICCP_STIFFNESS_H
#define ICCP_STIFFNESS_H

#include "geometry/simplices.h"
#include "math/gram.h"

/* The stiffness matrix of all points, which is singular. */
icc_status iccp_stiffness_create(iccp_gram *gram, const iccp_simplices *mesh, const iccp_env *env);

/* Positive weights in place of such a matrix's entries, which obtuse and thin simplices may give
 * the other sign: minus the weights off the diagonal, their sums on it. Any such matrix puts values
 * between those of the neighbours. */
icc_status iccp_stiffness_to_network(iccp_gram *gram, const iccp_env *env);

/* Some rows and their columns of a matrix: row[i] is the new number of row i of `gram`, rising, or
 * UINT32_MAX. */
icc_status iccp_stiffness_restrict(iccp_gram *part, const iccp_gram *gram, const uint32_t *row,
                                   const iccp_env *env);

#endif
