/* Triangulates the facets of a point that is about to leave the surface, without that point. */
#ifndef ICCP_LIFTING_H
#define ICCP_LIFTING_H

#include "fill/constraints.h"

typedef struct iccp_lifting {
    iccp_tets *m;
    const iccp_constraints *s;
    iccp_list walls; /* walls at the point */
    iccp_list polygon;
    iccp_list triangles; /* triangles of all its facets: three points and the facet */
    uint32_t p;
} iccp_lifting;

/* Fills in m->star and l->walls for l->p. Returns false if there is no memory. */
bool iccp_lifting_walls(iccp_lifting *l);

static inline uint32_t iccp_lifting_facet(const iccp_lifting *l, uint32_t side)
{
    return l->m->tet[side / 4].across[side % 4] & ~ICCP_WALL;
}

/* Returns the edge of a wall opposite l->p, counter-clockwise from inside. */
void iccp_lifting_opposite(const iccp_lifting *l, uint32_t side, uint32_t edge[2]);

/* Fills in l->triangles without l->p, for the listed walls, counter-clockwise from inside. Returns
 * false if there is no ear to cut, or no memory. */
bool iccp_lifting_triangulate(iccp_lifting *l);

#endif
