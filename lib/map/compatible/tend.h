/* Keeping the mesh of a map fit while what it holds fixed moves. */
#ifndef ICCP_TEND_H
#define ICCP_TEND_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* How fine a mesh should be. */
typedef struct iccp_grain {
    double longest; /* no edge becomes longer than this, or much shorter */
    size_t many;    /* triangles: with more of them, vertices merge */
} iccp_grain;

/* Where triangles carry far more energy than others, cuts and flips edges and moves points and
 * images; elsewhere merges vertices. `room`: how many motions like the last one would fit in before
 * the first triangle flips. Does nothing while that is enough, unless a triangle is all too tense.
 * All triangles are positive before and after the map, which they stay, exactly. O(n) but for steps
 * near tense triangles. */
icc_status iccp_tend(iccp_plmap *map, const iccp_grain *grain, double room, iccp_work *work,
                     const iccp_env *env);

#endif
