/* Ways to a first map of kind mesh in space, on one mesh. info->n_unrepaired is what one leaves. */
#ifndef ICCP_SOLID_WAYS_H
#define ICCP_SOLID_WAYS_H

#include "map/solid/solid_map.h"

/* From one chart to another. */
typedef struct iccp_direction {
    const icc_chart *source, *target;
} iccp_direction;

size_t iccp_solid_count_inverted(const iccp_solid_map *map);

/* Gives the map a mesh of its own, if it has none: a copy. */
icc_status iccp_solid_own(iccp_solid_map *map);

/* Puts a mesh and its images, which become the map's, in place of its own. */
void iccp_solid_take(iccp_solid_map *map, iccp_simplices *mesh, double *images);

/* On the source's mesh if that can be repaired, else without its chords. */
icc_status iccp_solid_fit(iccp_solid_map *map, iccp_direction way, icc_map_info *info,
                          const iccp_env *env);

/* On what iccp_solid_fit() has made of the mesh: from where images have been left, or anew from the
 * charts. */
icc_status iccp_solid_refit(iccp_solid_map *map, iccp_direction way, bool anew, icc_map_info *info,
                            const iccp_env *env);

/* Without the charts, anew on a mesh without chords: where a point sees all of the target's surface
 * from inside. Else the map is none, and what is told stays. */
icc_status iccp_solid_unfold(iccp_solid_map *map, iccp_direction way, icc_map_info *info,
                             const iccp_env *env);

#endif
