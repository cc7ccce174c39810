/* Volumes, areas, gradients and conductances of simplices. Source: linear algebra, with bounds
 * for flat simplices. */
#include "shelling/element.h"

#include "base/compiler.h"
#include "base/minmax.h"
#include "icc/base.h"
#include "math/vec.h"

#include <math.h>

/* The least height of an edge over the space of the earlier edges, relative to the longest edge.
 * Smaller heights count as this much, so that matrices can always be factorised. A single
 * simplex of height 1e-9 would spoil them. */
static const double THINNEST = 1e-4;

/* The least length to divide by, in local units, in which domains have size 1. */
static const double LEAST_LENGTH = 1e-12;

/* Functions that take the dimension are also compiled for 3, with unrolled loops. There a cross
 * product replaces the elimination. */

/* A matrix with the identity to its right, which elimination turns into the inverse. */
typedef double tableau[ICC_MAX_DIM][2 * ICC_MAX_DIM];

static void swap_rows(double *a, double *b, size_t n)
{
    for (size_t k = 0; k < n; ++k) {
        const double swap = a[k];
        a[k] = b[k];
        b[k] = swap;
    }
}

/* Inverts a matrix by elimination. The pivot is the greatest entry of each column. Returns the
 * modulus of the determinant. */
static ICCP_INLINE double invert(size_t n, tableau a, double size)
{
    double determinant = 1;
    for (size_t c = 0; c < n; ++c) {
        size_t best = c;
        for (size_t r = c + 1; r < n; ++r)
            best = fabs(a[r][c]) > fabs(a[best][c]) ? r : best;
        swap_rows(a[c], a[best], best == c ? 0 : 2 * n);
        const double pivot = copysign(iccp_max(fabs(a[c][c]), THINNEST * size), a[c][c]);
        determinant *= fabs(pivot);
        for (size_t k = 0; k < 2 * n; ++k)
            a[c][k] /= pivot;
        for (size_t r = 0; r < n; ++r) {
            const double factor = r == c ? 0 : a[r][c];
            for (size_t k = c; k < 2 * n; ++k)
                a[r][k] -= factor * a[c][k];
        }
    }
    return determinant;
}

static ICCP_INLINE const double *point_of(const iccp_simplices *mesh, size_t dim, size_t side)
{
    return mesh->points + dim * mesh->corners[side];
}

/* Finds the gradients by inverting the matrix of the edges from corner 0. The first gradient is
 * minus the sum of the others. */
static ICCP_INLINE double find_gradients(const iccp_simplices *mesh, size_t n, size_t simplex,
                                         double *gradient)
{
    const size_t side = (n + 1) * simplex;
    const double *origin = point_of(mesh, n, side);
    tableau a;
    double size = 0, volume = 1;
    for (size_t i = 0; i < n; ++i) {
        const double *corner = point_of(mesh, n, side + i + 1);
        for (size_t k = 0; k < n; ++k) {
            a[k][i] = corner[k] - origin[k];
            a[k][n + i] = k == i;
            size = iccp_max(size, fabs(a[k][i]));
        }
    }
    volume = invert(n, a, size);
    for (size_t k = 0; k < n; ++k) {
        volume /= (double)(k + 1);
        gradient[k] = 0;
        for (size_t i = 0; i < n; ++i) {
            gradient[n * (i + 1) + k] = a[i][n + k];
            gradient[k] -= a[i][n + k];
        }
    }
    return volume;
}

/* Like find_gradients(), for tetrahedra. Returns 0 for a tetrahedron so flat that a pivot might
 * be below the least. If one is, the determinant is at most 4 THINNEST size^3, because the
 * pivots after the first are at most twice the longest edge. */
static double find_gradients_3(const iccp_simplices *mesh, size_t simplex, double *gradient)
{
    const double *origin = point_of(mesh, 3, 4 * simplex);
    double edge[3][3], size = 0;
    for (size_t i = 0; i < 3; ++i) {
        const double *corner = point_of(mesh, 3, 4 * simplex + i + 1);
        for (size_t k = 0; k < 3; ++k) {
            edge[i][k] = corner[k] - origin[k];
            size = iccp_max(size, fabs(edge[i][k]));
        }
    }
    iccp_vec_cross(edge[1], edge[2], gradient + 3);
    iccp_vec_cross(edge[2], edge[0], gradient + 6);
    iccp_vec_cross(edge[0], edge[1], gradient + 9);
    const double determinant = iccp_vec_dot(3, edge[0], gradient + 3);
    if (!(fabs(determinant) > 4 * THINNEST * size * size * size))
        return 0;
    for (size_t k = 0; k < 3; ++k) {
        for (size_t i = 3; i < 12; i += 3)
            gradient[i + k] /= determinant;
        gradient[k] = -gradient[3 + k] - gradient[6 + k] - gradient[9 + k];
    }
    return fabs(determinant) / 6;
}

/* The product of the heights of the edges from one corner, by Gram-Schmidt, over (dim - 1)!. */
static ICCP_INLINE double find_area(const iccp_simplices *mesh, size_t dim, size_t side)
{
    const size_t out = side % (dim + 1), first = side - out, base = out == 0;
    const double *origin = point_of(mesh, dim, first + base);
    double edge[ICC_MAX_DIM][ICC_MAX_DIM], area = 1;
    size_t n = 0;
    for (size_t i = base + 1; i <= dim; ++i) {
        if (i == out)
            continue;
        double square = 0;
        for (size_t k = 0; k < dim; ++k)
            edge[n][k] = point_of(mesh, dim, first + i)[k] - origin[k];
        for (size_t j = 0; j < n; ++j) {
            double along = 0;
            for (size_t k = 0; k < dim; ++k)
                along += edge[n][k] * edge[j][k];
            for (size_t k = 0; k < dim; ++k)
                edge[n][k] -= along * edge[j][k];
        }
        for (size_t k = 0; k < dim; ++k)
            square += edge[n][k] * edge[n][k];
        const double height = sqrt(square);
        for (size_t k = 0; k < dim; ++k)
            edge[n][k] /= iccp_max(height, LEAST_LENGTH);
        area *= height / (double)++n;
    }
    return area;
}

static double find_area_3(const iccp_simplices *mesh, size_t side)
{
    const size_t first = side / 4 * 4, out = side % 4;
    const double *a = point_of(mesh, 3, first + (out + 1) % 4);
    const double *b = point_of(mesh, 3, first + (out + 2) % 4);
    const double *c = point_of(mesh, 3, first + (out + 3) % 4);
    const double ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double ac[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    double cross[3];
    iccp_vec_cross(ab, ac, cross);
    return 0.5 * iccp_vec_norm(3, cross);
}

/* The mean of the corners of a simplex. If a side is given, the opposite corner is left out. */
static ICCP_INLINE void find_middle(const iccp_simplices *mesh, size_t dim, size_t simplex,
                                    size_t out, double *point)
{
    const size_t first = (dim + 1) * simplex;
    const double share = 1 / (double)(dim + (out > dim));
    for (size_t k = 0; k < dim; ++k)
        point[k] = 0;
    for (size_t i = 0; i <= dim; ++i)
        for (size_t k = 0; k < dim && i != out; ++k)
            point[k] += share * point_of(mesh, dim, first + i)[k];
}

static ICCP_INLINE double find_conductance(const iccp_simplices *mesh, size_t dim, size_t side)
{
    const size_t no_corner = SIZE_MAX;
    const uint32_t other = mesh->across[side];
    double here[ICC_MAX_DIM], there[ICC_MAX_DIM], square = 0;
    find_middle(mesh, dim, side / (dim + 1), no_corner, here);
    if ((other & ICCP_ON_BOUNDARY) != 0)
        find_middle(mesh, dim, side / (dim + 1), side % (dim + 1), there);
    else
        find_middle(mesh, dim, other / (dim + 1), no_corner, there);
    for (size_t k = 0; k < dim; ++k)
        square += (there[k] - here[k]) * (there[k] - here[k]);
    return iccp_element_area(mesh, side) / iccp_max(sqrt(square), LEAST_LENGTH);
}

double iccp_element_gradients(const iccp_simplices *mesh, size_t simplex, double *gradient)
{
    if (mesh->dim != 3)
        return find_gradients(mesh, mesh->dim, simplex, gradient);
    const double volume = find_gradients_3(mesh, simplex, gradient);
    return volume > 0 ? volume : find_gradients(mesh, 3, simplex, gradient);
}

double iccp_element_area(const iccp_simplices *mesh, size_t side)
{
    return mesh->dim == 3 ? find_area_3(mesh, side) : find_area(mesh, mesh->dim, side);
}

double iccp_element_conductance(const iccp_simplices *mesh, size_t side)
{
    return mesh->dim == 3 ? find_conductance(mesh, 3, side)
                          : find_conductance(mesh, mesh->dim, side);
}
