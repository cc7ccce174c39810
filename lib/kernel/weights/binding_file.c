/* Bindings as bytes: kind "BIND"; see docs/reference/formats.md. */
#include "base/blob.h"
#include "base/error.h"
#include "kernel/weights/binding.h"

#include <math.h>

static const char KIND[] = "BIND";
static const uint32_t VERSION = 1;

/* `head` has the dimension, and whether there are gradients. */
static void visit_sizes(iccp_blob *b, uint32_t head[2], size_t *n_handles, size_t *n)
{
    iccp_blob_u32(b, 2, head);
    const size_t dim = head[0];
    iccp_blob_require(b, (dim == 2 || dim == 3) && head[1] <= 1);
    iccp_blob_count(b, dim * ICCP_F64, n_handles);
    const size_t row = *n_handles * (head[1] == 1 ? dim + 1 : 1) + dim;
    iccp_blob_count(b, row * ICCP_F64, n);
}

static void visit_arrays(iccp_blob *b, const icc_binding *x)
{
    iccp_blob_f64(b, x->n_handles * x->dim, x->handles);
    iccp_blob_f64(b, x->n * x->dim, x->points);
    iccp_blob_f64(b, x->n * x->n_handles, x->weights);
    if (x->gradients != NULL)
        iccp_blob_f64(b, x->n * x->n_handles * x->dim, x->gradients);
}

void iccp_binding_save(const icc_binding *binding, size_t capacity, void *data, size_t *n_bytes)
{
    uint32_t head[2] = {(uint32_t)binding->dim, binding->gradients != NULL};
    size_t n_handles = binding->n_handles, n = binding->n;
    iccp_blob b;
    iccp_blob_begin(&b, data, capacity, KIND, VERSION);
    visit_sizes(&b, head, &n_handles, &n);
    visit_arrays(&b, binding);
    iccp_blob_end(&b, n_bytes);
}

static bool are_finite(size_t n, const double *values)
{
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

/* Handles and points must be finite, but weights need not be: an interpolant overflows far away. */
static bool is_sound(const iccp_blob *b, const icc_binding *x)
{
    return iccp_blob_done(b) && are_finite(x->n_handles * x->dim, x->handles) &&
           are_finite(x->n * x->dim, x->points);
}

icc_status iccp_binding_load(icc_binding **out, size_t n_bytes, const void *data,
                             const iccp_env *env, icc_error *err)
{
    iccp_blob b;
    uint32_t head[2];
    size_t n_handles, n;
    *out = NULL;
    icc_status status = iccp_blob_open(&b, data, n_bytes, KIND, VERSION, &env->memory, err);
    if (status != ICC_OK)
        return status;
    visit_sizes(&b, head, &n_handles, &n);
    const size_t dim = head[0];
    if (dim < 2 || dim > 3 || head[1] > 1)
        return iccp_fail(err, ICC_ERR_FORMAT, "the binding has dimension %zu or unknown parts",
                         dim);
    if (b.status != ICC_OK || n_handles <= dim)
        return iccp_fail(err, ICC_ERR_FORMAT,
                         "the binding has impossible numbers of handles or points");
    status = iccp_binding_allocate(out, dim, n, n_handles, head[1] == 1, &env->memory);
    if (status != ICC_OK)
        return status;
    visit_arrays(&b, *out);
    if (is_sound(&b, *out))
        return ICC_OK;
    iccp_binding_release(*out);
    *out = NULL;
    return iccp_fail(err, ICC_ERR_FORMAT,
                     "the binding is not whole, or has a number that is not finite");
}
