/* The network of a domain with features: a plane graph of nodes and sides.
 *
 * Features may share vertices with each other and with the outer ring, and may run along the same
 * segment. The network counts each place and each segment once.
 * - node: a place with a vertex. Its number is that of the smallest vertex there.
 * - side: a segment between two nodes. Its number is that of the smallest facet there.
 * - half-side: a side with a direction. 2 f runs the way of facet f, 2 f + 1 the other way.
 * - piece: nodes that sides connect. A node without sides is a piece by itself.
 * - face: a part of the domain that no side divides. Pieces inside a face may make holes in it.
 * - walk: half-sides one after another with the same face on their left. Each piece has one walk
 *   in each face that it bounds.
 * - rim: the sides with the domain on one side only.
 *
 * A place belongs to the domain if it lies in more of the outer ring and regions than of holes. */
#ifndef ICCP_NETWORK_H
#define ICCP_NETWORK_H

#include "domain/features.h"
#include "geometry/defect.h"

/* Instead of a face: outside the domain. */
#define ICCP_NO_FACE UINT32_MAX

/* Instead of a walk: outside everything. */
#define ICCP_NO_WALK UINT32_MAX

typedef struct iccp_network {
    size_t n_nodes, n_sides, n_rim, n_pieces, n_faces;
    size_t n_junctions; /* nodes with 3 or more sides */
    uint32_t *node;     /* by vertex */
    uint32_t *side;     /* by facet; of a point's facet: the smallest at that node */
    uint32_t *first;    /* n_vertices + 1: where half-sides that leave a node begin */
    uint32_t *leaving;  /* 2 n_sides half-sides, counter-clockwise around each node */
    uint32_t *slot;     /* by half-side: its position in `leaving` */
    uint32_t *piece;    /* by vertex: 0 .. n_pieces - 1, in the order of their smallest vertices */
    /* By half-side: the face on its left, numbered by smallest half-sides, or ICCP_NO_FACE. Both
     * half-sides of the smallest facet of a node without sides have the face around it. */
    uint32_t *face;
    /* By half-side, like `face`: the walk around the face on its left, also outside the domain. Its
     * smallest half-side tells the walk. ICCP_NO_WALK: outside everything. */
    uint32_t *around;
    /* By vertex: a half-side that leaves its node, of the smallest side. For a node without sides,
     * 2 f of its smallest facet. */
    uint32_t *place;
} iccp_network;

/* Makes the network of a domain whose local vertices, facets and features are there, and fills in
 * the orientations of its rings. If `found` has a kind, there is a defect and *out is NULL:
 * - ICC_DEFECT_REPEATED: vertices a < b coincide, but follow each other or belong to one ring;
 * - ICC_DEFECT_CROSSING, ICC_DEFECT_TOUCH: facets a < b have more in common than a node. A point's
 *   facet lies on another one. Or both belong to one feature, or to two rings, and neither is a
 *   region, and they join the same nodes. */
icc_status iccp_network_create(iccp_network **out, iccp_defect *found, icc_domain *domain,
                               const iccp_env *env);
void iccp_network_free(iccp_network *network, const iccp_memory *memory);

/* Returns the network of a domain, or NULL if it has no features. */
static inline const iccp_network *iccp_network_of(const icc_domain *domain)
{
    return domain->features != NULL ? domain->features->network : NULL;
}

/* Returns the feature that a facet belongs to, or UINT32_MAX for the outer ring. */
static inline uint32_t iccp_feature_of_facet(const icc_domain *domain, uint32_t facet)
{
    return iccp_feature_of_vertex(domain->features, domain->facets[2 * (size_t)facet]);
}

/* Returns true if a facet is the smallest one that joins two nodes. */
static inline bool iccp_network_is_side(const iccp_network *network, const icc_domain *domain,
                                        uint32_t facet)
{
    return network->side[facet] == facet &&
           domain->facets[2 * (size_t)facet] != domain->facets[2 * (size_t)facet + 1];
}

/* Returns the number of sides at a node. */
static inline uint32_t iccp_network_degree(const iccp_network *network, uint32_t node)
{
    return network->first[node + 1] - network->first[node];
}

/* Returns the node that a half-side leaves. The node that it leads to is that of h ^ 1. */
static inline uint32_t iccp_network_origin(const iccp_network *network, const icc_domain *domain,
                                           uint32_t h)
{
    return network->node[domain->facets[h]];
}

/* Returns the half-side that follows on the walk of h: around the face on its left. */
static inline uint32_t iccp_network_next(const iccp_network *network, const icc_domain *domain,
                                         uint32_t h)
{
    const uint32_t node = iccp_network_origin(network, domain, h ^ 1);
    const uint32_t slot = network->slot[h ^ 1];
    const uint32_t at = slot > network->first[node] ? slot : network->first[node + 1];
    return network->leaving[at - 1];
}

/* Returns true if a facet is a side of the rim. Other facets in the same place are not. */
static inline bool iccp_network_is_rim(const iccp_network *network, uint32_t facet)
{
    return network->side[facet] == facet &&
           (network->face[2 * (size_t)facet] == ICCP_NO_FACE) !=
               (network->face[2 * (size_t)facet + 1] == ICCP_NO_FACE);
}

/* Returns the half-side after h on the rim. Both have the domain on their left, but nothing of it
 * on their right. So the domain lies between them where they meet. */
uint32_t iccp_network_next_on_rim(const iccp_network *network, const icc_domain *domain,
                                  uint32_t h);

/* Finds the side that joins two nodes. Returns false if there is none. O(smaller degree). */
bool iccp_network_side(const iccp_network *network, const icc_domain *domain, uint32_t node_a,
                       uint32_t node_b, uint32_t *side);

#endif
