/* Makes a mesh map in the plane. */
#ifndef ICCP_PLANE_START_H
#define ICCP_PLANE_START_H

#include "map/plane/mesh_map.h"

/* Makes a map from two charts that were made together. Overlays replace the parts of the source
 * chart's mesh that the charts invert (overlay_patches.h, overlay_start.h). Fills in the mesh's
 * members of `info`. If an overlay would be too large, *out is NULL, with ICC_OK, and
 * info->n_unrepaired counts the inverted triangles. `iterations` as in icc_map_options. */
icc_status iccp_mesh_map_create(iccp_mesh_map **out, const icc_chart *source,
                                const icc_chart *target, int32_t iterations, iccp_map_facts *info,
                                const iccp_env *env, icc_error *err);

/* Makes a map between two domains with features, without charts. ICC_ERR_RESOLUTION if features are
 * too close for doubles. Otherwise like iccp_mesh_map_create(). */
icc_status iccp_mesh_map_create_features(iccp_mesh_map **out, const icc_domain *source,
                                         const icc_domain *target, const icc_map_options *options,
                                         iccp_map_facts *info, const iccp_env *env, icc_error *err);

#endif
