/* Plane sweep: tests whether a polygon is simple, and whether polygons and other chains of edges
 * stay apart. O(n log n). */
#ifndef ICCP_SWEEP_H
#define ICCP_SWEEP_H

#include "geometry/defect.h"
#include "geometry/polygon.h"

#include <stdbool.h>

/* A sequence of points. A closed chain is a polygon. */
typedef struct iccp_chain {
    uint32_t first, n; /* its points; at least 3 if closed */
    bool closed;       /* closed: the first point is repeated after the last */
} iccp_chain;

/* Where a chain lies relative to the others, if none of them meet. */
typedef struct iccp_chain_place {
    int32_t orientation; /* of a closed chain: +1 counter-clockwise, -1 clockwise; else 0 */
    uint32_t around;     /* innermost closed chain around it, or ICCP_NO_CHAIN */
} iccp_chain_place;

#define ICCP_NO_CHAIN UINT32_MAX

/* Chains stored one after another. Edge k joins points k and k + 1 of the same chain. */
typedef struct iccp_chains {
    size_t n_points; /* including those that close chains */
    const double *points;
    size_t n;
    const iccp_chain *item;
} iccp_chains;

/* Returns the chain of a point or an edge. */
uint32_t iccp_chain_of(const iccp_chains *chains, uint32_t point);

/* Looks for a defect of a polygon of at least 3 finite points. found->kind is 0 if there is none.
 * If there are several, any of them may be found. */
icc_status iccp_sweep(iccp_defect *found, const iccp_polygon *polygon, const iccp_env *env);

/* Like iccp_sweep(), for chains of finite points, which must not meet one another either. A chain
 * of one point touches an edge that it lies on. `places` has one entry per chain or is NULL; it is
 * undefined if there is a defect. */
icc_status iccp_sweep_chains(iccp_defect *found, iccp_chain_place *places,
                             const iccp_chains *chains, const iccp_env *env);

#endif
