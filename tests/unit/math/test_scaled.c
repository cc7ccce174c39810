/* Numbers as fraction and exponent: the two functions that split and join them are those of C. */
#include "../../random.h"
#include "../../suite.h"

#include "math/scaled.h"

#include <check.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

static void check_same(double a, double b)
{
    ck_assert(memcmp(&a, &b, sizeof a) == 0);
}

static void check_number(double x)
{
    int exponent, expected;
    const double fraction = iccp_frexp(x, &exponent);
    check_same(fraction, frexp(x, &expected));
    ck_assert_int_eq(exponent, expected);
    for (int32_t shift = -1080; shift <= 1040; shift += 1 + (shift > -1000 && shift < 1000) * 7) {
        check_same(iccp_ldexp(fraction, shift), ldexp(fraction, shift));
        check_same(iccp_ldexp(1.999 * fraction, shift), ldexp(1.999 * fraction, shift));
    }
}

START_TEST(numbers_are_split_and_joined_as_in_c)
{
    static const double SPECIAL[] = {0,       DBL_MIN, DBL_MIN / 2, DBL_TRUE_MIN,
                                     DBL_MAX, 1,       0.5,         1 - DBL_EPSILON / 2};
    for (size_t i = 0; i < sizeof SPECIAL / sizeof *SPECIAL; ++i) {
        check_number(SPECIAL[i]);
        check_number(-SPECIAL[i]);
    }
    random_source r = {1};
    for (int k = 0; k < 1000; ++k)
        check_number(ldexp(random_between(&r, -1, 1), (int)random_between(&r, -1074, 1024)));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("scaled");
    TCase *numbers = tcase_create("numbers");
    tcase_add_test(numbers, numbers_are_split_and_joined_as_in_c);
    suite_add_tcase(suite, numbers);
    return suite_run(suite);
}
