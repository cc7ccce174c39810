/* Computes the untangling energy of one simplex and its derivatives: V. Garanzha, I. Kaporin,
 * L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, Foldover-free maps in 50 lines of code, 2021.
 *
 * The energy is (1 - s) |J|^2 / (dim chi^(2 / dim)) + s (1 + det^2) / (2 chi), where chi stands for
 * the determinant of J. It is taken as a function A(N, D) of N = |J|^2 and D = det J.
 *
 * In the plane J is the sum of a rotation scaled by p / sqrt 2 and a reflection scaled by q / sqrt
 * 2. Then N = p^2 + q^2 and D = (p^2 - q^2) / 2. So the Hessian splits into three blocks: turning
 * the rotation, turning the reflection, and both scales.
 *
 * In space its eigenvectors are those of B. Smith, F. de Goes, T. Kim, Analytic eigensystems for
 * isotropic distortion energies, 2019. They are a flip and a twist for each pair of singular
 * vectors, and three vectors in the space of the singular values. */
#include "map/energy/untangling.h"

#include "base/minmax.h"
#include "map/energy/modes.h"
#include "math/elementary.h"
#include "math/jacobi.h"

#include <string.h>

const double iccp_untangling_share = 1.0 / 128;

double iccp_untangling_chi(double epsilon, double det)
{
    const double root = sqrt(epsilon * epsilon + det * det);
    /* The second form does not cancel for negative determinants. */
    return det >= 0 ? 0.5 * (det + root) : 0.5 * epsilon * epsilon / (root - det);
}

double iccp_untangling_start(double least)
{
    return least > 0 ? 1e-10 : sqrt(1e-12 + 0.04 * least * least);
}

double iccp_untangling_next(double epsilon, double least, double fall)
{
    const double mu = (1 - fall) * iccp_untangling_chi(epsilon, least);
    return least < mu ? 2 * sqrt(mu * (mu - least)) : 1e-10;
}

/* A(N, D) and its derivatives. A is linear in N. */
typedef struct profile {
    double value, by_n, by_d, by_nd, by_dd;
} profile;

static ICCP_INLINE profile evaluate(size_t dim, double n, double det, double epsilon)
{
    const double e = dim == 2 ? 1 : 2.0 / 3, ee = dim == 2 ? 2 : 10.0 / 9; /* e (e + 1) */
    const double root = sqrt(epsilon * epsilon + det * det),
                 chi = iccp_untangling_chi(epsilon, det);
    const double first = chi / root, second = 0.5 * epsilon * epsilon / (root * root * root);
    const double base = dim == 2 ? 1 : iccp_cbrt(chi), power = 1 / (dim == 2 ? chi : base * base);
    const double shape = (1 - iccp_untangling_share) / (double)dim * power,
                 size = 0.5 * iccp_untangling_share / chi;
    const double slope = first / chi, bend = second / chi, square = 1 + det * det;
    return (profile){
        .value = shape * n + size * square,
        .by_n = shape,
        .by_d = -e * shape * n * slope + size * (2 * det - square * slope),
        .by_nd = -e * shape * slope,
        .by_dd = shape * n * (ee * slope * slope - e * bend) +
                 size * (2 - 4 * det * slope + square * (2 * slope * slope - bend)),
    };
}

/* ---- in the plane ---- */

typedef struct polar {
    double length, c, s; /* a complex number; if it is 0, any direction will do */
} polar;

static polar polar_of(double x, double y)
{
    const double length = sqrt(x * x + y * y);
    return length > 0 ? (polar){length, x / length, y / length} : (polar){0, 1, 0};
}

static void add_positive(const double *element, const double *mode, double curvature,
                         double *hessian)
{
    if (curvature > 0)
        iccp_add_mode(2, element, mode, element[0] * curvature, hessian);
}

/* Adds four modes and leaves out those with negative curvature. Two modes turn the rotation and the
 * reflection. The other two mix both scales; a rotation diagonalises their 2 by 2 Hessian `a`. */
static void set_hessian2(const double *element, const double *j, const profile *p, double *hessian)
{
    const double half = sqrt(0.5);
    const polar z = polar_of(half * (j[0] + j[3]), half * (j[2] - j[1]));
    const polar w = polar_of(half * (j[0] - j[3]), half * (j[1] + j[2]));
    const double turn[2] = {2 * p->by_n + p->by_d, 2 * p->by_n - p->by_d};
    const double mixed = -p->by_dd * z.length * w.length;
    double a[2][2] = {{turn[0] + z.length * z.length * (p->by_dd + 4 * p->by_nd), mixed},
                      {mixed, turn[1] + w.length * w.length * (p->by_dd - 4 * p->by_nd)}};
    double v[2][2], mode[4];
    memset(hessian, 0, 36 * sizeof *hessian);
    add_positive(element, (double[4]){-half * z.s, -half * z.c, half * z.c, -half * z.s}, turn[0],
                 hessian);
    add_positive(element, (double[4]){-half * w.s, half * w.c, half * w.c, half * w.s}, turn[1],
                 hessian);
    iccp_jacobi_diagonalise(2, 1, 0, &a[0][0], &v[0][0]);
    for (int k = 0; k < 2; ++k) {
        const double x = half * v[k][0], y = half * v[k][1];
        mode[0] = x * z.c + y * w.c;
        mode[1] = -x * z.s + y * w.s;
        mode[2] = x * z.s + y * w.s;
        mode[3] = x * z.c - y * w.c;
        add_positive(element, mode, a[k][k], hessian);
    }
}

/* ---- in space ---- */

/* Flips and twists are known. The three modes of the singular values are the eigenvectors of a
 * matrix. */
static void set_curvature3(const profile *p, const double *sigma, iccp_modes *h)
{
    enum { SWEEPS = 8 };
    const double minor[3] = {sigma[1] * sigma[2], sigma[2] * sigma[0], sigma[0] * sigma[1]};
    double a[3][3], v[3][3];
    memset(h, 0, sizeof *h);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const double third = i == k ? 0 : sigma[3 - i - k];
            a[i][k] = (i == k) * 2 * p->by_n + p->by_dd * minor[i] * minor[k] + p->by_d * third +
                      2 * p->by_nd * (sigma[i] * minor[k] + minor[i] * sigma[k]);
            if (i != k) {
                const double flip = iccp_max(2 * p->by_n - p->by_d * third, 0);
                const double twist = iccp_max(2 * p->by_n + p->by_d * third, 0);
                iccp_modes_set(h, i, k, flip, twist);
            }
        }
    iccp_jacobi_diagonalise(3, SWEEPS, 1e-16, &a[0][0], &v[0][0]);
    for (int n = 0; n < 3; ++n)
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                h->singular[i][k] += iccp_max(a[n][n], 0) * v[n][i] * v[n][k];
}

static void set_hessian3(const double *element, const double *j, const profile *p, double *hessian)
{
    iccp_modes h;
    iccp_singular s;
    iccp_singular_find(3, j, &s);
    set_curvature3(p, s.sigma, &h);
    iccp_modes_hessian(element, &h, &s, hessian);
}

/* ---- plane and space ---- */

static ICCP_INLINE double energy_of(size_t dim, const double *element, const double *const *image,
                                    double epsilon)
{
    double j[9];
    const double det = iccp_element_jacobian(dim, element, image, j);
    return element[0] * evaluate(dim, iccp_squared_norm(dim, j), det, epsilon).value;
}

double iccp_untangling_energy(size_t dim, const double *element, const double *const *image,
                              double epsilon)
{
    return dim == 2 ? energy_of(2, element, image, epsilon) : energy_of(3, element, image, epsilon);
}

static ICCP_INLINE profile set_gradient(size_t dim, const double *element,
                                        const double *const *image, double epsilon, double *j,
                                        double *gradient)
{
    double minor[9], by_j[9];
    const double det = iccp_element_jacobian(dim, element, image, j);
    const profile p = evaluate(dim, iccp_squared_norm(dim, j), det, epsilon);
    iccp_cofactors(dim, j, minor);
    for (size_t i = 0; i < dim * dim; ++i)
        by_j[i] = element[0] * (2 * p.by_n * j[i] + p.by_d * minor[i]);
    iccp_pull_back(dim, element, by_j, 1, gradient);
    return p;
}

void iccp_untangling_local(size_t dim, const double *element, const double *const *image,
                           double epsilon, iccp_local *local)
{
    double j[9];
    if (dim == 2) {
        const profile p = set_gradient(2, element, image, epsilon, j, local->gradient);
        set_hessian2(element, j, &p, local->hessian);
    } else {
        const profile p = set_gradient(3, element, image, epsilon, j, local->gradient);
        set_hessian3(element, j, &p, local->hessian);
    }
}
