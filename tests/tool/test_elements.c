/* The signs of elements: never `positive` where the determinant is not, by exact values of it at many places, which are
 * computed from the textbooks' shape functions; and seldom undecided. */
#include "mesh/element_sign.h"

#include "../random.h"
#include "../share.h"
#include "../suite.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Where a node lies in the reference element: 0, 1/2 or 1 along each direction, in halves. */
typedef struct shape {
    int type;
    int halves[ELEMENT_MOST_NODES][3];
} shape;

#define CUBE                                                                                       \
    {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},                   \
    {                                                                                              \
        0, 2, 2                                                                                    \
    }
#define CUBE_EDGES                                                                                 \
    {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2},        \
        {0, 0, 1}, {2, 0, 1}, {2, 2, 1},                                                           \
    {                                                                                              \
        0, 2, 1                                                                                    \
    }
#define PRISM                                                                                      \
    {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2},                                         \
    {                                                                                              \
        0, 2, 2                                                                                    \
    }
#define PRISM_EDGES                                                                                \
    {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1},        \
    {                                                                                              \
        0, 2, 1                                                                                    \
    }
static const shape shapes[] = {
    {9, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}},
    {12, {CUBE}},
    {13, {PRISM}},
    {14, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}}},
    {22, {{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 1}, {0, 1}}},
    {23, {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}}},
    {28, {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}}},
    {24,
     {{0, 0, 0},
      {2, 0, 0},
      {0, 2, 0},
      {0, 0, 2},
      {1, 0, 0},
      {1, 1, 0},
      {0, 1, 0},
      {0, 0, 1},
      {1, 0, 1},
      {0, 1, 1}}},
    {25, {CUBE, CUBE_EDGES}},
    {29,
     {CUBE,
      CUBE_EDGES,
      {0, 1, 1},
      {2, 1, 1},
      {1, 0, 1},
      {1, 2, 1},
      {1, 1, 0},
      {1, 1, 2},
      {1, 1, 1}}},
    {26, {PRISM, PRISM_EDGES}},
    {32, {PRISM, PRISM_EDGES, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}};
enum { N_SHAPES = sizeof shapes / sizeof *shapes };

/* Shape functions, each by its node's place (a, b, c) in halves; x = (r, s, t). Serendipity ones in -1..1. */
static long double linear(int half, long double x)
{
    return half == 2 ? x : 1 - x;
}

static long double quadratic(int half, long double x)
{
    return half == 0 ? (1 - x) * (1 - 2 * x) : half == 1 ? 4 * x * (1 - x) : x * (2 * x - 1);
}

static long double triangle_2(const int *half, const long double *x)
{
    const int l[3] = {2 - half[0] - half[1], half[0], half[1]};
    const long double at[3] = {1 - x[0] - x[1], x[0], x[1]};
    long double value = 1;
    for (int k = 0; k < 3; k++)
        value *= l[k] == 2 ? at[k] * (2 * at[k] - 1) : l[k] == 1 ? 2 * at[k] : 1;
    return value;
}

static long double tetrahedron_2(const int *half, const long double *x)
{
    const int l[4] = {2 - half[0] - half[1] - half[2], half[0], half[1], half[2]};
    const long double at[4] = {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
    long double value = 1;
    for (int k = 0; k < 4; k++)
        value *= l[k] == 2 ? at[k] * (2 * at[k] - 1) : l[k] == 1 ? 2 * at[k] : 1;
    return value;
}

static long double serendipity(unsigned dim, const int *half, const long double *x)
{
    long double value = 1, sum = 1 - (long double)dim;
    int n_middle = 0;
    for (unsigned k = 0; k < dim; k++) {
        const long double u = 2 * x[k] - 1, at = half[k] - 1;
        n_middle += half[k] == 1;
        value *= half[k] == 1 ? 1 - u * u : (1 + u * at) / 2;
        sum += u * at;
    }
    return n_middle == 0 ? value * sum : value;
}

static long double prism_15(const int *half, const long double *x)
{
    const long double l[3] = {1 - x[0] - x[1], x[0], x[1]}, u = 2 * x[2] - 1, way = half[2] - 1;
    const int at[3] = {2 - half[0] - half[1], half[0], half[1]};
    long double value = 1;
    for (int k = 0; k < 3; k++) {
        if (at[k] == 2 && half[2] == 1)
            return l[k] * (1 - u * u);
        if (at[k] == 2)
            return l[k] * ((2 * l[k] - 1) * (1 + way * u) - (1 - u * u)) / 2;
        value *= at[k] == 1 ? 2 * l[k] : 1;
    }
    return value * (1 + way * u) / 2;
}

static long double shape_function(int type, const int *half, const long double *x)
{
    switch (type) {
    case 9:
        return linear(half[0], x[0]) * linear(half[1], x[1]);
    case 12:
        return linear(half[0], x[0]) * linear(half[1], x[1]) * linear(half[2], x[2]);
    case 13:
        return (half[0] == 2   ? x[0]
                : half[1] == 2 ? x[1]
                               : 1 - x[0] - x[1]) *
               linear(half[2], x[2]);
    case 14: /* a cube with its top drawn together */
        return half[2] == 2 ? x[2] : linear(half[0], x[0]) * linear(half[1], x[1]) * (1 - x[2]);
    case 22:
        return triangle_2(half, x);
    case 24:
        return tetrahedron_2(half, x);
    case 23:
        return serendipity(2, half, x);
    case 25:
        return serendipity(3, half, x);
    case 26:
        return prism_15(half, x);
    case 28:
        return quadratic(half[0], x[0]) * quadratic(half[1], x[1]);
    case 29:
        return quadratic(half[0], x[0]) * quadratic(half[1], x[1]) * quadratic(half[2], x[2]);
    default:
        return triangle_2(half, x) * quadratic(half[2], x[2]);
    }
}

/* The slopes of all shape functions at one place. */
typedef struct place {
    bool corner;
    long double slopes[ELEMENT_MOST_NODES][3];
} place;

/* Nothing is rounded while points are whole numbers of up to 8 bits and places multiples of 1/8, since central
 * differences of quadratic polynomials are exact. */
static place place_at(const shape *s, const element_kind *kind, const long double *x)
{
    place at = {false, {{0}}};
    for (unsigned i = 0; i < kind->n_nodes; i++)
        for (unsigned k = 0; k < kind->dim; k++) {
            long double up[3], down[3];
            memcpy(up, x, sizeof up);
            memcpy(down, x, sizeof down);
            up[k] += 0.125L;
            down[k] -= 0.125L;
            at.slopes[i][k] = 4 * (shape_function(s->type, s->halves[i], up) -
                                   shape_function(s->type, s->halves[i], down));
        }
    return at;
}

static long double determinant(const place *at, const element_kind *kind, const double *points)
{
    long double d[3][3] = {{0}};
    for (unsigned i = 0; i < kind->n_nodes; i++)
        for (unsigned k = 0; k < kind->dim; k++)
            for (unsigned c = 0; c < kind->dim; c++)
                d[k][c] += at->slopes[i][k] * (long double)points[kind->dim * i + c];
    return kind->dim == 2 ? d[0][0] * d[1][1] - d[0][1] * d[1][0]
                          : d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) +
                                d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
                                d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

static bool is_within(int type, const int *at, int n)
{
    const bool triangle = type == 13 || type == 22 || type == 26 || type == 32;
    return triangle     ? at[0] + at[1] <= n
           : type == 24 ? at[0] + at[1] + at[2] <= n
                        : type != 14 || at[2] < n;
}

enum { N = 8, MOST_PLACES = (N + 1) * (N + 1) * (N + 1) };

/* All multiples of 1/N in the reference element. Returns how many. */
static int make_places(const shape *s, const element_kind *kind, place *out)
{
    int n = 0;
    for (int i = 0; i < (N + 1) * (N + 1) * (kind->dim == 3 ? N + 1 : 1); i++) {
        const int at[3] = {i % (N + 1), i / (N + 1) % (N + 1), i / (N + 1) / (N + 1)};
        if (!is_within(s->type, at, N))
            continue;
        out[n] = place_at(s, kind, (long double[3]){at[0] / 8.0L, at[1] / 8.0L, at[2] / 8.0L});
        out[n++].corner = at[0] % N == 0 && at[1] % N == 0 && at[2] % N == 0;
    }
    return n;
}

/* The least value; those at corners apart. */
static long double least(int n, const place *places, const element_kind *kind, const double *points,
                         long double *at_corners)
{
    long double value = HUGE_VALL;
    *at_corners = HUGE_VALL;
    for (int i = 0; i < n; i++) {
        const long double here = determinant(&places[i], kind, points);
        value = fminl(value, here);
        if (places[i].corner)
            *at_corners = fminl(*at_corners, here);
    }
    return value;
}

static const uint32_t nodes[ELEMENT_MOST_NODES] = {0,  1,  2,  3,  4,  5,  6,  7,  8,
                                                   9,  10, 11, 12, 13, 14, 15, 16, 17,
                                                   18, 19, 20, 21, 22, 23, 24, 25, 26};

static void draw(const shape *s, const element_kind *kind, double amount, random_source *r,
                 double *points)
{
    for (unsigned i = 0; i < kind->n_nodes; i++)
        for (unsigned k = 0; k < kind->dim; k++)
            points[kind->dim * i + k] =
                floor(40 * s->halves[i][k] + amount * (random_unit(r) - 0.5));
}

/* Elements of all kinds, distorted by any amount. */
START_TEST(test_signs_are_true)
{
    const shape *s = &shapes[_i];
    const element_kind *kind = element_kind_find(s->type);
    element_plan *p = element_plan_make(kind);
    random_source r = {(uint64_t)s->type};
    int n_positive = 0, n_inverted = 0, n_undecided = 0, n_inside = 0;
    place *places = malloc(MOST_PLACES * sizeof *places);
    ck_assert(p != NULL && places != NULL);
    const int n_places = make_places(s, kind, places);
    const int n = share_of(600);
    for (int i = 0; i < n; i++) {
        double points[3 * ELEMENT_MOST_NODES];
        long double at_corners;
        draw(s, kind, 120.0 * (i % 100) / 100, &r, points);
        const long double value = least(n_places, places, kind, points, &at_corners);
        const element_sign sign = element_sign_of(p, points, nodes, 1);
        if (sign == ELEMENT_POSITIVE)
            ck_assert_msg(value > 0, "kind %d, case %d: positive, but %Lg", s->type, i, value);
        if (value <= 0)
            ck_assert_msg(sign != ELEMENT_POSITIVE, "kind %d, case %d", s->type, i);
        n_positive += sign == ELEMENT_POSITIVE;
        n_inverted += sign == ELEMENT_INVERTED;
        n_undecided += sign == ELEMENT_UNDECIDED;
        n_inside += at_corners > 0 && value <= 0;

        /* The other way round, and far away and tiny. */
        for (unsigned k = 0; k < kind->n_nodes; k++)
            points[kind->dim * k] *= -1;
        ck_assert_int_eq(element_sign_of(p, points, nodes, -1), sign);
        for (unsigned k = 0; k < kind->dim * kind->n_nodes; k++)
            points[k] = 0x1p-600 * (points[k] + 0x1p26);
        if (sign != ELEMENT_UNDECIDED && kind->degree == 1)
            ck_assert_int_eq(element_sign_of(p, points, nodes, -1), sign);
        else if (sign != ELEMENT_UNDECIDED)
            ck_assert(element_sign_of(p, points, nodes, -1) + sign !=
                      ELEMENT_POSITIVE + ELEMENT_INVERTED);
    }
    if (n == 600) {
        ck_assert_int_gt(n_positive, 50);
        ck_assert_int_gt(n_inverted, 50);
        ck_assert_msg(n_undecided <= 6, "kind %d: %d undecided", s->type, n_undecided);
        /* Corners alone do not tell, but where they do. */
        if (kind->degree == 2 || kind->shape == SHAPE_CUBE)
            ck_assert_int_gt(n_inside, 0);
    }
    free(places);
    element_plan_free(p);
}
END_TEST

/* What is just flat, or would be flat but for the last bit. */
START_TEST(test_signs_at_zero)
{
    const element_kind *kind = element_kind_find(ELEMENT_HEXAHEDRON);
    element_plan *p = element_plan_make(kind);
    double points[24];
    for (int i = 0; i < 24; i++)
        points[i] = 0.5 * shapes[1].halves[i / 3][i % 3];
    ck_assert_int_eq(element_orientation(p, points, nodes), 1);
    points[2] = 1; /* corner 0 on corner 4 */
    ck_assert_int_eq(element_sign_of(p, points, nodes, 1), ELEMENT_INVERTED);
    points[2] = 1 - 0x1p-52;
    ck_assert_int_ne(element_sign_of(p, points, nodes, 1), ELEMENT_INVERTED);
    for (int i = 0; i < 8; i++)
        points[3 * i] = 7;
    ck_assert_int_eq(element_orientation(p, points, nodes), 0);
    element_plan_free(p);
}
END_TEST

/* Voxels and pixels have another order; other kinds are never decided. */
START_TEST(test_kinds)
{
    const double voxel[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    const double pixel[] = {0, 0, 1, 0, 0, 1, 1, 1};
    element_plan *p = element_plan_make(element_kind_find(11));
    ck_assert_int_eq(element_orientation(p, voxel, nodes), 1);
    element_plan_free(p);
    p = element_plan_make(element_kind_find(8));
    ck_assert_int_eq(element_orientation(p, pixel, nodes), 1);
    element_plan_free(p);
    p = element_plan_make(element_kind_find(42));
    ck_assert_int_eq(element_sign_of(p, voxel, nodes, 1), ELEMENT_UNDECIDED);
    element_plan_free(p);
    ck_assert_str_eq(element_kind_find(200)->many, "cells of unknown kind");
    ck_assert_str_eq(element_kind_find(12)->many, "hexahedra");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("elements");
    TCase *tests = tcase_create("elements");
    tcase_add_loop_test(tests, test_signs_are_true, 0, N_SHAPES);
    tcase_add_test(tests, test_signs_at_zero);
    tcase_add_test(tests, test_kinds);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
