/* Adds the knots of a slide to the sides of the domains as vertices. */
#ifndef ICCP_ADDED_VERTICES_H
#define ICCP_ADDED_VERTICES_H

#include "map/slide/knots.h"

/* How the vertices of the larger domains are numbered. Source and target are numbered alike. */
typedef struct iccp_added_vertices {
    iccp_memory memory;
    size_t n;
    size_t *count;  /* numbers of vertices: of the outer ring, and then of each feature */
    uint32_t *knot; /* of each vertex: its knot, or UINT32_MAX for a lone point */
    /* The edge from each vertex to the next one of its feature. 2 k is the edge from knot k to
     * knot k + 1, and 2 k + 1 is the same edge backwards. UINT32_MAX if there is no edge */
    uint32_t *after;
    uint32_t *vertex; /* of each vertex of the given domains: its new number */
} iccp_added_vertices;

icc_status iccp_added_vertices_create(iccp_added_vertices *added, const iccp_slide *slide,
                                      const iccp_memory *memory);
void iccp_added_vertices_free(iccp_added_vertices *added);

/* Returns the local coordinates of a knot in the given source (side 0) or target. */
void iccp_knot_place(const iccp_slide *slide, size_t chain, const iccp_knot *knot, int side,
                     double place[2]);

/* Makes the source (side 0) or target (side 1) with the knots as vertices. Added vertices lie on
 * their sides up to rounding. Fails if rounding makes sides meet. */
icc_status iccp_domain_with_knots(icc_domain **out, const iccp_slide *slide, int side,
                                  const iccp_env *env, icc_error *err);

#endif
