/* Computes elements, Jacobians and energies of simplices that are nearly flat. All that could
 * cancel is summed without rounding errors (math/expansion.h). */
#include "map/energy/flat_simplex.h"

#include "math/expansion.h"

/* h = the cofactor of coordinate c of the edge from corner 0 to corner k. h has room for 16
 * components. Returns the length. */
static size_t find_cofactor(size_t dim, const double *const *p, size_t k, size_t c, double *h)
{
    if (dim == 2) {
        const double *a = p[3 - k], sign = k == 1 + c ? 1 : -1;
        return iccp_expansion_two_sum(h, sign * a[1 - c], -sign * p[0][1 - c]);
    }
    const double *a = p[1 + k % 3], *b = p[1 + (k + 1) % 3], *o = p[0];
    const size_t d = (c + 1) % 3, e = (c + 2) % 3;
    double left[8], right[8];
    const size_t n_left = iccp_expansion_product_of_differences(left, a[d], o[d], b[e], o[e]);
    const size_t n_right = /* subtracted */
        iccp_expansion_product_of_differences(right, o[e], a[e], b[d], o[d]);
    return iccp_expansion_sum(h, n_left, left, n_right, right);
}

/* Returns row r and column c of the Jacobian of the map from p to q, times the determinant of the
 * edges of p. */
static double find_entry(size_t dim, const double *const *p, const double *const *q, size_t r,
                         size_t c)
{
    double sum[2][3 * 64];
    size_t n_sum = 0;
    for (size_t k = 1; k <= dim; ++k) {
        double cofactor[16], low[32], high[32], term[64], tail;
        const double difference = iccp_two_sum(q[k][r], -q[0][r], &tail);
        const size_t n = find_cofactor(dim, p, k, c, cofactor);
        const size_t n_low = iccp_expansion_scale(low, n, cofactor, tail);
        const size_t n_high = iccp_expansion_scale(high, n, cofactor, difference);
        const size_t n_term = iccp_expansion_sum(term, n_low, low, n_high, high);
        n_sum = iccp_expansion_sum(sum[k % 2], n_sum, sum[1 - k % 2], n_term, term);
    }
    return iccp_expansion_estimate(n_sum, sum[dim % 2]);
}

/* The map of a simplex to itself has the Jacobian 1. */
static double find_determinant(size_t dim, const double *const *corner)
{
    return find_entry(dim, corner, corner, 0, 0);
}

void iccp_flat_element(size_t dim, const double *const *corner, double *element)
{
    const double det = find_determinant(dim, corner);
    double *gradient = element + 1;
    element[0] = det / (dim == 2 ? 2 : 6);
    for (size_t c = 0; c < dim; ++c) {
        gradient[c] = 0;
        for (size_t k = 1; k <= dim; ++k) {
            double cofactor[16];
            const size_t n = find_cofactor(dim, corner, k, c, cofactor);
            gradient[dim * k + c] = iccp_expansion_estimate(n, cofactor) / det;
            gradient[c] -= gradient[dim * k + c];
        }
    }
}

void iccp_flat_jacobian(size_t dim, const double *const *corner, const double *const *image,
                        double *jacobian)
{
    const double det = find_determinant(dim, corner);
    for (size_t r = 0; r < dim; ++r)
        for (size_t c = 0; c < dim; ++c)
            jacobian[dim * r + c] = find_entry(dim, corner, image, r, c) / det;
}

/* Multiplied by the measure first, squares do not overflow. */
double iccp_flat_energy(size_t dim, const double *const *corner, double stretch,
                        const double *const *image)
{
    const double det = find_determinant(dim, corner);
    const double measure = det * stretch * stretch * (dim == 2 ? 0.5 : stretch / 6);
    double there[9], back[9], sum = 0;
    iccp_flat_jacobian(dim, corner, image, there);
    iccp_flat_jacobian(dim, image, corner, back);
    for (size_t i = 0; i < dim * dim; ++i) {
        const double a = there[i] / stretch, b = back[i] * stretch;
        sum += measure * a * a + measure * b * b;
    }
    return sum;
}
