#include "domain/domain.h"

#include "base/error.h"
#include "domain/locate.h"
#include "domain/mask.h"
#include "domain/polygon.h"

#include <assert.h>
#include <string.h>

/* What icc.h promises: rounding of input files is of this order. In longest sides of the box. */
static const double BOUNDARY_TOLERANCE = 1e-14;

static icc_status copy_boundary(icc_domain *d, const double *vertices, const uint32_t *facets,
                                icc_error *err)
{
    const size_t n = d->n_vertices;
    d->given = iccp_alloc(&d->memory, n, 2 * sizeof *d->given);
    d->vertices = iccp_alloc(&d->memory, n, 2 * sizeof *d->vertices);
    d->facets = iccp_alloc(&d->memory, n, 2 * sizeof *d->facets);
    if (d->given == NULL || d->vertices == NULL || d->facets == NULL)
        return iccp_fail_memory(err);
    memcpy(d->given, vertices, n * 2 * sizeof *d->given);
    if (facets != NULL) {
        memcpy(d->facets, facets, n * 2 * sizeof *d->facets);
        return ICC_OK;
    }
    for (uint32_t i = 0; i < n; ++i) {
        d->facets[2 * i] = i;
        d->facets[2 * i + 1] = i + 1 < n ? i + 1 : 0;
    }
    return ICC_OK;
}

static void measure_box(icc_domain *d)
{
    double longest = 0;
    for (size_t k = 0; k < 2; ++k) {
        d->lower[k] = d->upper[k] = d->vertices[k];
        for (size_t i = 1; i < d->n_vertices; ++i) {
            const double x = d->vertices[2 * i + k];
            d->lower[k] = x < d->lower[k] ? x : d->lower[k];
            d->upper[k] = x > d->upper[k] ? x : d->upper[k];
        }
        const double side = d->upper[k] - d->lower[k];
        longest = side > longest ? side : longest;
    }
    d->tolerance = BOUNDARY_TOLERANCE * longest;
}

/* Everything that follows from the copied boundary. */
static icc_status complete(icc_domain *d, const iccp_env *env, icc_error *err)
{
    const size_t n = d->n_vertices;
    iccp_ring ring = {0};
    icc_status status = iccp_polygon_localise(&d->frame, d->vertices, n, d->given, err);
    if (status == ICC_OK)
        status = iccp_ring_create(&ring, n, d->vertices, d->facets, &d->memory, err);
    if (status == ICC_OK)
        status = iccp_polygon_check(&ring, &d->frame, env, err);
    if (status != ICC_OK) {
        iccp_ring_free(&ring, &d->memory);
        return status;
    }
    measure_box(d);
    d->orientation = iccp_polygon_orientation(&ring);
    d->measure = iccp_polygon_area(&ring);
    d->locator = iccp_locator_create(&ring, d->lower, d->upper, d->tolerance, &d->memory);
    return d->locator != NULL ? ICC_OK : iccp_fail_memory(err);
}

icc_status iccp_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                              const double *vertices, size_t n_facets, const uint32_t *facets,
                              const iccp_env *env, icc_error *err)
{
    assert(dim == 2);
    *out = NULL;
    if (n_vertices < 3)
        return iccp_fail(err, ICC_ERR_BOUNDARY, -1, "a polygon needs at least 3 vertices, not %zu",
                         n_vertices);
    if (facets != NULL && n_facets != n_vertices)
        return iccp_fail(err, ICC_ERR_BOUNDARY, -1,
                         "a closed ring through %zu vertices has as many facets, not %zu",
                         n_vertices, n_facets);
    icc_domain *domain = iccp_alloc_zero(&env->memory, 1, sizeof *domain);
    if (domain == NULL)
        return iccp_fail_memory(err);
    domain->memory = env->memory;
    atomic_init(&domain->references, 1);
    domain->dim = dim;
    domain->n_vertices = domain->n_facets = n_vertices;
    icc_status status = copy_boundary(domain, vertices, facets, err);
    if (status == ICC_OK)
        status = complete(domain, env, err);
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
    iccp_locator_free(domain->locator, &memory);
    iccp_mask_free(domain->mask);
    iccp_free(&memory, domain->given);
    iccp_free(&memory, domain->vertices);
    iccp_free(&memory, domain->facets);
    iccp_free(&memory, domain);
}

int32_t iccp_domain_locate(const icc_domain *domain, const double *point, bool boundary_only,
                           uint32_t *facet, double *bary)
{
    const bool nearest = facet != NULL && !boundary_only;
    const iccp_place place = iccp_locator_find(domain->locator, point, nearest);
    if (facet != NULL && (nearest || place.where == ICC_BOUNDARY)) {
        *facet = domain->locator->ring.facet[place.edge];
        bary[0] = 1 - place.t;
        bary[1] = place.t;
    }
    return place.where;
}

/* From the nearer end, so that both ends come out exactly, and a coordinate that they share too. */
void iccp_domain_facet_point(const icc_domain *domain, uint32_t facet, const double *bary,
                             double *point)
{
    const size_t from = bary[0] >= bary[1] ? 0 : 1;
    const double *a = domain->vertices + 2 * (size_t)domain->facets[2 * facet + from];
    const double *b = domain->vertices + 2 * (size_t)domain->facets[2 * facet + 1 - from];
    for (int k = 0; k < 2; ++k)
        point[k] = a[k] + bary[1 - from] * (b[k] - a[k]);
}
