/* The inside of a cage as a conforming mesh: triangles in the plane, tetrahedra in space. The mesh
 * is the caller's. */
#ifndef FILLING_H
#define FILLING_H

#include "cage/cage.h"

typedef struct filling {
    size_t dim, n_points, n;
    double *points;    /* n_points * dim: first the vertices of the cage, in their order */
    uint32_t *corners; /* n * (dim + 1) */
    int32_t *regions;  /* in space: of each tetrahedron, as the file numbers them; or NULL */
    size_t n_facets;
    uint32_t *facets; /* n_facets * dim: those of the cage */
} filling;

/* Reads a mesh (Medit, VTK, OBJ, OFF) whose boundary is the cage. Its vertices may come in any
 * order, because the cage's vertices are found by their places. False: see `wrong`, and `out` is
 * empty. */
bool filling_read(filling *out, const cage *c, const char *text, size_t n, problem *wrong);

void filling_free(filling *f);

#endif
