/* Checks the arguments of the chart functions. Those that name every method are in
 * api_chart_create.c and api_chart_file.c. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "chart/encode_all.h"
#include "gradient/coordinates/chart_gradient.h"
#include "gradient/function/critical_points.h"

#include <math.h>
#include <string.h>

ICCP_END(chart)

/* Checks that a function can have a chart: its grid covers a domain, and curves can end at the
 * root. */
static icc_status check_for_chart(const icc_function *function, icc_error *err)
{
    const icc_tree *tree = function->tree;
    const icc_grid *grid = tree->grid;
    if (grid->domain == NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         grid->cells > 0
                             ? "the grid was refined and does not belong to its domain any more: "
                               "make one with twice the cells by icc_grid_create()"
                             : "the grid comes from a mask of vertices and has no domain: make one "
                               "by icc_grid_create()");
    const uint32_t above = iccp_function_above(function, tree->root);
    if (above == ICCP_NONE)
        return ICC_OK;
    return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_GRID_VERTEX, above,
                        "the function is higher at vertex %lu than at the root beside it, so no "
                        "curve ends at the root: grow the tree from a maximum",
                        (unsigned long)above);
}

icc_status icc_chart_create_function(icc_chart **out, const icc_function *function,
                                     const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : function == NULL ? "function" : NULL;
    iccp_env full_env;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = check_for_chart(function, err);
    if (status != ICC_OK)
        return status;
    status = iccp_explain(err, iccp_gradient_create_function(out, function, &full_env));
    return iccp_end_chart(status, out, &full_env, err);
}

void icc_chart_free(icc_chart *chart)
{
    iccp_chart_release(chart);
}

icc_status icc_chart_get_info(const icc_chart *chart, icc_chart_info *info)
{
    ICCP_ENTER;
    if (chart == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(info, &chart->info, sizeof chart->info, "icc_chart_info", NULL);
}

/* Writes the members that only one method has. Fails with ICC_ERR_UNSUPPORTED for charts of other
 * methods. */
static icc_status write_own(const icc_chart *chart, int32_t method, bool shelling, void *info,
                            const void *own, size_t size, const char *name)
{
    if (chart->info.method != method || iccp_chart_is_shelling(chart) != shelling)
        return ICC_ERR_UNSUPPORTED;
    return iccp_write_struct(info, own, size, name, NULL);
}

icc_status icc_chart_get_gradient_info(const icc_chart *chart, icc_gradient_info *info)
{
    ICCP_ENTER;
    if (chart == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return write_own(chart, ICC_METHOD_GRADIENT, false, info, &chart->own.gradient,
                     sizeof chart->own.gradient, "icc_gradient_info");
}

icc_status icc_chart_get_field_info(const icc_chart *chart, icc_field_info *info)
{
    ICCP_ENTER;
    if (chart == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return write_own(chart, ICC_METHOD_FIELD, false, info, &chart->own.field,
                     sizeof chart->own.field, "icc_field_info");
}

icc_status icc_chart_get_foliation_info(const icc_chart *chart, icc_foliation_info *info)
{
    ICCP_ENTER;
    if (chart == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return write_own(chart, ICC_METHOD_FOLIATION, false, info, &chart->own.foliation,
                     sizeof chart->own.foliation, "icc_foliation_info");
}

icc_status icc_chart_get_shelling_info(const icc_chart *chart, icc_shelling_info *info)
{
    ICCP_ENTER;
    if (chart == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return write_own(chart, ICC_METHOD_FOLIATION, true, info, &chart->own.shelling,
                     sizeof chart->own.shelling, "icc_shelling_info");
}

icc_status icc_chart_get_disc_info(const icc_chart *chart, icc_disc_info *info)
{
    ICCP_ENTER;
    if (chart == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return write_own(chart, ICC_METHOD_DISC, false, info, &chart->own.disc, sizeof chart->own.disc,
                     "icc_disc_info");
}

icc_status icc_chart_get_timings(const icc_chart *chart, icc_chart_timings *timings)
{
    ICCP_ENTER;
    if (chart == NULL || timings == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(timings, &chart->timings, sizeof chart->timings, "icc_chart_timings",
                             NULL);
}

const icc_domain *icc_chart_domain(const icc_chart *chart)
{
    return chart != NULL ? chart->domain : NULL;
}

const icc_function *icc_chart_function(const icc_chart *chart)
{
    return chart != NULL && chart->ops->function != NULL ? chart->ops->function(chart) : NULL;
}

icc_status icc_chart_get_report(const icc_chart *chart, size_t n_points, icc_chart_report *measures,
                                const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = chart == NULL ? "chart" : measures == NULL ? "measures" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (n_points > UINT32_MAX)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_chart_get_report: %zu points are too many",
                         n_points);
    icc_chart_report full = {0};
    if (status == ICC_OK && chart->ops->measure != NULL)
        status = iccp_finish(&full_env, chart->ops->measure(chart, n_points > 0 ? n_points : 4096,
                                                            &full, &full_env));
    return status == ICC_OK
               ? iccp_write_struct(measures, &full, sizeof full, "icc_chart_report", err)
               : iccp_explain(err, status);
}

static icc_status encode(const icc_chart *chart, size_t n, const double *points, uint32_t *facet,
                         double *bary, double *t, icc_status *status, int32_t *flags,
                         size_t *n_failed, const icc_env *env)
{
    if (chart == NULL || (n > 0 && (points == NULL || facet == NULL || bary == NULL || t == NULL)))
        return ICC_ERR_ARGUMENT;
    iccp_env full_env;
    const icc_status read = iccp_env_read(&full_env, env, NULL);
    if (read != ICC_OK)
        return read;
    return iccp_finish(&full_env, iccp_encode_all(chart, n, points, facet, bary, t, status, flags,
                                                  n_failed, &full_env));
}

icc_status icc_chart_encode(const icc_chart *chart, size_t n, const double *points, uint32_t *facet,
                            double *bary, double *t, icc_status *status, size_t *n_failed,
                            const icc_env *env)
{
    ICCP_ENTER;
    return encode(chart, n, points, facet, bary, t, status, NULL, n_failed, env);
}

icc_status icc_chart_encode_flags(const icc_chart *chart, size_t n, const double *points,
                                  uint32_t *facet, double *bary, double *t, icc_status *status,
                                  int32_t *flags, size_t *n_failed, const icc_env *env)
{
    ICCP_ENTER;
    return encode(chart, n, points, facet, bary, t, status, flags, n_failed, env);
}

static icc_status decode(const icc_chart *chart, size_t n, const uint32_t *facet,
                         const double *bary, const double *t, double *points, icc_status *status,
                         int32_t *flags, size_t *n_failed, const icc_env *env)
{
    if (chart == NULL || (n > 0 && (points == NULL || facet == NULL || bary == NULL || t == NULL)))
        return ICC_ERR_ARGUMENT;
    iccp_env full_env;
    const icc_status read = iccp_env_read(&full_env, env, NULL);
    if (read != ICC_OK)
        return read;
    return iccp_finish(&full_env, iccp_decode_all(chart, n, facet, bary, t, points, status, flags,
                                                  n_failed, &full_env));
}

icc_status icc_chart_decode(const icc_chart *chart, size_t n, const uint32_t *facet,
                            const double *bary, const double *t, double *points, icc_status *status,
                            size_t *n_failed, const icc_env *env)
{
    ICCP_ENTER;
    return decode(chart, n, facet, bary, t, points, status, NULL, n_failed, env);
}

icc_status icc_chart_decode_flags(const icc_chart *chart, size_t n, const uint32_t *facet,
                                  const double *bary, const double *t, double *points,
                                  icc_status *status, int32_t *flags, size_t *n_failed,
                                  const icc_env *env)
{
    ICCP_ENTER;
    return decode(chart, n, facet, bary, t, points, status, flags, n_failed, env);
}

typedef struct polyline {
    const iccp_frame *frame;
    int32_t dim;
    size_t capacity, n;
    double *points;
} polyline;

static icc_status append(void *argument, const double *local)
{
    polyline *line = argument;
    if (line->n < line->capacity)
        iccp_frame_out(line->frame, line->dim, local, line->points + (size_t)line->dim * line->n);
    ++line->n;
    return ICC_OK;
}

icc_status icc_chart_trace(const icc_chart *chart, const double *point, size_t capacity,
                           double *curve, size_t *n_curve, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (n_curve != NULL)
        *n_curve = 0;
    iccp_env full_env;
    const char *missing = chart == NULL                   ? "chart"
                          : point == NULL                 ? "point"
                          : n_curve == NULL               ? "n_curve"
                          : capacity > 0 && curve == NULL ? "curve"
                                                          : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    const int32_t dim = chart->domain->dim;
    for (int32_t k = 0; k < dim; ++k)
        if (!isfinite(point[k]))
            return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_chart_trace: the point is not finite");
    double local[ICC_MAX_DIM];
    iccp_frame_in(&chart->domain->frame, dim, point, local);
    polyline line = {&chart->domain->frame, dim, capacity, 0, curve};
    iccp_path path;
    iccp_path_init(&path, &full_env.memory);
    status = iccp_chart_trace(chart, local, &path, append, &line);
    iccp_path_clear(&path);
    if (status == ICC_ERR_OUTSIDE)
        return iccp_fail(err, status, "the point is outside the domain");
    if (status == ICC_ERR_TRACE)
        return iccp_fail(err, status,
                         "the curve through the point does not reach the boundary and the maximum");
    if (status != ICC_OK)
        return iccp_fail_memory(err);
    *n_curve = line.n;
    return ICC_OK;
}
