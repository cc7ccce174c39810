/* Repairs the image of a caller's mesh. */
#ifndef ICCP_MESH_REPAIR_H
#define ICCP_MESH_REPAIR_H

#include "geometry/simplices.h"

/* Moves the images of inner points of a mesh in 2-D or 3-D until the images of all simplices are
 * positive. The images have dim coordinates each. It may fail, or stop after `most` steps for each
 * simplex. HUGE_VAL leaves only the limits of iccp_untangle(). An inner point whose image is not
 * finite first gets an image by iccp_mesh_place(). */
icc_status iccp_mesh_repair(const iccp_simplices *mesh, double *images, double most,
                            const iccp_env *env);

/* Gives inner points without a finite image the mean of their neighbours' images, ring by ring from
 * the boundary. */
icc_status iccp_mesh_place(const iccp_simplices *mesh, double *images, const iccp_env *env);

/* Sets coordinates of inner points' images to 0 if they are tiny beside the largest one. Exact
 * signs can then be computed. */
void iccp_mesh_round(const iccp_simplices *mesh, double *images);

#endif
