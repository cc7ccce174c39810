/* A surface is made coarse by collapses of edges. */
#ifndef ICCP_DECIMATE_H
#define ICCP_DECIMATE_H

#include "surface/half_edges.h"

/* Collapses edges, those first that change the shape least, until n_left >= 4 vertices are there.
 * x: coordinates by vertex, of size about 1. ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED, both
 * without a text. O(n log n) for n vertices with a bounded number of neighbours. */
icc_status iccp_decimate(iccp_half_edges *m, const double *x, size_t n_left, const iccp_env *env);

#endif
