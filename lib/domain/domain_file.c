/* Reads and writes domains as part of other objects' bytes. */
#include "domain/domain_file.h"

#include "domain/features_file.h"
#include "domain/mask.h"
#include "domain/mask_boundary.h"
#include "domain/mesh_domain.h"
#include "domain/solid_file.h"
#include "math/orient.h"

#include <math.h>
#include <string.h>

enum { BOUNDARY = 1, MASK = 2, MESH = 3, FEATURES = 4 };

/* Arrays that a domain is made from. When a domain is written, they are its own arrays. */
typedef struct parts {
    size_t n_points, n_simplices, n_facets;
    double *points;
    uint32_t *corners, *facets;
} parts;

static void free_parts(parts *p, const iccp_memory *memory)
{
    iccp_free(memory, p->points);
    iccp_free(memory, p->corners);
    iccp_free(memory, p->facets);
}

static void visit_count(iccp_blob *b, size_t size, size_t *n)
{
    iccp_blob_count(b, size, n);
    iccp_blob_require(b, *n <= ICCP_MAX_COUNT);
}

bool iccp_are_local(size_t dim, size_t n, const double *numbers)
{
    /* Differences are whole multiples of 2^-53 times this, so products of two or three exceed the
     * least double. */
    const double least = ldexp(1, dim == 2 ? -420 : -280);
    for (size_t i = 0; i < n; ++i) {
        const double size = fabs(numbers[i]);
        if (!(size <= 2) || (size > 0 && size < least))
            return false;
    }
    return true;
}

/* ---- boundaries ---- */

/* Writes the vertices as they were given, a few at a time. */
static void write_vertices(iccp_blob *b, const icc_domain *d)
{
    enum { SOME = 64 };
    double given[SOME * ICC_MAX_DIM];
    const size_t dim = (size_t)d->dim;
    for (size_t v = 0; v < d->n_vertices; v += SOME) {
        const size_t n = d->n_vertices - v < SOME ? d->n_vertices - v : SOME;
        for (size_t i = 0; i < n; ++i)
            iccp_domain_given(d, v + i, given + dim * i);
        iccp_blob_f64(b, dim * n, given);
    }
}

icc_status iccp_boundary_visit(iccp_blob *b, icc_domain **domain, int32_t dim, const iccp_env *env)
{
    const size_t d = (size_t)dim;
    parts p = {0};
    if (!b->reads)
        p = (parts){.n_points = (*domain)->n_vertices,
                    .n_facets = (*domain)->n_facets,
                    .facets = (*domain)->facets};
    visit_count(b, d * ICCP_F64, &p.n_points);
    visit_count(b, d * ICCP_U32, &p.n_facets);
    if (b->reads)
        iccp_blob_array_f64(b, d * p.n_points, &p.points);
    else
        write_vertices(b, *domain);
    iccp_blob_array_u32(b, d * p.n_facets, &p.facets);
    if (!b->reads)
        return ICC_OK;
    icc_status status = b->status;
    *domain = NULL;
    if (status == ICC_OK)
        status =
            iccp_domain_create(domain, dim, p.n_points, p.points, p.n_facets, p.facets, env, NULL);
    free_parts(&p, &env->memory);
    return status;
}

/* ---- masks ---- */

/* Advances to the next cell, first axis fastest. Returns false at the end. */
static bool next_cell(int32_t dim, const size_t *shape, size_t *at)
{
    for (int32_t k = 0; k < dim; ++k) {
        if (++at[k] < shape[k])
            return true;
        at[k] = 0;
    }
    return false;
}

/* Visits the cells, 32 to a word; bits beyond the last cell are 0. stride[k] leads from a cell to
 * the next one along axis k. */
static void visit_cells(iccp_blob *b, int32_t dim, const size_t *shape, const size_t *stride,
                        uint8_t *cells)
{
    size_t at[ICC_MAX_DIM] = {0};
    bool more = true;
    while (more && b->status == ICC_OK) {
        uint8_t *cell[32];
        uint32_t word = 0;
        int n = 0;
        for (; n < 32 && more; ++n) {
            cell[n] = cells;
            for (int32_t k = 0; k < dim; ++k)
                cell[n] += at[k] * stride[k];
            word |= b->reads ? 0 : (uint32_t)*cell[n] << n;
            more = next_cell(dim, shape, at);
        }
        iccp_blob_u32(b, 1, &word);
        iccp_blob_require(b, n == 32 || word >> n == 0);
        for (int bit = 0; bit < n && b->reads; ++bit)
            *cell[bit] = word >> bit & 1;
    }
}

/* Returns the number of cells. Their bytes are available unless reading has failed. */
static size_t visit_shape(iccp_blob *b, int32_t dim, size_t *shape)
{
    size_t n = 1;
    for (int32_t k = 0; k < dim; ++k) {
        iccp_blob_size(b, &shape[k]);
        iccp_blob_require(b, shape[k] > 0 && shape[k] <= ICCP_MAX_LATTICE / n);
        n *= b->status == ICC_OK ? shape[k] : 1;
    }
    iccp_blob_require(b, iccp_blob_has(b, (n + 31) / 32, ICCP_U32));
    return n;
}

static void write_mask(iccp_blob *b, iccp_mask *mask)
{
    size_t first = 0;
    for (int32_t k = 0; k < mask->dim; ++k)
        first += mask->stride[k];
    (void)visit_shape(b, mask->dim, mask->shape);
    visit_cells(b, mask->dim, mask->shape, mask->stride, mask->cells + first);
}

static icc_status read_mask(iccp_blob *b, icc_domain **domain, int32_t dim, const iccp_env *env)
{
    size_t shape[ICC_MAX_DIM] = {0}, stride[ICC_MAX_DIM] = {1};
    uint8_t *cells = iccp_blob_alloc(b, visit_shape(b, dim, shape), 1);
    for (int32_t k = 1; k < dim; ++k)
        stride[k] = stride[k - 1] * shape[k - 1];
    if (cells != NULL)
        visit_cells(b, dim, shape, stride, cells);
    icc_status status = b->status;
    if (status == ICC_OK)
        status = iccp_domain_create_mask(domain, dim, shape, cells, env, NULL);
    iccp_free(&env->memory, cells);
    return status;
}

/* ---- meshes ---- */

/* When a mesh is written, its points come from the domain, which knows the boundary's points as
 * given. */
static void visit_mesh(iccp_blob *b, size_t dim, parts *p, const icc_domain *from)
{
    visit_count(b, dim * ICCP_F64, &p->n_points);
    visit_count(b, (dim + 1) * ICCP_U32, &p->n_simplices);
    visit_count(b, dim * ICCP_U32, &p->n_facets);
    iccp_blob_require(b, p->n_simplices > 0);
    if (b->reads) {
        iccp_blob_array_f64(b, dim * p->n_points, &p->points);
    } else {
        double given[ICC_MAX_DIM];
        write_vertices(b, from);
        for (size_t v = from->n_vertices; v < p->n_points; ++v) {
            iccp_frame_restore(&from->frame, from->dim, p->points + dim * v, given);
            iccp_blob_f64(b, dim, given);
        }
    }
    iccp_blob_array_u32(b, (dim + 1) * p->n_simplices, &p->corners);
    iccp_blob_array_u32(b, dim * p->n_facets, &p->facets);
}

static void write_mesh(iccp_blob *b, const icc_domain *d)
{
    const iccp_simplices *mesh = d->mesh;
    parts p = {mesh->n_points, mesh->n_simplices, mesh->n_facets,
               mesh->points,   mesh->corners,     d->facets};
    visit_mesh(b, mesh->dim, &p, d);
}

/* Returns true if the points have the order that a new domain gives them: every point is used, and
 * those of the boundary come first. */
static bool keeps_order(const iccp_simplices *mesh, size_t n_points, const uint32_t *corners)
{
    bool same = mesh->n_points == n_points;
    for (size_t v = 0; same && v < n_points; ++v)
        same = mesh->given[v] == v;
    return same && memcmp(mesh->corners, corners,
                          (mesh->dim + 1) * mesh->n_simplices * sizeof *corners) == 0;
}

static icc_status read_mesh(iccp_blob *b, icc_domain **domain, int32_t dim, const iccp_env *env)
{
    parts p = {0};
    visit_mesh(b, (size_t)dim, &p, NULL);
    icc_status status = b->status;
    const icc_mesh mesh = {.dim = dim,
                           .n_vertices = p.n_points,
                           .vertices = p.points,
                           .n_cells = p.n_simplices,
                           .cells = p.corners};
    if (status == ICC_OK)
        status = iccp_domain_create_mesh(domain, &mesh, p.n_facets, p.facets, env, NULL);
    if (status == ICC_OK && !keeps_order((*domain)->mesh, p.n_points, p.corners))
        status = ICC_ERR_FORMAT;
    free_parts(&p, &env->memory);
    return status;
}

/* ---- any domain ---- */

static int32_t kind_of(const icc_domain *domain)
{
    if (domain->features != NULL)
        return FEATURES;
    return domain->mask != NULL ? MASK : domain->mesh != NULL ? MESH : BOUNDARY;
}

static icc_status visit_kind(iccp_blob *b, int32_t kind, icc_domain **domain, int32_t dim,
                             const iccp_env *env)
{
    if (kind == BOUNDARY)
        return iccp_boundary_visit(b, domain, dim, env);
    if (kind == FEATURES)
        return dim == 2   ? iccp_features_visit(b, domain, env)
               : dim == 3 ? iccp_solid_visit(b, domain, env)
                          : ICC_ERR_FORMAT;
    if (b->reads)
        return kind == MASK ? read_mask(b, domain, dim, env) : read_mesh(b, domain, dim, env);
    if (kind == MASK)
        write_mask(b, (*domain)->mask);
    else
        write_mesh(b, *domain);
    return ICC_OK;
}

/* Visits a domain of the kinds up to `last`. */
static icc_status visit_any(iccp_blob *b, icc_domain **domain, int32_t last, const iccp_env *env)
{
    int32_t dim = b->reads ? 0 : (*domain)->dim, kind = b->reads ? 0 : kind_of(*domain);
    if (b->reads)
        *domain = NULL;
    iccp_blob_i32(b, ICCP_U32, 2, ICC_MAX_DIM, &dim);
    iccp_blob_i32(b, ICCP_U32, BOUNDARY, last, &kind);
    const icc_status status =
        b->status == ICC_OK ? visit_kind(b, kind, domain, dim, env) : b->status;
    if (status != ICC_OK) {
        iccp_domain_release(*domain);
        *domain = NULL;
    }
    return status;
}

icc_status iccp_domain_visit(iccp_blob *b, icc_domain **domain, const iccp_env *env)
{
    return visit_any(b, domain, MESH, env);
}

icc_status iccp_domain_visit_any(iccp_blob *b, icc_domain **domain, const iccp_env *env)
{
    return visit_any(b, domain, FEATURES, env);
}

/* ---- other meshes of a domain ---- */

/* Visits a mesh without its boundary points, which are the domain's. */
static void visit_filling(iccp_blob *b, iccp_simplices *mesh, const icc_domain *domain)
{
    const size_t dim = mesh->dim, n_boundary = mesh->n_boundary;
    size_t n_inner = mesh->n_points - n_boundary;
    visit_count(b, dim * ICCP_F64, &n_inner);
    visit_count(b, (dim + 1) * ICCP_U32, &mesh->n_simplices);
    iccp_blob_require(b, mesh->n_simplices > 0);
    if (b->reads) {
        mesh->n_points = n_boundary + n_inner;
        mesh->points = iccp_blob_alloc(b, mesh->n_points, dim * sizeof *mesh->points);
    }
    if (b->status != ICC_OK)
        return;
    if (b->reads)
        memcpy(mesh->points, domain->vertices, dim * n_boundary * sizeof *mesh->points);
    iccp_blob_f64(b, dim * n_inner, mesh->points + dim * n_boundary);
    iccp_blob_array_u32(b, (dim + 1) * mesh->n_simplices, &mesh->corners);
}

static bool all_positive(const iccp_simplices *mesh)
{
    const size_t n = mesh->dim + 1;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const double *points[ICC_MAX_DIM + 1];
        for (size_t i = 0; i < n; ++i)
            points[i] = iccp_corner_point(mesh, n * s + i);
        if (iccp_orient(mesh->dim, points) != 1)
            return false;
    }
    return true;
}

static bool all_used(const iccp_simplices *mesh, bool *used)
{
    size_t n = 0;
    for (size_t side = 0; side < (mesh->dim + 1) * mesh->n_simplices; ++side) {
        n += !used[mesh->corners[side]];
        used[mesh->corners[side]] = true;
    }
    return n == mesh->n_points;
}

static icc_status check_filling(iccp_simplices *mesh, const icc_domain *domain)
{
    const size_t n_inner = mesh->n_points - mesh->n_boundary;
    if (!iccp_are_local(mesh->dim, mesh->dim * n_inner,
                        mesh->points + mesh->dim * mesh->n_boundary))
        return ICC_ERR_FORMAT;
    icc_status status = iccp_simplices_check_corners(mesh, NULL);
    if (status != ICC_OK)
        return status;
    bool *used = iccp_alloc_zero(&mesh->memory, mesh->n_points, sizeof *used);
    if (used == NULL)
        return ICC_ERR_MEMORY;
    const bool sound = all_used(mesh, used) && all_positive(mesh);
    iccp_free(&mesh->memory, used);
    if (!sound)
        return ICC_ERR_FORMAT;
    status = iccp_simplices_join(mesh, domain->n_facets, domain->facets, NULL);
    return status == ICC_OK ? iccp_simplices_check_shape(mesh, NULL) : status;
}

static icc_status read_filling(iccp_blob *b, iccp_simplices **out, const icc_domain *domain)
{
    iccp_simplices *mesh = *out = iccp_blob_alloc(b, 1, sizeof *mesh);
    if (mesh == NULL)
        return b->status;
    *mesh = (iccp_simplices){.memory = b->memory,
                             .dim = (size_t)domain->dim,
                             .n_points = domain->n_vertices,
                             .n_boundary = domain->n_vertices};
    visit_filling(b, mesh, domain);
    const icc_status status = b->status == ICC_OK ? check_filling(mesh, domain) : b->status;
    if (status != ICC_OK) {
        iccp_simplices_free(mesh);
        *out = NULL;
    }
    return status;
}

icc_status iccp_filling_visit(iccp_blob *b, iccp_simplices **mesh, const icc_domain *domain)
{
    if (b->reads)
        *mesh = NULL;
    if (!iccp_blob_follows(b, *mesh))
        return b->status;
    if (b->reads)
        return read_filling(b, mesh, domain);
    iccp_simplices copy = **mesh;
    visit_filling(b, &copy, domain);
    return ICC_OK;
}
