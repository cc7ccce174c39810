/* The certificate that a piecewise linear map in the plane is one-to-one. */
#ifndef ICCP_PLANE_CERTIFICATE_H
#define ICCP_PLANE_CERTIFICATE_H

#include "map/plane/mesh_map.h"

/* Returns ICC_ERR_CERTIFICATE unless three conditions hold:
 * - Every triangle is exactly positive before and after the map.
 * - The mesh is a disc with a hole for each ring but one.
 * - Before and after the map, the boundary's rings are simple and bound one region
 *   (domain/outlines.h). */
icc_status iccp_plmap_certify(const iccp_plmap *map, const iccp_env *env, icc_error *err);

/* See iccp_map_kind. */
icc_status iccp_plane_certify(icc_map *map, const iccp_env *env, icc_error *err);

#endif
