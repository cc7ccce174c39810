/* Moves two drawings on the sphere so that the map from one surface to the other stretches less. */
#ifndef ICCP_RELAX_H
#define ICCP_RELAX_H

#include "match/sphere/composed_star.h"

typedef struct iccp_relaxation {
    iccp_drawn_surface side[2];
    const uint8_t *is_fixed[2]; /* by vertex; or NULL */
    iccp_composed_star star[2]; /* of a vertex of one drawing on the other */
    uint32_t *hint[2]; /* by vertex: a face of the other drawing near it; or ICCP_NO_EDGE */
    uint32_t last[2];  /* a face of the other drawing near the vertex that was moved last */
    double (*room)[3];
} iccp_relaxation;

/* Prepares drawings that are one-to-one. Vertices may be added to them later. ICC_ERR_MEMORY
 * without a text. Free it in any case. */
icc_status iccp_relaxation_create(iccp_relaxation *r, const iccp_drawn_surface side[2],
                                  const uint8_t *const is_fixed[2], const iccp_memory *memory);
void iccp_relaxation_free(iccp_relaxation *r, const iccp_memory *memory);

/* Steps are this many times as long as Newton's step for one vertex, because its neighbours will
 * move the same way (D. M. Young, 1954, successive overrelaxation). With 1 or 1.7 the maps of
 * solids come out worse. */
#define ICCP_LONGER 1.5

/* Moves the present vertices of both drawings that are not fixed, one by one. Steps are `longer`
 * times as long as Newton's. It ends with the first round that lowers the energy by less than
 * 0.3 %. The energy is that of match/sphere/composed_star.h and may be severe. *left
 * becomes the energy of all stars of both drawings. Every face stays positive, exactly, and each
 * vertex's neighbours turn once around it. The same on every machine. ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED without a text. */
icc_status iccp_relax(iccp_relaxation *r, double longer, bool is_severe, double *left,
                      const iccp_env *env);

#endif
