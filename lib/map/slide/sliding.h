/* Lets the chains of a map's features slide (map/slide/chains.h). */
#ifndef ICCP_SLIDING_H
#define ICCP_SLIDING_H

#include "map/map.h"
#include "map/slide/knots.h"

/* Makes a map between two domains with features. */
typedef icc_status (*iccp_map_maker)(icc_map **out, const icc_domain *source,
                                     const icc_domain *target, const icc_map_options *options,
                                     const iccp_env *env, icc_error *err);

/* Makes a map without sliding, and then others whose chains slide. Returns the one of least
 * energy. */
icc_status iccp_map_create_sliding(icc_map **out, const icc_domain *source,
                                   const icc_domain *target, const icc_map_options *options,
                                   iccp_map_maker maker, const iccp_env *env, icc_error *err);

/* Hands a slide over to a map between the domains with its knots. The map then owns it. */
void iccp_map_set_slide(icc_map *map, iccp_slide *slide);

/* Gives `next` a copy of the slide of `map`, if there is one. `target`: the target that the caller
 * gave, or NULL if it is that of `map`. */
icc_status iccp_map_keep_slide(icc_map *next, const icc_map *map, const icc_domain *target);

/* Gives the ends of a tie the numbers of the caller's vertices. Returns ICC_ERR_UNSUPPORTED if one
 * of them has slid, so that no vertex is there both before and after the map. */
icc_status iccp_slide_given_tie(const iccp_slide *slide, icc_tie_info *info);

#endif
