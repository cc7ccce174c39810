#include "domain/domain_file.h"

#include "domain/mask.h"
#include "domain/mask_boundary.h"
#include "domain/mesh_domain.h"
#include "math/orient.h"

#include <math.h>
#include <string.h>

enum { BOUNDARY = 1, MASK = 2, MESH = 3 };

static size_t read_count(iccp_blob_reader *r, size_t size)
{
    const size_t count = iccp_blob_read_count(r, size);
    r->failed = r->failed || count > ICCP_MAX_COUNT;
    return r->failed ? 0 : count;
}

bool iccp_are_local(size_t dim, size_t n, const double *numbers)
{
    /* Differences are whole multiples of 2^-53 of that, so products of two or three are above the
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

void iccp_boundary_write(const icc_domain *d, iccp_blob_writer *w)
{
    const size_t dim = (size_t)d->dim;
    iccp_blob_u64(w, d->n_vertices);
    iccp_blob_u64(w, d->n_facets);
    iccp_blob_f64(w, d->n_vertices * dim, d->given);
    iccp_blob_u32(w, d->n_facets * dim, d->facets);
}

icc_status iccp_boundary_read(icc_domain **out, int32_t dim, iccp_blob_reader *r,
                              const iccp_env *env)
{
    const size_t d = (size_t)dim;
    const size_t n_vertices = read_count(r, d * ICCP_F64), n_facets = read_count(r, d * ICCP_U32);
    *out = NULL;
    if (r->failed)
        return ICC_ERR_FORMAT;
    double *vertices = iccp_alloc(&env->memory, n_vertices, d * sizeof *vertices);
    uint32_t *facets = iccp_alloc(&env->memory, n_facets, d * sizeof *facets);
    icc_status status = ICC_ERR_MEMORY;
    if (vertices != NULL && facets != NULL) {
        iccp_blob_read_f64(r, n_vertices * d, vertices);
        iccp_blob_read_u32(r, n_facets * d, facets);
        status = r->failed ? ICC_ERR_FORMAT
                           : iccp_domain_create(out, dim, n_vertices, vertices, n_facets, facets,
                                                env, NULL);
    }
    iccp_free(&env->memory, vertices);
    iccp_free(&env->memory, facets);
    return status;
}

/* ---- masks ---- */

/* Goes on to the next cell, the first axis fastest; false at the end. */
static bool next_cell(int32_t dim, const size_t *shape, size_t *at)
{
    for (int32_t k = 0; k < dim; ++k) {
        if (++at[k] < shape[k])
            return true;
        at[k] = 0;
    }
    return false;
}

static bool has_cell(const iccp_mask *mask, const size_t *at)
{
    size_t cell = 0;
    for (int32_t k = 0; k < mask->dim; ++k)
        cell += (at[k] + 1) * mask->stride[k];
    return mask->cells[cell] != 0;
}

/* 32 cells to a word. */
static void write_mask(const iccp_mask *mask, iccp_blob_writer *w)
{
    size_t at[ICC_MAX_DIM] = {0};
    bool more = true;
    for (int32_t k = 0; k < mask->dim; ++k)
        iccp_blob_u64(w, mask->shape[k]);
    while (more) {
        uint32_t word = 0;
        for (int bit = 0; bit < 32 && more; ++bit) {
            word |= (uint32_t)has_cell(mask, at) << bit;
            more = next_cell(mask->dim, mask->shape, at);
        }
        iccp_blob_u32(w, 1, &word);
    }
}

/* The number of cells; 0 if their bytes are not there. */
static size_t read_shape(iccp_blob_reader *r, int32_t dim, size_t *shape)
{
    uint64_t n = 1;
    for (int32_t k = 0; k < dim; ++k) {
        const uint64_t side = iccp_blob_read_u64(r);
        if (r->failed || side == 0 || side > ICCP_MAX_LATTICE / n)
            return 0;
        shape[k] = (size_t)side;
        n *= side;
    }
    return (n + 31) / 32 <= (r->n - r->at) / ICCP_U32 ? (size_t)n : 0;
}

static bool read_cells(iccp_blob_reader *r, size_t n, uint8_t *cells)
{
    uint32_t word = 0;
    for (size_t i = 0; i < n; ++i) {
        if (i % 32 == 0)
            iccp_blob_read_u32(r, 1, &word);
        cells[i] = word & 1;
        word >>= 1;
    }
    return !r->failed && word == 0;
}

static icc_status read_mask(icc_domain **out, int32_t dim, iccp_blob_reader *r, const iccp_env *env)
{
    size_t shape[ICC_MAX_DIM];
    const size_t n = read_shape(r, dim, shape);
    if (n == 0)
        return ICC_ERR_FORMAT;
    uint8_t *cells = iccp_alloc(&env->memory, n, 1);
    icc_status status = ICC_ERR_MEMORY;
    if (cells != NULL)
        status = read_cells(r, n, cells)
                     ? iccp_domain_create_mask(out, dim, shape, cells, env, NULL)
                     : ICC_ERR_FORMAT;
    iccp_free(&env->memory, cells);
    return status;
}

/* ---- meshes ---- */

/* What the caller gave, exactly: the frame loses nothing but the sign of a zero. */
static void write_given(const icc_domain *d, const double *local, iccp_blob_writer *w)
{
    double given[ICC_MAX_DIM];
    iccp_frame_out(&d->frame, d->dim, local, given);
    for (int32_t k = 0; k < d->dim; ++k)
        if (given[k] == 0)
            given[k] = copysign(0, local[k]);
    iccp_blob_f64(w, (size_t)d->dim, given);
}

static void write_mesh(const icc_domain *d, iccp_blob_writer *w)
{
    const iccp_simplices *mesh = d->mesh;
    iccp_blob_u64(w, mesh->n_points);
    iccp_blob_u64(w, mesh->n_simplices);
    iccp_blob_u64(w, mesh->n_facets);
    iccp_blob_f64(w, mesh->dim * mesh->n_boundary, d->given);
    for (size_t v = mesh->n_boundary; v < mesh->n_points; ++v)
        write_given(d, mesh->points + mesh->dim * v, w);
    iccp_blob_u32(w, (mesh->dim + 1) * mesh->n_simplices, mesh->corners);
    iccp_blob_u32(w, mesh->dim * mesh->n_facets, d->facets);
}

/* As they were numbered when the domain was first made: none is left out, and those of the boundary
 * come first. */
static bool keeps_order(const iccp_simplices *mesh, size_t n_points, const uint32_t *corners)
{
    bool same = mesh->n_points == n_points;
    for (size_t v = 0; same && v < n_points; ++v)
        same = mesh->given[v] == v;
    return same && memcmp(mesh->corners, corners,
                          (mesh->dim + 1) * mesh->n_simplices * sizeof *corners) == 0;
}

static icc_status read_mesh(icc_domain **out, int32_t dim, iccp_blob_reader *r, const iccp_env *env)
{
    const size_t d = (size_t)dim, n_points = read_count(r, d * ICCP_F64);
    const size_t n_simplices = read_count(r, (d + 1) * ICCP_U32),
                 n_facets = read_count(r, d * ICCP_U32);
    if (r->failed || n_simplices == 0)
        return ICC_ERR_FORMAT;
    double *points = iccp_alloc(&env->memory, n_points, d * sizeof *points);
    uint32_t *corners = iccp_alloc(&env->memory, n_simplices, (d + 1) * sizeof *corners);
    uint32_t *facets = iccp_alloc(&env->memory, n_facets, d * sizeof *facets);
    icc_status status = ICC_ERR_MEMORY;
    if (points != NULL && corners != NULL && facets != NULL) {
        iccp_blob_read_f64(r, n_points * d, points);
        iccp_blob_read_u32(r, n_simplices * (d + 1), corners);
        iccp_blob_read_u32(r, n_facets * d, facets);
        status = r->failed ? ICC_ERR_FORMAT
                           : iccp_domain_create_mesh(out, dim, n_points, points, n_simplices,
                                                     corners, n_facets, facets, env, NULL);
    }
    if (status == ICC_OK && !keeps_order((*out)->mesh, n_points, corners))
        status = ICC_ERR_FORMAT;
    iccp_free(&env->memory, points);
    iccp_free(&env->memory, corners);
    iccp_free(&env->memory, facets);
    return status;
}

/* ---- any ---- */

void iccp_domain_write(const icc_domain *domain, iccp_blob_writer *w)
{
    const uint32_t kind = domain->mask != NULL ? MASK : domain->mesh != NULL ? MESH : BOUNDARY;
    const uint32_t head[2] = {(uint32_t)domain->dim, kind};
    iccp_blob_u32(w, 2, head);
    if (kind == MASK)
        write_mask(domain->mask, w);
    else if (kind == MESH)
        write_mesh(domain, w);
    else
        iccp_boundary_write(domain, w);
}

icc_status iccp_domain_read(icc_domain **out, iccp_blob_reader *r, const iccp_env *env)
{
    uint32_t head[2];
    icc_status status = ICC_ERR_FORMAT;
    *out = NULL;
    iccp_blob_read_u32(r, 2, head);
    if (head[0] < 2 || head[0] > ICC_MAX_DIM)
        return ICC_ERR_FORMAT;
    if (head[1] == BOUNDARY)
        status = iccp_boundary_read(out, (int32_t)head[0], r, env);
    else if (head[1] == MASK)
        status = read_mask(out, (int32_t)head[0], r, env);
    else if (head[1] == MESH)
        status = read_mesh(out, (int32_t)head[0], r, env);
    if (status != ICC_OK) {
        iccp_domain_release(*out);
        *out = NULL;
    }
    return status;
}

/* ---- other meshes of a domain ---- */

void iccp_filling_write(const iccp_simplices *mesh, iccp_blob_writer *w)
{
    const size_t n_inner = mesh->n_points - mesh->n_boundary;
    iccp_blob_u64(w, n_inner);
    iccp_blob_u64(w, mesh->n_simplices);
    iccp_blob_f64(w, mesh->dim * n_inner, mesh->points + mesh->dim * mesh->n_boundary);
    iccp_blob_u32(w, (mesh->dim + 1) * mesh->n_simplices, mesh->corners);
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

static icc_status fill(iccp_simplices *mesh, const icc_domain *domain, size_t n_inner,
                       iccp_blob_reader *r)
{
    const size_t dim = mesh->dim, n_boundary = mesh->n_boundary, n_simplices = mesh->n_simplices;
    mesh->points = iccp_alloc(&mesh->memory, mesh->n_points, dim * sizeof *mesh->points);
    mesh->corners = iccp_alloc(&mesh->memory, n_simplices, (dim + 1) * sizeof *mesh->corners);
    if (mesh->points == NULL || mesh->corners == NULL)
        return ICC_ERR_MEMORY;
    double *inner = mesh->points + dim * n_boundary;
    memcpy(mesh->points, domain->vertices, dim * n_boundary * sizeof *mesh->points);
    iccp_blob_read_f64(r, dim * n_inner, inner);
    iccp_blob_read_u32(r, (dim + 1) * n_simplices, mesh->corners);
    return !r->failed && iccp_are_local(dim, dim * n_inner, inner) ? check_filling(mesh, domain)
                                                                   : ICC_ERR_FORMAT;
}

icc_status iccp_filling_read(iccp_simplices **out, const icc_domain *domain, iccp_blob_reader *r,
                             const iccp_env *env)
{
    const size_t dim = (size_t)domain->dim;
    const size_t n_inner = read_count(r, dim * ICCP_F64),
                 n_simplices = read_count(r, (dim + 1) * ICCP_U32);
    *out = NULL;
    if (r->failed || n_simplices == 0)
        return ICC_ERR_FORMAT;
    iccp_simplices *mesh = iccp_alloc_zero(&env->memory, 1, sizeof *mesh);
    if (mesh == NULL)
        return ICC_ERR_MEMORY;
    *mesh = (iccp_simplices){.memory = env->memory,
                             .dim = dim,
                             .n_points = domain->n_vertices + n_inner,
                             .n_boundary = domain->n_vertices,
                             .n_simplices = n_simplices};
    const icc_status status = fill(mesh, domain, n_inner, r);
    if (status == ICC_OK)
        *out = mesh;
    else
        iccp_simplices_free(mesh);
    return status;
}
