#include "map/higher/fill_higher.h"

#include "domain/mask.h"
#include "geometry/tuples.h"

#include <string.h>

/* Makes a mesh without corners whose points are those of the boundary, followed by n_inner that are
 * not written yet. */
static icc_status new_mesh(iccp_simplices **out, const icc_domain *domain, size_t n_inner,
                           size_t n_simplices, const iccp_env *env)
{
    const size_t dim = (size_t)domain->dim, n = domain->n_vertices + n_inner;
    iccp_simplices *mesh = *out = iccp_alloc_zero(&env->memory, 1, sizeof *mesh);
    if (mesh == NULL)
        return ICC_ERR_MEMORY;
    *mesh = (iccp_simplices){.memory = env->memory,
                             .dim = dim,
                             .n_points = n,
                             .n_boundary = domain->n_vertices,
                             .n_simplices = n_simplices};
    mesh->points = iccp_alloc_zero(&env->memory, n, dim * sizeof *mesh->points);
    mesh->corners = iccp_alloc(&env->memory, n_simplices, (dim + 1) * sizeof *mesh->corners);
    if (mesh->points == NULL || mesh->corners == NULL) {
        iccp_simplices_free(mesh);
        *out = NULL;
        return ICC_ERR_MEMORY;
    }
    memcpy(mesh->points, domain->vertices, dim * domain->n_vertices * sizeof *mesh->points);
    return ICC_OK;
}

static void exchange(uint32_t *a, uint32_t *b)
{
    const uint32_t kept = *a;
    *a = *b;
    *b = kept;
}

/* Finds the neighbours. Frees a mesh whose boundary is not the domain's, which would be an error of
 * this file. */
static icc_status join(iccp_simplices **mesh, const icc_domain *domain)
{
    const icc_status status = iccp_simplices_join(*mesh, domain->n_facets, domain->facets, NULL);
    if (status != ICC_OK) {
        iccp_simplices_free(*mesh);
        *mesh = NULL;
    }
    return status;
}

/* Writes the prism between a facet, whose vertices ascend, and its copy. Simplex j has corners 0 to
 * j of the copy, and the corners from j on of the facet. Every other one is turned round. */
static uint32_t *write_prism(uint32_t *corner, size_t dim, const uint32_t *facet, uint32_t copy,
                             bool odd)
{
    for (size_t j = 0; j < dim; ++j, corner += dim + 1) {
        for (size_t i = 0; i <= dim; ++i)
            corner[i] = i <= j ? facet[i] + copy : facet[i - 1];
        if (odd != (j % 2 != 0))
            exchange(&corner[0], &corner[dim]);
    }
    return corner;
}

icc_status iccp_fill_cone(iccp_simplices **out, const icc_domain *domain, size_t n_collars,
                          const iccp_env *env)
{
    const size_t dim = (size_t)domain->dim, n = domain->n_vertices;
    icc_status status =
        new_mesh(out, domain, n_collars * n + 1, (n_collars * dim + 1) * domain->n_facets, env);
    if (status != ICC_OK)
        return status;
    uint32_t *corner = (*out)->corners;
    for (size_t f = 0; f < domain->n_facets; ++f) {
        uint32_t facet[ICC_MAX_DIM];
        memcpy(facet, domain->facets + dim * f, dim * sizeof *facet);
        const bool odd = iccp_sort_vertices(dim, facet) != (domain->orientation < 0);
        for (size_t k = 0; k < n_collars; ++k) {
            corner = write_prism(corner, dim, facet, (uint32_t)n, odd);
            for (size_t i = 0; i < dim; ++i)
                facet[i] += (uint32_t)n;
        }
        corner[0] = (uint32_t)((n_collars + 1) * n);
        memcpy(corner + 1, facet, dim * sizeof *facet);
        if (odd)
            exchange(&corner[0], &corner[dim]);
        corner += dim + 1;
    }
    return join(out, domain);
}

/* ---- masks ---- */

typedef struct cells {
    const icc_domain *domain;
    const iccp_mask *mask;
    size_t n_lattice, stride[ICC_MAX_DIM]; /* of the cut lattice */
    uint32_t *number;                      /* by vertex of the cut lattice, or NONE */
    iccp_simplices *mesh;
    size_t n_filled; /* simplices that have their corners */
} cells;

static const uint32_t NONE = UINT32_MAX;

/* The middle of a cell in the cut lattice. */
static size_t middle_of(const cells *c, size_t cell)
{
    int64_t at[ICC_MAX_DIM];
    size_t middle = 0;
    (void)iccp_mask_coordinates(c->mask, cell, at);
    for (int32_t k = 0; k < c->mask->dim; ++k)
        middle += c->stride[k] * (size_t)(2 * at[k] + 1);
    return middle;
}

/* Boundary vertices have their numbers in the domain. */
static void number_boundary(const cells *c)
{
    for (size_t i = 0; i < c->n_lattice; ++i)
        c->number[i] = NONE;
    for (size_t v = 0; v < c->domain->n_vertices; ++v) {
        double point[ICC_MAX_DIM];
        size_t at = 0;
        iccp_domain_given(c->domain, v, point);
        for (int32_t k = 0; k < c->mask->dim; ++k)
            at += c->stride[k] * (size_t)(2 * point[k]);
        c->number[at] = (uint32_t)v;
    }
}

/* Numbers the other vertices of the mask's cells. Returns how many there are. */
static size_t number_inner(const cells *c)
{
    size_t at[ICC_MAX_DIM] = {0}, n = c->domain->n_vertices, index = 0;
    do {
        int n_axes;
        if (iccp_mask_block(c->mask, at, &n_axes) != 0 && c->number[index] == NONE)
            c->number[index] = (uint32_t)n++;
        ++index;
    } while (iccp_mask_next(c->mask, at));
    return n - c->domain->n_vertices;
}

static void place_inner(const cells *c)
{
    const size_t dim = c->mesh->dim;
    for (size_t i = 0; i < c->n_lattice; ++i) {
        double point[ICC_MAX_DIM];
        if (c->number[i] == NONE || c->number[i] < c->domain->n_vertices)
            continue;
        for (size_t k = 0; k < dim; ++k)
            point[k] = 0.5 * (double)(i / c->stride[k] % (2 * c->mask->shape[k] + 1));
        iccp_frame_in(&c->domain->frame, c->domain->dim, point,
                      c->mesh->points + dim * c->number[i]);
    }
}

/* Advances to the next order of n numbers. Returns false after the last, descending one. */
static bool next_order(size_t n, size_t *order)
{
    size_t i = n, j = n;
    while (i > 1 && order[i - 2] > order[i - 1])
        --i;
    if (i <= 1)
        return false;
    while (order[j - 1] < order[i - 2])
        --j;
    size_t kept = order[i - 2];
    order[i - 2] = order[j - 1];
    order[j - 1] = kept;
    for (size_t a = i - 1, b = n; a + 1 < b; ++a, --b) {
        kept = order[a];
        order[a] = order[b - 1];
        order[b - 1] = kept;
    }
    return true;
}

/* Joins the middle of a cell to the part of a face from `lowest` to one step further along the
 * axes other than `axis`. */
static void join_part(cells *c, size_t middle, size_t lowest, size_t axis)
{
    const size_t dim = c->mesh->dim;
    size_t order[ICC_MAX_DIM], n = 0;
    for (size_t k = 0; k < dim; ++k)
        if (k != axis)
            order[n++] = k;
    do {
        uint32_t *corner = c->mesh->corners + (dim + 1) * c->n_filled++;
        size_t at = lowest;
        corner[0] = c->number[middle];
        corner[1] = c->number[at];
        for (size_t i = 0; i < n; ++i) {
            at += c->stride[order[i]];
            corner[i + 2] = c->number[at];
        }
    } while (next_order(n, order));
}

static void join_cell(cells *c, size_t middle)
{
    const size_t dim = c->mesh->dim;
    for (size_t axis = 0; axis < dim; ++axis)
        for (size_t part = 0; part < (size_t)1 << dim; ++part) {
            size_t lowest = middle;
            for (size_t k = 0; k < dim; ++k)
                if ((part >> k & 1) == 0)
                    lowest -= c->stride[k];
                else if (k == axis)
                    lowest += c->stride[k];
            join_part(c, middle, lowest, axis);
        }
}

/* Simplices of a cell: 2 dim faces, each in 2^(dim - 1) parts of (dim - 1)! simplices. */
static size_t count_simplices(const iccp_mask *mask)
{
    size_t n = (size_t)1 << mask->dim, n_cells = 0;
    for (int32_t k = 1; k <= mask->dim; ++k)
        n *= (size_t)k;
    for (size_t i = 0; i < mask->n_padded; ++i)
        n_cells += mask->cells[i];
    return n_cells <= ICCP_MAX_COUNT / n ? n * n_cells : SIZE_MAX;
}

static icc_status fill(cells *c, size_t n_simplices, const iccp_env *env)
{
    number_boundary(c);
    icc_status status = new_mesh(&c->mesh, c->domain, number_inner(c), n_simplices, env);
    if (status != ICC_OK)
        return status;
    place_inner(c);
    for (size_t i = 0; i < c->mask->n_padded; ++i)
        if (c->mask->cells[i])
            join_cell(c, middle_of(c, i));
    return iccp_simplices_orient(c->mesh, NULL);
}

icc_status iccp_fill_mask(iccp_simplices **out, const icc_domain *domain, const iccp_env *env)
{
    cells c = {.domain = domain, .mask = domain->mask, .n_lattice = 1};
    const size_t n_simplices = count_simplices(c.mask);
    *out = NULL;
    if (n_simplices == SIZE_MAX)
        return ICC_OK;
    for (int32_t k = 0; k < c.mask->dim; ++k) {
        c.stride[k] = c.n_lattice;
        c.n_lattice *= 2 * c.mask->shape[k] + 1;
    }
    c.number = iccp_alloc(&env->memory, c.n_lattice, sizeof *c.number);
    if (c.number == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = fill(&c, n_simplices, env);
    iccp_free(&env->memory, c.number);
    if (status == ICC_OK)
        status = join(&c.mesh, domain);
    else
        iccp_simplices_free(c.mesh);
    *out = status == ICC_OK ? c.mesh : NULL;
    return status;
}
