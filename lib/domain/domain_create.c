/* Makes domains from boundaries of any dimension. */
#include "domain/domain.h"
#include "domain/polygon_domain.h"
#include "domain/simplicial_domain.h"

icc_status iccp_domain_create(icc_domain **out, int32_t dim, size_t n_vertices,
                              const double *vertices, size_t n_facets, const uint32_t *facets,
                              const iccp_env *env, icc_error *err)
{
    return dim == 2
               ? iccp_polygon_domain_create(out, n_vertices, vertices, n_facets, facets, env, err)
               : iccp_simplicial_domain_create(out, dim, n_vertices, vertices, n_facets, facets,
                                               env, err);
}
