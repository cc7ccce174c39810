/* Makes domains from boundaries. */
#include "domain/domain.h"

#include "base/error.h"
#include "base/minmax.h"
#include "domain/features.h"
#include "domain/mask.h"
#include "domain/simplicial.h"
#include "geometry/locate.h"
#include "geometry/polygon_check.h"
#include "geometry/simplices.h"

#include <float.h>
#include <math.h>
#include <string.h>

static icc_status copy_facets(icc_domain *d, const uint32_t *facets, icc_error *err)
{
    const size_t dim = (size_t)d->dim, n = d->n_vertices;
    d->vertices = iccp_alloc(&d->memory, n + 1, dim * sizeof *d->vertices);
    d->facets = iccp_alloc(&d->memory, d->n_facets, dim * sizeof *d->facets);
    if (d->vertices == NULL || d->facets == NULL)
        return iccp_fail_memory(err);
    if (facets != NULL) {
        memcpy(d->facets, facets, d->n_facets * dim * sizeof *d->facets);
        return ICC_OK;
    }
    for (uint32_t i = 0; i < n; ++i) {
        d->facets[2 * i] = i;
        d->facets[2 * i + 1] = i + 1 < n ? i + 1 : 0;
    }
    return ICC_OK;
}

/* Keeps the caller's vertices unless they can be computed from the local ones. */
static icc_status keep_given(icc_domain *d, const double *given, icc_error *err)
{
    const size_t dim = (size_t)d->dim, size = dim * sizeof *given;
    double x[ICC_MAX_DIM];
    bool same = true;
    for (size_t v = 0; v < d->n_vertices && same; ++v) {
        iccp_frame_restore(&d->frame, d->dim, d->vertices + dim * v, x);
        same = memcmp(x, given + dim * v, size) == 0;
    }
    if (same)
        return ICC_OK;
    d->given = iccp_alloc(&d->memory, d->n_vertices, size);
    if (d->given == NULL)
        return iccp_fail_memory(err);
    memcpy(d->given, given, d->n_vertices * size);
    return ICC_OK;
}

void iccp_domain_given(const icc_domain *domain, size_t vertex, double *point)
{
    const size_t dim = (size_t)domain->dim;
    if (domain->given != NULL)
        memcpy(point, domain->given + dim * vertex, dim * sizeof *point);
    else
        iccp_frame_restore(&domain->frame, domain->dim, domain->vertices + dim * vertex, point);
}

/* Computes the bounding box, and the band around the boundary within which points count as on it.
 * Rounding depends on the size of the caller's coordinates. So `largest` is measured from the
 * caller's origin, in units of the local frame. */
void iccp_domain_measure_box(icc_domain *d)
{
    const size_t dim = (size_t)d->dim;
    double longest = 0, given[2][ICC_MAX_DIM], largest[ICC_MAX_DIM];
    iccp_frame_bounds(d->dim, d->n_vertices, d->vertices, d->lower, d->upper);
    for (size_t k = 0; k < dim; ++k) {
        const double side = d->upper[k] - d->lower[k];
        longest = side > longest ? side : longest;
    }
    iccp_frame_out(&d->frame, d->dim, d->lower, given[0]);
    iccp_frame_out(&d->frame, d->dim, d->upper, given[1]);
    for (size_t k = 0; k < dim; ++k)
        largest[k] = iccp_max(iccp_max(fabs(given[0][k]), fabs(given[1][k])), DBL_MIN) *
                     d->frame.in[0] * d->frame.in[1];
    d->band = iccp_band_of(dim, longest, largest);
}

/* ---------------------------------------------------------------- polygons */

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
static icc_status complete_polygon(icc_domain *d, const double *given, const uint32_t *facets,
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

const iccp_facet_tree *iccp_domain_tree(const icc_domain *domain)
{
    return domain->locator != NULL ? &iccp_locator_trees(domain->locator)->facets : &domain->tree;
}

/* -------------------------------------------------------- other dimensions */

static icc_status check_interval(icc_domain *d, icc_error *err)
{
    const double a = d->vertices[d->facets[0]], b = d->vertices[d->facets[1]];
    if (a == b)
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, 1,
                            "the interval has no length");
    d->orientation = a < b ? 1 : -1;
    d->measure = fabs(b - a);
    return ICC_OK;
}

static icc_status check_complex(iccp_complex *c, const iccp_env *env, icc_error *err)
{
    c->across = iccp_alloc(&env->memory, c->n_facets, c->dim * sizeof *c->across);
    if (c->across == NULL)
        return iccp_fail_memory(err);
    icc_status status = iccp_explain(err, iccp_progress(env, "check", 0));
    if (status == ICC_OK)
        status = iccp_complex_join(c, env, err);
    if (status == ICC_OK)
        status = iccp_complex_check_shape(c, env, err);
    iccp_free(&env->memory, c->across);
    return status;
}

static icc_status check_geometry(icc_domain *d, const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_simplicial_check_flat(&d->tree, err);
    if (status == ICC_OK && d->dim == 3)
        status = iccp_simplicial_check_simple(&d->tree, d->n_vertices, &d->frame, env, err);
    if (status == ICC_OK)
        status = iccp_simplicial_measure(&d->tree, &d->orientation, &d->measure, err);
    return status;
}

static icc_status complete_simplicial(icc_domain *d, const double *given, const iccp_env *env,
                                      icc_error *err)
{
    iccp_complex c = {(size_t)d->dim, d->n_vertices, d->n_facets, d->facets, NULL};
    icc_status status = iccp_complex_check_indices(&c, err);
    if (status == ICC_OK)
        status = iccp_simplicial_localise(&d->frame, d->vertices, c.dim, &c, given, env, err);
    if (status == ICC_OK)
        status = keep_given(d, given, err);
    if (status == ICC_OK && d->dim > 1)
        status = check_complex(&c, env, err);
    if (status != ICC_OK)
        return status;
    if (iccp_progress(env, "check", 0.5) != ICC_OK)
        return iccp_explain(err, ICC_ERR_CANCELLED);
    iccp_domain_measure_box(d);
    iccp_facet_tree_create(&d->tree, c.dim, d->vertices, d->n_facets, d->facets, &d->memory);
    if (d->tree.boxes == NULL)
        return iccp_fail_memory(err);
    return d->dim == 1 ? check_interval(d, err) : check_geometry(d, env, err);
}

static icc_status check_counts(size_t dim, size_t n_vertices, size_t n_facets, icc_error *err)
{
    if (dim == 1 && n_facets != 2)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "an interval has 2 facets, not %zu", n_facets);
    if (n_facets <= dim)
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "a closed boundary in %zu dimensions has at least %zu facets, not %zu",
                         dim, dim + 1, n_facets);
    if (n_vertices <= dim)
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "a closed boundary in %zu dimensions has at least %zu vertices, not %zu",
                         dim, dim + 1, n_vertices);
    return ICC_OK;
}

icc_domain *iccp_domain_new(int32_t dim, const iccp_memory *memory)
{
    icc_domain *domain = iccp_alloc_zero(memory, 1, sizeof *domain);
    if (domain == NULL)
        return NULL;
    domain->memory = *memory;
    atomic_init(&domain->references, 1);
    domain->dim = dim;
    return domain;
}

icc_status iccp_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                              const double *vertices, size_t n_facets, const uint32_t *facets,
                              const iccp_env *env, icc_error *err)
{
    *out = NULL;
    icc_status status = dim == 2 ? iccp_polygon_check_counts(n_vertices, n_facets, facets, err)
                                 : check_counts((size_t)dim, n_vertices, n_facets, err);
    if (status != ICC_OK)
        return status;
    icc_domain *domain = iccp_domain_new(dim, &env->memory);
    if (domain == NULL)
        return iccp_fail_memory(err);
    domain->n_vertices = n_vertices;
    domain->n_facets = dim == 2 ? n_vertices : n_facets;
    status = copy_facets(domain, facets, err);
    if (status == ICC_OK)
        status = dim == 2 ? complete_polygon(domain, vertices, facets, env, err)
                          : complete_simplicial(domain, vertices, env, err);
    if (status != ICC_OK) {
        iccp_domain_release(domain);
        return status;
    }
    *out = domain;
    return ICC_OK;
}

icc_domain *iccp_domain_retain(const icc_domain *domain)
{
    icc_domain *shared = (icc_domain *)domain;
    atomic_fetch_add_explicit(&shared->references, 1, memory_order_relaxed);
    return shared;
}

void iccp_domain_release(icc_domain *domain)
{
    if (domain == NULL ||
        atomic_fetch_sub_explicit(&domain->references, 1, memory_order_acq_rel) != 1)
        return;
    const iccp_memory memory = domain->memory;
    if (domain->locator == NULL)
        iccp_facet_tree_free(&domain->tree, &memory);
    iccp_locator_free(domain->locator, &memory);
    iccp_features_free(domain->features, &memory);
    iccp_mask_free(domain->mask);
    iccp_simplices_free(domain->mesh);
    iccp_free(&memory, domain->given);
    iccp_free(&memory, domain->vertices);
    iccp_free(&memory, domain->facets);
    iccp_free(&memory, domain);
}
