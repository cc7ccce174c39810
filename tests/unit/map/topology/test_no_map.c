/* Pairs of solids that have a map, and pairs that have none: which are refused, and by which loop. */
#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../lattice_bodies.h"
#include "../../../suite.h"
#include "domain/domain.h"
#include "map/topology/no_map.h"
#include "map/topology/region_pair.h"
#include "math/residue.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static iccp_bad_loop compare(bool *exists, const iccp_simplices *source,
                             const iccp_simplices *target)
{
    const iccp_env env = default_env();
    icc_error err = {.size = sizeof err};
    iccp_bad_loop loop;
    const icc_status status = iccp_bad_loop_find(&loop, exists, source, target, &env, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    return loop;
}

/* Checks that edges of the surface join the vertices, and that no vertex occurs twice. */
static void check_loop(const iccp_bad_loop *loop, const iccp_simplices *source, bool is_simple)
{
    const iccp_env env = default_env();
    const iccp_region region = {source, loop->region};
    iccp_region_surface s;
    ck_assert_uint_gt(loop->n, 2);
    ck_assert_int_eq(iccp_region_surface_create(&s, &region, &env.memory), ICC_OK);
    for (size_t i = 0; i < loop->n; ++i) {
        const uint32_t v = loop->vertices[i], w = loop->vertices[(i + 1) % loop->n];
        bool joined = false;
        for (size_t k = s.edge_first[v]; k < s.edge_first[v + 1]; ++k) {
            const uint32_t *ends = s.ends + 2 * (size_t)s.at_vertex[k];
            joined = joined || ends[0] == w || ends[1] == w;
        }
        ck_assert(joined);
        ck_assert_uint_eq(s.root[s.component[v]], loop->surface);
        for (size_t k = 0; is_simple && k < i; ++k)
            ck_assert_uint_ne(loop->vertices[k], v);
    }
    iccp_region_surface_free(&s);
}

/* ---- solid tori ---- */

enum { N_TORUS = 13 };

/* How often a loop goes along each axis of the torus. */
static void count_turns(int turns[2], const iccp_bad_loop *loop)
{
    turns[0] = turns[1] = 0;
    for (size_t i = 0; i < loop->n; ++i) {
        const int v = (int)loop->vertices[i], w = (int)loop->vertices[(i + 1) % loop->n];
        const int step[2] = {w / N_TORUS - v / N_TORUS, w % N_TORUS - v % N_TORUS};
        for (int k = 0; k < 2; ++k)
            turns[k] += step[k] > 1    ? step[k] - N_TORUS
                        : step[k] < -1 ? step[k] + N_TORUS
                                       : step[k];
    }
    ck_assert(turns[0] % N_TORUS == 0 && turns[1] % N_TORUS == 0);
    turns[0] /= N_TORUS;
    turns[1] /= N_TORUS;
}

static bool are_parallel(const int a[2], const int b[2])
{
    return a[0] * b[1] - a[1] * b[0] == 0;
}

typedef struct torus {
    iccp_simplices *mesh;
    int slope[2];
} torus;

/* Returns true if there is a map. */
static bool check_tori(const torus *source, const torus *target)
{
    bool exists;
    const bool same = are_parallel(source->slope, target->slope);
    iccp_bad_loop loop = compare(&exists, source->mesh, target->mesh);
    ck_assert_int_eq(exists, !same);
    if (exists) {
        const torus *const in[2] = {source, target};
        int turns[2];
        const int *slope = in[loop.inside]->slope;
        /* Loops with more turns hardly fit on the lattice. */
        check_loop(&loop, source->mesh, abs(slope[0]) < 4 && abs(slope[1]) < 4);
        count_turns(turns, &loop);
        ck_assert(turns[0] != 0 || turns[1] != 0);
        ck_assert(are_parallel(turns, in[loop.inside]->slope));
        ck_assert(!are_parallel(turns, in[!loop.inside]->slope));
        ck_assert_uint_eq(loop.n_partners, 0);
    }
    iccp_bad_loop_free(&loop);
    return same;
}

/* Solid tori with one surface and all ways of up to four exchanges. The next exchange after one
 * never takes it back. */
START_TEST(test_solid_tori)
{
    static const char letters[] = "abc";
    enum { MOST = 24 };
    static torus tori[MOST];
    static char words[MOST][5];
    int n = 1, n_maps = 0, n_refused = 0;
    tori[0].mesh = torus_mesh(N_TORUS, "", tori[0].slope);
    for (int from = 0; n < MOST && from < n; ++from)
        for (int k = 0; k < 3 && n < MOST; ++k) {
            const size_t length = strlen(words[from]);
            if (length == 4 || (length > 0 && letters[k] == 'b'))
                continue;
            (void)snprintf(words[n], sizeof words[n], "%s%c", words[from], letters[k]);
            tori[n].mesh = torus_mesh(N_TORUS, words[n], tori[n].slope);
            ++n;
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const bool is_map = check_tori(&tori[i], &tori[j]);
            n_maps += is_map;
            n_refused += !is_map;
        }
    ck_assert_int_gt(n_maps, 50);
    ck_assert_int_gt(n_refused, 20);
    for (int i = 0; i < n; ++i)
        iccp_simplices_free(tori[i].mesh);
}
END_TEST

/* ---- cells ---- */

/* A case is a number: the body is made from it. */
typedef void (*make_body)(lattice_body *b, int k);

static iccp_simplices *make(make_body body, int k, size_t n_divided)
{
    static lattice_body b;
    random_source r = {(uint64_t)k};
    body(&b, k);
    return body_mesh(&b, n_divided, &r);
}

/* A plate with k holes. */
static void make_plate(lattice_body *b, int k)
{
    body_begin(b, 2 * k + 3, 5, 3, OUTSIDE_CELL);
    for (int x = 1; x < 2 * k + 2; ++x)
        for (int y = 1; y < 4; ++y)
            b->cell[x][y][1] = x % 2 == 0 && y == 2 ? OUTSIDE_CELL : 0;
}

/* A knotted tube: 3, 5, 7 half turns, or none. */
static void make_tube(lattice_body *b, int k)
{
    if (k == 0) {
        body_begin(b, 11, 11, 5, OUTSIDE_CELL);
        body_ring(b, 1, 1, 2, 0, 1, 9, 0);
        return;
    }
    const int n = 2 * k + 3;
    body_begin(b, 2 * n + 1, 2 * n + 1, 5, OUTSIDE_CELL);
    body_knot(b, n, 1, 1, 1, 0);
}

/* Two rings; k tells where the second one is: 0 to 3 beside the first one, 4 to 12 linked with it,
 * 13 to 21 linked from the other side. */
static void make_rings(lattice_body *b, int k, uint8_t cell)
{
    body_begin(b, 24, 11, 13, 0);
    body_ring(b, 8, 2, 6, 0, 1, 7, cell);
    const int next = cell + 1;
    const int moved = (k - 4) % 9, y = k < 4 ? 2 + k : 4 + moved / 3;
    const int x = k < 4 ? 16 : (k < 13 ? 10 : 4) + moved % 3;
    body_ring(b, x, y, k < 4 ? 2 + k : 3, 0, 2, 7, (uint8_t)next);
}

static void make_ring_voids(lattice_body *b, int k)
{
    make_rings(b, k, 1);
}

static void make_ring_regions(lattice_body *b, int k)
{
    make_rings(b, k, FIRST_REGION + 1);
}

/* A void that is a knotted tube, at three places. */
static void make_knot_void(lattice_body *b, int k)
{
    body_begin(b, 15, 13, 7 + k, 0);
    b->size[2] = 9;
    body_knot(b, 5, 2 + k, 2, 1 + k, 1);
}

/* A void that is a plate with two holes, at three places. */
static void make_plate_void(lattice_body *b, int k)
{
    body_begin(b, 13, 7, 7, 0);
    for (int x = 0; x < 5; ++x)
        for (int y = 0; y < 3; ++y)
            if (x % 2 == 0 || y != 1)
                b->cell[2 + 2 * k + x][2][1 + k + y] = 1;
}

static void check_map(iccp_simplices *source, iccp_simplices *target)
{
    bool exists;
    iccp_bad_loop loop = compare(&exists, source, target);
    ck_assert(!exists);
    iccp_bad_loop_free(&loop);
    iccp_simplices_free(source);
    iccp_simplices_free(target);
}

static iccp_bad_loop check_none(iccp_simplices *source, iccp_simplices *target)
{
    bool exists;
    iccp_bad_loop loop = compare(&exists, source, target);
    ck_assert(exists);
    check_loop(&loop, source, true);
    iccp_simplices_free(source);
    iccp_simplices_free(target);
    return loop;
}

/* Other insides of the same surface, and voids that move. */
START_TEST(test_maps)
{
    int n = 0;
    for (int k = 1; k <= 8; ++k, ++n)
        check_map(make(make_plate, k, 0), make(make_plate, k, (size_t)(40 * k)));
    for (int k = 0; k < 4; ++k, ++n)
        check_map(make(make_tube, k, 0), make(make_tube, k, 300));
    for (int k = 0; k < 22; ++k, n += 2) {
        const int first = k < 4 ? 0 : k < 13 ? 4 : 13;
        check_map(make(make_ring_voids, first, 0), make(make_ring_voids, k, 500));
        check_map(make(make_ring_regions, k, 0), make(make_ring_regions, first, 500));
    }
    for (int k = 0; k < 3; ++k, n += 2) {
        check_map(make(make_knot_void, k, 0), make(make_knot_void, 0, 200));
        check_map(make(make_plate_void, 0, 0), make(make_plate_void, k, 200));
    }
    ck_assert_int_ge(n, 50);
}
END_TEST

static iccp_simplices *turned_out(make_body body, int k)
{
    static lattice_body b;
    random_source r = {1};
    body(&b, k);
    body_turn_out(&b);
    return body_mesh(&b, 100, &r);
}

/* Turned inside out, and linked voids and regions onto others. */
START_TEST(test_no_maps)
{
    static const int pairs[][2] = {{0, 4}, {4, 0}, {0, 13}, {13, 2}, {4, 13}, {13, 9}};
    int n = 0;
    for (int k = 1; k <= 8; ++k, ++n) {
        iccp_bad_loop loop = check_none(make(make_plate, k, 0), turned_out(make_plate, k));
        ck_assert_uint_eq(loop.n_partners, 0);
        iccp_bad_loop_free(&loop);
    }
    for (int k = 0; k < 4; ++k, ++n) {
        iccp_bad_loop loop = check_none(turned_out(make_tube, k), make(make_tube, k, 100));
        ck_assert_uint_eq(loop.n_partners, 0);
        iccp_bad_loop_free(&loop);
    }
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i)
        for (int regions = 0; regions < 2; ++regions, ++n) {
            const make_body body = regions ? make_ring_regions : make_ring_voids;
            const bool both_linked = pairs[i][0] >= 4 && pairs[i][1] >= 4;
            iccp_bad_loop loop =
                check_none(make(body, pairs[i][0], 50), make(body, pairs[i][1], 0));
            ck_assert_uint_eq(loop.n_partners, both_linked);
            iccp_bad_loop_free(&loop);
        }
    ck_assert_int_ge(n, 20);
}
END_TEST

/* ---- the rest ---- */

/* Half as many classes as there are loops, and few free edges more. */
START_TEST(test_classes)
{
    const iccp_env env = default_env();
    iccp_simplices *mesh[] = {make(make_plate, 8, 500), turned_out(make_plate, 8),
                              make(make_tube, 3, 500), turned_out(make_tube, 3),
                              make(make_ring_voids, 9, 5000)};
    for (size_t i = 0; i < sizeof mesh / sizeof *mesh; ++i) {
        const iccp_region regions[2] = {{mesh[i], 0}, {mesh[i], 0}};
        iccp_region_pair pair;
        ck_assert_int_eq(iccp_region_pair_create(&pair, regions, &env, NULL), ICC_OK);
        ck_assert_uint_eq(2 * pair.classes[0].n, iccp_surface_n_loops(&pair.surface));
        ck_assert_uint_le(pair.classes[0].n_free, pair.classes[0].n + 4);
        iccp_region_pair_free(&pair);
        iccp_simplices_free(mesh[i]);
    }
}
END_TEST

/* A body without handles costs nothing more. */
START_TEST(test_no_handles)
{
    static lattice_body b;
    random_source r = {1};
    body_begin(&b, 5, 5, 5, 0);
    b.cell[2][2][2] = 1;
    check_map(body_mesh(&b, 0, &r), body_mesh(&b, 10, &r));
}
END_TEST

typedef struct meshes {
    const iccp_simplices *source, *target;
} meshes;

static icc_status find(const icc_env *env, icc_error *err, void *argument)
{
    const meshes *m = argument;
    iccp_env own;
    iccp_bad_loop loop;
    bool exists;
    icc_status status = iccp_env_read(&own, env, err);
    if (status == ICC_OK)
        status = iccp_bad_loop_find(&loop, &exists, m->source, m->target, &own, err);
    if (status == ICC_OK)
        iccp_bad_loop_free(&loop);
    return status;
}

START_TEST(test_failures)
{
    iccp_simplices *mesh[4] = {make(make_ring_voids, 4, 0), make(make_ring_voids, 13, 0),
                               make(make_plate, 2, 0), make(make_plate, 2, 9)};
    meshes pairs[2] = {{mesh[0], mesh[1]}, {mesh[2], mesh[3]}};
    for (int i = 0; i < 2; ++i)
        faulty_sweep(find, &pairs[i]);
    for (int i = 0; i < 4; ++i)
        iccp_simplices_free(mesh[i]);
}
END_TEST

/* ---- domains ---- */

enum { N_ROUND = 12 };

/* A torus with N_ROUND by N_ROUND vertices; `exchanged` turns it inside out: it goes around what it
 * went through. */
static icc_domain *make_torus(bool exchanged, bool filled)
{
    static double vertices[3 * N_ROUND * N_ROUND];
    static uint32_t facets[6 * N_ROUND * N_ROUND];
    const double turn = 8 * atan(1) / N_ROUND;
    const size_t n = N_ROUND * N_ROUND;
    icc_domain *surface = NULL, *domain = NULL;
    for (uint32_t i = 0; i < N_ROUND; ++i)
        for (uint32_t j = 0; j < N_ROUND; ++j) {
            const double u = turn * (exchanged ? j : i), v = turn * (exchanged ? i : j);
            const double radius = 1 + 0.4 * cos(v), sign = exchanged ? -1 : 1;
            double *at = vertices + 3 * (N_ROUND * i + j);
            uint32_t *f = facets + 6 * (N_ROUND * i + j);
            const uint32_t corners[4] = {torus_vertex(N_ROUND, (int)i, (int)j),
                                         torus_vertex(N_ROUND, (int)i + 1, (int)j),
                                         torus_vertex(N_ROUND, (int)i + 1, (int)j + 1),
                                         torus_vertex(N_ROUND, (int)i, (int)j + 1)};
            at[0] = radius * cos(u);
            at[1] = radius * sin(u) * sign; /* the faces then face outwards on both */
            at[2] = 0.4 * sin(v);
            for (int k = 0; k < 6; ++k)
                f[k] = corners[k < 3 ? k : k == 3 ? 0 : k - 2];
        }
    ck_assert_int_eq(icc_domain_create(&surface, 3, n, vertices, 2 * n, facets, NULL, NULL),
                     ICC_OK);
    if (!filled)
        return surface;
    ck_assert_int_eq(icc_domain_fill(&domain, surface, NULL, NULL, NULL), ICC_OK);
    icc_domain_free(surface);
    return domain;
}

static icc_status has_map(const icc_env *env, icc_error *err, void *argument)
{
    const bool *exchanged = argument;
    iccp_env own;
    icc_status status = iccp_env_read(&own, env, err);
    icc_domain *source = make_torus(false, true), *target = make_torus(*exchanged, false);
    icc_domain *filled = NULL;
    if (status == ICC_OK)
        status = iccp_solid_has_map(&filled, source, target, &own, err);
    ck_assert_int_eq(filled != NULL, status == ICC_OK);
    iccp_domain_release(filled);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

START_TEST(test_domains)
{
    bool exchanged = false;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(has_map(NULL, NULL, &exchanged), ICC_OK);
    faulty_sweep(has_map, &exchanged);
    exchanged = true;
    ck_assert_int_eq(has_map(NULL, &err, &exchanged), ICC_ERR_TOPOLOGY);
    ck_assert_int_eq(err.item, ICC_ITEM_VERTEX);
    ck_assert(err.index >= 0 && err.index < N_ROUND * N_ROUND);
    ck_assert_ptr_nonnull(strstr(err.message, "handle of the outer surface"));
    ck_assert_ptr_nonnull(strstr(err.message, "inside the source, but not inside the target"));
    ck_assert_ptr_nonnull(strstr(err.message, "same loops bound"));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("no map");
    TCase *tc = tcase_create("no map");
    tcase_add_test(tc, test_solid_tori);
    tcase_add_test(tc, test_maps);
    tcase_add_test(tc, test_no_maps);
    tcase_add_test(tc, test_classes);
    tcase_add_test(tc, test_no_handles);
    tcase_add_test(tc, test_failures);
    tcase_add_test(tc, test_domains);
    suite_add_tcase(suite, tc);
    return suite_run(suite);
}
