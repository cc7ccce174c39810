/* An order of elimination for the unknowns of a grid. */
#ifndef ICCP_DISSECTION_H
#define ICCP_DISSECTION_H

#include "gradient/solver/unknowns.h"

/* order[k] is the unknown that is eliminated k-th; n entries. For factorisations of the Laplacian
 * of the unknowns, whose entries it keeps from underflow: no two unknowns are joined far beyond
 * which values fall by 10^87 or so along the tree. O(n log n) time; 12 + 4 dim bytes an unknown
 * until it returns. */
icc_status iccp_dissection(const iccp_unknowns *unknowns, uint32_t *order, const iccp_env *env);

#endif
