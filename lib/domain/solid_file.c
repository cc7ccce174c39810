/* Reads and writes solids with features, and their meshes. */
#include "domain/solid_file.h"

#include "domain/domain_file.h"
#include "domain/solid_domain.h"
#include "domain/solid_mesh.h"

#include <string.h>

/* Data that a solid is made from. */
typedef struct parts {
    iccp_outer outer;
    size_t n, n_vertices, n_facets; /* features; all vertices and facets */
    uint32_t *head;                 /* kind, vertices and facets of each feature */
    double *vertices;
    uint32_t *facets;
    icc_feature *features;
} parts;

/* ---- boundary and features ---- */

static void write_solid(iccp_blob *b, const icc_domain *d)
{
    iccp_features *features = d->features;
    iccp_blob_size(b, &features->n_outer);
    iccp_blob_size(b, &features->n_outer_facets);
    iccp_blob_size(b, &features->n);
    for (size_t f = 0; f < features->n; ++f) {
        const iccp_feature *item = &features->item[f];
        uint32_t head[3] = {(uint32_t)item->kind, item->n, item->n_facets};
        iccp_blob_u32(b, 3, head);
    }
    iccp_blob_f64(b, 3 * d->n_vertices, d->given);
    iccp_blob_u32(b, 3 * features->n_places, d->facets);
}

/* Reads the counts, each of which must be possible for a solid. */
static void read_head(iccp_blob *b, parts *p)
{
    iccp_blob_count(b, 3 * ICCP_F64, &p->outer.n_vertices);
    iccp_blob_count(b, 3 * ICCP_U32, &p->outer.n_facets);
    iccp_blob_count(b, 3 * ICCP_U32, &p->n);
    iccp_blob_require(b, p->outer.n_vertices <= ICCP_MAX_COUNT &&
                             p->outer.n_facets <= ICCP_MAX_COUNT && p->n > 0 &&
                             p->n <= ICCP_MAX_COUNT);
    iccp_blob_array_u32(b, 3 * p->n, &p->head);
    p->n_vertices = p->outer.n_vertices;
    p->n_facets = p->outer.n_facets;
    for (size_t f = 0; f < p->n && b->status == ICC_OK; ++f) {
        const uint32_t *head = p->head + 3 * f;
        const bool is_surface = head[0] <= INT32_MAX && iccp_feature_is_ring((int32_t)head[0]);
        iccp_blob_require(
            b, head[0] <= INT32_MAX && iccp_feature_allows(3, (int32_t)head[0], head[1]) &&
                   (head[2] > 0) == is_surface && head[1] <= ICCP_MAX_COUNT - p->n_vertices &&
                   head[2] <= ICCP_MAX_COUNT - p->n_facets);
        p->n_vertices += b->status == ICC_OK ? head[1] : 0;
        p->n_facets += b->status == ICC_OK ? head[2] : 0;
    }
}

/* Lists the facets of features of a kind in their own numbers. */
static uint32_t *take_facets(const parts *p, int32_t kind, uint32_t *next)
{
    uint32_t first = (uint32_t)p->outer.n_vertices;
    for (size_t f = 0; f < p->n; ++f) {
        icc_feature *feature = &p->features[f];
        if (feature->kind == kind) {
            feature->facets = next;
            for (size_t i = 0; i < 3 * feature->n_facets; ++i)
                *next++ -= first;
        }
        first += (uint32_t)feature->n_vertices;
    }
    return next;
}

static void read_arrays(iccp_blob *b, parts *p)
{
    iccp_blob_array_f64(b, 3 * p->n_vertices, &p->vertices);
    iccp_blob_array_u32(b, 3 * p->n_facets, &p->facets);
    p->features = iccp_blob_alloc(b, p->n, sizeof *p->features);
    if (b->status != ICC_OK)
        return;
    p->outer.vertices = p->vertices;
    p->outer.facets = p->facets;
    const double *next = p->vertices + 3 * p->outer.n_vertices;
    for (size_t f = 0; f < p->n; ++f) {
        const uint32_t *head = p->head + 3 * f;
        p->features[f] = (icc_feature){.size = sizeof(icc_feature),
                                       .kind = (int32_t)head[0],
                                       .n_vertices = head[1],
                                       .vertices = next,
                                       .n_facets = head[2]};
        next += 3 * (size_t)head[1];
    }
    uint32_t *facets = p->facets + 3 * p->outer.n_facets;
    facets = take_facets(p, ICC_FEATURE_HOLE, facets);
    (void)take_facets(p, ICC_FEATURE_REGION, facets);
}

static icc_status read_solid(iccp_blob *b, icc_domain **domain, const iccp_env *env)
{
    parts p = {.n = 0};
    read_head(b, &p);
    if (b->status == ICC_OK)
        read_arrays(b, &p);
    icc_status status = b->status;
    if (status == ICC_OK)
        status = iccp_domain_create_solid(domain, &p.outer, p.n, p.features, env, NULL);
    iccp_free(&env->memory, p.head);
    iccp_free(&env->memory, p.vertices);
    iccp_free(&env->memory, p.facets);
    iccp_free(&env->memory, p.features);
    return status;
}

/* ---- meshes ---- */

/* Visits a mesh without its first points, which are the solid's. */
static void visit_mesh(iccp_blob *b, iccp_simplices *mesh, const icc_domain *solid)
{
    const size_t n_first = solid->n_vertices;
    size_t n_inner = mesh->n_points - n_first;
    iccp_blob_count(b, 3 * ICCP_F64, &n_inner);
    iccp_blob_count(b, 4 * ICCP_U32, &mesh->n_simplices);
    iccp_blob_count(b, 3 * ICCP_U32 + ICCP_F64, &mesh->n_on_lines);
    iccp_blob_require(b, n_inner <= ICCP_MAX_COUNT - n_first && mesh->n_simplices > 0 &&
                             mesh->n_simplices <= ICCP_MAX_COUNT && mesh->n_on_lines <= n_inner);
    if (b->reads && b->status == ICC_OK) {
        mesh->n_points = n_first + n_inner;
        mesh->points = iccp_blob_alloc(b, mesh->n_points, 3 * sizeof *mesh->points);
        mesh->on_line = iccp_blob_alloc(b, mesh->n_on_lines, sizeof *mesh->on_line);
    }
    if (b->status != ICC_OK)
        return;
    if (b->reads)
        memcpy(mesh->points, solid->vertices, 3 * n_first * sizeof *mesh->points);
    iccp_blob_f64(b, 3 * n_inner, mesh->points + 3 * n_first);
    iccp_blob_array_u32(b, 4 * mesh->n_simplices, &mesh->corners);
    for (size_t i = 0; i < mesh->n_on_lines && b->status == ICC_OK; ++i) {
        iccp_on_line *p = &mesh->on_line[i];
        uint32_t numbers[3] = {p->point, p->a, p->b};
        iccp_blob_u32(b, 3, numbers);
        iccp_blob_f64(b, 1, &p->share);
        p->point = numbers[0];
        p->a = numbers[1];
        p->b = numbers[2];
    }
}

/* Reads a mesh that is not checked yet. NULL if that fails. */
static iccp_simplices *read_simplices(iccp_blob *b, const icc_domain *solid)
{
    iccp_simplices *mesh = iccp_blob_alloc(b, 1, sizeof *mesh);
    if (mesh == NULL)
        return NULL;
    *mesh = (iccp_simplices){.memory = b->memory, .dim = 3, .n_points = solid->n_vertices};
    visit_mesh(b, mesh, solid);
    if (b->status == ICC_OK)
        iccp_blob_require(b, iccp_are_local(3, 3 * mesh->n_points, mesh->points));
    if (b->status == ICC_OK)
        return mesh;
    iccp_simplices_free(mesh);
    return NULL;
}

static icc_status as_format(icc_status status)
{
    return status == ICC_ERR_CERTIFICATE || status == ICC_ERR_BOUNDARY ? ICC_ERR_FORMAT : status;
}

/* Replaces a solid by one with the mesh that follows in the bytes. */
static icc_status read_mesh(iccp_blob *b, icc_domain **domain, const iccp_env *env)
{
    icc_domain *solid = *domain;
    iccp_simplices *mesh = read_simplices(b, solid);
    if (mesh == NULL)
        return b->status;
    const icc_status status = iccp_domain_create_solid_mesh(domain, solid, mesh, env, NULL);
    iccp_domain_release(solid);
    return as_format(status);
}

icc_status iccp_solid_filling_visit(iccp_blob *b, iccp_simplices **mesh, const icc_domain *solid,
                                    const iccp_env *env)
{
    if (b->reads)
        *mesh = NULL;
    if (!iccp_blob_follows(b, *mesh))
        return b->status;
    if (!b->reads) {
        iccp_simplices copy = **mesh;
        visit_mesh(b, &copy, solid);
        return b->status;
    }
    *mesh = read_simplices(b, solid);
    if (*mesh == NULL)
        return b->status;
    const icc_status status = iccp_solid_mesh_check(solid, *mesh, env, NULL);
    if (status != ICC_OK) {
        iccp_simplices_free(*mesh);
        *mesh = NULL;
    }
    return as_format(status);
}

/* ---- both ---- */

icc_status iccp_solid_visit(iccp_blob *b, icc_domain **domain, const iccp_env *env)
{
    icc_status status = ICC_OK;
    if (b->reads)
        status = read_solid(b, domain, env);
    else
        write_solid(b, *domain);
    if (status != ICC_OK)
        return status;
    if (!iccp_blob_follows(b, (*domain)->mesh))
        return b->status;
    if (b->reads)
        return read_mesh(b, domain, env);
    iccp_simplices copy = *(*domain)->mesh;
    visit_mesh(b, &copy, *domain);
    return ICC_OK;
}
