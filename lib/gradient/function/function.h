/* The function object: values on the vertices of a tree.
 *
 * Words of this folder. Begin with this file, then make_function.h.
 * - function: f of the papers, highest at the root and falling along the tree.
 * - unknowns: the inside vertices at which an equation is solved (gradient/solver/unknowns.h).
 * - exponent, plain: f may exceed the range of doubles. Then it is values * 2^exponent, and `plain`
 *   holds the part that fits.
 * - critical point: a vertex at which f has a maximum, a minimum or a saddle (critical_points.h).
 * - compression, expansion facet: a facet to, or from, which the gradient points on both sides
 *   (merging.h).
 * - load: the point at which a bi-Laplace equation is driven. move_maximum.h moves it.
 *
 * Ways: make_function.c sets functions of the generation and of the distance along the tree, and
 * asks laplace.h for the others. given_function.h takes the caller's values, given_equation.h some
 * values and an equation. extrapolate.h gives values outside.
 *
 * Invariants: values are NaN where the tree does not reach, until gradient/coordinates extends
 * them. Otherwise only the cached logarithms are made after make_function.h. */
#ifndef ICCP_FUNCTION_H
#define ICCP_FUNCTION_H

#include "base/once.h"
#include "gradient/solver/solution.h"
#include "gradient/solver/unknowns.h"
#include "math/scaled.h"

struct icc_function {
    iccp_memory memory;
    icc_tree *tree;
    iccp_solution info;
    double *values; /* one per grid vertex; NaN where the tree does not reach */
    /* The function is values * 2^exponent; NULL: all exponents are 0, the usual case */
    int32_t *exponent;
    double *plain; /* the function as far as doubles can hold it; NULL: same as `values` */
    bool has_logs; /* it is positive inside */
    /* How it was made: complete options, or ICC_FUNCTION_VALUES alone for values of the caller's */
    icc_function_options made;
    bool from_logs; /* the caller gave logarithms */
    iccp_once logs; /* logarithms of the function, made on first use */
};

/* Makes a function whose values are all NaN. */
icc_status iccp_function_new(icc_function **out, const icc_tree *tree, const iccp_env *env);

/* Takes the values of a function at the unknowns. Outside vertices next to them get 0. The vertices
 * beyond get minus the value two steps back, as if the function continued. Logarithms are available
 * if all values are positive, and exponents if doubles would not hold the values. It may be called
 * again. After ICC_ERR_MEMORY, the function is only good for iccp_function_release(). */
icc_status iccp_function_assign(icc_function *function, const iccp_unknowns *unknowns,
                                const iccp_scaled *f);

/* Finds the highest vertex: the root, unless the function is greater elsewhere. Of several greatest
 * vertices, it is the one that the tree reaches first. Sets it in `info`. */
void iccp_function_find_highest(icc_function *function);

/* Makes a copy with the same tree. */
icc_status iccp_function_copy(icc_function **out, const icc_function *function,
                              const iccp_env *env);

/* Returns the logarithm at a vertex of a function that has logarithms: -HUGE_VAL outside, NaN where
 * the tree does not reach. */
double iccp_function_log(const icc_function *function, size_t v);

/* Returns all logarithms and makes them on first use. NULL if the function has none, or there is no
 * memory. */
const double *iccp_function_logs(const icc_function *function);

/* NULL does nothing. At this stage a function is not shared, so it has one owner. */
void iccp_function_release(icc_function *function);

/* Copies the function at a few vertices. If a double would not hold the values, all are divided by
 * the same power of 2. NaN stays NaN. Differences of the results have exact signs. */
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

/* Returns -1, 0 or 1 if the function at u is smaller than, equal to or larger than at v. */
static inline int iccp_function_compare(const icc_function *function, uint32_t u, uint32_t v)
{
    const uint32_t ends[2] = {u, v};
    double local[2];
    iccp_function_local(function, 2, ends, local);
    return (local[0] > local[1]) - (local[0] < local[1]);
}

#endif
