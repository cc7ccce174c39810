/* Points inside, where tetrahedra are too long or too large for what is round them. */
#ifndef ICCP_INNER_POINTS_H
#define ICCP_INNER_POINTS_H

#include "fill/surface.h"

/* Inserts points until tetrahedra have circumspheres of at most `ratio` times their shortest edge,
 * or what edges are like there, if that is longer; not close to the surface, and no more than
 * `most`. */
icc_status iccp_tets_refine(iccp_tets *m, const iccp_surface *s, double ratio, uint64_t most,
                            const iccp_env *env, icc_error *err);

#endif
