/* Making the images of all simplices of a map positive while its mesh stays. */
#ifndef ICCP_UNTANGLE_H
#define ICCP_UNTANGLE_H

#include "map/energy/simplicial_map.h"
#include "map/energy/work.h"

/* Round by round, patches and then everything, as far as that goes. `n_left` says how many
 * simplices are not positive in the end. */
icc_status iccp_untangle(const iccp_simplicial_map *map, iccp_work *work, size_t *n_left,
                         const iccp_env *env);

#endif
