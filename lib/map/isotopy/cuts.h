/* Paths along which two domains with features are cut open, alike. */
#ifndef ICCP_CUTS_H
#define ICCP_CUTS_H

#include "map/isotopy/taut.h"

/* A tree of paths that joins all components. In both domains each goes from one vertex to another
 * through as many bends; neither itself nor another one is crossed, and at each vertex they leave
 * in the same order between the same walls. */
typedef struct iccp_cuts {
    iccp_memory memory;
    size_t n;
    uint32_t *ends;     /* 2 n vertices */
    uint32_t *first;    /* n + 1: the bends of a cut, numbered through */
    size_t room;        /* for bends */
    double *points[2];  /* 2 for each bend, in the source and in the target */
    double length[2];   /* of all cuts, */
    double straight[2]; /* and of the straight lines between their ends */
} iccp_cuts;

/* What cuts are looked for with. */
typedef struct iccp_cutter {
    iccp_memory memory;
    const iccp_scene *scene;
    iccp_routes routes[2];
    struct iccp_candidate_cut *candidate; /* by component */
    size_t *first;                        /* n_components + 1 */
    iccp_heap queue;
    iccp_way way[2];
} iccp_cutter;

icc_status iccp_cutter_create(iccp_cutter *cutter, const iccp_scene *scene, const iccp_env *env);
void iccp_cutter_free(iccp_cutter *cutter);

/* Short cuts, by a minimum spanning tree of the components with the lengths of paths in both
 * domains taken together; tree 0, or with lengths that are changed at random for others. About n
 * log n for each component. */
icc_status iccp_cuts_create(iccp_cuts *cuts, iccp_cutter *cutter, uint64_t tree,
                            const iccp_env *env);
void iccp_cuts_free(iccp_cuts *cuts);

/* Cuts one by one: room for n of them, which are still to be added in their order. `line`: one for
 * each domain, from end to end; the one with fewer bends gets more. */
icc_status iccp_cuts_begin(iccp_cuts *cuts, size_t n, const iccp_memory *memory);
icc_status iccp_cuts_add(iccp_cuts *cuts, size_t cut, const uint32_t ends[2],
                         iccp_polyline line[2]);

#endif
