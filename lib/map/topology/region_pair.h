/* The same region of two meshes: one surface, two insides. */
#ifndef ICCP_REGION_PAIR_H
#define ICCP_REGION_PAIR_H

#include "map/topology/region_classes.h"
#include "map/topology/region_surface.h"

typedef struct iccp_region_pair {
    iccp_memory memory;
    iccp_region_surface surface;
    iccp_region_cells cells[2];
    iccp_region_classes classes[2];
    uint32_t *at[2]; /* of each edge of the surface: its number among the edges of cells[k] */
    /* Sums along the loops of the surface: class c along loop l is periods[k][classes[k].n l +
     * c] */
    uint64_t *periods[2];
} iccp_region_pair;

/* Makes the surface, and everything else if it has handles. Returns ICC_ERR_BOUNDARY if an edge of
 * the first region's surface is not in the second region. */
icc_status iccp_region_pair_create(iccp_region_pair *pair, const iccp_region regions[2],
                                   const iccp_env *env, icc_error *err);
void iccp_region_pair_free(iccp_region_pair *pair);

/* Copies the values of a class of side k at the edges of the surface. */
void iccp_region_pair_class(iccp_region_pair *pair, int k, const uint64_t *coefficients,
                            uint64_t *values);

#endif
