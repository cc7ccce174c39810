/* Checks the arguments of the function that makes a domain from a mesh. */
#include "api/check.h"
#include "base/env.h"
#include "domain/mesh_domain.h"

ICCP_END(domain)

icc_status icc_domain_create_mesh(icc_domain **out, const icc_mesh *mesh, size_t n_facets,
                                  const uint32_t *facets, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : mesh == NULL ? "mesh" : NULL;
    iccp_env full;
    icc_mesh m;
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_solid_mesh(&m, mesh, err);
    if (status == ICC_OK)
        status = iccp_check_counts(m.n_vertices, m.vertices, n_facets, facets, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_domain(iccp_domain_create_mesh(out, &m, n_facets, facets, &full, err), out,
                           &full, err);
}
