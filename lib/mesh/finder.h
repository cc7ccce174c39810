/* Which triangle of a mesh holds a point. */
#ifndef ICCP_FINDER_H
#define ICCP_FINDER_H

#include "base/once.h"
#include "mesh/planar.h"

/* Finds by a grid, which is made when the first point is looked for: many meshes are never asked.
 * Nothing else about a finder changes, so that several threads may ask at the same time. */
typedef struct iccp_finder {
    iccp_memory memory;
    const double *points;      /* of the vertices: the mesh's own, or their images */
    const uint32_t *triangles; /* 3 n_triangles vertices, all triangles counter-clockwise */
    const uint32_t *twins;     /* 3 n_triangles: ICCP_NO_NEIGHBOUR at the boundary */
    size_t n_vertices, n_triangles;
    double density; /* cells of the grid per triangle */
    double reach;   /* see iccp_found */
    iccp_once grid;
} iccp_finder;

/* Where a point lies. */
typedef struct iccp_found {
    uint32_t triangle; /* that holds it, exactly, the first of several; or ICCP_NO_NEIGHBOUR */
    bool is_near;      /* whether it may be within `reach` of the mesh's boundary, or outside of the
                          mesh's box; elsewhere in the mesh's plane it is farther away */
    double bary[3];    /* in the triangle: not negative, sum 1 */
} iccp_found;

/* Points that are looked for at once, at most. */
enum { ICCP_FINDER_MANY = 128 };

/* How many points will be looked for: a finer grid finds them faster, but takes longer to make, and
 * more memory. */
typedef enum iccp_demand { ICCP_FEW_POINTS, ICCP_MANY_POINTS } iccp_demand;

/* For the triangles of a mesh with their corners at `points`, all of them borrowed. The grid will
 * live in `memory`. */
void iccp_finder_init(iccp_finder *finder, const iccp_planar *mesh, const double *points,
                      double reach, iccp_demand demand, const iccp_memory *memory);
void iccp_finder_free(iccp_finder *finder);

/* Asks the budget for what the grid will take where that is much. O(n). */
icc_status iccp_finder_budget(const iccp_finder *finder, const iccp_env *env);

/* Makes the grid if there is none: ICC_OK or ICC_ERR_MEMORY. Whoever asks in parallel does so
 * first. */
icc_status iccp_finder_ready(const iccp_finder *finder);

/* ICC_OK; ICC_ERR_TRACE when no triangle holds the point; ICC_ERR_MEMORY without a grid. */
icc_status iccp_finder_find(const iccp_finder *finder, const double p[2], iccp_found *found);

/* The same for a single point, without a grid: ICC_OK or ICC_ERR_TRACE. O(n). */
icc_status iccp_finder_find_alone(const iccp_finder *finder, const double p[2], iccp_found *found);

/* As iccp_finder_find(), for n points with 2 coordinates each and a grid that is ready. `other` are
 * other points of the vertices, which are about to be read for the triangles that are found. */
void iccp_finder_find_many(const iccp_finder *finder, size_t n, const double *points,
                           const double *other, iccp_found *found);

#endif
