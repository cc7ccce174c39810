/* Finds the weights of a rigid part. Based on: Sakaridis, Kernel Coordinates (ETH Zurich 2016),
 * section 5.4: the program (5.35) of all weights near a part at once. It differs from the thesis in
 * five points.
 *
 * - The sign of equation 5.35a is +2: with the printed -2 the energy rises.
 * - The unknowns are the weights at the part's nodes and at those within the kernel's reach of it.
 *   They are not the part's coefficients, which move nodes beside the part, including handles and
 *   edges, and whose signs are not in the program. All other nodes keep their weights.
 * - Nodes that are held (handles, edges, lines) keep their weights, too.
 * - The rigidity is inside the sum 5.16 and may vary.
 * - The derivatives of the change also count a little at the nodes around the part. Otherwise the
 *   weights would bend between the part and held nodes.
 *
 * So the energy is q(w) = 1/2 |E w - c|^2 with weights for its rows, and E as in rigid_slopes.h.
 * Each node has its own constraints: sums, reproduction and signs. The nearest weights that satisfy
 * these are what the quadratic program of one point finds (handles.c).
 *
 * It is minimised by an active set that may change as a whole. A step goes down the gradient and
 * then to the nearest allowed weights, which tells which of them are 0. With these fixed at 0,
 * conjugate gradients find the least energy among the others, whatever their signs. After a few
 * rounds the weights at 0 are those of the optimum. A step may end higher than the last one without
 * being the shortest. Then conjugate gradients that stop at 0 follow from there, which never climb.
 * They run for 1, 2, 4 .. rounds, because they are slower.
 *
 * An approximate inverse of the Hessian is available (rigid_hessian.c). Components of its products
 * that would change weights at 0 are removed. 1,807 of 2,077 nodes take 68 products with the
 * Hessian, and 90 with the Gaussian. Accelerated projected gradients, followed by conjugate
 * gradients, took 265 and 603.
 *
 * Sources: D. Bertsekas, Projected Newton methods for optimization problems with simple
 * constraints, SIAM J. Control Optim. 20, 1982; M. Hintermueller, K. Ito, K. Kunisch, The
 * primal-dual active set strategy as a semismooth Newton method, SIAM J. Optim. 13, 2003; N. Gould,
 * M. Hribar, J. Nocedal, On the solution of equality constrained quadratic programming problems
 * arising in optimization, SIAM J. Sci. Comput. 23, 2001. */
#include "base/minmax.h"
#include "kernel/pose/rigid_program.h"
#include "kernel/weights/rigid_parts.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* Length of the last step, in units of the first one. The error of the energy is then about the
 * square of it times the condition number of the Hessian. */
static const double RESIDUAL = 1e-8;
/* Share of the size of all weights that steps change when there is nothing to gain. */
static const double ROUNDING = 1e-14;
/* Factor by which steps get shorter if the energy curves more than expected. */
static const double MARGIN = 1.1;
/* Progress reports expect this many rounds; and the limit after which a program is given up. */
#define TYPICAL 10.0
enum { MOST_STEPS = 10000 };
/* Conjugate gradients end when the gradient is reduced by this factor, or after so many
 * iterations. */
static const double REDUCTION = 0.2;
enum { MOST_CONJUGATE = 200 };

/* Returns the weighted sum of squared derivatives. */
static double measure(const iccp_rigid *r, size_t n_places, const double *slopes)
{
    const size_t row = r->nodes->dim * r->nodes->n_handles;
    double sum = 0;
    for (size_t k = 0; k < n_places; ++k)
        sum += r->count[k] * iccp_vec_dot(row, slopes + row * k, slopes + row * k);
    return sum;
}

/* Replaces the weights by the nearest allowed ones. */
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

/* Returns the curvature of the energy along `change`. Writes the change of the gradient to
 * `bent`. */
static double find_bend(const iccp_rigid *r)
{
    const size_t n = iccp_rigid_weights(r);
    const double length2 = iccp_vec_dot(n, r->change, r->change);
    iccp_hessian_apply(&r->hessian, r->change, r->bent);
    return length2 > 0 ? iccp_vec_dot(n, r->change, r->bent) / length2 : 0;
}

/* Steps from x along its gradient by 1 / *bend, to `next`. The step is shorter if the energy curves
 * more than that on the way. Returns its length, in units of the gradient. */
static icc_status step(const iccp_rigid *r, double *bend, double *length)
{
    const size_t n = iccp_rigid_weights(r);
    for (;;) {
        for (size_t k = 0; k < n; ++k)
            r->next.weights[k] = r->x.weights[k] - r->x.gradient[k] / *bend;
        const icc_status status = allow(r, r->next.weights);
        if (status != ICC_OK)
            return status;
        for (size_t k = 0; k < n; ++k)
            r->change[k] = r->next.weights[k] - r->x.weights[k];
        const double found = find_bend(r);
        if (found <= *bend)
            break;
        *bend = MARGIN * found;
    }
    for (size_t k = 0; k < n; ++k)
        r->next.gradient[k] = r->x.gradient[k] + r->bent[k];
    *length = *bend * iccp_vec_norm(n, r->change);
    return ICC_OK;
}

/* Removes from `change` what alters weights that are 0 in `face`, sums or reproduction. */
static void stay_on_face(const iccp_rigid *r, const double *face, double *change)
{
    const size_t m = r->nodes->n_handles;
    for (size_t i = 0; i < r->n_free; ++i)
        iccp_handles_project(r->handles, r->signs[i] ? face + m * i : NULL, change + m * i);
}

static void copy_state(const iccp_rigid *r, const iccp_rigid_state *from, iccp_rigid_state *to)
{
    const size_t size = iccp_rigid_weights(r) * sizeof *from->weights;
    memcpy(to->weights, from->weights, size);
    memcpy(to->gradient, from->gradient, size);
}

/* Moves x and its gradient by `length` times `change`. If `bounded`, moves only as far as no weight
 * becomes negative, and returns false if one has become 0. */
static bool go_along(const iccp_rigid *r, double length, bool bounded)
{
    const size_t n = iccp_rigid_weights(r), m = r->nodes->n_handles;
    double *x = r->x.weights;
    size_t stop = n;
    for (size_t k = 0; bounded && k < n; ++k)
        if (r->signs[k / m] && r->change[k] < 0 && x[k] + length * r->change[k] < 0) {
            length = -x[k] / r->change[k];
            stop = k;
        }
    for (size_t k = 0; k < n; ++k) {
        x[k] += length * r->change[k];
        r->x.gradient[k] += length * r->bent[k];
        if (k == stop || (bounded && r->signs[k / m] && x[k] < 0))
            x[k] = 0;
    }
    return stop == n;
}

/* Runs conjugate gradients from `best` to x, with all weights that are 0 fixed. Ends when the
 * gradient is `enough`, or REDUCTION of its initial size. If `bounded`, weights that reach 0 stay
 * there, and the iteration restarts. */
static icc_status slide(iccp_rigid *r, double enough, bool bounded, const iccp_env *env)
{
    const size_t n = iccp_rigid_weights(r);
    const double *face = bounded ? r->x.weights : r->best.weights;
    double *side = r->next.gradient, *ahead = r->next.weights;
    double least = 0, older = 0;
    copy_state(r, &r->best, &r->x);
    for (size_t k = 0; k < MOST_CONJUGATE; ++k) {
        const icc_status status = iccp_progress(env, "weights", 0);
        if (status != ICC_OK)
            return status;
        memcpy(side, r->x.gradient, n * sizeof *side);
        stay_on_face(r, face, side);
        const double size = iccp_vec_norm(n, side);
        if (k == 0)
            least = iccp_max(enough, REDUCTION * size);
        if (size <= least)
            break;
        iccp_hessian_divide(&r->hessian, side, ahead);
        stay_on_face(r, face, ahead);
        const double square = iccp_vec_dot(n, side, ahead);
        for (size_t j = 0; j < n; ++j)
            r->change[j] = (older > 0 ? square / older * r->change[j] : 0) - ahead[j];
        iccp_hessian_apply(&r->hessian, r->change, r->bent);
        const double bend = iccp_vec_dot(n, r->change, r->bent);
        if (!(bend > 0 && square > 0))
            break;
        older = go_along(r, square / bend, bounded) ? square : 0;
    }
    return ICC_OK;
}

/* Returns true if the energy is higher at `next` than at `best`. */
static bool climbs(const iccp_rigid *r)
{
    double rise = 0;
    for (size_t k = 0; k < iccp_rigid_weights(r); ++k)
        rise +=
            (r->next.weights[k] - r->best.weights[k]) * (r->next.gradient[k] + r->best.gradient[k]);
    return rise > 0;
}

/* Repeats steps to `best`, and from there on its face to the next x, until a step is at most
 * RESIDUAL of the first. If it is 0, x satisfies the optimality conditions. */
static icc_status minimise(iccp_rigid *r, double *residual, const iccp_env *env)
{
    const size_t n = iccp_rigid_weights(r);
    double length = 0, first = 0, shortest = HUGE_VAL;
    size_t n_bounded = 0, next_bounded = 1;
    icc_status status = ICC_OK;
    memcpy(r->x.weights, r->before, n * sizeof *r->before);
    iccp_hessian_gather(&r->hessian, r->slopes, r->x.gradient);
    memcpy(r->change, r->x.gradient, n * sizeof *r->change);
    for (size_t i = 0; i < r->n_free; ++i)
        iccp_handles_project(r->handles, NULL, r->change + r->nodes->n_handles * i);
    double bend = MARGIN * find_bend(r);
    copy_state(r, &r->x, &r->best);
    for (size_t k = 0; bend > 0; ++k) {
        iccp_env round = iccp_round(env, k, TYPICAL);
        status = k < MOST_STEPS ? iccp_progress(&round, "weights", 0) : ICC_ERR_SOLVER;
        if (status == ICC_OK)
            status = step(r, &bend, &length);
        if (status != ICC_OK)
            return status;
        if (k == 0)
            first = iccp_max(length, bend * ROUNDING / RESIDUAL * iccp_vec_norm(n, r->before));
        if (n_bounded == 0 && length >= shortest && climbs(r)) {
            n_bounded = next_bounded;
            next_bounded *= 2;
        } else {
            const iccp_rigid_state swapped = r->best;
            r->best = r->next;
            r->next = swapped;
            n_bounded -= n_bounded > 0;
            shortest = iccp_min(shortest, length);
            if (length <= RESIDUAL * first)
                break;
        }
        status = slide(r, 0.1 * RESIDUAL * first, n_bounded > 0, &round);
        if (status != ICC_OK)
            return status;
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
        memcpy(weights + m * r->free[i], r->best.weights + m * i, m * sizeof *weights);
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
