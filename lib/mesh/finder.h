/* Which triangle of a mesh holds a point. */
#ifndef ICCP_FINDER_H
#define ICCP_FINDER_H

#include "mesh/planar.h"

/* A grid of cells, each with the triangles that come near it. */
typedef struct iccp_finder {
    iccp_memory memory;
    const double *points;      /* the mesh's own, or its image: borrowed */
    const uint32_t *triangles; /* borrowed */
    double origin[2], rate;    /* cell = (point - origin) * rate */
    size_t size[2];
    uint32_t *first;   /* cells + 1: where the triangles of a cell begin in `entries` */
    uint32_t *entries; /* triangles, cell by cell */
} iccp_finder;

/* For the mesh's triangles with their corners at `points`, all counter-clockwise. */
icc_status iccp_finder_create(iccp_finder *finder, const iccp_planar *mesh, const double *points,
                              const iccp_env *env);
void iccp_finder_free(iccp_finder *finder);

/* The triangle that holds p, exactly, the first of several, and p's barycentric coordinates in it:
 * not negative, sum 1. False when there is none. */
bool iccp_finder_find(const iccp_finder *finder, const double p[2], uint32_t *triangle,
                      double bary[3]);

#endif
