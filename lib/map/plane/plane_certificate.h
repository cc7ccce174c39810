/* The certificate that a piecewise linear map in the plane is one-to-one. */
#ifndef ICCP_PLANE_CERTIFICATE_H
#define ICCP_PLANE_CERTIFICATE_H

#include "map/plane/mesh_map.h"

/* Returns ICC_ERR_CERTIFICATE unless these conditions hold:
 * - Every triangle is exactly positive before and after the map.
 * - Before and after the map, the boundary of the mesh bounds a region on its left.
 * - Without features, the boundary's rings touch nowhere, and the mesh is a disc with a hole for
 *   each ring but one.
 *
 * So the map is one-to-one on the region that the mesh covers. */
icc_status iccp_plmap_certify(const iccp_plmap *map, const iccp_env *env, icc_error *err);

/* See iccp_map_kind. With features, the mesh must also follow the network of the source, and so
 * covers exactly the two domains (map/compatible/network_rows.h). */
icc_status iccp_plane_certify(icc_map *map, const iccp_env *env, icc_error *err);

#endif
