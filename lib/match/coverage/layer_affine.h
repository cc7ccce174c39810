/* Fits an affine map to pairs of places that surely correspond. */
#ifndef ICCP_LAYER_AFFINE_H
#define ICCP_LAYER_AFFINE_H

#include "match/coverage/layer_pairing.h"

/* Fits by least squares to n pairs (four numbers each). If they tell no direction, the first pair
 * and the sizes of the layers decide; without any, the bounding boxes. */
void iccp_layer_affine_fit(iccp_plane_affine *affine, size_t n, const double *pairs,
                           const iccp_layer *source, const iccp_layer *target);

#endif
