/* Isotopy classes of maps with features: ties in and out, and sequences of crossed edges. */
#include "map/isotopy/isotopy.h"
#include "map/isotopy/sequence_motion.h"
#include "map/map.h"
#include "map/plane/plane_kind.h"

#include "../../../feature_pairs.h"
#include "../../../infos.h"
#include "../../../reports.h"
#include "../../../saved.h"
#include "../../../share.h"
#include "../../../suite.h"

typedef struct given_tie {
    icc_tie_info info;
    double *source, *target;
} given_tie;

enum { MOST_TIES = 16 };

/* The ties of a map, as options. */
static size_t read_ties(const icc_map *map, given_tie *given, icc_tie *ties)
{
    const size_t n = info_of_map(map).n_ties;
    ck_assert_uint_le(n, MOST_TIES);
    for (size_t k = 0; k < n; ++k) {
        given_tie *g = &given[k];
        g->info = (icc_tie_info){.size = sizeof g->info};
        ck_assert_int_eq(icc_map_get_tie(map, k, &g->info, NULL, NULL), ICC_OK);
        g->source = saved_alloc(2 * g->info.n_source * sizeof(double));
        g->target = saved_alloc(2 * g->info.n_target * sizeof(double));
        ck_assert_int_eq(icc_map_get_tie(map, k, &g->info, g->source, g->target), ICC_OK);
        ties[k] = (icc_tie){.size = sizeof *ties,
                            .vertex = {g->info.vertex[0], g->info.vertex[1]},
                            .n_source = g->info.n_source,
                            .source = g->source,
                            .n_target = g->info.n_target,
                            .target = g->target};
    }
    icc_tie_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_tie(map, n, &info, NULL, NULL), ICC_ERR_ARGUMENT);
    return n;
}

static void free_ties(given_tie *given, size_t n)
{
    for (size_t k = 0; k < n; ++k) {
        free(given[k].source);
        free(given[k].target);
    }
}

static icc_map *map_with(const icc_domain *source, const icc_domain *target, size_t n_ties,
                         const icc_tie *ties, int32_t iterations)
{
    const icc_map_options options = {
        .size = sizeof options, .iterations = iterations, .n_ties = n_ties, .ties = ties};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    ck_assert_msg(icc_map_create(&map, source, target, &options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    const icc_map_info info = info_of_map(map);
    ck_assert(info.certified == 1 && info.class_kept == 1);
    return map;
}

/* The ties of a map give another map of the same class. */
static void check_returned(const icc_map *map)
{
    given_tie given[MOST_TIES];
    icc_tie ties[MOST_TIES];
    const size_t n = read_ties(map, given, ties);
    ck_assert_uint_eq(n, map->source_domain->features->n);
    icc_map *again = map_with(map->source_domain, map->target_domain, n, ties, -1);
    ck_assert(iccp_isotopy_same(iccp_plane_of(map)->isotopy, iccp_plane_of(again)->isotopy));
    icc_map_free(again);
    free_ties(given, n);
}

/* ---- turns about two points ---- */

enum { PLACES = 48 };

/* The square with two points, and the tie from a corner that goes round both of them `turns` times
 * before it meets the first. */
static plan two_points(void)
{
    plan p = plan_square(10);
    plan_point(&p, 3.5, 4.5);
    plan_point(&p, 6, 5);
    return p;
}

static size_t spiral(int turns, double *bends)
{
    const double centre[2] = {4.75, 4.75}, from = atan2(-4.75, -4.75), to = atan2(-0.25, -1.25);
    const size_t n = turns == 0 ? 0 : PLACES * (size_t)turns;
    for (size_t k = 0; k < n; ++k) {
        const double share = ((double)k + 0.5) / (double)n;
        const double a =
            from + share * (to - 6.283185307179586 + 6.283185307179586 * (1 - turns) - from);
        const double r = 4 - 2 * share;
        bends[2 * k] = centre[0] + r * cos(a);
        bends[2 * k + 1] = centre[1] + r * sin(a);
    }
    return n;
}

/* What the tie from the corner crosses in the domain. */
static void read_sequence(iccp_sequences *sequences, const icc_domain *domain, size_t n,
                          const double *bends)
{
    iccp_env env;
    iccp_domain_pair domains;
    iccp_triangulation triangulation;
    double local[6 * PLACES];
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_domain_pair_create(&domains, domain, domain, &env), ICC_OK);
    ck_assert_int_eq(iccp_triangulation_create(&triangulation, &domains.mesh[1], domains.n,
                                               domain->vertices, &domains.walls, &env.memory),
                     ICC_OK);
    for (size_t k = 0; k < n; ++k)
        iccp_frame_in(&domain->frame, 2, bends + 2 * k, local + 2 * k);
    ck_assert_int_eq(iccp_sequences_begin(sequences, 1, &env.memory), ICC_OK);
    ck_assert_int_eq(
        iccp_sequence_read(&sequences->sequence[0], &triangulation, 0, 4, n, local, &env), ICC_OK);
    iccp_triangulation_free(&triangulation, &env.memory);
    iccp_domain_pair_free(&domains);
}

/* Both when it is drawn with few bends and as the image of the straight line. */
static void check_tie_from_corner(const icc_map *map, const iccp_sequences *wanted)
{
    given_tie given[MOST_TIES];
    icc_tie ties[MOST_TIES];
    const size_t n = read_ties(map, given, ties);
    ck_assert_uint_eq(n, 2);
    const size_t k = ties[0].vertex[0] == 0 ? 0 : 1;
    ck_assert(ties[k].vertex[0] == 0 && ties[k].vertex[1] == 4 && ties[k].n_source == 0);
    ck_assert(ties[1 - k].vertex[0] == 4 && ties[1 - k].vertex[1] == 5 &&
              ties[1 - k].n_target == 0);
    iccp_sequences drawn;
    read_sequence(&drawn, map->target_domain, ties[k].n_target, ties[k].target);
    ck_assert(iccp_sequences_same(&drawn, wanted));
    iccp_sequences own = {.n = 1, .sequence = &iccp_plane_of(map)->isotopy->sequences.sequence[k]};
    ck_assert(iccp_sequences_same(&own, wanted));
    iccp_sequences_free(&drawn);
    free_ties(given, n);
}

/* The identity on two points, with ties that go round them 0, 1 and 2 times: the images of the cuts
 * are what the ties say, and stay so. */
START_TEST(turns)
{
    static const double LARGEST[3] = {4.001, 14, 42};
    const plan p = two_points();
    icc_domain *domain = plan_domain(&p);
    double bends[4 * PLACES], last = 0;
    for (int k = 0; k < 3; ++k) {
        const size_t n = spiral(k, bends);
        const icc_tie ties[2] = {
            {.size = sizeof *ties, .vertex = {0, 4}, .n_target = n, .target = bends},
            {.size = sizeof *ties, .vertex = {4, 5}}};
        iccp_sequences wanted;
        read_sequence(&wanted, domain, n, bends);
        ck_assert((wanted.sequence[0].n == 0) == (k == 0));
        icc_map *map = map_with(domain, domain, 2, ties, 0), *better, *next, *loaded;
        const icc_map_info info = info_of_map(map);
        ck_assert_double_le(info.energy, LARGEST[k]);
        ck_assert(info.n_points == 2 && info.n_holes == 0 && info.n_lines == 0 && info.n_ties == 2);
        ck_assert(report_of(map).n_trees == 1);
        ck_assert(k == 0 ? fabs(info.detour - 1) < 1e-12 : info.detour > last + 0.5);
        last = info.detour;
        check_tie_from_corner(map, &wanted);
        check_returned(map);
        const icc_improve_options few = {.size = sizeof few, .iterations = 3, .levels = 1};
        ck_assert_int_eq(icc_map_improve(&better, map, &few, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(info_of_map(better).class_kept, 1);
        check_tie_from_corner(better, &wanted);
        ck_assert_int_eq(icc_map_retarget(&next, better, domain, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(info_of_map(next).class_kept, 1);
        check_tie_from_corner(next, &wanted);
        bytes b = map_bytes(next);
        ck_assert_int_eq(icc_map_load(&loaded, b.n, b.data, NULL, NULL), ICC_OK);
        check_tie_from_corner(loaded, &wanted);
        free(b.data);
        icc_map_free(loaded);
        icc_map_free(next);
        icc_map_free(better);
        icc_map_free(map);
        iccp_sequences_free(&wanted);
    }
    icc_domain_free(domain);
}
END_TEST

/* ---- any features ---- */

START_TEST(returned)
{
    for (int k = 0; k < N_PLANS; ++k) {
        plan plans[2];
        plans_number(k, &plans[0], &plans[1]);
        icc_domain *domains[2] = {plan_domain(&plans[0]), plan_domain(&plans[1])};
        for (int turn = 0; turn < 2; ++turn) {
            icc_map *map = map_with(domains[turn], domains[1 - turn], 0, NULL, 0);
            check_returned(map);
            icc_map_free(map);
        }
        icc_domain_free(domains[0]);
        icc_domain_free(domains[1]);
    }
}
END_TEST

/* Points and small holes anywhere. */
static plan random_plan(random_source *r, size_t n)
{
    for (;;) {
        plan p = plan_square(100);
        for (size_t k = 0; k < n; ++k) {
            const double x = random_between(r, 8, 92), y = random_between(r, 8, 92);
            if (k % 3 == 2)
                plan_hole(&p, 4, x, y, 3, 0.3);
            else if (k % 3 == 1)
                plan_feature(&p, ICC_FEATURE_LINE, 2, (const double[]){x, y, x + 5, y + 1});
            else
                plan_point(&p, x, y);
        }
        icc_domain *domain;
        if (plan_try(&domain, &p, NULL, NULL) == ICC_OK) {
            icc_domain_free(domain);
            return p;
        }
    }
}

START_TEST(random_returned)
{
    random_source r = {4};
    for (int round = 0; round < share_of(60); ++round) {
        const size_t n = 1 + (size_t)random_below(&r, 6);
        const plan source = random_plan(&r, n), target = random_plan(&r, n);
        icc_domain *domains[2] = {plan_domain(&source), plan_domain(&target)};
        icc_map *map = map_with(domains[0], domains[1], 0, NULL, 2);
        check_returned(map);
        icc_map_free(map);
        icc_domain_free(domains[0]);
        icc_domain_free(domains[1]);
    }
}
END_TEST

/* ---- motion ---- */

/* Two targets that are the same, of which one point went round the other in between: carried along,
 * the map is kept at each step, but it is not what it was. */
START_TEST(carried_round)
{
    const plan p = two_points();
    icc_domain *source = plan_domain(&p);
    icc_map *first = map_with(source, source, 0, NULL, 0), *map = first;
    enum { STEPS = 24 };
    for (int k = 1; k <= STEPS; ++k) {
        plan moved = p;
        const double a = 6.283185307179586 * k / STEPS;
        moved.xy[10] = 3.5 + 2 * cos(a) * 1.25 - 0.5 * sin(a);
        moved.xy[11] = 4.5 + 2 * sin(a) * 1.25 + 0.5 * cos(a);
        if (k == STEPS)
            moved = p;
        icc_domain *target = plan_domain(&moved);
        icc_map *next;
        ck_assert_int_eq(icc_map_retarget(&next, map, target, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(info_of_map(next).class_kept, 1);
        icc_domain_free(target);
        if (map != first)
            icc_map_free(map);
        map = next;
    }
    ck_assert(!iccp_isotopy_same(iccp_plane_of(map)->isotopy, iccp_plane_of(first)->isotopy));
    ck_assert(info_of_map(map).detour > 1.2 && info_of_map(first).detour < 1.001);
    check_returned(map);
    /* The one is not what the other becomes when nothing moves. */
    iccp_env env;
    bool kept = true;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_isotopy_is_kept(&kept, iccp_plane_of(first)->isotopy,
                                          first->target_domain, &iccp_plane_of(map)->pl, source,
                                          map->target_domain, &env),
                     ICC_OK);
    ck_assert(!kept);
    ck_assert_int_eq(iccp_isotopy_is_kept(&kept, iccp_plane_of(first)->isotopy,
                                          first->target_domain, &iccp_plane_of(first)->pl, source,
                                          source, &env),
                     ICC_OK);
    ck_assert(kept);
    icc_map_free(map);
    icc_map_free(first);
    icc_domain_free(source);
}
END_TEST

/* Sequences that move with the vertices to other places and back are unchanged, whatever edges flip
 * on the way. */
START_TEST(there_and_back)
{
    random_source r = {8};
    int n_moved = 0;
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (int round = 0; round < share_of(200); ++round) {
        const size_t n = 2 + (size_t)random_below(&r, 6);
        const plan here = random_plan(&r, n), there = random_plan(&r, n);
        icc_domain *domains[2] = {plan_domain(&here), plan_domain(&there)};
        icc_map *map = map_with(domains[0], domains[0], 0, NULL, -1);
        iccp_domain_pair pair;
        iccp_triangulation triangulation;
        iccp_moving_triangulation moving;
        bool arrived;
        ck_assert_int_eq(iccp_domain_pair_create(&pair, domains[0], domains[0], &env), ICC_OK);
        ck_assert_int_eq(iccp_triangulation_create(&triangulation, &pair.mesh[1], pair.n,
                                                   domains[0]->vertices, &pair.walls, &env.memory),
                         ICC_OK);
        ck_assert_int_eq(iccp_moving_triangulation_create(&moving, &triangulation, pair.n,
                                                          domains[0]->vertices, &env.memory),
                         ICC_OK);
        iccp_sequences *sequences = &iccp_plane_of(map)->isotopy->sequences;
        ck_assert_int_eq(
            iccp_sequences_move(sequences, &moving, domains[1]->vertices, &arrived, &env), ICC_OK);
        if (arrived) {
            ck_assert_int_eq(
                iccp_sequences_move(sequences, &moving, domains[0]->vertices, &arrived, &env),
                ICC_OK);
            ck_assert(arrived);
            iccp_sequences back;
            iccp_cuts tree;
            ck_assert_int_eq(iccp_cuts_begin(&tree, sequences->n, &env.memory), ICC_OK);
            for (size_t k = 0; k < sequences->n; ++k)
                memcpy(tree.ends + 2 * k, sequences->sequence[k].ends, 2 * sizeof *tree.ends);
            ck_assert_int_eq(iccp_sequences_of_cuts(&back, &tree, &moving.triangulation, &env),
                             ICC_OK);
            ck_assert(iccp_sequences_same(sequences, &back));
            iccp_sequences_free(&back);
            iccp_cuts_free(&tree);
            ++n_moved;
        }
        iccp_moving_triangulation_free(&moving);
        iccp_triangulation_free(&triangulation, &env.memory);
        iccp_domain_pair_free(&pair);
        icc_map_free(map);
        icc_domain_free(domains[0]);
        icc_domain_free(domains[1]);
    }
    ck_assert_int_gt(n_moved, share_of(60) - 1);
}
END_TEST

/* ---- sequences ---- */

/* A square with a point in its middle: four triangles around it. */
START_TEST(sequences)
{
    static uint32_t vertex[12], twin[12];
    static const uint32_t corners[12] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    static const double points[10] = {0, 0, 4, 0, 4, 4, 0, 4, 2, 2};
    iccp_corners mesh = {vertex, twin, 4};
    iccp_triangulation triangulation;
    iccp_env env;
    bool is_manifold;
    iccp_sequence sequence = {.n = 0};
    memcpy(vertex, corners, sizeof vertex);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_find_twins(&mesh, 5, &is_manifold, &env), ICC_OK);
    ck_assert_int_eq(iccp_triangulation_create(&triangulation, &mesh, 5, points, NULL, &env.memory),
                     ICC_OK);
    /* Through the vertex in the middle: past it, always on the same side. */
    ck_assert_int_eq(iccp_sequence_read(&sequence, &triangulation, 0, 2, 0, NULL, &env), ICC_OK);
    ck_assert(sequence.n == 1 && sequence.sides[0] == 1 && sequence.sides[1] == 4);
    /* Along edges, and with bends on them. */
    ck_assert_int_eq(iccp_sequence_read(&sequence, &triangulation, 0, 4, 0, NULL, &env), ICC_OK);
    ck_assert_uint_eq(sequence.n, 0);
    ck_assert_int_eq(iccp_sequence_read(&sequence, &triangulation, 0, 4, 2,
                                        (const double[]){1, 1, 1.5, 1.5}, &env),
                     ICC_OK);
    ck_assert_uint_eq(sequence.n, 0);
    /* Around the middle on either side. */
    ck_assert_int_eq(
        iccp_sequence_read(&sequence, &triangulation, 0, 2, 2, (const double[]){1, 3, 2, 3}, &env),
        ICC_OK);
    ck_assert(sequence.n == 1 && sequence.sides[0] == 4 && sequence.sides[1] == 3);
    ck_assert_int_eq(iccp_sequence_read(&sequence, &triangulation, 0, 2, 3,
                                        (const double[]){1, 3, 1, 3, 1, 0.5}, &env),
                     ICC_OK);
    ck_assert(sequence.n == 1 && sequence.sides[0] == 1 && sequence.sides[1] == 4);
    /* Once more than round, and back. */
    const double round[8] = {3, 1, 3, 3, 1, 3, 1, 0.5};
    ck_assert_int_eq(iccp_sequence_read(&sequence, &triangulation, 0, 2, 4, round, &env), ICC_OK);
    ck_assert_uint_eq(sequence.n, 5);
    /* A turn about its own end is none. */
    ck_assert_int_eq(iccp_sequence_read(&sequence, &triangulation, 0, 4, 4, round, &env), ICC_OK);
    ck_assert_uint_eq(sequence.n, 0);
    /* Outside. */
    ck_assert_int_eq(
        iccp_sequence_read(&sequence, &triangulation, 0, 2, 1, (const double[]){5, 2}, &env),
        ICC_ERR_TOPOLOGY);
    ck_assert_int_eq(
        iccp_sequence_read(&sequence, &triangulation, 0, 2, 1, (const double[]){-1, 2}, &env),
        ICC_ERR_TOPOLOGY);
    ck_assert_uint_eq(mesh.vertex[iccp_fans_edge(&triangulation.fans, &mesh, 1, 4)], 0);
    iccp_free(&env.memory, sequence.sides);
    iccp_triangulation_free(&triangulation, &env.memory);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("isotopy");
    TCase *c = tcase_create("isotopy");
    tcase_add_test(c, turns);
    tcase_add_test(c, returned);
    tcase_add_test(c, random_returned);
    tcase_add_test(c, carried_round);
    tcase_add_test(c, there_and_back);
    tcase_add_test(c, sequences);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
