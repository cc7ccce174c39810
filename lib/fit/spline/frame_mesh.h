/* The mesh of a frame around control points. */
#ifndef ICCP_FRAME_MESH_H
#define ICCP_FRAME_MESH_H

#include "mesh/graded_box.h"

/* Control points and the box to cover. */
typedef struct iccp_frame_region {
    size_t n;
    const double *points; /* 2 n, all different */
    double *spacing; /* n: distance to the nearest other point, at most the box's size; twice the
                             length of walls, because these need no room beside them */
    double lower[2], upper[2];
    double size;                /* longest side of the box */
    const iccp_edge_set *walls; /* edges that the mesh must have; NULL: none */
} iccp_frame_region;

/* Finds the box, which contains the given one (NULL: none) and all points, and the spacings. The
 * caller frees `spacing`. O(n log n). */
icc_status iccp_frame_region_create(iccp_frame_region *region, size_t n, const double *points,
                                    const iccp_edge_set *walls, const double *lower,
                                    const double *upper, const iccp_env *env);

/* Meshes the box and a margin around it, in longest sides. Cells have at most the width size /
 * across, and at points their spacing, but at least the share `least` of that. */
icc_status iccp_frame_mesh(iccp_box_mesh *mesh, const iccp_frame_region *region, double margin,
                           double across, double least, const iccp_env *env);

#endif
