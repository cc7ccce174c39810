/* Arithmetic modulo a prime against GMP's integers, and matrices of residues. */
#include "../../random.h"
#include "../../suite.h"
#include "math/residue.h"

#include <check.h>
#include <gmp.h>
#include <string.h>

enum { N = 20000, MOST = 12 };

static uint64_t residue(random_source *r)
{
    static const uint64_t hard[] = {0, 1, 2, ICCP_PRIME - 1, ICCP_PRIME - 2, UINT32_MAX};
    const int k = random_below(r, 16);
    return k < 6 ? hard[k] : random_bits(r) % ICCP_PRIME;
}

static void set(mpz_t z, uint64_t x)
{
    mpz_import(z, 1, -1, sizeof x, 0, 0, &x);
}

START_TEST(test_arithmetic)
{
    random_source r = {1};
    mpz_t a, b, c, p;
    mpz_inits(a, b, c, p, NULL);
    set(p, ICCP_PRIME);
    ck_assert_int_ne(mpz_probab_prime_p(p, 25), 0);
    for (int i = 0; i < N; ++i) {
        const uint64_t x = residue(&r), y = residue(&r);
        const uint64_t results[3] = {iccp_residue_add(x, y), iccp_residue_subtract(x, y),
                                     iccp_residue_multiply(x, y)};
        set(a, x);
        set(b, y);
        for (int k = 0; k < 3; ++k) {
            if (k == 0)
                mpz_add(c, a, b);
            else if (k == 1)
                mpz_sub(c, a, b);
            else
                mpz_mul(c, a, b);
            mpz_mod(c, c, p);
            set(a, results[k]);
            ck_assert_int_eq(mpz_cmp(c, a), 0);
            set(a, x);
        }
        if (x != 0)
            ck_assert_uint_eq(iccp_residue_multiply(x, iccp_residue_inverse(x)), 1);
    }
    mpz_clears(a, b, c, p, NULL);
}
END_TEST

/* Products of random matrices have the rank of their inner size, and null vectors are null. */
START_TEST(test_matrices)
{
    random_source r = {2};
    for (int i = 0; i < N / 100; ++i) {
        const size_t n = 1 + (size_t)random_below(&r, MOST), m = 1 + (size_t)random_below(&r, MOST);
        const size_t least = n < m ? n : m, rank = (size_t)random_below(&r, (int)least + 1);
        uint64_t matrix[MOST * MOST], given[MOST * MOST], basis[MOST * MOST];
        uint64_t left[MOST * MOST], right[MOST * MOST];
        uint32_t pivots[MOST];
        for (size_t k = 0; k < n * rank; ++k)
            left[k] = random_bits(&r) % ICCP_PRIME;
        for (size_t k = 0; k < rank * m; ++k)
            right[k] = random_bits(&r) % ICCP_PRIME;
        for (size_t k = 0; k < n * m; ++k) {
            given[k] = 0;
            for (size_t j = 0; j < rank; ++j)
                given[k] =
                    iccp_residue_add(given[k], iccp_residue_multiply(left[rank * (k / m) + j],
                                                                     right[m * j + k % m]));
        }
        memcpy(matrix, given, n * m * sizeof *matrix);
        ck_assert_uint_eq(iccp_residue_reduce(matrix, n, m, pivots), rank);
        iccp_residue_null_space(basis, matrix, rank, m, pivots);
        for (size_t k = 0; k < (m - rank) * n; ++k) {
            uint64_t sum = 0;
            for (size_t j = 0; j < m; ++j)
                sum = iccp_residue_add(
                    sum, iccp_residue_multiply(given[m * (k % n) + j], basis[m * (k / n) + j]));
            ck_assert_uint_eq(sum, 0);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("residue");
    TCase *tc = tcase_create("residue");
    tcase_add_test(tc, test_arithmetic);
    tcase_add_test(tc, test_matrices);
    suite_add_tcase(suite, tc);
    return suite_run(suite);
}
