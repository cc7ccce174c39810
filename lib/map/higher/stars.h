/* The stars of a mesh: which simplices meet at each inner vertex. */
#ifndef ICCP_STARS_H
#define ICCP_STARS_H

#include "base/env.h"
#include "geometry/simplices.h"

typedef struct iccp_stars {
    size_t first_vertex, n_vertices; /* the inner vertices of the mesh */
    uint32_t *first; /* n_vertices + 1: where the star of each begins in `simplex` */
    uint32_t *simplex;
} iccp_stars;

icc_status iccp_stars_create(iccp_stars *stars, const iccp_simplices *mesh,
                             const iccp_memory *memory);
void iccp_stars_free(iccp_stars *stars, const iccp_memory *memory);

#endif
