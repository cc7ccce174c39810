/* Makes any plane map one-to-one, and keeps it as near to what it was as possible.
 *
 * Begin with nearest.c, then regions.h, which explains the words of this folder. */
#ifndef ICCP_NEAREST_H
#define ICCP_NEAREST_H

#include "map/compatible/plmap.h"

typedef struct iccp_nearest_facts {
    int32_t repair;      /* ICC_REPAIR_* */
    size_t n_folded;     /* triangles whose image was not positive */
    size_t n_patches;    /* regions that were mapped anew */
    double changed;      /* their share of the area before the map */
    size_t n_iterations; /* Newton steps */
} iccp_nearest_facts;

/* Makes all images positive, and the image of the boundary simple. If they are so already, nothing
 * changes. Otherwise the folded regions are mapped anew. Images of held vertices do not change, nor
 * do those of the boundary, unless `boundary_moves`. Images far from the regions do not change
 * either. Vertices keep their numbers, and new ones follow. Boundary edges stay.
 *
 * `fixed` is ICCP_ALONG at boundary vertices, ICCP_ON_POINT at held vertices inside, and otherwise
 * ICCP_FREE. Coordinates are local, and points positive.
 *
 * Returns ICC_ERR_BOUNDARY if the image of the boundary meets itself and may not move, and
 * ICC_ERR_CERTIFICATE if no map was found. On failure the images are of no use. */
icc_status iccp_nearest(iccp_plmap *map, bool boundary_moves, iccp_nearest_facts *facts,
                        const iccp_env *env, icc_error *err);

#endif
