/* The affine map that is nearest to a plane map, for its boundary. */
#ifndef ICCP_AFFINE_FRAME_H
#define ICCP_AFFINE_FRAME_H

#include "map/compatible/plmap.h"

/* x -> j x + shift, with j row by row. */
typedef struct iccp_affine_frame {
    double j[4], shift[2];
} iccp_affine_frame;

/* Finds the affine map whose derivative is the mean of the map's, or of its positive triangles' if
 * that turns areas over. */
iccp_affine_frame iccp_affine_frame_find(const iccp_plmap *map);

/* Maps the vertices of the boundary by the affine map, after they are scaled about the middle of
 * the box of all points. */
void iccp_affine_frame_set(const iccp_affine_frame *frame, double scale, iccp_plmap *map);

#endif
