/* Takes steps for the images of a plane map, and then for its points. */
#ifndef ICCP_POINTS_AND_IMAGES_H
#define ICCP_POINTS_AND_IMAGES_H

#include "map/compatible/plmap.h"
#include "map/energy/descent.h"

/* Takes the steps of iccp_improve_images() for the images. Then takes as many steps for the points
 * of free vertices by the energy of the inverse map. Sets improvement->energy. The map is no worse
 * than before. No triangle becomes so flat on either side that doubles see no area in it. */
icc_status iccp_improve_points_and_images(iccp_plmap *map, const iccp_descent *descent,
                                          iccp_work *work, iccp_improvement *improvement,
                                          const iccp_env *env);

#endif
