#include "match/coverage/layer_affine.h"

#include "math/elementary.h"

/* Centre and diagonal of a layer's bounding box. */
static double box_of(const iccp_layer *layer, double *centre)
{
    double lower[2], upper[2];
    iccp_frame_bounds(2, layer->n, layer->place, lower, upper);
    for (int k = 0; k < 2; ++k)
        centre[k] = (lower[k] + upper[k]) / 2;
    return iccp_hypot(upper[0] - lower[0], upper[1] - lower[1]);
}

void iccp_layer_affine_fit(iccp_plane_affine *affine, size_t n, const double *pairs,
                           const iccp_layer *source, const iccp_layer *target)
{
    double from[2], to[2];
    const double size[2] = {box_of(source, from), box_of(target, to)};
    iccp_plane_affine_sums sums = {0};
    for (size_t k = 0; k < n; ++k)
        iccp_plane_affine_add(&sums, 1, pairs + 4 * k, pairs + 4 * k + 2);
    (void)iccp_plane_affine_fit(affine, &sums, size);
    for (int k = 0; k < 2 && n == 0; ++k) {
        affine->from[k] = from[k];
        affine->to[k] = to[k];
    }
}
