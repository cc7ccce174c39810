/* Bindings as bytes: kind "BIND"; see docs/formats.md. */
#include "base/blob.h"
#include "base/error.h"
#include "kernel/binding.h"

#include <math.h>

static const char KIND[] = "BIND";
static const uint32_t VERSION = 1;

void iccp_binding_save(const icc_binding *binding, size_t capacity, void *data, size_t *n_bytes)
{
    const icc_binding *b = binding;
    const uint32_t head[2] = {(uint32_t)b->dim, b->gradients != NULL};
    iccp_blob_writer w;
    iccp_blob_begin(&w, data, capacity, KIND, VERSION);
    iccp_blob_u32(&w, 2, head);
    iccp_blob_u64(&w, b->n_handles);
    iccp_blob_u64(&w, b->n);
    iccp_blob_f64(&w, b->n_handles * b->dim, b->handles);
    iccp_blob_f64(&w, b->n * b->dim, b->points);
    iccp_blob_f64(&w, b->n * b->n_handles, b->weights);
    if (b->gradients != NULL)
        iccp_blob_f64(&w, b->n * b->n_handles * b->dim, b->gradients);
    iccp_blob_end(&w, n_bytes);
}

static bool are_finite(size_t n, const double *values)
{
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

static void read_arrays(iccp_blob_reader *r, const icc_binding *b)
{
    iccp_blob_read_f64(r, b->n_handles * b->dim, b->handles);
    iccp_blob_read_f64(r, b->n * b->dim, b->points);
    iccp_blob_read_f64(r, b->n * b->n_handles, b->weights);
    if (b->gradients != NULL)
        iccp_blob_read_f64(r, b->n * b->n_handles * b->dim, b->gradients);
}

/* Handles and points can be finite and weights not: an interpolant overflows far away. */
static bool is_sound(const iccp_blob_reader *r, const icc_binding *b)
{
    return iccp_blob_done(r) && are_finite(b->n_handles * b->dim, b->handles) &&
           are_finite(b->n * b->dim, b->points);
}

icc_status iccp_binding_load(icc_binding **out, size_t n_bytes, const void *data,
                             const iccp_env *env, icc_error *err)
{
    iccp_blob_reader r;
    uint32_t head[2];
    *out = NULL;
    icc_status status = iccp_blob_open(&r, data, n_bytes, KIND, VERSION, err);
    if (status != ICC_OK)
        return status;
    iccp_blob_read_u32(&r, 2, head);
    const size_t dim = head[0], number = sizeof(double);
    if (dim < 2 || dim > 3 || head[1] > 1)
        return iccp_fail(err, ICC_ERR_FORMAT, "the binding has dimension %zu or unknown parts",
                         dim);
    const size_t n_handles = iccp_blob_read_count(&r, dim * number);
    const size_t row = n_handles * (head[1] == 1 ? dim + 1 : 1) + dim;
    const size_t n = iccp_blob_read_count(&r, row * number);
    if (r.failed || n_handles <= dim)
        return iccp_fail(err, ICC_ERR_FORMAT,
                         "the binding has impossible numbers of handles or points");
    status = iccp_binding_allocate(out, dim, n, n_handles, head[1] == 1, &env->memory);
    if (status != ICC_OK)
        return status;
    read_arrays(&r, *out);
    if (is_sound(&r, *out))
        return ICC_OK;
    iccp_binding_release(*out);
    *out = NULL;
    return iccp_fail(err, ICC_ERR_FORMAT,
                     "the binding is not whole, or has a number that is not finite");
}
