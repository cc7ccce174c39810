/* Checks the arguments of the functions on integral curves. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "gradient/coordinates/integral_curves.h"
#include "icc/stages.h"

#include <math.h>
#include <string.h>

ICCP_END(curves)

icc_status icc_curves_create(icc_curves **out, const icc_function *function, size_t n,
                             const double *points, int32_t way, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL               ? "out"
                          : function == NULL        ? "function"
                          : n > 0 && points == NULL ? "points"
                                                    : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (way != ICC_WAY_UP && way != ICC_WAY_DOWN)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "way is %ld; it must be ICC_WAY_UP or ICC_WAY_DOWN",
                         (long)way);
    const size_t dim = (size_t)function->tree->grid->dim;
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < dim; ++k)
            if (!isfinite(points[dim * i + k]))
                return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                    "point %zu is not finite", i);
    status = iccp_curves_create(out, function, n, points, way, &full_env);
    return iccp_end_curves(iccp_explain(err, status), out, &full_env, err);
}

void icc_curves_free(icc_curves *curves)
{
    iccp_curves_release(curves);
}

icc_status icc_curves_get_info(const icc_curves *curves, icc_curves_info *info)
{
    ICCP_ENTER;
    if (curves == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    icc_curves_info full = {.dim = curves->dim,
                            .way = curves->way,
                            .n_curves = curves->n,
                            .n_vertices = curves->first[curves->n]};
    for (size_t i = 0; i < curves->n; ++i)
        full.n_merged += curves->alone[i] < curves->length[i];
    return iccp_write_struct(info, &full, sizeof full, "icc_curves_info", NULL);
}

/* Copies an array that the caller wants. */
static void copy(void *to, const void *from, size_t n, size_t size)
{
    if (to != NULL && n > 0)
        memcpy(to, from, n * size);
}

icc_status icc_curves_get_vertices(const icc_curves *curves, size_t *first, double *vertices)
{
    ICCP_ENTER;
    if (curves == NULL)
        return ICC_ERR_ARGUMENT;
    copy(first, curves->first, curves->n + 1, sizeof *first);
    copy(vertices, curves->vertices, curves->first[curves->n] * (size_t)curves->dim,
         sizeof *vertices);
    return ICC_OK;
}

icc_status icc_curves_get_ends(const icc_curves *curves, int32_t *ends, double *lengths,
                               double *alone, uint32_t *facets, double *bary)
{
    ICCP_ENTER;
    if (curves == NULL)
        return ICC_ERR_ARGUMENT;
    copy(ends, curves->end, curves->n, sizeof *ends);
    copy(lengths, curves->length, curves->n, sizeof *lengths);
    copy(alone, curves->alone, curves->n, sizeof *alone);
    copy(facets, curves->facet, curves->n, sizeof *facets);
    copy(bary, curves->bary, curves->n * (size_t)curves->dim, sizeof *bary);
    return ICC_OK;
}
