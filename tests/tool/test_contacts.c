/* Points near segments are found wherever they crowd, and layers whose polygons share sides are told
 * from others. */
#include "geo/contacts.h"
#include "geo/near_sides.h"

#include "../random.h"
#include "../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 400 };

typedef struct found {
    size_t n;
    size_t times[N][N]; /* of each point and item */
} found;

static bool count_pair(void *context, uint32_t point, size_t item)
{
    found *f = context;
    f->times[point][item]++;
    f->n++;
    return true;
}

static double distance_to(const double *a, const double *b, const double *p)
{
    double dx = b[0] - a[0], dy = b[1] - a[1];
    double t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy);
    t = t > 0 ? (t < 1 ? t : 1) : 0;
    return hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

/* Compares the pairs with those of all points and items. */
static void check_pairs(const double *points, const near_item *items, double near)
{
    found *f = calloc(1, sizeof *f);
    bool asked[N] = {false};
    near_sides(N, items, N, points, near, count_pair, f);
    for (size_t i = 0; i < N; i++)
        asked[items[i].a] = true;
    for (size_t p = 0; p < N; p++)
        for (size_t i = 0; i < N; i++) {
            near_item item = items[i];
            bool apart = item.a != item.b && item.a != p && item.b != p && asked[p];
            double off = apart ? distance_to(points + 2 * (size_t)item.a,
                                             points + 2 * (size_t)item.b, points + 2 * p)
                               : HUGE_VAL;
            ck_assert_uint_le(f->times[p][i], off <= 2 * near);
            if (off < near)
                ck_assert_uint_eq(f->times[p][i], 1);
        }
    free(f);
}

/* Short segments and long ones, spread evenly or in clusters within clusters. */
START_TEST(test_pairs)
{
    random_source r = {7};
    for (int round = 0; round < 40; round++) {
        double points[2 * N], spread = round % 4;
        near_item items[N];
        for (size_t i = 0; i < 2 * N; i++)
            points[i] = random_between(&r, -1, 1) * pow(10, -spread * random_below(&r, 4));
        for (uint32_t i = 0; i < N; i++) {
            items[i] = (near_item){i, (i + 1) % N};
            if (round % 3 != 0 && i % 8 != 0) {
                points[2 * i] = points[2 * i - 2] + random_between(&r, -0.01, 0.01);
                points[2 * i + 1] = points[2 * i - 1] + random_between(&r, -0.01, 0.01);
            }
            if (random_below(&r, 10) == 0)
                items[i].b = i;
            if (random_below(&r, 10) == 0)
                items[i].a = (uint32_t)random_below(&r, N);
        }
        check_pairs(points, items, round % 2 == 0 ? 0.003 : 0.1);
    }
}
END_TEST

/* Two rings or lines of five positions each. */
static bool may_share(const double *first, const double *second, uint32_t polygon)
{
    double points[20];
    const layer_path paths[] = {{0, 5, 1}, {5, 5, polygon}};
    memcpy(points, first, 10 * sizeof *points);
    memcpy(points + 10, second, 10 * sizeof *points);
    return contacts_may_share(10, points, 2, paths, 1e-9);
}

START_TEST(test_contacts)
{
    const double square[] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0};
    const double beside[] = {1, 0, 2, 0, 2, 1, 1, 1, 1, 0};
    const double along[] = {1, 0.25, 2, 0, 2, 1, 1, 0.75, 1, 0.25};
    const double past[] = {1, 0.5, 2, 0, 2, 2, 1, 2, 1, 0.5};
    const double nearly[] = {1 + 1e-10, 1, 2, 1, 2, 2, 1, 2, 1 + 1e-10, 1};
    const double corner[] = {1, 1, 2, 1, 2, 2, 1, 2, 1, 1};
    const double tip[] = {1, 0.5, 2, 0, 2, 1, 2, 2, 1, 0.5};
    const double crossing[] = {0.5, 0.5, 2, 0.5, 2, 2, 0.5, 2, 0.5, 0.5};
    const double apart[] = {3, 0, 4, 0, 4, 1, 3, 1, 3, 0};
    ck_assert(may_share(square, beside, 2));
    ck_assert(may_share(square, along, 2));
    ck_assert(may_share(along, square, 2));
    ck_assert(may_share(square, past, 2));
    ck_assert(may_share(square, nearly, 2)); /* welding would change what is shared */
    ck_assert(!may_share(square, corner, 2));
    ck_assert(!may_share(square, tip, 2));
    ck_assert(!may_share(tip, square, 2));
    ck_assert(!may_share(square, crossing, 2));
    ck_assert(!may_share(square, apart, 2));
    ck_assert(!may_share(square, beside, 1));
    ck_assert(!may_share(square, beside, NO_POLYGON));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("contacts");
    TCase *tests = tcase_create("contacts");
    tcase_add_test(tests, test_pairs);
    tcase_add_test(tests, test_contacts);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
