/* The equations of weights at a point, and their optimisation. Based on: Sakaridis, Kernel
 * Coordinates (ETH Zurich 2016), sections 4.1, 4.2 and 4.4.
 *
 * Weights w of a point x reproduce it and sum to 1 if A w = (1, x), where the columns of A are the
 * handles. The rows of A are replaced by orthonormal rows Q with the same span: A = L Q. So the
 * equations are Q w = L^-1 (1, x). The nearest w that satisfies them, (4.4) to (4.6), is
 *      w0 + Q'(L^-1 (1, x) - Q w0).
 *
 * The numbers in the iterative methods have size 1, wherever the handles are. */
#include "base/compiler.h"
#include "base/error.h"
#include "base/minmax.h"
#include "kernel/biharmonic/biharmonic.h"
#include "kernel/weights/l1.h"
#include "kernel/weights/weights.h"

#include <assert.h>
#include <math.h>

/* Thickness over extent below which handles count as lying in a plane. Weights beside the plane
 * would have a larger error than this. */
static const double THINNEST = 1e-8;
/* Cost of negative values where weights must be negative: 1 / SLOPE times that of positive ones.
 * The smaller it is, the less weights jump at the hull: by 2e-4 on the star, and by 2e-2 with 1e-3.
 * With 1e-6, Newton's method fails at times. */
static const double SLOPE = 1e-5;
/* An equation's row follows from the other rows if less than this share of its squared length
 * remains without them. */
static const double FLAT = 1e-12;

struct iccp_handles {
    iccp_memory memory;
    size_t dim, m;
    double centre[3];
    /* L; rows are 1 and the coordinates relative to the centre */
    double lower[ICCP_ROWS][ICCP_ROWS];
    double *columns;           /* columns of Q, ICCP_ROWS each; rows beyond dim are 0 */
    uint32_t start[ICCP_ROWS]; /* independent columns */
};

/* Returns entry (row, handle j) of A, relative to the centre. */
static double entry(const iccp_handles *h, const double *points, size_t row, size_t j)
{
    return row == 0 ? 1 : points[h->dim * j + row - 1] - h->centre[row - 1];
}

/* Subtracts the components along the previous rows from row r of Q. */
static void make_orthogonal(iccp_handles *h, size_t r)
{
    for (size_t k = 0; k < r; ++k) {
        double along = 0;
        for (size_t j = 0; j < h->m; ++j)
            along += h->columns[ICCP_ROWS * j + r] * h->columns[ICCP_ROWS * j + k];
        for (size_t j = 0; j < h->m; ++j)
            h->columns[ICCP_ROWS * j + r] -= along * h->columns[ICCP_ROWS * j + k];
        h->lower[r][k] += along;
    }
}

static double row_length(const iccp_handles *h, size_t r)
{
    double sum = 0;
    for (size_t j = 0; j < h->m; ++j)
        sum += h->columns[ICCP_ROWS * j + r] * h->columns[ICCP_ROWS * j + r];
    return sqrt(sum);
}

/* Applies Gram and Schmidt's method twice, which makes rows orthogonal to the last digit. Returns
 * false if the handles lie in a plane. */
static bool make_rows(iccp_handles *h, const double *points)
{
    double longest = 0;
    for (size_t r = 0; r <= h->dim; ++r) {
        for (size_t j = 0; j < h->m; ++j)
            h->columns[ICCP_ROWS * j + r] = entry(h, points, r, j);
        if (r > 0)
            longest = iccp_max(longest, row_length(h, r));
        make_orthogonal(h, r);
        make_orthogonal(h, r);
        h->lower[r][r] = row_length(h, r);
        for (size_t j = 0; j < h->m && h->lower[r][r] > 0; ++j)
            h->columns[ICCP_ROWS * j + r] /= h->lower[r][r];
    }
    for (size_t r = 1; r <= h->dim; ++r)
        if (!(h->lower[r][r] > THINNEST * longest))
            return false;
    return true;
}

/* Chooses columns that span a large simplex. Each has the largest component that the previous ones
 * leave. */
static void choose_start(iccp_handles *h)
{
    double basis[ICCP_ROWS][ICCP_ROWS] = {{0}};
    for (size_t k = 0; k <= h->dim; ++k) {
        double most = -1;
        for (size_t j = 0; j < h->m; ++j) {
            double rest[ICCP_ROWS], size = 0;
            for (size_t r = 0; r < ICCP_ROWS; ++r)
                rest[r] = h->columns[ICCP_ROWS * j + r];
            for (size_t b = 0; b < k; ++b) {
                double along = 0;
                for (size_t r = 0; r < ICCP_ROWS; ++r)
                    along += rest[r] * basis[b][r];
                for (size_t r = 0; r < ICCP_ROWS; ++r)
                    rest[r] -= along * basis[b][r];
            }
            for (size_t r = 0; r < ICCP_ROWS; ++r)
                size += rest[r] * rest[r];
            if (size <= most)
                continue;
            most = size;
            h->start[k] = (uint32_t)j;
            for (size_t r = 0; r < ICCP_ROWS; ++r)
                basis[k][r] = rest[r] / sqrt(size);
        }
    }
}

icc_status iccp_handles_create(iccp_handles **out, size_t dim, size_t m, const double *points,
                               const iccp_env *env, icc_error *err)
{
    assert((dim == 2 || dim == 3) && m > dim);
    *out = NULL;
    iccp_handles *h = iccp_alloc_zero(&env->memory, 1, sizeof *h);
    if (h == NULL)
        return iccp_fail_memory(err);
    *h = (iccp_handles){.memory = env->memory, .dim = dim, .m = m};
    h->columns = iccp_alloc_zero(&h->memory, ICCP_ROWS * m, sizeof *h->columns);
    if (h->columns == NULL) {
        iccp_handles_free(h);
        return iccp_fail_memory(err);
    }
    for (size_t k = 0; k < dim; ++k) {
        for (size_t j = 0; j < m; ++j)
            h->centre[k] += points[dim * j + k];
        h->centre[k] /= (double)m;
    }
    if (!make_rows(h, points)) {
        iccp_handles_free(h);
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "all handles lie %s: their weights cannot reproduce points beside it",
                         dim == 2 ? "on a line" : "in a plane");
    }
    choose_start(h);
    *out = h;
    return ICC_OK;
}

void iccp_handles_free(iccp_handles *handles)
{
    if (handles == NULL)
        return;
    const iccp_memory memory = handles->memory;
    iccp_free(&memory, handles->columns);
    iccp_free(&memory, handles);
}

/* target -= Q weights */
static ICCP_INLINE void subtract_rows(const iccp_handles *h, const double *weights, double *target)
{
    for (size_t j = 0; j < h->m; ++j)
        for (size_t r = 0; r < ICCP_ROWS; ++r)
            target[r] -= weights[j] * h->columns[ICCP_ROWS * j + r];
}

/* weights += Q' target */
static ICCP_INLINE void add_rows(const iccp_handles *h, const double *target, double *weights)
{
    for (size_t j = 0; j < h->m; ++j) {
        const double *c = h->columns + ICCP_ROWS * j;
        weights[j] += (c[0] * target[0] + c[1] * target[1]) + (c[2] * target[2] + c[3] * target[3]);
    }
}

/* Replaces weights by the nearest ones whose combination is the target. */
static ICCP_INLINE void meet(const iccp_handles *h, const double *target, double *weights)
{
    double missing[ICCP_ROWS];
    for (size_t r = 0; r < ICCP_ROWS; ++r)
        missing[r] = target[r];
    subtract_rows(h, weights, missing);
    add_rows(h, missing, weights);
}

/* Replaces b by y with C y = b, for a C that is not negative. Where C is 0, y is 0. */
static void solve_small(double c[ICCP_ROWS][ICCP_ROWS], double *y)
{
    for (size_t k = 0; k < ICCP_ROWS; ++k)
        for (size_t r = k + 1; c[k][k] > FLAT && r < ICCP_ROWS; ++r) {
            const double factor = c[r][k] / c[k][k];
            for (size_t j = k; j < ICCP_ROWS; ++j)
                c[r][j] -= factor * c[k][j];
            y[r] -= factor * y[k];
        }
    for (size_t k = ICCP_ROWS; k-- > 0;) {
        for (size_t j = k + 1; j < ICCP_ROWS; ++j)
            y[k] -= c[k][j] * y[j];
        y[k] = c[k][k] > FLAT ? y[k] / c[k][k] : 0;
    }
}

void iccp_handles_project(const iccp_handles *handles, const double *bounded, double *change)
{
    double gram[ICCP_ROWS][ICCP_ROWS] = {{0}}, y[ICCP_ROWS] = {0};
    for (size_t j = 0; j < handles->m; ++j) {
        const double *c = handles->columns + ICCP_ROWS * j;
        if (bounded != NULL && bounded[j] <= 0)
            change[j] = 0;
        else
            for (size_t r = 0; r < ICCP_ROWS; ++r)
                for (size_t k = 0; k < ICCP_ROWS; ++k)
                    gram[r][k] += c[r] * c[k];
    }
    subtract_rows(handles, change, y);
    solve_small(gram, y);
    for (size_t j = 0; j < handles->m; ++j)
        for (size_t r = 0; r < ICCP_ROWS && !(bounded != NULL && bounded[j] <= 0); ++r)
            change[j] += y[r] * handles->columns[ICCP_ROWS * j + r];
}

size_t iccp_optimise_work(const iccp_handles *handles)
{
    return handles->m + iccp_l1_work(handles->m);
}

static void minimise_l1(const iccp_handles *h, const double *target, double *weights, double *work)
{
    iccp_l1 problem = {.rows = h->dim + 1, .m = h->m, .columns = h->columns, .start = h->start};
    for (size_t r = 0; r < ICCP_ROWS; ++r)
        problem.target[r] = target[r];
    subtract_rows(h, weights, problem.target);
    problem.total = problem.target[0] * h->lower[0][0];
    iccp_l1_solve(&problem, work, work + h->m);
    for (size_t j = 0; j < h->m; ++j)
        weights[j] += work[j];
}

static double least(size_t m, const double *x)
{
    double value = x[0];
    for (size_t j = 1; j < m; ++j)
        value = x[j] < value ? x[j] : value;
    return value;
}

static double greatest(size_t m, const double *x)
{
    double value = fabs(x[0]);
    for (size_t j = 1; j < m; ++j)
        value = fabs(x[j]) > value ? fabs(x[j]) : value;
    return value;
}

/* Computes L^-1 (1, x) for a constant number of rows. */
static ICCP_INLINE void solve_lower(const iccp_handles *h, size_t rows, const double *point,
                                    double *target)
{
    for (size_t r = 0; r < ICCP_ROWS; ++r)
        target[r] = r == 0 ? 1 : r < rows ? point[r - 1] - h->centre[r - 1] : 0;
    for (size_t k = 0; k < rows; ++k) {
        target[k] /= h->lower[k][k];
        for (size_t r = k + 1; r < rows; ++r)
            target[r] -= h->lower[r][k] * target[k];
    }
}

icc_status iccp_optimise(const iccp_handles *handles, int32_t method, const double *point,
                         double *weights, double *work)
{
    if (method == ICC_WEIGHTS_BIHARMONIC)
        return iccp_share_out(handles->m, weights);
    iccp_nonneg problem = {
        .m = handles->m, .rows = handles->dim + 1, .columns = handles->columns, .total = 1};
    if (handles->dim == 2)
        solve_lower(handles, 3, point, problem.target);
    else
        solve_lower(handles, 4, point, problem.target);
    if (method == ICC_WEIGHTS_L1) {
        minimise_l1(handles, problem.target, weights, work);
        return ICC_OK;
    }
    const bool again = method == ICC_WEIGHTS_EQUALITY || greatest(handles->m, weights) > 1;
    meet(handles, problem.target, weights);
    /* Large weights leave rounding errors of their size, and many weights leave their sum. The
     * repetition removes these, too. */
    if (again)
        meet(handles, problem.target, weights);
    if (method == ICC_WEIGHTS_EQUALITY || least(handles->m, weights) >= 0 ||
        iccp_nonneg_solve(&problem, weights, work))
        return ICC_OK;
    (void)iccp_nonneg_relax(&problem, SLOPE, weights);
    meet(handles, problem.target, weights);
    return ICC_ERR_SOLVER;
}
