/* Conjugate gradients in the form with one round of dot products an iteration: A. Chronopoulos and C. W.
 * Gear, s-step iterative methods for symmetric linear systems, 1989, section 2. Memory is what costs time here,
 * so that an iteration is two passes over it: down (new direction p, new x and r, first half of the
 * V-cycle) and up (second half, dot products), slab by slab with each step a slab behind the one before.
 *
 * p and the V-cycle are float. That is no loss: r changes by exactly what x does, whatever p is, so that it stays
 * the residual to double precision. A p is never stored. */
#include "field/mg_cg.h"

#include <math.h>

/* Iterations without a smaller residual after which it will not get smaller. */
enum { PATIENCE = 40 };

/* Progress is reported whenever so many entries have been worked on. */
static const size_t ENTRIES_PER_REPORT = (size_t)1 << 20;

/* Sums are taken in so many interleaved parts, whatever the width of the machine's vectors. */
enum { LANES = 8 };

typedef struct upward {
    double rz[LANES], zaz[LANES];
} upward;

typedef struct downward {
    double rr[LANES];     /* |r|^2 */
    double peak[LANES];   /* the largest x */
    double excess[LANES]; /* the largest |r| - bound * max(x, least) */
} downward;

typedef struct solver {
    iccp_multigrid *mg;
    const iccp_mg_level *level;
    double *x, *r;
    float *p;
    double alpha, beta, bound, least;
    upward up;     /* of the last pass up */
    downward down; /* of the last pass down */
} solver;

/* Stencils. n_near is a constant wherever these are called. */
static ICCP_INLINE double apply(const float *centre, const float *const *near, size_t i, int32_t n_near)
{
    double sum = (double)near[0][i] + (double)near[1][i];
    for (int32_t j = 2; j < n_near; ++j)
        sum += (double)near[j][i];
    return n_near * (double)centre[i] - sum;
}

typedef struct stretch {
    size_t at, n;
    const float *near[2 * ICC_MAX_DIM]; /* of the vector that the stencil is applied to */
} stretch;

static double add_lanes(const double lanes[LANES])
{
    double sum = 0;
    for (int j = 0; j < LANES; ++j)
        sum += lanes[j];
    return sum;
}

static double max_lanes(const double lanes[LANES])
{
    double most = lanes[0];
    for (int j = 1; j < LANES; ++j)
        most = lanes[j] > most ? lanes[j] : most;
    return most;
}

static ICCP_INLINE void measure_at(const stretch *t, const float *z, const double *r, size_t i,
                                   size_t lane, int32_t n_near, upward *up)
{
    up->rz[lane] += r[i] * (double)z[i];
    up->zaz[lane] += (double)z[i] * apply(z, t->near, i, n_near);
}

static ICCP_INLINE void measure(solver *s, const stretch *t, int32_t n_near)
{
    const float *z = s->level->x + t->at;
    const double *r = s->r + t->at;
    size_t i = 0;
    if (t->n >= LANES) {
        upward up = s->up;
        for (; i + LANES <= t->n; i += LANES)
            for (size_t j = 0; j < LANES; ++j)
                measure_at(t, z, r, i + j, j, n_near, &up);
        s->up = up;
    }
    for (size_t j = 0; i + j < t->n; ++j)
        measure_at(t, z, r, i + j, j, n_near, &s->up);
}

/* What a pass down writes and reads, in registers. */
typedef struct update {
    double *restrict x, *restrict r;
    float *restrict b;
    const float *p;
    double alpha, bound, least;
} update;

static ICCP_INLINE void advance_at(const update *u, const float *const *near, size_t i, size_t lane,
                                   int32_t n_near, downward *down)
{
    const double x = u->x[i] + u->alpha * (double)u->p[i];
    const double r = u->r[i] - u->alpha * apply(u->p, near, i, n_near);
    const double excess = (r < 0 ? -r : r) - u->bound * (x > u->least ? x : u->least);
    u->x[i] = x;
    u->r[i] = r;
    u->b[i] = (float)r;
    down->rr[lane] += r * r;
    down->peak[lane] = x > down->peak[lane] ? x : down->peak[lane];
    down->excess[lane] = excess > down->excess[lane] ? excess : down->excess[lane];
}

static ICCP_INLINE void advance(solver *s, const stretch *t, int32_t n_near)
{
    const update u = {s->x + t->at, s->r + t->at, s->level->b + t->at, s->p + t->at,
                      s->alpha,     s->bound,     s->least};
    size_t i = 0;
    if (t->n >= LANES) {
        downward down = s->down;
        for (; i + LANES <= t->n; i += LANES)
            for (size_t j = 0; j < LANES; ++j)
                advance_at(&u, t->near, i + j, j, n_near, &down);
        s->down = down;
    }
    for (size_t j = 0; i + j < t->n; ++j)
        advance_at(&u, t->near, i + j, j, n_near, &s->down);
}

static void measure_stretch(solver *s, const stretch *t)
{
    switch (s->level->dim) {
    case 2:
        measure(s, t, 4);
        break;
    case 3:
        measure(s, t, 6);
        break;
    default:
        measure(s, t, 2 * s->level->dim);
    }
}

static void advance_stretch(solver *s, const stretch *t)
{
    switch (s->level->dim) {
    case 2:
        advance(s, t, 4);
        break;
    case 3:
        advance(s, t, 6);
        break;
    default:
        advance(s, t, 2 * s->level->dim);
    }
}

/* Does something with every run of a slab and the neighbours of its vertices in `all`. */
static void for_slab(solver *s, size_t slab, const float *all, void (*act)(solver *, const stretch *))
{
    const size_t n = s->level->n_rows / s->level->n_slabs;
    for (size_t row = slab * n; row < (slab + 1) * n; ++row)
        for (int half = 0; half < 2; ++half) {
            const iccp_mg_run *end, *run = iccp_mg_runs(s->level, row, half, &end);
            for (; run < end; ++run) {
                size_t near[2 * ICC_MAX_DIM];
                stretch t = {.n = run->end - run->begin};
                t.at = iccp_mg_near(s->level, row, half, run->begin, near);
                for (int32_t j = 0; j < 2 * s->level->dim; ++j)
                    t.near[j] = all + near[j];
                act(s, &t);
            }
        }
}

/* p = z + beta p */
static void turn(solver *s, const stretch *t)
{
    const float *z = s->level->x + t->at;
    float *restrict p = s->p + t->at;
    const float beta = (float)s->beta;
    for (size_t i = 0; i < t->n; ++i)
        p[i] = z[i] + beta * p[i];
}

/* Reports progress once for so many entries. */
static icc_status report(const solver *s, size_t slab, const iccp_env *env)
{
    const size_t slabs = ENTRIES_PER_REPORT / (s->level->n_entries / s->level->n_slabs + 1) + 1;
    return slab % slabs == 0 ? iccp_progress(env, "multigrid", 0) : ICC_OK;
}

static icc_status pass_down(solver *s, const iccp_env *env)
{
    const size_t n = s->level->n_slabs;
    icc_status status = ICC_OK;
    s->down = (downward){{0}, {0}, {0}};
    for (int j = 0; j < LANES; ++j)
        s->down.excess[j] = -HUGE_VAL;
    for (size_t slab = 0; slab < n + 4 && status == ICC_OK; ++slab) {
        if (slab < n)
            for_slab(s, slab, s->p, turn);
        if (slab >= 1 && slab - 1 < n)
            for_slab(s, slab - 1, s->p, advance_stretch);
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
    s->up = (upward){{0}, {0}};
    for (size_t slab = 0; slab < n + 3 && status == ICC_OK; ++slab) {
        iccp_multigrid_ascend(s->mg, slab);
        if (slab >= 3)
            for_slab(s, slab - 3, s->level->x, measure_stretch);
        status = report(s, slab, env);
    }
    return status;
}

static icc_status iterate(solver *s, double size, const iccp_mg_goal *goal, size_t *n_iterations,
                          const iccp_env *env)
{
    const double wanted = goal->relative * size;
    double least = HUGE_VAL, rz = 0;
    size_t since = 0;
    s->bound = goal->componentwise * 2 * s->level->dim;
    /* A pass with alpha = 0 measures what is there and begins the first V-cycle. */
    icc_status status = pass_down(s, env);
    while (status == ICC_OK) {
        const double rr = add_lanes(s->down.rr);
        if (sqrt(rr) <= wanted && max_lanes(s->down.excess) <= 0)
            break;
        since = rr < least ? 0 : since + 1;
        least = fmin(rr, least);
        if (!isfinite(rr) || since > PATIENCE)
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
