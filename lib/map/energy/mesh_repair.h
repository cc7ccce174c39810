/* Repairing the image of a caller's mesh. */
#ifndef ICCP_MESH_REPAIR_H
#define ICCP_MESH_REPAIR_H

#include "geometry/simplices.h"

/* Moves the images, dim coordinates each, of inner points of a mesh in 2-D or 3-D until the images
 * of all simplices are positive, as far as that goes, or as so many steps for each do: HUGE_VAL, no
 * limit but those of iccp_untangle(). Inner points that have none, but coordinates that are not
 * finite, get one first. */
icc_status iccp_mesh_repair(const iccp_simplices *mesh, double *images, double most,
                            const iccp_env *env);

/* That: the mean of its neighbours' images, ring by ring from the boundary. */
icc_status iccp_mesh_place(const iccp_simplices *mesh, double *images, const iccp_env *env);

/* Makes coordinates of the images of inner points 0 that are next to nothing beside the largest, so
 * that there is room for exact signs. */
void iccp_mesh_round(const iccp_simplices *mesh, double *images);

#endif
