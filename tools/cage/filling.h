/* The inside of a cage as a conforming mesh: triangles in the plane, tetrahedra in space. It is the
 * caller's, or, where that is asked for, what the program tetgen makes of it in space. */
#ifndef FILLING_H
#define FILLING_H

#include "cage/cage.h"

typedef struct filling {
    size_t dim, n_points, n;
    double *points;    /* n_points * dim: first the vertices of the cage, in their order */
    uint32_t *corners; /* n * (dim + 1) */
    size_t n_facets;
    uint32_t *facets; /* n_facets * dim: those of the cage */
} filling;

/* Reads a mesh (Medit, VTK, OBJ, OFF) whose boundary is the cage. Its vertices may come in any
 * order: those of the cage are found by their places. False: see `wrong`, and `out` is empty. */
bool filling_read(filling *out, const cage *c, const char *text, size_t n, problem *wrong);

/* Whether the program tetgen can be run. */
bool filling_can_make(void);

/* Has tetgen fill a closed surface without touching it. False: see `wrong`, and `out` is empty. */
bool filling_make(filling *out, const cage *c, problem *wrong);

void filling_free(filling *f);

/* For the two of them: copies the facets of the cage. */
void filling_take_facets(filling *out, const cage *c);

#endif
