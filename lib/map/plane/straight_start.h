/* A start for maps of domains with features in which no edge has a bend. */
#ifndef ICCP_STRAIGHT_START_H
#define ICCP_STRAIGHT_START_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"
#include "map/isotopy/cuts.h"

/* Looks for edges between the vertices of the domains that are straight on both sides and leave
 * only triangles and small polygons, and maps these one-to-one, exactly. Then *found is true, and
 * `tree` has cuts along such edges, by which the class of the map is known. As a rule, there are
 * such edges if features move little. If none are found, *found is false, with ICC_OK. The caller
 * frees `map` and `tree` in any case. O(n log n). */
icc_status iccp_straight_start(iccp_plmap *map, iccp_cuts *tree, bool *found,
                               const iccp_domain_pair *domains, iccp_work *work,
                               const iccp_env *env);

#endif
