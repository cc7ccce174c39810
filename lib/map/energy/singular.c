/* Decomposes a Jacobian. Finds the eigenvectors v of J^T J; then u follows from J v. The last pair
 * is chosen to make both u and v rotations. So the last value carries the sign of the
 * determinant. */
#include "map/energy/singular.h"

#include "math/jacobi.h"
#include "math/vec.h"

#include <string.h>

/* ---- in the plane ---- */

/* J^T J is a multiple of 1 plus (p, q; q, -p). The angle of v is half that of (p, q). */
static void find2(const double *j, iccp_singular *s)
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
    s->sigma[1] = (j[0] * j[3] - j[1] * j[2]) / s->sigma[0];
    s->u[0][0] = x / s->sigma[0];
    s->u[0][1] = y / s->sigma[0];
    s->u[1][0] = -s->u[0][1];
    s->u[1][1] = s->u[0][0];
}

/* ---- in space ---- */

static void normalise(double *a)
{
    const double length = iccp_vec_norm(3, a);
    for (int k = 0; k < 3; ++k)
        a[k] /= length;
}

/* Sets w to any direction at right angles to u. */
static void set_beside(const double *u, double *w)
{
    const int k = fabs(u[0]) < 0.6 ? 0 : 1;
    const double axis[3] = {k == 0, k == 1, 0};
    iccp_vec_cross(u, axis, w);
    normalise(w);
}

static void multiply(const double *j, const double *a, double *b)
{
    for (int r = 0; r < 3; ++r)
        b[r] = iccp_vec_dot(3, j + 3 * r, a);
}

/* Sets the eigenvectors of J^T J, by falling eigenvalues. The last one is reversed if needed to
 * make them a rotation. */
static void set_right(const double *j, iccp_singular *s)
{
    enum { SWEEPS = 8 };
    double square[3][3], v[3][3];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            square[r][c] = j[r] * j[c] + j[3 + r] * j[3 + c] + j[6 + r] * j[6 + c];
    iccp_jacobi_diagonalise(3, SWEEPS, 1e-16, &square[0][0], &v[0][0]);
    int most = 0, least = 2;
    for (int k = 0; k < 3; ++k) {
        most = square[k][k] > square[most][most] ? k : most;
        least = square[k][k] < square[least][least] ? k : least;
    }
    const int middle = most != least ? 3 - most - least : (most + 1) % 3;
    memcpy(s->v[0], v[most], sizeof s->v[0]);
    memcpy(s->v[1], v[middle], sizeof s->v[1]);
    iccp_vec_cross(s->v[0], s->v[1], s->v[2]);
}

/* Applies Gram-Schmidt to J v. If J v vanishes, as for a flat image, any directions will do. */
static void find3(const double *j, iccp_singular *s)
{
    double image[3];
    set_right(j, s);
    multiply(j, s->v[0], s->u[0]);
    s->sigma[0] = iccp_vec_norm(3, s->u[0]);
    if (s->sigma[0] > 0)
        normalise(s->u[0]);
    else
        memcpy(s->u[0], (double[3]){1, 0, 0}, sizeof s->u[0]);
    multiply(j, s->v[1], image);
    const double along = iccp_vec_dot(3, image, s->u[0]);
    for (int k = 0; k < 3; ++k)
        s->u[1][k] = image[k] - along * s->u[0][k];
    s->sigma[1] = iccp_vec_norm(3, s->u[1]);
    if (s->sigma[1] > 1e-14 * s->sigma[0])
        normalise(s->u[1]);
    else
        set_beside(s->u[0], s->u[1]);
    iccp_vec_cross(s->u[0], s->u[1], s->u[2]);
    multiply(j, s->v[2], image);
    s->sigma[2] = iccp_vec_dot(3, image, s->u[2]);
}

void iccp_singular_find(size_t dim, const double *j, iccp_singular *s)
{
    if (dim == 2)
        find2(j, s);
    else
        find3(j, s);
}
