/* Cuts: paths along which both domains are cut open in the same way. */
#ifndef ICCP_CUTS_H
#define ICCP_CUTS_H

#include "map/isotopy/shorten.h"

/* A tree of paths that joins all components, or one tree for each part of the domain. In both
 * domains a cut joins the same two vertices and has the same number of bends. No cut crosses itself
 * or another cut. At each vertex the cuts leave in the same order between the same walls. */
typedef struct iccp_cuts {
    iccp_memory memory;
    size_t n;
    uint32_t *ends;     /* 2 n vertices */
    uint32_t *first;    /* n + 1: the first bend of each cut; bends are numbered from cut to cut */
    size_t room;        /* for bends */
    double *points[2];  /* 2 for each bend, in the source and in the target */
    double length[2];   /* of all cuts together */
    double straight[2]; /* of the straight lines between their ends */
} iccp_cuts;

/* The search for cuts. */
typedef struct iccp_cutter {
    iccp_memory memory;
    const iccp_domain_pair *domains;
    iccp_path_search search[2];
    struct iccp_candidate_cut *candidate; /* sorted by component */
    size_t *first;                        /* n_components + 1 */
    iccp_heap queue;
    iccp_found_path found[2];
} iccp_cutter;

icc_status iccp_cutter_create(iccp_cutter *cutter, const iccp_domain_pair *domains,
                              const iccp_env *env);
void iccp_cutter_free(iccp_cutter *cutter);

/* Finds short cuts as a minimum spanning tree of the components. The length of a cut is taken in
 * both domains together. Tree 0 uses the lengths as they are. Larger numbers give other trees, with
 * other weights of the two domains or with random factors. About n log n for each component. */
icc_status iccp_cuts_create(iccp_cuts *cuts, iccp_cutter *cutter, uint64_t tree,
                            const iccp_env *env);
void iccp_cuts_free(iccp_cuts *cuts);

/* Adds cuts one by one: makes room for n cuts, which the caller then adds in their order. `line`
 * has one polyline for each domain, from end to end. The polyline with fewer bends gets more
 * bends. */
icc_status iccp_cuts_begin(iccp_cuts *cuts, size_t n, const iccp_memory *memory);
icc_status iccp_cuts_add(iccp_cuts *cuts, size_t cut, const uint32_t ends[2],
                         iccp_polyline line[2]);

#endif
