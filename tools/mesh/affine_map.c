/* Products and inverses of affine maps. */
#include "mesh/affine_map.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The square of it is below the rounding of doubles. */
static const double NEARLY_ORTHOGONAL = 1e-9;

static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

void affine_identity(double out[12])
{
    memcpy(out, identity, sizeof identity);
}

bool affine_is_identity(const double a[12])
{
    for (int i = 0; i < 12; i++)
        if (a[i] != identity[i])
            return false;
    return true;
}

void affine_compose(double out[12], const double a[12], const double b[12])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            const double *row = a + 4 * i;
            out[4 * i + j] =
                row[0] * b[j] + row[1] * b[4 + j] + row[2] * b[8 + j] + (j == 3 ? row[3] : 0);
        }
}

/* Entry (i, j) of the matrix of cofactors. */
static double cofactor(const double a[12], int i, int j)
{
    const double *p = a + 4 * ((i + 1) % 3), *q = a + 4 * ((i + 2) % 3);
    int k = (j + 1) % 3, l = (j + 2) % 3;
    return p[k] * q[l] - p[l] * q[k];
}

double affine_determinant(const double a[12])
{
    return a[0] * cofactor(a, 0, 0) + a[1] * cofactor(a, 0, 1) + a[2] * cofactor(a, 0, 2);
}

bool affine_invert(double out[12], const double a[12])
{
    double determinant = affine_determinant(a), product[12];
    for (int i = 0; i < 3; i++) {
        double *row = out + 4 * i;
        for (int j = 0; j < 3; j++)
            row[j] = cofactor(a, j, i) / determinant;
        row[3] = -(row[0] * a[3] + row[1] * a[7] + row[2] * a[11]);
    }
    affine_compose(product, out, a);
    for (int i = 0; i < 12; i++)
        if (!isfinite(out[i]) ||
            (i % 4 < 3 && !(fabs(product[i] - identity[i]) < (double)FLT_EPSILON)))
            return false;
    return true;
}

void affine_turn(double out[3], const double a[12], const double v[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[4 * i] * v[0] + a[4 * i + 1] * v[1] + a[4 * i + 2] * v[2];
}

void affine_turn_back(double out[3], const double a[12], const double v[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] * v[0] + a[4 + i] * v[1] + a[8 + i] * v[2];
}

void affine_apply(double out[3], const double a[12], const double point[3])
{
    affine_turn(out, a, point);
    for (int i = 0; i < 3; i++)
        out[i] += a[4 * i + 3];
}

double affine_length(const double v[3])
{
    double size = fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2]));
    if (!(size > 0))
        return 0;
    double x = v[0] / size, y = v[1] / size, z = v[2] / size;
    return size * sqrt(x * x + y * y + z * z);
}

bool affine_set_length(double v[3], double length)
{
    double now = affine_length(v);
    if (!(now > 0 && isfinite(now)))
        return false;
    for (int i = 0; i < 3; i++)
        v[i] = v[i] / now * length;
    return true;
}

/* Newton's iteration X -> (s X + X^-T / s) / 2, scaled by s while X is far from orthogonal. The error
 * of each step is about the square of the one before.
 * Higham: Computing the polar decomposition - with applications, 1986. */
bool affine_rotation(double out[12], const double a[12])
{
    double inverse[12], change = HUGE_VAL;
    for (int i = 0; i < 12; i++)
        out[i] = i % 4 < 3 ? a[i] : 0;
    while (change > NEARLY_ORTHOGONAL) {
        double size = 0, size_back = 0;
        if (!affine_invert(inverse, out))
            return false;
        for (int i = 0; i < 12; i++) {
            size += out[i] * out[i];
            size_back += inverse[i] * inverse[i];
        }
        double s = change > 0.5 ? sqrt(sqrt(size_back / size)) : 1;
        change = 0;
        for (int i = 0; i < 12; i++) {
            double old = out[i];
            out[i] = i % 4 < 3 ? (s * old + inverse[i % 4 * 4 + i / 4] / s) / 2 : 0;
            change = fmax(change, fabs(out[i] - old));
        }
    }
    return true;
}

bool affine_turn_normal(double out[3], const double a[12], const double normal[3])
{
    double size = 0, scaled[12] = {0}, turned[3];
    for (int i = 0; i < 12; i++)
        size = i % 4 < 3 ? fmax(size, fabs(a[i])) : size;
    for (int i = 0; i < 12; i++)
        scaled[i] = size > 0 ? a[i] / size : 0;
    double sign = affine_determinant(scaled) < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++)
        turned[i] =
            sign * (cofactor(scaled, i, 0) * normal[0] + cofactor(scaled, i, 1) * normal[1] +
                    cofactor(scaled, i, 2) * normal[2]);
    if (!affine_set_length(turned, affine_length(normal)))
        return false;
    memcpy(out, turned, sizeof turned);
    return true;
}
