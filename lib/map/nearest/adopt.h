/* Moves new vertices of a region's map onto vertices that the region had. */
#ifndef ICCP_ADOPT_H
#define ICCP_ADOPT_H

#include "map/compatible/plmap.h"
#include "mesh/finder.h"

/* The vertices that a region had inside. */
typedef struct iccp_lost {
    const iccp_finder *given; /* of the mesh before, ready */
    const uint32_t *inside;   /* n of its vertices */
    const uint32_t *place;    /* of each of its vertices: its place in `inside`; undefined for
                                 others */
    size_t n;
} iccp_lost;

/* Moves each vertex v of `map` that has no number onto the nearest lost vertex that is still free,
 * if all triangles stay positive. number[v] becomes that vertex. Its image does not move. Vertices
 * without a number must lie inside the map. Otherwise a new vertex could lie next to an old one. */
icc_status iccp_adopt_vertices(iccp_plmap *map, uint32_t *number, const iccp_lost *lost,
                               const iccp_env *env);

#endif
