/* Point location: finds the triangle of a mesh that contains a point. */
#ifndef ICCP_FINDER_H
#define ICCP_FINDER_H

#include "base/once.h"
#include "mesh/planar.h"

/* Finds triangles with a grid. The first query makes the grid, because many meshes are never
 * queried. Nothing else in a finder changes, so several threads may use it at the same time. */
typedef struct iccp_finder {
    iccp_memory memory;
    const double *points;      /* the vertices of the mesh, or their images */
    const uint32_t *triangles; /* 3 n_triangles vertices, all triangles counter-clockwise */
    const uint32_t *twins;     /* 3 n_triangles: ICCP_NO_NEIGHBOUR at the boundary */
    size_t n_vertices, n_triangles;
    double density; /* grid cells per triangle */
    double reach;   /* see iccp_found */
    iccp_once grid;
} iccp_finder;

/* The result of a query. */
typedef struct iccp_found {
    /* The triangle that contains the point (exact, the first if there are several), or
     * ICCP_NO_NEIGHBOUR */
    uint32_t triangle;
    /* True if the point may be within `reach` of the mesh's boundary, or lies outside the mesh's
     * box. If false, the point is farther away from the boundary. */
    bool is_near;
    double bary[3]; /* barycentric coordinates in the triangle: not negative, sum 1 */
} iccp_found;

/* Most points of one batch. */
enum { ICCP_FINDER_MANY = 128 };

/* How many points will be looked up. A finer grid finds them faster, but takes longer to make and
 * more memory. */
typedef enum iccp_demand { ICCP_FEW_POINTS, ICCP_MANY_POINTS } iccp_demand;

/* Prepares a finder for the triangles of a mesh with their corners at `points`. All arrays are
 * borrowed. The grid will be allocated in `memory`. */
void iccp_finder_init(iccp_finder *finder, const iccp_planar *mesh, const double *points,
                      double reach, iccp_demand demand, const iccp_memory *memory);
void iccp_finder_free(iccp_finder *finder);

/* Charges the budget for the grid if that is large. O(n). */
icc_status iccp_finder_budget(const iccp_finder *finder, const iccp_env *env);

/* Makes the grid if there is none. Returns ICC_OK or ICC_ERR_MEMORY. Call it before parallel
 * queries. */
icc_status iccp_finder_ready(const iccp_finder *finder);

/* Looks up a point. Returns ICC_OK, ICC_ERR_TRACE if no triangle contains the point, or
 * ICC_ERR_MEMORY if there is no grid. */
icc_status iccp_finder_find(const iccp_finder *finder, const double p[2], iccp_found *found);

/* Looks up a single point without a grid. Returns ICC_OK or ICC_ERR_TRACE. O(n). */
icc_status iccp_finder_find_alone(const iccp_finder *finder, const double p[2], iccp_found *found);

/* Batch version of iccp_finder_find() for n points with 2 coordinates each; the grid must be ready.
 * `other` is a second position of each vertex, which the caller is about to read for the triangles
 * found. */
void iccp_finder_find_many(const iccp_finder *finder, size_t n, const double *points,
                           const double *other, iccp_found *found);

#endif
