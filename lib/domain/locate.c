#include "domain/locate.h"

#include "base/compiler.h"

iccp_locator *iccp_locator_create(iccp_polygon *polygon, iccp_boxtree *tree, const double *lower,
                                  const double *upper, const iccp_band *band,
                                  const iccp_memory *memory)
{
    iccp_locator *locator = iccp_alloc_zero(memory, 1, sizeof *locator);
    if (locator == NULL) {
        iccp_boxtree_free(tree, memory);
        iccp_polygon_free(polygon, memory);
        return NULL;
    }
    locator->memory = *memory;
    locator->polygon = *polygon;
    locator->tree = *tree;
    *polygon = (iccp_polygon){0};
    *tree = (iccp_boxtree){0};
    iccp_buckets_start(&locator->bare, &locator->polygon, lower, upper, band);
    atomic_init(&locator->buckets, NULL);
    return locator;
}

static void free_buckets(iccp_buckets *buckets, const iccp_memory *memory)
{
    if (buckets != NULL)
        iccp_buckets_free(buckets, memory);
    iccp_free(memory, buckets);
}

void iccp_locator_free(iccp_locator *locator, const iccp_memory *memory)
{
    if (locator == NULL)
        return;
    free_buckets(atomic_load_explicit(&locator->buckets, memory_order_acquire), memory);
    iccp_boxtree_free(&locator->tree, memory);
    iccp_polygon_free(&locator->polygon, memory);
    iccp_free(memory, locator);
}

/* Of threads that make the buckets at the same time the first to be done wins. */
static const iccp_buckets *make_buckets(iccp_locator *locator)
{
    iccp_buckets *made = iccp_alloc(&locator->memory, 1, sizeof *made), *known = NULL;
    if (made == NULL)
        return &locator->bare;
    *made = locator->bare;
    if (iccp_buckets_fill(made, &locator->memory) != ICC_OK) {
        iccp_free(&locator->memory, made);
        return &locator->bare;
    }
    if (atomic_compare_exchange_strong_explicit(&locator->buckets, &known, made,
                                                memory_order_acq_rel, memory_order_acquire))
        return made;
    free_buckets(made, &locator->memory);
    return known;
}

static const iccp_buckets *find_buckets(const iccp_locator *locator)
{
    iccp_locator *shared = (iccp_locator *)locator;
    const iccp_buckets *known = atomic_load_explicit(&shared->buckets, memory_order_acquire);
    return ICCP_LIKELY(known != NULL) ? known : make_buckets(shared);
}

/* Keeps squares finite. So far away (1e100 boxes) all edges are equally far in doubles. */
static double within_reach(double x)
{
    return x > 1e100 ? 1e100 : x > -1e100 ? x : x == x ? -1e100 : 0;
}

iccp_location iccp_locator_find(const iccp_locator *locator, const double *p, bool nearest)
{
    iccp_location place = iccp_buckets_find(find_buckets(locator), p);
    if (nearest && place.where != ICC_BOUNDARY) {
        const double reachable[2] = {within_reach(p[0]), within_reach(p[1])};
        double distance2;
        place.edge = iccp_boxtree_nearest(&locator->tree, reachable, &place.t, &distance2);
    }
    return place;
}
