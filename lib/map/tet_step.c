/* Projected Newton with truncated conjugate gradients, preconditioned by the blocks of the points (J. Nocedal,
 * S. Wright, Numerical Optimization, section 7.1): factors of space fill up too much for a mesh as a
 * whole. */
#include "map/tet_newton.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* Added to the diagonal, relative to its mean: where negative curvature was left out the Hessian may be
 * singular. */
static const double SHIFT = 1e-10;

/* A pivot of a point's block that is smaller than this share of its diagonal is rounding. */
static const double SMALLEST_PIVOT = 1e-13;

/* Conjugate gradients end when the residual, in the preconditioner's norm, has fallen to this share. */
static const double RESIDUAL = 1e-2;
enum { MAX_DIRECTIONS = 200 };

/* ---- the system ---- */

/* Which of the two entries beside the diagonal, in row d of a block, is that of column c. */
static size_t beside(uint32_t d, uint32_t c)
{
    return c > d ? c - 1 : c;
}

static void add_element(iccp_tet_newton *s, size_t e, const iccp_tet_local *local)
{
    for (uint32_t a = 0; a < 4; ++a) {
        const uint32_t i = iccp_tet_slot(s, s->simplex[e], a);
        for (uint32_t d = 0; d < 3 && i != NONE; ++d) {
            s->gradient[3 * i + d] += local->gradient[3 * a + d];
            s->diagonal[3 * i + d] += local->hessian[3 * a + d][3 * a + d];
            for (uint32_t c = 0; c < 3; ++c)
                if (c != d)
                    s->value[s->first[3 * i + d] + beside(d, c)] +=
                        local->hessian[3 * a + d][3 * a + c];
        }
    }
    for (uint32_t p = 0; p < 12; ++p) {
        const uint32_t k = s->neighbour[12 * e + p];
        if (k == NONE)
            continue;
        uint32_t a, b;
        iccp_tet_pair(p, &a, &b);
        const uint32_t i = iccp_tet_slot(s, s->simplex[e], a);
        for (uint32_t d = 0; d < 3; ++d) {
            double *value = s->value + s->first[3 * i + d] + 2 + 3 * (size_t)k;
            for (uint32_t c = 0; c < 3; ++c)
                value[c] += local->hessian[3 * a + d][3 * b + c];
        }
    }
}

static void assemble(iccp_tet_newton *s, double epsilon)
{
    const size_t n = 3 * s->n_free;
    double sum = 0;
    memset(s->gradient, 0, n * sizeof *s->gradient);
    memset(s->diagonal, 0, n * sizeof *s->diagonal);
    memset(s->value, 0, s->first[n] * sizeof *s->value);
    for (size_t e = 0; e < s->n_elements; ++e) {
        const double *image[4];
        iccp_tet_local local;
        iccp_tet_images(s, e, image);
        iccp_tet_untangle_local(&s->element[e], image, epsilon, &local);
        add_element(s, e, &local);
    }
    for (size_t i = 0; i < n; ++i)
        sum += s->diagonal[i];
    for (size_t i = 0; i < n; ++i)
        s->diagonal[i] += SHIFT * sum / (double)n;
}

/* ---- conjugate gradients ---- */

/* L D L^T of each point's block: the three pivots and the three entries of L. */
static void factorise_blocks(const iccp_tet_newton *s, double *factor)
{
    for (size_t i = 0; i < s->n_free; ++i, factor += 6) {
        const double *d = s->diagonal + 3 * i;
        const double *x = s->value + s->first[3 * i], *y = s->value + s->first[3 * i + 1];
        factor[0] = d[0];
        factor[3] = x[0] / d[0];
        factor[4] = x[1] / d[0];
        factor[1] = fmax(d[1] - factor[3] * x[0], SMALLEST_PIVOT * d[1]);
        const double rest = y[1] - factor[4] * x[0];
        factor[5] = rest / factor[1];
        factor[2] = fmax(d[2] - factor[4] * x[1] - factor[5] * rest, SMALLEST_PIVOT * d[2]);
    }
}

static void precondition(size_t n_blocks, const double *factor, const double *r, double *z)
{
    for (size_t i = 0; i < n_blocks; ++i, factor += 6, r += 3, z += 3) {
        const double y1 = r[1] - factor[3] * r[0];
        const double y2 = r[2] - factor[4] * r[0] - factor[5] * y1;
        z[2] = y2 / factor[2];
        z[1] = y1 / factor[1] - factor[5] * z[2];
        z[0] = r[0] / factor[0] - factor[3] * z[1] - factor[4] * z[2];
    }
}

static double product(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

static void apply_hessian(const iccp_tet_newton *s, const double *x, double *y)
{
    for (size_t i = 0; i < 3 * s->n_free; ++i) {
        double sum = s->diagonal[i] * x[i];
        for (size_t k = s->first[i]; k < s->first[i + 1]; ++k)
            sum += s->value[k] * x[s->column[k]];
        y[i] = sum;
    }
}

/* Every iterate from 0 on is a direction of descent. */
static icc_status solve(iccp_tet_newton *s, const iccp_env *env)
{
    const size_t n = 3 * s->n_free;
    double *r = s->work, *z = r + n, *p = z + n, *q = p + n, *factor = q + n;
    factorise_blocks(s, factor);
    for (size_t i = 0; i < n; ++i) {
        s->step[i] = 0;
        r[i] = -s->gradient[i];
    }
    precondition(s->n_free, factor, r, z);
    memcpy(p, z, n * sizeof *p);
    double rho = product(n, r, z);
    const double enough = RESIDUAL * RESIDUAL * rho;
    for (int k = 0; k < MAX_DIRECTIONS && rho > enough; ++k) {
        if (iccp_progress(env, "repair", (double)k / MAX_DIRECTIONS) != ICC_OK)
            return ICC_ERR_CANCELLED;
        apply_hessian(s, p, q);
        const double curvature = product(n, p, q);
        if (!(curvature > 0))
            break;
        const double length = rho / curvature;
        for (size_t i = 0; i < n; ++i) {
            s->step[i] += length * p[i];
            r[i] -= length * q[i];
        }
        precondition(s->n_free, factor, r, z);
        const double next = product(n, r, z), share = next / rho;
        rho = next;
        for (size_t i = 0; i < n; ++i)
            p[i] = z[i] + share * p[i];
    }
    return ICC_OK;
}

icc_status iccp_tet_newton_solve(iccp_tet_newton *newton, double epsilon, double *slope,
                                 const iccp_env *env)
{
    assemble(newton, epsilon);
    const icc_status status = solve(newton, env);
    *slope = product(3 * newton->n_free, newton->gradient, newton->step);
    return status;
}
