/* Chains of a network, and how their vertices slide along them.
 *
 * Words of this folder
 * - stop: a node that never slides. It is a node where more or fewer than two sides meet, an end of
 *   a line, or a lone point. A closed chain without such a node has one stop, where it begins.
 * - chain: the sides of a network from one stop to the next.
 * - corner: a node of the chain. The source and the target of a map have the same corners.
 * - knot: a pair of places on a chain, before and after the map. Between knots a chain is mapped
 *   linearly. So each corner of the source is a knot, whose image may lie anywhere on the target's
 *   chain. Each corner of the target is a knot as well.
 * - slide: the knots of all chains, in order. From knot to knot, places move on strictly, before
 *   the map and after it.
 * - added vertex: a knot that is a corner on one side only.
 *
 * A map whose chains slide is an ordinary map between two larger domains: those that the caller
 * gave, with added vertices on their sides. So the certificate, improvement, isotopy and everything
 * else stay as they are. If the mesh itself held two places for each vertex on a chain, all of
 * these would have to know. And no corner could pass another without changing the mesh.
 *
 * Ways
 * - knots.h makes slides and reads and writes them, added_vertices.h makes the domains,
 *   slide_step.h proposes a better slide from a map, with merge_corners.h.
 * - sliding.c asks for proposals and makes the maps. It keeps the best of them.
 *
 * Begin with knots.h. */
#ifndef ICCP_CHAINS_H
#define ICCP_CHAINS_H

#include "domain/network.h"

typedef struct iccp_chains {
    iccp_memory memory;
    size_t n;
    size_t *first;   /* n + 1: where the sides of each chain begin in `half` */
    uint32_t *half;  /* the half-sides (domain/network.h) of all chains, along them */
    uint32_t *chain; /* by facet of a side: its chain */
    uint32_t *order; /* by facet of a side: its position in `half` */
} iccp_chains;

/* Finds the chains of a domain with features. All sides belong to one. They are numbered alike in
 * domains that correspond. O(n). */
icc_status iccp_chains_create(iccp_chains *chains, const icc_domain *domain,
                              const iccp_memory *memory);
void iccp_chains_free(iccp_chains *chains);

#endif
