/* Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016), section 5.4: the program (5.35) of all
 * weights near a part at once, from which this differs in five points.
 * - The sign of equation 5.35a is +2: with the printed -2 the energy rises.
 * - Unknown are the weights at the part's nodes and at those within the kernel's reach of it, not
 *   the part's coefficients: these move nodes beside the part, handles and edges among them, and
 *   signs there are not in the program. All other nodes keep their weights.
 * - Nodes that are held (handles, edges, lines) keep theirs, too.
 * - The rigidity stands inside the sum 5.16 and may vary.
 * - Lest the weights bend between the part and what is held, the derivatives of the change count a
 *   little at the nodes around the part.
 * So the energy is q(w) = 1/2 |E w - c|^2 with weights for its rows, E as in rigid_slopes.h, and
 * each node's constraints are its own: sums, reproduction and signs, for which the nearest weights
 * are what the quadratic program of one point finds (handles.c).
 *
 * Minimised by accelerated projected gradients: a step goes down the gradient at a point ahead and
 * then to the nearest weights that are allowed. It starts again without momentum where it climbs.
 * These soon find nearly all weights that are 0 at the optimum, and then take long to get there: so
 * where two steps leave the same weights at 0, conjugate gradients go on among the others. They
 * never climb and stay among what is allowed, and the next step from there says what they missed.
 *
 * As derivatives are taken at the nodes, the Hessian's condition number is that of a Laplacian on
 * them, times a few where the Gaussian's is interpolated: 1,765 nodes take 116 steps and 149 of
 * conjugate gradients, with the Gaussian 186 and 417. Each is made cheap (rigid_hessian.c).
 *
 * A. Beck, M. Teboulle, A fast iterative shrinkage-thresholding algorithm for linear inverse
 * problems, SIAM J. Imaging Sci. 2, 2009; B. O'Donoghue, E. Candes, Adaptive restart for
 * accelerated gradient schemes, Found. Comput. Math. 15, 2015; J. More, G. Toraldo, On the solution
 * of large quadratic programming problems with bound constraints, SIAM J. Optim. 1, 1991. */
#include "base/minmax.h"
#include "kernel/rigid_program.h"
#include "kernel/structure.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* Of the first step: the last one. The energy is then right to about the square of it times the
 * condition number of the Hessian. */
static const double RESIDUAL = 1e-8;
/* Of the size of all weights: what steps change when there is nothing to gain. */
static const double ROUNDING = 1e-14;
/* How much steps get shorter when the energy bends more than was thought. */
static const double MARGIN = 1.1;
/* Half of the steps, as far as progress goes; and when a program is given up. */
#define TYPICAL 100.0
enum { MOST_STEPS = 10000 };
/* Steps in a row with the same weights at 0: conjugate gradients follow. These end where the
 * gradient is so much smaller, or after so many. */
static const double REDUCTION = 1e-2;
enum { ALIKE = 2, MOST_CONJUGATE = 200 };

/* The sum of squared derivatives, each as much as it counts. */
static double measure(const iccp_rigid *r, size_t n_places, const double *slopes)
{
    const size_t row = r->nodes->dim * r->nodes->n_handles;
    double sum = 0;
    for (size_t k = 0; k < n_places; ++k)
        sum += r->count[k] * iccp_vec_dot(row, slopes + row * k, slopes + row * k);
    return sum;
}

/* The weights nearest to those given that are allowed. */
static icc_status allow(const iccp_rigid *r, double *weights)
{
    const size_t dim = r->nodes->dim, m = r->nodes->n_handles;
    for (size_t i = 0; i < r->n_free; ++i) {
        const icc_status status =
            iccp_optimise(r->handles, r->signs[i] ? ICC_WEIGHTS_QP : ICC_WEIGHTS_EQUALITY,
                          r->nodes->points + dim * r->free[i], weights + m * i, r->scratch);
        if (status != ICC_OK)
            return status;
    }
    return ICC_OK;
}

/* How much the energy bends along `change`; what the gradient changes by goes to `bent`. */
static double find_bend(const iccp_rigid *r)
{
    const size_t n = iccp_rigid_weights(r);
    const double length2 = iccp_vec_dot(n, r->change, r->change);
    iccp_hessian_apply(&r->hessian, r->change, r->bent);
    return length2 > 0 ? iccp_vec_dot(n, r->change, r->bent) / length2 : 0;
}

/* From the point ahead along its gradient by 1 / *bend, to `next`; shorter if the energy bends more
 * than that on the way. Returns the step's length, in units of the gradient. */
static icc_status step(const iccp_rigid *r, double *bend, double *length)
{
    const size_t n = iccp_rigid_weights(r);
    for (;;) {
        for (size_t k = 0; k < n; ++k)
            r->next.weights[k] = r->ahead.weights[k] - r->ahead.gradient[k] / *bend;
        const icc_status status = allow(r, r->next.weights);
        if (status != ICC_OK)
            return status;
        for (size_t k = 0; k < n; ++k)
            r->change[k] = r->next.weights[k] - r->ahead.weights[k];
        const double found = find_bend(r);
        if (found <= *bend)
            break;
        *bend = MARGIN * found;
    }
    for (size_t k = 0; k < n; ++k)
        r->next.gradient[k] = r->ahead.gradient[k] + r->bent[k];
    *length = *bend * iccp_vec_norm(n, r->change);
    return ICC_OK;
}

/* ahead = (1 + momentum) next - momentum x */
static void extrapolate(const iccp_rigid *r, double momentum)
{
    const size_t n = iccp_rigid_weights(r);
    for (size_t k = 0; k < n; ++k) {
        const double *w = r->next.weights, *g = r->next.gradient;
        r->ahead.weights[k] = w[k] + momentum * (w[k] - r->x.weights[k]);
        r->ahead.gradient[k] = g[k] + momentum * (g[k] - r->x.gradient[k]);
    }
}

/* Whether the last step and the one before go against each other: momentum has carried too far. */
static bool turns_back(const iccp_rigid *r)
{
    double along = 0;
    for (size_t k = 0; k < iccp_rigid_weights(r); ++k)
        along += r->change[k] * (r->next.weights[k] - r->x.weights[k]);
    return along < 0;
}

static bool same_zeros(const iccp_rigid *r)
{
    const size_t m = r->nodes->n_handles;
    for (size_t k = 0; k < iccp_rigid_weights(r); ++k)
        if (r->signs[k / m] && (r->next.weights[k] <= 0) != (r->x.weights[k] <= 0))
            return false;
    return true;
}

/* Takes from the gradient at x what leads away from the weights that are 0, and what would change
 * sums or reproduction; to next.gradient. Returns its square. */
static double find_face_gradient(const iccp_rigid *r)
{
    const size_t n = iccp_rigid_weights(r), m = r->nodes->n_handles;
    memcpy(r->next.gradient, r->x.gradient, n * sizeof *r->x.gradient);
    for (size_t i = 0; i < r->n_free; ++i)
        iccp_handles_project(r->handles, r->signs[i] ? r->x.weights + m * i : NULL,
                             r->next.gradient + m * i);
    return iccp_vec_dot(n, r->next.gradient, r->next.gradient);
}

/* x and its gradient by `length` times change, or as far as no weight becomes negative. False where
 * one has become 0. */
static bool go_along(const iccp_rigid *r, double length)
{
    const size_t n = iccp_rigid_weights(r), m = r->nodes->n_handles;
    double *x = r->x.weights;
    size_t stop = n;
    for (size_t k = 0; k < n; ++k)
        if (r->signs[k / m] && r->change[k] < 0 && x[k] + length * r->change[k] < 0) {
            length = -x[k] / r->change[k];
            stop = k;
        }
    for (size_t k = 0; k < n; ++k) {
        x[k] += length * r->change[k];
        r->x.gradient[k] += length * r->bent[k];
        if (k == stop || (r->signs[k / m] && x[k] < 0))
            x[k] = 0;
    }
    return stop == n;
}

/* Conjugate gradients from x, with all weights at 0 that are: where another gets there, it stays,
 * and they begin again. Until the gradient is `enough`, or REDUCTION of what it was. */
static icc_status slide(const iccp_rigid *r, double enough, const iccp_env *env)
{
    const size_t n = iccp_rigid_weights(r);
    double square = find_face_gradient(r), older = 0;
    const double least = iccp_max(enough, REDUCTION * sqrt(square));
    for (size_t k = 0; k < MOST_CONJUGATE && square > least * least; ++k) {
        const icc_status status = iccp_progress(env, "weights", 0);
        if (status != ICC_OK)
            return status;
        for (size_t j = 0; j < n; ++j)
            r->change[j] = (older > 0 ? square / older * r->change[j] : 0) - r->next.gradient[j];
        iccp_hessian_apply(&r->hessian, r->change, r->bent);
        const double bend = iccp_vec_dot(n, r->change, r->bent);
        if (!(bend > 0))
            break;
        older = go_along(r, square / bend) ? square : 0;
        square = find_face_gradient(r);
    }
    memcpy(r->ahead.weights, r->x.weights, n * sizeof *r->x.weights);
    memcpy(r->ahead.gradient, r->x.gradient, n * sizeof *r->x.gradient);
    return ICC_OK;
}

/* Steps until one from x itself, without momentum, is at most RESIDUAL of the first: where it is 0,
 * x satisfies the optimality conditions. Where one with momentum is as short, one without follows.
 */
static icc_status minimise(iccp_rigid *r, double *residual, const iccp_env *env)
{
    const size_t n = iccp_rigid_weights(r);
    double age = 1, length = 0, first = 0;
    size_t alike = 0;
    icc_status status = ICC_OK;
    memcpy(r->x.weights, r->before, n * sizeof *r->before);
    iccp_hessian_gather(&r->hessian, r->slopes, r->x.gradient);
    memcpy(r->change, r->x.gradient, n * sizeof *r->change);
    for (size_t i = 0; i < r->n_free; ++i)
        iccp_handles_project(r->handles, NULL, r->change + r->nodes->n_handles * i);
    double bend = MARGIN * find_bend(r);
    memcpy(r->ahead.weights, r->x.weights, n * sizeof *r->x.weights);
    memcpy(r->ahead.gradient, r->x.gradient, n * sizeof *r->x.gradient);
    for (size_t k = 0; bend > 0; ++k) {
        iccp_env round = iccp_round(env, k, TYPICAL);
        status = k < MOST_STEPS ? iccp_progress(&round, "weights", 0) : ICC_ERR_SOLVER;
        if (status == ICC_OK)
            status = step(r, &bend, &length);
        if (status != ICC_OK)
            return status;
        if (k == 0)
            first = iccp_max(length, bend * ROUNDING / RESIDUAL * iccp_vec_norm(n, r->before));
        const bool is_short = length <= RESIDUAL * first, restarted = age <= 1;
        const double older = age;
        alike = same_zeros(r) ? alike + 1 : 0;
        age = is_short || turns_back(r) ? 1 : (1 + sqrt(1 + 4 * age * age)) / 2;
        extrapolate(r, age <= 1 ? 0 : (older - 1) / age);
        const iccp_rigid_state swapped = r->x;
        r->x = r->next;
        r->next = swapped;
        if (is_short && restarted)
            break;
        if (alike >= ALIKE) {
            age = 1;
            status = slide(r, 0.1 * RESIDUAL * first, &round);
            if (status != ICC_OK)
                return status;
        }
    }
    *residual = first > 0 ? length / first : 0;
    return ICC_OK;
}

static icc_status solve(iccp_rigid *r, double *weights, double *coefficients, double energy[2],
                        double *residual, const iccp_env *env)
{
    const size_t m = r->nodes->n_handles;
    iccp_rigid_slopes(r, coefficients, r->slopes);
    energy[0] = 0.5 * r->mean * measure(r, r->n_part, r->slopes);
    icc_status status = minimise(r, residual, env);
    for (size_t i = 0; status == ICC_OK && i < r->n_free; ++i)
        memcpy(weights + m * r->free[i], r->x.weights + m * i, m * sizeof *weights);
    if (status == ICC_OK)
        status = iccp_collocation_solve(r->collocation, m, weights, coefficients, env);
    if (status != ICC_OK)
        return status;
    iccp_rigid_slopes(r, coefficients, r->slopes);
    energy[1] = 0.5 * r->mean * measure(r, r->n_part, r->slopes);
    return ICC_OK;
}

icc_status iccp_stiffen(const iccp_nodes *nodes, const iccp_handles *handles,
                        const iccp_collocation *collocation, size_t n_part, const uint32_t *part,
                        const double *rigidity, const bool *held, bool positive, double *weights,
                        double *coefficients, double energy[2], double *residual,
                        const iccp_env *env)
{
    iccp_rigid r;
    icc_status status = iccp_rigid_create(&r, nodes, handles, collocation, n_part, part, rigidity,
                                          held, positive, weights, env);
    if (status != ICC_OK)
        return status;
    status = solve(&r, weights, coefficients, energy, residual, env);
    iccp_rigid_free(&r);
    return status;
}
