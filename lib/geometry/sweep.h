/* Whether a polygon is simple, and whether several and other chains of edges keep apart, in
 * O(n log n). */
#ifndef ICCP_SWEEP_H
#define ICCP_SWEEP_H

#include "geometry/defect.h"
#include "geometry/polygon.h"

#include <stdbool.h>

/* Points in a row; a closed chain is a polygon. */
typedef struct iccp_chain {
    uint32_t first, n; /* its points; at least 3 of a closed one */
    bool closed;       /* its first point follows once more behind the last */
} iccp_chain;

/* Where a chain lies with respect to the others, when none of them meet. */
typedef struct iccp_chain_place {
    int32_t orientation; /* of a closed one: +1 counter-clockwise, -1 clockwise; else 0 */
    uint32_t around;     /* the innermost closed chain around it, or ICCP_NO_CHAIN */
} iccp_chain_place;

#define ICCP_NO_CHAIN UINT32_MAX

/* Chains one behind the other. Edge k joins points k and k + 1 of the same chain. */
typedef struct iccp_chains {
    size_t n_points; /* those that close chains included */
    const double *points;
    size_t n;
    const iccp_chain *item;
} iccp_chains;

/* The chain of a point or an edge. */
uint32_t iccp_chain_of(const iccp_chains *chains, uint32_t point);

/* Looks for a defect of a polygon of at least 3 finite points; found->kind is 0 if there is none.
 * Which one is found of several says nothing. */
icc_status iccp_sweep(iccp_defect *found, const iccp_polygon *polygon, const iccp_env *env);

/* The same for chains of finite points, which may not meet one another either. A chain of one point
 * that lies on an edge touches it as if it were an edge itself. `places`, one of each chain, may be
 * NULL, and says nothing if there is a defect. */
icc_status iccp_sweep_chains(iccp_defect *found, iccp_chain_place *places,
                             const iccp_chains *chains, const iccp_env *env);

#endif
