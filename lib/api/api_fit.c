/* Checks the arguments of the functions that make maps from what is known in part. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "domain/features.h"
#include "fit/fit.h"

#include <math.h>
#include <string.h>

ICCP_END(fit)

static const double MOST_STIFFNESS = 3, MOST_MARGIN = 1000;

/* ---- constraints ---- */

static icc_status check_arrays(size_t c, const icc_constraint *given, icc_error *err)
{
    const bool has_vertices =
        given->kind == ICC_CONSTRAINT_VERTICES || given->kind == ICC_CONSTRAINT_SLIDING;
    const bool is_sliding = given->kind == ICC_CONSTRAINT_SLIDING;
    const char *wrong = NULL;
    if (has_vertices ? given->vertices == NULL : given->source == NULL)
        wrong = has_vertices ? "vertices is NULL" : "source is NULL";
    else if (has_vertices ? given->source != NULL : given->vertices != NULL)
        wrong = has_vertices ? "source must be NULL" : "vertices must be NULL";
    else if (given->target == NULL && !is_sliding)
        wrong = "target is NULL";
    else if (given->direction != NULL && !is_sliding)
        wrong = "direction must be NULL";
    else if (given->tolerance != NULL && given->kind != ICC_CONSTRAINT_POINTS)
        wrong = "tolerance must be NULL";
    return wrong == NULL
               ? ICC_OK
               : iccp_fail(err, ICC_ERR_ARGUMENT, "icc_constraint.%s in constraint %zu", wrong, c);
}

static icc_status check_constraint(size_t c, const icc_constraint *given, size_t n_before,
                                   bool has_shape, icc_error *err)
{
    const size_t least = given->kind == ICC_CONSTRAINT_LINE ? 2 : 1;
    if (given->kind < ICC_CONSTRAINT_POINTS || given->kind > ICC_CONSTRAINT_SLIDING)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_constraint.kind of constraint %zu is %ld; it must lie in %d..%d", c,
                         (long)given->kind, ICC_CONSTRAINT_POINTS, ICC_CONSTRAINT_SLIDING);
    if (given->n < least || given->n > ICCP_MAX_COUNT - n_before)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_constraint.n of constraint %zu is %zu; it must be at least %zu, and "
                         "at most %zu for all constraints together",
                         c, given->n, least, ICCP_MAX_COUNT);
    if (!has_shape && given->kind != ICC_CONSTRAINT_POINTS && given->kind != ICC_CONSTRAINT_LINE)
        return iccp_fail(
            err, ICC_ERR_UNSUPPORTED,
            "constraint %zu: only points and lines can be told without a domain or mesh", c);
    return check_arrays(c, given, err);
}

/* Reads the caller's constraints. Their size gives the distance from one to the next. */
static icc_status read_constraints(icc_constraint *full, size_t n, const icc_constraint *given,
                                   bool has_shape, icc_error *err)
{
    const size_t stride = given->size;
    size_t n_items = 0;
    for (size_t c = 0; c < n; ++c) {
        const icc_constraint *one = (const icc_constraint *)((const char *)given + c * stride);
        icc_status status = iccp_read_struct(&full[c], sizeof full[c], one, "icc_constraint", err);
        if (status == ICC_OK && full[c].size != stride)
            status =
                iccp_fail(err, ICC_ERR_ARGUMENT,
                          "icc_constraint.size of constraint %zu is not that of constraint 0", c);
        if (status == ICC_OK)
            status = check_constraint(c, &full[c], n_items, has_shape, err);
        if (status != ICC_OK)
            return status;
        n_items += full[c].n;
    }
    return ICC_OK;
}

/* ---- options ---- */

static icc_status check_number(double value, double most, const char *name, icc_error *err)
{
    if (value >= 0 && value <= most && isfinite(value))
        return ICC_OK;
    return most < HUGE_VAL
               ? iccp_fail(err, ICC_ERR_ARGUMENT, "icc_fit_options.%s is %g; it must lie in 0..%g",
                           name, value, most)
               : iccp_fail(err, ICC_ERR_ARGUMENT,
                           "icc_fit_options.%s is %g; it must be finite, at least 0", name, value);
}

static icc_status check_box(const double *box, icc_error *err)
{
    for (int k = 0; box != NULL && k < 2; ++k)
        if (!isfinite(box[k]) || !isfinite(box[k + 2]) || !(box[k] < box[k + 2]))
            return iccp_fail(err, ICC_ERR_ARGUMENT,
                             "icc_fit_options.box: the lower corner comes first, and each side has "
                             "a length");
    return ICC_OK;
}

/* Checks that each option suits the model. */
static icc_status check_model(const icc_fit_options *o, bool has_shape, bool has_mesh,
                              icc_error *err)
{
    const char *wrong = NULL;
    if (o->model == ICC_FIT_SPLINE && has_shape)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "the spline takes neither a domain nor a mesh: leave both out, or take "
                         "the elastic model");
    if (o->model == ICC_FIT_ELASTIC && !has_shape)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "the elastic model needs a domain or a mesh");
    if (has_shape && (o->box != NULL || o->margin > 0 || o->smoothing > 0 || o->smoothing < 0))
        wrong = o->box != NULL ? "box" : o->margin > 0 ? "margin" : "smoothing";
    if (wrong != NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_fit_options.%s is for the spline only", wrong);
    if (!has_shape && (o->reach > 0 || o->stiffness > 0 || o->cell > 0 || o->no_contact))
        wrong = o->reach > 0       ? "reach"
                : o->stiffness > 0 ? "stiffness"
                : o->cell > 0      ? "cell"
                                   : "no_contact";
    if (wrong != NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_fit_options.%s needs a domain or a mesh",
                         wrong);
    if (o->cell > 0 && has_mesh)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_fit_options.cell needs a domain; a mesh is kept as it is");
    if (o->cell_stiffness != NULL && !has_mesh)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_fit_options.cell_stiffness needs a mesh");
    return ICC_OK;
}

static icc_status check_options(const icc_fit_options *o, const icc_domain *domain,
                                const icc_mesh *mesh, icc_error *err)
{
    if (o->model < 0 || o->model > ICC_FIT_ELASTIC)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_fit_options.model is %ld; it must lie in 0..%d", (long)o->model,
                         ICC_FIT_ELASTIC);
    icc_status status = check_box(o->box, err);
    if (status == ICC_OK)
        status = check_number(o->margin, MOST_MARGIN, "margin", err);
    if (status == ICC_OK && !isfinite(o->smoothing))
        status = iccp_fail(err, ICC_ERR_ARGUMENT, "icc_fit_options.smoothing is not finite");
    if (status == ICC_OK)
        status = check_number(o->reach, HUGE_VAL, "reach", err);
    if (status == ICC_OK)
        status = check_number(o->stiffness, MOST_STIFFNESS, "stiffness", err);
    if (status == ICC_OK)
        status = check_number(o->cell, HUGE_VAL, "cell", err);
    if (status == ICC_OK && (o->no_contact < 0 || o->no_contact > 1))
        status =
            iccp_fail(err, ICC_ERR_ARGUMENT, "icc_fit_options.no_contact is %ld; it must be 0 or 1",
                      (long)o->no_contact);
    return status == ICC_OK ? check_model(o, domain != NULL || mesh != NULL, mesh != NULL, err)
                            : status;
}

static icc_status check_cells(const icc_fit_options *o, const icc_mesh *mesh, icc_error *err)
{
    for (size_t k = 0; o->cell_stiffness != NULL && k < mesh->n_cells; ++k)
        if (!(o->cell_stiffness[k] > 0 && isfinite(o->cell_stiffness[k])))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_SIMPLEX, (int64_t)k,
                                "icc_fit_options.cell_stiffness of cell %zu is %g; it must be "
                                "finite and above 0",
                                k, o->cell_stiffness[k]);
    return ICC_OK;
}

/* ---- the shape ---- */

static icc_status check_shape(icc_mesh *full, const icc_domain *domain, const icc_mesh *mesh,
                              icc_error *err)
{
    if (domain != NULL && mesh != NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "pass a domain or a mesh, not both");
    if (domain != NULL && domain->dim != 2)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, "the domain has dimension %ld; it must be 2",
                         (long)domain->dim);
    if (domain != NULL && domain->mask != NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, "the domain is a mask; it must be a polygon");
    if (domain != NULL && domain->features != NULL &&
        domain->features->n_holes < domain->features->n)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "the domain has lines or points inside; pass them as constraints");
    if (mesh == NULL)
        return ICC_OK;
    const icc_status status = iccp_read_faces(full, mesh, err);
    return status != ICC_OK || full->dim == 2
               ? status
               : iccp_fail(err, ICC_ERR_UNSUPPORTED, "the mesh has dimension %ld; it must be 2",
                           (long)full->dim);
}

static icc_status create(icc_fit **out, const icc_domain *domain, const icc_mesh *mesh, size_t n,
                         const icc_constraint *constraints, const icc_fit_options *options,
                         const iccp_env *env, icc_error *err)
{
    icc_mesh full_mesh;
    icc_fit_options full;
    icc_status status = iccp_read_struct(&full, sizeof full, options, "icc_fit_options", err);
    if (status == ICC_OK)
        status = check_shape(&full_mesh, domain, mesh, err);
    if (status == ICC_OK)
        status = check_options(&full, domain, mesh, err);
    if (status == ICC_OK && mesh != NULL)
        status = check_cells(&full, &full_mesh, err);
    if (status != ICC_OK)
        return status;
    icc_constraint *read = iccp_alloc(&env->memory, n, sizeof *read);
    if (read == NULL)
        return iccp_fail_memory(err);
    status = read_constraints(read, n, constraints, domain != NULL || mesh != NULL, err);
    if (status == ICC_OK)
        status = iccp_fit_create(out, domain, mesh != NULL ? &full_mesh : NULL, n, read, &full, env,
                                 err);
    iccp_free(&env->memory, read);
    return status;
}

/* ---- functions ---- */

icc_status icc_fit_create(icc_fit **out, const icc_domain *domain, const icc_mesh *mesh,
                          size_t n_constraints, const icc_constraint *constraints,
                          const icc_fit_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : constraints == NULL ? "constraints" : NULL;
    iccp_env full;
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK && (n_constraints == 0 || n_constraints > ICCP_MAX_COUNT))
        status = iccp_fail(err, ICC_ERR_ARGUMENT, "%zu constraints; there must be 1 to %zu",
                           n_constraints, ICCP_MAX_COUNT);
    if (status != ICC_OK)
        return status;
    status = create(out, domain, mesh, n_constraints, constraints, options, &full, err);
    return iccp_end_fit(status, out, &full, err);
}

icc_status icc_fit_move(icc_fit **out, const icc_fit *fit, const double *targets,
                        const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL       ? "out"
                          : fit == NULL     ? "fit"
                          : targets == NULL ? "targets"
                                            : NULL;
    iccp_env full;
    const icc_status status = iccp_begin(&full, env, missing, err);
    return status == ICC_OK
               ? iccp_end_fit(iccp_fit_move(out, fit, targets, &full, err), out, &full, err)
               : status;
}

void icc_fit_free(icc_fit *fit)
{
    iccp_fit_release(fit);
}

const icc_map *icc_fit_map(const icc_fit *fit)
{
    return fit != NULL ? fit->map : NULL;
}

icc_status icc_fit_get_info(const icc_fit *fit, icc_fit_info *info)
{
    ICCP_ENTER;
    if (fit == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(info, &fit->info, sizeof fit->info, "icc_fit_info", NULL);
}

icc_status icc_fit_get_residuals(const icc_fit *fit, double *residuals, double *left_out)
{
    ICCP_ENTER;
    if (fit == NULL)
        return ICC_ERR_ARGUMENT;
    const size_t size = 2 * fit->told.n * sizeof(double);
    if (residuals != NULL)
        memcpy(residuals, fit->residuals, size);
    if (left_out != NULL)
        memcpy(left_out, fit->left_out, size);
    return ICC_OK;
}
