/* Finds the surfaces between the regions of a caller's mesh in space. */
#ifndef ICCP_MESH_REGIONS_H
#define ICCP_MESH_REGIONS_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* The surfaces as features of kind ICC_FEATURE_REGION. */
typedef struct iccp_region_surfaces {
    iccp_memory memory;
    size_t n;
    icc_feature *features; /* n, with the next arrays */
    double *vertices;      /* as the caller gave them */
    uint32_t *facets;
} iccp_region_surfaces;

/* Cells of one number that are connected across facets are a piece. Each piece but the outermost
 * one gets a surface. They come in the order of the numbers, and for equal numbers in that of their
 * first cells. `mesh` comes from iccp_mesh_read(), and `given` has the caller's vertices. The
 * points of the surfaces move to the places after those of the boundary, surface by surface.
 * Returns ICC_ERR_BOUNDARY if a surface touches the boundary or another surface. */
icc_status iccp_region_surfaces_create(iccp_region_surfaces *out, iccp_simplices *mesh,
                                       const int32_t *regions, const double *given, icc_error *err);
void iccp_region_surfaces_free(iccp_region_surfaces *surfaces);

#endif
