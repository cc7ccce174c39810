/* Least squares by the normal equations of centred points: two by two, so they are solved directly.
 */
#include "control/affine_fit.h"

#include <math.h>

/* Below this share of the largest possible determinant, points count as on a line. Rounding of the
 * sums is 1e-16 of it for each point. */
static const double FLAT = 1e-12;

/* Sums over centred points: of from * from', and of to * from'. */
typedef struct moments {
    double from_mean[2], to_mean[2];
    double from_from[2][2], to_from[2][2], to_to;
} moments;

static moments moments_of(const control_points *c)
{
    moments m = {.to_to = 0};
    for (size_t i = 0; i < c->n; i++)
        for (size_t k = 0; k < 2; k++) {
            m.from_mean[k] += c->from[2 * i + k] / (double)c->n;
            m.to_mean[k] += c->to[2 * i + k] / (double)c->n;
        }
    for (size_t i = 0; i < c->n; i++)
        for (size_t k = 0; k < 2; k++) {
            double to = c->to[2 * i + k] - m.to_mean[k];
            double from = c->from[2 * i + k] - m.from_mean[k];
            m.to_to += to * to;
            for (size_t h = 0; h < 2; h++) {
                double other = c->from[2 * i + h] - m.from_mean[h];
                m.from_from[k][h] += from * other;
                m.to_from[k][h] += to * other;
            }
        }
    return m;
}

static double determinant(double a[2][2])
{
    return a[0][0] * a[1][1] - a[0][1] * a[1][0];
}

static bool is_flat(moments *m)
{
    double trace = m->from_from[0][0] + m->from_from[1][1];
    return !(determinant(m->from_from) > FLAT * trace * trace);
}

bool affine_mirrors(const control_points *c)
{
    moments m = moments_of(c);
    double trace = m.from_from[0][0] + m.from_from[1][1], turn = determinant(m.to_from);
    bool is_clear = !is_flat(&m) && fabs(turn) > FLAT * trace * m.to_to;
    return is_clear ? turn < 0 : c->rows_down;
}

/* The linear part: to_from times the inverse of from_from. */
static void solve_affine(moments *m, double a[2][2])
{
    double(*f)[2] = m->from_from, (*t)[2] = m->to_from;
    double d = determinant(f);
    for (size_t k = 0; k < 2; k++) {
        a[k][0] = (t[k][0] * f[1][1] - t[k][1] * f[1][0]) / d;
        a[k][1] = (t[k][1] * f[0][0] - t[k][0] * f[0][1]) / d;
    }
}

/* The linear part [p -q; q p], or its mirror image. */
static void solve_similarity(const moments *m, bool mirrored, double a[2][2])
{
    double trace = m->from_from[0][0] + m->from_from[1][1], s = mirrored ? -1 : 1;
    double p = trace > 0 ? (m->to_from[0][0] + s * m->to_from[1][1]) / trace : s;
    double q = trace > 0 ? (m->to_from[1][0] - s * m->to_from[0][1]) / trace : 0;
    a[0][0] = p;
    a[1][0] = q;
    a[0][1] = -s * q;
    a[1][1] = s * p;
}

void affine_residuals(const control_points *c, double *residuals)
{
    moments m = moments_of(c);
    double a[2][2];
    if (is_flat(&m))
        solve_similarity(&m, affine_mirrors(c), a);
    else
        solve_affine(&m, a);
    for (size_t i = 0; i < c->n; i++)
        for (size_t k = 0; k < 2; k++)
            residuals[2 * i + k] = a[k][0] * (c->from[2 * i] - m.from_mean[0]) +
                                   a[k][1] * (c->from[2 * i + 1] - m.from_mean[1]) + m.to_mean[k] -
                                   c->to[2 * i + k];
}
