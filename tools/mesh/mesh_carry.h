/* What is attached to the vertices of a mesh and has a direction or a place of its own: normals, tangents,
 * morph targets. It follows the map as the vertices do. */
#ifndef MESH_CARRY_H
#define MESH_CARRY_H

#include "mesh/mesh_file.h"

/* A map as a mesh sees it. What returns false has said why. */
typedef struct mesh_mover {
    void *data;
    /* Images of n points; a point without one stays where it is, and is counted. */
    bool (*map)(void *data, size_t n, const double *points, double *images, size_t *n_failed);
    /* The derivatives at n points, dim * dim each; NaN where there is none. Where a point lies on the
     * boundary it is taken beside it, along the direction that the point has (3 numbers each). */
    bool (*derive)(void *data, size_t n, const double *points, const double *directions,
                   double *derivatives);
} mesh_mover;

/* What became of it. */
typedef struct mesh_carried {
    size_t n_vectors, n_stay;   /* normals and tangents; those without a derivative */
    double shared;              /* normals of several vertices are off by this, in degrees */
    size_t n_morphed, n_beyond; /* displaced vertices; those without an image */
    bool other;                 /* there are normals or tangents that are not read, and stay */
    bool skins, animations;     /* joints, or nodes, that move; they stay */
} mesh_carried;

/* Replaces all that in the text of m, whose vertices become `images`, rounded. Without a mover it only
 * says what there is: n_vectors, n_morphed and the flags. False: see `wrong`, or the mover has said why, and
 * then the text of `wrong` is empty. */
bool mesh_carry(mesh_file *m, const double *images, const mesh_mover *mover, mesh_carried *out,
                problem *wrong);

/* ---- for the formats ---- */

bool glb_carry(mesh_file *m, const double *images, const mesh_mover *mover, mesh_carried *out,
               problem *wrong);

/* A derivative of dim * dim numbers as that of a map of space. False: it is none. */
bool carry_derivative(double out[12], size_t dim, const double *derivative);

#endif
