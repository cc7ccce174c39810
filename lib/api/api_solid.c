/* Checks the arguments of the function that makes solids with features. */
#include "api/check.h"
#include "api/read_features.h"
#include "domain/solid_domain.h"

ICCP_END(domain)

/* Reads the features and makes the solid. */
static icc_status create_solid(icc_domain **out, const iccp_outer *outer, size_t n_features,
                               const icc_feature *features, const iccp_env *env, icc_error *err)
{
    icc_feature *full;
    icc_status status = iccp_read_features(&full, 3, outer->n_vertices, outer->n_facets, n_features,
                                           features, &env->memory, err);
    if (status == ICC_OK)
        status = iccp_domain_create_solid(out, outer, n_features, full, env, err);
    iccp_free(&env->memory, full);
    return status;
}

icc_status icc_domain_create_solid(icc_domain **out, size_t n_vertices, const double *vertices,
                                   size_t n_facets, const uint32_t *facets, size_t n_features,
                                   const icc_feature *features, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full;
    const char *missing = out == NULL        ? "out"
                          : vertices == NULL ? "vertices"
                          : facets == NULL   ? "facets"
                                             : NULL;
    const iccp_outer outer = {n_vertices, n_facets, vertices, facets};
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK)
        status = iccp_check_counts(n_vertices, vertices, n_facets, facets, err);
    if (status != ICC_OK)
        return status;
    status = n_features == 0
                 ? iccp_domain_create(out, 3, n_vertices, vertices, n_facets, facets, &full, err)
                 : create_solid(out, &outer, n_features, features, &full, err);
    return iccp_end_domain(status, out, &full, err);
}
