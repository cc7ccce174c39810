/* Makes and moves fits. */
#include "fit/fit.h"

#include "base/error.h"
#include "base/threads.h"
#include "fit/elastic_fit.h"
#include "fit/elastic_shape.h"
#include "fit/spline/spline.h"
#include "fit/spline_fit.h"

#include <string.h>

void iccp_fit_release(icc_fit *fit)
{
    if (fit == NULL)
        return;
    const iccp_memory memory = fit->memory;
    iccp_map_release(fit->map);
    iccp_told_free(&fit->told);
    iccp_free(&memory, fit->residuals);
    iccp_free(&memory, fit->left_out);
    iccp_spline_base_release(fit->base);
    iccp_elastic_shape_release(fit->shape);
    iccp_free(&memory, fit->images);
    iccp_free(&memory, fit->off);
    iccp_free(&memory, fit);
}

/* Allocates a fit without a map. */
static icc_status begin(icc_fit **out, const icc_fit_options *options, const iccp_env *env)
{
    icc_fit *fit = iccp_alloc_zero(&env->memory, 1, sizeof *fit);
    *out = fit;
    if (fit == NULL)
        return ICC_ERR_MEMORY;
    fit->memory = fit->told.memory = env->memory;
    fit->options = *options;
    if (options->box != NULL) {
        memcpy(fit->box, options->box, sizeof fit->box);
        fit->options.box = fit->box;
    }
    return ICC_OK;
}

static icc_status make_room(icc_fit *fit)
{
    const size_t n = fit->told.n;
    fit->info.n_items = n;
    fit->info.model = fit->options.model;
    fit->residuals = iccp_alloc(&fit->memory, n, 2 * sizeof *fit->residuals);
    fit->left_out = iccp_alloc(&fit->memory, n, 2 * sizeof *fit->left_out);
    return fit->residuals != NULL && fit->left_out != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Gives an elastic fit its shape, and the state where it begins: that of `before`, or NULL for the
 * shape itself. */
static icc_status take_shape(icc_fit *fit, iccp_elastic_shape *shape, const icc_fit *before)
{
    const size_t n = shape->n_points;
    fit->shape = shape;
    fit->images = iccp_alloc(&fit->memory, n, 2 * sizeof *fit->images);
    fit->off = iccp_alloc_zero(&fit->memory, n, sizeof *fit->off);
    if (fit->images == NULL || fit->off == NULL)
        return ICC_ERR_MEMORY;
    memcpy(fit->images, before != NULL ? before->images : shape->points,
           2 * n * sizeof *fit->images);
    if (before != NULL)
        memcpy(fit->off, before->off, n * sizeof *fit->off);
    return ICC_OK;
}

static icc_status solve(icc_fit *fit, const iccp_env *env, icc_error *err)
{
    return fit->shape != NULL ? iccp_elastic_fit(fit, env, err) : iccp_spline_fit(fit, env, err);
}

static icc_status create(icc_fit *fit, const icc_domain *domain, const icc_mesh *mesh, size_t n,
                         const icc_constraint *constraints, const iccp_env *env, icc_error *err)
{
    const bool has_shape = domain != NULL || mesh != NULL;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    if (fit->options.model == 0)
        fit->options.model = has_shape ? ICC_FIT_ELASTIC : ICC_FIT_SPLINE;
    icc_status status = iccp_told_create(&fit->told, n, constraints, env, err);
    if (status == ICC_OK)
        status = make_room(fit);
    iccp_elastic_shape *shape = NULL;
    if (status == ICC_OK && has_shape)
        status = iccp_elastic_shape_create(&shape, domain, mesh, &fit->told, &fit->options,
                                           &part[0], err);
    if (status == ICC_OK && has_shape)
        status = take_shape(fit, shape, NULL);
    return status == ICC_OK ? solve(fit, has_shape ? &part[1] : env, err) : status;
}

/* Ends both ways of making a fit. */
static icc_status end(icc_fit **out, icc_status status, icc_error *err)
{
    if (status == ICC_OK)
        return status;
    iccp_fit_release(*out);
    *out = NULL;
    return iccp_explain(err, status);
}

icc_status iccp_fit_create(icc_fit **out, const icc_domain *domain, const icc_mesh *mesh, size_t n,
                           const icc_constraint *constraints, const icc_fit_options *options,
                           const iccp_env *env, icc_error *err)
{
    iccp_team team;
    iccp_env with;
    iccp_with_team(&with, &team, env);
    icc_status status = begin(out, options, env);
    if (status == ICC_OK)
        status = create(*out, domain, mesh, n, constraints, &with, err);
    iccp_without_team(&with, env);
    return end(out, status, err);
}

static icc_status move(icc_fit *next, const icc_fit *fit, const double *targets,
                       const iccp_env *env, icc_error *err)
{
    next->is_moved = true;
    icc_status status = iccp_told_aim(&next->told, &fit->told, targets, env, err);
    if (status == ICC_OK)
        status = make_room(next);
    if (status == ICC_OK && fit->base != NULL)
        next->base = iccp_spline_base_retain(fit->base);
    if (status == ICC_OK && fit->shape != NULL)
        status = take_shape(next, iccp_elastic_shape_retain(fit->shape), fit);
    return status == ICC_OK ? solve(next, env, err) : status;
}

icc_status iccp_fit_move(icc_fit **out, const icc_fit *fit, const double *targets,
                         const iccp_env *env, icc_error *err)
{
    iccp_team team;
    iccp_env with;
    iccp_with_team(&with, &team, env);
    icc_status status = begin(out, &fit->options, env);
    if (status == ICC_OK)
        status = move(*out, fit, targets, &with, err);
    iccp_without_team(&with, env);
    return end(out, status, err);
}
