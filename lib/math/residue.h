/* Arithmetic modulo the prime 2^61 - 1, and small matrices of residues. */
#ifndef ICCP_RESIDUE_H
#define ICCP_RESIDUE_H

#include "base/compiler.h"

#include <stddef.h>
#include <stdint.h>

/* The ninth Mersenne prime. Residues are less than it. */
#define ICCP_PRIME (((uint64_t)1 << 61) - 1)

static ICCP_INLINE uint64_t iccp_residue_add(uint64_t a, uint64_t b)
{
    const uint64_t sum = a + b;
    return sum >= ICCP_PRIME ? sum - ICCP_PRIME : sum;
}

static ICCP_INLINE uint64_t iccp_residue_subtract(uint64_t a, uint64_t b)
{
    return a >= b ? a - b : a + (ICCP_PRIME - b);
}

/* Multiplies halves of 32 bits. The product is high 2^64 + middle 2^32 + low, where 2^61 counts as
 * 1. */
static ICCP_INLINE uint64_t iccp_residue_multiply(uint64_t a, uint64_t b)
{
    const uint64_t low_bits = UINT32_MAX, a_low = a & low_bits, b_low = b & low_bits;
    const uint64_t a_high = a >> 32, b_high = b >> 32;
    const uint64_t middle = a_high * b_low + a_low * b_high, low = a_low * b_low;
    const uint64_t sum = (a_high * b_high << 3) + (middle >> 29) +
                         ((middle & (((uint64_t)1 << 29) - 1)) << 32) + (low >> 61) +
                         (low & ICCP_PRIME);
    const uint64_t folded = (sum >> 61) + (sum & ICCP_PRIME);
    return folded >= ICCP_PRIME ? folded - ICCP_PRIME : folded;
}

/* Returns 1 / a for a residue that is not 0: a^(p - 2), by P. de Fermat. */
uint64_t iccp_residue_inverse(uint64_t a);

/* Brings a matrix, row by row, into reduced row echelon form. Row r then begins with a 1 in column
 * pivots[r], and this column has zeros elsewhere. Returns the rank r. Rows from r on are zero.
 * `pivots` has room for as many columns as there are rows. */
size_t iccp_residue_reduce(uint64_t *matrix, size_t n_rows, size_t n_columns, uint32_t *pivots);

/* Writes a basis of the vectors x with M x = 0 for a reduced matrix of this rank. There are
 * n_columns - rank vectors of n_columns residues each. `pivots` ascend. */
void iccp_residue_null_space(uint64_t *basis, const uint64_t *matrix, size_t rank, size_t n_columns,
                             const uint32_t *pivots);

#endif
