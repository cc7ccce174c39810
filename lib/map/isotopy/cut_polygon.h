/* A domain with features, cut open along paths until it is one polygon. */
#ifndef ICCP_CUT_POLYGON_H
#define ICCP_CUT_POLYGON_H

#include "map/compatible/overlay.h"
#include "map/isotopy/cuts.h"

/* The corners are listed along the walls and cuts, with the inside on the left. So a vertex may
 * appear several times. Edge i runs from corner i to corner i + 1. */
typedef struct iccp_cut_polygon {
    iccp_memory memory;
    uint32_t n;
    uint32_t *vertex;  /* of each corner: a vertex of the domains, or a bend from domains->n on */
    uint32_t *partner; /* of each edge: the edge along the other side of the same cut or line;
                          ICCP_NO_NEIGHBOUR on a ring */
    double *points;    /* 2 n */
    iccp_corners mesh; /* n - 2 triangles, whose vertices are corners of the polygon */
} iccp_cut_polygon;

/* ICC_ERR_CERTIFICATE if rounding made cuts meet one another or walls. O(n log n). */
icc_status iccp_cut_polygon_create(iccp_cut_polygon *polygon, const iccp_domain_pair *domains,
                                   int side, const iccp_cuts *cuts, const iccp_env *env);
void iccp_cut_polygon_free(iccp_cut_polygon *polygon);

static inline iccp_ngon iccp_cut_polygon_ngon(const iccp_cut_polygon *polygon)
{
    return (iccp_ngon){polygon->points, polygon->mesh.vertex, polygon->mesh.twin};
}

#endif
