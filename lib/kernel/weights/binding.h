/* Bindings: points with their weights. */
#ifndef ICCP_BINDING_H
#define ICCP_BINDING_H

#include "kernel/weights/handle_weights.h"

struct icc_binding {
    iccp_memory memory;
    size_t dim, n, n_handles;
    double *handles;   /* n_handles * dim */
    double *points;    /* n * dim */
    double *weights;   /* n * n_handles */
    double *gradients; /* n * n_handles * dim, or NULL */
};

/* See icc_binding_create(). All points are finite. */
icc_status iccp_binding_create(icc_binding **out, const icc_weights *weights, size_t n,
                               const double *points, bool derivatives, const iccp_env *env);

/* Makes a binding whose arrays the caller then fills in. */
icc_status iccp_binding_allocate(icc_binding **out, size_t dim, size_t n, size_t n_handles,
                                 bool derivatives, const iccp_memory *memory);
void iccp_binding_release(icc_binding *binding);

/* See icc_binding_save() and icc_binding_load(). */
void iccp_binding_save(const icc_binding *binding, size_t capacity, void *data, size_t *n_bytes);
icc_status iccp_binding_load(icc_binding **out, size_t n_bytes, const void *data,
                             const iccp_env *env, icc_error *err);

#endif
