/* Samplings as bytes. */
#include "kernel/sampling/sampling_file.h"

#include "base/error.h"
#include "kernel/sampling/shape_file.h"

#include <math.h>

static const char KIND[] = "SMPL";
static const uint32_t VERSION = 1;

static bool is_sound(const icc_sampling_info *info)
{
    return info->n_samples > 0 && info->n_edge <= info->n_samples && isfinite(info->spacing) &&
           info->spacing > 0 && isfinite(info->nearest) && info->nearest >= 0 &&
           isfinite(info->sigma) && info->sigma > 0;
}

static bool are_finite(size_t n, const double *values)
{
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

static void visit(iccp_blob *b, icc_sampling_info *info, double **points)
{
    const size_t dim = (size_t)info->dim;
    iccp_blob_i32(b, ICCP_U64, ICC_SAMPLING_GRID, ICC_SAMPLING_POINTS, &info->kind);
    iccp_blob_size(b, &info->n_edge);
    iccp_blob_count(b, dim * ICCP_F64, &info->n_samples);
    iccp_blob_f64(b, 1, &info->spacing);
    iccp_blob_f64(b, 1, &info->nearest);
    iccp_blob_f64(b, 1, &info->sigma);
    iccp_blob_require(b, is_sound(info));
    iccp_blob_array_f64(b, info->n_samples * dim, points);
}

static icc_status read_samples(icc_sampling *s, iccp_blob *b)
{
    s->info = (icc_sampling_info){.dim = (int32_t)s->shape->dim};
    visit(b, &s->info, &s->points);
    iccp_blob_require(b, b->status != ICC_OK ||
                             are_finite(s->info.n_samples * s->shape->dim, s->points));
    return b->status;
}

/* The shape explains its own failures. */
static icc_status read_sampling(icc_sampling **out, iccp_blob *b, const iccp_env *env,
                                icc_error *err)
{
    icc_sampling *s = iccp_alloc_zero(&env->memory, 1, sizeof *s);
    if (s == NULL)
        return iccp_fail_memory(err);
    s->memory = env->memory;
    atomic_init(&s->references, 1);
    icc_status status = iccp_shape_visit(b, &s->shape, env, err);
    if (status == ICC_OK) {
        status = read_samples(s, b);
        if (status == ICC_ERR_FORMAT)
            status = iccp_fail(err, status, "the bytes do not describe samples");
        status = iccp_explain(err, status);
    }
    if (status != ICC_OK) {
        iccp_sampling_release(s);
        return status;
    }
    *out = s;
    return ICC_OK;
}

void iccp_sampling_save(const icc_sampling *sampling, size_t capacity, void *data, size_t *n_bytes)
{
    icc_sampling_info info = sampling->info;
    icc_shape *shape = sampling->shape;
    double *points = sampling->points;
    iccp_blob b;
    iccp_blob_begin(&b, data, capacity, KIND, VERSION);
    (void)iccp_shape_visit(&b, &shape, NULL, NULL);
    visit(&b, &info, &points);
    iccp_blob_end(&b, n_bytes);
}

icc_status iccp_sampling_load(icc_sampling **out, size_t n_bytes, const void *data,
                              const iccp_env *env, icc_error *err)
{
    iccp_blob b;
    *out = NULL;
    icc_status status = iccp_blob_open(&b, data, n_bytes, KIND, VERSION, &env->memory, err);
    const iccp_env whole = iccp_part(env, "load", 0, 1);
    if (status == ICC_OK)
        status = read_sampling(out, &b, &whole, err);
    if (status != ICC_OK || iccp_blob_done(&b))
        return status;
    iccp_sampling_release(*out);
    *out = NULL;
    return iccp_fail(err, ICC_ERR_FORMAT, "bytes are left over");
}
