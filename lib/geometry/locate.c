/* Where points lie with respect to a polygon, and their nearest edges. */
#include "geometry/locate.h"

#include "base/compiler.h"
#include "geometry/away.h"

iccp_locator *iccp_locator_create(iccp_polygon *polygon, const iccp_facet_tree *facets,
                                  const double *lower, const double *upper, const iccp_band *band,
                                  const iccp_memory *memory)
{
    iccp_locator *locator = iccp_alloc_zero(memory, 1, sizeof *locator);
    if (locator == NULL) {
        iccp_polygon_free(polygon, memory);
        return NULL;
    }
    locator->memory = *memory;
    locator->polygon = *polygon;
    *polygon = (iccp_polygon){0};
    locator->bare_trees.edges =
        iccp_boxtree_without_boxes(locator->polygon.points, locator->polygon.n);
    locator->bare_trees.facets = *facets;
    iccp_once_init(&locator->trees);
    iccp_buckets_start(&locator->bare, &locator->polygon, lower, upper, band);
    iccp_once_init(&locator->buckets);
    return locator;
}

static void free_trees(iccp_edge_trees *trees, const iccp_memory *memory)
{
    if (trees != NULL)
        iccp_boxtree_free(&trees->edges, memory);
    iccp_free(memory, trees);
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
    free_buckets(iccp_once_get(&locator->buckets), memory);
    free_trees(iccp_once_get(&locator->trees), memory);
    iccp_polygon_free(&locator->polygon, memory);
    iccp_free(memory, locator);
}

static const iccp_edge_trees *make_trees(const iccp_locator *locator)
{
    iccp_edge_trees *made = iccp_alloc(&locator->memory, 1, sizeof *made);
    if (made == NULL)
        return &locator->bare_trees;
    *made = locator->bare_trees;
    iccp_boxtree_create(&made->edges, made->edges.points, made->edges.n, &locator->memory);
    if (made->edges.boxes == NULL) {
        iccp_free(&locator->memory, made);
        return &locator->bare_trees;
    }
    made->facets.boxes = made->edges.boxes->lower;
    iccp_edge_trees *kept = iccp_once_keep(&locator->trees, made);
    if (kept != made)
        free_trees(made, &locator->memory);
    return kept;
}

const iccp_edge_trees *iccp_locator_trees(const iccp_locator *locator)
{
    const iccp_edge_trees *known = iccp_once_get(&locator->trees);
    return ICCP_LIKELY(known != NULL) ? known : make_trees(locator);
}

static const iccp_buckets *make_buckets(const iccp_locator *locator)
{
    iccp_buckets *made = iccp_alloc(&locator->memory, 1, sizeof *made);
    if (made == NULL)
        return &locator->bare;
    *made = locator->bare;
    if (iccp_buckets_fill(made, &locator->memory) != ICC_OK) {
        iccp_free(&locator->memory, made);
        return &locator->bare;
    }
    const iccp_buckets *known = iccp_once_keep(&locator->buckets, made);
    if (known != made)
        free_buckets(made, &locator->memory);
    return known;
}

static const iccp_buckets *find_buckets(const iccp_locator *locator)
{
    const iccp_buckets *known = iccp_once_get(&locator->buckets);
    return ICCP_LIKELY(known != NULL) ? known : make_buckets(locator);
}

iccp_location iccp_locator_find(const iccp_locator *locator, const double *p, bool nearest)
{
    iccp_location place = iccp_buckets_find(find_buckets(locator), p);
    if (nearest && place.where != ICC_BOUNDARY) {
        double reachable[2], distance2;
        iccp_away_reach(2, p, reachable);
        place.edge = iccp_boxtree_nearest(&iccp_locator_trees(locator)->edges, reachable, &place.t,
                                          &distance2);
    }
    return place;
}
