#include "domain/domain.h"

#include "base/error.h"
#include "base/minmax.h"
#include "domain/locate.h"
#include "domain/mask.h"
#include "domain/polygon_check.h"
#include "domain/simplices.h"
#include "domain/simplicial.h"

#include <float.h>
#include <math.h>
#include <string.h>

static icc_status copy_boundary(icc_domain *d, const double *vertices, const uint32_t *facets,
                                icc_error *err)
{
    const size_t dim = (size_t)d->dim, n = d->n_vertices;
    d->given = iccp_alloc(&d->memory, n, dim * sizeof *d->given);
    d->vertices = iccp_alloc(&d->memory, n + 1, dim * sizeof *d->vertices);
    d->facets = iccp_alloc(&d->memory, d->n_facets, dim * sizeof *d->facets);
    if (d->given == NULL || d->vertices == NULL || d->facets == NULL)
        return iccp_fail_memory(err);
    memcpy(d->given, vertices, n * dim * sizeof *d->given);
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

/* The bounding box, and the band around the boundary within which points count as on it.
 * Rounding depends on how large the coordinates are where the caller has them, hence the way out
 * of the frame and back: `largest` is in units of the local frame, but measured from the
 * caller's origin. */
static void measure_box(icc_domain *d)
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

/* The polygon's tree of boxes has the form of a facet tree (domain/facet_tree.h). */
static void view_tree(icc_domain *d)
{
    d->tree = (iccp_facet_tree){.dim = 2,
                                .n_corners = 2,
                                .n = d->n_facets,
                                .vertices = d->vertices,
                                .facets = d->facets,
                                .n_leaves = d->locator->tree.n_leaves,
                                .boxes = d->locator->tree.boxes->lower,
                                .order = d->locator->polygon.facet};
}

static icc_status check_polygon(const icc_domain *d, const iccp_polygon *polygon,
                                iccp_boxtree *tree, const iccp_env *env, icc_error *err)
{
    iccp_boxtree_create(tree, polygon->points, polygon->n, &d->memory);
    if (tree->boxes == NULL)
        return iccp_fail_memory(err);
    return iccp_polygon_check(polygon, tree, &d->frame, env, err);
}

/* Everything that follows from the copied boundary. */
static icc_status complete_polygon(icc_domain *d, const iccp_env *env, icc_error *err)
{
    const size_t n = d->n_vertices;
    iccp_polygon polygon = {0};
    iccp_boxtree tree = {0};
    icc_status status = iccp_polygon_localise(&d->frame, d->vertices, n, d->given, err);
    if (status == ICC_OK) {
        memcpy(d->vertices + 2 * n, d->vertices, 2 * sizeof *d->vertices);
        status = iccp_polygon_create(&polygon, n, d->vertices, d->facets, &d->memory, err);
    }
    if (status == ICC_OK)
        status = check_polygon(d, &polygon, &tree, env, err);
    if (status != ICC_OK) {
        iccp_boxtree_free(&tree, &d->memory);
        iccp_polygon_free(&polygon, &d->memory);
        return status;
    }
    measure_box(d);
    d->orientation = iccp_polygon_orientation(&polygon);
    d->measure = iccp_polygon_area(&polygon);
    d->locator = iccp_locator_create(&polygon, &tree, d->lower, d->upper, &d->band, &d->memory);
    if (d->locator == NULL)
        return iccp_fail_memory(err);
    view_tree(d);
    return ICC_OK;
}

static icc_status check_polygon_counts(size_t n_vertices, size_t n_facets, const uint32_t *facets,
                                       icc_error *err)
{
    if (n_vertices < 3)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "a polygon needs at least 3 vertices, not %zu",
                         n_vertices);
    if (facets != NULL && n_facets != n_vertices)
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "a closed ring through %zu vertices has as many facets, not %zu",
                         n_vertices, n_facets);
    return ICC_OK;
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

static icc_status complete_simplicial(icc_domain *d, const iccp_env *env, icc_error *err)
{
    iccp_complex c = {(size_t)d->dim, d->n_vertices, d->n_facets, d->facets, NULL};
    icc_status status = iccp_complex_check_indices(&c, err);
    if (status == ICC_OK)
        status = iccp_simplicial_localise(&d->frame, d->vertices, c.dim, &c, d->given, env, err);
    if (status == ICC_OK && d->dim > 1)
        status = check_complex(&c, env, err);
    if (status != ICC_OK)
        return status;
    if (iccp_progress(env, "check", 0.5) != ICC_OK)
        return iccp_explain(err, ICC_ERR_CANCELLED);
    measure_box(d);
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

icc_status iccp_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                              const double *vertices, size_t n_facets, const uint32_t *facets,
                              const iccp_env *env, icc_error *err)
{
    *out = NULL;
    icc_status status = dim == 2 ? check_polygon_counts(n_vertices, n_facets, facets, err)
                                 : check_counts((size_t)dim, n_vertices, n_facets, err);
    if (status != ICC_OK)
        return status;
    icc_domain *domain = iccp_alloc_zero(&env->memory, 1, sizeof *domain);
    if (domain == NULL)
        return iccp_fail_memory(err);
    domain->memory = env->memory;
    atomic_init(&domain->references, 1);
    domain->dim = dim;
    domain->n_vertices = n_vertices;
    domain->n_facets = dim == 2 ? n_vertices : n_facets;
    status = copy_boundary(domain, vertices, facets, err);
    if (status == ICC_OK)
        status =
            dim == 2 ? complete_polygon(domain, env, err) : complete_simplicial(domain, env, err);
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
    iccp_mask_free(domain->mask);
    iccp_simplices_free(domain->mesh);
    iccp_free(&memory, domain->given);
    iccp_free(&memory, domain->vertices);
    iccp_free(&memory, domain->facets);
    iccp_free(&memory, domain);
}
