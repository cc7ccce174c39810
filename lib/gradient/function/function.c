/* The function object. */
#include "gradient/function/function.h"

#include "base/minmax.h"
#include "gradient/function/extrapolate.h"
#include "math/elementary.h"

#include <stdbool.h>
#include <string.h>

/* Below 2^LEAST_EXPONENT differences of neighbouring values would lose bits. Above its reciprocal
 * they might overflow. */
enum { LEAST_EXPONENT = -900 };

icc_status iccp_function_new(icc_function **out, const icc_tree *tree, const iccp_env *env)
{
    *out = NULL;
    icc_function *function = iccp_alloc_zero(&env->memory, 1, sizeof *function);
    if (function == NULL)
        return ICC_ERR_MEMORY;
    function->memory = env->memory;
    function->tree = iccp_tree_retain(tree);
    const size_t n = tree->grid->n_vertices;
    function->values = iccp_alloc(&env->memory, n, sizeof *function->values);
    if (function->values == NULL) {
        iccp_function_release(function);
        return ICC_ERR_MEMORY;
    }
    for (size_t v = 0; v < n; ++v)
        function->values[v] = NAN;
    *out = function;
    return ICC_OK;
}

/* Computes the logarithm from a fraction in [0.5, 1) and an exponent. The bits are the same however
 * the value is stored. */
static double log_of(double fraction, int32_t exponent)
{
    static const double LN_2 = 0.69314718055994530942;
    return iccp_ln(fraction) + LN_2 * exponent;
}

double iccp_function_log(const icc_function *function, size_t v)
{
    const icc_tree *tree = function->tree;
    const double value = function->values[v];
    int shift;
    if (tree->generation[v] < 0)
        return NAN;
    if (!tree->grid->inside[v] || !(value > 0))
        return -HUGE_VAL;
    const double fraction = iccp_frexp(value, &shift);
    return log_of(fraction, shift + (function->exponent != NULL ? function->exponent[v] : 0));
}

const double *iccp_function_logs(const icc_function *function)
{
    const size_t n = function->tree->grid->n_vertices;
    const double *known = iccp_once_get(&function->logs);
    if (known != NULL || !function->has_logs)
        return known;
    double *fresh = iccp_alloc(&function->memory, n, sizeof *fresh);
    if (fresh == NULL)
        return NULL;
    for (size_t v = 0; v < n; ++v)
        fresh[v] = iccp_function_log(function, v);
    known = iccp_once_keep(&function->logs, fresh);
    if (known != fresh)
        iccp_free(&function->memory, fresh);
    return known;
}

/* Stores fractions and exponents in place of the values. Keeps plain values for callers that want
 * these. */
static icc_status assign_exponents(icc_function *function, const iccp_unknowns *unknowns,
                                   const iccp_scaled *f)
{
    const size_t n = function->tree->grid->n_vertices;
    function->plain = function->values;
    function->values = iccp_alloc(&function->memory, n, sizeof *function->values);
    function->exponent = iccp_alloc(&function->memory, n, sizeof *function->exponent);
    if (function->values == NULL || function->exponent == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < n; ++v) {
        function->values[v] = function->plain[v];
        function->exponent[v] = ICCP_ZERO_EXPONENT;
    }
    for (size_t k = 0; k < unknowns->n; ++k) {
        function->values[unknowns->vertex[k]] = f->fraction[k];
        function->exponent[unknowns->vertex[k]] = f->exponent[k];
    }
    return ICC_OK;
}

/* Frees what an earlier assignment has made. */
static void forget(icc_function *function)
{
    if (function->plain != NULL) {
        iccp_free(&function->memory, function->values);
        function->values = function->plain;
    }
    iccp_free(&function->memory, function->exponent);
    iccp_free(&function->memory, iccp_once_get(&function->logs));
    iccp_once_init(&function->logs);
    function->exponent = NULL;
    function->plain = NULL;
}

icc_status iccp_function_assign(icc_function *function, const iccp_unknowns *unknowns,
                                const iccp_scaled *f)
{
    const icc_tree *tree = function->tree;
    bool positive = true;
    double least_log = 0;
    int32_t least = 0, most = 0;
    forget(function);
    for (size_t i = 0; i < tree->n_reached; ++i)
        function->values[tree->order[i]] = 0;
    for (size_t k = 0; k < unknowns->n; ++k) {
        function->values[unknowns->vertex[k]] = iccp_scaled_get(f, k, 0);
        positive = positive && f->fraction[k] > 0;
        if (positive)
            least_log = iccp_min(least_log, log_of(f->fraction[k], f->exponent[k]));
        least = f->exponent[k] < least ? f->exponent[k] : least;
        most = f->exponent[k] > most ? f->exponent[k] : most;
    }
    function->has_logs = positive;
    function->info.least_log = positive ? least_log : 0;
    icc_status status = ICC_OK;
    if (positive && (least < LEAST_EXPONENT || most > -LEAST_EXPONENT))
        status = assign_exponents(function, unknowns, f);
    return status == ICC_OK ? iccp_function_extrapolate(function, unknowns) : status;
}

void iccp_function_find_highest(icc_function *function)
{
    const icc_tree *tree = function->tree;
    uint32_t ends[2] = {tree->root, tree->root};
    double local[2];
    for (size_t i = 1; i < tree->n_inside; ++i)
        if (iccp_function_compare(function, tree->order[i], ends[1]) > 0)
            ends[1] = tree->order[i];
    function->info.highest = ends[1];
    function->info.beside = ends[1] != tree->root;
    if (function->info.beside) {
        iccp_function_local(function, 2, ends, local);
        function->info.excess = (local[1] - local[0]) / fabs(local[0]);
    }
}

static bool copy_values(icc_function *copy, double **to, const double *from)
{
    const size_t n = copy->tree->grid->n_vertices;
    if (from == NULL)
        return true;
    if (*to == NULL)
        *to = iccp_alloc(&copy->memory, n, sizeof **to);
    if (*to != NULL)
        memcpy(*to, from, n * sizeof **to);
    return *to != NULL;
}

icc_status iccp_function_copy(icc_function **out, const icc_function *function, const iccp_env *env)
{
    icc_status status = iccp_function_new(out, function->tree, env);
    if (status != ICC_OK)
        return status;
    icc_function *copy = *out;
    const size_t n = function->tree->grid->n_vertices;
    copy->info = function->info;
    copy->has_logs = function->has_logs;
    copy->made = function->made;
    copy->from_logs = function->from_logs;
    if (function->exponent != NULL)
        copy->exponent = iccp_alloc(&copy->memory, n, sizeof *copy->exponent);
    if (copy->exponent != NULL)
        memcpy(copy->exponent, function->exponent, n * sizeof *copy->exponent);
    if (copy_values(copy, &copy->values, function->values) &&
        copy_values(copy, &copy->plain, function->plain) &&
        (copy->exponent != NULL || function->exponent == NULL))
        return ICC_OK;
    iccp_function_release(copy);
    *out = NULL;
    return ICC_ERR_MEMORY;
}

void iccp_function_release(icc_function *function)
{
    if (function == NULL)
        return;
    const iccp_memory memory = function->memory;
    iccp_tree_release(function->tree);
    iccp_free(&memory, function->values);
    iccp_free(&memory, function->exponent);
    iccp_free(&memory, function->plain);
    iccp_free(&memory, iccp_once_get(&function->logs));
    iccp_free(&memory, function);
}
