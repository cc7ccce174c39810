/* Computes signs of three directions that are never 0. Based on: H. Edelsbrunner, E. P. Mücke,
 * Simulation of Simplicity, ACM Transactions on Graphics 9, 1990. Coordinate c of the vertex of
 * rank r is moved by e to the power 2^(3 r + c). */
#include "match/surface/perturbed.h"

#include "match/surface/direction.h"

#include <stdbool.h>

/* The bits of `code` stand for infinitesimals, and `code` for their product. Finds the column that
 * each row contributes to it, or 3 if it contributes none. Returns false if two come from one row
 * or one column, because the determinant has no such term. */
static bool read_code(unsigned code, unsigned column[3])
{
    unsigned used = 0;
    for (unsigned row = 0; row < 3; ++row, code >>= 3) {
        const unsigned bits = code & 7;
        if ((bits & (bits - 1)) != 0 || (bits & used) != 0)
            return false;
        used |= bits;
        column[row] = bits == 0 ? 3 : bits >> 1;
    }
    return true;
}

/* The sign of the factor that such a product has in the determinant with rows p. The factor is the
 * minor of the rows and columns that contribute nothing, with the sign of its place. */
static int minor_sign(const double *const p[3], unsigned column[3])
{
    unsigned row[3], n = 0;
    bool taken[4] = {false, false, false, false};
    for (unsigned r = 0; r < 3; ++r) {
        taken[column[r]] = true;
        if (column[r] == 3)
            row[n++] = r;
    }
    for (unsigned k = 0, c = 0; k < n; ++k, ++c) {
        while (taken[c])
            ++c;
        column[row[k]] = c;
    }
    const bool odd =
        (column[0] > column[1]) != ((column[0] > column[2]) != (column[1] > column[2]));
    int sign = 1;
    if (n == 1) {
        const double a = p[row[0]][column[row[0]]];
        sign = (a > 0) - (a < 0);
    } else if (n == 2) {
        const double *const a = p[row[0]], *const b = p[row[1]];
        const unsigned i = column[row[0]], j = column[row[1]];
        sign = iccp_cross_sign(a[i], 0, b[j], 0, a[j], 0, b[i], 0);
    }
    return odd ? -sign : sign;
}

int iccp_perturbed_sign(const double *const p[3], const uint32_t number[3])
{
    const int sign = iccp_direction_sign(p[0], p[1], p[2]);
    if (ICCP_LIKELY(sign != 0))
        return sign;
    const double *row[3] = {p[0], p[1], p[2]};
    uint32_t rank[3] = {number[0], number[1], number[2]};
    int order = 1;
    for (int k = 0; k < 3; ++k) { /* 0 1, 1 2, 0 1 */
        const int i = k % 2;
        if (rank[i] > rank[i + 1]) {
            const uint32_t r = rank[i];
            const double *const q = row[i];
            rank[i] = rank[i + 1];
            row[i] = row[i + 1];
            rank[i + 1] = r;
            row[i + 1] = q;
            order = -order;
        }
    }
    /* The product grows as the code falls. A product of three infinitesimals has the factor +1 or
     * -1. */
    for (unsigned code = 1;; ++code) {
        unsigned column[3];
        const int s = read_code(code, column) ? minor_sign(row, column) : 0;
        if (s != 0)
            return order * s;
    }
}
