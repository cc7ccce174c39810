/* Making a map of a mesh in space fairer without losing its certificate. */
#ifndef ICCP_SOLID_IMPROVE_H
#define ICCP_SOLID_IMPROVE_H

#include "map/compatible/improve.h"
#include "map/solid/solid_map.h"

/* Fills in a map that is all 0 but for its memory and stretch: with a mesh of its own, and without
 * what finds points. */
icc_status iccp_solid_copy(iccp_solid_map *copy, const iccp_solid_map *map);

/* Changes the mesh where the energy falls for it: flips, and with `cuts` edges inside from boundary
 * to boundary and the longest ones of the worst fifth are cut in between. Leaves the map alone when
 * that is in vain; `n_changes` is then 0. */
icc_status iccp_solid_refine(iccp_solid_map *map, const icc_domain *source, bool cuts,
                             size_t *n_changes, const iccp_env *env);

/* As iccp_improve(), for a map all of whose tetrahedra are positive, of a mesh of the domain
 * `source`. Levels change the mesh inside, so that it becomes one of the map's own; the surface
 * stays as it is. On any failure, ICC_ERR_CANCELLED included, the map is valid and no worse than
 * before. */
icc_status iccp_solid_improve(iccp_solid_map *map, const icc_domain *source,
                              const iccp_schedule *schedule, iccp_work *work,
                              iccp_improvement *improvement, const iccp_env *env);

#endif
