/* Collects the caller's constraints in one list of items. */
#include "fit/told.h"

#include "base/error.h"

#include <math.h>
#include <string.h>

static bool are_finite(const double *point)
{
    return isfinite(point[0]) && isfinite(point[1]);
}

static icc_status allocate(iccp_told *told, size_t n, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    *told = (iccp_told){.memory = *memory, .n = n};
    told->kind = iccp_alloc(memory, n, sizeof *told->kind);
    told->joined = iccp_alloc_zero(memory, n, sizeof *told->joined);
    told->vertex = iccp_alloc(memory, n, sizeof *told->vertex);
    told->source = iccp_alloc(memory, n, 2 * sizeof *told->source);
    told->target = iccp_alloc(memory, n, 2 * sizeof *told->target);
    told->direction = iccp_alloc(memory, n, 2 * sizeof *told->direction);
    told->tolerance = iccp_alloc(memory, n, sizeof *told->tolerance);
    return told->kind != NULL && told->joined != NULL && told->vertex != NULL &&
                   told->source != NULL && told->target != NULL && told->direction != NULL &&
                   told->tolerance != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

void iccp_told_free(iccp_told *told)
{
    const iccp_memory memory = told->memory;
    iccp_free(&memory, told->kind);
    iccp_free(&memory, told->joined);
    iccp_free(&memory, told->vertex);
    iccp_free(&memory, told->source);
    iccp_free(&memory, told->target);
    iccp_free(&memory, told->direction);
    iccp_free(&memory, told->tolerance);
    *told = (iccp_told){.memory = memory};
}

static void copy_pair(double *to, const double *from, size_t k)
{
    to[0] = from != NULL ? from[2 * k] : NAN;
    to[1] = from != NULL ? from[2 * k + 1] : NAN;
}

static icc_status check_item(const iccp_told *told, size_t i, icc_error *err)
{
    const bool is_sliding = told->kind[i] == ICC_CONSTRAINT_SLIDING;
    const double *d = told->direction + 2 * i, *target = told->target + 2 * i;
    if (told->vertex[i] == UINT32_MAX && !are_finite(told->source + 2 * i)) {
        (void)iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                           "point %zu is not finite", i);
        return iccp_fail_side(err, ICC_ERR_ARGUMENT, 1);
    }
    if (!are_finite(target) && !(is_sliding && isnan(target[0]) && isnan(target[1]))) {
        (void)iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                           "the target of point %zu is not finite", i);
        return iccp_fail_side(err, ICC_ERR_ARGUMENT, 2);
    }
    if (is_sliding && !(isnan(d[0]) && isnan(d[1])) &&
        (!are_finite(d) || !(fabs(d[0]) + fabs(d[1]) > 0)))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                            "the direction of point %zu is not finite, or it is 0", i);
    if (!(told->tolerance[i] >= 0 && isfinite(told->tolerance[i])))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                            "the tolerance of point %zu is %g; it must be finite and not negative",
                            i, told->tolerance[i]);
    return ICC_OK;
}

static icc_status fill_in(iccp_told *told, size_t n, const icc_constraint *constraints,
                          icc_error *err)
{
    size_t i = 0;
    icc_status status = ICC_OK;
    for (size_t c = 0; c < n; ++c)
        for (size_t k = 0; status == ICC_OK && k < constraints[c].n; ++k, ++i) {
            const icc_constraint *given = &constraints[c];
            told->kind[i] = given->kind;
            told->joined[i] = given->kind == ICC_CONSTRAINT_LINE && k > 0;
            told->vertex[i] = given->vertices != NULL ? given->vertices[k] : UINT32_MAX;
            copy_pair(told->source + 2 * i, given->source, k);
            copy_pair(told->target + 2 * i, given->target, k);
            copy_pair(told->direction + 2 * i, given->direction, k);
            told->tolerance[i] = given->tolerance != NULL ? given->tolerance[k] : 0;
            status = check_item(told, i, err);
        }
    return status;
}

icc_status iccp_told_create(iccp_told *told, size_t n, const icc_constraint *constraints,
                            const iccp_env *env, icc_error *err)
{
    size_t n_items = 0;
    for (size_t c = 0; c < n; ++c)
        n_items += constraints[c].n;
    icc_status status = allocate(told, n_items, env);
    if (status == ICC_OK)
        status = fill_in(told, n, constraints, err);
    if (status != ICC_OK)
        iccp_told_free(told);
    return status;
}

icc_status iccp_told_aim(iccp_told *told, const iccp_told *other, const double *targets,
                         const iccp_env *env, icc_error *err)
{
    const size_t n = other->n;
    icc_status status = allocate(told, n, env);
    if (status == ICC_OK) {
        memcpy(told->kind, other->kind, n * sizeof *told->kind);
        memcpy(told->joined, other->joined, n * sizeof *told->joined);
        memcpy(told->vertex, other->vertex, n * sizeof *told->vertex);
        memcpy(told->source, other->source, 2 * n * sizeof *told->source);
        memcpy(told->direction, other->direction, 2 * n * sizeof *told->direction);
        memcpy(told->tolerance, other->tolerance, n * sizeof *told->tolerance);
    }
    for (size_t i = 0; status == ICC_OK && i < n; ++i) {
        const bool stays = isnan(other->target[2 * i]);
        copy_pair(told->target + 2 * i, stays ? NULL : targets, i);
        status = check_item(told, i, err);
    }
    if (status != ICC_OK)
        iccp_told_free(told);
    return status;
}
