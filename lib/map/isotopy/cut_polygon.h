/* A domain with features, cut open along walls and paths until each face is one polygon. */
#ifndef ICCP_CUT_POLYGON_H
#define ICCP_CUT_POLYGON_H

#include "map/compatible/overlay.h"
#include "map/isotopy/cuts.h"

/* The corners of all polygons are numbered from polygon to polygon. They are listed along the walls
 * and cuts, with the inside on the left. So a vertex may appear several times. Edge i runs from
 * corner i to the next corner of its polygon. Each polygon begins at the first of its walls. */
typedef struct iccp_cut_polygons {
    iccp_memory memory;
    size_t n_polygons;
    uint32_t n;        /* corners */
    uint32_t *first;   /* n_polygons + 1: the first corner of each polygon */
    uint32_t *vertex;  /* of each corner: a node of the domains, or a bend from domains->n on */
    uint32_t *partner; /* of each edge: the edge along the other side of the same cut or wall;
                          ICCP_NO_NEIGHBOUR on the rim */
    double *points;    /* 2 n */
    iccp_corners mesh; /* n - 2 n_polygons triangles, from polygon to polygon. Their vertices and
                          twins count from the first corner and triangle of the polygon */
} iccp_cut_polygons;

/* ICC_ERR_CERTIFICATE if rounding made cuts meet one another or walls. ICC_ERR_TOPOLOGY if the cuts
 * do not leave polygons. O(n log n). */
icc_status iccp_cut_polygons_create(iccp_cut_polygons *polygons, const iccp_domain_pair *domains,
                                    int side, const iccp_cuts *cuts, const iccp_env *env);
void iccp_cut_polygons_free(iccp_cut_polygons *polygons);

/* Returns true if two domains were cut into polygons with the same corners. */
bool iccp_cut_polygons_same(const iccp_cut_polygons *a, const iccp_cut_polygons *b);

static inline uint32_t iccp_cut_polygon_size(const iccp_cut_polygons *polygons, size_t polygon)
{
    return polygons->first[polygon + 1] - polygons->first[polygon];
}

static inline iccp_ngon iccp_cut_polygon_ngon(const iccp_cut_polygons *polygons, size_t polygon)
{
    const size_t first = polygons->first[polygon], triangle = first - 2 * polygon;
    return (iccp_ngon){polygons->points + 2 * first, polygons->mesh.vertex + 3 * triangle,
                       polygons->mesh.twin + 3 * triangle};
}

#endif
