/* Cuts segments where they cross the triangles' edges of a map. Between two cuts the map is linear,
 * so the image of a segment is exact, up to rounding, if it has vertices at its cuts. */
#ifndef MAP_EDGES_H
#define MAP_EDGES_H

#include "geo/noding.h"
#include "geo/segment_tree.h"

/* A place strictly between the ends of a segment. */
typedef struct edge_cut {
    double share; /* of the way from the segment's smaller end: the one with less x, then less y */
    double point[2], image[2];
} edge_cut;

typedef struct map_edges {
    size_t n;
    double *ends, *images; /* 4 n: from, to */
    segment_tree tree;
    edge_cut *cuts; /* the result of a query, by their shares */
    size_t n_cuts, room_cuts;
} map_edges;

/* Collects the edges of all maps of a plane carrier, except those on the cage:
 * lines have nodes there already. False if not all maps are mesh maps. Free the result in either
 * case. */
bool map_edges_make(map_edges *out, noding *x);
void map_edges_free(map_edges *edges);

/* Finds the cuts of a segment, in edges->cuts. They are the same, bit by bit, for the segment from
 * b to a. */
void map_edges_cut(map_edges *edges, const double a[2], const double b[2]);

#endif
