/* A closed surface of triangles. It shrinks by collapses of edges and grows when these are undone.
 *
 * Half-edge 3 f + i has the number of a corner and runs from it to the next corner. A collapse does
 * not change the entries of the two faces that it removes. So these entries are enough to undo it:
 * D. E. Knuth, Dancing Links, 2000. If collapses are undone in reverse order, the surface is the
 * same as before, number by number.
 *
 * Words of this folder, and of lib/match/sphere and lib/match/common_mesh
 * - present: a vertex or face that no collapse has removed.
 * - drawing: a direction for each vertex of a surface, so that its faces become triangles on the
 *   sphere.
 * - star: the faces around a vertex. ring: the polygon of its neighbours.
 * - certified: shown to be one-to-one by exact signs (sphere/sphere_certificate.h).
 * - landmark: a pair of vertices, one on each surface, that must come to the same direction.
 * - overlay: the surface of all pieces that the faces of two drawings have in common.
 * - common surface: one mesh with two places for each vertex, one on each surface.
 *
 * Invariants
 * - Every face of a drawing is positive at all times, and each vertex's neighbours turn once around
 *   it.
 * - Exact signs decide (direction.h, perturbed.h), so results are the same on every machine.
 *
 * Ways
 * - One surface: sphere/sphere.h draws it. Two: rotation.h turns one drawing, relax.h moves both.
 * - With landmarks: landmark_sphere.h, which begins with a base of few triangles (landmark_base.h).
 * - Equal surfaces: equal_surfaces.h. Then common_mesh/sphere_overlay.h makes common triangles.
 * - common_mesh/simplify_apart.h removes vertices that are not needed.
 * - Drawing, in sphere/: sphere.h shrinks by decimate.h and grows, by the stars of drawn_star.h,
 *   within kernel_room.h. relax.h moves by composed_star.h; sphere_pair.c joins what is left.
 * - Landmarks, in sphere/: landmark_paths.h joins them (landmark_web.h, on a split_surface.h).
 *   landmark_guesses.h and likely_pairs.h add pairs where there are few.
 * - Overlay, in common_mesh/: arc_walk.h walks edges, paired_crossings.h and shared_vertices.h
 *   compare, overlay_darts.h orders the pieces, common_surface.h is the result.
 * - Simplification, in common_mesh/: simplify.h collapses edges, as far as kept_cells.h allows.
 *   optimise_shape.h also flips and moves; shape_patch.h asks covering.h for distances and
 *   clearance.h for contact. intersections.h finds what meets.
 * - Measures: stretch.h, corner_angle.h. Back to the surface: drawn_place.h, sphere/drawn_finder.h.
 *
 * Begin with ../surfaces.c and ../sphere_pair.c. */
#ifndef ICCP_HALF_EDGES_H
#define ICCP_HALF_EDGES_H

#include "base/env.h"
#include "base/triangle_corners.h"

#include <stdbool.h>

#define ICCP_NO_EDGE UINT32_MAX

/* The most neighbours of a vertex that another is merged into. */
enum { ICCP_MERGED_NEIGHBOURS = 18 };

typedef struct iccp_half_edges {
    iccp_memory memory;
    size_t n_vertices, n_faces; /* of the whole surface */
    size_t n_left;              /* vertices present */
    size_t n_collapsed;
    size_t most_neighbours; /* the most that any vertex has had */
    uint32_t *collapsed;    /* half-edges, in the order of their collapses */
    uint32_t *origin;       /* 3 n_faces: the vertex where a half-edge starts */
    uint32_t *twin;         /* 3 n_faces: the same edge in the other direction */
    uint32_t *out;          /* n_vertices: a half-edge that starts at it; ICCP_NO_EDGE if it is
                               not present */
    uint32_t *degree;       /* n_vertices: number of its half-edges; 0 if it is not present */
} iccp_half_edges;

/* The vertex where a half-edge ends. */
static inline uint32_t iccp_edge_end(const iccp_half_edges *m, uint32_t h)
{
    return m->origin[iccp_after(h)];
}

/* The next half-edge that starts at the same vertex, counter-clockwise. */
static inline uint32_t iccp_edge_turn(const iccp_half_edges *m, uint32_t h)
{
    return m->twin[iccp_before(h)];
}

/* Makes the half edges of a closed, connected surface, on which the faces at each vertex form one
 * ring. Vertices without faces are not present. ICC_ERR_BOUNDARY or ICC_ERR_MEMORY. Free it in any
 * case. */
icc_status iccp_half_edges_create(iccp_half_edges *m, size_t n_vertices, size_t n_faces,
                                  const uint32_t *faces, const iccp_env *env, icc_error *err);
void iccp_half_edges_free(iccp_half_edges *m);

bool iccp_are_neighbours(const iccp_half_edges *m, uint32_t a, uint32_t b);

/* Returns true if the half-edge's origin may be merged into its end. Then no two vertices are
 * joined twice, and at least four vertices are left. Linear in the origin's degree, unless both
 * ends have neighbours with many neighbours. */
bool iccp_edge_collapsible(const iccp_half_edges *m, uint32_t h);

/* Removes the origin of a collapsible half-edge. Its other neighbours are then joined to the end.
 * O(its degree). */
void iccp_edge_collapse(iccp_half_edges *m, uint32_t h);

/* Replaces an edge by the edge between the two corners that face it. Both ends must have more than
 * three neighbours, and the corners must not be neighbours yet. Collapses made before can no longer
 * be undone. */
void iccp_edge_flip(iccp_half_edges *m, uint32_t h);

/* Undoes the last collapse. Returns the vertex that is present again. O(its degree). */
uint32_t iccp_edge_restore(iccp_half_edges *m);

#endif
