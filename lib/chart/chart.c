/* The chart object, and the operations on one point that all methods share. */
#include "chart/chart.h"

#include <math.h>
#include <string.h>

icc_status iccp_chart_new(icc_chart **out, const icc_domain *domain, const iccp_env *env)
{
    icc_chart *chart = iccp_alloc_zero(&env->memory, 1, sizeof *chart);
    *out = chart;
    if (chart == NULL)
        return ICC_ERR_MEMORY;
    chart->memory = env->memory;
    atomic_init(&chart->references, 1);
    chart->domain = iccp_domain_retain(domain);
    chart->info.dim = domain->dim;
    return ICC_OK;
}

icc_chart *iccp_chart_retain(const icc_chart *chart)
{
    icc_chart *shared = (icc_chart *)chart;
    atomic_fetch_add(&shared->references, 1);
    return shared;
}

void iccp_chart_release(icc_chart *chart)
{
    if (chart == NULL || atomic_fetch_sub(&chart->references, 1) != 1)
        return;
    if (chart->state != NULL)
        chart->ops->free_state(chart);
    iccp_domain_release(chart->domain);
    const iccp_memory memory = chart->memory;
    iccp_free(&memory, chart);
}

void iccp_chart_set_maximum(icc_chart *chart, const double *local)
{
    const icc_domain *domain = chart->domain;
    memcpy(chart->maximum, local, (size_t)domain->dim * sizeof *local);
    iccp_frame_out(&domain->frame, domain->dim, local, chart->info.maximum);
}

/* ---- one local point ---- */

enum { MAXIMUM = ICC_OUTSIDE + 1 }; /* in addition to ICC_INSIDE, ICC_BOUNDARY and ICC_OUTSIDE */

static bool is_maximum(const icc_chart *chart, const double *point)
{
    for (int32_t k = 0; k < chart->domain->dim; ++k)
        if (!(fabs(point[k] - chart->maximum[k]) <= chart->domain->band.tolerance))
            return false;
    return true;
}

/* The maximum belongs to every boundary point. Its coordinates name the middle of facet 0. */
static void put_maximum(int32_t dim, iccp_coords *coords)
{
    *coords = (iccp_coords){.facet = 0, .t = 1};
    for (int32_t k = 0; k < dim; ++k)
        coords->bary[k] = 1.0 / dim;
}

bool iccp_chart_is_shelling(const icc_chart *chart)
{
    return chart->ops->number == ICC_METHOD_FOLIATION && chart->ops->needs_mesh;
}

/* Locates a point. The maximum has priority over the boundary. It may lie in a corridor so
 * narrow that all of it counts as boundary, and must still be found. */
static int32_t locate(const icc_chart *chart, const double *point, iccp_chart_place *place,
                      iccp_coords *coords)
{
    const int32_t where =
        chart->ops->locate != NULL
            ? chart->ops->locate(chart, point, place, coords)
            : iccp_domain_locate(chart->domain, point, true, &coords->facet, coords->bary);
    coords->t = 0;
    if (where == ICC_OUTSIDE || !is_maximum(chart, point))
        return where;
    put_maximum(chart->domain->dim, coords);
    return MAXIMUM;
}

bool iccp_chart_is_trivial(const icc_chart *chart, const double *point, iccp_chart_place *place,
                           iccp_coords *coords, icc_status *status)
{
    const int32_t where = locate(chart, point, place, coords);
    *status = where == ICC_OUTSIDE ? ICC_ERR_OUTSIDE : ICC_OK;
    return where != ICC_INSIDE;
}

bool iccp_chart_is_end(const icc_chart *chart, const iccp_coords *coords, double *point)
{
    if (coords->t >= 1)
        memcpy(point, chart->maximum, (size_t)chart->domain->dim * sizeof *point);
    else if (coords->t <= 0)
        iccp_domain_facet_point(chart->domain, coords->facet, coords->bary, point);
    else
        return false;
    return true;
}

icc_status iccp_chart_encode(const icc_chart *chart, const double *point, iccp_coords *coords,
                             iccp_encode_jet *jet)
{
    iccp_chart_place place;
    icc_status status;
    if (!iccp_chart_is_trivial(chart, point, &place, coords, &status))
        return chart->ops->encode(chart, point, &place, coords, jet);
    return status == ICC_OK && jet != NULL ? ICC_ERR_TRACE : status;
}

icc_status iccp_chart_encode_vertex(const icc_chart *chart, size_t v, iccp_coords *coords)
{
    if (chart->ops->encode_vertex == NULL)
        return iccp_chart_encode(chart, chart->mesh->points + 2 * v, coords, NULL);
    chart->ops->encode_vertex(chart, v, coords);
    return ICC_OK;
}

icc_status iccp_chart_decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path)
{
    if (!iccp_chart_is_end(chart, coords, point))
        return chart->ops->decode(chart, coords, point, jet, path);
    return jet != NULL ? ICC_ERR_TRACE : ICC_OK;
}

icc_status iccp_chart_ready(const icc_chart *chart, bool decodes)
{
    return chart->ops->ready != NULL ? chart->ops->ready(chart, decodes) : ICC_OK;
}

icc_status iccp_chart_trace(const icc_chart *chart, const double *point, iccp_path *path,
                            iccp_emit emit, void *argument)
{
    iccp_chart_place place;
    iccp_coords coords;
    const int32_t where = locate(chart, point, &place, &coords);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    if (where == MAXIMUM)
        return emit(argument, point);
    return chart->ops->trace(chart, point, &place, where == ICC_BOUNDARY ? &coords : NULL, path,
                             emit, argument);
}
