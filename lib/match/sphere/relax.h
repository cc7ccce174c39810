/* Two drawings on the sphere, each moved so that the map from one surface to the other stretches
 * less. */
#ifndef ICCP_RELAX_H
#define ICCP_RELAX_H

#include "match/sphere/composed_star.h"

typedef struct iccp_relaxation {
    iccp_drawn_surface side[2];
    const uint8_t *is_fixed[2]; /* by vertex; or NULL */
    iccp_composed_star star[2]; /* of a vertex of one on the other */
    uint32_t *hint[2]; /* by vertex: a face of the other drawing near it; or ICCP_NO_EDGE */
    uint32_t last[2];  /* a face of the other drawing near the vertex that was moved last */
    double (*room)[3];
} iccp_relaxation;

/* Of drawings that are one-to-one; vertices may be put back to them later. ICC_ERR_MEMORY without a
 * text; to be freed in any case. */
icc_status iccp_relaxation_create(iccp_relaxation *r, const iccp_drawn_surface side[2],
                                  const uint8_t *const is_fixed[2], const iccp_memory *memory);
void iccp_relaxation_free(iccp_relaxation *r, const iccp_memory *memory);

/* Steps are so many times as long as Newton's for one vertex: what it does its neighbours will do
 * as well (D. M. Young, 1954, successive overrelaxation). With 1 or 1.7 bodies come out worse. */
#define ICCP_LONGER 1.5

/* Moves the vertices of both that are there and not fixed, one by one, by steps `longer` times as
 * long as Newton's, in rounds, at most `most_rounds`, until one lowers the energy of
 * match/sphere/composed_star.h, which may be severe, by less than .3 %. *left: the energy then, of
 * all stars of both. Every face stays positive, exactly, and every star goes round once. The same
 * on every machine. ICC_ERR_MEMORY, ICC_ERR_CANCELLED without a text. */
icc_status iccp_relax(iccp_relaxation *r, double longer, bool is_severe, int most_rounds,
                      double *left, const iccp_env *env);

#endif
