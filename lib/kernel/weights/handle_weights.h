/* The object of type icc_weights: weights at nodes, and their interpolant. */
#ifndef ICCP_HANDLE_WEIGHTS_H
#define ICCP_HANDLE_WEIGHTS_H

#include "kernel/weights/node_set.h"

struct icc_weights {
    iccp_memory memory;
    iccp_node_set *nodes;
    double *values;        /* n * n_handles */
    icc_status *status;    /* by node */
    double *coefficients;  /* of the interpolant: n + dim + 1 rows of n_handles */
    icc_weights_info info; /* except `size` */
    icc_weights_timings timings;
};

/* See icc_weights_create(). Arguments have been checked, but not against each other's geometry. */
icc_status iccp_weights_create(icc_weights **out, const icc_sampling *sampling, size_t n_handles,
                               const double *handles, const icc_weights_options *options,
                               const iccp_env *env, icc_error *err);
void iccp_weights_release(icc_weights *weights);

/* Makes a copy on the same nodes, with the weights, statuses and coefficients of `from`. */
icc_status iccp_weights_copy(icc_weights **out, const icc_weights *from, const iccp_env *env);

/* Optimises the weights of some nodes, which must differ, starting from their present weights. NULL
 * means all n nodes. Held nodes keep their weights. */
icc_status iccp_weights_optimise(icc_weights *weights, size_t n, const uint32_t *nodes,
                                 const iccp_env *env);

/* Optimises all weights from the initial ones, then makes lines straight. */
icc_status iccp_weights_start(icc_weights *weights, const iccp_env *env, icc_error *err);

/* Adapts the nodes near line k to it. */
icc_status iccp_weights_follow_line(icc_weights *weights, size_t k, const iccp_env *env);

/* Computes coefficients for those handles whose weights at nodes differ from `before`. NULL: for
 * all handles. */
icc_status iccp_weights_interpolate(icc_weights *weights, const icc_weights *before,
                                    const iccp_env *env);

/* See icc_weights_paint() and the next functions. */
icc_status iccp_weights_paint(icc_weights **out, const icc_weights *weights, size_t handle,
                              const double *centre, double radius, double amount,
                              const iccp_env *env);
icc_status iccp_weights_repaint(icc_weights **out, const icc_weights *weights, size_t n,
                                const uint32_t *nodes, const double *values, const iccp_env *env,
                                icc_error *err);
icc_status iccp_weights_with_method(icc_weights **out, const icc_weights *weights, int32_t method,
                                    const iccp_env *env, icc_error *err);
icc_status iccp_weights_stiffen(icc_weights **out, const icc_weights *weights, size_t n,
                                const uint32_t *nodes, const double *rigidity, double energy[2],
                                const iccp_env *env, icc_error *err);

/* Computes weights at a finite point, and gradients unless NULL, all in the caller's
 * coordinates. */
void iccp_weights_at(const icc_weights *weights, const double *point, double *values,
                     double *gradients);

/* See icc_weights_evaluate(), icc_weights_get_dual() and icc_weights_get_report(). */
icc_status iccp_weights_evaluate(const icc_weights *weights, size_t n, const double *points,
                                 double *values, double *gradients, icc_status *status,
                                 size_t *n_failed, const iccp_env *env);
icc_status iccp_weights_dual(const icc_weights *weights, size_t node, size_t n,
                             const double *points, double *values, const iccp_env *env);
icc_status iccp_weights_measure(const icc_weights *weights, size_t n, const double *points,
                                icc_weights_report *report, const iccp_env *env);

#endif
