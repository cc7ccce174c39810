/* Inverses and matrices modulo a prime. */
#include "math/residue.h"

#include <string.h>

uint64_t iccp_residue_inverse(uint64_t a)
{
    uint64_t result = 1;
    for (uint64_t exponent = ICCP_PRIME - 2; exponent > 0; exponent >>= 1) {
        if (exponent & 1)
            result = iccp_residue_multiply(result, a);
        a = iccp_residue_multiply(a, a);
    }
    return result;
}

/* Subtracts `factor` times a row from another one, from column `first` on. */
static void subtract_row(uint64_t *row, const uint64_t *other, uint64_t factor, size_t first,
                         size_t n_columns)
{
    for (size_t c = first; c < n_columns; ++c)
        if (other[c] != 0)
            row[c] = iccp_residue_subtract(row[c], iccp_residue_multiply(factor, other[c]));
}

static void exchange_rows(uint64_t *a, uint64_t *b, size_t n_columns)
{
    for (size_t c = 0; a != b && c < n_columns; ++c) {
        const uint64_t swap = a[c];
        a[c] = b[c];
        b[c] = swap;
    }
}

size_t iccp_residue_reduce(uint64_t *matrix, size_t n_rows, size_t n_columns, uint32_t *pivots)
{
    size_t rank = 0;
    for (size_t c = 0; c < n_columns && rank < n_rows; ++c) {
        uint64_t *const top = matrix + n_columns * rank;
        size_t r = rank;
        while (r < n_rows && matrix[n_columns * r + c] == 0)
            ++r;
        if (r == n_rows)
            continue;
        exchange_rows(top, matrix + n_columns * r, n_columns);
        const uint64_t inverse = iccp_residue_inverse(top[c]);
        for (size_t k = c; k < n_columns; ++k)
            top[k] = iccp_residue_multiply(top[k], inverse);
        for (r = 0; r < n_rows; ++r) {
            uint64_t *const row = matrix + n_columns * r;
            if (r != rank && row[c] != 0)
                subtract_row(row, top, row[c], c, n_columns);
        }
        pivots[rank++] = (uint32_t)c;
    }
    return rank;
}

void iccp_residue_null_space(uint64_t *basis, const uint64_t *matrix, size_t rank, size_t n_columns,
                             const uint32_t *pivots)
{
    memset(basis, 0, (n_columns - rank) * n_columns * sizeof *basis);
    for (size_t c = 0, r = 0; c < n_columns; ++c) {
        if (r < rank && pivots[r] == c) {
            ++r;
            continue;
        }
        for (size_t k = 0; k < rank; ++k)
            basis[pivots[k]] = iccp_residue_subtract(0, matrix[n_columns * k + c]);
        basis[c] = 1;
        basis += n_columns;
    }
}
