/* The domain object, whatever way it is made. */
#include "domain/domain.h"

#include "base/error.h"
#include "domain/mask.h"
#include "geometry/simplices.h"

#include <string.h>

void iccp_domain_given(const icc_domain *domain, size_t vertex, double *point)
{
    const size_t dim = (size_t)domain->dim;
    if (domain->given != NULL)
        memcpy(point, domain->given + dim * vertex, dim * sizeof *point);
    else
        iccp_frame_restore(&domain->frame, domain->dim, domain->vertices + dim * vertex, point);
}

/* Starts from the nearest vertex. So vertices are exact, and so is a coordinate that all vertices
 * share. */
void iccp_domain_facet_point(const icc_domain *domain, uint32_t facet, const double *bary,
                             double *point)
{
    const size_t dim = domain->tree.dim;
    const double *corners[ICC_MAX_DIM];
    size_t from = 0;
    iccp_facet_corners(&domain->tree, facet, corners);
    for (size_t i = 1; i < dim; ++i)
        from = bary[i] > bary[from] ? i : from;
    for (size_t k = 0; k < dim; ++k) {
        point[k] = corners[from][k];
        for (size_t i = 0; i < dim; ++i)
            if (i != from)
                point[k] += bary[i] * (corners[i][k] - corners[from][k]);
    }
}

icc_status iccp_domain_refuse_holes(const icc_domain *domain, const char *what, icc_error *err)
{
    if (domain->genus == 0 && domain->n_voids == 0)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_TOPOLOGY,
                     "%s must be a ball, but this one has %zu handle%s and %zu void%s", what,
                     domain->genus, domain->genus == 1 ? "" : "s", domain->n_voids,
                     domain->n_voids == 1 ? "" : "s");
}

icc_status iccp_domain_require_ball(const icc_domain *domain, const char *what, icc_error *err)
{
    if (domain->features == NULL)
        return iccp_domain_refuse_holes(domain, what, err);
    return iccp_fail(err, ICC_ERR_UNSUPPORTED, "%s cannot have %s inside: only mesh maps can", what,
                     domain->dim == 2 ? "holes, lines or points"
                                      : "voids, surfaces, lines or points");
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
    domain->ops->clear(domain);
    iccp_mask_free(domain->mask);
    iccp_simplices_free(domain->mesh);
    iccp_free(&memory, domain->given);
    iccp_free(&memory, domain->vertices);
    iccp_free(&memory, domain->facets);
    iccp_free(&memory, domain);
}
