/* Lowers the energy of a map of a mesh in space without losing its certificate. */
#ifndef ICCP_SOLID_IMPROVE_H
#define ICCP_SOLID_IMPROVE_H

#include "map/energy/refinement.h"
#include "map/solid/solid_map.h"

/* Fills in a copy with a mesh of its own, but without the search structure for points. `copy` must
 * be 0 except for its memory and stretch. */
icc_status iccp_solid_copy(iccp_solid_map *copy, const iccp_solid_map *map);

/* Changes the mesh where this lowers the energy. It flips, and with `cuts` it also cuts chords and
 * the longest edges of the worst fifth. If this does not help, the map does not change and
 * `n_changes` is 0. */
icc_status iccp_solid_refine(iccp_solid_map *map, const icc_domain *source, bool cuts,
                             size_t *n_changes, const iccp_env *env);

/* Improves a map as iccp_improve() does. All its tetrahedra must be positive, and its mesh fills
 * `source`. Levels change the mesh inside, which then belongs to the map. The surface does not
 * change. After any failure, also after ICC_ERR_CANCELLED, the map is valid and no worse than
 * before. */
icc_status iccp_solid_improve(iccp_solid_map *map, const icc_domain *source,
                              const iccp_schedule *schedule, iccp_work *work,
                              iccp_improvement *improvement, const iccp_env *env);

#endif
