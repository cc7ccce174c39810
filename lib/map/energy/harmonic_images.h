/* Images by harmonic functions. */
#ifndef ICCP_HARMONIC_IMAGES_H
#define ICCP_HARMONIC_IMAGES_H

#include "map/energy/simplicial_map.h"

/* Sets the images of free points to the values of the harmonic functions whose boundary values are
 * the images of the fixed points, by linear finite elements on the mesh before the map. Images may
 * fold. ICC_ERR_SOLVER if there is no solution, which only happens in the plane. */
icc_status iccp_harmonic_images(const iccp_simplicial_map *map, const iccp_env *env);

#endif
