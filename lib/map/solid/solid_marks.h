/* What a map in space must keep: fixed points, and marked faces and edges of the mesh. */
#ifndef ICCP_SOLID_MARKS_H
#define ICCP_SOLID_MARKS_H

#include "geometry/simplices.h"

/* The vertices of the domain are the first points of the mesh. They are fixed. So are the points on
 * its lines. Facets of the boundary and of regions are marked, and the pieces of lines. All arrays
 * but `edges` and `fixed` are borrowed. */
typedef struct iccp_solid_marks {
    size_t n_boundary;      /* the first points are fixed, */
    size_t n_points;        /* and of the others below this number */
    const uint8_t *fixed;   /* those with fixed[v] != 0, unless it is NULL */
    size_t n_facets;        /* marked facets, those of the boundary first */
    const uint32_t *facets; /* dim points of each */
    size_t n_edges;
    const uint32_t *edges; /* 2 points of each */
} iccp_solid_marks;

static inline bool iccp_solid_is_fixed(const iccp_solid_marks *marks, uint32_t point)
{
    return point < marks->n_boundary ||
           (point < marks->n_points && marks->fixed != NULL && marks->fixed[point] != 0);
}

#endif
