/* A triangle mesh of one region without the regions inside it. */
#ifndef ICCP_REGION_MESH_H
#define ICCP_REGION_MESH_H

#include "kernel/biharmonic/region_vertices.h"

typedef struct iccp_region_mesh {
    iccp_memory memory;
    size_t n, n_triangles;
    double *points;      /* 2 n, local */
    uint32_t *vertex;    /* n: their numbers in the region's vertices, in rising order */
    uint32_t *triangles; /* 3 n_triangles, counter-clockwise; numbers below n */
    uint32_t *twins;     /* 3 n_triangles: see iccp_triangulate_mesh() */
} iccp_region_mesh;

/* Triangulates the region between its walls and those of the regions directly inside it. `parent`
 * has the parent of each region. The triangulation is constrained Delaunay. Returns
 * ICC_ERR_RESOLUTION if walls are so close that rounded points on them touch. */
icc_status iccp_region_mesh_create(iccp_region_mesh *mesh, const iccp_region_vertices *vertices,
                                   const uint32_t *parent, uint32_t region, const iccp_env *env,
                                   icc_error *err);
void iccp_region_mesh_free(iccp_region_mesh *mesh);

#endif
