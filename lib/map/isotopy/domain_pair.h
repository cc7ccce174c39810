/* Two domains whose features correspond, each triangulated by its own vertices and walls.
 *
 * Words of this folder
 * - component: a piece of the network (domain/network.h): rings, lines and points that hang
 *   together.
 * - wall: a side of the network, so an edge of a ring or a segment of a line. No path crosses a
 *   wall.
 * - bare triangulation: the triangulation of a domain that has no vertices but the domain's nodes.
 * - cut: a pair of corresponding paths, one in each domain, that joins two components.
 * - tie: the public name (icc_tie) of a cut that the caller gives or reads.
 * - crossing: the place where a path crosses an edge of the bare triangulation.
 * - sequence: the edges that a path crosses, in order. It is the path's isotopy class.
 * - class: two maps are in one class if one can be moved to the other while it stays one-to-one.
 *
 * Invariants
 * - The cuts form a tree that joins all components, or one tree for each part of the domain. So
 *   cutting a domain open along walls and cuts leaves one polygon for each face.
 * - Vertices that are not nodes of the network lie where a node lies. Nothing uses them.
 * - Both domains' cuts leave each vertex in the same order, between the same walls.
 * - Predicates decide on which side a path passes a vertex, so classes are exact.
 *
 * Ways
 * - Without ties: cuts.h chooses cuts, path_search.h finds their paths, shorten.h draws them.
 * - With ties: ties.h reads the caller's cuts.
 * - Map to class: isotopy.h, by crossing_sequence.h. After a motion: sequence_motion.h.
 * - From cuts to a map: cut_polygon.h opens a domain, map/compatible/overlay.h overlays the two
 *   polygons of each face, close_cuts.h closes them (called by map/plane/feature_start.c).
 * - A drawing of paths that are only known by what they cross: draw_crossings.h.
 *
 * Begin with cuts.h and isotopy.h. docs/theory/features.md explains the method. */
#ifndef ICCP_DOMAIN_PAIR_H
#define ICCP_DOMAIN_PAIR_H

#include "domain/network.h"
#include "mesh/corners.h"

/* Vertices are those of the domains. Components are numbered as the pieces of the network. */
typedef struct iccp_domain_pair {
    iccp_memory memory;
    const icc_domain *domain[2]; /* source, target */
    size_t n;                    /* vertices */
    size_t n_components, n_walls, n_rim;
    size_t n_cuts; /* that join the components: one for each but the first of each part */
    const iccp_network *network; /* of the source, which lends the next two arrays */
    const uint32_t *node;        /* of each vertex: the node in the same place */
    const uint32_t *component;   /* of each vertex */
    uint32_t *part;  /* of each component: the smallest component in its part of the domain */
    uint32_t *pairs; /* 2 n_walls nodes: the n_rim sides of the rim, then the others */
    iccp_walls walls;
    iccp_corners mesh[2]; /* the bare triangulations, constrained Delaunay; twins join triangles
                             across sides inside, not across the rim */
    double scale;         /* multiplies lengths in the target to compare them with lengths in the
                             source */
} iccp_domain_pair;

icc_status iccp_domain_pair_create(iccp_domain_pair *domains, const icc_domain *source,
                                   const icc_domain *target, const iccp_env *env);
void iccp_domain_pair_free(iccp_domain_pair *domains);

/* The constrained Delaunay triangulation of the inside of one domain. The first of the n points are
 * the domain's vertices. `pairs` has n_walls walls, which begin with the domain's own. The caller
 * frees the arrays of `mesh`. */
icc_status iccp_triangulate_inside(iccp_corners *mesh, const iccp_domain_pair *domains, size_t n,
                                   const double *points, size_t n_walls, const uint32_t *pairs,
                                   const iccp_env *env);

#endif
