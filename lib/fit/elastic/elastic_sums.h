/* Sums the elastic energy and its derivatives. */
#ifndef ICCP_ELASTIC_SUMS_H
#define ICCP_ELASTIC_SUMS_H

#include "fit/elastic/elastic_parts.h"

/* Energy of the triangles. */
double iccp_elastic_triangles(const iccp_elastic_state *state);

/* Energy of the springs. */
double iccp_elastic_springs(const iccp_elastic_state *state);

/* Sums the gradient and the Hessian at the present images into state->own.assembly. Row 2 v + k
 * belongs to vertex v and axis k of its frame (iccp_elastic_axis()). Rows of fixed unknowns are 0
 * but for the diagonal. */
void iccp_elastic_sum(iccp_elastic_state *state);

/* Writes axis k of a vertex. A sliding vertex moves along axis 0; axis 1 is told. */
static inline void iccp_elastic_axis(const iccp_elastic *elastic, uint32_t v, size_t k,
                                     double *axis)
{
    const double *d = elastic->axis + 2 * (size_t)v;
    axis[0] = k == 0 ? d[0] : -d[1];
    axis[1] = k == 0 ? d[1] : d[0];
}

/* Returns true if unknown k of a vertex is told. */
static inline bool iccp_elastic_is_told(const iccp_elastic *elastic, uint32_t v, size_t k)
{
    return elastic->hold[v] == ICCP_HELD || (elastic->hold[v] == ICCP_SLIDING && k == 1);
}

#endif
