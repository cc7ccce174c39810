/* Makes domains from polygons. */
#include "domain/polygon_domain.h"

#include "base/error.h"
#include "domain/domain_make.h"
#include "domain/scan_polygon.h"
#include "domain/tree_cross.h"
#include "geometry/locate.h"
#include "geometry/polygon_check.h"

#include <string.h>

static const iccp_facet_tree *find_tree(const icc_domain *domain)
{
    return &iccp_locator_trees(domain->locator)->facets;
}

static int32_t locate(const icc_domain *domain, const double *point, bool boundary_only,
                      uint32_t *facet, double *bary)
{
    const bool nearest = facet != NULL && !boundary_only;
    const iccp_location place = iccp_locator_find(domain->locator, point, nearest);
    if (facet != NULL && (nearest || place.where == ICC_BOUNDARY)) {
        *facet = iccp_polygon_facet(&domain->locator->polygon, place.edge);
        bary[0] = 1 - place.t;
        bary[1] = place.t;
    }
    return place.where;
}

static void clear(icc_domain *domain)
{
    iccp_locator_free(domain->locator, &domain->memory);
}

static const iccp_domain_ops OPS = {find_tree, locate, iccp_tree_cross, iccp_scan_polygon, clear};

/* A tree over the polygon's edges (geometry/boxtree.h) in the form of a facet tree. */
static iccp_facet_tree tree_without_boxes(const icc_domain *d, const iccp_polygon *polygon)
{
    return (iccp_facet_tree){.dim = 2,
                             .n_corners = 2,
                             .n = d->n_facets,
                             .vertices = d->vertices,
                             .facets = d->facets,
                             .n_leaves =
                                 iccp_boxtree_without_boxes(polygon->points, polygon->n).n_leaves,
                             .order = polygon->facet};
}

/* Computes everything that follows from the copied boundary. */
static icc_status complete(icc_domain *d, const double *given, const uint32_t *facets,
                           const iccp_env *env, icc_error *err)
{
    const size_t n = d->n_vertices;
    iccp_polygon polygon = {0};
    icc_status status = iccp_polygon_localise(&d->frame, d->vertices, n, given, err);
    if (status == ICC_OK) {
        memcpy(d->vertices + 2 * n, d->vertices, 2 * sizeof *d->vertices);
        status = iccp_polygon_create(&polygon, n, d->vertices, facets, &d->memory, err);
    }
    if (status == ICC_OK)
        status = iccp_polygon_check(&polygon, &d->frame, env, err);
    if (status != ICC_OK) {
        iccp_polygon_free(&polygon, &d->memory);
        return status;
    }
    iccp_domain_measure_box(d);
    d->orientation = iccp_polygon_orientation(&polygon);
    d->measure = iccp_polygon_area(&polygon);
    const iccp_facet_tree tree = tree_without_boxes(d, &polygon);
    d->locator = iccp_locator_create(&polygon, &tree, d->lower, d->upper, &d->band, &d->memory);
    if (d->locator == NULL)
        return iccp_fail_memory(err);
    d->tree = tree;
    return ICC_OK;
}

icc_status iccp_polygon_domain_create(icc_domain **out, size_t n_vertices, const double *vertices,
                                      size_t n_facets, const uint32_t *facets, const iccp_env *env,
                                      icc_error *err)
{
    *out = NULL;
    icc_status status = iccp_polygon_check_counts(n_vertices, n_facets, facets, err);
    if (status != ICC_OK)
        return status;
    icc_domain *domain = iccp_domain_new(2, &OPS, &env->memory);
    if (domain == NULL)
        return iccp_fail_memory(err);
    domain->n_vertices = n_vertices;
    status = iccp_domain_copy_facets(domain, n_vertices, facets, err);
    if (status == ICC_OK)
        status = complete(domain, vertices, facets, env, err);
    if (status != ICC_OK) {
        iccp_domain_release(domain);
        return status;
    }
    *out = domain;
    return ICC_OK;
}
