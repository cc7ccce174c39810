/* Checks the arguments of the functions on kernel weights (kernel coordinates). */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "kernel/weights/handle_weights.h"

#include <math.h>
#include <string.h>

ICCP_END(weights)

static const int32_t DEFAULT_STEPS = 5; /* from the thesis, section 4.7 */
static const int32_t MAX_STEPS = 100000;
static const double DEFAULT_CUTOFF = 5; /* from the thesis, section 6.1 */
static const double MAX_CUTOFF = 40;    /* farther away the Gaussian is 0 */
static const size_t MAX_HANDLES = (size_t)1 << 20;

static bool are_finite(size_t n, const double *values)
{
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

/* The first of n rows of `width` numbers that has a number that is not finite, or n if there is
 * none. */
static size_t first_infinite(size_t n, size_t width, const double *values)
{
    size_t i = 0;
    while (i < n && are_finite(width, values + width * i))
        ++i;
    return i;
}

/* ---- creation ---- */

static icc_status check_choice(int32_t value, int32_t first, int32_t last, const char *member,
                               icc_error *err)
{
    if (value >= first && value <= last)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_ARGUMENT,
                     "icc_weights_options.%s is %ld; it must lie in %ld..%ld", member, (long)value,
                     (long)first, (long)last);
}

static icc_status check_amount(double value, double most, const char *member, icc_error *err)
{
    if (value >= 0 && value <= most && isfinite(value))
        return ICC_OK;
    if (isinf(most))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_weights_options.%s is %g; it must be finite and at least 0", member,
                         value);
    return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_weights_options.%s is %g; it must lie in [0, %g]",
                     member, value, most);
}

/* Refuses options that are wrong for any sampling. */
static icc_status check_choices(const icc_weights_options *o, icc_error *err)
{
    icc_status status = check_choice(o->kernel, 0, ICC_KERNEL_GAUSS, "kernel", err);
    if (status == ICC_OK)
        status = check_choice(o->initial, 0, ICC_INITIAL_GIVEN, "initial", err);
    if (status == ICC_OK)
        status = check_choice(o->method, 0, ICC_WEIGHTS_BIHARMONIC, "method", err);
    if (status == ICC_OK)
        status = check_choice(o->steps, 0, MAX_STEPS, "steps", err);
    if (status == ICC_OK)
        status = check_choice(o->affine_tail, -1, 1, "affine_tail", err);
    if (status == ICC_OK)
        status = check_choice(o->within_shape, -1, 1, "within_shape", err);
    if (status == ICC_OK)
        status = check_amount(o->sigma, HUGE_VAL, "sigma", err);
    return status == ICC_OK ? check_amount(o->cutoff, MAX_CUTOFF, "cutoff", err) : status;
}

static icc_status check_edges(const icc_weights_options *o, size_t n_handles, icc_error *err)
{
    if (o->n_edges > 0 && o->edges == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_weights_options.edges is NULL");
    if (o->n_edges > UINT32_MAX / 2)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "there are too many edges: %zu", o->n_edges);
    for (size_t e = 0; e < o->n_edges; ++e) {
        const uint32_t *ends = o->edges + 2 * e;
        if (ends[0] >= n_handles || ends[1] >= n_handles || ends[0] == ends[1])
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_EDGE, (int64_t)e,
                                "edge %zu joins handles %lu and %lu of %zu", e,
                                (unsigned long)ends[0], (unsigned long)ends[1], n_handles);
    }
    if (o->initial == ICC_INITIAL_EDGES && o->n_edges == 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_weights_options.initial holds edges, but there are none");
    return ICC_OK;
}

static icc_status check_lines(const icc_weights_options *o, size_t dim, icc_error *err)
{
    if (o->n_lines > 0 && o->lines == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_weights_options.lines is NULL");
    if (o->n_lines > INT32_MAX)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "there are too many lines: %zu", o->n_lines);
    for (size_t k = 0; k < o->n_lines; ++k) {
        const icc_line *line = &o->lines[k];
        if (!are_finite(dim, line->from) || !are_finite(dim, line->to))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)k,
                                "line %zu is not finite", k);
        if (line->parallel < 0 || (size_t)line->parallel > k)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)k,
                                "line %zu: parallel is %ld; it may be parallel to an earlier line",
                                k, (long)line->parallel);
    }
    return ICC_OK;
}

static icc_status check_weights(const icc_weights_options *o, size_t n_samples, size_t n_handles,
                                icc_error *err)
{
    if (o->initial != ICC_INITIAL_GIVEN)
        return ICC_OK;
    if (o->initial_weights == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_weights_options.initial_weights is NULL");
    const size_t i = first_infinite(n_samples, n_handles, o->initial_weights);
    if (i == n_samples)
        return ICC_OK;
    return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_SAMPLE, (int64_t)i,
                        "an initial weight of sample %zu is not finite", i);
}

static icc_status check_handles(size_t dim, size_t n, const double *handles, icc_error *err)
{
    if (n < dim + 1 || n > MAX_HANDLES)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "there are %zu handles; at least %zu are needed to reproduce points", n,
                         dim + 1);
    const size_t j = first_infinite(n, dim, handles);
    if (j == n)
        return ICC_OK;
    return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_HANDLE, (int64_t)j,
                        "handle %zu is not finite", j);
}

static void complete(icc_weights_options *o, double sigma)
{
    if (o->kernel == 0)
        o->kernel = ICC_KERNEL_WENDLAND;
    if (o->initial == 0)
        o->initial = o->n_edges > 0 ? ICC_INITIAL_EDGES : ICC_INITIAL_HEAT;
    if (o->method == 0)
        o->method = ICC_WEIGHTS_QP;
    if (o->steps == 0)
        o->steps = DEFAULT_STEPS;
    if (!(o->sigma > 0))
        o->sigma = sigma;
    if (!(o->cutoff > 0))
        o->cutoff = DEFAULT_CUTOFF;
}

static icc_status check_all(const icc_weights_options *o, const icc_sampling *sampling,
                            size_t n_handles, const double *handles, icc_error *err)
{
    const size_t dim = sampling->shape->dim;
    icc_status status = check_choices(o, err);
    if (status == ICC_OK)
        status = check_handles(dim, n_handles, handles, err);
    if (status == ICC_OK)
        status = check_edges(o, n_handles, err);
    if (status == ICC_OK)
        status = check_lines(o, dim, err);
    return status == ICC_OK ? check_weights(o, sampling->info.n_samples, n_handles, err) : status;
}

icc_status icc_weights_create(icc_weights **out, const icc_sampling *sampling, size_t n_handles,
                              const double *handles, const icc_weights_options *options,
                              const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL        ? "out"
                          : sampling == NULL ? "sampling"
                          : handles == NULL  ? "handles"
                                             : NULL;
    iccp_env full_env;
    icc_weights_options full;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&full, sizeof full, options, "icc_weights_options", err);
    if (status == ICC_OK)
        status = check_all(&full, sampling, n_handles, handles, err);
    if (status != ICC_OK)
        return status;
    complete(&full, sampling->info.sigma);
    return iccp_end_weights(iccp_explain(err, iccp_weights_create(out, sampling, n_handles, handles,
                                                                  &full, &full_env, err)),
                            out, &full_env, err);
}

void icc_weights_free(icc_weights *weights)
{
    iccp_weights_release(weights);
}

/* ---- information ---- */

icc_status icc_weights_get_info(const icc_weights *weights, icc_weights_info *info)
{
    ICCP_ENTER;
    if (weights == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(info, &weights->info, sizeof weights->info, "icc_weights_info", NULL);
}

icc_status icc_weights_get_timings(const icc_weights *weights, icc_weights_timings *timings)
{
    ICCP_ENTER;
    if (weights == NULL || timings == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(timings, &weights->timings, sizeof weights->timings,
                             "icc_weights_timings", NULL);
}

icc_status icc_weights_get_nodes(const icc_weights *weights, double *points, double *initial,
                                 double *values, icc_status *status)
{
    ICCP_ENTER;
    if (weights == NULL)
        return ICC_ERR_ARGUMENT;
    const iccp_node_set *set = weights->nodes;
    const size_t n_weights = set->n * set->n_handles;
    if (points != NULL)
        memcpy(points, set->given, set->n * set->dim * sizeof *points);
    if (initial != NULL)
        memcpy(initial, set->initial, n_weights * sizeof *initial);
    if (values != NULL)
        memcpy(values, weights->values, n_weights * sizeof *values);
    if (status != NULL)
        memcpy(status, weights->status, set->n * sizeof *status);
    return ICC_OK;
}

icc_status icc_weights_evaluate(const icc_weights *weights, size_t n, const double *points,
                                double *values, double *gradients, icc_status *status,
                                size_t *n_failed, const icc_env *env)
{
    ICCP_ENTER;
    if (weights == NULL || (n > 0 && (points == NULL || values == NULL)))
        return ICC_ERR_ARGUMENT;
    iccp_env full_env;
    const icc_status read = iccp_env_read(&full_env, env, NULL);
    return read == ICC_OK
               ? iccp_finish(&full_env, iccp_weights_evaluate(weights, n, points, values, gradients,
                                                              status, n_failed, &full_env))
               : read;
}

icc_status icc_weights_get_dual(const icc_weights *weights, size_t node, size_t n,
                                const double *points, double *values, const icc_env *env,
                                icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = weights == NULL           ? "weights"
                          : n > 0 && points == NULL ? "points"
                          : n > 0 && values == NULL ? "values"
                                                    : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (node >= weights->nodes->n)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_NODE, (int64_t)node,
                            "node %zu does not exist", node);
    const size_t i = first_infinite(n, weights->nodes->dim, points);
    if (i < n)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                            "point %zu is not finite", i);
    return iccp_explain(err, iccp_finish(&full_env, iccp_weights_dual(weights, node, n, points,
                                                                      values, &full_env)));
}

icc_status icc_weights_get_report(const icc_weights *weights, size_t n, const double *points,
                                  icc_weights_report *report, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = weights == NULL           ? "weights"
                          : report == NULL          ? "report"
                          : n > 0 && points == NULL ? "points"
                                                    : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    icc_weights_report full;
    const size_t i = first_infinite(n, weights->nodes->dim, points);
    if (i < n)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                            "point %zu is not finite", i);
    if (status == ICC_OK)
        status = iccp_finish(&full_env, iccp_weights_measure(weights, n, points, &full, &full_env));
    if (status == ICC_OK)
        return iccp_write_struct(report, &full, sizeof full, "icc_weights_report", err);
    return iccp_explain(err, status);
}

/* ---- weights from others ---- */

icc_status icc_weights_paint(icc_weights **out, const icc_weights *weights, size_t handle,
                             const double *centre, double radius, double amount, const icc_env *env,
                             icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL       ? "out"
                          : weights == NULL ? "weights"
                          : centre == NULL  ? "centre"
                                            : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (handle >= weights->nodes->n_handles)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "handle %zu does not exist", handle);
    if (!are_finite(weights->nodes->dim, centre) || !(radius > 0) || !isfinite(radius) ||
        !isfinite(amount))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_weights_paint: radius %g, amount %g, or a centre that is not finite",
                         radius, amount);
    return iccp_end_weights(iccp_explain(err, iccp_weights_paint(out, weights, handle, centre,
                                                                 radius, amount, &full_env)),
                            out, &full_env, err);
}

icc_status icc_weights_repaint(icc_weights **out, const icc_weights *weights, size_t n,
                               const uint32_t *nodes, const double *values, const icc_env *env,
                               icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL               ? "out"
                          : weights == NULL         ? "weights"
                          : n > 0 && nodes == NULL  ? "nodes"
                          : n > 0 && values == NULL ? "values"
                                                    : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    const size_t k = first_infinite(n, weights->nodes->n_handles, values);
    if (k < n)
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_NODE, (int64_t)k,
                            "a weight for node %lu is not finite", (unsigned long)nodes[k]);
    return iccp_end_weights(
        iccp_explain(err, iccp_weights_repaint(out, weights, n, nodes, values, &full_env, err)),
        out, &full_env, err);
}

icc_status icc_weights_with_method(icc_weights **out, const icc_weights *weights, int32_t method,
                                   const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL ? "out" : weights == NULL ? "weights" : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (method < ICC_WEIGHTS_QP || method > ICC_WEIGHTS_BIHARMONIC)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "method is %ld; it must lie in %d..%d",
                         (long)method, (int)ICC_WEIGHTS_QP, (int)ICC_WEIGHTS_BIHARMONIC);
    return iccp_end_weights(
        iccp_explain(err, iccp_weights_with_method(out, weights, method, &full_env, err)), out,
        &full_env, err);
}

icc_status icc_weights_stiffen(icc_weights **out, const icc_weights *weights, size_t n,
                               const uint32_t *nodes, const double *rigidity, double energy[2],
                               const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL              ? "out"
                          : weights == NULL        ? "weights"
                          : n > 0 && nodes == NULL ? "nodes"
                                                   : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    for (size_t k = 0; rigidity != NULL && k < n; ++k)
        if (!(rigidity[k] > 0) || !isfinite(rigidity[k]))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_NODE, (int64_t)k,
                                "the rigidity of node %lu is %g; it must be positive and finite",
                                (unsigned long)nodes[k], rigidity[k]);
    return iccp_end_weights(iccp_explain(err, iccp_weights_stiffen(out, weights, n, nodes, rigidity,
                                                                   energy, &full_env, err)),
                            out, &full_env, err);
}
