/* Carries the normals, tangents and morph targets of a mesh by the map that its vertices follow. */
#ifndef MESH_CARRY_H
#define MESH_CARRY_H

#include "mesh/mesh_file.h"

/* A map as a mesh sees it. A function that returns false has said why. */
typedef struct mesh_mover {
    void *data;
    /* Images of n points; a point without one stays where it is, and is counted. */
    bool (*map)(void *data, size_t n, const double *points, double *images, size_t *n_failed);
    /* The derivatives at n points, dim * dim numbers each, NaN if there is none. For a point on the
     * boundary it is taken beside the point, along the point's direction (3 numbers each). */
    bool (*derive)(void *data, size_t n, const double *points, const double *directions,
                   double *derivatives);
} mesh_mover;

/* What became of normals, tangents and morph targets. */
typedef struct mesh_carried {
    size_t n_vectors, n_stay;   /* normals and tangents; those without a derivative */
    double shared;              /* normals of several vertices are off by up to this, in degrees */
    size_t n_morphed, n_beyond; /* displaced vertices; those without an image */
    bool other;                 /* there are normals or tangents that are not read, and stay */
    bool skins, animations;     /* joints, or nodes, that move; they stay */
} mesh_carried;

/* Replaces them in the text of m, whose vertices become `images`, rounded. Without a mover it only
 * counts what there is: n_vectors, n_morphed and the flags. False: see `wrong`. If its text is empty, the
 * mover has said why. */
bool mesh_carry(mesh_file *m, const double *images, const mesh_mover *mover, mesh_carried *out,
                problem *wrong);

/* ---- for the formats ---- */

bool glb_carry(mesh_file *m, const double *images, const mesh_mover *mover, mesh_carried *out,
               problem *wrong);

/* Makes an affine map of space of a derivative of dim * dim numbers. False: one is not finite. */
bool carry_derivative(double out[12], size_t dim, const double *derivative);

#endif
