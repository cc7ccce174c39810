/* Making a mesh map in the plane. */
#ifndef ICCP_PLANE_START_H
#define ICCP_PLANE_START_H

#include "map/plane/mesh_map.h"

/* Starts from two charts that were made together: from their images of the source chart's mesh if
 * no triangle is inverted, otherwise from the overlay of two triangulations of the domains
 * (map/compatible/overlay_start.h). Fills in the mesh's members of `info`. If the overlay would be
 * too large, *out is NULL, with ICC_OK, and info->n_unrepaired counts the charts' inverted
 * triangles. `iterations` as in icc_map_options. */
icc_status iccp_mesh_map_create(iccp_mesh_map **out, const icc_chart *source,
                                const icc_chart *target, int32_t iterations, icc_map_info *info,
                                const iccp_env *env, icc_error *err);

/* Between two domains with features that correspond, without charts. ICC_ERR_RESOLUTION when
 * features are too close for doubles. Otherwise as above. */
icc_status iccp_mesh_map_create_features(iccp_mesh_map **out, const icc_domain *source,
                                         const icc_domain *target, const icc_map_options *options,
                                         icc_map_info *info, const iccp_env *env, icc_error *err);

#endif
