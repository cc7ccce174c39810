#include "kernel/sampling_file.h"

#include "base/error.h"

#include <math.h>

static const char KIND[] = "SMPL";
static const uint32_t VERSION = 1;

void iccp_sampling_write(const icc_sampling *sampling, iccp_blob_writer *w)
{
    const icc_sampling_info *info = &sampling->info;
    iccp_shape_write(sampling->shape, w);
    iccp_blob_u64(w, (uint64_t)info->kind);
    iccp_blob_u64(w, info->n_edge);
    iccp_blob_u64(w, info->n_samples);
    iccp_blob_f64(w, 1, &info->spacing);
    iccp_blob_f64(w, 1, &info->nearest);
    iccp_blob_f64(w, 1, &info->sigma);
    iccp_blob_f64(w, info->n_samples * sampling->shape->dim, sampling->points);
}

static bool sound(const icc_sampling_info *info)
{
    return info->kind >= ICC_SAMPLING_GRID && info->kind <= ICC_SAMPLING_POINTS &&
           info->n_samples > 0 && info->n_edge <= info->n_samples && isfinite(info->spacing) &&
           info->spacing > 0 && isfinite(info->nearest) && info->nearest >= 0 &&
           isfinite(info->sigma) && info->sigma > 0;
}

static icc_status read_points(icc_sampling *s, iccp_blob_reader *r)
{
    const size_t n = s->info.n_samples * s->shape->dim;
    s->points = iccp_alloc(&s->memory, s->info.n_samples, s->shape->dim * sizeof *s->points);
    if (s->points == NULL)
        return ICC_ERR_MEMORY;
    iccp_blob_read_f64(r, n, s->points);
    bool finite = !r->failed;
    for (size_t i = 0; i < n; ++i)
        finite &= isfinite(s->points[i]) != 0;
    return finite ? ICC_OK : ICC_ERR_FORMAT;
}

static icc_status read_samples(icc_sampling *s, iccp_blob_reader *r)
{
    const uint64_t kind = iccp_blob_read_u64(r), n_edge = iccp_blob_read_u64(r);
    s->info = (icc_sampling_info){.dim = (int32_t)s->shape->dim};
    s->info.n_samples = iccp_blob_read_count(r, s->shape->dim * 8);
    iccp_blob_read_f64(r, 1, &s->info.spacing);
    iccp_blob_read_f64(r, 1, &s->info.nearest);
    iccp_blob_read_f64(r, 1, &s->info.sigma);
    s->info.kind = kind <= ICC_SAMPLING_POINTS ? (int32_t)kind : 0;
    s->info.n_edge = n_edge <= s->info.n_samples ? (size_t)n_edge : SIZE_MAX;
    return !r->failed && sound(&s->info) ? read_points(s, r) : ICC_ERR_FORMAT;
}

icc_status iccp_sampling_read(icc_sampling **out, iccp_blob_reader *r, const iccp_env *env,
                              icc_error *err)
{
    *out = NULL;
    icc_sampling *s = iccp_alloc_zero(&env->memory, 1, sizeof *s);
    if (s == NULL)
        return iccp_fail_memory(err);
    s->memory = env->memory;
    atomic_init(&s->references, 1);
    icc_status status = iccp_shape_read(&s->shape, r, env, err);
    if (status == ICC_OK) {
        status = read_samples(s, r);
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
    iccp_blob_writer w;
    iccp_blob_begin(&w, data, capacity, KIND, VERSION);
    iccp_sampling_write(sampling, &w);
    iccp_blob_end(&w, n_bytes);
}

icc_status iccp_sampling_load(icc_sampling **out, size_t n_bytes, const void *data,
                              const iccp_env *env, icc_error *err)
{
    iccp_blob_reader r;
    *out = NULL;
    icc_status status = iccp_blob_open(&r, data, n_bytes, KIND, VERSION, err);
    if (status == ICC_OK)
        status = iccp_sampling_read(out, &r, env, err);
    if (status != ICC_OK || iccp_blob_done(&r))
        return status;
    iccp_sampling_release(*out);
    *out = NULL;
    return iccp_fail(err, ICC_ERR_FORMAT, "bytes are left over");
}
