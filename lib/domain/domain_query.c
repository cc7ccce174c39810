/* Where points, lines and segments lie with respect to a domain. */
#include "domain/domain.h"

#include "geometry/away.h"
#include "geometry/inside.h"
#include "geometry/locate.h"
#include "geometry/simplex.h"

#include <math.h>
#include <string.h>

static int32_t locate_in_polygon(const icc_domain *domain, const double *point, bool nearest,
                                 uint32_t *facet, double *bary)
{
    const iccp_location place = iccp_locator_find(domain->locator, point, nearest);
    if (facet != NULL && (nearest || place.where == ICC_BOUNDARY)) {
        *facet = iccp_polygon_facet(&domain->locator->polygon, place.edge);
        bary[0] = 1 - place.t;
        bary[1] = place.t;
    }
    return place.where;
}

static bool finite(size_t dim, const double *point)
{
    for (size_t k = 0; k < dim; ++k)
        if (!isfinite(point[k]))
            return false;
    return true;
}

int32_t iccp_domain_locate(const icc_domain *domain, const double *point, bool boundary_only,
                           uint32_t *facet, double *bary)
{
    const bool nearest = facet != NULL && !boundary_only;
    if (domain->locator != NULL)
        return locate_in_polygon(domain, point, nearest, facet, bary);
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

bool iccp_domain_cross(const icc_domain *domain, const double *from, const double *to,
                       double *share, uint32_t *facet, double *bary)
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

size_t iccp_domain_line(const icc_domain *domain, int32_t axis, const double *point,
                        size_t capacity, iccp_line_crossing *crossings)
{
    double p[ICC_MAX_DIM];
    iccp_away_reach(domain->tree.dim, point, p);
    return iccp_line_crossings(iccp_domain_tree(domain), (size_t)axis, p, capacity, crossings);
}
