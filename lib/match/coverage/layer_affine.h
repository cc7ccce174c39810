/* Fits an affine map to pairs of places that surely correspond. */
#ifndef ICCP_LAYER_AFFINE_H
#define ICCP_LAYER_AFFINE_H

#include "match/coverage/layer_pairing.h"

/* Fits by least squares to n pairs (four numbers each). If they lie almost on a line, or would be
 * mirrored, the fit is a similarity. If there are fewer than two places, or if they tell no
 * direction, the bounding boxes of the layers decide. */
void iccp_layer_affine_fit(iccp_layer_affine *affine, size_t n, const double *pairs,
                           const iccp_layer *source, const iccp_layer *target);

#endif
