/* What is made when it is first asked for. */
#include "base/once.h"

#include "../../share.h"
#include "../../suite.h"
#include "../../together.h"

#include <stdlib.h>

static void *make(int number)
{
    int *made = malloc(sizeof *made);
    ck_assert_ptr_nonnull(made);
    *made = number;
    return made;
}

START_TEST(the_first_one_stays)
{
    iccp_once once;
    iccp_once_init(&once);
    ck_assert_ptr_null(iccp_once_get(&once));
    void *first = make(1), *second = make(2);
    ck_assert_ptr_eq(iccp_once_keep(&once, first), first);
    ck_assert_ptr_eq(iccp_once_keep(&once, second), first);
    ck_assert_ptr_eq(iccp_once_get(&once), first);
    free(first);
    free(second);
}
END_TEST

START_TEST(zeros_are_nothing_yet)
{
    iccp_once *once = calloc(1, sizeof *once);
    ck_assert_ptr_nonnull(once);
    ck_assert_ptr_null(iccp_once_get(once));
    free(once);
}
END_TEST

typedef struct asker {
    const iccp_once *once;
    int number, seen;
    bool made, stayed;
} asker;

/* As all users do: whoever finds nothing makes one, and frees it if another stays. */
static void *ask(void *argument)
{
    asker *a = argument;
    const int *known = iccp_once_get(a->once);
    if (known == NULL) {
        int *fresh = make(a->number);
        a->made = true;
        known = iccp_once_keep(a->once, fresh);
        a->stayed = known == fresh;
        if (!a->stayed)
            free(fresh);
    }
    a->seen = *known;
    return iccp_once_get(a->once) == known ? NULL : a;
}

START_TEST(threads_agree)
{
    for (int round = 0; round < share_of(2000); ++round) {
        iccp_once once;
        asker askers[TOGETHER];
        int n_stayed = 0;
        iccp_once_init(&once);
        for (int k = 0; k < TOGETHER; ++k)
            askers[k] = (asker){.once = &once, .number = 100 + k};
        run_together(ask, askers, sizeof *askers);
        int *made = iccp_once_get(&once);
        ck_assert_ptr_nonnull(made);
        for (int k = 0; k < TOGETHER; ++k) {
            ck_assert_int_eq(askers[k].seen, *made);
            ck_assert(!askers[k].stayed || askers[k].number == *made);
            n_stayed += askers[k].stayed;
        }
        ck_assert_int_eq(n_stayed, 1);
        free(made);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("once");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, the_first_one_stays);
    tcase_add_test(tests, zeros_are_nothing_yet);
    tcase_add_test(tests, threads_agree);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
