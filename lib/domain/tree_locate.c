/* Where points lie with respect to a domain, by the tree of its facets. */
#include "domain/tree_locate.h"

#include "geometry/away.h"
#include "geometry/inside.h"

#include <math.h>
#include <string.h>

const iccp_facet_tree *iccp_tree_own(const icc_domain *domain)
{
    return &domain->tree;
}

static bool finite(size_t dim, const double *point)
{
    for (size_t k = 0; k < dim; ++k)
        if (!isfinite(point[k]))
            return false;
    return true;
}

int32_t iccp_tree_locate(const icc_domain *domain, const double *point, bool boundary_only,
                         uint32_t *facet, double *bary)
{
    const bool nearest = facet != NULL && !boundary_only;
    const size_t dim = domain->tree.dim;
    double p[ICC_MAX_DIM], share[ICC_MAX_DIM];
    uint32_t at = 0;
    int32_t where = ICC_OUTSIDE;
    iccp_away_reach(dim, point, p);
    if (finite(dim, point))
        where = iccp_inside_find(iccp_domain_tree(domain), &domain->band, p, &at, share);
    if (nearest && where != ICC_BOUNDARY)
        at = iccp_facet_tree_nearest_local(iccp_domain_tree(domain), p, share);
    if (facet != NULL && (nearest || where == ICC_BOUNDARY)) {
        *facet = at;
        memcpy(bary, share, dim * sizeof *bary);
    }
    return where;
}
