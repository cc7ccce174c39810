/* Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), section 5.4. What is minimised is the sum over the part's
 * nodes of rigidity / 2 times the squared derivatives of all weights there, by the coefficients of the kernels at
 * these nodes: equation 5.35a with its sign mended (+2, the printed -2 makes the energy rise), and with the
 * rigidity inside the sum 5.16.
 *
 * The matrix acts on every handle alike, and sums and reproduction, 5.35b and c, hold when all changes of one
 * coefficient, as a vector over the handles, lie in the null space of the handles' matrix: so each handle is a right
 * side of one system, and the changes are projected at the end. Nodes that are held would move with those of the
 * part near them: their values are equations beside the minimum. Non-negativity, 5.35d, is not imposed. */
#include "kernel/structure.h"
#include "math/gram.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

/* Of the greatest diagonal entry: what is added for coefficients that hardly matter to any derivative, such as
 * those of waves with crests at all nodes. */
static const double WEIGHT_OF_CHANGE = 1e-9;
/* The same beside 0: the pivots of the equations, so that those may be too many. The refinement takes it out. */
static const double PIVOT = 1e-9;
/* Refinement of the solution; and minimisations, of which the second only sees what the affine function changed. */
enum { REFINEMENTS = 4, ROUNDS = 2 };

/* The part's coefficients come first, q of them, then a multiplier for each node that is held. */
typedef struct rigid {
    const iccp_nodes *nodes;
    const iccp_collocation *collocation;
    const iccp_symmetric *kernel; /* the values between all nodes */
    size_t q, n_held;
    const uint32_t *part;
    const double *rigidity; /* of each, or NULL */
    uint32_t *number;       /* of each node: its place in the part, or NONE */
    uint32_t *held;         /* nodes that are, with a node of the part near them */
    double *weight;         /* rigidity of each derivative */
    iccp_sparse slopes;     /* from coefficients to derivatives: dim rows a node */
    iccp_gram gram;         /* the matrix of 5.16, of the part alone */
    size_t *first;          /* the system: its arrays */
    uint32_t *column;
    double *value, *diagonal;
    int8_t *sign;
    iccp_symmetric matrix;
    iccp_ldlt factor;
} rigid;

static size_t count_entries(const rigid *r, size_t node)
{
    size_t n = r->number[node] != NONE;
    for (size_t p = r->kernel->first[node]; p < r->kernel->first[node + 1]; ++p)
        n += r->number[r->kernel->column[p]] != NONE;
    return n;
}

static void find_held(rigid *r, const bool *held)
{
    for (size_t i = 0; i < r->nodes->n; ++i)
        if (held[i] && count_entries(r, i) > 0)
            r->held[r->n_held++] = (uint32_t)i;
}

/* ---- derivatives ---- */

static void fill_slopes(rigid *r)
{
    const size_t dim = r->nodes->dim;
    const double *x = r->nodes->points;
    const iccp_radial *radial = iccp_collocation_radial(r->collocation);
    size_t n = 0;
    for (size_t row = 0; row < dim * r->q; ++row) {
        const size_t i = r->part[row / dim], axis = row % dim;
        r->slopes.first[row] = n;
        r->weight[row] = r->rigidity != NULL ? r->rigidity[row / dim] : 1;
        for (size_t p = r->kernel->first[i]; p < r->kernel->first[i + 1]; ++p) {
            const size_t j = r->kernel->column[p];
            double distance2 = 0;
            if (r->number[j] == NONE)
                continue;
            for (size_t k = 0; k < dim; ++k)
                distance2 += (x[dim * i + k] - x[dim * j + k]) * (x[dim * i + k] - x[dim * j + k]);
            r->slopes.column[n] = r->number[j];
            r->slopes.value[n++] = 2 * iccp_radial_slope(radial, distance2) *
                                   (x[dim * i + axis] - x[dim * j + axis]);
        }
    }
    r->slopes.first[dim * r->q] = n;
}

static icc_status create_gram(rigid *r, const iccp_env *env)
{
    const size_t rows = r->nodes->dim * r->q;
    size_t n = 0;
    for (size_t k = 0; k < r->q; ++k)
        n += r->nodes->dim * count_entries(r, r->part[k]);
    icc_status status = iccp_sparse_create(&r->slopes, rows, r->q, n, env);
    if (status != ICC_OK)
        return status;
    fill_slopes(r);
    status = iccp_gram_create(&r->gram, &r->slopes, env);
    if (status == ICC_OK)
        iccp_gram_fill(&r->gram, &r->slopes, r->weight);
    return status;
}

/* ---- the system ---- */

/* Row q + h: the values of the part's kernels at a node that is held. */
static void add_equation(rigid *r, size_t h, size_t *fill)
{
    const size_t i = r->held[h];
    for (size_t p = r->kernel->first[i]; p <= r->kernel->first[i + 1]; ++p) {
        const bool own = p == r->kernel->first[i + 1];
        const uint32_t j = r->number[own ? i : r->kernel->column[p]];
        if (j == NONE)
            continue;
        const double value = own ? r->kernel->diagonal[i] : r->kernel->value[p];
        r->column[fill[j]] = (uint32_t)(r->q + h);
        r->value[fill[j]++] = value;
        r->column[fill[r->q + h]] = j;
        r->value[fill[r->q + h]++] = value;
    }
}

/* The Gram matrix, over its greatest diagonal entry, and the equations beside and below it. */
static void fill_system(rigid *r, double scale, size_t *fill)
{
    const iccp_symmetric *g = &r->gram.matrix;
    for (size_t i = 0; i < r->q; ++i) {
        fill[i] = r->first[i];
        for (size_t p = g->first[i]; p < g->first[i + 1]; ++p) {
            r->column[fill[i]] = g->column[p];
            r->value[fill[i]++] = g->value[p] / scale;
        }
        r->diagonal[i] = g->diagonal[i] / scale + WEIGHT_OF_CHANGE;
        r->sign[i] = 1;
    }
    for (size_t h = 0; h < r->n_held; ++h) {
        fill[r->q + h] = r->first[r->q + h];
        r->diagonal[r->q + h] = -PIVOT;
        r->sign[r->q + h] = -1;
    }
    for (size_t h = 0; h < r->n_held; ++h)
        add_equation(r, h, fill);
}

static void count_system(rigid *r, size_t *count)
{
    const iccp_symmetric *g = &r->gram.matrix;
    for (size_t i = 0; i < r->q; ++i)
        count[i] = g->first[i + 1] - g->first[i];
    for (size_t h = 0; h < r->n_held; ++h) {
        const size_t i = r->held[h];
        count[r->q + h] = count_entries(r, i);
        for (size_t p = r->kernel->first[i]; p < r->kernel->first[i + 1]; ++p)
            if (r->number[r->kernel->column[p]] != NONE)
                ++count[r->number[r->kernel->column[p]]];
        if (r->number[i] != NONE)
            ++count[r->number[i]];
    }
}

static icc_status create_system(rigid *r, double scale, const iccp_env *env)
{
    const size_t n = r->q + r->n_held;
    size_t *fill = iccp_alloc(&env->memory, n, sizeof *fill);
    r->first = iccp_alloc(&env->memory, n + 1, sizeof *r->first);
    r->diagonal = iccp_alloc(&env->memory, n, sizeof *r->diagonal);
    r->sign = iccp_alloc(&env->memory, n, sizeof *r->sign);
    icc_status status =
        fill != NULL && r->first != NULL && r->diagonal != NULL && r->sign != NULL ? ICC_OK
                                                                                   : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        count_system(r, fill);
        r->first[0] = 0;
        for (size_t i = 0; i < n; ++i)
            r->first[i + 1] = r->first[i] + fill[i];
        r->column = iccp_alloc(&env->memory, r->first[n], sizeof *r->column);
        r->value = iccp_alloc(&env->memory, r->first[n], sizeof *r->value);
        status = r->column != NULL && r->value != NULL ? ICC_OK : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK) {
        fill_system(r, scale, fill);
        r->matrix = (iccp_symmetric){n, r->first, r->column, r->value, r->diagonal};
        status = iccp_ldlt_analyse(&r->factor, &r->matrix, 1, env);
    }
    if (status == ICC_OK)
        status = iccp_ldlt_factorise_signed(&r->factor, &r->matrix, r->sign, env);
    iccp_free(&env->memory, fill);
    return status;
}

/* left = right - matrix * x, without the pivots of the equations. */
static void find_residual(const rigid *r, size_t m, const double *right, const double *x, double *left)
{
    for (size_t i = 0; i < r->matrix.n; ++i) {
        const double diagonal = i < r->q ? r->diagonal[i] : 0;
        for (size_t j = 0; j < m; ++j)
            left[m * i + j] = right[m * i + j] - diagonal * x[m * i + j];
        for (size_t p = r->first[i]; p < r->first[i + 1]; ++p)
            for (size_t j = 0; j < m; ++j)
                left[m * i + j] -= r->value[p] * x[m * r->column[p] + j];
    }
}

/* ---- minimising ---- */

/* Arrays of m numbers a row. */
typedef struct vectors {
    double *coefficients; /* n + dim + 1 rows */
    double *change;       /* n: of the coefficients; then of the weights */
    double *moved;        /* n */
    double *right, *x, *left, *work; /* as many as the system has */
    double *values, *gradients;      /* 1; dim */
} vectors;

/* The energy, and unless NULL its negative derivatives by the part's coefficients, over `scale`. */
static double find_energy(const rigid *r, size_t m, const vectors *v, double scale, double *right)
{
    const size_t dim = r->nodes->dim;
    double energy = 0;
    if (right != NULL)
        memset(right, 0, r->matrix.n * m * sizeof *right);
    for (size_t row = 0; row < dim * r->q; ++row) {
        if (row % dim == 0)
            iccp_collocation_evaluate(r->collocation, m, v->coefficients,
                                      r->nodes->points + dim * r->part[row / dim], v->values,
                                      v->gradients);
        for (size_t j = 0; j < m; ++j) {
            const double slope = v->gradients[dim * j + row % dim];
            energy += 0.5 * r->weight[row] * slope * slope;
        }
        for (size_t p = r->slopes.first[row]; right != NULL && p < r->slopes.first[row + 1]; ++p)
            for (size_t j = 0; j < m; ++j)
                right[m * r->slopes.column[p] + j] -= r->weight[row] / scale * r->slopes.value[p] *
                                                      v->gradients[dim * j + row % dim];
    }
    return energy;
}

/* Changes of the weights of all nodes, in `moved`. */
static void minimise(const rigid *r, const iccp_handles *handles, const vectors *v)
{
    const size_t m = r->nodes->n_handles, n = r->matrix.n;
    memset(v->x, 0, n * m * sizeof *v->x);
    memcpy(v->left, v->right, n * m * sizeof *v->left);
    for (int k = 0; k <= REFINEMENTS; ++k) {
        iccp_ldlt_solve(&r->factor, m, v->left, v->work);
        for (size_t i = 0; i < n * m; ++i)
            v->x[i] += v->left[i];
        find_residual(r, m, v->right, v->x, v->left);
    }
    memset(v->change, 0, r->nodes->n * m * sizeof *v->change);
    for (size_t i = 0; i < r->q; ++i) {
        memcpy(v->change + m * r->part[i], v->x + m * i, m * sizeof *v->x);
        iccp_handles_project(handles, v->change + m * r->part[i]);
    }
    iccp_collocation_multiply(r->collocation, m, v->change, v->moved);
}

static void move(const rigid *r, const bool *held, double share, const double *moved, double *weights)
{
    const size_t m = r->nodes->n_handles;
    for (size_t i = 0; i < r->nodes->n; ++i)
        for (size_t j = 0; !held[i] && j < m; ++j)
            weights[m * i + j] += share * moved[m * i + j];
}

/* The affine function changes a little with the values, and the energy with it: a round that does not lower it is
 * taken back. */
static icc_status lower_energy(const rigid *r, const iccp_handles *handles, double scale,
                               const bool *held, const vectors *v, double *weights,
                               double energy[2], const iccp_env *env)
{
    const size_t m = r->nodes->n_handles;
    icc_status status = iccp_collocation_solve(r->collocation, m, weights, v->coefficients, env);
    if (status != ICC_OK)
        return status;
    energy[0] = energy[1] = find_energy(r, m, v, scale, v->right);
    for (int k = 0; k < ROUNDS; ++k) {
        minimise(r, handles, v);
        move(r, held, 1, v->moved, weights);
        status = iccp_collocation_solve(r->collocation, m, weights, v->coefficients, env);
        if (status != ICC_OK)
            return status;
        const double now = find_energy(r, m, v, scale, v->right);
        if (!(now < energy[1])) {
            move(r, held, -1, v->moved, weights);
            break;
        }
        energy[1] = now;
    }
    return ICC_OK;
}

static icc_status run(const rigid *r, const iccp_handles *handles, double scale, const bool *held,
                      double *weights, double energy[2], const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = r->nodes->n, m = r->nodes->n_handles, dim = r->nodes->dim, size = r->matrix.n;
    const size_t rows[] = {n + dim + 1, n, n, size, size, size, size, 1, dim};
    vectors v;
    double **const arrays[] = {&v.coefficients, &v.change, &v.moved,  &v.right,    &v.x,
                               &v.left,         &v.work,   &v.values, &v.gradients};
    icc_status status = ICC_OK;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        *arrays[k] = iccp_alloc(memory, rows[k], m * sizeof **arrays[k]);
        if (*arrays[k] == NULL)
            status = ICC_ERR_MEMORY;
    }
    if (status == ICC_OK)
        status = lower_energy(r, handles, scale, held, &v, weights, energy, env);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k)
        iccp_free(memory, *arrays[k]);
    return status;
}

static void clear(rigid *r, const iccp_memory *memory)
{
    iccp_ldlt_free(&r->factor);
    iccp_gram_free(&r->gram);
    iccp_sparse_free(&r->slopes);
    iccp_free(memory, r->number);
    iccp_free(memory, r->held);
    iccp_free(memory, r->weight);
    iccp_free(memory, r->first);
    iccp_free(memory, r->column);
    iccp_free(memory, r->value);
    iccp_free(memory, r->diagonal);
    iccp_free(memory, r->sign);
}

icc_status iccp_stiffen(const iccp_nodes *nodes, const iccp_handles *handles,
                        const iccp_collocation *collocation, size_t n_part, const uint32_t *part,
                        const double *rigidity, const bool *held, double *weights, double energy[2],
                        const iccp_env *env)
{
    const iccp_memory memory = env->memory;
    rigid r = {.nodes = nodes,
               .collocation = collocation,
               .kernel = iccp_collocation_matrix(collocation),
               .q = n_part,
               .part = part,
               .rigidity = rigidity,
               .slopes = {.memory = memory},
               .gram = {.memory = memory},
               .factor = {.memory = memory}};
    double scale = 0;
    r.number = iccp_alloc(&memory, nodes->n, sizeof *r.number);
    r.held = iccp_alloc(&memory, nodes->n, sizeof *r.held);
    r.weight = iccp_alloc(&memory, n_part, nodes->dim * sizeof *r.weight);
    icc_status status =
        r.number != NULL && r.held != NULL && r.weight != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (size_t i = 0; i < nodes->n; ++i)
            r.number[i] = NONE;
        for (size_t k = 0; k < n_part; ++k)
            r.number[part[k]] = (uint32_t)k;
        find_held(&r, held);
        status = create_gram(&r, env);
    }
    for (size_t k = 0; status == ICC_OK && k < n_part; ++k)
        scale = fmax(scale, r.gram.diagonal[k]);
    /* A single node, or nodes out of each other's reach: no coefficient matters. */
    scale = scale > 0 ? scale : 1;
    if (status == ICC_OK)
        status = create_system(&r, scale, env);
    if (status == ICC_OK)
        status = run(&r, handles, scale, held, weights, energy, env);
    clear(&r, &memory);
    return status;
}
