/* A point of all half-spaces is found however thin what they have in common is, and none where they
 * have nothing in common. */
#include "../../../random.h"
#include "../../../suite.h"
#include "map/solid/halfspaces.h"
#include "math/vec.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

enum { SIDES = 40, ROUNDS = 200 };

/* Normals point inwards from as far off as `radius`; and two more, across, leave `thickness`. */
static void make_slice(iccp_halfspaces *h, random_source *r, double thickness)
{
    double across[3], middle[3];
    ck_assert(iccp_halfspaces_reserve(h, SIDES + 2));
    h->n = 0;
    for (int k = 0; k < 3; ++k) {
        across[k] = random_between(r, -1, 1);
        middle[k] = random_between(r, -0.3, 0.3);
    }
    for (int i = 0; i < SIDES + 2; ++i) {
        iccp_halfspace *half = &h->item[h->n++];
        double radius = random_between(r, 0.5, 1);
        for (int k = 0; k < 3; ++k)
            half->normal[k] = i < SIDES    ? random_between(r, -1, 1)
                              : i == SIDES ? across[k]
                                           : -across[k];
        if (i < 6) /* bounded: the faces of a cube */
            for (int k = 0; k < 3; ++k)
                half->normal[k] = k == i / 2 ? (i % 2 == 0 ? 1 : -1) : 0;
        if (i >= SIDES)
            radius = thickness / 2;
        const double length = iccp_vec_norm(3, half->normal);
        for (int k = 0; k < 3; ++k)
            half->normal[k] /= length;
        half->offset = iccp_vec_dot(3, half->normal, middle) - radius;
    }
}

static double least_distance(const iccp_halfspaces *h, const double *x)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < h->n; ++i)
        least = fmin(least, iccp_vec_dot(3, h->item[i].normal, x) - h->item[i].offset);
    return least;
}

/* Whether a point is found, from one far off. */
static bool enters(iccp_halfspaces *h, random_source *r, double thickness)
{
    double x[3];
    make_slice(h, r, thickness);
    for (int k = 0; k < 3; ++k)
        x[k] = random_between(r, -2, 2);
    const bool entered = iccp_halfspaces_enter(h, x);
    ck_assert(!entered || least_distance(h, x) > 0.1 * thickness);
    return entered;
}

START_TEST(thin)
{
    iccp_halfspaces h = {.memory = iccp_memory_default};
    random_source r = {1};
    for (int k = 0; k < ROUNDS; ++k)
        ck_assert_msg(enters(&h, &r, pow(10, -random_between(&r, 0, 12))), "round %d", k);
    iccp_halfspaces_free(&h);
}
END_TEST

START_TEST(empty)
{
    iccp_halfspaces h = {.memory = iccp_memory_default};
    random_source r = {2};
    for (int k = 0; k < ROUNDS; ++k)
        ck_assert_msg(!enters(&h, &r, -pow(10, -random_between(&r, 0, 12))), "round %d", k);
    iccp_halfspaces_free(&h);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("half-spaces");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, thin);
    tcase_add_test(tests, empty);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
