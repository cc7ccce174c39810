/* What tests/unit uses of Check, for a machine without processes: the tests of a program run one after
 * another, and the first assertion that fails ends it. */
#ifndef TESTS_PLAIN_CHECK_H
#define TESTS_PLAIN_CHECK_H

#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CK_NORMAL 0

enum { CHECK_MOST = 256 };

typedef void check_function(int);

typedef struct TCase {
    int n;
    struct {
        check_function *run;
        const char *name;
        int from, to;
    } tests[CHECK_MOST];
} TCase;

typedef struct Suite {
    int n;
    TCase *cases[CHECK_MOST];
} Suite;

typedef struct SRunner {
    Suite *suite;
} SRunner;

static const char *check_running = "";

static inline void *check_zeros(size_t size)
{
    void *zeros = calloc(1, size);
    if (zeros == NULL)
        exit(EXIT_FAILURE);
    return zeros;
}

static inline Suite *suite_create(const char *name)
{
    (void)name;
    return check_zeros(sizeof(Suite));
}

static inline TCase *tcase_create(const char *name)
{
    (void)name;
    return check_zeros(sizeof(TCase));
}

static inline SRunner *srunner_create(Suite *suite)
{
    SRunner *runner = check_zeros(sizeof *runner);
    runner->suite = suite;
    return runner;
}

static inline void suite_add_tcase(Suite *suite, TCase *added)
{
    suite->cases[suite->n++] = added;
}

static inline void tcase_set_timeout(TCase *of, double seconds)
{
    (void)of;
    (void)seconds;
}

static inline void check_add(TCase *to, check_function *run, const char *name, int from, int until)
{
    if (to->n == CHECK_MOST)
        exit(EXIT_FAILURE);
    to->tests[to->n].run = run;
    to->tests[to->n].name = name;
    to->tests[to->n].from = from;
    to->tests[to->n++].to = until;
}

static inline void srunner_run_all(SRunner *runner, int how)
{
    int n = 0;
    (void)how;
    for (int c = 0; c < runner->suite->n; ++c) {
        const TCase *of = runner->suite->cases[c];
        for (int t = 0; t < of->n; ++t)
            for (int i = of->tests[t].from; i < of->tests[t].to; ++i, ++n) {
                check_running = of->tests[t].name;
                of->tests[t].run(i);
            }
    }
    (void)printf("%d tests passed\n", n);
    if (n == 0)
        exit(EXIT_FAILURE);
}

/* A test that fails does not come back. */
static inline int srunner_ntests_failed(const SRunner *runner)
{
    (void)runner;
    return 0;
}

static inline void srunner_free(SRunner *runner)
{
    for (int c = 0; c < runner->suite->n; ++c)
        free(runner->suite->cases[c]);
    free(runner->suite);
    free(runner);
}

#define START_TEST(name)                                                                           \
    static void name(int _i)                                                                       \
    {                                                                                              \
        (void)_i;
#define END_TEST }

#define tcase_add_test(to, run) check_add(to, run, #run, 0, 1)
#define tcase_add_loop_test(to, run, from, until) check_add(to, run, #run, from, until)

/* Some tests have a variable `exit`. */
_Noreturn static inline void check_stop(void)
{
    exit(EXIT_FAILURE);
}

#define check_fail(...)                                                                            \
    ((void)printf("%s:%d: %s: ", __FILE__, __LINE__, check_running), (void)printf(__VA_ARGS__),    \
     (void)printf("\n"), check_stop())

#define ck_abort() check_fail("aborted")
#define ck_abort_msg(...) check_fail(__VA_ARGS__)
#define ck_assert_msg(truth, ...)                                                                  \
    do {                                                                                           \
        if (!(truth))                                                                              \
            check_fail(__VA_ARGS__);                                                               \
    } while (0)
#define ck_assert(truth) ck_assert_msg(truth, "%s", #truth)

#define check_compare(type, format, a, op, b)                                                      \
    do {                                                                                           \
        const type check_a = (type)(a), check_b = (type)(b);                                       \
        if (!(check_a op check_b))                                                                 \
            check_fail("%s %s %s: %" format ", %" format, #a, #op, #b, check_a, check_b);          \
    } while (0)
#define ck_assert_int_eq(a, b) check_compare(intmax_t, PRIdMAX, a, ==, b)
#define ck_assert_int_ne(a, b) check_compare(intmax_t, PRIdMAX, a, !=, b)
#define ck_assert_int_gt(a, b) check_compare(intmax_t, PRIdMAX, a, >, b)
#define ck_assert_int_ge(a, b) check_compare(intmax_t, PRIdMAX, a, >=, b)
#define ck_assert_int_lt(a, b) check_compare(intmax_t, PRIdMAX, a, <, b)
#define ck_assert_int_le(a, b) check_compare(intmax_t, PRIdMAX, a, <=, b)
#define ck_assert_uint_eq(a, b) check_compare(uintmax_t, PRIuMAX, a, ==, b)
#define ck_assert_uint_ne(a, b) check_compare(uintmax_t, PRIuMAX, a, !=, b)
#define ck_assert_uint_gt(a, b) check_compare(uintmax_t, PRIuMAX, a, >, b)
#define ck_assert_uint_ge(a, b) check_compare(uintmax_t, PRIuMAX, a, >=, b)
#define ck_assert_uint_lt(a, b) check_compare(uintmax_t, PRIuMAX, a, <, b)
#define ck_assert_uint_le(a, b) check_compare(uintmax_t, PRIuMAX, a, <=, b)
#define ck_assert_double_eq(a, b) check_compare(double, ".17g", a, ==, b)
#define ck_assert_double_gt(a, b) check_compare(double, ".17g", a, >, b)
#define ck_assert_double_ge(a, b) check_compare(double, ".17g", a, >=, b)
#define ck_assert_double_lt(a, b) check_compare(double, ".17g", a, <, b)
#define ck_assert_double_le(a, b) check_compare(double, ".17g", a, <=, b)
#define ck_assert_double_eq_tol(a, b, tolerance)                                                   \
    check_compare(double, ".17g", fabs((a) - (b)), <, tolerance)
#define ck_assert_ptr_eq(a, b) ck_assert_msg((a) == (b), "%s is not %s", #a, #b)
#define ck_assert_ptr_null(p) ck_assert_msg((p) == NULL, "%s is not NULL", #p)
#define ck_assert_ptr_nonnull(p) ck_assert_msg((p) != NULL, "%s is NULL", #p)
#define ck_assert_mem_eq(a, b, n) ck_assert_msg(memcmp(a, b, n) == 0, "%s is not %s", #a, #b)
#define ck_assert_str_eq(a, b) ck_assert_msg(strcmp(a, b) == 0, "\"%s\" is not \"%s\"", a, b)
#define ck_assert_str_ne(a, b) ck_assert_msg(strcmp(a, b) != 0, "%s is %s", #a, #b)

#endif
