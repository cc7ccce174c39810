/* Bindings: points with their weights. */
#include "kernel/weights/binding.h"

#include <string.h>

icc_status iccp_binding_allocate(icc_binding **out, size_t dim, size_t n, size_t n_handles,
                                 bool derivatives, const iccp_memory *memory)
{
    icc_binding *b = iccp_alloc_zero(memory, 1, sizeof *b);
    *out = NULL;
    if (b == NULL)
        return ICC_ERR_MEMORY;
    *b = (icc_binding){.memory = *memory, .dim = dim, .n = n, .n_handles = n_handles};
    const size_t row = n_handles * sizeof(double);
    b->handles = iccp_alloc(memory, n_handles, dim * sizeof *b->handles);
    b->points = iccp_alloc(memory, n, dim * sizeof *b->points);
    b->weights = iccp_alloc(memory, n, row);
    if (derivatives)
        b->gradients = iccp_alloc(memory, n, dim * row);
    if (b->handles == NULL || b->points == NULL || b->weights == NULL ||
        (derivatives && b->gradients == NULL)) {
        iccp_binding_release(b);
        return ICC_ERR_MEMORY;
    }
    *out = b;
    return ICC_OK;
}

icc_status iccp_binding_create(icc_binding **out, const icc_weights *weights, size_t n,
                               const double *points, bool derivatives, const iccp_env *env)
{
    const iccp_node_set *set = weights->nodes;
    icc_status status =
        iccp_binding_allocate(out, set->dim, n, set->n_handles, derivatives, &env->memory);
    if (status != ICC_OK)
        return status;
    icc_binding *b = *out;
    memcpy(b->handles, set->given, set->n_handles * set->dim * sizeof *b->handles);
    memcpy(b->points, points, n * set->dim * sizeof *b->points);
    status = iccp_weights_evaluate(weights, n, points, b->weights, b->gradients, NULL, NULL, env);
    if (status != ICC_OK) {
        iccp_binding_release(b);
        *out = NULL;
    }
    return status;
}

void iccp_binding_release(icc_binding *binding)
{
    if (binding == NULL)
        return;
    iccp_free(&binding->memory, binding->handles);
    iccp_free(&binding->memory, binding->points);
    iccp_free(&binding->memory, binding->weights);
    iccp_free(&binding->memory, binding->gradients);
    const iccp_memory memory = binding->memory;
    iccp_free(&memory, binding);
}
