/* Arranges simplices along a space-filling curve.
 *
 * Source: G. M. Morton, A computer oriented geodetic data base and a new technique in file
 * sequencing, 1966. The place of a lattice cell on the curve interleaves the bits of its
 * coordinates. */
#include "shelling/arranged.h"

#include "base/sort.h"

#include <math.h>

/* A key consists of the place on the curve and the number of the simplex. */
enum { PLACE_BITS = 32, PLACE_SHIFT = 32 };

/* A lattice in a cube round all points. */
typedef struct lattice {
    size_t dim, bits; /* bits: for each axis */
    double low[ICC_MAX_DIM], scale;
} lattice;

static lattice find_lattice(const iccp_simplices *mesh)
{
    lattice l = {.dim = mesh->dim, .bits = PLACE_BITS / mesh->dim};
    double high[ICC_MAX_DIM], size = 0;
    for (size_t k = 0; k < l.dim; ++k)
        l.low[k] = high[k] = mesh->points[k];
    for (size_t v = 1; v < mesh->n_points; ++v)
        for (size_t k = 0; k < l.dim; ++k) {
            const double x = mesh->points[l.dim * v + k];
            l.low[k] = x < l.low[k] ? x : l.low[k];
            high[k] = x > high[k] ? x : high[k];
        }
    for (size_t k = 0; k < l.dim; ++k)
        size = high[k] - l.low[k] > size ? high[k] - l.low[k] : size;
    l.scale = size > 0 ? ldexp(1, (int)l.bits) / size : 0;
    return l;
}

/* The place on the curve of the mean of a simplex's corners. */
static uint64_t find_place(const lattice *l, const iccp_simplices *mesh, size_t simplex)
{
    const size_t n_corners = l->dim + 1;
    uint64_t place = 0;
    for (size_t k = 0; k < l->dim; ++k) {
        double x = 0;
        for (size_t i = 0; i < n_corners; ++i)
            x += iccp_corner_point(mesh, n_corners * simplex + i)[k] - l->low[k];
        const uint64_t most = ((uint64_t)1 << l->bits) - 1;
        const uint64_t cell = (uint64_t)(x / (double)n_corners * l->scale);
        const uint64_t within = cell < most ? cell : most;
        for (size_t b = 0; b < l->bits; ++b)
            place |= (within >> b & 1) << (l->dim * b + k);
    }
    return place;
}

static void sort_simplices(const iccp_simplices *mesh, uint64_t *keys, uint64_t *work)
{
    const lattice l = find_lattice(mesh);
    for (size_t t = 0; t < mesh->n_simplices; ++t)
        keys[t] = find_place(&l, mesh, t) << PLACE_SHIFT | t;
    iccp_sort_keys(keys, work, mesh->n_simplices, PLACE_SHIFT);
}

/* `number` holds the new number of each simplex. */
static void copy_sides(iccp_arranged *a, const iccp_simplices *mesh, const uint32_t *number)
{
    const uint32_t n_corners = (uint32_t)mesh->dim + 1;
    for (size_t t = 0; t < mesh->n_simplices; ++t)
        for (size_t i = 0; i < n_corners; ++i) {
            const size_t from = n_corners * (size_t)a->order[t] + i, to = n_corners * t + i;
            const uint32_t across = mesh->across[from];
            a->mesh.corners[to] = mesh->corners[from];
            a->mesh.across[to] = across >= ICCP_ON_BOUNDARY
                                     ? across
                                     : n_corners * number[across / n_corners] + across % n_corners;
        }
}

icc_status iccp_arranged_create(iccp_arranged *a, const iccp_simplices *mesh, const iccp_env *env)
{
    const size_t n = mesh->n_simplices;
    uint64_t *keys = iccp_alloc(&env->memory, n, 2 * sizeof *keys);
    uint32_t *number = iccp_alloc(&env->memory, n, sizeof *number);
    *a = (iccp_arranged){.mesh = *mesh};
    a->mesh.memory = env->memory;
    a->mesh.given = NULL;
    a->mesh.corners = iccp_alloc(&env->memory, n, (mesh->dim + 1) * sizeof *a->mesh.corners);
    a->mesh.across = iccp_alloc(&env->memory, n, (mesh->dim + 1) * sizeof *a->mesh.across);
    a->order = iccp_alloc(&env->memory, n, sizeof *a->order);
    const bool good = keys != NULL && number != NULL && a->mesh.corners != NULL &&
                      a->mesh.across != NULL && a->order != NULL;
    if (good) {
        sort_simplices(mesh, keys, keys + n);
        for (uint32_t t = 0; t < n; ++t) {
            a->order[t] = (uint32_t)keys[t];
            number[a->order[t]] = t;
        }
        copy_sides(a, mesh, number);
    }
    iccp_free(&env->memory, keys);
    iccp_free(&env->memory, number);
    if (!good)
        iccp_arranged_free(a);
    return good ? ICC_OK : ICC_ERR_MEMORY;
}

void iccp_arranged_free(iccp_arranged *a)
{
    const iccp_memory memory = a->mesh.memory;
    iccp_free(&memory, a->mesh.corners);
    iccp_free(&memory, a->mesh.across);
    iccp_free(&memory, a->order);
    *a = (iccp_arranged){.mesh.memory = memory};
}

void iccp_arranged_restore(const iccp_arranged *a, const double *of_sides, double *restored)
{
    const size_t n_corners = a->mesh.dim + 1;
    for (size_t t = 0; t < a->mesh.n_simplices; ++t)
        for (size_t i = 0; i < n_corners; ++i)
            restored[n_corners * a->order[t] + i] = of_sides[n_corners * t + i];
}
