/* Makes the domain of a mask. Based on: H. W. Kuhn, Some Combinatorial Lemmas in Topology, IBM
 * Journal of Research and Development 4, 1960. A cube is divided into simplices from its lowest to
 * its highest corner along the axes, one for each order of the axes.
 *
 * So the faces of cells that are cut in two along each axis are triangulated just like the grid on
 * the same lattice. The orientation of a face's simplex is the sign of its order. If it does not
 * point outwards, two vertices are exchanged. */
#include "domain/mask_boundary.h"

#include "base/budget.h"
#include "base/error.h"
#include "domain/solid.h"

#include <string.h>

enum { MOST_ORDERS = 120 }; /* number of orders of 5 axes */

static const size_t CELLS_PER_REPORT = 1 << 12;
static const size_t MAX_COUNT = UINT32_MAX / 64; /* limit of a domain's counts */

/* An order of the axes of a face, numbered from 0. */
typedef struct axis_order {
    uint8_t axis[ICC_MAX_DIM - 1];
    int sign;
} axis_order;

typedef struct boundary {
    const iccp_mask *mask;
    const iccp_env *env;
    uint32_t *number; /* by vertex of the cut lattice: its number if it is on the boundary */
    double *vertices; /* n_vertices * dim */
    uint32_t *facets; /* n_facets * dim */
    size_t n_vertices, n_facets;
    int n_orders; /* number of orders of a face's dim - 1 axes */
    axis_order orders[MOST_ORDERS];
} boundary;

static void list_orders(boundary *b)
{
    const int n_axes = (int)b->mask->dim - 1;
    b->n_orders = 1;
    for (int i = 2; i <= n_axes; ++i)
        b->n_orders *= i;
    for (int p = 0; p < b->n_orders; ++p) {
        axis_order *order = &b->orders[p];
        order->sign = 1;
        for (int i = 0; i < n_axes; ++i)
            order->axis[i] = (uint8_t)i;
        for (int i = n_axes - 1, rest = p; i > 0; rest /= i + 1, --i) {
            const int j = rest % (i + 1);
            const uint8_t moved = order->axis[i];
            order->axis[i] = order->axis[j];
            order->axis[j] = moved;
            order->sign = j != i ? -order->sign : order->sign;
        }
    }
}

/* Numbers the vertices that have cells inside and outside around them. Also writes their
 * coordinates if there is an array. */
static icc_status number_vertices(boundary *b)
{
    const iccp_mask *mask = b->mask;
    size_t at[ICC_MAX_DIM] = {0}, index = 0;
    b->n_vertices = 0;
    do {
        if (index % CELLS_PER_REPORT == 0 && iccp_progress(b->env, "check", 0) != ICC_OK)
            return ICC_ERR_CANCELLED;
        int n_axes;
        const uint64_t block = iccp_mask_block(mask, at, &n_axes);
        if (block != 0 && block != iccp_mask_full(n_axes)) {
            for (int32_t k = 0; b->vertices != NULL && k < mask->dim; ++k)
                b->vertices[b->n_vertices * (size_t)mask->dim + (size_t)k] = 0.5 * (double)at[k];
            b->number[index] = (uint32_t)b->n_vertices++;
        }
        ++index;
    } while (iccp_mask_next(mask, at));
    return ICC_OK;
}

/* Writes the simplices of the part of a face from `at` to one step further along the other axes.
 * Outwards is up or down along `axis`. */
static void cut_part(boundary *b, size_t at, const size_t *stride, int32_t axis, bool up)
{
    const size_t dim = (size_t)b->mask->dim;
    for (int p = 0; p < b->n_orders; ++p) {
        const axis_order *order = &b->orders[p];
        uint32_t *facet = b->facets + dim * b->n_facets++;
        size_t corner = at;
        facet[0] = b->number[corner];
        for (size_t i = 1; i < dim; ++i) {
            const int32_t other = order->axis[i - 1];
            corner += stride[other < axis ? other : other + 1];
            facet[i] = b->number[corner];
        }
        const bool even = (order->sign > 0) == (axis % 2 == 0);
        if (even != up && dim > 1) {
            const uint32_t moved = facet[dim - 1];
            facet[dim - 1] = facet[dim - 2];
            facet[dim - 2] = moved;
        }
    }
}

/* Cuts a face of the cell with these coordinates. */
static void cut_face(boundary *b, const size_t *cell, int32_t axis, bool up)
{
    const iccp_mask *mask = b->mask;
    size_t stride[ICC_MAX_DIM], lowest = 0, n = 1;
    for (int32_t k = 0; k < mask->dim; ++k) {
        stride[k] = n;
        lowest += n * (2 * cell[k] + (k == axis && up ? 2 : 0));
        n *= 2 * mask->shape[k] + 1;
    }
    for (int part = 0; part < 1 << mask->dim; ++part) {
        size_t at = lowest;
        for (int32_t k = 0; k < mask->dim; ++k)
            at += (size_t)(part >> k & 1) * stride[k];
        if ((part >> axis & 1) == 0)
            cut_part(b, at, stride, axis, up);
    }
}

/* Counts the faces between inside and outside. Also cuts them if there is an array. */
static icc_status find_faces(boundary *b, size_t *n_faces)
{
    const iccp_mask *mask = b->mask;
    *n_faces = 0;
    for (size_t i = 0; i < mask->n_padded; ++i) {
        if (i % CELLS_PER_REPORT == 0 &&
            iccp_progress(b->env, "check", (double)i / (double)mask->n_padded) != ICC_OK)
            return ICC_ERR_CANCELLED;
        if (!mask->cells[i])
            continue;
        size_t cell[ICC_MAX_DIM];
        for (int32_t k = 0; k < mask->dim; ++k)
            cell[k] = i / mask->stride[k] % (mask->shape[k] + 2) - 1;
        for (int32_t k = 0; k < mask->dim; ++k)
            for (int up = 0; up < 2; ++up) {
                if (mask->cells[up ? i + mask->stride[k] : i - mask->stride[k]])
                    continue;
                ++*n_faces;
                if (b->facets != NULL)
                    cut_face(b, cell, k, up != 0);
            }
    }
    return ICC_OK;
}

static size_t count_lattice(const iccp_mask *mask)
{
    size_t n = 1;
    for (int32_t k = 0; k < mask->dim; ++k)
        n *= 2 * mask->shape[k] + 1;
    return n;
}

static icc_status fail_size(icc_error *err)
{
    return iccp_fail(err, ICC_ERR_RESOLUTION,
                     "the mask is too large: its boundary would have more than %zu facets",
                     MAX_COUNT);
}

/* Returns the bytes per facet of a boundary and of the domain made from it, with its tree. There
 * are roughly fewer vertices than facets. */
static double bytes_per_facet(size_t dim)
{
    return 100 + 60 * (double)dim;
}

/* Counts first, then allocates the arrays and fills them. */
static icc_status cut_boundary(boundary *b, icc_error *err)
{
    const iccp_memory *memory = &b->env->memory;
    const size_t dim = (size_t)b->mask->dim;
    size_t n_faces;
    list_orders(b);
    icc_status status = find_faces(b, &n_faces);
    if (status != ICC_OK)
        return status;
    const size_t per_face = ((size_t)1 << (dim - 1)) * (size_t)b->n_orders;
    if (n_faces > MAX_COUNT / per_face)
        return fail_size(err);
    status = iccp_budget_keep(b->env, (double)(n_faces * per_face) * bytes_per_facet(dim));
    if (status != ICC_OK)
        return status;
    b->number = iccp_alloc(memory, count_lattice(b->mask), sizeof *b->number);
    if (b->number == NULL)
        return ICC_ERR_MEMORY;
    status = number_vertices(b);
    if (status != ICC_OK)
        return status;
    b->vertices = iccp_alloc(memory, b->n_vertices, dim * sizeof *b->vertices);
    b->facets = iccp_alloc(memory, n_faces * per_face, dim * sizeof *b->facets);
    if (b->vertices == NULL || b->facets == NULL)
        return ICC_ERR_MEMORY;
    status = number_vertices(b);
    return status == ICC_OK ? find_faces(b, &n_faces) : status;
}

/* In the plane: renumbers so that facet i joins vertices i and i + 1. */
static icc_status follow_polygon(boundary *b)
{
    const iccp_memory *memory = &b->env->memory;
    const size_t n = b->n_vertices;
    double *polygon = iccp_alloc(memory, n, 2 * sizeof *polygon);
    if (polygon == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < n; ++i)
        b->number[b->facets[2 * i]] = b->facets[2 * i + 1];
    uint32_t vertex = 0;
    for (size_t i = 0; i < n; ++i) {
        memcpy(polygon + 2 * i, b->vertices + 2 * (size_t)vertex, 2 * sizeof *polygon);
        vertex = b->number[vertex];
        b->facets[2 * i] = (uint32_t)i;
        b->facets[2 * i + 1] = i + 1 < n ? (uint32_t)(i + 1) : 0;
    }
    iccp_free(memory, b->vertices);
    b->vertices = polygon;
    return ICC_OK;
}

static icc_status create(icc_domain **out, const iccp_mask *mask, const iccp_env *env,
                         icc_error *err)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    boundary b = {.mask = mask, .env = &part[0]};
    icc_status status = cut_boundary(&b, err);
    if (status == ICC_OK && mask->dim == 2)
        status = follow_polygon(&b);
    if (status == ICC_OK)
        status = iccp_domain_create(out, mask->dim, b.n_vertices, b.vertices, b.n_facets, b.facets,
                                    &part[1], err);
    iccp_free(&env->memory, b.number);
    iccp_free(&env->memory, b.vertices);
    iccp_free(&env->memory, b.facets);
    return iccp_explain(err, status);
}

icc_status iccp_domain_create_mask(icc_domain **out, int32_t dim, const size_t *shape,
                                   const uint8_t *cells, const iccp_env *env, icc_error *err)
{
    *out = NULL;
    iccp_mask *mask;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 2, 4}, env);
    icc_status status = iccp_mask_create(&mask, dim, shape, cells, &part[0], err);
    if (status == ICC_OK)
        status = iccp_mask_check(mask, &part[1], err);
    if (status == ICC_OK)
        status = create(out, mask, &part[2], err);
    if (status == ICC_OK)
        (*out)->mask = mask;
    else
        iccp_mask_free(mask);
    return status;
}
