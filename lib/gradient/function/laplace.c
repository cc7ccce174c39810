/* Solves the equations of functions. Based on: L. Huynh and Y. Gingold, Bijective Deformations in
 * R^n via Integral Curve Coordinates, section 5.2: solutions to the Laplace and bi-Laplace
 * equations, with and without the inequalities of the cousin tree. */
#include "gradient/function/laplace.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/minmax.h"
#include "gradient/function/critical_points.h"
#include "gradient/solver/active_set.h"
#include "gradient/solver/bilaplace.h"
#include "gradient/solver/inequalities.h"
#include "gradient/solver/tied.h"
#include "math/elementary.h"

/* State of a solution. All members are borrowed except the arrays. */
typedef struct job {
    icc_function *function;
    const icc_function_options *options;
    iccp_unknowns unknowns;
    iccp_scaled f;
    uint32_t *top; /* per unknown, as in iccp_ties, like the next two; ties nothing */
    double *share;
    uint32_t *order;
} job;

/* Largest factorisation, in multiplications, that is preferred to conjugate gradients. */
static const double MOST_WORK_IN_2D = 2e10, MOST_WORK_BEYOND = 2e9;

/* Estimates the multiplications of a factorisation whose separators are the generations of the
 * tree. Along a limb of breadth w, blocks of w^dim vertices cost w^(3 (dim - 1)) each. That is w^(3
 * dim - 4) per generation of w^(dim - 1) vertices. The factors come from exact counts on squares
 * and boxes (tests/bench/bench_spd). */
static double predict_work(const icc_tree *tree)
{
    const double dim = tree->grid->dim;
    const double power = dim > 1 ? (3 * dim - 4) / (dim - 1) : 1;
    const double factor = dim < 3 ? 8 : 50;
    double work = 0;
    for (size_t begin = 0, end; begin < tree->n_inside; begin = end) {
        const int32_t generation = tree->generation[tree->order[begin]];
        for (end = begin + 1; end < tree->n_inside; ++end)
            if (tree->generation[tree->order[end]] != generation)
                break;
        work += factor * iccp_pow((double)(end - begin), power);
    }
    return work;
}

static int32_t choose_solver(const job *j)
{
    if (j->options->function == ICC_FUNCTION_CLAMPED ||
        j->options->function == ICC_FUNCTION_HARMONIC)
        return ICC_SOLVER_DIRECT;
    if (j->options->solver != 0)
        return j->options->solver;
    const icc_tree *tree = j->function->tree;
    const double most = tree->grid->dim < 3 ? MOST_WORK_IN_2D : MOST_WORK_BEYOND;
    return predict_work(tree) <= most ? ICC_SOLVER_DIRECT : ICC_SOLVER_ITERATIVE;
}

/* Numbers the unknowns and allocates arrays. No unknown is tied to another one yet, and the guess
 * is 1 everywhere. order[0] == ICCP_NONE says that no order of elimination is known. */
static icc_status begin_job(job *j, const iccp_env *env)
{
    icc_status status = iccp_unknowns_create(&j->unknowns, j->function->tree, env);
    if (status == ICC_OK && j->options->function == ICC_FUNCTION_HARMONIC)
        status = iccp_unknowns_reach_boundary(&j->unknowns, env);
    if (status != ICC_OK)
        return status;
    const size_t n = j->unknowns.n;
    j->f.fraction = iccp_alloc(&env->memory, n, sizeof *j->f.fraction);
    j->f.exponent = iccp_alloc(&env->memory, n, sizeof *j->f.exponent);
    j->top = iccp_alloc(&env->memory, n, sizeof *j->top);
    j->share = iccp_alloc(&env->memory, n, sizeof *j->share);
    j->order = iccp_alloc(&env->memory, n, sizeof *j->order);
    if (j->f.fraction == NULL || j->f.exponent == NULL || j->top == NULL || j->share == NULL ||
        j->order == NULL)
        return ICC_ERR_MEMORY;
    j->order[0] = ICCP_NONE;
    for (uint32_t k = 0; k < n; ++k) {
        iccp_scaled_set(&j->f, k, 1, 0);
        j->top[k] = k;
        j->share[k] = 1;
    }
    return ICC_OK;
}

static void free_job(job *j, const iccp_env *env)
{
    iccp_unknowns_free(&j->unknowns);
    iccp_free(&env->memory, j->f.fraction);
    iccp_free(&env->memory, j->f.exponent);
    iccp_free(&env->memory, j->top);
    iccp_free(&env->memory, j->share);
    iccp_free(&env->memory, j->order);
}

/* Solves by factorisation if possible, else by iteration. `info` tells which. */
static icc_status solve_directly(const iccp_unknowns *unknowns, const iccp_ties *ties,
                                 const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    const icc_status status = iccp_tied_direct(unknowns, ties, f, info, env);
    if (status != ICC_ERR_SOLVER || unknowns->reach != NULL)
        return status;
    iccp_log(env, "the factorisation loses values far from the maximum: iterating instead");
    info->solver = ICC_SOLVER_ITERATIVE;
    for (size_t k = 0; k < unknowns->n; ++k)
        iccp_scaled_set(f, k, 1, 0);
    return iccp_tied_iterative(unknowns, ties, f, info, env);
}

static iccp_tied_solver tied_solver(const job *j)
{
    return j->function->info.solver == ICC_SOLVER_DIRECT ? solve_directly : iccp_tied_iterative;
}

/* With zeros on the boundary itself, the equation is the same with another diagonal. */
static bool is_laplace(int32_t function)
{
    return function == ICC_FUNCTION_LAPLACE || function == ICC_FUNCTION_HARMONIC;
}

static icc_status solve_laplace(job *j, const iccp_env *env)
{
    iccp_solution *info = &j->function->info;
    const iccp_ties none = {j->top, j->share, j->order};
    const icc_status status = tied_solver(j)(&j->unknowns, &none, &j->f, info, env);
    if (status != ICC_OK)
        return status;
    for (size_t k = 1; k < j->unknowns.n; ++k)
        info->residual =
            iccp_max(info->residual, fabs(iccp_laplacian_row(&j->unknowns, &j->f, k, 0)));
    info->residual_before = info->residual;
    return ICC_OK;
}

static icc_status solve(job *j, const iccp_env *env)
{
    iccp_solution *info = &j->function->info;
    const int32_t function = j->options->function;
    const icc_status status = is_laplace(function) ? solve_laplace(j, env)
                                                   : iccp_bilaplace(&j->unknowns, function,
                                                                    info->solver, &j->f, info, env);
    if (status != ICC_OK)
        return status;
    const double clock = iccp_seconds();
    info->n_violated = iccp_inequalities_violated(&j->unknowns, j->options->min_fall, &j->f);
    info->seconds_verify += iccp_seconds() - clock;
    return ICC_OK;
}

static icc_status constrain(job *j, const iccp_env *env)
{
    iccp_solution *info = &j->function->info;
    const int32_t function = j->options->function;
    const double eta = j->options->min_fall;
    info->constrained = 1;
    if (is_laplace(function))
        return iccp_active_set_laplace(&j->unknowns, eta, tied_solver(j), j->order, &j->f, info,
                                       env);
    info->solver = ICC_SOLVER_DIRECT;
    return iccp_bilaplace_constrained(&j->unknowns, function, eta, j->options->leaf_min, &j->f,
                                      info, env);
}

/* Solves without the inequalities first. That solution is the guess for solving with them. With
 * ICC_CONSTRAINTS_NEEDED it is the result if its critical points on the grid allow. */
static icc_status find_function(job *j, const iccp_env *env)
{
    icc_function *function = j->function;
    const int32_t constraints = j->options->constraints;
    iccp_env part[4];
    iccp_split(part, 4, (const double[]){1, 6, 1, constraints == ICC_CONSTRAINTS_NONE ? 0 : 8},
               env);
    icc_status status = begin_job(j, &part[0]);
    if (status == ICC_OK)
        status = solve(j, &part[1]);
    bool enough = constraints == ICC_CONSTRAINTS_NONE;
    if (status == ICC_OK && constraints == ICC_CONSTRAINTS_NEEDED) {
        const double clock = iccp_seconds();
        status = iccp_function_assign(function, &j->unknowns, &j->f);
        if (status == ICC_OK)
            status = iccp_function_is_regular(function, &enough, &part[2]);
        function->info.seconds_verify += iccp_seconds() - clock;
    }
    if (status == ICC_OK && !enough)
        status = constrain(j, &part[3]);
    return status == ICC_OK ? iccp_function_assign(function, &j->unknowns, &j->f) : status;
}

icc_status iccp_laplace(icc_function *function, const icc_function_options *options,
                        const iccp_env *env, icc_error *err)
{
    job j = {.function = function, .options = options};
    const icc_tree *tree = function->tree;
    if (tree->n_inside < 2)
        return iccp_fail_at(
            err, ICC_ERR_RESOLUTION, ICC_ITEM_GRID_VERTEX, tree->root,
            "the grid is too coarse: vertex %lu is the only one inside that the tree "
            "reaches",
            (unsigned long)tree->root);
    if (options->function == ICC_FUNCTION_HARMONIC && tree->grid->domain == NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "the grid was not made from a domain, so there is no boundary");
    function->info.n_unknowns = tree->n_inside - 1;
    function->info.solver = choose_solver(&j);
    const icc_status status = find_function(&j, env);
    free_job(&j, env);
    if (status == ICC_ERR_SOLVER)
        return iccp_fail(err, status, "the %s solver did not converge",
                         function->info.solver == ICC_SOLVER_DIRECT ? "direct" : "iterative");
    return status;
}
