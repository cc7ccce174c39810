/* Conjugate gradients in the form with one round of dot products per iteration: A. Chronopoulos and
 * C. W. Gear, s-step iterative methods for symmetric linear systems, 1989.
 *
 * Memory access takes most of the time, so an iteration makes only two passes over memory. The pass
 * down computes the new direction p, the new x and r, and the first half of the V-cycle. The pass
 * up computes the second half and the dot products. Both go slab by slab, and each step is one slab
 * behind the previous step.
 *
 * p and the V-cycle are float. That loses nothing: r changes exactly as x does, whatever p is, so
 * it stays the residual to double precision. A p is never stored. */
#include "gradient/solver/mg_cg.h"

#include "base/budget.h"
#include "base/minmax.h"

#include <math.h>

/* Number of entries between progress reports. */
static const size_t ENTRIES_PER_REPORT = (size_t)1 << 20;

typedef struct solver {
    iccp_multigrid *mg;
    const iccp_mg_level *level;
    double *x, *r; /* by entry of the level, like p */
    float *p;
    double alpha, beta, bound, least;
    iccp_mg_upward up;     /* of the last pass up */
    iccp_mg_downward down; /* of the last pass down */
} solver;

static double add_lanes(const double lanes[ICCP_MG_LANES])
{
    double sum = 0;
    for (int j = 0; j < ICCP_MG_LANES; ++j)
        sum += lanes[j];
    return sum;
}

static double max_lanes(const double lanes[ICCP_MG_LANES])
{
    double most = lanes[0];
    for (int j = 1; j < ICCP_MG_LANES; ++j)
        most = lanes[j] > most ? lanes[j] : most;
    return most;
}

/* A run of a level. */
typedef struct stretch {
    size_t row, n;
    int half;
    uint32_t begin;
} stretch;

/* Calls act() for every run of a slab. */
static ICCP_INLINE void for_slab(solver *s, size_t slab, void (*act)(solver *, const stretch *))
{
    const size_t n = s->level->n_rows / s->level->n_slabs;
    for (size_t row = slab * n; row < (slab + 1) * n; ++row)
        for (int half = 0; half < 2; ++half) {
            const iccp_mg_run *end, *run = iccp_mg_runs(s->level, row, half, &end);
            for (; run < end; ++run) {
                const stretch t = {row, run->end - run->begin, half, run->begin};
                act(s, &t);
            }
        }
}

static void redirect(solver *s, const stretch *t)
{
    const size_t at = iccp_mg_position(s->level, t->row, 2 * t->begin + (uint32_t)t->half);
    s->level->kernels->redirect(s->p + at, s->level->x + at, (float)s->beta, t->n);
}

static void advance(solver *s, const stretch *t)
{
    const float *near[2 * ICC_MAX_DIM];
    const size_t at = iccp_mg_near_in(s->level, t->row, t->half, t->begin, s->p, near);
    const iccp_mg_step step = {s->x + at, s->r + at, s->level->b + at, s->p + at,
                               s->alpha,  s->bound,  s->least};
    s->level->kernels->advance(&step, near, t->n, 2 * s->level->dim, &s->down);
}

static void measure(solver *s, const stretch *t)
{
    const float *near[2 * ICC_MAX_DIM];
    const size_t at = iccp_mg_near_in(s->level, t->row, t->half, t->begin, s->level->x, near);
    s->level->kernels->measure(s->level->x + at, s->r + at, near, t->n, 2 * s->level->dim, &s->up);
}

/* Reports progress once per ENTRIES_PER_REPORT. */
static icc_status report(const solver *s, size_t slab, const iccp_env *env)
{
    const size_t slabs = ENTRIES_PER_REPORT / (s->level->n_entries / s->level->n_slabs + 1) + 1;
    return slab % slabs == 0 ? iccp_progress(env, "solve", 0) : ICC_OK;
}

static icc_status pass_down(solver *s, const iccp_env *env)
{
    const size_t n = s->level->n_slabs;
    icc_status status = iccp_budget_work(env, ICCP_CG_WORK * (double)s->level->n_entries);
    s->down = (iccp_mg_downward){{0}, {0}, {0}};
    for (int j = 0; j < ICCP_MG_LANES; ++j)
        s->down.excess[j] = -HUGE_VAL;
    for (size_t slab = 0; slab < n + 4 && status == ICC_OK; ++slab) {
        if (slab < n)
            for_slab(s, slab, redirect);
        if (slab >= 1 && slab - 1 < n)
            for_slab(s, slab - 1, advance);
        if (slab >= 1)
            iccp_multigrid_descend(s->mg, slab - 1);
        status = report(s, slab, env);
    }
    return status;
}

static icc_status pass_up(solver *s, const iccp_env *env)
{
    const size_t n = s->level->n_slabs;
    icc_status status = ICC_OK;
    iccp_multigrid_correct(s->mg);
    s->up = (iccp_mg_upward){{0}, {0}};
    for (size_t slab = 0; slab < n + 3 && status == ICC_OK; ++slab) {
        iccp_multigrid_ascend(s->mg, slab);
        if (slab >= 3)
            for_slab(s, slab - 3, measure);
        status = report(s, slab, env);
    }
    return status;
}

/* As in the source, p'Ap is not summed up but follows from z'Az and the last step. The measurements
 * of a pass down belong to the x that it made. So the goal is tested between the passes. */
static icc_status iterate(solver *s, double size, const iccp_mg_goal *goal, size_t *n_iterations,
                          const iccp_env *env)
{
    const double wanted = goal->relative * size;
    double least = HUGE_VAL, rz = 0;
    size_t since = 0;
    s->bound = goal->componentwise * 2 * s->level->dim;
    /* A pass with alpha = 0 measures the initial state and begins the first V-cycle. */
    icc_status status = pass_down(s, env);
    while (status == ICC_OK) {
        const double rr = add_lanes(s->down.rr);
        if (sqrt(rr) <= wanted && max_lanes(s->down.excess) <= 0)
            break;
        since = rr < least ? 0 : since + 1;
        least = iccp_min(rr, least);
        if (!isfinite(rr) || since > ICCP_CG_PATIENCE)
            return ICC_ERR_SOLVER;
        status = pass_up(s, env);
        if (status != ICC_OK)
            break;
        const double next = add_lanes(s->up.rz), zaz = add_lanes(s->up.zaz);
        s->beta = s->alpha > 0 ? next / rz : 0;
        const double curvature = s->alpha > 0 ? zaz - s->beta * next / s->alpha : zaz;
        if (!(next > 0 && curvature > 0))
            return ICC_ERR_SOLVER;
        rz = next;
        s->alpha = rz / curvature;
        s->least = goal->floor * max_lanes(s->down.peak);
        status = pass_down(s, env);
        ++*n_iterations;
    }
    return status;
}

icc_status iccp_mg_cg(iccp_multigrid *mg, double *x, double *r, double size,
                      const iccp_mg_goal *goal, size_t *n_iterations, const iccp_env *env)
{
    solver s = {.mg = mg, .level = &mg->level[0], .x = x, .r = r};
    s.p = iccp_alloc_zero(&mg->memory, s.level->n_entries, sizeof *s.p);
    if (s.p == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iterate(&s, size, goal, n_iterations, env);
    iccp_free(&mg->memory, s.p);
    return status;
}
