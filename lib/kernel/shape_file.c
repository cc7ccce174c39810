#include "kernel/shape_file.h"

#include "base/error.h"
#include "domain/domain_file.h"

void iccp_shape_write(const icc_shape *shape, iccp_blob_writer *w)
{
    iccp_blob_u64(w, shape->dim);
    iccp_blob_u64(w, shape->n_regions);
    iccp_blob_u64(w, shape->n_vertices);
    iccp_blob_u64(w, shape->n_segments);
    for (size_t r = 0; r < shape->n_regions; ++r)
        iccp_boundary_write(shape->regions[r], w);
    iccp_blob_f64(w, shape->n_vertices * shape->dim, shape->vertices);
    iccp_blob_u32(w, shape->n_segments * 2, shape->segments);
}

typedef struct curves {
    size_t n_vertices, n_segments;
    double *vertices;
    uint32_t *segments;
} curves;

static icc_status read_curves(curves *c, size_t dim, iccp_blob_reader *r, const iccp_env *env)
{
    c->vertices = iccp_alloc(&env->memory, c->n_vertices, dim * sizeof *c->vertices);
    c->segments = iccp_alloc(&env->memory, c->n_segments, 2 * sizeof *c->segments);
    if (c->vertices == NULL || c->segments == NULL)
        return ICC_ERR_MEMORY;
    iccp_blob_read_f64(r, c->n_vertices * dim, c->vertices);
    iccp_blob_read_u32(r, c->n_segments * 2, c->segments);
    return r->failed ? ICC_ERR_FORMAT : ICC_OK;
}

icc_status iccp_shape_read(icc_shape **out, iccp_blob_reader *r, const iccp_env *env,
                           icc_error *err)
{
    const uint64_t dim = iccp_blob_read_u64(r);
    *out = NULL;
    if (dim != 2 && dim != 3)
        return iccp_blob_blame(err, ICC_ERR_FORMAT, "shape");
    const size_t n_regions = iccp_blob_read_count(r, 2 * ICCP_F64);
    curves c = {.n_vertices = iccp_blob_read_count(r, (size_t)dim * ICCP_F64)};
    c.n_segments = iccp_blob_read_count(r, 2 * ICCP_U32);
    if (r->failed || n_regions + c.n_segments == 0 || n_regions >= ICCP_NOWHERE)
        return iccp_blob_blame(err, ICC_ERR_FORMAT, "shape");
    icc_domain **regions = iccp_alloc_zero(&env->memory, n_regions, sizeof *regions);
    icc_status status = regions != NULL ? ICC_OK : iccp_fail_memory(err);
    for (size_t i = 0; status == ICC_OK && i < n_regions; ++i)
        status = iccp_boundary_read(&regions[i], (int32_t)dim, r, env);
    if (status == ICC_OK)
        status = read_curves(&c, (size_t)dim, r, env);
    if (status == ICC_OK)
        status = iccp_shape_create(out, (int32_t)dim, n_regions, (const icc_domain *const *)regions,
                                   c.n_vertices, c.vertices, c.n_segments, c.segments, env, NULL);
    for (size_t i = 0; regions != NULL && i < n_regions; ++i)
        iccp_domain_release(regions[i]);
    iccp_free(&env->memory, regions);
    iccp_free(&env->memory, c.vertices);
    iccp_free(&env->memory, c.segments);
    return iccp_blob_blame(err, status, "shape");
}
