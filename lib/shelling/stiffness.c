/* Assembles the Laplacian of a mesh of simplices, with linear finite elements. */
#include "shelling/stiffness.h"

#include "base/minmax.h"
#include "base/sort.h"
#include "math/vec.h"
#include "shelling/element.h"

#include <math.h>

#define NONE UINT32_MAX

/* The least weight of an edge, relative to the geometric mean of the diagonal entries of its
 * ends. */
static const double LEAST_WEIGHT = 0.02;

/* The data from which the matrix is made. For every vertex these are the sides opposite to it.
 * For every simplex these are the gradients times the square root of its volume. */
typedef struct assembly {
    const iccp_simplices *mesh;
    uint32_t *first; /* n_points + 1: where the sides of each point begin */
    uint32_t *side;  /* sides opposite to each point, rising */
    double *gradient;
    uint32_t
        *place; /* of each point: its entry in the current row, relative to the row's beginning */
} assembly;

static icc_status prepare(assembly *a, const iccp_simplices *mesh, const iccp_env *env)
{
    const size_t dim = mesh->dim, n_sides = (dim + 1) * mesh->n_simplices;
    *a = (assembly){.mesh = mesh};
    a->first = iccp_alloc_zero(&env->memory, mesh->n_points + 1, sizeof *a->first);
    a->side = iccp_alloc(&env->memory, n_sides, sizeof *a->side);
    a->gradient = iccp_alloc(&env->memory, n_sides, dim * sizeof *a->gradient);
    a->place = iccp_alloc(&env->memory, mesh->n_points, sizeof *a->place);
    if (a->first == NULL || a->side == NULL || a->gradient == NULL || a->place == NULL)
        return ICC_ERR_MEMORY;
    iccp_list_groups(a->side, a->first, mesh->n_points, mesh->corners, n_sides, 1);
    for (size_t t = 0; t < mesh->n_simplices; ++t) {
        double *gradient = a->gradient + dim * (dim + 1) * t;
        const double root = sqrt(iccp_element_gradients(mesh, t, gradient));
        for (size_t k = 0; k < dim * (dim + 1); ++k)
            gradient[k] *= root;
    }
    return ICC_OK;
}

static void discard(assembly *a, const iccp_env *env)
{
    iccp_free(&env->memory, a->first);
    iccp_free(&env->memory, a->side);
    iccp_free(&env->memory, a->gradient);
    iccp_free(&env->memory, a->place);
}

/* Counts the neighbours of vertex v. `place` holds the vertex at which a point was last met. */
static size_t count_neighbours(const assembly *a, uint32_t v)
{
    const size_t n_corners = a->mesh->dim + 1;
    size_t n = 0;
    a->place[v] = v;
    for (size_t p = a->first[v]; p < a->first[v + 1]; ++p) {
        const uint32_t *corner = a->mesh->corners + a->side[p] / n_corners * n_corners;
        for (size_t i = 0; i < n_corners; ++i) {
            n += a->place[corner[i]] != v;
            a->place[corner[i]] = v;
        }
    }
    return n;
}

/* Fills a row, with columns in the order in which the simplices list them. A place that does not
 * lead to its own column in this row belongs to an earlier row. */
static void fill_row(const assembly *a, iccp_gram *g, uint32_t v)
{
    const size_t dim = a->mesh->dim, n_corners = dim + 1, begin = g->first[v];
    uint32_t n = 0;
    g->diagonal[v] = 0;
    for (size_t p = a->first[v]; p < a->first[v + 1]; ++p) {
        const size_t first = a->side[p] / n_corners * n_corners;
        const double *own = a->gradient + dim * a->side[p];
        for (size_t s = first; s < first + n_corners; ++s) {
            const uint32_t w = a->mesh->corners[s];
            const double product = iccp_vec_dot(dim, own, a->gradient + dim * s);
            if (w == v) {
                g->diagonal[v] += product;
                continue;
            }
            if (a->place[w] >= n || g->column[begin + a->place[w]] != w) {
                a->place[w] = n;
                g->column[begin + n] = w;
                g->value[begin + n++] = 0;
            }
            g->value[begin + a->place[w]] += product;
        }
    }
}

static icc_status assemble(const assembly *a, iccp_gram *g, const iccp_env *env)
{
    const size_t n = a->mesh->n_points;
    g->first = iccp_alloc(&env->memory, n + 1, sizeof *g->first);
    g->diagonal = iccp_alloc(&env->memory, n, sizeof *g->diagonal);
    if (g->first == NULL || g->diagonal == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < n; ++v)
        a->place[v] = NONE;
    g->first[0] = 0;
    for (uint32_t v = 0; v < n; ++v)
        g->first[v + 1] = g->first[v] + count_neighbours(a, v);
    g->column = iccp_alloc(&env->memory, g->first[n], sizeof *g->column);
    g->value = iccp_alloc(&env->memory, g->first[n], sizeof *g->value);
    if (g->column == NULL || g->value == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < n; ++v)
        fill_row(a, g, v);
    g->matrix = (iccp_symmetric){n, g->first, g->column, g->value, g->diagonal};
    return ICC_OK;
}

icc_status iccp_stiffness_create(iccp_gram *gram, const iccp_simplices *mesh, const iccp_env *env)
{
    assembly a;
    *gram = (iccp_gram){.memory = env->memory};
    icc_status status = iccp_progress(env, "solve", 0);
    if (status == ICC_OK) {
        status = prepare(&a, mesh, env);
        if (status == ICC_OK)
            status = assemble(&a, gram, env);
        discard(&a, env);
    }
    if (status != ICC_OK)
        iccp_gram_free(gram);
    return status;
}

icc_status iccp_stiffness_to_network(iccp_gram *gram, const iccp_env *env)
{
    const size_t n = gram->matrix.n;
    double *sum = iccp_alloc_zero(&env->memory, n, sizeof *sum);
    if (sum == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < n; ++v)
        for (size_t p = gram->first[v]; p < gram->first[v + 1]; ++p) {
            const double ends = gram->diagonal[v] * gram->diagonal[gram->column[p]];
            const double weight = iccp_max(-gram->value[p], LEAST_WEIGHT * sqrt(ends));
            gram->value[p] = -weight;
            sum[v] += weight;
        }
    for (size_t v = 0; v < n; ++v)
        gram->diagonal[v] = sum[v];
    iccp_free(&env->memory, sum);
    return ICC_OK;
}

static size_t count_entries(const iccp_gram *gram, const uint32_t *row, size_t *n_rows)
{
    size_t n_entries = 0;
    *n_rows = 0;
    for (size_t i = 0; i < gram->matrix.n; ++i) {
        *n_rows += row[i] != NONE;
        for (size_t p = gram->first[i]; p < gram->first[i + 1] && row[i] != NONE; ++p)
            n_entries += row[gram->column[p]] != NONE;
    }
    return n_entries;
}

/* Makes two passes over the rows that are kept: one counts, one fills. */
icc_status iccp_stiffness_restrict(iccp_gram *part, const iccp_gram *gram, const uint32_t *row,
                                   const iccp_env *env)
{
    size_t n, end = 0;
    const size_t n_entries = count_entries(gram, row, &n);
    *part = (iccp_gram){.memory = env->memory};
    part->first = iccp_alloc(&env->memory, n + 1, sizeof *part->first);
    part->column = iccp_alloc(&env->memory, n_entries, sizeof *part->column);
    part->value = iccp_alloc(&env->memory, n_entries, sizeof *part->value);
    part->diagonal = iccp_alloc(&env->memory, n, sizeof *part->diagonal);
    if (part->first == NULL || part->column == NULL || part->value == NULL ||
        part->diagonal == NULL) {
        iccp_gram_free(part);
        return ICC_ERR_MEMORY;
    }
    part->first[0] = 0;
    for (size_t i = 0; i < gram->matrix.n; ++i) {
        if (row[i] == NONE)
            continue;
        for (size_t p = gram->first[i]; p < gram->first[i + 1]; ++p)
            if (row[gram->column[p]] != NONE) {
                part->column[end] = row[gram->column[p]];
                part->value[end++] = gram->value[p];
            }
        part->diagonal[row[i]] = gram->diagonal[i];
        part->first[row[i] + 1] = end;
    }
    part->matrix = (iccp_symmetric){n, part->first, part->column, part->value, part->diagonal};
    return ICC_OK;
}
