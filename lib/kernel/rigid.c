/* Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), section 5.4, from which this differs
 * in five points.
 * - The sign of equation 5.35a is +2: with the printed -2 the energy rises.
 * - The matrix acts on every handle alike, and sums and reproduction, 5.35b and c, hold when the
 *   change of each coefficient, as a vector over the handles, lies in the null space of the
 *   handles' matrix. So each handle is a right side of one system, and the changes are projected.
 * - Nodes that are held (handles, edges, lines) would move with the part near them; here they stay.
 * - The rigidity stands inside the sum 5.16 and may vary.
 * - Not only the part's coefficients change, but also those around it, lest the weights bend
 *   between the part and what is held; there, the derivatives of the change count instead of those
 *   of the weights.
 * Non-negativity, 5.35d, is restored node by node after minimising, which takes a quarter of the
 * gain on the star. */
#include "base/minmax.h"
#include "kernel/rigid_system.h"
#include "kernel/structure.h"

#include <math.h>
#include <string.h>

/* Arrays of m numbers a row. */
typedef struct vectors {
    double *coefficients;            /* n + dim + 1 rows */
    double *change;                  /* n: of the coefficients */
    double *moved;                   /* n: by it, the weights */
    double *right, *x, *left, *work; /* as many as the system has */
    double *values;                  /* 1 */
    double *gradients, *others;      /* dim */
    double *scratch;                 /* for iccp_optimise() */
} vectors;

/* The energy, and its negative derivatives by the area's coefficients. */
static double find_energy(const iccp_rigid *r, const double *coefficients, const vectors *v)
{
    const size_t dim = r->nodes->dim, m = r->nodes->n_handles;
    double energy = 0;
    memset(v->right, 0, r->matrix.n * m * sizeof *v->right);
    for (size_t row = 0; row < dim * r->n_part; ++row) {
        const double weight = r->weight[row], *slopes = v->gradients + row % dim;
        if (row % dim == 0)
            iccp_collocation_evaluate(r->collocation, m, coefficients,
                                      r->nodes->points + dim * r->area[row / dim], v->values,
                                      v->gradients);
        for (size_t j = 0; j < m; ++j)
            energy += 0.5 * weight * slopes[dim * j] * slopes[dim * j];
        for (size_t p = r->slopes.first[row]; p < r->slopes.first[row + 1]; ++p) {
            double *right = v->right + m * r->slopes.column[p];
            for (size_t j = 0; j < m; ++j)
                right[j] -= weight / r->scale * r->slopes.value[p] * slopes[dim * j];
        }
    }
    return energy;
}

/* Changes of the weights of all nodes, in `moved`. */
static void minimise(const iccp_rigid *r, const iccp_handles *handles, const vectors *v)
{
    const size_t m = r->nodes->n_handles;
    iccp_rigid_solve(r, m, v->right, v->x, v->left, v->work);
    memset(v->change, 0, r->nodes->n * m * sizeof *v->change);
    for (size_t i = 0; i < r->n; ++i) {
        double *change = v->change + m * r->area[i];
        memcpy(change, v->x + m * i, m * sizeof *change);
        iccp_handles_project(handles, change);
    }
    iccp_collocation_multiply(r->collocation, m, v->change, v->moved);
}

static bool has_negative(size_t m, const double *weights)
{
    for (size_t j = 0; j < m; ++j)
        if (weights[j] < 0)
            return true;
    return false;
}

/* Turns changes of weights into weights; with `positive`, where none was negative none becomes
 * so. */
static void add_weights(const iccp_rigid *r, const iccp_handles *handles, const bool *held,
                        bool positive, const double *weights, const vectors *v)
{
    const size_t m = r->nodes->n_handles;
    for (size_t i = 0; i < r->nodes->n; ++i) {
        double *moved = v->moved + m * i;
        const double *before = weights + m * i;
        for (size_t j = 0; j < m; ++j)
            moved[j] = before[j] + (held[i] ? 0 : moved[j]);
        if (positive && has_negative(m, moved) && !has_negative(m, before))
            (void)iccp_optimise(handles, ICC_WEIGHTS_QP, r->nodes->points + r->nodes->dim * i,
                                moved, v->scratch);
    }
}

/* The energy's bilinear form, of old and new coefficients or of new ones alone. */
static double product_of(const iccp_rigid *r, const double *a, const double *b, const vectors *v)
{
    const size_t dim = r->nodes->dim, m = r->nodes->n_handles;
    double product = 0;
    for (size_t i = 0; i < r->n_part; ++i) {
        const double *place = r->nodes->points + dim * r->area[i];
        iccp_collocation_evaluate(r->collocation, m, a, place, v->values, v->gradients);
        iccp_collocation_evaluate(r->collocation, m, b, place, v->values, v->others);
        for (size_t k = 0; k < dim * m; ++k)
            product += 0.5 * r->weight[dim * i] * v->gradients[k] * v->others[k];
    }
    return product;
}

/* The affine function of the interpolant changes with the values, and positive weights cost
 * something, too. So the energy is minimised once more between the old weights and the new ones,
 * where it is a parabola. */
static icc_status lower_energy(const iccp_rigid *r, const iccp_handles *handles, const bool *held,
                               bool positive, const vectors *v, double *weights,
                               double *coefficients, double energy[2], const iccp_env *env)
{
    const size_t n = r->nodes->n, m = r->nodes->n_handles;
    const double before = find_energy(r, coefficients, v);
    minimise(r, handles, v);
    add_weights(r, handles, held, positive, weights, v);
    const icc_status status =
        iccp_collocation_solve(r->collocation, m, v->moved, v->coefficients, env);
    if (status != ICC_OK)
        return status;
    const double mixed = product_of(r, coefficients, v->coefficients, v);
    const double after = product_of(r, v->coefficients, v->coefficients, v);
    const double curvature = before - 2 * mixed + after;
    const double share = curvature > 0 ? iccp_min(iccp_max((before - mixed) / curvature, 0), 1) : 0;
    energy[0] = before;
    energy[1] = before - share * (2 * (before - mixed) - share * curvature);
    for (size_t k = 0; k < n * m; ++k)
        weights[k] += share * (v->moved[k] - weights[k]);
    for (size_t k = 0; k < (n + r->nodes->dim + 1) * m; ++k)
        coefficients[k] += share * (v->coefficients[k] - coefficients[k]);
    return ICC_OK;
}

/* Allocates all arrays of `vectors` by one table of their rows, so that each is there or NULL when
 * they are freed. */
static icc_status lower_with_room(const iccp_rigid *r, const iccp_handles *handles,
                                  const bool *held, bool positive, double *weights,
                                  double *coefficients, double energy[2], const iccp_env *env)
{
    const size_t n = r->nodes->n, m = r->nodes->n_handles, dim = r->nodes->dim, size = r->matrix.n;
    const size_t scratch = iccp_optimise_work(handles) / m + 1;
    const size_t rows[] = {n + dim + 1, n, n, size, size, size, size, 1, dim, dim, scratch};
    vectors v;
    double **const arrays[] = {&v.coefficients, &v.change, &v.moved,  &v.right,     &v.x,
                               &v.left,         &v.work,   &v.values, &v.gradients, &v.others,
                               &v.scratch};
    icc_status status = ICC_OK;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        *arrays[k] = iccp_alloc(&env->memory, rows[k], m * sizeof **arrays[k]);
        if (*arrays[k] == NULL)
            status = ICC_ERR_MEMORY;
    }
    if (status == ICC_OK)
        status = lower_energy(r, handles, held, positive, &v, weights, coefficients, energy, env);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k)
        iccp_free(&env->memory, *arrays[k]);
    return status;
}

icc_status iccp_stiffen(const iccp_nodes *nodes, const iccp_handles *handles,
                        const iccp_collocation *collocation, size_t n_part, const uint32_t *part,
                        const double *rigidity, const bool *held, bool positive, double *weights,
                        double *coefficients, double energy[2], const iccp_env *env)
{
    iccp_rigid r;
    icc_status status = iccp_progress(env, "weights", 0);
    if (status == ICC_OK)
        status = iccp_rigid_create(&r, nodes, collocation, n_part, part, rigidity, held, env);
    if (status != ICC_OK)
        return status;
    status = lower_with_room(&r, handles, held, positive, weights, coefficients, energy, env);
    iccp_rigid_free(&r);
    return status;
}
