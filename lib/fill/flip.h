/* Flips: removal of an edge or of a face. */
#ifndef ICCP_FLIP_H
#define ICCP_FLIP_H

#include "fill/tets.h"

enum { ICCP_MOST_RING = 10 };

/* How to triangulate the link of edge pq anew. Each triangle forms a tetrahedron with p and one
 * with q. */
typedef struct iccp_removal {
    /* Returns the worth of triangle (x, y, z), which forms the tetrahedra (x, y, z, q) and (y, x,
     * z, p). If side xz is an inner one, its worth is included. Returns -HUGE_VAL if the triangle
     * is forbidden. */
    double (*worth)(void *context, uint32_t x, uint32_t y, uint32_t z, bool inner_xz);
    void *context;
    bool sum; /* true: the worths of all triangles are added; false: the least one counts */
} iccp_removal;

/* Removes edge pq, whose ring is in m->ring and m->link. Uses the best triangulation of the link if
 * its worth is more than `least`. Returns false if nothing has changed, as for an edge
 * that must stay. */
bool iccp_remove_edge(iccp_tets *m, uint32_t p, uint32_t q, const iccp_removal *removal,
                      double least);

/* Lists the three tetrahedra around a new edge that may replace the two at a side. Returns false at
 * a wall. */
bool iccp_face_removed(const iccp_tets *m, uint32_t side, uint32_t fresh[3][4]);

/* Makes that replacement. Returns false if nothing has changed. */
bool iccp_remove_face(iccp_tets *m, uint32_t side);

#endif
