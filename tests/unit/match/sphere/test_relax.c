/* Drawings that are moved on one another: their energy, what stays, edges that are halved and made
 * whole again, and pairs that are found by their distances. */
#include "../../../default_env.h"
#include "../../../hard_bodies.h"
#include "../../../suite.h"
#include "base/env.h"
#include "icc/icc.h"
#include "match/sphere/drawn_finder.h"
#include "match/sphere/likely_pairs.h"
#include "match/sphere/relax.h"
#include "match/sphere/sphere.h"
#include "match/sphere/split_surface.h"
#include "match/surface/direction.h"

#include <check.h>
#include <stdlib.h>

static surface shape;

typedef struct drawn {
    iccp_half_edges m;
    double *directions, *x;
} drawn;

static drawn draw(const surface *s)
{
    const iccp_env env = default_env();
    drawn d = {.directions = malloc(3 * s->n_vertices * sizeof(double)),
               .x = malloc(3 * s->n_vertices * sizeof(double))};
    ck_assert(d.directions != NULL && d.x != NULL);
    memcpy(d.x, s->vertices, 3 * s->n_vertices * sizeof(double));
    ck_assert_int_eq(iccp_half_edges_create(&d.m, s->n_vertices, s->n_faces, s->faces, &env, NULL),
                     ICC_OK);
    ck_assert_int_eq(
        iccp_sphere_draw(d.directions, s->n_vertices, d.x, s->n_faces, s->faces, &env, NULL),
        ICC_OK);
    return d;
}

static void free_drawn(drawn *d)
{
    iccp_half_edges_free(&d->m);
    free(d->directions);
    free(d->x);
}

static iccp_drawn_surface part_of(const drawn *d)
{
    return (iccp_drawn_surface){&d->m, d->x, d->directions, iccp_sphere_scale(&d->m, d->x)};
}

/* The sum over the stars of one drawing, and of the areas. */
static double energy_of(const drawn *one, const drawn *other, bool is_severe, double *weight)
{
    const iccp_memory memory = iccp_memory_default;
    const iccp_drawn_surface a = part_of(one), b = part_of(other);
    iccp_composed_star star;
    double sum = 0;
    uint32_t face = 0;
    *weight = 0;
    ck_assert(iccp_composed_star_create(&star, a.m->most_neighbours, b.m->n_faces, &memory));
    star.is_severe = is_severe;
    for (uint32_t v = 0; v < a.m->n_vertices; ++v) {
        face = iccp_drawn_walk(b.m, b.directions, face, a.directions + 3 * (size_t)v);
        ck_assert_int_eq(iccp_composed_star_gather(&star, &a, v, &b, face), ICC_OK);
        sum += iccp_composed_star_energy(&star, (const double[]){0, 0, 1}, HUGE_VAL);
        *weight += star.weight;
    }
    iccp_composed_star_free(&star);
    return sum;
}

/* E is 4 everywhere, whatever the drawing, and each face counts for three stars. */
START_TEST(a_surface_on_itself_is_not_stretched)
{
    random_source r = {5};
    surface_star(&shape, 3, .3, &r);
    drawn one = draw(&shape);
    double weight;
    ck_assert_double_eq_tol(energy_of(&one, &one, false, &weight) / weight, 4, 1e-9);
    ck_assert_double_eq_tol(energy_of(&one, &one, true, &weight) / weight, 8, 1e-9);
    ck_assert_double_eq_tol(weight / (3 * 2 * 4 * 3.14159265358979323846), 1, 1e-2);
    free_drawn(&one);
}
END_TEST

/* A star's energy at a place does not depend on the places asked before. At or above the limit it
 * is HUGE_VAL. */
START_TEST(energies_of_a_star_are_the_same_in_any_order)
{
    enum { N = 5 };
    const iccp_memory memory = iccp_memory_default;
    random_source r = {11};
    surface_star(&shape, 3, .3, &r);
    drawn one = draw(&shape);
    surface_star(&shape, 3, .3, &r);
    drawn other = draw(&shape);
    const iccp_drawn_surface a = part_of(&one), b = part_of(&other);
    iccp_composed_star star;
    uint32_t face = 0;
    ck_assert(iccp_composed_star_create(&star, a.m->most_neighbours, b.m->n_faces, &memory));
    for (uint32_t v = 0; v < a.m->n_vertices; ++v) {
        double energy[N];
        face = iccp_drawn_walk(b.m, b.directions, face, a.directions + 3 * (size_t)v);
        for (int k = 0; k < 2 * N; ++k) {
            const int i = k < N ? k : 2 * N - 1 - k;
            if (k <= N) /* later, all is known */
                ck_assert_int_eq(iccp_composed_star_gather(&star, &a, v, &b, face), ICC_OK);
            const double place[3] = {.1 * i * star.radius, -.15 * i * star.radius, 1};
            const double now = iccp_composed_star_energy(&star, place, HUGE_VAL);
            if (k < N)
                energy[i] = now;
            ck_assert(now == energy[i] && now > 0 && now < 1e8);
            ck_assert(iccp_composed_star_energy(&star, place, now) == HUGE_VAL);
            ck_assert(iccp_composed_star_energy(&star, place, (1 + 1e-12) * now) == now);
        }
    }
    iccp_composed_star_free(&star);
    free_drawn(&one);
    free_drawn(&other);
}
END_TEST

START_TEST(relaxing_lowers_the_energy_and_keeps_the_class)
{
    const iccp_env env = default_env();
    random_source r = {9};
    for (int trial = 0; trial < 4; ++trial) {
        const bool is_severe = trial % 2 == 1;
        surface_star(&shape, 3, .3, &r);
        drawn pair[2] = {draw(&shape), {.x = NULL}};
        surface_star(&shape, 3, .3, &r);
        for (size_t k = 0; k < 3 * shape.n_vertices; ++k)
            shape.vertices[k] *= k % 3 == 0 ? 1 : .4; /* a cigar, which as such is drawn badly */
        pair[1] = draw(&shape);
        const size_t n = pair[0].m.n_vertices, size = 3 * n * sizeof(double);
        double weight, *const before = malloc(size), *const first = malloc(size);
        uint8_t *const is_fixed = calloc(n, 1);
        ck_assert(before != NULL && first != NULL && is_fixed != NULL);
        for (size_t v = 0; v < n; v += 40)
            is_fixed[v] = 1;
        memcpy(before, pair[0].directions, size);
        const double energy = energy_of(&pair[0], &pair[1], is_severe, &weight);
        const iccp_drawn_surface side[2] = {part_of(&pair[0]), part_of(&pair[1])};
        double *const second = malloc(size);
        ck_assert_ptr_nonnull(second);
        memcpy(second, pair[1].directions, size);
        double left[2];
        for (int run = 0; run < 2; ++run) { /* the same twice */
            iccp_relaxation relaxation;
            memcpy(pair[0].directions, before, size);
            memcpy(pair[1].directions, second, size);
            ck_assert_int_eq(iccp_relaxation_create(&relaxation, side,
                                                    (const uint8_t *const[]){is_fixed, NULL},
                                                    &env.memory),
                             ICC_OK);
            ck_assert_int_eq(iccp_relax(&relaxation, ICCP_LONGER, is_severe, &left[run], &env),
                             ICC_OK);
            ck_assert(left[run] > 0 && left[run] < 1e8);
            iccp_relaxation_free(&relaxation, &env.memory);
            if (run == 0)
                memcpy(first, pair[0].directions, size);
        }
        ck_assert_mem_eq(first, pair[0].directions, size);
        ck_assert_double_lt(energy_of(&pair[0], &pair[1], is_severe, &weight),
                            (is_severe ? .99 : .995) * energy);
        for (int s = 0; s < 2; ++s)
            ck_assert_int_eq(iccp_sphere_check(&pair[s].m, pair[s].directions, NULL), ICC_OK);
        size_t n_moved = 0;
        for (size_t v = 0; v < n; ++v) {
            const bool has_moved = memcmp(before + 3 * v, first + 3 * v, 3 * sizeof(double)) != 0;
            ck_assert(!(has_moved && is_fixed[v] != 0));
            n_moved += has_moved;
        }
        ck_assert_uint_gt(2 * n_moved, n);
        free(before);
        free(first);
        free(second);
        free(is_fixed);
        free_drawn(&pair[0]);
        free_drawn(&pair[1]);
    }
}
END_TEST

START_TEST(halved_edges_are_made_whole)
{
    const iccp_memory memory = iccp_memory_default;
    const iccp_env env = default_env();
    random_source r = {3};
    surface_star(&shape, 2, .3, &r);
    iccp_half_edges m, again;
    iccp_split_surface s;
    ck_assert_int_eq(
        iccp_half_edges_create(&m, shape.n_vertices, shape.n_faces, shape.faces, &env, NULL),
        ICC_OK);
    ck_assert(iccp_split_surface_create(&s, &m, shape.vertices, &memory));
    for (int k = 0; k < 300; ++k)
        ck_assert(iccp_split_halve(&s, (uint32_t)random_below(&r, (int)(3 * s.n_faces))));
    for (uint32_t v = (uint32_t)s.n_vertices; v-- > s.n_given;)
        ck_assert(iccp_split_unite(&s, v));
    ck_assert_uint_eq(s.n_faces, m.n_faces);
    ck_assert_int_eq(iccp_half_edges_create(&again, s.n_vertices, s.n_faces, s.origin, &env, NULL),
                     ICC_OK);
    for (uint32_t h = 0; h < 3 * s.n_faces; ++h) {
        ck_assert_uint_eq(again.twin[h], s.twin[h]);
        ck_assert(iccp_are_neighbours(&m, s.origin[h], iccp_split_end(&s, h)));
    }
    for (uint32_t v = 0; v < s.n_vertices; ++v) {
        ck_assert_uint_eq(s.out[v] != ICCP_NO_EDGE, v < s.n_given);
        if (v < s.n_given)
            ck_assert_uint_eq(s.origin[s.out[v]], v);
    }
    iccp_half_edges_free(&m);
    iccp_half_edges_free(&again);
    iccp_split_surface_free(&s);
}
END_TEST

/* The same surface with other numbers and turned: distances agree up to rounding, and the farthest
 * vertices are found with their partners. */
START_TEST(likely_pairs_are_partners)
{
    const iccp_env env = default_env();
    random_source r = {21};
    for (int trial = 0; trial < 10; ++trial) {
        static uint32_t number[SURFACE_VERTICES], faces[3 * SURFACE_FACES], vertices[2][12];
        static double turned[3 * SURFACE_VERTICES];
        iccp_half_edges m[2];
        size_t n = 4;
        surface_star(&shape, 3, .6, &r);
        for (uint32_t v = 0; v < shape.n_vertices; ++v)
            number[v] = v;
        for (size_t v = shape.n_vertices; v-- > 1;) {
            const int other = random_below(&r, (int)v + 1);
            const uint32_t swap = number[v];
            number[v] = number[other];
            number[other] = swap;
        }
        for (size_t v = 0; v < shape.n_vertices; ++v)
            for (size_t k = 0; k < 3; ++k)
                turned[3 * (size_t)number[v] + k] = shape.vertices[3 * v + (k + 1) % 3];
        for (size_t c = 0; c < 3 * shape.n_faces; ++c)
            faces[c] = number[shape.faces[c]];
        ck_assert_int_eq(
            iccp_half_edges_create(&m[0], shape.n_vertices, shape.n_faces, shape.faces, &env, NULL),
            ICC_OK);
        ck_assert_int_eq(
            iccp_half_edges_create(&m[1], shape.n_vertices, shape.n_faces, faces, &env, NULL),
            ICC_OK);
        for (uint32_t k = 0; k < n; ++k)
            vertices[1][k] = number[vertices[0][k] = 40 * k + (uint32_t)random_below(&r, 40)];
        ck_assert_int_eq(
            iccp_likely_pairs_find((uint32_t *const[]){vertices[0], vertices[1]}, &n, 12,
                                   (const iccp_half_edges *const[]){&m[0], &m[1]},
                                   (const double *const[]){shape.vertices, turned},
                                   (const double[]){iccp_sphere_scale(&m[0], shape.vertices),
                                                    iccp_sphere_scale(&m[1], turned)},
                                   &env),
            ICC_OK);
        ck_assert_uint_eq(n, 12);
        for (size_t k = 0; k < n; ++k)
            ck_assert_uint_eq(vertices[1][k], number[vertices[0][k]]);
        for (size_t k = 0; k < n; ++k)
            for (size_t i = 0; i < k; ++i)
                ck_assert_uint_ne(vertices[0][i], vertices[0][k]);
        iccp_half_edges_free(&m[0]);
        iccp_half_edges_free(&m[1]);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("relax");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, a_surface_on_itself_is_not_stretched);
    tcase_add_test(tests, energies_of_a_star_are_the_same_in_any_order);
    tcase_add_test(tests, relaxing_lowers_the_energy_and_keeps_the_class);
    tcase_add_test(tests, halved_edges_are_made_whole);
    tcase_add_test(tests, likely_pairs_are_partners);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
