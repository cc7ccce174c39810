/* A domain with features, cut open along paths until it is one polygon. */
#ifndef ICCP_CUT_POLYGON_H
#define ICCP_CUT_POLYGON_H

#include "map/compatible/overlay.h"
#include "map/isotopy/cuts.h"

/* Its corners are met on the way round along the walls and cuts, the inside being on the left; a
 * vertex may be met several times. Edge i runs from corner i to corner i + 1. */
typedef struct iccp_cut_polygon {
    iccp_memory memory;
    uint32_t n;
    uint32_t *vertex;  /* of each corner: one of the scene's, or, from scene->n on, a bend */
    uint32_t *partner; /* of each edge: the one along its other side; or, of a ring's,
                          ICCP_NO_NEIGHBOUR */
    double *points;    /* 2 n */
    iccp_corners mesh; /* n - 2 triangles with corners of the polygon for vertices */
} iccp_cut_polygon;

/* ICC_ERR_CERTIFICATE when cuts meet others or walls, by rounding. O(n log n). */
icc_status iccp_cut_polygon_create(iccp_cut_polygon *polygon, const iccp_scene *scene, int side,
                                   const iccp_cuts *cuts, const iccp_env *env);
void iccp_cut_polygon_free(iccp_cut_polygon *polygon);

static inline iccp_ngon iccp_cut_polygon_ngon(const iccp_cut_polygon *polygon)
{
    return (iccp_ngon){polygon->points, polygon->mesh.vertex, polygon->mesh.twin};
}

#endif
