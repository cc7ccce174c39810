/* Sorting by keys: their order, the order of equal keys, and keys of numbers. */
#include "base/radix_sort.h"

#include "../random.h"
#include "../suite.h"

#include <check.h>
#include <math.h>

START_TEST(test_order)
{
    enum { MOST = 300 };
    random_source r = {1};
    for (int round = 0; round < 200; round++) {
        keyed list[MOST];
        size_t n = (size_t)random_below(&r, MOST);
        uint64_t mask = random_bits(&r) & random_bits(&r) & random_bits(&r);
        for (size_t i = 0; i < n; i++)
            list[i] = (keyed){random_bits(&r) & mask, (uint32_t)i};
        radix_sort(n, list);
        for (size_t i = 1; i < n; i++)
            ck_assert(list[i - 1].key < list[i].key ||
                      (list[i - 1].key == list[i].key && list[i - 1].item < list[i].item));
    }
}
END_TEST

START_TEST(test_keys)
{
    const double rising[] = {-HUGE_VAL, -1e300, -2, -1, -5e-324, 0, 5e-324, 1, 2, 1e300, HUGE_VAL};
    for (size_t i = 1; i < sizeof rising / sizeof *rising; i++)
        ck_assert(radix_key(rising[i - 1]) < radix_key(rising[i]));
    ck_assert(radix_key(-0.0) == radix_key(0));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("radix_sort");
    TCase *tests = tcase_create("radix_sort");
    tcase_add_test(tests, test_order);
    tcase_add_test(tests, test_keys);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
