/* Improves a mesh map in the plane. */
#ifndef ICCP_PLANE_IMPROVE_H
#define ICCP_PLANE_IMPROVE_H

#include "map/compatible/improve.h"
#include "map/plane/mesh_map.h"

/* Improves a map that has this energy, as far as the options ask. If it is cancelled, *cancelled is
 * true, the status is ICC_OK, and the map is as good as it has become. */
icc_status iccp_plane_improve(iccp_plmap *pl, double energy, const icc_improve_options *options,
                              const iccp_schedule *how, iccp_work *work, bool *cancelled,
                              iccp_improvement *improvement, const iccp_env *env);

/* Improves map->pl, which is one-to-one, and then calls iccp_mesh_map_finish(). */
icc_status iccp_plane_complete(iccp_mesh_map *map, const icc_improve_options *options,
                               const iccp_schedule *how, iccp_work *work, iccp_map_facts *info,
                               const iccp_env *env);

/* Keeps Newton's plan for maps that follow, if `mesh` is still the plan's. That is the mesh of the
 * map, or of the part that moved last. */
void iccp_plane_keep_plan(iccp_mesh_map *map, iccp_newton_plan *plan, const iccp_plmap *mesh);

/* Improves a copy of a map between domains of n_facets. See icc_map_improve(). */
icc_status iccp_mesh_map_improve(iccp_mesh_map **out, const iccp_mesh_map *map, size_t n_facets,
                                 const icc_improve_options *options, icc_improve_report *report,
                                 const iccp_env *env);

#endif
