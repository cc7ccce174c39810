/* Interpolates weights with kernels and an affine function. Based on: Sakaridis, Kernel Coordinates
 * (ETH Zurich 2016), sections 3.5 and 6.1. The affine function beside the kernels is ours.
 * Coefficients a of the kernels and t of the function solve
 *      K a + P t = w,  P' a = 0,    rows of P: (1, x),
 * so affine weights are reproduced exactly. Z = K^-1 P is computed once. Then t = (P' Z)^-1 Z' w
 * comes first. K a = w - P t has a small right-hand side where the weights are nearly affine, so
 * nothing cancels. Source: H. Wendland, Scattered Data Approximation, 2005, section 8.5. */
#include "kernel/weights/interpolant.h"

#include "base/compiler.h"
#include "base/error.h"
#include "base/minmax.h"
#include "base/simd.h"
#include "base/threads.h"

#include <math.h>
#include <string.h>

/* Cells are half the reach wide. Then half of the points in the cells that a ball touches are in
 * the ball. */
static const double CELLS_PER_REACH = 2;
/* Pivots below this share of the greatest are rounding errors. */
static const double LEAST_PIVOT = 1e-13;
/* If a pivot of P'Z is below this share of its diagonal, the nodes lie on a line or in a plane. */
static const double LEAST_SCHUR = 1e-13;
/* Most right-hand sides per task. The factor is read once for all of them. */
enum { SIDES = 32, MOST_TAIL = 4 };

struct iccp_collocation {
    iccp_memory memory;
    size_t dim, n, n_tail; /* n_tail is dim + 1, or 0 */
    iccp_radial radial;
    double *points;
    double *sorted; /* `points` in the order of the cells */
    iccp_cells cells;
    iccp_kernel_matrix kernel;
    iccp_ldlt factor;
    double definiteness;
    double *z;                           /* n rows of n_tail */
    double schur[MOST_TAIL * MOST_TAIL]; /* lower triangle of the Cholesky factor of P'Z */
};

/* ---- the affine function ---- */

static double tail_entry(const iccp_collocation *c, size_t i, size_t k)
{
    return k == 0 ? 1 : c->points[c->dim * i + k - 1];
}

/* Computes Cholesky's factorisation of P'Z, (dim + 1) by (dim + 1), in place. Returns false if a
 * pivot is only rounding: the columns of P are then dependent at the nodes. */
static bool factorise_schur(iccp_collocation *c)
{
    const size_t q = c->n_tail;
    double *s = c->schur;
    for (size_t k = 0; k < q; ++k)
        for (size_t l = 0; l <= k; ++l) {
            double sum = 0;
            for (size_t i = 0; i < c->n; ++i)
                sum += tail_entry(c, i, k) * c->z[q * i + l];
            s[q * k + l] = sum;
        }
    for (size_t k = 0; k < q; ++k) {
        const double whole = s[q * k + k];
        for (size_t l = 0; l <= k; ++l) {
            for (size_t j = 0; j < l; ++j)
                s[q * k + l] -= s[q * k + j] * s[q * l + j];
            if (l < k)
                s[q * k + l] /= s[q * l + l];
        }
        if (!(s[q * k + k] > LEAST_SCHUR * whole))
            return false;
        s[q * k + k] = sqrt(s[q * k + k]);
    }
    return true;
}

/* Replaces x, q numbers, by (P'Z)^-1 x. */
static void solve_schur(const iccp_collocation *c, double *x)
{
    const size_t q = c->n_tail;
    for (size_t k = 0; k < q; ++k) {
        for (size_t l = 0; l < k; ++l)
            x[k] -= c->schur[q * k + l] * x[l];
        x[k] /= c->schur[q * k + k];
    }
    for (size_t k = q; k-- > 0;) {
        for (size_t l = k + 1; l < q; ++l)
            x[k] -= c->schur[q * l + k] * x[l];
        x[k] /= c->schur[q * k + k];
    }
}

/* Computes Z = K^-1 P and the factor of P'Z, once for all weights on these nodes. */
static icc_status prepare_tail(iccp_collocation *c, const iccp_env *env, icc_error *err)
{
    const size_t q = c->n_tail = c->dim + 1;
    c->z = iccp_alloc(&c->memory, c->n, q * sizeof *c->z);
    double *work = iccp_alloc(&env->memory, c->n, q * sizeof *work);
    icc_status status = c->z != NULL && work != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (size_t i = 0; i < c->n; ++i)
            for (size_t k = 0; k < q; ++k)
                c->z[q * i + k] = tail_entry(c, i, k);
        iccp_ldlt_solve(&c->factor, q, c->z, work);
        if (!factorise_schur(c))
            status =
                iccp_fail(err, ICC_ERR_SOLVER,
                          "the nodes determine no affine function: they lie in a plane or line");
    }
    iccp_free(&env->memory, work);
    return status;
}

/* ---- creation ---- */

/* Keeps the ratio of the least pivot to the greatest as a measure of definiteness. Wendland's
 * function is positive definite at any width, so a failure means lack of precision. */
static icc_status factorise(iccp_collocation *c, const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_ldlt_analyse(&c->factor, &c->kernel.matrix, 1, env);
    if (status == ICC_OK)
        status = iccp_ldlt_factorise(&c->factor, &c->kernel.matrix, env);
    double least = HUGE_VAL, greatest = 0;
    for (size_t k = 0; status == ICC_OK && k < c->n; ++k) {
        least = iccp_min(least, c->factor.pivot[k]);
        greatest = iccp_max(greatest, c->factor.pivot[k]);
    }
    c->definiteness = least / greatest;
    if (status == ICC_ERR_SOLVER || (status == ICC_OK && !(c->definiteness > LEAST_PIVOT)))
        return iccp_fail(err, ICC_ERR_SOLVER,
                         "sigma is too large: the matrix of the kernel is not positive definite%s",
                         c->radial.kind == ICC_KERNEL_GAUSS ? " (Wendland's would be)"
                                                            : " to working precision");
    return status;
}

static icc_status create(iccp_collocation *c, const double *points, const iccp_env *env,
                         icc_error *err)
{
    const size_t row = c->dim * sizeof *points;
    c->points = iccp_alloc(&c->memory, c->n, row);
    c->sorted = iccp_alloc(&c->memory, c->n, row);
    if (c->points == NULL || c->sorted == NULL)
        return ICC_ERR_MEMORY;
    memcpy(c->points, points, c->n * row);
    icc_status status = iccp_cells_create(&c->cells, c->dim, c->n, c->points,
                                          c->radial.reach / CELLS_PER_REACH, env);
    if (status != ICC_OK)
        return status;
    for (size_t p = 0; p < c->n; ++p)
        memcpy(c->sorted + c->dim * p, c->points + c->dim * c->cells.order[p], row);
    status = iccp_kernel_matrix_create(&c->kernel, &c->cells, &c->radial, env, err);
    return status == ICC_OK ? factorise(c, env, err) : status;
}

icc_status iccp_collocation_create(iccp_collocation **out, size_t dim, size_t n,
                                   const double *points, const iccp_radial *radial, bool tail,
                                   const iccp_env *env, icc_error *err)
{
    iccp_collocation *c = iccp_alloc_zero(&env->memory, 1, sizeof *c);
    *out = NULL;
    if (c == NULL)
        return ICC_ERR_MEMORY;
    c->memory = c->cells.memory = c->kernel.memory = c->factor.memory = env->memory;
    c->dim = dim;
    c->n = n;
    c->radial = *radial;
    icc_status status = create(c, points, env, err);
    if (status == ICC_OK && tail)
        status = prepare_tail(c, env, err);
    if (status == ICC_OK)
        *out = c;
    else
        iccp_collocation_free(c);
    return status;
}

void iccp_collocation_free(iccp_collocation *collocation)
{
    iccp_collocation *c = collocation;
    if (c == NULL)
        return;
    iccp_cells_free(&c->cells);
    iccp_kernel_matrix_free(&c->kernel);
    iccp_ldlt_free(&c->factor);
    iccp_free(&c->memory, c->points);
    iccp_free(&c->memory, c->sorted);
    iccp_free(&c->memory, c->z);
    const iccp_memory memory = c->memory;
    iccp_free(&memory, c);
}

size_t iccp_collocation_entries(const iccp_collocation *collocation)
{
    return collocation->n + collocation->kernel.first[collocation->n] / 2;
}

const iccp_symmetric *iccp_collocation_matrix(const iccp_collocation *collocation)
{
    return &collocation->kernel.matrix;
}

const iccp_radial *iccp_collocation_radial(const iccp_collocation *collocation)
{
    return &collocation->radial;
}

double iccp_collocation_definiteness(const iccp_collocation *collocation)
{
    return collocation->definiteness;
}

/* ---- coefficients ---- */

typedef struct solution {
    const iccp_collocation *c;
    const iccp_memory *memory;
    size_t m;
    const double *values;
    double *coefficients;
    size_t n_sides;
    size_t *sides; /* columns to solve for */
} solution;

/* Computes t of `n_sides` columns, and subtracts the affine function from b. */
static void split_affine(const iccp_collocation *c, size_t n_sides, double *b, double *tail)
{
    const size_t q = c->n_tail;
    double t[SIDES][MOST_TAIL] = {{0}};
    for (size_t i = 0; i < c->n; ++i)
        for (size_t r = 0; r < n_sides; ++r)
            for (size_t k = 0; k < q; ++k)
                t[r][k] += c->z[q * i + k] * b[n_sides * i + r];
    for (size_t r = 0; r < n_sides; ++r)
        solve_schur(c, t[r]);
    for (size_t i = 0; i < c->n; ++i)
        for (size_t r = 0; r < n_sides; ++r)
            for (size_t k = 0; k < q; ++k)
                b[n_sides * i + r] -= tail_entry(c, i, k) * t[r][k];
    for (size_t r = 0; r < n_sides; ++r)
        for (size_t k = 0; k < q; ++k)
            tail[n_sides * k + r] = t[r][k];
}

/* Solves for the columns sides[begin] up to sides[end], n values each. They are first gathered into
 * rows of `width`, so that the factor is read once for all of them. */
static icc_status solve_sides(void *argument, size_t begin, size_t end)
{
    const solution *s = argument;
    const iccp_collocation *c = s->c;
    const size_t width = end - begin, n_rows = c->n + c->dim + 1;
    const size_t *sides = s->sides + begin;
    double *b = iccp_alloc_zero(s->memory, n_rows, width * sizeof *b);
    double *work = iccp_alloc(s->memory, c->n, width * sizeof *work);
    const icc_status status = b != NULL && work != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (size_t i = 0; i < c->n; ++i)
            for (size_t r = 0; r < width; ++r)
                b[width * i + r] = s->values[s->m * i + sides[r]];
        if (c->n_tail > 0)
            split_affine(c, width, b, b + width * c->n);
        iccp_ldlt_solve(&c->factor, width, b, work);
        for (size_t i = 0; i < n_rows; ++i)
            for (size_t r = 0; r < width; ++r)
                s->coefficients[s->m * i + sides[r]] = b[width * i + r];
    }
    iccp_free(s->memory, b);
    iccp_free(s->memory, work);
    return status;
}

icc_status iccp_collocation_solve_some(const iccp_collocation *collocation, size_t m,
                                       const double *values, const bool *which,
                                       double *coefficients, const iccp_env *env)
{
    solution s = {collocation, &env->memory, m, values, coefficients, 0, NULL};
    s.sides = iccp_alloc(&env->memory, m, sizeof *s.sides);
    if (s.sides == NULL)
        return ICC_ERR_MEMORY;
    for (size_t j = 0; j < m; ++j)
        if (which == NULL || which[j])
            s.sides[s.n_sides++] = j;
    const size_t share = s.n_sides / (size_t)env->threads + 1;
    const icc_status status =
        iccp_for_chunks(env, "weights", s.n_sides, share < SIDES ? share : SIDES, solve_sides, &s);
    iccp_free(&env->memory, s.sides);
    return status;
}

icc_status iccp_collocation_solve(const iccp_collocation *collocation, size_t m,
                                  const double *values, double *coefficients, const iccp_env *env)
{
    return iccp_collocation_solve_some(collocation, m, values, NULL, coefficients, env);
}

/* ---- values ---- */

enum { MOST_NEAR = 256, FOUR = 4 };

/* Several numbers side by side, not aligned. */
#ifdef __GNUC__
typedef double four __attribute__((vector_size(8 * FOUR), aligned(8), may_alias));
#endif

typedef struct query {
    const iccp_collocation *c;
    size_t m;
    const double *coefficients, *point;
    double *values, *gradients;
} query;

/* Nodes nearer than the reach, in a fixed order. First they are found, then their kernels' values
 * are computed, then each sum, in registers. */
typedef struct near {
    size_t n;
    uint32_t place[MOST_NEAR]; /* places in the order of the cells */
    double distance2[MOST_NEAR];
} near;

static void add_tail(const query *q)
{
    const size_t dim = q->c->dim, m = q->m;
    const double *t = q->coefficients + m * q->c->n;
    for (size_t j = 0; j < m; ++j) {
        q->values[j] = t[j];
        for (size_t k = 0; k < dim; ++k)
            q->values[j] += t[m * (k + 1) + j] * q->point[k];
        for (size_t k = 0; q->gradients != NULL && k < dim; ++k)
            q->gradients[dim * j + k] = t[m * (k + 1) + j];
    }
}

/* The nodes' rows of coefficients, and the factors of these. */
typedef struct terms {
    size_t n;
    const double *row[MOST_NEAR];
    double factor[MOST_NEAR];
} terms;

/* Adds the rows times their factors, row by row, to m numbers: every stride-th from `sums` on. */
static ICCP_INLINE void add_rows(const terms *t, size_t m, double *sums, size_t stride)
{
    size_t j = 0;
#ifdef __GNUC__
    for (; j + FOUR <= m; j += FOUR) {
        four sum;
        for (size_t l = 0; l < FOUR; ++l)
            sum[l] = sums[stride * (j + l)];
        for (size_t i = 0; i < t->n; ++i)
            sum += t->factor[i] * *(const four *)(t->row[i] + j);
        for (size_t l = 0; l < FOUR; ++l)
            sums[stride * (j + l)] = sum[l];
    }
#endif
    for (; j < m; ++j)
        for (size_t i = 0; i < t->n; ++i)
            sums[stride * j] += t->factor[i] * t->row[i][j];
}

/* Computes twice the slopes of the kernel. `kind` is a constant, so the loop has no branches. */
static ICCP_INLINE void fill_slopes(iccp_radial radial, int32_t kind, const near *h, double *slope)
{
    radial.kind = kind;
    for (size_t i = 0; i < h->n; ++i)
        slope[i] = 2 * iccp_radial_slope(&radial, h->distance2[i]);
}

/* Adds the kernels of the nodes that were found, and empties the list. */
static ICCP_INLINE void add_near(const query *q, near *h)
{
    const iccp_collocation *c = q->c;
    const iccp_radial radial = c->radial;
    double slope[MOST_NEAR];
    terms t;
    t.n = h->n;
    for (size_t i = 0; i < h->n; ++i)
        t.row[i] = q->coefficients + q->m * c->cells.order[h->place[i]];
    for (size_t i = 0; i < h->n; ++i)
        t.factor[i] = iccp_radial_value(&radial, h->distance2[i]);
    add_rows(&t, q->m, q->values, 1);
    if (q->gradients != NULL && radial.kind == ICC_KERNEL_GAUSS)
        fill_slopes(radial, ICC_KERNEL_GAUSS, h, slope);
    else if (q->gradients != NULL)
        fill_slopes(radial, ICC_KERNEL_WENDLAND, h, slope);
    for (size_t k = 0; q->gradients != NULL && k < c->dim; ++k) {
        for (size_t i = 0; i < h->n; ++i)
            t.factor[i] = slope[i] * (q->point[k] - c->sorted[c->dim * h->place[i] + k]);
        add_rows(&t, q->m, q->gradients + k, c->dim);
    }
    h->n = 0;
}

/* Finds the near nodes of a run. Which ones are near is unpredictable, so nothing branches on
 * it. */
static ICCP_INLINE void find_near(const query *q, size_t begin, size_t end, size_t dim, near *h)
{
    const double *points = q->c->sorted;
    const double reach2 = q->c->radial.reach * q->c->radial.reach;
    double at[3];
    size_t n = h->n;
    for (size_t k = 0; k < dim; ++k)
        at[k] = q->point[k];
    for (size_t p = begin; p < end; ++p) {
        double distance2 = 0;
        for (size_t k = 0; k < dim; ++k)
            distance2 += (at[k] - points[dim * p + k]) * (at[k] - points[dim * p + k]);
        h->distance2[n] = distance2;
        h->place[n] = (uint32_t)p;
        n += distance2 < reach2;
    }
    h->n = n;
}

/* Finds and adds the nodes of a run of any length. */
static ICCP_INLINE void add_run(const query *q, size_t begin, size_t end, near *h)
{
    while (begin < end) {
        if (h->n == MOST_NEAR)
            add_near(q, h);
        const size_t room = MOST_NEAR - h->n, stop = end - begin < room ? end : begin + room;
        if (q->c->dim == 2)
            find_near(q, begin, stop, 2, h);
        else
            find_near(q, begin, stop, q->c->dim, h);
        begin = stop;
    }
}

static ICCP_INLINE void add_kernels(const query *q, const iccp_cell_box *box)
{
    const iccp_cells *cells = &q->c->cells;
    near h;
    h.n = 0;
    for (size_t z = box->from[2]; z <= box->to[2]; ++z)
        for (size_t y = box->from[1]; y <= box->to[1]; ++y) {
            const uint32_t *run = cells->first + cells->shape[0] * (y + cells->shape[1] * z);
            add_run(q, run[box->from[0]], run[box->to[0] + 1], &h);
        }
    add_near(q, &h);
}

static void add_kernels_portable(const query *q, const iccp_cell_box *box)
{
    add_kernels(q, box);
}

#ifdef ICCP_HAS_SIMD

/* Gives the same bits: lanes are handles or nodes, and no products are fused with sums. */
ICCP_AVX2 static void add_kernels_avx2(const query *q, const iccp_cell_box *box)
{
    add_kernels(q, box);
}

#else

#define add_kernels_avx2 add_kernels_portable

#endif

void iccp_collocation_evaluate_as(iccp_simd_level level, const iccp_collocation *collocation,
                                  size_t m, const double *coefficients, const double *point,
                                  double *values, double *gradients)
{
    const query q = {collocation, m, coefficients, point, values, gradients};
    iccp_cell_box box;
    add_tail(&q);
    if (!iccp_cells_box(&collocation->cells, point, collocation->radial.reach, &box))
        return;
    (level >= ICCP_SIMD_AVX2 ? add_kernels_avx2 : add_kernels_portable)(&q, &box);
}

void iccp_collocation_evaluate(const iccp_collocation *collocation, size_t m,
                               const double *coefficients, const double *point, double *values,
                               double *gradients)
{
    iccp_collocation_evaluate_as(iccp_simd(), collocation, m, coefficients, point, values,
                                 gradients);
}

/* ---- for programs with many weights at once ---- */

size_t iccp_collocation_dim(const iccp_collocation *collocation)
{
    return collocation->dim;
}

const double *iccp_collocation_affine(const iccp_collocation *collocation)
{
    return collocation->z;
}

void iccp_collocation_solve_affine(const iccp_collocation *collocation, double *x)
{
    solve_schur(collocation, x);
}

size_t iccp_collocation_marks(const iccp_collocation *collocation)
{
    return collocation->factor.nodes.n;
}

void iccp_collocation_mark(const iccp_collocation *collocation, size_t n, const uint32_t *nodes,
                           uint8_t *needed)
{
    iccp_ldlt_mark(&collocation->factor, n, nodes, needed);
}

size_t iccp_collocation_marked(const iccp_collocation *collocation, const uint8_t *needed,
                               uint32_t *nodes)
{
    return iccp_ldlt_marked(&collocation->factor, needed, nodes);
}

void iccp_collocation_invert(const iccp_collocation *collocation, const uint8_t *needed, size_t m,
                             double *b, double *work)
{
    iccp_ldlt_solve_marked(&collocation->factor, needed, m, b, work);
}
