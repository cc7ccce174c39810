/* Makes domains from boundaries that consist of simplices: intervals, surfaces, and so on. */
#include "domain/simplicial_domain.h"

#include "base/error.h"
#include "domain/closed_surfaces.h"
#include "domain/domain_make.h"
#include "domain/scan_surface.h"
#include "domain/simplicial.h"
#include "domain/tree_cross.h"
#include "domain/tree_locate.h"

#include <math.h>
#include <string.h>

static void clear(icc_domain *domain)
{
    iccp_facet_tree_free(&domain->tree, &domain->memory);
}

static const iccp_domain_ops OPS = {iccp_tree_own, iccp_tree_locate, iccp_tree_cross,
                                    iccp_scan_surface, clear};

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
        status = c->dim == 3 ? iccp_complex_check_vertices(c, env, err)
                             : iccp_complex_check_connected(c, env, err);
    return status;
}

/* ---- voids ---- */

static icc_status check_voids(icc_domain *d, const iccp_surfaces *s, icc_error *err)
{
    uint32_t outer = 0;
    icc_status status = ICC_OK;
    while (s->item[outer].around != UINT32_MAX)
        ++outer;
    for (uint32_t k = 0; k < s->n && status == ICC_OK; ++k) {
        d->genus += iccp_surface_genus(&s->item[k]);
        if (k != outer)
            status = iccp_surfaces_check_void(s, outer, k, s->item[k].around, err);
    }
    d->orientation = s->item[outer].orientation;
    d->n_voids = s->n - 1;
    return status;
}

/* Finds the surfaces of a boundary in space, which must be those of a solid and its voids. */
static icc_status check_surfaces(icc_domain *d, const iccp_complex *c, const iccp_env *env,
                                 icc_error *err)
{
    iccp_surfaces surfaces;
    icc_status status = iccp_explain(err, iccp_surfaces_create(&surfaces, c, &d->tree, env));
    if (status != ICC_OK)
        return status;
    status = check_voids(d, &surfaces, err);
    iccp_surfaces_free(&surfaces, &env->memory);
    return status;
}

static icc_status check_geometry(icc_domain *d, const iccp_complex *c, const iccp_env *env,
                                 icc_error *err)
{
    icc_status status = iccp_simplicial_check_flat(&d->tree, err);
    if (status == ICC_OK && d->dim == 3)
        status = iccp_simplicial_check_simple(&d->tree, d->n_vertices, &d->frame, env, err);
    if (status == ICC_OK)
        status = iccp_simplicial_measure(&d->tree, &d->orientation, &d->measure, err);
    return status == ICC_OK && d->dim == 3 ? check_surfaces(d, c, env, err) : status;
}

/* Checks the boundary, whose coordinates are there. */
static icc_status check_all(icc_domain *d, iccp_complex *c, const iccp_env *env, icc_error *err)
{
    if (d->dim > 1) {
        const icc_status status = check_complex(c, env, err);
        if (status != ICC_OK)
            return status;
    }
    if (iccp_progress(env, "check", 0.5) != ICC_OK)
        return iccp_explain(err, ICC_ERR_CANCELLED);
    iccp_domain_measure_box(d);
    iccp_facet_tree_create(&d->tree, c->dim, d->vertices, d->n_facets, d->facets, &d->memory);
    if (d->tree.boxes == NULL)
        return iccp_fail_memory(err);
    return d->dim == 1 ? check_interval(d, err) : check_geometry(d, c, env, err);
}

static icc_status complete(icc_domain *d, const double *given, const iccp_env *env, icc_error *err)
{
    iccp_complex c = {(size_t)d->dim, d->n_vertices, d->n_facets, d->facets, NULL};
    icc_status status = iccp_complex_check_indices(&c, err);
    if (status == ICC_OK)
        status = iccp_simplicial_localise(&d->frame, d->vertices, c.dim, &c, given, env, err);
    if (status == ICC_OK)
        status = keep_given(d, given, err);
    if (status == ICC_OK)
        status = check_all(d, &c, env, err);
    iccp_free(&env->memory, c.across);
    return status;
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

icc_status iccp_simplicial_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                                         const double *vertices, size_t n_facets,
                                         const uint32_t *facets, const iccp_env *env,
                                         icc_error *err)
{
    *out = NULL;
    icc_status status = check_counts((size_t)dim, n_vertices, n_facets, err);
    if (status != ICC_OK)
        return status;
    icc_domain *domain = iccp_domain_new(dim, &OPS, &env->memory);
    if (domain == NULL)
        return iccp_fail_memory(err);
    domain->n_vertices = n_vertices;
    status = iccp_domain_copy_facets(domain, n_facets, facets, err);
    if (status == ICC_OK)
        status = complete(domain, vertices, env, err);
    if (status != ICC_OK) {
        iccp_domain_release(domain);
        return status;
    }
    *out = domain;
    return ICC_OK;
}
