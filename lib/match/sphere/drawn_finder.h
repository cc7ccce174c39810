/* Which face of a drawing on the sphere has a direction. */
#ifndef ICCP_DRAWN_FINDER_H
#define ICCP_DRAWN_FINDER_H

#include "match/surface/half_edges.h"

typedef struct iccp_drawn_finder {
    const iccp_half_edges *m; /* all of it there, certified */
    const double *directions;
    size_t n;       /* cells along the sides of a cube's faces */
    uint32_t *near; /* 6 n^2: a face near the middle of each cell */
} iccp_drawn_finder;

/* ICC_ERR_MEMORY without a text; to be freed in any case. Some steps for each vertex. */
icc_status iccp_drawn_finder_create(iccp_drawn_finder *finder, const iccp_half_edges *m,
                                    const double *directions, const iccp_memory *memory);
void iccp_drawn_finder_free(iccp_drawn_finder *finder, const iccp_memory *memory);

/* A face that has p, to rounding. A few steps where faces are of like size. */
uint32_t iccp_drawn_find(const iccp_drawn_finder *finder, const double p[3]);

/* The same by a walk from a face, on a surface some of whose vertices may have been taken away. */
uint32_t iccp_drawn_walk(const iccp_half_edges *m, const double *directions, uint32_t face,
                         const double p[3]);

#endif
