/* Turns a tetrahedron's Hessian from the basis of the singular vectors, where it is block diagonal,
 * to the corners: B. Smith, F. de Goes, T. Kim, Analytic eigensystems for isotropic distortion
 * energies, 2019. */
#include "map/energy/modes.h"

typedef double matrix[3][3];

/* Computes the block of two corners. Their gradients have coordinates `a` and `b` in the basis v.
 * The block is built in the basis u and then turned to that of space. */
static void set_block(const iccp_modes *h, const iccp_singular *s, const double *a, const double *b,
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

void iccp_modes_hessian(const double *element, const iccp_modes *modes, const iccp_singular *s,
                        double *hessian)
{
    double w[4][3];
    for (int a = 0; a < 4; ++a)
        for (int k = 0; k < 3; ++k) {
            const double *g = element + 1 + 3 * a, *v = s->v[k];
            w[a][k] = g[0] * v[0] + g[1] * v[1] + g[2] * v[2];
        }
    for (int a = 0; a < 4; ++a)
        for (int b = a; b < 4; ++b) {
            matrix block;
            set_block(modes, s, w[a], w[b], element[0], block);
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    hessian[12 * (3 * a + r) + 3 * b + c] = hessian[12 * (3 * b + c) + 3 * a + r] =
                        block[r][c];
        }
}
