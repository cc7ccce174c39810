/* Tells which points and coordinates of a chart do not lead to each other. Every one takes the way
 * back, which decides. Then the curve tells why: other curves have joined it, or it has left the
 * domain. Source: L. Huynh, thesis, 2013, section 6.4 (expansion and compression edges, and figure
 * 6.12 with the area that is not covered). */
#include "chart/losses.h"

#include "base/minmax.h"
#include "chart/encode_points.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* Largest distance from the start that counts as coming back, relative to the longest side of the
 * domain's bounding box. The same limit holds for shares of curves. */
static const double AWAY = 1e-6;

static double allowed_distance(const icc_domain *domain)
{
    double side = 0;
    for (int32_t k = 0; k < domain->dim; ++k)
        side = iccp_max(side, domain->upper[k] - domain->lower[k]);
    return AWAY * side;
}

icc_status iccp_encode_losses(const icc_chart *chart, size_t n, const double *points,
                              const iccp_coords *coords, const icc_status *status, int32_t *flags,
                              iccp_path *path)
{
    const icc_domain *domain = chart->domain;
    const size_t dim = (size_t)domain->dim;
    const double allowed = allowed_distance(domain);
    iccp_coords own[ICCP_CHART_MANY];
    double back[ICCP_CHART_MANY * ICC_MAX_DIM];
    icc_status arrived[ICCP_CHART_MANY];
    memcpy(own, coords, n * sizeof *own);
    memcpy(arrived, status, n * sizeof *arrived);
    const icc_status all = iccp_decode_points(chart, n, own, back, NULL, arrived, path);
    for (size_t i = 0; all == ICC_OK && i < n; ++i) {
        double from[ICC_MAX_DIM], to[ICC_MAX_DIM];
        flags[i] = 0;
        if (status[i] != ICC_OK)
            continue;
        iccp_frame_in(&domain->frame, domain->dim, points + dim * i, from);
        iccp_frame_in(&domain->frame, domain->dim, back + dim * i, to);
        if (arrived[i] == ICC_OK && iccp_vec_distance(dim, from, to) <= allowed)
            continue;
        flags[i] = ICC_LOSS_AWAY;
        if (chart->ops->merges_down != NULL && chart->ops->merges_down(chart, from))
            flags[i] |= ICC_LOSS_UNCOVERED;
    }
    return all;
}

/* How close a curve comes to a place. */
typedef struct approach {
    size_t dim, n; /* number of points so far */
    const double *place;
    double last[ICC_MAX_DIM], distance;
} approach;

static icc_status approach_piece(void *argument, const double *local)
{
    approach *a = argument;
    double along = 0, square = 0, nearest[ICC_MAX_DIM];
    if (a->n++ == 0)
        memcpy(a->last, local, a->dim * sizeof *local);
    for (size_t k = 0; k < a->dim; ++k) {
        const double step = local[k] - a->last[k];
        along += step * (a->place[k] - a->last[k]);
        square += step * step;
    }
    const double share = square > 0 ? iccp_max(0, iccp_min(1, along / square)) : 0;
    for (size_t k = 0; k < a->dim; ++k)
        nearest[k] = a->last[k] + share * (local[k] - a->last[k]);
    a->distance = iccp_min(a->distance, iccp_vec_distance(a->dim, nearest, a->place));
    memcpy(a->last, local, a->dim * sizeof *local);
    return ICC_OK;
}

/* Finds out why the point of some coordinates leads to another place of the boundary, or to none
 * (NULL). If the curve passes that place, it enters the domain there once more. Only curves that
 * may merge are asked, which are polylines. */
static icc_status explain(const icc_chart *chart, const iccp_coords *coords, const double *boundary,
                          const double *place, int32_t *flags, iccp_path *path)
{
    const double allowed = allowed_distance(chart->domain);
    const size_t dim = (size_t)chart->domain->dim;
    if (chart->ops->merges_up == NULL)
        return ICC_OK;
    if (chart->ops->merges_up(chart, coords))
        *flags |= ICC_LOSS_COLLAPSED;
    if (place == NULL || iccp_vec_distance(dim, boundary, place) <= allowed)
        return ICC_OK;
    const iccp_chart_place none = {{0}};
    approach a = {.dim = dim, .place = place, .distance = HUGE_VAL};
    const icc_status status =
        chart->ops->trace(chart, boundary, &none, coords, path, approach_piece, &a);
    if (status == ICC_OK && a.distance <= allowed)
        *flags |= ICC_LOSS_GAP;
    return iccp_is_point_status(status) ? ICC_OK : status;
}

icc_status iccp_decode_losses(const icc_chart *chart, size_t n, const iccp_coords *coords,
                              const double *points, const icc_status *status, int32_t *flags,
                              iccp_path *path)
{
    const icc_domain *domain = chart->domain;
    const size_t dim = (size_t)domain->dim;
    const double allowed = allowed_distance(domain);
    iccp_coords found[ICCP_CHART_MANY];
    icc_status arrived[ICCP_CHART_MANY];
    icc_status all = iccp_encode_points(chart, n, points, found, NULL, arrived, path);
    for (size_t i = 0; all == ICC_OK && i < n; ++i) {
        double from[ICC_MAX_DIM], to[ICC_MAX_DIM];
        const bool there = arrived[i] == ICC_OK;
        flags[i] = 0;
        if (status[i] != ICC_OK || (there && coords[i].t >= 1 && found[i].t >= 1))
            continue;
        iccp_domain_facet_point(domain, coords[i].facet, coords[i].bary, from);
        if (there)
            iccp_domain_facet_point(domain, found[i].facet, found[i].bary, to);
        if (there && fabs(coords[i].t - found[i].t) <= AWAY &&
            iccp_vec_distance(dim, from, to) <= allowed)
            continue;
        flags[i] = ICC_LOSS_AWAY;
        all = explain(chart, &coords[i], from, there ? to : NULL, &flags[i], path);
    }
    return all;
}
