/* Features that go far in space: the chain finds one certified map where the direct way gets
 * stuck. */
#include "../../../domains.h"
#include "../../../faulty.h"
#include "../../../infos.h"
#include "../../../random.h"
#include "../../../suite.h"
#include "../../../surfaces.h"
#include "fill/fill_domain.h"
#include "geometry/simplices.h"
#include "map/kind/kind.h"
#include "map/solid/feature_motion.h"
#include "map/solid/solid_chain.h"

enum { MOST_FEATURES = 12, MOST_POINTS = 200 };

/* A unit ball with features. */
typedef struct body {
    size_t n, n_points;
    icc_feature features[MOST_FEATURES];
    double points[3 * MOST_POINTS];
} body;

static surface ball, small;

static void set_surfaces(int n_splits)
{
    surface_octahedron(&small);
    surface_octahedron(&ball);
    for (int k = 0; k < n_splits; ++k)
        surface_split(&ball);
    for (size_t v = 0; v < ball.n_vertices; ++v) {
        double *x = ball.vertices + 3 * v;
        const double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        for (int k = 0; k < 3; ++k)
            x[k] /= length;
    }
}

/* Adds a feature of n points, scaled and moved. */
static void add(body *b, int32_t kind, size_t n, const double *points, double size,
                const double *place)
{
    double *own = b->points + 3 * b->n_points;
    const bool is_surface = kind == ICC_FEATURE_HOLE || kind == ICC_FEATURE_REGION;
    for (size_t i = 0; i < 3 * n; ++i)
        own[i] = size * points[i] + place[i % 3];
    b->n_points += n;
    b->features[b->n++] = (icc_feature){.size = sizeof(icc_feature),
                                        .kind = kind,
                                        .n_vertices = n,
                                        .vertices = own,
                                        .n_facets = is_surface ? small.n_faces : 0,
                                        .facets = is_surface ? small.faces : NULL};
}

static icc_domain *solid_of(const body *b)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create_solid(&domain, ball.n_vertices, ball.vertices, ball.n_faces,
                                          ball.faces, b->n, b->features, NULL, &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

/* Two voids change places, beside a line that turns round. */
static void set_exchange(body *b, int side)
{
    static const double LINE[9] = {-0.3, 0.1, 0, 0, 0, 0.1, 0.3, 0, 0};
    const double x = side == 0 ? 0.45 : -0.45;
    b->n = b->n_points = 0;
    add(b, ICC_FEATURE_HOLE, 6, small.vertices, 0.25, (const double[3]){x, 0, 0});
    add(b, ICC_FEATURE_HOLE, 6, small.vertices, 0.25, (const double[3]){-x, 0.1, 0});
    add(b, ICC_FEATURE_LINE, 3, LINE, x > 0 ? 1 : -1, (const double[3]){0, 0, x});
}

/* A region with a void and a point in it, whose places in the region change, goes to the other side
 * of the ball, past a void. */
static void set_nested(body *b, int side)
{
    static const double POINT[3] = {0, 0, 0};
    const double x = side == 0 ? 0.4 : -0.4, y = side == 0 ? 0.14 : -0.14;
    b->n = b->n_points = 0;
    add(b, ICC_FEATURE_REGION, 6, small.vertices, 0.4, (const double[3]){x, 0, 0});
    add(b, ICC_FEATURE_HOLE, 6, small.vertices, 0.1, (const double[3]){x, y, 0});
    add(b, ICC_FEATURE_POINT, 1, POINT, 1, (const double[3]){x, -y, 0});
    add(b, ICC_FEATURE_HOLE, 6, small.vertices, 0.2, (const double[3]){-x, 0.1, 0});
}

/* Ten points anywhere. */
static void set_points(body *b, int side)
{
    random_source random = {side == 0 ? 1 : 2};
    b->n = b->n_points = 0;
    while (b->n < 10) {
        double place[3];
        static const double POINT[3] = {0, 0, 0};
        bool is_near = false;
        for (int k = 0; k < 3; ++k)
            place[k] = random_between(&random, -0.6, 0.6);
        if (place[0] * place[0] + place[1] * place[1] + place[2] * place[2] > 0.49)
            continue;
        for (size_t i = 0; i < b->n; ++i) {
            const double *p = b->points + 3 * i;
            is_near |= hypot(hypot(p[0] - place[0], p[1] - place[1]), p[2] - place[2]) < 0.15;
        }
        if (!is_near)
            add(b, ICC_FEATURE_POINT, 1, POINT, 1, place);
    }
}

typedef void set_body(body *b, int side);

static void make_pair(set_body *set, int n_splits, icc_domain *pair[2])
{
    static body b;
    set_surfaces(n_splits);
    for (int side = 0; side < 2; ++side) {
        set(&b, side);
        pair[side] = solid_of(&b);
    }
}

/* Runs the chain after the direct way, even if that has succeeded. */
static icc_status run_chain(icc_domain *const pair[2], size_t *n_left, const iccp_env *env)
{
    const iccp_direction way = {pair[0], pair[1]};
    iccp_solid_map map = {.memory = env->memory, .mesh = pair[0]->mesh, .stretch = 1};
    iccp_map_facts facts = {0};
    icc_status status = iccp_solid_fit(&map, way, &facts, env);
    facts.n_unrepaired = SIZE_MAX;
    if (status == ICC_OK)
        status = iccp_solid_chain(&map, way, &facts, env);
    *n_left = facts.n_unrepaired;
    if (status == ICC_OK && *n_left == 0) {
        ck_assert_uint_eq(iccp_solid_count_inverted(&map), 0);
        ck_assert_int_eq(
            memcmp(map.images, pair[1]->vertices, 3 * pair[1]->n_vertices * sizeof *map.images), 0);
    }
    iccp_simplices_free(map.own);
    iccp_free(&map.memory, map.images);
    return status;
}

/* A body with the mesh that a map begins with. */
static icc_domain *filled(icc_domain *solid)
{
    icc_domain *domain;
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_domain_fill_for_map(&domain, solid, &env, NULL), ICC_OK);
    icc_domain_free(solid);
    return domain;
}

START_TEST(far_away)
{
    static set_body *const BODIES[] = {set_exchange, set_nested, set_points};
    icc_domain *pair[2];
    make_pair(BODIES[_i], 2, pair);
    pair[0] = filled(pair[0]);
    iccp_env env;
    size_t n_left;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(run_chain(pair, &n_left, &env), ICC_OK);
    ck_assert_uint_eq(n_left, 0);
    if (_i == 0) {
        icc_map *map;
        ck_assert_int_eq(icc_map_create(&map, pair[0], pair[1], NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(info_of_map(map).certified, 1);
        icc_map_free(map);
    }
    icc_domain_free(pair[0]);
    icc_domain_free(pair[1]);
}
END_TEST

/* At the ends of its stages, a motion is where it should be. */
START_TEST(stages)
{
    static const iccp_motion_stage OTHER[2] = {ICCP_MOTION_SHRINKS, ICCP_MOTION_OUTER};
    icc_domain *pair[2], *at[2];
    iccp_carrier carriers[4];
    iccp_feature_motion motion;
    iccp_env env;
    make_pair(set_nested, 2, pair);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (size_t f = 0; f < 4; ++f) {
        carriers[f] = (iccp_carrier){.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .scale = 1};
        iccp_feature_centre(pair[1], f, carriers[f].from);
    }
    ck_assert_int_eq(iccp_feature_motion_create(&motion, pair[0], pair[1], carriers, &env.memory),
                     ICC_OK);
    for (int stage = 0; stage < 2; ++stage) {
        motion.scale = 0.5;
        ck_assert_int_eq(iccp_feature_waypoint(&at[0], &motion, OTHER[stage], 1 - stage, &env),
                         ICC_OK);
        ck_assert_int_eq(iccp_feature_waypoint(&at[1], &motion, ICCP_MOTION_MOVES, stage, &env),
                         ICC_OK);
        for (size_t i = 0; i < 3 * at[0]->n_vertices; ++i)
            ck_assert_double_eq_tol(at[0]->given[i], at[1]->given[i], 1e-12);
        icc_domain_free(at[0]);
        icc_domain_free(at[1]);
    }
    motion.scale = 1;
    ck_assert_int_eq(iccp_feature_waypoint(&at[0], &motion, ICCP_MOTION_OUTER, 1, &env), ICC_OK);
    for (size_t i = 0; i < 3 * at[0]->n_vertices; ++i)
        ck_assert_double_eq_tol(at[0]->given[i], pair[1]->given[i], 1e-12);
    icc_domain_free(at[0]);
    iccp_feature_motion_free(&motion);
    icc_domain_free(pair[0]);
    icc_domain_free(pair[1]);
}
END_TEST

static icc_status make_once(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *const *pair = argument;
    iccp_env own;
    size_t n_left;
    ck_assert_int_eq(iccp_env_read(&own, env, err), ICC_OK);
    const icc_status status = run_chain(pair, &n_left, &own);
    if (status != ICC_OK) { /* the caller of a strategy describes its failure */
        err->status = status;
        err->message[0] = '.';
    } else
        ck_assert_uint_eq(n_left, 0);
    return status;
}

/* One small void and a point: so the sweep is short. */
static void set_simple(body *b, int side)
{
    static const double POINT[3] = {0, 0, 0};
    const double x = side == 0 ? 0.3 : -0.3;
    b->n = b->n_points = 0;
    add(b, ICC_FEATURE_HOLE, 6, small.vertices, 0.2, (const double[3]){x, 0, 0});
    add(b, ICC_FEATURE_POINT, 1, POINT, 1, (const double[3]){0, x, 0.4});
}

START_TEST(failures)
{
    icc_domain *pair[2];
    make_pair(set_simple, 1, pair);
    pair[0] = filled(pair[0]);
    faulty_sweep(make_once, pair);
    icc_domain_free(pair[0]);
    icc_domain_free(pair[1]);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("chains of solids with features");
    TCase *tcase = tcase_create("all");
    tcase_set_timeout(tcase, 300);
    tcase_add_loop_test(tcase, far_away, 0, 3);
    tcase_add_test(tcase, stages);
    tcase_add_test(tcase, failures);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
