/* Transforms the normals, tangents and morph targets of a mesh by the map that its vertices
 * follow. */
#ifndef MESH_CARRY_H
#define MESH_CARRY_H

#include "base/edits.h"
#include "mesh/mesh_file.h"

/* A map as a mesh uses it. A function that returns false has printed a message. */
typedef struct mesh_mover {
    void *data;
    /* Maps n points. A point without an image stays where it is and is counted. */
    bool (*map)(void *data, size_t n, const double *points, double *images, size_t *n_failed);
    /* Computes the derivatives at n points, dim * dim numbers each, or NaN if there is none. At a
     * boundary point the derivative is taken beside the point, along the point's direction (3
     * numbers each). */
    bool (*derive)(void *data, size_t n, const double *points, const double *directions,
                   double *derivatives);
} mesh_mover;

/* How many vectors were rotated, and how many stay because the map has no derivative there. */
typedef struct mesh_rotated {
    size_t n_arrays, n_vectors, n_stay;
} mesh_rotated;

/* The result for normals, tangents and morph targets. */
typedef struct mesh_carried {
    size_t n_vectors, n_stay;   /* normals and tangents; how many of them have no derivative and
                                   stay */
    double shared;              /* normals shared by several vertices are wrong by up to this
                                   angle, in degrees */
    size_t n_morphed, n_beyond; /* displaced vertices; how many of them have no image */
    bool other;                 /* there are normals or tangents that cannot be read; they stay */
    bool skins, animations;     /* some of them stay as they are */
    size_t skin;                /* the first skin that stays, and why, or NULL */
    const char *why;
    size_t n_joints, n_out; /* joints that move; how many of them have no image and stay */
    size_t n_copies;        /* meshes that are copies of others, at other places of a scene */
    mesh_rotated rotated;   /* mesh_vectors.h */
} mesh_carried;

/* Replaces them in the text of m, whose vertices become `images`, rounded, and moves joints along.
 * Without a mover it only counts: n_vectors, n_morphed and the flags. False: see `wrong`. If its
 * text is empty, the mover has printed a message. */
bool mesh_carry(mesh_file *m, const double *images, const mesh_mover *mover, mesh_carried *out,
                problem *wrong);

/* ---- for the formats ---- */

/* Changes the text of the mesh and moves the places of its vertices. */
void mesh_edit(mesh_file *m, edits *e);

bool glb_carry(mesh_file *m, const double *images, const mesh_mover *mover, mesh_carried *out,
               problem *wrong);

/* Makes an affine map of space from a derivative of dim * dim numbers. False if one is not
 * finite. */
bool carry_derivative(double out[12], size_t dim, const double *derivative);

#endif
