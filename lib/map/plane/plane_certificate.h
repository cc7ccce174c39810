/* The certificate that a piecewise linear map in the plane is one-to-one. */
#ifndef ICCP_PLANE_CERTIFICATE_H
#define ICCP_PLANE_CERTIFICATE_H

#include "map/plane/mesh_map.h"

/* ICC_ERR_CERTIFICATE unless every triangle is positive before and after the map, exactly, the mesh
 * is a disc, and its boundary is one polygon that is simple before and after. */
icc_status iccp_plmap_certify(const iccp_plmap *map, const iccp_env *env, icc_error *err);

/* See iccp_map_kind. */
icc_status iccp_plane_certify(icc_map *map, const iccp_env *env, icc_error *err);

#endif
