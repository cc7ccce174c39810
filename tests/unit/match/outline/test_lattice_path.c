/* Paths through lattices: of least cost, of known steps, in memory of their own. */
#include "match/outline/lattice_path.h"

#include "../../../faulty.h"
#include "../../../random.h"
#include "../../../suite.h"

#include <math.h>

enum { MOST = 64 };

typedef struct fixture {
    faulty counts;
    icc_env with;
    iccp_env env;
    int32_t n;
    float cost[(MOST + 1) * (2 * MOST + 1)];
    iccp_lattice lattice;
    iccp_lattice_path paths[MOST];
    int32_t points[MOST][2 * (2 * MOST + 1)];
} fixture;

static fixture f;

static void begin(int32_t n)
{
    f.counts = (faulty){0};
    f.with = faulty_env(&f.counts);
    f.with.progress = NULL;
    ck_assert_int_eq(iccp_env_read(&f.env, &f.with, NULL), ICC_OK);
    f.n = n;
    ck_assert_int_eq(iccp_lattice_create(&f.lattice, n, &f.env.memory), ICC_OK);
    for (int32_t k = 0; k < n; ++k)
        f.paths[k] = (iccp_lattice_path){.points = f.points[k], .cost = HUGE_VAL};
}

static void end(void)
{
    iccp_lattice_free(&f.lattice, &f.env.memory);
    ck_assert_uint_eq(f.counts.n_live, 0);
}

static float *cost_at(int32_t i, int32_t j)
{
    return &f.cost[(size_t)i * (2 * (size_t)f.n + 1) + (size_t)j];
}

/* A path goes from its start to the same place one round later, forward and by short steps. */
static void check_path(int32_t first)
{
    const iccp_lattice_path *const p = &f.paths[first];
    ck_assert_int_ge(p->n_points, 2);
    ck_assert_int_le(p->n_points, 2 * f.n + 1);
    ck_assert(p->points[0] == 0 && p->points[1] == first);
    const int32_t *const last = p->points + 2 * (p->n_points - 1);
    ck_assert(last[0] == f.n && last[1] == first + f.n);
    for (int32_t k = 1; k < p->n_points; ++k) {
        const int32_t di = p->points[2 * k] - p->points[2 * k - 2];
        const int32_t dj = p->points[2 * k + 1] - p->points[2 * k - 1];
        ck_assert(di >= 0 && dj >= 0 && di + dj > 0 && di <= 5 && dj <= 5);
    }
}

/* Steps of several rows and a column, then a way along one row: the rows between paths are as wide
 * as they can be, those that path 0 passes over and the one along which it goes. */
START_TEST(wide_rows_stay_within_their_memory)
{
    for (int32_t n = 32; n <= MOST; n *= 2) {
        begin(n);
        for (size_t k = 0; k < sizeof f.cost / sizeof *f.cost; ++k)
            f.cost[k] = 100;
        const int32_t row = 5 * ((n - 1) / 5);
        for (int32_t turn = 0; turn <= n; turn += n) {
            for (int32_t i = 0; i < row; ++i)
                *cost_at(i, i / 5 + turn) = *cost_at(i, (i + 4) / 5 + turn) = 0;
            for (int32_t j = row / 5; j <= row; ++j)
                *cost_at(row, j + turn) = 0;
            for (int32_t i = row; i <= n; ++i)
                *cost_at(i, i + turn) = 0;
        }
        ck_assert_int_eq(iccp_lattice_cyclic(f.paths, &f.lattice, n, f.cost, 1, &f.env), ICC_OK);
        check_path(0);
        int32_t n_along = 0, n_over = 0;
        for (int32_t k = 1; k < f.paths[0].n_points; ++k) {
            const int32_t di = f.paths[0].points[2 * k] - f.paths[0].points[2 * k - 2];
            n_along += di == 0;
            n_over += di > 1 ? di - 1 : 0;
        }
        ck_assert_int_gt(n_along + n_over, n + 1);
        for (int32_t first = 1; first < n; ++first)
            if (f.paths[first].n_points > 0)
                check_path(first);
        end();
    }
}
END_TEST

START_TEST(random_costs)
{
    random_source r = {.state = 7};
    for (int times = 0; times < 200; ++times) {
        begin(MOST);
        const double rough = random_between(&r, 1, 12);
        for (int32_t i = 0; i <= MOST; ++i)
            for (int32_t j = 0; j <= 2 * MOST; ++j)
                *cost_at(i, j) = (float)pow(random_unit(&r), rough);
        ck_assert_int_eq(iccp_lattice_cyclic(f.paths, &f.lattice, MOST, f.cost, 1, &f.env), ICC_OK);
        check_path(0);
        for (int32_t first = 1; first < MOST; ++first)
            if (f.paths[first].n_points > 0)
                check_path(first);
        end();
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lattice path");
    TCase *tcase = tcase_create("paths");
    tcase_add_test(tcase, wide_rows_stay_within_their_memory);
    tcase_add_test(tcase, random_costs);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
