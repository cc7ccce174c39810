/* Checks the arguments of the function that makes a domain from its boundary. */
#include "api/check.h"
#include "base/env.h"
#include "base/error.h"
#include "domain/domain.h"

ICCP_END(domain)

icc_status icc_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                             const double *vertices, size_t n_facets, const uint32_t *facets,
                             const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "out is NULL");
    *out = NULL;
    if (dim < 1 || dim > ICC_MAX_DIM)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "dim is %ld; it must lie in 1..%d", (long)dim,
                         ICC_MAX_DIM);
    if (dim != 2 && facets == NULL && n_facets > 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "facets is NULL; only those of a polygon can be left out");
    iccp_env full;
    icc_status status = iccp_env_read(&full, env, err);
    if (status == ICC_OK)
        status = iccp_check_counts(n_vertices, vertices, n_facets, facets, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_domain(
        iccp_domain_create(out, dim, n_vertices, vertices, n_facets, facets, &full, err), out,
        &full, err);
}
