/* Triangles and their neighbours, as corners.
 *
 * Corner c belongs to triangle c / 3 and faces one of its edges, the half-edge c. That runs from
 * the vertex after c to the vertex before c, counter-clockwise. The twin of c is the corner that
 * faces the same edge from the other triangle. Vertex n_points is the ghost. The triangles between
 * it and the edges of the hull cover the plane outside the hull, so every half-edge has a twin. */
#ifndef ICCP_TRIMESH_H
#define ICCP_TRIMESH_H

#include "base/env.h"
#include "base/triangle_corners.h"
#include "mesh/walls.h"

#include <stdbool.h>
#include <stddef.h>

/* The limit leaves a bit of a corner unused, and an index fits into the sort key of
 * mesh/insertion_order.c. */
#define ICCP_TRIMESH_MAX_POINTS ((size_t)1 << 28)

typedef struct iccp_corner {
    uint32_t vertex, twin;
} iccp_corner;

typedef struct iccp_trimesh {
    const double *points; /* borrowed */
    uint32_t n_points;
    uint32_t n_boundary;     /* the first points are the vertices of a polygon, in order */
    const iccp_walls *walls; /* borrowed: the segments to keep; NULL: the polygon's edges */
    uint32_t n_triangles;
    iccp_corner *corners; /* 3 (2 n_points - 2), all of which are used in the end */
} iccp_trimesh;

/* Returns the corner at the same vertex in the next triangle around it, counter-clockwise. */
static inline uint32_t iccp_around(const iccp_trimesh *mesh, uint32_t corner)
{
    return iccp_after(mesh->corners[iccp_after(corner)].twin);
}

static inline void iccp_link_twins(iccp_trimesh *mesh, uint32_t a, uint32_t b)
{
    mesh->corners[a].twin = b;
    mesh->corners[b].twin = a;
}

static inline const double *iccp_point(const iccp_trimesh *mesh, uint32_t vertex)
{
    return mesh->points + 2 * (size_t)vertex;
}

/* Returns true if the segment between two vertices must be kept. */
static inline bool iccp_is_wall(const iccp_trimesh *mesh, uint32_t a, uint32_t b)
{
    if (mesh->walls != NULL)
        return iccp_walls_have(mesh->walls, a, b);
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    return high < mesh->n_boundary && (high - low == 1 || high - low == mesh->n_boundary - 1);
}

/* Flips the edge that the corner faces: replaces it by the other diagonal of its two triangles. The
 * corner and the one after it keep their vertices, and the triangles keep their places. */
static inline void iccp_flip(iccp_trimesh *mesh, uint32_t corner)
{
    iccp_corner *const c = mesh->corners;
    const uint32_t after = iccp_after(corner), before = iccp_before(corner);
    const uint32_t twin = c[corner].twin;
    const uint32_t twin_after = iccp_after(twin), twin_before = iccp_before(twin);
    const uint32_t outer = c[twin_after].twin, twin_outer = c[after].twin;
    c[before].vertex = c[twin].vertex;
    c[twin_before].vertex = c[corner].vertex;
    iccp_link_twins(mesh, corner, outer);
    iccp_link_twins(mesh, twin, twin_outer);
    iccp_link_twins(mesh, after, twin_after);
}

#endif
