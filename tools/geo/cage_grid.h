/* Finds the edges of a plane cage that come close to a segment. */
#ifndef CAGE_GRID_H
#define CAGE_GRID_H

#include "geo/carrier.h"

typedef struct cage_grid {
    const carrier *cage;
    double corner[2], cell[2], near; /* `near`: an edge this close is always listed */
    size_t n[2];
    size_t *starts; /* n[0] * n[1] + 1: the first edge of each cell */
    uint32_t *edges;
    uint32_t *asked; /* for each edge: the last query that returned it */
    uint32_t question;
    uint32_t *found; /* the result of a query */
    size_t n_found;
} cage_grid;

void cage_grid_make(cage_grid *out, const carrier *cage, double near);
void cage_grid_free(cage_grid *grid);

/* Finds the edges close to a segment, in grid->found. */
void cage_grid_ask(cage_grid *grid, const double a[2], const double b[2]);

/* Finds the edges close to a box. A box that is far away gets all edges close to its nearest
 * cells. */
void cage_grid_ask_box(cage_grid *grid, const double lower[2], const double upper[2]);

/* True if all edges are more than `near` away from a box. */
bool cage_grid_is_far(cage_grid *grid, const double lower[2], const double upper[2]);

/* The ends of an edge of the cage. */
static inline const double *cage_end(const carrier *c, uint32_t edge, size_t end)
{
    return c->vertices[0] + 2 * (size_t)c->facets[0][2 * edge + end];
}

#endif
