/* Reads the rings of a layer. Each ring gets its region on the left: outer rings run
 * counter-clockwise, holes clockwise. */
#include "match/coverage/layer.h"

#include "base/error.h"

#include <inttypes.h>

uint32_t iccp_regions_find(const iccp_regions *regions, int64_t id)
{
    size_t low = 0, high = regions->n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (regions->id[middle] < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < regions->n && regions->id[low] == id ? (uint32_t)low : ICCP_NO_REGION;
}

void iccp_layer_free(iccp_layer *layer, const iccp_memory *memory)
{
    iccp_free(memory, layer->place);
    iccp_free(memory, layer->edge);
    iccp_free(memory, layer->side);
}

icc_status iccp_layer_overlap(const iccp_layer *layer, uint32_t a, uint32_t b, const double *place,
                              icc_error *err)
{
    const int64_t *const id = layer->regions->id;
    double at[2];
    iccp_frame_restore(&layer->frame, 2, place, at);
    if (a == ICCP_NO_REGION && b == ICCP_NO_REGION)
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "regions overlap at (%.9g, %.9g): weld if they should only meet", at[0],
                         at[1]);
    if (a == ICCP_NO_REGION)
        a = b;
    if (a == b || b == ICCP_NO_REGION)
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "region %" PRId64 " overlaps itself at (%.9g, %.9g)", id[a], at[0], at[1]);
    return iccp_fail(err, ICC_ERR_BOUNDARY,
                     "regions %" PRId64 " and %" PRId64
                     " overlap at (%.9g, %.9g): weld if they should only meet",
                     id[a < b ? a : b], id[a < b ? b : a], at[0], at[1]);
}

/* Twice the signed area of n points. */
static double area_of(const double *points, size_t n)
{
    double sum = 0;
    for (size_t k = 1; k + 1 < n; ++k) {
        const double *const p = points + 2 * k;
        sum += (p[0] - points[0]) * (p[3] - points[1]) - (p[2] - points[0]) * (p[1] - points[1]);
    }
    return sum;
}

/* Appends the places and edges of one ring. */
static void add_ring(iccp_layer *layer, const double *points, size_t n, uint32_t region,
                     bool is_hole)
{
    const uint32_t first = (uint32_t)layer->n;
    double *const place = layer->place + 2 * layer->n;
    for (size_t k = 0; k < n; ++k)
        iccp_frame_in(&layer->frame, 2, points + 2 * k, place + 2 * k);
    const bool is_back = (area_of(place, n) < 0) != is_hole;
    for (size_t k = 0; k < n; ++k) {
        const uint32_t a = first + (uint32_t)k, b = first + (uint32_t)((k + 1) % n);
        layer->edge[layer->n_edges++] = (iccp_layer_edge){is_back ? b : a, is_back ? a : b, region};
    }
    layer->n += n;
}

icc_status iccp_layer_read(iccp_layer *layer, const icc_layer *given, const iccp_regions *regions,
                           double weld, const iccp_env *env, icc_error *err)
{
    const size_t n = given->first[given->n_rings];
    *layer = (iccp_layer){.regions = regions};
    iccp_frame_fit(&layer->frame, 2, n, given->vertices);
    layer->weld = weld * layer->frame.in[0] * layer->frame.in[1];
    for (size_t k = 0; k < n; ++k)
        if (!iccp_frame_holds(&layer->frame, 2, given->vertices + 2 * k))
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)k,
                                "vertex %zu: a coordinate is not 0, but less than 2^-200 of the "
                                "largest one",
                                k);
    layer->place = iccp_alloc(&env->memory, n, 2 * sizeof *layer->place);
    layer->edge = iccp_alloc(&env->memory, n, sizeof *layer->edge);
    if (layer->place == NULL || layer->edge == NULL)
        return iccp_fail_memory(err);
    for (size_t r = 0; r < given->n_rings; ++r) {
        const uint32_t region = iccp_regions_find(regions, given->ids[r]);
        if (region != ICCP_NO_REGION)
            add_ring(layer, given->vertices + 2 * given->first[r],
                     given->first[r + 1] - given->first[r], region,
                     given->holes != NULL && given->holes[r] != 0);
    }
    layer->n_given = layer->n;
    return ICC_OK;
}
