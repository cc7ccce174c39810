/* Shapes as part of other objects' bytes. */
#include "kernel/sampling/shape_file.h"

#include "domain/domain_file.h"

/* Data that a shape is made from. When a shape is written, they are its own. */
typedef struct parts {
    uint64_t dim;
    size_t n_regions, n_vertices, n_segments;
    icc_domain **regions;
    double *vertices;
    uint32_t *segments;
} parts;

/* Regions follow the counts, and each has counts of its own. */
static icc_status visit(iccp_blob *b, parts *p, const iccp_env *env)
{
    icc_status status = ICC_OK;
    iccp_blob_u64(b, 1, &p->dim);
    iccp_blob_require(b, p->dim == 2 || p->dim == 3);
    iccp_blob_count(b, 2 * ICCP_F64, &p->n_regions);
    iccp_blob_count(b, (size_t)p->dim * ICCP_F64, &p->n_vertices);
    iccp_blob_count(b, 2 * ICCP_U32, &p->n_segments);
    iccp_blob_require(b, p->n_regions + p->n_segments > 0 && p->n_regions < ICCP_NOWHERE);
    if (b->reads)
        p->regions = iccp_blob_alloc(b, p->n_regions, sizeof(icc_domain *));
    for (size_t i = 0; b->reads && p->regions != NULL && i < p->n_regions; ++i)
        p->regions[i] = NULL;
    if (b->status != ICC_OK)
        return b->status;
    for (size_t i = 0; status == ICC_OK && i < p->n_regions; ++i)
        status = iccp_boundary_visit(b, &p->regions[i], (int32_t)p->dim, env);
    if (status != ICC_OK)
        return status;
    iccp_blob_array_f64(b, p->n_vertices * (size_t)p->dim, &p->vertices);
    iccp_blob_array_u32(b, p->n_segments * 2, &p->segments);
    return b->status;
}

static icc_status read_shape(icc_shape **out, iccp_blob *b, const iccp_env *env)
{
    parts p = {0};
    icc_status status = visit(b, &p, env);
    if (status == ICC_OK)
        status = iccp_shape_create(out, (int32_t)p.dim, p.n_regions,
                                   (const icc_domain *const *)p.regions, p.n_vertices, p.vertices,
                                   p.n_segments, p.segments, env, NULL);
    for (size_t i = 0; p.regions != NULL && i < p.n_regions; ++i)
        iccp_domain_release(p.regions[i]);
    iccp_free(&env->memory, p.regions);
    iccp_free(&env->memory, p.vertices);
    iccp_free(&env->memory, p.segments);
    return status;
}

icc_status iccp_shape_visit(iccp_blob *b, icc_shape **shape, const iccp_env *env, icc_error *err)
{
    if (b->reads) {
        *shape = NULL;
        return iccp_blob_blame(err, read_shape(shape, b, env), "shape");
    }
    const icc_shape *s = *shape;
    parts p = {s->dim,     s->n_regions, s->n_vertices, s->n_segments,
               s->regions, s->vertices,  s->segments};
    return visit(b, &p, env);
}
