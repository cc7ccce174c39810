/* V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, Foldover-free maps in
 * 50 lines of code, 2021: with chi for the determinant of J, the energy is
 *     (1 - s) |J|^2 / (dim chi^(2 / dim)) + s (1 + det^2) / (2 chi).
 * In the plane the eigenvectors of its Hessian by J are found by rotations. In space it is taken as
 * a function A(N, D) of N = |J|^2 and D = det J, whose Hessian has the eigenvectors of B. Smith, F.
 * de Goes, T. Kim, Analytic eigensystems for isotropic distortion energies, 2019: for each pair of
 * singular vectors a flip and a twist, and three in the space of the singular values. */
#include "map/untangling.h"

#include "base/minmax.h"
#include "map/modes.h"
#include "math/elementary.h"
#include "math/jacobi.h"

#include <string.h>

/* The share of the area or volume term: small, so that angles decide. */
static const double MEASURE_SHARE = 1.0 / 128;

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

/* ---- in the plane ---- */

static double numerator(const double *j, double det)
{
    return 0.5 * (1 - MEASURE_SHARE) * iccp_squared_norm(2, j) +
           0.5 * MEASURE_SHARE * (1 + det * det);
}

/* The derivatives of numerator / chi by J, and the modes of positive curvature among the four. */
static void set_local2(const double *element, const double *const *image, double epsilon,
                       iccp_local *local)
{
    enum { SWEEPS = 12 };
    double j[4], by_det[4], by_j[4], n_by_j[4], h[4][4], v[4][4];
    const double det = iccp_element_jacobian(2, element, image, j);
    const double root = sqrt(epsilon * epsilon + det * det);
    const double chi = iccp_untangling_chi(epsilon, det), d_chi = chi / root;
    const double dd_chi = 0.5 * epsilon * epsilon / (root * root * root);
    const double n = numerator(j, det);
    static const double second[4][4] = {{0, 0, 0, 1}, {0, 0, -1, 0}, {0, -1, 0, 0}, {1, 0, 0, 0}};
    iccp_cofactors(2, j, by_det);
    for (int i = 0; i < 4; ++i) {
        n_by_j[i] = (1 - MEASURE_SHARE) * j[i] + MEASURE_SHARE * det * by_det[i];
        by_j[i] = n_by_j[i] / chi - n * d_chi / (chi * chi) * by_det[i];
    }
    const double outer = MEASURE_SHARE / chi + n * (2 * d_chi * d_chi / chi - dd_chi) / (chi * chi);
    const double curve = MEASURE_SHARE * det / chi - n * d_chi / (chi * chi);
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            h[r][c] = (r == c) * (1 - MEASURE_SHARE) / chi + outer * by_det[r] * by_det[c] +
                      curve * second[r][c] -
                      d_chi / (chi * chi) * (n_by_j[r] * by_det[c] + by_det[r] * n_by_j[c]);
    iccp_jacobi_diagonalise(4, SWEEPS, 1e-14, &h[0][0], &v[0][0]);
    iccp_pull_back(2, element, by_j, element[0], local->gradient);
    memset(local->hessian, 0, 36 * sizeof *local->hessian);
    for (int i = 0; i < 4; ++i)
        if (h[i][i] > 0)
            iccp_add_mode(2, element, v[i], element[0] * h[i][i], local->hessian);
}

/* ---- in space ---- */

/* A(N, D) and its derivatives; it is linear in N. */
typedef struct profile {
    double value, by_n, by_d, by_nd, by_dd;
} profile;

static profile evaluate(double n, double det, double epsilon)
{
    const double root = sqrt(epsilon * epsilon + det * det),
                 chi = iccp_untangling_chi(epsilon, det);
    const double first = chi / root, second = 0.5 * epsilon * epsilon / (root * root * root);
    const double third = iccp_cbrt(chi), power = 1 / (third * third);
    const double shape = (1 - MEASURE_SHARE) / 3 * power, size = 0.5 * MEASURE_SHARE / chi;
    const double slope = first / chi, bend = second / chi, square = 1 + det * det;
    return (profile){
        .value = shape * n + size * square,
        .by_n = shape,
        .by_d = -2.0 / 3 * shape * n * slope + size * (2 * det - square * slope),
        .by_nd = -2.0 / 3 * shape * slope,
        .by_dd = shape * n * (10.0 / 9 * slope * slope - 2.0 / 3 * bend) +
                 size * (2 - 4 * det * slope + square * (2 * slope * slope - bend)),
    };
}

/* Flips and twists are known; the three modes of the singular values are the eigenvectors of a
 * matrix. */
static void set_curvature(const profile *p, const double *sigma, iccp_modes *h)
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

static void set_local3(const double *element, const double *const *image, double epsilon,
                       iccp_local *local)
{
    double j[9], minor[9], by_j[9];
    iccp_singular s;
    iccp_modes h;
    const double det = iccp_element_jacobian(3, element, image, j);
    const profile p = evaluate(iccp_squared_norm(3, j), det, epsilon);
    iccp_cofactors(3, j, minor);
    for (int i = 0; i < 9; ++i)
        by_j[i] = element[0] * (2 * p.by_n * j[i] + p.by_d * minor[i]);
    iccp_pull_back(3, element, by_j, 1, local->gradient);
    iccp_singular_find(3, j, &s);
    set_curvature(&p, s.sigma, &h);
    iccp_modes_hessian(element, &h, &s, local->hessian);
}

/* ---- in either ---- */

double iccp_untangling_energy(size_t dim, const double *element, const double *const *image,
                              double epsilon)
{
    double j[9];
    if (dim == 2) {
        const double det = iccp_element_jacobian(2, element, image, j);
        return element[0] * numerator(j, det) / iccp_untangling_chi(epsilon, det);
    }
    const double det = iccp_element_jacobian(3, element, image, j);
    return element[0] * evaluate(iccp_squared_norm(3, j), det, epsilon).value;
}

void iccp_untangling_local(size_t dim, const double *element, const double *const *image,
                           double epsilon, iccp_local *local)
{
    if (dim == 2)
        set_local2(element, image, epsilon, local);
    else
        set_local3(element, image, epsilon, local);
}
