/* Finds the face of a drawing on the sphere that contains a direction. */
#ifndef ICCP_DRAWN_FINDER_H
#define ICCP_DRAWN_FINDER_H

#include "match/surface/half_edges.h"

typedef struct iccp_drawn_finder {
    const iccp_half_edges *m; /* all of it present, certified */
    const double *directions;
    size_t n;       /* cells along each side of a cube's face */
    uint32_t *near; /* 6 n^2: a face near the middle of each cell */
} iccp_drawn_finder;

/* ICC_ERR_MEMORY without a text. Free it in any case. A few steps for each vertex. */
icc_status iccp_drawn_finder_create(iccp_drawn_finder *finder, const iccp_half_edges *m,
                                    const double *directions, const iccp_memory *memory);
void iccp_drawn_finder_free(iccp_drawn_finder *finder, const iccp_memory *memory);

/* Returns a face that contains p, up to rounding. A few steps if faces have similar sizes. */
uint32_t iccp_drawn_find(const iccp_drawn_finder *finder, const double p[3]);

/* Does the same by a walk from a face, on a surface from which vertices may have been removed. */
uint32_t iccp_drawn_walk(const iccp_half_edges *m, const double *directions, uint32_t face,
                         const double p[3]);

#endif
