/* What all ways of making a domain share. */
#include "domain/domain_make.h"

#include "base/error.h"
#include "base/minmax.h"

#include <float.h>
#include <math.h>
#include <string.h>

icc_domain *iccp_domain_new(int32_t dim, const iccp_domain_ops *ops, const iccp_memory *memory)
{
    icc_domain *domain = iccp_alloc_zero(memory, 1, sizeof *domain);
    if (domain == NULL)
        return NULL;
    domain->memory = *memory;
    atomic_init(&domain->references, 1);
    domain->ops = ops;
    domain->dim = dim;
    return domain;
}

icc_status iccp_domain_copy_facets(icc_domain *d, size_t n_facets, const uint32_t *facets,
                                   icc_error *err)
{
    const size_t dim = (size_t)d->dim, n = d->n_vertices;
    d->n_facets = n_facets;
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
