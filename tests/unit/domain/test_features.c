/* Which polygons with features are accepted, and what is said of the others, against brute
 * force. */
#include "features.h"

#include "../../share.h"
#include "../../suite.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---------------------------------------------------------------- messages */

/* "vertex 3" or "edge 3" at the beginning of a text: whether it is a vertex, and which. */
static bool read_part(const char *text, bool *is_vertex, int *number)
{
    *is_vertex = strncmp(text, "vertex", 6) == 0;
    return sscanf(text, *is_vertex ? "vertex %d" : "edge %d", number) == 1;
}

/* What one part of a chain is, as a chain of its own: the vertex, or the edge. */
static chain part_of(const chain *c, bool is_vertex, int number)
{
    chain part = {.kind = is_vertex ? ICC_FEATURE_POINT : ICC_FEATURE_LINE, .n = is_vertex ? 1 : 2};
    ck_assert(number >= 0 && number < (is_vertex ? c->n : count_edges(c)));
    part.at[0] = corner(c, number);
    part.at[1] = corner(c, number + 1);
    return part;
}

/* "feature 3 (a line), vertex 2, lies on the outer ring" and the like. */
static void check_outside(const picture *p, const char *message, const char *rest, const chain *own)
{
    bool is_vertex[2];
    int number[2], other = -1;
    ck_assert(read_part(rest, &is_vertex[0], &number[0]));
    const chain part = part_of(own, is_vertex[0], number[0]);
    const char *what = strchr(rest, ',') + 2;
    if (strncmp(what, "lies on the", 11) == 0) {
        ck_assert(where_in_ring(&p->chains[0], part.at[0]) == ICC_BOUNDARY);
    } else if (strncmp(what, "lies outside the", 16) == 0) {
        ck_assert(!left_is_in(&p->chains[0], part.at[0], part.at[is_vertex[0] ? 0 : 1]));
    } else if (sscanf(what, "lies in feature %d", &other) == 1) {
        ck_assert(other >= 0 && other < p->n && p->chains[other + 1].kind == ICC_FEATURE_HOLE);
        ck_assert(left_is_in(&p->chains[other + 1], part.at[0], part.at[is_vertex[0] ? 0 : 1]));
    } else {
        ck_assert_msg(strstr(what, "the outer ring, edge") != NULL, "%s", message);
        ck_assert(read_part(strstr(what, "ring, ") + 6, &is_vertex[1], &number[1]));
        ck_assert(!is_vertex[0] && edges_clash(own, number[0], &p->chains[0], number[1]));
    }
}

/* "feature 3 (a line), edge 2, and feature 1 (a hole), edge 0, cross near (0.5, 1)" */
static void check_pair(const picture *p, const char *message, const char *rest, const chain *own,
                       int feature)
{
    bool is_vertex[2];
    int number[2], other = -1;
    const char *second = strstr(rest, "feature ");
    ck_assert_msg(second != NULL && sscanf(second, "feature %d", &other) == 1, "%s", message);
    ck_assert(other >= 0 && other < feature);
    ck_assert(read_part(rest, &is_vertex[0], &number[0]));
    ck_assert(read_part(strstr(second, "), ") + 3, &is_vertex[1], &number[1]));
    const chain *const with = &p->chains[other + 1];
    ck_assert_msg(edges_clash(own, number[0], with, number[1]), "%s", message);
    const chain a = part_of(own, is_vertex[0], number[0]),
                b = part_of(with, is_vertex[1], number[1]);
    const bool crosses = a.n == 2 && b.n == 2 &&
                         turn(a.at[0], a.at[1], b.at[0]) * turn(a.at[0], a.at[1], b.at[1]) < 0 &&
                         turn(b.at[0], b.at[1], a.at[0]) * turn(b.at[0], b.at[1], a.at[1]) < 0;
    ck_assert_msg(crosses == (strstr(message, "cross near") != NULL), "%s", message);
}

/* What is said must be so. */
static void check_report(const picture *p, icc_status status, const icc_error *err)
{
    int feature = -1, length = 0;
    static const char *const names[] = {"", "(a hole)", "(a line)", "(a point)", "(a region)"};
    ck_assert(status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE);
    if (err->item != ICC_ITEM_FEATURE) {
        ck_assert(status == ICC_ERR_BOUNDARY && strstr(err->message, "feature") == NULL);
        ck_assert(clashes_with_itself(&p->chains[0]));
        return;
    }
    ck_assert_msg(sscanf(err->message, "feature %d (a %*[a-z])%n", &feature, &length) == 1 &&
                      feature == err->index && feature >= 0 && feature < p->n,
                  "%s", err->message);
    const chain *own = &p->chains[feature + 1];
    const char *rest = err->message + length;
    ck_assert_msg(strstr(err->message, names[own->kind]) != NULL, "%s", err->message);
    if (status == ICC_ERR_OUTSIDE)
        check_outside(p, err->message, rest + 2, own);
    else if (strstr(rest, "feature ") != NULL)
        check_pair(p, err->message, rest + 2, own, feature);
    else
        ck_assert_msg(clashes_with_itself(own), "%s", err->message);
}

static icc_status check_picture(const picture *p, bool expected, double scale, double x, double y)
{
    request q;
    icc_domain *domain;
    icc_error err;
    request_picture(&q, p, scale, x, y);
    const icc_status status = create(&domain, &q, NULL, &err);
    ck_assert((domain != NULL) == (status == ICC_OK));
    ck_assert_msg((status == ICC_OK) == expected, "status %d: %s", (int)status, err.message);
    if (status != ICC_OK)
        check_report(p, status, &err);
    icc_domain_free(domain);
    return status;
}

/* -------------------------------------------------------------------- tests */

/* Starts a chain elsewhere or reverses it; a line can be reversed only. */
static void turn_chain(chain *c, random_source *r)
{
    const chain old = *c;
    const int start = is_ring(c) ? random_below(r, c->n) : 0;
    const bool reversed = random_below(r, 2) == 0;
    for (int i = 0; i < c->n; ++i)
        c->at[i] = old.at[reversed ? (start + c->n - 1 - i) % c->n : (start + i) % c->n];
}

START_TEST(random_pictures)
{
    static picture p;
    random_source r = {1};
    int n_sound = 0, n_outside = 0;
    const int n_rounds = share_of(100000);
    for (int round = 0; round < n_rounds; ++round) {
        random_picture(&p, &r);
        const bool expected = is_sound(&p);
        n_sound += expected;
        n_outside += check_picture(&p, expected, 1, 0, 0) == ICC_ERR_OUTSIDE;
        for (int i = 0; i <= p.n; ++i)
            turn_chain(&p.chains[i], &r);
        check_picture(&p, expected, 0x1p-20, round % 2 == 0 ? 0 : 1e9, -1e9);
        check_picture(&p, expected, round % 2 == 0 ? 0x1p20 : 1, 1e9, 1e9);
    }
    ck_assert_int_gt(n_sound, n_rounds / 20);
    ck_assert_int_lt(n_sound, n_rounds * 19 / 20);
    ck_assert_int_gt(n_outside, n_rounds / 50);
}
END_TEST

/* One defect each: the status, the feature, and what is said. */
typedef struct known {
    picture p;
    icc_status status;
    int index;
    const char *message;
} known;

#define SQUARE                                                                                     \
    {                                                                                              \
        0, 4,                                                                                      \
        {                                                                                          \
            {0, 0}, {10, 0}, {10, 10},                                                             \
            {                                                                                      \
                0, 10                                                                              \
            }                                                                                      \
        }                                                                                          \
    }
#define HOLE                                                                                       \
    {                                                                                              \
        ICC_FEATURE_HOLE, 4,                                                                       \
        {                                                                                          \
            {2, 2}, {6, 2}, {6, 6},                                                                \
            {                                                                                      \
                2, 6                                                                               \
            }                                                                                      \
        }                                                                                          \
    }
#define NOTCH                                                                                      \
    {                                                                                              \
        0, 5,                                                                                      \
        {                                                                                          \
            {0, 0}, {10, 0}, {10, 10}, {5, 5},                                                     \
            {                                                                                      \
                0, 10                                                                              \
            }                                                                                      \
        }                                                                                          \
    }
#define POINT(x, y)                                                                                \
    {                                                                                              \
        ICC_FEATURE_POINT, 1,                                                                      \
        {                                                                                          \
            {                                                                                      \
                x, y                                                                               \
            }                                                                                      \
        }                                                                                          \
    }
#define BONE(a, b, c, d)                                                                           \
    {                                                                                              \
        ICC_FEATURE_LINE, 2,                                                                       \
        {                                                                                          \
            {a, b},                                                                                \
            {                                                                                      \
                c, d                                                                               \
            }                                                                                      \
        }                                                                                          \
    }

START_TEST(known_defects)
{
    static const known cases[] = {
        {{1, {SQUARE, POINT(10, 5)}},
         7,
         0,
         "feature 0 (a point), vertex 0, lies on the outer ring"},
        {{1, {SQUARE, POINT(11, 5)}},
         7,
         0,
         "feature 0 (a point), vertex 0, lies outside the outer ring"},
        {{1, {SQUARE, BONE(5, 5, 12, 5)}},
         7,
         0,
         "feature 0 (a line), vertex 1, lies outside the outer ring"},
        {{1, {SQUARE, BONE(5, 5, 10, 5)}},
         7,
         0,
         "feature 0 (a line), vertex 1, lies on the outer ring"},
        {{1, {NOTCH, BONE(1, 8, 9, 8)}},
         7,
         0,
         "feature 0 (a line), edge 0, crosses the outer ring, edge 3, near (2, 8)"},
        {{1, {NOTCH, BONE(3, 5, 7, 5)}},
         7,
         0,
         "feature 0 (a line), edge 0, touches the outer ring, edge 3, near (5, 5)"},
        {{1, {SQUARE, {1, 4, {{-1, -1}, {11, -1}, {11, 11}, {-1, 11}}}}},
         7,
         0,
         "feature 0 (a hole), vertex 0, lies outside the outer ring"},
        {{1, {SQUARE, {1, 3, {{0, 5}, {4, 4}, {4, 6}}}}},
         7,
         0,
         "feature 0 (a hole), vertex 0, lies on the outer ring"},
        {{2, {SQUARE, HOLE, POINT(4, 4)}},
         7,
         1,
         "feature 1 (a point), vertex 0, lies in feature 0 (a hole)"},
        {{2, {SQUARE, BONE(4, 4, 5, 3), HOLE}},
         7,
         0,
         "feature 0 (a line), vertex 0, lies in feature 1 (a hole)"},
        {{2, {SQUARE, HOLE, {1, 3, {{3, 3}, {4, 3}, {4, 4}}}}},
         7,
         1,
         "feature 1 (a hole), vertex 0, lies in feature 0 (a hole)"},
        {{2, {SQUARE, HOLE, POINT(4, 2)}},
         4,
         1,
         "feature 1 (a point), vertex 0, and feature 0 (a hole), edge 0, touch near (4, 2)"},
        {{2, {SQUARE, HOLE, BONE(4, 5, 4, 8)}},
         4,
         1,
         "feature 1 (a line), edge 0, and feature 0 (a hole), edge 2, cross near (4, 6)"},
        {{2, {SQUARE, HOLE, BONE(4, 6, 4, 8)}},
         4,
         1,
         "feature 1 (a line), edge 0, and feature 0 (a hole), edge 2, touch near (4, 6)"},
        {{2, {SQUARE, BONE(1, 1, 5, 5), BONE(1, 5, 5, 1)}},
         4,
         1,
         "feature 1 (a line), edge 0, and feature 0 (a line), edge 0, cross near (3, 3)"},
        {{2, {SQUARE, BONE(1, 1, 5, 5), BONE(4, 4, 8, 8)}},
         4,
         1,
         "feature 1 (a line), edge 0, and feature 0 (a line), edge 0, touch near (5, 5)"},
        {{1, {SQUARE, {2, 4, {{2, 2}, {4, 4}, {2, 4}, {4, 2}}}}},
         4,
         0,
         "feature 0 (a line): edges 0 and 2 cross near (3, 3)"},
        {{1, {SQUARE, {2, 5, {{2, 2}, {6, 2}, {6, 4}, {4, 4}, {4, 2}}}}},
         4,
         0,
         "feature 0 (a line): edges 0 and 3 touch near (4, 2)"},
        {{1, {SQUARE, {2, 3, {{2, 2}, {4, 4}, {3, 3}}}}},
         4,
         0,
         "feature 0 (a line), vertex 1: here it runs back over itself"},
        {{1, {SQUARE, {2, 5, {{2, 2}, {4, 4}, {4, 2}, {2, 2}, {4, 4}}}}},
         4,
         0,
         "feature 0 (a line): edges 0 and 3 touch near (2, 2)"},
        {{2, {SQUARE, HOLE, {1, 3, {{2, 2}, {6, 2}, {4, 0}}}}},
         4,
         1,
         "feature 1 (a hole), edge 0, and feature 0 (a hole), edge 0, touch near (2, 2)"},
        {{1, {SQUARE, {1, 3, {{10, 0}, {10, 10}, {7, 5}}}}},
         7,
         0,
         "feature 0 (a hole), edge 0, touches the outer ring, edge 1, near (10, 0)"},
        {{1, {NOTCH, BONE(10, 10, 0, 10)}},
         7,
         0,
         "feature 0 (a line), edge 0, lies outside the outer ring"},
        {{2, {SQUARE, HOLE, BONE(2, 2, 6, 6)}},
         7,
         1,
         "feature 1 (a line), edge 0, lies in feature 0 (a hole)"},
        {{2, {SQUARE, {4, 3, {{2, 2}, {8, 2}, {8, 8}}}, {4, 3, {{9, 3}, {9, 6}, {7, 4}}}}},
         4,
         1,
         "feature 1 (a region), edge 2, and feature 0 (a region), edge 1, cross near (8, 3.5)"},
        {{1, {SQUARE, BONE(2, 2, 2, 2)}}, 4, 0, "feature 0 (a line): vertex 1 repeats vertex 0"},
        {{2, {SQUARE, POINT(8, 8), {1, 4, {{2, 2}, {4, 4}, {2, 4}, {4, 2}}}}},
         4,
         1,
         "feature 1 (a hole): edges 0 and 2 cross near (3, 3)"},
        {{1, {SQUARE, {1, 3, {{2, 2}, {3, 3}, {4, 4}}}}},
         4,
         0,
         "feature 0 (a hole): all vertices lie on one line: the shape has no area"},
        {{1, {{0, 4, {{0, 0}, {10, 10}, {0, 10}, {10, 0}}}, POINT(2, 1)}},
         4,
         0,
         "edges 0 and 2 cross near (5, 5)"},
        {{1, {{0, 2, {{0, 0}, {10, 10}}}, POINT(2, 1)}},
         4,
         -1,
         "a polygon needs at least 3 vertices, not 2"},
        {{1, {{0, 0, {{0, 0}}}, POINT(2, 1)}}, 4, -1, "there must be an outer ring or a region"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const known *k = &cases[i];
        request q;
        icc_domain *domain;
        icc_error err;
        request_picture(&q, &k->p, 1, 0, 0);
        ck_assert_int_eq(create(&domain, &q, NULL, &err), k->status);
        ck_assert_ptr_null(domain);
        ck_assert_str_eq(err.message, k->message);
        ck_assert_int_eq(err.index, k->index);
        const bool of_feature = strstr(k->message, "feature") != NULL;
        ck_assert_int_eq(err.item, of_feature       ? ICC_ITEM_FEATURE
                                   : k->index == -1 ? ICC_ITEM_NONE
                                                    : ICC_ITEM_FACET);
    }
}
END_TEST

/* Numbers that no picture has: they are named in the feature's own numbers. */
START_TEST(odd_numbers)
{
    const picture p = {2, {SQUARE, POINT(8, 8), BONE(3, 3, 4, 5)}};
    static const double odd[] = {NAN, HUGE_VAL, -HUGE_VAL, 1e-70};
    icc_domain *domain;
    icc_error err;
    request q;
    for (size_t i = 0; i < 4; ++i) {
        request_picture(&q, &p, 1, 0, 0);
        q.vertices[2 * 6] = odd[i];
        ck_assert_int_eq(create(&domain, &q, NULL, &err), ICC_ERR_BOUNDARY);
        ck_assert_int_eq(err.item, ICC_ITEM_FEATURE);
        ck_assert_int_eq(err.index, 1);
        ck_assert_ptr_nonnull(strstr(err.message, "feature 1 (a line): vertex 1 "));
        request_picture(&q, &p, 1, 0, 0);
        q.vertices[2 * 2] = odd[i];
        ck_assert_int_eq(create(&domain, &q, NULL, &err), ICC_ERR_BOUNDARY);
        ck_assert_int_eq(err.item, ICC_ITEM_VERTEX);
        ck_assert_int_eq(err.index, 2);
    }
}
END_TEST

/* Many features whose boxes all overlap: a quadratic test would not end in time. */
START_TEST(many_features)
{
    enum { N = 30000 };
    static double lines[N][4];
    static icc_feature features[N];
    static const double outer[] = {-1, -1, N + 10, -1, N + 10, N + 10, -1, N + 10};
    for (int i = 0; i < N; ++i) {
        const double line[4] = {i, 0, 0, i};
        memcpy(lines[i], line, sizeof line);
        lines[i][0] += 0.5;
        lines[i][3] += 0.5;
        features[i] = (icc_feature){sizeof(icc_feature), ICC_FEATURE_LINE, 2, lines[i], 0, 0, NULL};
    }
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_create_features(&domain, 4, outer, N, features, NULL, &err),
                     ICC_OK);
    icc_domain_free(domain);
    lines[N / 2][0] += 1.5;
    ck_assert_int_eq(icc_domain_create_features(&domain, 4, outer, N, features, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.index, N / 2 + 1);
}
END_TEST

int main(void)
{
    TCase *checks = tcase_create("features");
    tcase_add_test(checks, random_pictures);
    tcase_add_test(checks, known_defects);
    tcase_add_test(checks, odd_numbers);
    tcase_add_test(checks, many_features);
    tcase_set_timeout(checks, 120);
    Suite *suite = suite_create("features");
    suite_add_tcase(suite, checks);
    return suite_run(suite);
}
