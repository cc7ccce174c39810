#include "domain/locate.h"

#include <math.h>

iccp_locator *iccp_locator_create(iccp_polygon *polygon, const double *lower, const double *upper,
                                  const iccp_band *band, const iccp_memory *memory)
{
    iccp_locator *locator = iccp_alloc_zero(memory, 1, sizeof *locator);
    if (locator == NULL) {
        iccp_polygon_free(polygon, memory);
        return NULL;
    }
    locator->polygon = *polygon;
    *polygon = (iccp_polygon){0};
    iccp_boxtree_create(&locator->tree, locator->polygon.points, locator->polygon.n, memory);
    if (locator->tree.boxes == NULL || iccp_buckets_create(&locator->buckets, &locator->polygon,
                                                           lower, upper, band, memory) != ICC_OK) {
        iccp_locator_free(locator, memory);
        return NULL;
    }
    return locator;
}

void iccp_locator_free(iccp_locator *locator, const iccp_memory *memory)
{
    if (locator == NULL)
        return;
    iccp_buckets_free(&locator->buckets, memory);
    iccp_boxtree_free(&locator->tree, memory);
    iccp_polygon_free(&locator->polygon, memory);
    iccp_free(memory, locator);
}

/* Keeps squares finite. So far away (1e100 boxes) all edges are equally far in doubles. */
static double within_reach(double x)
{
    return x > 1e100 ? 1e100 : x > -1e100 ? x : x == x ? -1e100 : 0;
}

iccp_location iccp_locator_find(const iccp_locator *locator, const double *p, bool nearest)
{
    iccp_location place = iccp_buckets_find(&locator->buckets, p);
    if (nearest && place.where != ICC_BOUNDARY) {
        const double reachable[2] = {within_reach(p[0]), within_reach(p[1])};
        double distance2;
        place.edge = iccp_boxtree_nearest(&locator->tree, reachable, &place.t, &distance2);
    }
    return place;
}
