/* The matrix of Sakaridis' equations 5.16 and 5.26 and, beside and below it, those that keep the
 * values of held nodes: quasi-definite when a little is added to the diagonal of the one and taken
 * from that of the other. */
#include "kernel/rigid_system.h"

#include "base/minmax.h"

#include <math.h>

#define NONE UINT32_MAX

/* Of the mean rigidity: how much derivatives around the part count. */
static const double SURROUNDINGS = 0.1;
/* Of the greatest diagonal entry: what is added and taken, so that coefficients may hardly matter
 * to any derivative, and equations may be too many. Held values are off by as much; the caller sets
 * them right. The least with which the matrix factorises: */
static const double LEAST_PIVOT = 1e-9, MOST_PIVOT = 1e-4, PIVOT_STEP = 100;
/* Steps of refinement; where the matrix is nearly singular more of them would diverge. */
enum { REFINEMENTS = 1 };

/* Entries of a node's row of the kernel's matrix, its own included, in the columns of the area. */
static size_t count_entries(const iccp_rigid *r, size_t node)
{
    size_t n = r->number[node] != NONE;
    for (size_t p = r->kernel->first[node]; p < r->kernel->first[node + 1]; ++p)
        n += r->number[r->kernel->column[p]] != NONE;
    return n;
}

/* The area: the part first, in the caller's order, then the other nodes within the kernel's reach
 * of it. Held nodes that some node of the area reaches become equations. */
static void find_area(iccp_rigid *r, const uint32_t *part, const bool *held)
{
    for (size_t i = 0; i < r->nodes->n; ++i)
        r->number[i] = NONE;
    for (r->n = 0; r->n < r->n_part; ++r->n) {
        r->area[r->n] = part[r->n];
        r->number[part[r->n]] = (uint32_t)r->n;
    }
    for (size_t k = 0; k < r->n_part; ++k)
        for (size_t p = r->kernel->first[part[k]]; p < r->kernel->first[part[k] + 1]; ++p) {
            const uint32_t j = r->kernel->column[p];
            if (r->number[j] != NONE)
                continue;
            r->number[j] = (uint32_t)r->n;
            r->area[r->n++] = j;
        }
    for (size_t i = 0; i < r->nodes->n; ++i)
        if (held[i] && count_entries(r, i) > 0)
            r->held[r->n_held++] = (uint32_t)i;
}

static void set_weights(iccp_rigid *r, const double *rigidity)
{
    const size_t dim = r->nodes->dim;
    double mean = rigidity != NULL ? 0 : 1;
    for (size_t k = 0; rigidity != NULL && k < r->n_part; ++k)
        mean += rigidity[k] / (double)r->n_part;
    for (size_t row = 0; row < dim * r->n; ++row) {
        const size_t k = row / dim;
        r->weight[row] = k >= r->n_part ? SURROUNDINGS * mean : rigidity != NULL ? rigidity[k] : 1;
    }
}

/* The derivatives of the area's kernels at the area's nodes: row dim * a + axis for node a of the
 * area, columns for coefficients in the order of the area. A kernel's own slope at its node is 0
 * and has no entry. */
static void fill_slopes(iccp_rigid *r)
{
    const size_t dim = r->nodes->dim;
    const double *x = r->nodes->points;
    const iccp_radial *radial = iccp_collocation_radial(r->collocation);
    size_t n = 0;
    for (size_t row = 0; row < dim * r->n; ++row) {
        const size_t i = r->area[row / dim], axis = row % dim;
        r->slopes.first[row] = n;
        for (size_t p = r->kernel->first[i]; p < r->kernel->first[i + 1]; ++p) {
            const size_t j = r->kernel->column[p];
            double distance2 = 0;
            if (r->number[j] == NONE)
                continue;
            for (size_t k = 0; k < dim; ++k)
                distance2 += (x[dim * i + k] - x[dim * j + k]) * (x[dim * i + k] - x[dim * j + k]);
            r->slopes.column[n] = r->number[j];
            r->slopes.value[n++] =
                2 * iccp_radial_slope(radial, distance2) * (x[dim * i + axis] - x[dim * j + axis]);
        }
    }
    r->slopes.first[dim * r->n] = n;
}

static icc_status create_gram(iccp_rigid *r, const iccp_env *env)
{
    size_t n = 0;
    for (size_t k = 0; k < r->n; ++k)
        n += r->nodes->dim * count_entries(r, r->area[k]);
    icc_status status = iccp_sparse_create(&r->slopes, r->nodes->dim * r->n, r->n, n, env);
    if (status != ICC_OK)
        return status;
    fill_slopes(r);
    status = iccp_gram_create(&r->gram, &r->slopes, env);
    if (status != ICC_OK)
        return status;
    iccp_gram_fill(&r->gram, &r->slopes, r->weight);
    for (size_t k = 0; k < r->n; ++k)
        r->scale = iccp_max(r->scale, r->gram.diagonal[k]);
    /* A node alone: its coefficient does not matter. */
    if (!(r->scale > 0))
        r->scale = 1;
    return ICC_OK;
}

/* Entries in each row of the system. */
static void count_system(const iccp_rigid *r, size_t *count)
{
    const iccp_symmetric *g = &r->gram.matrix;
    for (size_t i = 0; i < r->n; ++i)
        count[i] = g->first[i + 1] - g->first[i];
    for (size_t h = 0; h < r->n_held; ++h) {
        const size_t i = r->held[h];
        count[r->n + h] = count_entries(r, i);
        for (size_t p = r->kernel->first[i]; p < r->kernel->first[i + 1]; ++p)
            if (r->number[r->kernel->column[p]] != NONE)
                ++count[r->number[r->kernel->column[p]]];
        if (r->number[i] != NONE)
            ++count[r->number[i]];
    }
}

/* Row n + h: the values of the area's kernels at a node that is held. */
static void add_equation(iccp_rigid *r, size_t h, size_t *end)
{
    const size_t i = r->held[h], row = r->n + h;
    for (size_t p = r->kernel->first[i]; p <= r->kernel->first[i + 1]; ++p) {
        const bool own = p == r->kernel->first[i + 1];
        const uint32_t j = r->number[own ? i : r->kernel->column[p]];
        if (j == NONE)
            continue;
        const double value = own ? r->kernel->diagonal[i] : r->kernel->value[p];
        r->column[end[j]] = (uint32_t)row;
        r->value[end[j]++] = value;
        r->column[end[row]] = j;
        r->value[end[row]++] = value;
    }
}

/* Rows of the energy have the sign + and those of held values -, by which the factorisation shifts
 * the diagonal. `end`: of each row, n + n_held of them. */
static void fill_system(iccp_rigid *r, size_t *end)
{
    const iccp_symmetric *g = &r->gram.matrix;
    for (size_t i = 0; i < r->n + r->n_held; ++i) {
        end[i] = r->first[i];
        r->diagonal[i] = i < r->n ? g->diagonal[i] / r->scale : 0;
        r->sign[i] = i < r->n ? 1 : -1;
    }
    for (size_t i = 0; i < r->n; ++i)
        for (size_t p = g->first[i]; p < g->first[i + 1]; ++p) {
            r->column[end[i]] = g->column[p];
            r->value[end[i]++] = g->value[p] / r->scale;
        }
    for (size_t h = 0; h < r->n_held; ++h)
        add_equation(r, h, end);
}

/* Allocates and fills in the system, n unknowns and then n_held equations, and
 * orders it. `end` counts the entries of each row first and marks their end while they are filled
 * in. */
static icc_status create_system(iccp_rigid *r, const iccp_env *env)
{
    const size_t n = r->n + r->n_held;
    size_t *end = iccp_alloc(&r->memory, n, sizeof *end);
    r->first = iccp_alloc(&r->memory, n + 1, sizeof *r->first);
    r->diagonal = iccp_alloc(&r->memory, n, sizeof *r->diagonal);
    r->sign = iccp_alloc(&r->memory, n, sizeof *r->sign);
    icc_status status = ICC_ERR_MEMORY;
    if (end != NULL && r->first != NULL && r->diagonal != NULL && r->sign != NULL) {
        count_system(r, end);
        r->first[0] = 0;
        for (size_t i = 0; i < n; ++i)
            r->first[i + 1] = r->first[i] + end[i];
        r->column = iccp_alloc(&r->memory, r->first[n], sizeof *r->column);
        r->value = iccp_alloc(&r->memory, r->first[n], sizeof *r->value);
        if (r->column != NULL && r->value != NULL)
            status = ICC_OK;
    }
    if (status == ICC_OK) {
        fill_system(r, end);
        r->matrix = (iccp_symmetric){n, r->first, r->column, r->value, r->diagonal};
        status = iccp_ldlt_analyse(&r->factor, &r->matrix, 1, env);
    }
    iccp_free(&r->memory, end);
    return status;
}

static icc_status factorise(iccp_rigid *r, const iccp_env *env)
{
    icc_status status = ICC_ERR_SOLVER;
    for (double pivot = LEAST_PIVOT; status == ICC_ERR_SOLVER && pivot < MOST_PIVOT;
         pivot *= PIVOT_STEP) {
        for (size_t i = 0; i < r->matrix.n; ++i)
            r->diagonal[i] += r->sign[i] * (pivot - r->pivot);
        r->pivot = pivot;
        status = iccp_ldlt_factorise_signed(&r->factor, &r->matrix, r->sign, env);
    }
    return status;
}

icc_status iccp_rigid_create(iccp_rigid *r, const iccp_nodes *nodes,
                             const iccp_collocation *collocation, size_t n_part,
                             const uint32_t *part, const double *rigidity, const bool *held,
                             const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    *r = (iccp_rigid){.memory = *memory,
                      .nodes = nodes,
                      .collocation = collocation,
                      .kernel = iccp_collocation_matrix(collocation),
                      .n_part = n_part,
                      .slopes = {.memory = *memory},
                      .gram = {.memory = *memory},
                      .factor = {.memory = *memory}};
    r->area = iccp_alloc(memory, nodes->n, sizeof *r->area);
    r->number = iccp_alloc(memory, nodes->n, sizeof *r->number);
    r->held = iccp_alloc(memory, nodes->n, sizeof *r->held);
    r->weight = iccp_alloc(memory, nodes->n, nodes->dim * sizeof *r->weight);
    icc_status status = ICC_ERR_MEMORY;
    if (r->area != NULL && r->number != NULL && r->held != NULL && r->weight != NULL) {
        find_area(r, part, held);
        set_weights(r, rigidity);
        status = create_gram(r, env);
    }
    if (status == ICC_OK)
        status = create_system(r, env);
    if (status == ICC_OK)
        status = factorise(r, env);
    if (status != ICC_OK)
        iccp_rigid_free(r);
    return status;
}

void iccp_rigid_free(iccp_rigid *r)
{
    iccp_ldlt_free(&r->factor);
    iccp_gram_free(&r->gram);
    iccp_sparse_free(&r->slopes);
    iccp_free(&r->memory, r->area);
    iccp_free(&r->memory, r->number);
    iccp_free(&r->memory, r->held);
    iccp_free(&r->memory, r->weight);
    iccp_free(&r->memory, r->first);
    iccp_free(&r->memory, r->column);
    iccp_free(&r->memory, r->value);
    iccp_free(&r->memory, r->diagonal);
    iccp_free(&r->memory, r->sign);
    *r = (iccp_rigid){.memory = r->memory};
}

/* left = right - matrix * x */
static void find_residual(const iccp_rigid *r, size_t m, const double *right, const double *x,
                          double *left)
{
    for (size_t i = 0; i < r->matrix.n; ++i) {
        for (size_t j = 0; j < m; ++j)
            left[m * i + j] = right[m * i + j] - r->diagonal[i] * x[m * i + j];
        for (size_t p = r->first[i]; p < r->first[i + 1]; ++p)
            for (size_t j = 0; j < m; ++j)
                left[m * i + j] -= r->value[p] * x[m * r->column[p] + j];
    }
}

void iccp_rigid_solve(const iccp_rigid *r, size_t m, const double *right, double *x, double *left,
                      double *work)
{
    const size_t size = r->matrix.n * m;
    for (size_t i = 0; i < size; ++i) {
        x[i] = 0;
        left[i] = right[i];
    }
    for (int k = 0; k <= REFINEMENTS; ++k) {
        iccp_ldlt_solve(&r->factor, m, left, work);
        for (size_t i = 0; i < size; ++i)
            x[i] += left[i];
        find_residual(r, m, right, x, left);
    }
}
