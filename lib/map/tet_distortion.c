/* The energy is that of V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov,
 * Foldover-free maps in 50 lines of code, 2021: with chi for the determinant of J,
 *     (1 - s) |J|^2 / (3 chi^(2/3)) + s (1 + det^2) / (2 chi).
 * It is a function A(N, D) of N = |J|^2 and D = det J, so its Hessian has the eigenvectors of B. Smith,
 * F. de Goes, T. Kim, Analytic eigensystems for isotropic distortion energies, 2019: for each pair of singular
 * vectors a flip and a twist, and three in the space of the singular values. */
#include "map/tet_distortion.h"

#include "map/distortion.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* The share of the volume term: small, so that angles decide. */
static const double VOLUME_SHARE = 1.0 / 128;

typedef double vector[3];
typedef double matrix[3][3];

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void iccp_tet_create(iccp_tet *tet, const double *const corner[4])
{
    matrix edge;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            edge[i][k] = corner[i + 1][k] - corner[0][k];
    cross(edge[1], edge[2], tet->gradient[1]);
    cross(edge[2], edge[0], tet->gradient[2]);
    cross(edge[0], edge[1], tet->gradient[3]);
    const double det = dot(edge[0], tet->gradient[1]);
    tet->volume = det / 6;
    for (int k = 0; k < 3; ++k) {
        tet->gradient[0][k] = 0;
        for (int i = 1; i < 4; ++i) {
            tet->gradient[i][k] /= det;
            tet->gradient[0][k] -= tet->gradient[i][k];
        }
    }
}

double iccp_tet_jacobian(const iccp_tet *tet, const double *const image[4], double j[9])
{
    vector minor;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
            j[3 * r + c] = 0;
            for (int k = 1; k < 4; ++k)
                j[3 * r + c] += (image[k][r] - image[0][r]) * tet->gradient[k][c];
        }
    cross(j + 3, j + 6, minor);
    return dot(j, minor);
}

/* A(N, D) and its derivatives; it is linear in N. */
typedef struct profile {
    double value, by_n, by_d, by_nd, by_dd;
} profile;

static profile evaluate(double n, double det, double epsilon)
{
    const double root = sqrt(epsilon * epsilon + det * det), chi = iccp_untangle_chi(epsilon, det);
    const double first = chi / root, second = 0.5 * epsilon * epsilon / (root * root * root);
    const double third = cbrt(chi), power = 1 / (third * third);
    const double shape = (1 - VOLUME_SHARE) / 3 * power, size = 0.5 * VOLUME_SHARE / chi;
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

static double squared_norm(const double j[9])
{
    return dot(j, j) + dot(j + 3, j + 3) + dot(j + 6, j + 6);
}

double iccp_tet_untangle_energy(const iccp_tet *tet, const double *const image[4], double epsilon)
{
    double j[9];
    const double det = iccp_tet_jacobian(tet, image, j);
    return tet->volume * evaluate(squared_norm(j), det, epsilon).value;
}

/* ---- eigenvectors ---- */

/* Eigenvalues, on the diagonal, and eigenvectors, the rows of v, of a symmetric matrix: C. G. J. Jacobi's
 * rotations. */
static void diagonalise(matrix a, matrix v)
{
    enum { SWEEPS = 8 };
    memset(v, 0, sizeof(matrix));
    for (int i = 0; i < 3; ++i)
        v[i][i] = 1;
    for (int k = 0; k < 3 * SWEEPS; ++k) {
        const int p = k % 3 == 2, q = k % 3 == 0 ? 1 : 2;
        if (fabs(a[p][q]) <= 1e-16 * (fabs(a[p][p]) + fabs(a[q][q])))
            continue;
        const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
        const double t = copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
        const double c = 1 / sqrt(t * t + 1), s = t * c;
        for (int i = 0; i < 3; ++i) {
            const double x = a[i][p], y = a[i][q];
            a[i][p] = c * x - s * y;
            a[i][q] = s * x + c * y;
        }
        for (int i = 0; i < 3; ++i) {
            const double x = a[p][i], y = a[q][i], z = v[p][i], w = v[q][i];
            a[p][i] = c * x - s * y;
            a[q][i] = s * x + c * y;
            v[p][i] = c * z - s * w;
            v[q][i] = s * z + c * w;
        }
    }
}

static void normalise(double *a)
{
    const double length = sqrt(dot(a, a));
    for (int k = 0; k < 3; ++k)
        a[k] /= length;
}

/* Any direction at right angles to u. */
static void set_beside(const double *u, double *w)
{
    const int k = fabs(u[0]) < 0.6 ? 0 : 1;
    const vector axis = {k == 0, k == 1, 0};
    cross(u, axis, w);
    normalise(w);
}

static void multiply(const double j[9], const double *a, double *b)
{
    for (int r = 0; r < 3; ++r)
        b[r] = dot(j + 3 * r, a);
}

/* J = sum of sigma[k] u[k] v[k]^T with rotations u and v; sigma[0] >= sigma[1] >= |sigma[2]|, up to
 * rounding. */
typedef struct singular {
    double sigma[3];
    matrix u, v;
} singular;

static void decompose(const double j[9], singular *s)
{
    matrix square, v;
    vector image;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            square[r][c] = j[r] * j[c] + j[3 + r] * j[3 + c] + j[6 + r] * j[6 + c];
    diagonalise(square, v);
    int most = 0, least = 2;
    for (int k = 0; k < 3; ++k) {
        most = square[k][k] > square[most][most] ? k : most;
        least = square[k][k] < square[least][least] ? k : least;
    }
    const int middle = most != least ? 3 - most - least : (most + 1) % 3;
    memcpy(s->v[0], v[most], sizeof(vector));
    memcpy(s->v[1], v[middle], sizeof(vector));
    cross(s->v[0], s->v[1], s->v[2]);
    multiply(j, s->v[0], s->u[0]);
    s->sigma[0] = sqrt(dot(s->u[0], s->u[0]));
    if (s->sigma[0] > 0)
        normalise(s->u[0]);
    else
        memcpy(s->u[0], (vector){1, 0, 0}, sizeof(vector));
    multiply(j, s->v[1], image);
    const double along = dot(image, s->u[0]);
    for (int k = 0; k < 3; ++k)
        s->u[1][k] = image[k] - along * s->u[0][k];
    s->sigma[1] = sqrt(dot(s->u[1], s->u[1]));
    if (s->sigma[1] > 1e-14 * s->sigma[0])
        normalise(s->u[1]);
    else
        set_beside(s->u[0], s->u[1]);
    cross(s->u[0], s->u[1], s->u[2]);
    multiply(j, s->v[2], image);
    s->sigma[2] = dot(image, s->u[2]);
}

/* ---- the Hessian ---- */

/* By J in the basis u[i] v[k]^T, without negative curvature: singular[i][k] for (i, i) and (k, k), the
 * others for (i, k) and itself, and (i, k) and (k, i). */
typedef struct curvature {
    matrix singular, same, other;
} curvature;

static void set_curvature(const profile *p, const double *sigma, curvature *h)
{
    const vector minor = {sigma[1] * sigma[2], sigma[2] * sigma[0], sigma[0] * sigma[1]};
    matrix a, v;
    memset(h, 0, sizeof *h);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const double third = i == k ? 0 : sigma[3 - i - k];
            a[i][k] = (i == k) * 2 * p->by_n + p->by_dd * minor[i] * minor[k] + p->by_d * third +
                      2 * p->by_nd * (sigma[i] * minor[k] + minor[i] * sigma[k]);
            if (i != k) {
                const double flip = fmax(2 * p->by_n - p->by_d * third, 0);
                const double twist = fmax(2 * p->by_n + p->by_d * third, 0);
                h->same[i][k] = 0.5 * (flip + twist);
                h->other[i][k] = 0.5 * (flip - twist);
            }
        }
    diagonalise(a, v);
    for (int n = 0; n < 3; ++n)
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                h->singular[i][k] += fmax(a[n][n], 0) * v[n][i] * v[n][k];
}

/* The block of two corners whose gradients have coordinates `a` and `b` in the basis v, in the basis u and
 * then in that of space. */
static void set_block(const curvature *h, const singular *s, const double *a, const double *b,
                      double factor, matrix block)
{
    matrix inner, half;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            inner[i][k] = h->singular[i][k] * a[i] * b[k] + h->other[i][k] * a[k] * b[i];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            inner[i][i] += h->same[i][k] * a[k] * b[k];
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c)
            half[i][c] =
                inner[i][0] * s->u[0][c] + inner[i][1] * s->u[1][c] + inner[i][2] * s->u[2][c];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            block[r][c] = factor * (s->u[0][r] * half[0][c] + s->u[1][r] * half[1][c] +
                                    s->u[2][r] * half[2][c]);
}

static void set_hessian(const iccp_tet *tet, const curvature *h, const singular *s,
                        double hessian[12][12])
{
    vector w[4];
    for (int a = 0; a < 4; ++a)
        for (int k = 0; k < 3; ++k)
            w[a][k] = dot(tet->gradient[a], s->v[k]);
    for (int a = 0; a < 4; ++a)
        for (int b = a; b < 4; ++b) {
            matrix block;
            set_block(h, s, w[a], w[b], tet->volume, block);
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    hessian[3 * a + r][3 * b + c] = hessian[3 * b + c][3 * a + r] = block[r][c];
        }
}

void iccp_tet_untangle_local(const iccp_tet *tet, const double *const image[4], double epsilon,
                             iccp_tet_local *local)
{
    double j[9], minor[9], by_j[9];
    singular s;
    curvature h;
    const double det = iccp_tet_jacobian(tet, image, j);
    const profile p = evaluate(squared_norm(j), det, epsilon);
    cross(j + 3, j + 6, minor);
    cross(j + 6, j, minor + 3);
    cross(j, j + 3, minor + 6);
    for (int i = 0; i < 9; ++i)
        by_j[i] = tet->volume * (2 * p.by_n * j[i] + p.by_d * minor[i]);
    for (int a = 0; a < 4; ++a)
        multiply(by_j, tet->gradient[a], local->gradient + 3 * a);
    decompose(j, &s);
    set_curvature(&p, s.sigma, &h);
    set_hessian(tet, &h, &s, local->hessian);
}
