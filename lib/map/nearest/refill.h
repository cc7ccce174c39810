/* Maps a region of a plane map anew. */
#ifndef ICCP_REFILL_H
#define ICCP_REFILL_H

#include "map/energy/work.h"
#include "map/nearest/adopt.h"
#include "map/nearest/regions.h"
#include "mesh/edge_set.h"

/* A one-to-one map of a region: with the rim, the held vertices and the held edges where they are,
 * and with all vertices that the region had. */
typedef struct iccp_refill {
    iccp_plmap map;     /* empty if rounding spoils every map that was tried */
    uint32_t *vertex;   /* of each vertex of `map`: the vertex of the whole, or UINT32_MAX: new */
    iccp_edge_set held; /* edges of `map` */
    double vain;        /* work on attempts that led to no map */
} iccp_refill;

/* Maps the region inside a rim anew. `whole` is the map that the rim belongs to. `given` finds
 * points in it, and place[v] is the place of an inner vertex among those of the rim that are not
 * held. `vain` limits the work on attempts that lead to no map. */
icc_status iccp_refill_create(iccp_refill *refill, const iccp_rim *rim, const iccp_plmap *whole,
                              const iccp_finder *given, const uint32_t *place,
                              const iccp_work *vain, const iccp_env *env);
void iccp_refill_free(iccp_refill *refill);

#endif
