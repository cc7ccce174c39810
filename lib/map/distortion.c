/* B. Smith, F. de Goes, T. Kim, Analytic eigensystems for isotropic distortion energies, 2019;
 * M. Rabinovich, R. Poranne, D. Panozzo, O. Sorkine-Hornung, Scalable locally injective mappings
 * (SLIM), 2017; V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov,
 * Foldover-free maps in 50 lines of code, 2021. */
#include "map/distortion.h"

#include <math.h>
#include <string.h>

/* The share of the area term in the untangling energy: small, so that angles decide. */
static const double AREA_SHARE = 1.0 / 128;

void iccp_element_create(iccp_element *element, const double a[2], const double b[2],
                         const double c[2])
{
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
    const double twice = ux * vy - uy * vx;
    element->area = 0.5 * twice;
    element->gradient[1][0] = vy / twice;
    element->gradient[1][1] = -vx / twice;
    element->gradient[2][0] = -uy / twice;
    element->gradient[2][1] = ux / twice;
    for (int c2 = 0; c2 < 2; ++c2)
        element->gradient[0][c2] = -element->gradient[1][c2] - element->gradient[2][c2];
}

void iccp_element_jacobian(const iccp_element *element, const double *const image[3], double j[4])
{
    const double ux = image[1][0] - image[0][0], uy = image[1][1] - image[0][1];
    const double vx = image[2][0] - image[0][0], vy = image[2][1] - image[0][1];
    for (int c = 0; c < 2; ++c) {
        j[c] = ux * element->gradient[1][c] + vx * element->gradient[2][c];
        j[2 + c] = uy * element->gradient[1][c] + vy * element->gradient[2][c];
    }
}

static double determinant(const double j[4])
{
    return j[0] * j[3] - j[1] * j[2];
}

static double squared_norm(const double j[4])
{
    return j[0] * j[0] + j[1] * j[1] + j[2] * j[2] + j[3] * j[3];
}

double iccp_dirichlet_energy(const iccp_element *element, const double *const image[3])
{
    double j[4];
    iccp_element_jacobian(element, image, j);
    const double det = determinant(j);
    return det > 0 ? element->area * squared_norm(j) * (1 + 1 / (det * det)) : HUGE_VAL;
}

/* J = u diag(sigma) v^T with rotations u and v; J's determinant is positive. */
typedef struct singular {
    double sigma[2];
    double u[2][2], v[2][2]; /* u[k]: the k-th left singular vector */
} singular;

static void decompose(const double j[4], singular *s)
{
    const double a = j[0] * j[0] + j[2] * j[2], d = j[1] * j[1] + j[3] * j[3];
    const double q = j[0] * j[1] + j[2] * j[3], p = 0.5 * (a - d), r = sqrt(p * p + q * q);
    double c = 1, t = 0;
    if (r > 0) {
        c = sqrt(0.5 * (1 + fabs(p) / r));
        t = 0.5 * q / (r * c);
        if (p < 0) {
            const double swap = c;
            c = fabs(t);
            t = copysign(swap, q);
        }
    }
    s->v[0][0] = c;
    s->v[0][1] = t;
    s->v[1][0] = -t;
    s->v[1][1] = c;
    const double x = j[0] * c + j[1] * t, y = j[2] * c + j[3] * t;
    s->sigma[0] = sqrt(x * x + y * y);
    s->sigma[1] = determinant(j) / s->sigma[0];
    s->u[0][0] = x / s->sigma[0];
    s->u[0][1] = y / s->sigma[0];
    s->u[1][0] = -s->u[0][1];
    s->u[1][1] = s->u[0][0];
}

/* Adds weight * q q^T, where q is what a direction in the space of Jacobians, row by row, means for the
 * corners. */
static void add_mode(const iccp_element *element, const double mode[4], double weight,
                     double hessian[6][6])
{
    double q[6];
    for (int k = 0; k < 3; ++k) {
        const double *g = element->gradient[k];
        q[2 * k] = mode[0] * g[0] + mode[1] * g[1];
        q[2 * k + 1] = mode[2] * g[0] + mode[3] * g[1];
    }
    for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c)
            hessian[r][c] += weight * q[r] * q[c];
}

static void set_gradient(const iccp_element *element, const double by_j[4], double gradient[6])
{
    for (int k = 0; k < 3; ++k) {
        const double *g = element->gradient[k];
        gradient[2 * k] = element->area * (by_j[0] * g[0] + by_j[1] * g[1]);
        gradient[2 * k + 1] = element->area * (by_j[2] * g[0] + by_j[3] * g[1]);
    }
}

/* a u_k v_l^T + b u_l v_k^T, row by row */
static void mix_modes(const singular *s, int k, int l, double a, double b, double mode[4])
{
    for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c)
            mode[2 * r + c] = a * s->u[k][r] * s->v[l][c] + b * s->u[l][r] * s->v[k][c];
}

/* The four modes of the energy h(sigma_0) + h(sigma_1), h = sigma^2 + sigma^-2: the singular values
 * themselves, flip and twist. Only the last may have negative curvature. */
static void add_newton_modes(const iccp_element *element, const singular *s, double hessian[6][6])
{
    const double s0 = s->sigma[0], s1 = s->sigma[1], product = s0 * s1;
    const double cube = product * product * product, half = sqrt(0.5);
    const double twist = 2 - 2 * (s0 * s0 - s0 * s1 + s1 * s1) / cube;
    const double flip = 2 + 2 * (s0 * s0 + s0 * s1 + s1 * s1) / cube;
    double mode[4];
    for (int k = 0; k < 2; ++k) {
        const double sigma2 = s->sigma[k] * s->sigma[k];
        mix_modes(s, k, k, 1, 0, mode);
        add_mode(element, mode, element->area * (2 + 6 / (sigma2 * sigma2)), hessian);
    }
    mix_modes(s, 0, 1, half, half, mode);
    add_mode(element, mode, element->area * flip, hessian);
    if (twist > 0) {
        mix_modes(s, 0, 1, half, -half, mode);
        add_mode(element, mode, element->area * twist, hessian);
    }
}

/* SLIM's weights: |W (J - R)|^2 has the energy's gradient; W^2 = u diag(m) u^T. */
static void add_majorant(const iccp_element *element, const singular *s, double hessian[6][6])
{
    double m[2][2] = {{0, 0}, {0, 0}};
    for (int k = 0; k < 2; ++k) {
        const double i = 1 / s->sigma[k], weight = 1 + i + i * i + i * i * i;
        for (int r = 0; r < 2; ++r)
            for (int c = 0; c < 2; ++c)
                m[r][c] += weight * s->u[k][r] * s->u[k][c];
    }
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            const double *g = element->gradient[a], *h = element->gradient[b];
            const double dot = 2 * element->area * (g[0] * h[0] + g[1] * h[1]);
            for (int r = 0; r < 2; ++r)
                for (int c = 0; c < 2; ++c)
                    hessian[2 * a + r][2 * b + c] += dot * m[r][c];
        }
}

void iccp_dirichlet_local(const iccp_element *element, const double *const image[3], bool majorise,
                          iccp_local *local)
{
    double j[4], by_j[4];
    singular s;
    iccp_element_jacobian(element, image, j);
    decompose(j, &s);
    for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c) {
            by_j[2 * r + c] = 0;
            for (int k = 0; k < 2; ++k) {
                const double sigma = s.sigma[k];
                by_j[2 * r + c] +=
                    2 * (sigma - 1 / (sigma * sigma * sigma)) * s.u[k][r] * s.v[k][c];
            }
        }
    set_gradient(element, by_j, local->gradient);
    memset(local->hessian, 0, sizeof local->hessian);
    if (majorise)
        add_majorant(element, &s, local->hessian);
    else
        add_newton_modes(element, &s, local->hessian);
}

/* ---- untangling ---- */

double iccp_untangle_chi(double epsilon, double det)
{
    const double root = sqrt(epsilon * epsilon + det * det);
    /* The second form does not cancel for negative determinants. */
    return det >= 0 ? 0.5 * (det + root) : 0.5 * epsilon * epsilon / (root - det);
}

double iccp_untangle_start(double least)
{
    return least > 0 ? 1e-10 : sqrt(1e-12 + 0.04 * least * least);
}

double iccp_untangle_next(double epsilon, double least, double fall)
{
    const double mu = (1 - fall) * iccp_untangle_chi(epsilon, least);
    return least < mu ? 2 * sqrt(mu * (mu - least)) : 1e-10;
}

static double numerator(const double j[4], double det)
{
    return 0.5 * (1 - AREA_SHARE) * squared_norm(j) + 0.5 * AREA_SHARE * (1 + det * det);
}

double iccp_untangle_energy(const iccp_element *element, const double *const image[3],
                            double epsilon)
{
    double j[4];
    iccp_element_jacobian(element, image, j);
    const double det = determinant(j);
    return element->area * numerator(j, det) / iccp_untangle_chi(epsilon, det);
}

/* Eigenvalues and eigenvectors (rows of v) of a symmetric 4 by 4 matrix by Jacobi rotations. */
static void diagonalise(double a[4][4], double v[4][4])
{
    memset(v, 0, 16 * sizeof(double));
    for (int i = 0; i < 4; ++i)
        v[i][i] = 1;
    for (int sweep = 0; sweep < 12; ++sweep)
        for (int p = 0; p < 3; ++p)
            for (int q = p + 1; q < 4; ++q) {
                if (fabs(a[p][q]) <= 1e-14 * (fabs(a[p][p]) + fabs(a[q][q])))
                    continue;
                const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
                const double t = copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
                const double c = 1 / sqrt(t * t + 1), s = t * c;
                for (int i = 0; i < 4; ++i) {
                    const double x = a[i][p], y = a[i][q];
                    a[i][p] = c * x - s * y;
                    a[i][q] = s * x + c * y;
                }
                for (int i = 0; i < 4; ++i) {
                    const double x = a[p][i], y = a[q][i], z = v[p][i], w = v[q][i];
                    a[p][i] = c * x - s * y;
                    a[q][i] = s * x + c * y;
                    v[p][i] = c * z - s * w;
                    v[q][i] = s * z + c * w;
                }
            }
}

void iccp_untangle_local(const iccp_element *element, const double *const image[3], double epsilon,
                         iccp_local *local)
{
    double j[4], by_j[4], n_by_j[4], h[4][4], v[4][4];
    iccp_element_jacobian(element, image, j);
    const double det = determinant(j), root = sqrt(epsilon * epsilon + det * det);
    const double chi = iccp_untangle_chi(epsilon, det), d_chi = chi / root;
    const double dd_chi = 0.5 * epsilon * epsilon / (root * root * root);
    const double n = numerator(j, det);
    const double by_det[4] = {j[3], -j[2], -j[1], j[0]};
    static const double second[4][4] = {{0, 0, 0, 1}, {0, 0, -1, 0}, {0, -1, 0, 0}, {1, 0, 0, 0}};
    for (int i = 0; i < 4; ++i) {
        n_by_j[i] = (1 - AREA_SHARE) * j[i] + AREA_SHARE * det * by_det[i];
        by_j[i] = n_by_j[i] / chi - n * d_chi / (chi * chi) * by_det[i];
    }
    const double outer = AREA_SHARE / chi + n * (2 * d_chi * d_chi / chi - dd_chi) / (chi * chi);
    const double curve = AREA_SHARE * det / chi - n * d_chi / (chi * chi);
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            h[r][c] = (r == c) * (1 - AREA_SHARE) / chi + outer * by_det[r] * by_det[c] +
                      curve * second[r][c] -
                      d_chi / (chi * chi) * (n_by_j[r] * by_det[c] + by_det[r] * n_by_j[c]);
    diagonalise(h, v);
    set_gradient(element, by_j, local->gradient);
    memset(local->hessian, 0, sizeof local->hessian);
    for (int i = 0; i < 4; ++i)
        if (h[i][i] > 0)
            add_mode(element, v[i], element->area * h[i][i], local->hessian);
}
