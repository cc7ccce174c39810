/* A triangle mesh of a box: fine near given points, coarser away from them, with the points as its
 * first vertices. */
#ifndef ICCP_GRADED_BOX_H
#define ICCP_GRADED_BOX_H

#include "mesh/edge_set.h"

#include "base/env.h"

/* The width of cells grows by this share of the distance from the points. The prototype's value
 * (fit of control points with 6 to 3,000 points). */
#define ICCP_BOX_SLOPE 0.5

/* What to mesh. The core is a box inside the box. Cells outside the core grow with the distance
 * from it. */
typedef struct iccp_graded_box {
    const double *lower, *upper;
    const double *core_lower, *core_upper;
    size_t n;
    const double *points;       /* 2 n: different, inside the box, not on its boundary */
    const double *width;        /* n: width of cells at each point */
    double largest;             /* largest width of a cell in the core */
    const iccp_edge_set *walls; /* edges between points that the mesh must have; NULL: none */
} iccp_graded_box;

typedef struct iccp_box_mesh {
    iccp_memory memory;
    size_t n_vertices, n_triangles;
    double *points;      /* 2 n_vertices: first the given points, in their order */
    uint32_t *triangles; /* 3 n_triangles: counter-clockwise */
    uint32_t *twins;     /* 3 n_triangles: ICCP_NO_NEIGHBOUR at the boundary */
} iccp_box_mesh;

/* Makes the constrained Delaunay triangulation of the points, and of the corners and centres of a
 * quadtree's leaves. All vertices are different. The boundary of the box has vertices at its four
 * corners. Returns ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED; ICC_ERR_BOUNDARY or ICC_ERR_OUTSIDE
 * if walls cross or a vertex lies on one. O(n log n). On failure nothing stays allocated. */
icc_status iccp_graded_box_mesh(iccp_box_mesh *mesh, const iccp_graded_box *box,
                                const iccp_env *env);
void iccp_box_mesh_free(iccp_box_mesh *mesh);

/* Writes the triangles and twins of the Delaunay triangulation of mesh->points with these walls
 * (NULL: none). The points are different and do not all lie on one line. Failures are as above, and
 * the mesh is freed then. */
icc_status iccp_box_mesh_triangulate(iccp_box_mesh *mesh, const iccp_edge_set *walls,
                                     const iccp_env *env);

#endif
