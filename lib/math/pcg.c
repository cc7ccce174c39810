/* Preconditioned conjugate gradients. Source: Y. Saad, Iterative Methods for Sparse Linear Systems,
 * 2nd edition, 2003, sections 9.2 and 10.2. */
#include "math/pcg.h"

#include "base/budget.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* Relative residuals: the goal, and the largest that is accepted if rounding stops progress
 * earlier. */
static const double WANTED = 1e-13, ACCEPTED = 1e-9;

/* Stops after this many iterations without a new smallest residual. */
enum { PATIENCE = 200 };

static void multiply(const iccp_symmetric *m, const double *x, double *y)
{
    for (size_t i = 0; i < m->n; ++i) {
        double sum = m->diagonal[i] * x[i];
        for (size_t p = m->first[i]; p < m->first[i + 1]; ++p)
            sum += m->value[p] * x[m->column[p]];
        y[i] = sum;
    }
}

/* z = ((D + L) D^-1 (D + L^T))^-1 r */
static void sweep(const iccp_symmetric *m, const double *r, double *z)
{
    for (size_t i = 0; i < m->n; ++i) {
        double sum = r[i];
        for (size_t p = m->first[i]; p < m->first[i + 1]; ++p)
            if (m->column[p] < i)
                sum -= m->value[p] * z[m->column[p]];
        z[i] = sum / m->diagonal[i];
    }
    for (size_t i = m->n; i-- > 0;) {
        double sum = 0;
        for (size_t p = m->first[i]; p < m->first[i + 1]; ++p)
            if (m->column[p] > i)
                sum += m->value[p] * z[m->column[p]];
        z[i] -= sum / m->diagonal[i];
    }
}

typedef struct problem {
    const iccp_symmetric *matrix;
    iccp_pcg_part part;
    void *argument;
    const iccp_env *env;
} problem;

static icc_status precondition(const problem *s, const double *r, double *z)
{
    sweep(s->matrix, r, z);
    return s->part != NULL ? s->part(s->argument, r, z) : ICC_OK;
}

/* Solves for one right-hand side. r holds it and becomes the residual; x becomes the solution. */
static icc_status iterate(const problem *s, double *x, double *r, double *z, double *p, double *q)
{
    const iccp_symmetric *m = s->matrix;
    const size_t n = m->n;
    icc_status status;
    const double size = iccp_vec_norm(n, r);
    double least = size;
    memset(x, 0, n * sizeof *x);
    if (!(size > 0))
        return size >= 0 ? ICC_OK : ICC_ERR_SOLVER;
    status = precondition(s, r, z);
    memcpy(p, z, n * sizeof *p);
    double rz = iccp_vec_dot(n, r, z);
    for (size_t since = 0; least > WANTED * size && since < PATIENCE; ++since) {
        if (since % 16 == 0 && status == ICC_OK)
            status = iccp_progress(s->env, "solve", 0);
        if (status == ICC_OK)
            status = iccp_budget_work(s->env, (double)(n + m->first[n]));
        if (status != ICC_OK)
            return status;
        multiply(m, p, q);
        const double curvature = iccp_vec_dot(n, p, q);
        /* Otherwise the matrix is not positive definite, or the residual is only rounding noise. */
        if (!(curvature > 0 && rz > 0))
            break;
        const double step = rz / curvature;
        for (size_t i = 0; i < n; ++i) {
            x[i] += step * p[i];
            r[i] -= step * q[i];
        }
        const double residual = iccp_vec_norm(n, r);
        if (residual < least) {
            least = residual;
            since = 0;
        }
        status = precondition(s, r, z);
        const double next = iccp_vec_dot(n, r, z), beta = next / rz;
        rz = next;
        for (size_t i = 0; i < n; ++i)
            p[i] = z[i] + beta * p[i];
    }
    if (status != ICC_OK)
        return status;
    return least <= ACCEPTED * size ? ICC_OK : ICC_ERR_SOLVER;
}

icc_status iccp_pcg_solve(const iccp_symmetric *matrix, iccp_pcg_part part, void *argument,
                          double *b, double *work, const iccp_env *env)
{
    const size_t n = matrix->n;
    const problem s = {matrix, part, argument, env};
    double *x = work, *r = work + n, *z = work + 2 * n, *p = work + 3 * n, *q = work + 4 * n;
    memcpy(r, b, n * sizeof *r);
    const icc_status status = iterate(&s, x, r, z, p, q);
    if (status == ICC_OK)
        memcpy(b, x, n * sizeof *b);
    return status;
}
