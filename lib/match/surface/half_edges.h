/* A closed surface of triangles that shrinks by collapses of edges and grows again by taking them
 * back.
 *
 * Half-edge 3 f + i, which has the number of a corner, runs from it to the next one. A collapse
 * changes none of the entries of the two faces that it takes away, so that they are all that is
 * needed to take it back: D. E. Knuth, Dancing Links, 2000. Taken back in reverse order the surface
 * is what it was, number by number. */
#ifndef ICCP_HALF_EDGES_H
#define ICCP_HALF_EDGES_H

#include "base/env.h"
#include "base/triangle_corners.h"

#include <stdbool.h>

#define ICCP_NO_EDGE UINT32_MAX

typedef struct iccp_half_edges {
    iccp_memory memory;
    size_t n_vertices, n_faces; /* of the whole surface */
    size_t n_left;              /* vertices that are there now */
    size_t n_collapsed;
    size_t most_neighbours; /* that a vertex has had so far */
    uint32_t *collapsed;    /* half-edges, the first collapse first */
    uint32_t *origin;       /* 3 n_faces: the vertex that a half-edge comes from */
    uint32_t *twin;         /* 3 n_faces: the same edge the other way */
    uint32_t *out;          /* n_vertices: one half-edge from it; ICCP_NO_EDGE: it is not there */
    uint32_t *degree;       /* n_vertices: half-edges from it; 0: it is not there */
} iccp_half_edges;

/* The vertex that it runs to. */
static inline uint32_t iccp_edge_end(const iccp_half_edges *m, uint32_t h)
{
    return m->origin[iccp_after(h)];
}

/* The next half-edge from the same vertex, counter-clockwise. */
static inline uint32_t iccp_edge_turn(const iccp_half_edges *m, uint32_t h)
{
    return m->twin[iccp_before(h)];
}

/* Faces of a closed surface of one piece, on which those at a vertex form one ring; vertices
 * without faces are not there. ICC_ERR_BOUNDARY or ICC_ERR_MEMORY; to be freed in either case. */
icc_status iccp_half_edges_create(iccp_half_edges *m, size_t n_vertices, size_t n_faces,
                                  const uint32_t *faces, const iccp_env *env, icc_error *err);
void iccp_half_edges_free(iccp_half_edges *m);

bool iccp_are_neighbours(const iccp_half_edges *m, uint32_t a, uint32_t b);

/* Whether the origin of a half-edge may become its end: no other edge would then join the same two
 * vertices twice, and at least four vertices are left. O(degree of the origin) but where both it
 * and its end have neighbours with many neighbours. */
bool iccp_edge_collapsible(const iccp_half_edges *m, uint32_t h);

/* Takes the origin of a half-edge that is collapsible away: what it was joined to is joined to the
 * end. O(its degree). */
void iccp_edge_collapse(iccp_half_edges *m, uint32_t h);

/* Joins the two corners across an edge in place of its ends, which have more than three neighbours
 * each; the corners are no neighbours yet. What was collapsed before cannot be taken back then. */
void iccp_edge_flip(iccp_half_edges *m, uint32_t h);

/* Takes the last collapse back; the vertex that is there again. O(its degree). */
uint32_t iccp_edge_restore(iccp_half_edges *m);

#endif
