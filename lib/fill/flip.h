/* Flips: an edge is removed, or a face. */
#ifndef ICCP_FLIP_H
#define ICCP_FLIP_H

#include "fill/tets.h"

enum { ICCP_MOST_RING = 10 };

/* What becomes of the ring round edge pq: triangles of its link, each with p and with q. */
typedef struct iccp_removal {
    /* What triangle (x, y, z) is worth, with tetrahedra (x, y, z, q) and (y, x, z, p), and so side
     * xz if it is an inner one; -HUGE_VAL: it must not be. */
    double (*worth)(void *context, uint32_t x, uint32_t y, uint32_t z, bool inner_xz);
    void *context;
    bool sum; /* all triangles' worths are added; else the smallest of them counts */
} iccp_removal;

/* Removes edge pq, whose ring is in m->ring and m->link, for the best triangulation of the link if
 * that is worth more than `least`. False: nothing has changed. */
bool iccp_remove_edge(iccp_tets *m, uint32_t p, uint32_t q, const iccp_removal *removal,
                      double least);

/* The three tetrahedra round a new edge that may replace the two at a side; false at a wall. */
bool iccp_face_removed(const iccp_tets *m, uint32_t side, uint32_t fresh[3][4]);

/* Puts them there. False: nothing has changed. */
bool iccp_remove_face(iccp_tets *m, uint32_t side);

#endif
