/* What a point of the surface that is about to leave it leaves behind. */
#ifndef ICCP_LIFTING_H
#define ICCP_LIFTING_H

#include "fill/surface.h"

typedef struct iccp_lifting {
    iccp_tets *m;
    const iccp_surface *s;
    iccp_list walls; /* the sides at the point that are walls */
    iccp_list polygon;
    iccp_list triangles; /* of all its facets: three points and the facet */
    uint32_t p;
} iccp_lifting;

/* Fills in m->star and l->walls for l->p. False if there is no memory. */
bool iccp_lifting_walls(iccp_lifting *l);

static inline uint32_t iccp_lifting_facet(const iccp_lifting *l, uint32_t side)
{
    return l->m->tet[side / 4].across[side % 4] & ~ICCP_WALL;
}

/* The edge of a wall opposite l->p, counter-clockwise from inside. */
void iccp_lifting_opposite(const iccp_lifting *l, uint32_t side, uint32_t edge[2]);

/* Fills in l->triangles without l->p, for the walls listed, counter-clockwise from inside. False if
 * there is no ear to cut, or no memory. */
bool iccp_lifting_triangulate(iccp_lifting *l);

#endif
