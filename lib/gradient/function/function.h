/* The function object: values on the vertices of a tree. */
#ifndef ICCP_FUNCTION_H
#define ICCP_FUNCTION_H

#include "base/once.h"
#include "gradient/solver/unknowns.h"
#include "math/scaled.h"

struct icc_function {
    iccp_memory memory;
    icc_tree *tree;
    icc_function_info info;
    double *values;    /* one per grid vertex; NaN where the tree does not reach */
    int32_t *exponent; /* the function is values * 2^exponent; NULL: 0 everywhere, the usual case */
    double *plain;     /* the function as far as doubles hold it; NULL when that is `values` */
    bool has_logs;     /* it is positive inside */
    iccp_once logs;    /* of the function, once somebody has asked for them */
};

/* A function whose values are all NaN. */
icc_status iccp_function_new(icc_function **out, const icc_tree *tree, const iccp_env *env);

/* Takes over the values of a function on the unknowns: 0 at the vertices outside next to them, and
 * beyond these minus the value two steps back, as if it went on. Logarithms are made when all are
 * positive, exponents when doubles would not hold them. May be called again. ICC_ERR_MEMORY leaves
 * the function usable only for iccp_function_release(). */
icc_status iccp_function_assign(icc_function *function, const iccp_unknowns *unknowns,
                                const iccp_scaled *f);

/* The logarithm of the function at a vertex, of one that has logarithms: -HUGE_VAL outside, NaN
 * where the tree does not reach. */
double iccp_function_log(const icc_function *function, size_t v);

/* All of them, made when they are first asked for. NULL where there are none, or no memory. */
const double *iccp_function_logs(const icc_function *function);

/* NULL is a no-op. Nothing shares a function yet, so it has one owner. */
void iccp_function_release(icc_function *function);

/* The function at a few vertices, all divided by the same power of 2 where a double would not hold
 * them; NaN stays NaN. Differences of the results have exact signs. */
static inline void iccp_function_local(const icc_function *function, size_t n,
                                       const uint32_t *vertices, double *local)
{
    for (size_t i = 0; i < n; ++i)
        local[i] = function->values[vertices[i]];
    if (function->exponent == NULL)
        return;
    int32_t highest = ICCP_ZERO_EXPONENT;
    for (size_t i = 0; i < n; ++i)
        if (function->exponent[vertices[i]] > highest)
            highest = function->exponent[vertices[i]];
    for (size_t i = 0; i < n; ++i)
        local[i] = ldexp(local[i], function->exponent[vertices[i]] - highest);
}

/* -1, 0 or 1 as the function at u is smaller than, equal to or larger than at v. */
static inline int iccp_function_compare(const icc_function *function, uint32_t u, uint32_t v)
{
    const uint32_t both[2] = {u, v};
    double local[2];
    iccp_function_local(function, 2, both, local);
    return (local[0] > local[1]) - (local[0] < local[1]);
}

#endif
