/* Where segments and lines cross a domain's boundary, by the tree of its facets. */
#include "domain/tree_cross.h"

#include "geometry/away.h"
#include "geometry/simplex.h"

bool iccp_tree_cross(const icc_domain *domain, const double *from, const double *to, double *share,
                     uint32_t *facet, double *bary)
{
    const size_t dim = domain->tree.dim;
    double ends[2][ICC_MAX_DIM], at[ICC_MAX_DIM];
    const double *corners[ICC_MAX_DIM];
    iccp_away_reach(dim, from, ends[0]);
    iccp_away_reach(dim, to, ends[1]);
    if (!iccp_segment_crossing(iccp_domain_tree(domain), ends[0], ends[1], share, facet))
        return false;
    for (size_t k = 0; k < dim; ++k)
        at[k] = ends[0][k] + *share * (ends[1][k] - ends[0][k]);
    iccp_facet_corners(&domain->tree, *facet, corners);
    (void)iccp_simplex_nearest(dim, dim, corners, *share < 1 ? at : ends[1], bary);
    return true;
}

size_t iccp_tree_line(const icc_domain *domain, int32_t axis, const double *point, size_t capacity,
                      iccp_line_crossing *crossings)
{
    double p[ICC_MAX_DIM];
    iccp_away_reach(domain->tree.dim, point, p);
    return iccp_line_crossings(iccp_domain_tree(domain), (size_t)axis, p, capacity, crossings);
}
