/* The command writes and reads numbers with the same bytes and bits as printf() and strtod(). */
#include "base/decimal.h"

#include "../random.h"
#include "../share.h"
#include "../suite.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check_written(double value)
{
    char text[DECIMAL_ROOM], wanted[40];
    snprintf(wanted, sizeof wanted, "%.17g", value);
    ck_assert_uint_eq(decimal_write(text, value), strlen(wanted));
    ck_assert_str_eq(text, wanted);
    snprintf(wanted, sizeof wanted, "%.15g", value);
    if (fabs(strtod(wanted, NULL) - value) > 0)
        snprintf(wanted, sizeof wanted, "%.17g", value);
    ck_assert_uint_eq(decimal_write_short(text, value), strlen(wanted));
    ck_assert_str_eq(text, wanted);
}

static void check_read(const char *text)
{
    char *wanted_end;
    const char *end;
    double read = decimal_read(text), wanted = strtod(text, &wanted_end);
    ck_assert_msg(memcmp(&read, &wanted, sizeof read) == 0, "%s: %.17g, not %.17g", text, read,
                  wanted);
    if (decimal_read_plain(text, &end, &read)) {
        ck_assert_mem_eq(&read, &wanted, sizeof read);
        ck_assert_ptr_eq(end, wanted_end);
    }
}

/* Numbers of all sizes, with many and with few digits. */
START_TEST(test_random)
{
    random_source r = {1};
    for (int i = 0, n = share_of(100000); i < n; i++) {
        char text[40];
        double value = random_between(&r, -1, 1) * pow(10, random_between(&r, -7, 20));
        check_written(value);
        snprintf(text, sizeof text, "%.*f", random_below(&r, 16), fmod(value, 1e7));
        check_written(strtod(text, NULL));
        check_read(text);
        snprintf(text, sizeof text, "%.*g", 1 + random_below(&r, 20), value);
        check_read(text);
    }
}
END_TEST

/* Numbers beside powers of ten and of two, and halfway between two decimal numbers. */
START_TEST(test_edges)
{
    for (int power = -30; power < 30; power++)
        for (int side = -2; side <= 2; side++) {
            double ten = pow(10, power), two = pow(2, power);
            check_written(ten * (1 + side * 0x1p-52));
            check_written(two * (1 + side * 0x1p-52));
            check_written(-two * (3 + side * 0x1p-40));
            check_written(side * two + 0x1p-20);
            check_written(1e14 + side + two);
        }
    const double odd[] = {0, -0.0, 999999999999999.5, 99999.99999999999, HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++)
        check_written(odd[i]);
}
END_TEST

START_TEST(test_read_words)
{
    const char *const words[] = {"0",
                                 "-0",
                                 "1.5]",
                                 "-12.25, 3",
                                 "5.",
                                 ".5",
                                 "-.5",
                                 "+1",
                                 "1e5",
                                 "1.5E-3",
                                 "0x10",
                                 "1.2.3",
                                 "9007199254740993",
                                 "0.30000000000000004",
                                 "9007199254740992.5",
                                 "0.00000000000000000000001",
                                 "-",
                                 "",
                                 "e1",
                                 "123456789012345678901234567890",
                                 "inf",
                                 "1e",
                                 "4 5",
                                 "000001.50"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        check_read(words[i]);
    const char *end;
    double value;
    ck_assert(decimal_read_plain("-12.25, 3", &end, &value));
    ck_assert_str_eq(end, ", 3");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("decimal");
    TCase *tests = tcase_create("decimal");
    tcase_add_test(tests, test_random);
    tcase_add_test(tests, test_edges);
    tcase_add_test(tests, test_read_words);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
