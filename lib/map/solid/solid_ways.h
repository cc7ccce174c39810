/* Strategies for a first map of kind mesh in space, on one mesh. Each sets info->n_unrepaired to
 * the number of tetrahedra left inverted. */
#ifndef ICCP_SOLID_WAYS_H
#define ICCP_SOLID_WAYS_H

#include "map/solid/solid_map.h"

/* A pair of domains, from the one to the other. The first has a mesh. */
typedef struct iccp_direction {
    const icc_domain *source, *target;
} iccp_direction;

size_t iccp_solid_count_inverted(const iccp_solid_map *map);

/* Gives the map a copy of its mesh as its own, if it has none. */
icc_status iccp_solid_own(iccp_solid_map *map);

/* Replaces the map's own mesh and images by others, which the map then owns. */
void iccp_solid_take(iccp_solid_map *map, iccp_simplices *mesh, double *images);

/* Maps a mesh on one side. Sets info->n_unrepaired, unless it does not apply to this pair. */
typedef icc_status iccp_solid_strategy(iccp_solid_map *map, iccp_direction way,
                                       iccp_map_facts *info, const iccp_env *env);

/* Repairs harmonic images of the source's mesh. If that fails, it uses a mesh without chords. */
iccp_solid_strategy iccp_solid_fit;

#endif
