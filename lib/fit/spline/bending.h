/* The bending energy of a function on a triangle mesh: the integral of its squared second
 * derivatives. It is 0 for affine functions, and asks nothing of the function at the boundary. */
#ifndef ICCP_BENDING_H
#define ICCP_BENDING_H

#include "math/gram.h"
#include "mesh/graded_box.h"

/* A mesh, borrowed, and the metric in which functions on it bend: the linear map from its points to
 * the points of which it measures lengths. */
typedef struct iccp_bending_mesh {
    size_t n_vertices, n_triangles;
    const double *points;      /* 2 n_vertices */
    const uint32_t *triangles; /* 3 n_triangles, counter-clockwise */
    const uint32_t *twins;     /* 3 n_triangles: ICCP_NO_NEIGHBOUR at the boundary */
    double metric[4];          /* x' = metric[0] x + metric[1] y, y' = metric[2] x + metric[3] y */
} iccp_bending_mesh;

static inline iccp_bending_mesh iccp_bending_mesh_of(const iccp_box_mesh *mesh)
{
    return (iccp_bending_mesh){mesh->n_vertices, mesh->n_triangles, mesh->points,
                               mesh->triangles,  mesh->twins,       {1, 0, 0, 1}};
}

/* Makes the matrix Q of the energy u'Qu, with one row for each vertex of the mesh. */
icc_status iccp_bending_energy(iccp_gram *energy, const iccp_bending_mesh *mesh,
                               const iccp_env *env);

#endif
