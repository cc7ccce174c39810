/* The map takes each facet of the cage linearly to its image, so a point that is taken to the cage
 * gets its image from the facet alone, and no rounding can put it outside again. */
#include "geo/carrier.h"

#include "base/allocate.h"
#include "geo/inner_point.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The outer ring has the inside on its left if it is counter-clockwise, a hole if it is not. */
static void find_holes(carrier *c, const icc_domain_info *domain)
{
    c->reversed = need(c->n_facets, sizeof *c->reversed);
    c->in_holes = need(domain->n_features, 2 * sizeof *c->in_holes);
    for (size_t i = 0; i < c->n_facets; i++)
        c->reversed[i] = domain->orientation < 0;
    for (size_t k = 0; k < domain->n_features; k++) {
        icc_feature_info hole = {.size = sizeof hole};
        icc_domain_get_feature(c->from, k, &hole);
        if (hole.kind != ICC_FEATURE_HOLE)
            continue;
        for (size_t i = 0; i < hole.n_vertices; i++)
            c->reversed[hole.first_facet + i] = hole.orientation > 0;
        inner_point(hole.n_vertices, c->vertices[0] + 2 * hole.first_vertex,
                    c->in_holes + 2 * c->n_holes++);
    }
}

icc_status carrier_start(carrier *out, const icc_map *map, const icc_domain *from,
                         const icc_domain *to, bool inverse, double snap, const icc_env *env)
{
    icc_domain_info info[2] = {{.size = sizeof *info}, {.size = sizeof *info}};
    const icc_domain *sides[2] = {from, to};
    *out = (carrier){.map = map, .from = from, .env = env, .inverse = inverse};
    for (size_t side = 0; side < 2; side++) {
        icc_status status = icc_domain_get_info(sides[side], &info[side]);
        if (status != ICC_OK)
            return status;
        size_t dim = (size_t)info[side].dim;
        out->vertices[side] = need(info[side].n_vertices, dim * sizeof(double));
        out->facets[side] = need(info[side].n_facets, dim * sizeof(uint32_t));
        status = icc_domain_get_boundary(sides[side], out->vertices[side], out->facets[side]);
        if (status != ICC_OK)
            return status;
    }
    out->dim = (size_t)info[0].dim;
    out->n_vertices = info[0].n_vertices;
    out->n_facets = info[0].n_facets;
    if (out->dim == 2)
        find_holes(out, &info[0]);
    double largest = 0;
    for (size_t k = 0; k < out->dim; k++) {
        out->lower[k] = info[0].lower[k];
        out->upper[k] = info[0].upper[k];
        out->size = fmax(out->size, info[0].upper[k] - info[0].lower[k]);
        largest = fmax(largest, fmax(fabs(info[0].lower[k]), fabs(info[0].upper[k])));
    }
    /* Sides that do not correspond facet by facet have no image to snap to. */
    bool matched = info[0].n_facets == info[1].n_facets;
    out->snap = !matched ? 0 : snap >= 0 ? snap : fmax(1e-9 * out->size, 4 * DBL_EPSILON * largest);
    return ICC_OK;
}

void carrier_free(carrier *c)
{
    for (size_t side = 0; side < 2; side++) {
        free(c->vertices[side]);
        free(c->facets[side]);
    }
    free(c->reversed);
    free(c->in_holes);
    *c = (carrier){0};
}

void carrier_facet_point(const carrier *c, size_t side, uint32_t facet, const double *shares,
                         double *point)
{
    const uint32_t *corners = c->facets[side] + c->dim * facet;
    for (size_t k = 0; k < c->dim; k++) {
        point[k] = 0;
        for (size_t i = 0; i < c->dim; i++)
            point[k] += shares[i] * c->vertices[side][c->dim * corners[i] + k];
    }
}

icc_status carrier_nearest(const carrier *c, const double *point, uint32_t *facet, double *shares,
                           double *distance)
{
    int32_t where;
    double nearest[ICC_MAX_DIM], square = 0;
    icc_status status = icc_domain_locate(c->from, 1, point, &where, facet, shares, c->env);
    if (status != ICC_OK)
        return status;
    carrier_facet_point(c, 0, *facet, shares, nearest);
    for (size_t k = 0; k < c->dim; k++)
        square += (point[k] - nearest[k]) * (point[k] - nearest[k]);
    *distance = sqrt(square);
    return ICC_OK;
}

/* Whether a point is so near to the cage's box that it may be snapped; most outside are not. */
static bool may_snap(const carrier *c, const double *point)
{
    for (size_t k = 0; k < c->dim; k++)
        if (!(point[k] >= c->lower[k] - 2 * c->snap && point[k] <= c->upper[k] + 2 * c->snap))
            return false;
    return c->snap > 0;
}

icc_status carrier_map(const carrier *c, size_t n, const double *points, double *images,
                       icc_status *status, bool *snapped)
{
    size_t n_failed;
    if (snapped != NULL)
        memset(snapped, 0, n * sizeof *snapped);
    icc_status ran = (c->inverse ? icc_map_apply_inverse : icc_map_apply)(
        c->map, n, points, images, status, &n_failed, c->env);
    for (size_t i = 0; i < n && n_failed > 0 && ran == ICC_OK; i++) {
        const double *point = points + c->dim * i;
        uint32_t facet;
        double shares[ICC_MAX_DIM], distance;
        if (status[i] != ICC_ERR_OUTSIDE || !may_snap(c, point))
            continue;
        ran = carrier_nearest(c, point, &facet, shares, &distance);
        if (ran != ICC_OK || !(distance <= c->snap))
            continue;
        carrier_facet_point(c, 1, facet, shares, images + c->dim * i);
        status[i] = ICC_OK;
        if (snapped != NULL)
            snapped[i] = true;
    }
    return ran;
}
