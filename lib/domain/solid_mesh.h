/* Makes domains with meshes that conform to the features of a solid. */
#ifndef ICCP_SOLID_MESH_H
#define ICCP_SOLID_MESH_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* Makes a domain with the boundary and the features of `solid` (solid_domain.h), bit for bit, and
 * with a mesh of its inside. Takes over the mesh, also if it fails. The caller fills in memory,
 * dim, n_points, points, n_simplices, corners, n_on_lines and on_line; everything else is 0. The
 * first points are all vertices of the solid, in local coordinates. The others are inner points.
 *
 * Fills in the rest, including the region of each simplex. Corners are checked and never exchanged.
 * Returns ICC_ERR_CERTIFICATE or ICC_ERR_BOUNDARY unless, exactly,
 * - every point belongs to a simplex, and all simplices are positive
 * - the faces with one simplex are the facets of the boundary, and all others have two simplices on
 *   opposite sides
 * - each facet of a region is a face between the regions that features->sides names, and all other
 *   inner faces lie within one region
 * - each segment of a line is a chain of edges of the mesh. The points on it, in the order of
 *   on_line[], have rising shares and are where iccp_frame_between() puts them.
 * So the mesh fills the solid and does not overlap, whatever its handles and voids. */
icc_status iccp_domain_create_solid_mesh(icc_domain **out, const icc_domain *solid,
                                         iccp_simplices *mesh, const iccp_env *env, icc_error *err);

/* Checks a mesh in the same way and fills in the rest anew, for a mesh whose simplices have
 * changed. The caller keeps it, also if it fails. */
icc_status iccp_solid_mesh_check(const icc_domain *solid, iccp_simplices *mesh, const iccp_env *env,
                                 icc_error *err);

#endif
