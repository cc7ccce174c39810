/* Fills closed surfaces with tetrahedra, and makes them domains.
 *
 * Words of this folder. Begin with fill_domain.c, which lists the stages, then tets.h.
 * - given points: the vertices of the surface. A box around them contains all tetrahedra at first.
 * - segment, facet: an edge and a triangle of the surface (constraints.h).
 * - recover: to change the mesh until a segment or facet is made of its edges or faces (segments.h,
 *   facets.h).
 * - obstacles: the faces that a missing edge crosses (obstacles.h).
 * - dyadic point: a point exactly on a segment or facet, with shares that are multiples of 2^-48
 *   (points.h).
 * - wall: a side of a tetrahedron on the surface.
 * - lift: to move a point from the surface to the inside (lift.h).
 * - star, ring, link: tetrahedra at a point, those around an edge, and the points opposite to it.
 * - cavity, rim: tetrahedra that a new point replaces, and the boundary of their space (insert.h).
 * - clean up: contract and smooth inner points (reshape.h, contract.h).
 * - refine: add inner points (inner_points.h). improve: flip and smooth (reshape.h,
 *   place_search.h), and split nearly flat tetrahedra (slivers.h).
 * - metric: a linear map in which a stretched surface has the same extent in all directions
 *   (metric.h).
 *
 * Ways, in the order of fill_domain.c
 * - insert.h for the vertices. segments.h for edges, by flip.h, then points on them (split.c).
 * - facets.h for facets, and to remove the outside. facet_scan.h finds what pierces a facet.
 * - lift.h, with lifting.h for the facets of one point. reshape.h cleans up, inner_points.h
 *   refines, reshape.h improves, by flip.h and slivers.h; quality.h says what is better.
 * - Exact signs of dyadic points: fixed.h.
 *
 * Invariants: every tetrahedron is positive by exact signs after every step. A step that fails
 * changes nothing. */
#ifndef ICCP_FILL_DOMAIN_H
#define ICCP_FILL_DOMAIN_H

#include "domain/domain.h"
#include "fill/fill_options.h"

/* See icc_domain_fill(). Arguments have been checked. */
icc_status iccp_domain_fill(icc_domain **out, const icc_domain *surface,
                            const iccp_fill_options *options, const iccp_env *env, icc_error *err);

/* Fills a surface with the default ratio, for a map. */
icc_status iccp_domain_fill_for_map(icc_domain **out, const icc_domain *surface,
                                    const iccp_env *env, icc_error *err);

#endif
