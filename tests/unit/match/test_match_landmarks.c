/* Landmarks of two surfaces, as people give them: few, in a mirrored order, joined by an edge, all vertices. Each
 * problem is solved with every landmark bit by bit, or refused by the number of one. */
#include <icc/icc.h>

#include "../../share.h"
#include "../../suite.h"
#include "../../surface_domains.h"
#include "../../surfaces.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>

enum { MOST = 128 };

static surface one, two;

/* An egg with a bump off its axes, so that no turn and no mirror image is like it. */
static void egg(surface *s, int splits, double turn)
{
    surface_octahedron(s);
    for (int i = 0; i < splits; ++i)
        surface_split(s);
    for (size_t v = 0; v < s->n_vertices; ++v) {
        double *const p = s->vertices + 3 * v, r = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        const double x = (cos(turn) * p[0] - sin(turn) * p[1]) / r, z = p[2] / r;
        const double y = (sin(turn) * p[0] + cos(turn) * p[1]) / r;
        const double more = 1 + .5 * exp(4 * (.6 * x + .64 * y + .48 * z) - 4);
        p[0] = more * x;
        p[1] = .8 * more * (cos(turn) * y - sin(turn) * z);
        p[2] = .6 * more * (sin(turn) * y + cos(turn) * z);
    }
}

/* The landmarks are vertices of both results, in one place of their lists. */
static void check_landmarks(const icc_match *match, size_t n, const double *landmarks)
{
    icc_match_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    ck_assert_uint_eq(info.n_landmarks, n);
    double *const x[2] = {malloc(3 * info.n_vertices * sizeof(double)),
                          malloc(3 * info.n_vertices * sizeof(double))};
    ck_assert(x[0] != NULL && x[1] != NULL);
    ck_assert_int_eq(icc_domain_get_boundary(icc_match_source(match), x[0], NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_get_boundary(icc_match_target(match), x[1], NULL), ICC_OK);
    for (size_t k = 0; k < n; ++k) {
        size_t n_found = 0;
        for (size_t v = 0; v < info.n_vertices; ++v)
            n_found += memcmp(x[0] + 3 * v, landmarks + 6 * k, 3 * sizeof **x) == 0 &&
                       memcmp(x[1] + 3 * v, landmarks + 6 * k + 3, 3 * sizeof **x) == 0;
        ck_assert_uint_eq(n_found, 1);
    }
    free(x[0]);
    free(x[1]);
}

/* The energy, or HUGE_VAL where landmarks are so that paths between them find no room. */
static double match_at(size_t n, const uint32_t *const at[2])
{
    double landmarks[6 * MOST];
    icc_domain *const source = domain_of_surface(&one), *const target = domain_of_surface(&two);
    icc_match *match = NULL;
    icc_match_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    for (size_t k = 0; k < n; ++k) {
        memcpy(landmarks + 6 * k, one.vertices + 3 * (size_t)at[0][k], 3 * sizeof *landmarks);
        memcpy(landmarks + 6 * k + 3, two.vertices + 3 * (size_t)at[1][k], 3 * sizeof *landmarks);
    }
    const icc_status status =
        icc_match_create(&match, source, target, n, landmarks, NULL, NULL, &err);
    if (status == ICC_OK) {
        check_landmarks(match, n, landmarks);
        ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    } else {
        ck_assert_msg(status == ICC_ERR_RESOLUTION, "%s", err.message);
        ck_assert_ptr_null(match);
        info.energy = HUGE_VAL;
    }
    icc_match_free(match);
    icc_domain_free(source);
    icc_domain_free(target);
    return info.energy;
}

/* The vertex that is nearest to one of the other surface. */
static uint32_t partner_of(uint32_t v)
{
    double least = HUGE_VAL;
    uint32_t best = 0;
    for (uint32_t w = 0; w < two.n_vertices; ++w) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            const double d = two.vertices[3 * w + (size_t)k] - one.vertices[3 * v + (size_t)k];
            sum += d * d;
        }
        if (sum < least) {
            least = sum;
            best = w;
        }
    }
    return best;
}

START_TEST(one_to_three)
{
    random_source r = {5};
    egg(&one, 2, 0);
    egg(&two, 2, .4);
    for (int trial = 0; trial < share_of(3); ++trial)
        for (size_t n = 1; n <= 3; ++n) {
            uint32_t at[2][3] = {{0}};
            for (size_t k = 0; k < n; ++k) { /* far from the others, each at its own vertex */
                at[0][k] = (uint32_t)(k * 22 + (size_t)random_below(&r, 22));
                at[1][k] = partner_of(at[0][k]);
            }
            const double energy = match_at(n, (const uint32_t *const[]){at[0], at[1]});
            ck_assert_double_lt(energy, 5);
            /* Elsewhere they are in their places, whatever that costs. */
            at[1][0] = (at[1][0] + 31) % (uint32_t)two.n_vertices;
            for (size_t k = 1; k < n; ++k)
                while (at[1][k] == at[1][0] || (k == 2 && at[1][2] == at[1][1]))
                    at[1][k] = (at[1][k] + 1) % (uint32_t)two.n_vertices;
            ck_assert(isfinite(match_at(n, (const uint32_t *const[]){at[0], at[1]})));
        }
}
END_TEST

/* No fair map has these; they are matched, and the energy says so. */
START_TEST(mirrored)
{
    uint32_t at[2][12];
    egg(&one, 2, 0);
    egg(&two, 2, .4);
    const size_t step = test_share() < 100 ? 3 : 1;
    for (size_t n = 4; n <= 12; n += step) {
        for (uint32_t k = 0; k < n; ++k) {
            at[0][k] = k;
            at[1][k] = k ^ 1; /* the octahedron's corners change sides */
        }
        if (n % 2 == 1)
            at[1][n - 1] = (uint32_t)n - 1;
        const double energy = match_at(n, (const uint32_t *const[]){at[0], at[1]});
        ck_assert_double_gt(energy, 4.1);
    }
}
END_TEST

/* On both sides, or on one. */
START_TEST(joined_by_an_edge)
{
    egg(&one, 2, 0);
    egg(&two, 2, .4);
    const size_t step = test_share() < 100 ? 51 : 17;
    for (size_t f = 0; f < one.n_faces; f += step)
        for (int side = 0; side < 3; ++side) {
            const uint32_t *const a = one.faces + 3 * f, *const b = two.faces + 3 * f;
            const uint32_t at[2][5] = {{a[0], a[1], a[2], (a[0] + 30) % 66, (a[0] + 45) % 66},
                                       {b[0], b[1], b[2], (b[0] + 30) % 66, (b[0] + 45) % 66}};
            const uint32_t apart[2][5] = {
                {a[0], (a[0] + 12) % 66, (a[0] + 24) % 66, (a[0] + 30) % 66, (a[0] + 45) % 66},
                {b[0], (b[0] + 12) % 66, (b[0] + 24) % 66, (b[0] + 30) % 66, (b[0] + 45) % 66}};
            bool differ = true;
            for (int s = 0; s < 2; ++s)
                for (int i = 1; i < 3; ++i)
                    for (int k = 3; k < 5; ++k)
                        differ = differ && at[s][i] != at[s][k];
            if (!differ)
                continue;
            const double energy =
                match_at(5, (const uint32_t *const[]){side == 1 ? apart[0] : at[0],
                                                      side == 2 ? apart[1] : at[1]});
            ck_assert(isfinite(energy) && (side != 0 || energy < 4.5));
        }
}
END_TEST

/* Equal surfaces on themselves; and in any order, which is refused unless paths find room. */
START_TEST(all_vertices)
{
    random_source r = {3};
    uint32_t at[2][MOST];
    for (int splits = 0; splits < 3; ++splits) {
        egg(&one, splits, 0);
        egg(&two, splits, 0);
        const size_t n = one.n_vertices;
        for (uint32_t k = 0; k < n; ++k)
            at[0][k] = at[1][k] = k;
        const double energy = match_at(n, (const uint32_t *const[]){at[0], at[1]});
        ck_assert_double_le(energy, 4.01);
        for (size_t k = n - 1; k > 0; --k) {
            const size_t i = (size_t)random_below(&r, (int)k + 1);
            const uint32_t other = at[1][i];
            at[1][i] = at[1][k];
            at[1][k] = other;
        }
        (void)match_at(n, (const uint32_t *const[]){at[0], at[1]});
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("match_landmarks");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, one_to_three);
    tcase_add_test(tests, mirrored);
    tcase_add_test(tests, joined_by_an_edge);
    tcase_add_test(tests, all_vertices);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
