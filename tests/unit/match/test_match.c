#include <icc/icc.h>

#include "../../domains.h"
#include "../../faulty.h"
#include "../../random.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* A key with a bit at one end: no symmetry. */
static const double key[] = {0, 0,  4, 0, 4, -1, 5, -1, 5,  0, 6,  0,  6, -2,
                             7, -2, 7, 1, 1, 1,  1, 2,  -1, 2, -1, -1, 0, -1};
enum { N_KEY = sizeof key / sizeof key[0] / 2, N_CUT = 3 * N_KEY };

/* The key's edges cut at two places each, from another vertex on; turned and scaled; backwards. */
static void cut_key(double *xy, size_t first, double turn, double scale, bool is_backward)
{
    for (size_t k = 0; k < N_CUT; ++k) {
        const size_t at = (first + (is_backward ? N_CUT - k : k)) % N_CUT;
        const double *const p = key + 2 * (at / 3), *const q = key + 2 * ((at / 3 + 1) % N_KEY);
        const double f = (double)(at % 3) * .31;
        const double x = p[0] + f * (q[0] - p[0]), y = p[1] + f * (q[1] - p[1]);
        xy[2 * k] = scale * (cos(turn) * x - sin(turn) * y) + 3;
        xy[2 * k + 1] = scale * (sin(turn) * x + cos(turn) * y) - 5;
    }
}

static icc_status match_of(icc_match **match, size_t n, const double *a, size_t m, const double *b,
                           size_t n_landmarks, const double *landmarks,
                           const icc_match_options *options, icc_error *err)
{
    icc_domain *source = domain_of_polygon(n, a), *target = domain_of_polygon(m, b);
    const icc_status status =
        icc_match_create(match, source, target, n_landmarks, landmarks, options, NULL, err);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

/* Every vertex is in the result bit by bit and in order; edges stretch by 1e-3 .. 1e3. */
static void check_exact(const icc_match *match, size_t n, const double *a, size_t m,
                        const double *b)
{
    icc_match_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    uint32_t *origin[2];
    const icc_domain *domains[2] = {icc_match_source(match), icc_match_target(match)};
    const double *given[2] = {a, b};
    const size_t count[2] = {n, m};
    for (int e = 0; e < 2; ++e) {
        origin[e] = malloc(info.n_vertices * sizeof(uint32_t));
        ck_assert_ptr_nonnull(origin[e]);
    }
    ck_assert_int_eq(icc_match_get_origins(match, origin[0], origin[1]), ICC_OK);
    ck_assert_uint_eq(origin[0][0], 0);
    for (int e = 0; e < 2; ++e) {
        double *const xy = malloc(info.n_vertices * 2 * sizeof(double));
        ck_assert_ptr_nonnull(xy);
        ck_assert_int_eq(icc_domain_get_boundary(domains[e], xy, NULL), ICC_OK);
        size_t n_found = 0, n_up = 0, n_down = 0;
        uint32_t last = UINT32_MAX;
        for (size_t k = 0; k < info.n_vertices; ++k) {
            const uint32_t v = origin[e][k];
            if (v == UINT32_MAX)
                continue;
            ck_assert_uint_lt(v, count[e]);
            ck_assert_int_eq(memcmp(xy + 2 * k, given[e] + 2 * v, 2 * sizeof(double)), 0);
            n_up += last != UINT32_MAX && v == (last + 1) % count[e];
            n_down += last != UINT32_MAX && last == (v + 1) % count[e];
            last = v;
            ++n_found;
        }
        ck_assert_uint_eq(n_found, count[e]);
        ck_assert(n_up == n_found - 1 || n_down == n_found - 1);
        free(xy);
        free(origin[e]);
    }
    ck_assert(info.least_slope >= 1e-3 && info.most_slope <= 1e3);
    icc_map *map = NULL;
    ck_assert_int_eq(icc_map_create(&map, domains[0], domains[1], NULL, NULL, NULL), ICC_OK);
    icc_map_free(map);
}

/* Starts, senses, places and sizes make no difference: what is cut is paired with what it was. */
START_TEST(finds_the_same_shape)
{
    for (int k = 0; k < 8; ++k) {
        double a[2 * N_CUT];
        cut_key(a, (size_t)(7 * k), .1 * k, 1 + 30.0 * k, k % 2 == 1);
        for (int way = 0; way < 2; ++way) {
            icc_match *match = NULL;
            icc_error err = {.size = sizeof err};
            const icc_status status =
                way == 0 ? match_of(&match, N_KEY, key, N_CUT, a, 0, NULL, NULL, &err)
                         : match_of(&match, N_CUT, a, N_KEY, key, 0, NULL, NULL, &err);
            ck_assert_msg(status == ICC_OK, "%d %d: %s", k, way, err.message);
            icc_match_info info = {.size = sizeof info};
            ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
            ck_assert_uint_eq(info.n_vertices, N_CUT);
            ck_assert_uint_eq(info.n_joined, N_KEY);
            ck_assert_int_eq(info.mirrored, 0);
            const double turn = (way == 0 ? 1 : -1) * .1 * k * 180 / 3.14159265358979;
            ck_assert_double_lt(fabs(info.turn - turn), 1);
            if (way == 0)
                check_exact(match, N_KEY, key, N_CUT, a);
            else
                check_exact(match, N_CUT, a, N_KEY, key);
            icc_match_free(match);
        }
    }
}
END_TEST

/* A mirror image is said to be one. */
START_TEST(tells_a_mirror_image)
{
    double a[2 * N_KEY];
    for (size_t k = 0; k < N_KEY; ++k) {
        a[2 * k] = -key[2 * k];
        a[2 * k + 1] = key[2 * k + 1];
    }
    icc_match *match = NULL;
    const icc_match_options options = {.size = sizeof options, .least_sure = 1};
    icc_error err = {.size = sizeof err};
    const icc_status status = match_of(&match, N_KEY, key, N_KEY, a, 0, NULL, &options, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    icc_match_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    ck_assert_int_eq(info.mirrored, 1);
    icc_match_free(match);
}
END_TEST

/* An outline of n vertices with six waves, drawn from another place. */
static void draw_waves(double *xy, size_t n, double from, const double wave[6][2])
{
    for (size_t k = 0; k < n; ++k) {
        const double at = 6.283185307179586 * (double)k / (double)n + from;
        double r = 1;
        for (int m = 0; m < 6; ++m)
            r += wave[m][0] * cos((m + 1) * at) + wave[m][1] * sin((m + 1) * at);
        xy[2 * k] = r * cos(at);
        xy[2 * k + 1] = r * sin(at);
    }
}

/* The same outline by other vertices, as it is and with y pointing down, as pixels have it. */
START_TEST(tells_what_has_y_down)
{
    random_source r = {.state = 5};
    for (int k = 0; k < share_of(20); ++k) {
        double wave[6][2], a[2 * 60], b[2 * 45];
        for (int m = 0; m < 12; ++m)
            wave[m / 2][m % 2] = random_between(&r, -.3, .3) / (m / 2 + 2);
        draw_waves(a, 60, 0, (const double(*)[2])wave);
        draw_waves(b, 45, .9, (const double(*)[2])wave);
        for (int down = 0; down < 2; ++down) {
            icc_match *match = NULL;
            icc_match_info info = {.size = sizeof info};
            const icc_match_options options = {.size = sizeof options, .least_sure = 1};
            icc_error err = {.size = sizeof err};
            ck_assert_msg(match_of(&match, 60, a, 45, b, 0, NULL, &options, &err) == ICC_OK, "%s",
                          err.message);
            ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
            ck_assert_msg(info.mirrored == down, "outline %d, cost %g", k, info.cost);
            icc_match_free(match);
            for (size_t v = 0; v < 45; ++v)
                b[2 * v + 1] = -b[2 * v + 1];
        }
    }
}
END_TEST

static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};

/* A square goes to a square in four ways; upright it goes as people expect. */
START_TEST(refuses_what_is_ambiguous)
{
    const double other[] = {2, 0, 2, 1, 2, 2, 0, 2, 0, 0};
    icc_match *match = NULL;
    icc_match_options options = {.size = sizeof options, .turning = ICC_TURNING_FREE};
    ck_assert_int_eq(match_of(&match, 4, square, 5, other, 0, NULL, &options, NULL),
                     ICC_ERR_AMBIGUOUS);
    ck_assert_ptr_null(match);
    icc_error err = {.size = sizeof err};
    const icc_status status = match_of(&match, 4, square, 5, other, 0, NULL, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    icc_match_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    ck_assert_double_lt(fabs(info.turn), 1);
    ck_assert_uint_eq(info.n_joined, 4);
    icc_match_free(match);
}
END_TEST

/* A regular polygon, from another vertex on. */
static void disc(double *xy, size_t n, size_t first)
{
    for (size_t k = 0; k < n; ++k) {
        const double turn = 6.283185307179586 * (double)((k + first) % n) / (double)n;
        xy[2 * k] = 3 * cos(turn);
        xy[2 * k + 1] = 3 * sin(turn);
    }
}

/* Discs have no features: by shape they are refused unless upright
 * is preferred, by arc length each direction is kept. */
START_TEST(pairs_discs_by_arc_length)
{
    enum { N = 60, M = 97 };
    double a[2 * N], b[2 * M], xy[2][2 * (N + M)];
    disc(a, N, 0);
    for (size_t first = 0; first < M; first += 12) {
        disc(b, M, first);
        icc_match *match = NULL;
        icc_match_options options = {.size = sizeof options, .turning = ICC_TURNING_FREE};
        if (first == 0)
            ck_assert_int_eq(match_of(&match, N, a, M, b, 0, NULL, &options, NULL),
                             ICC_ERR_AMBIGUOUS);
        options.between = ICC_BETWEEN_ARC;
        ck_assert_int_eq(match_of(&match, N, a, M, b, 0, NULL, &options, NULL), ICC_OK);
        check_exact(match, N, a, M, b);
        icc_match_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
        (void)icc_domain_get_boundary(icc_match_source(match), xy[0], NULL);
        (void)icc_domain_get_boundary(icc_match_target(match), xy[1], NULL);
        for (size_t k = 0; k < 2 * info.n_vertices; ++k)
            ck_assert_double_lt(fabs(xy[0][k] - xy[1][k]), .06); /* joins: .3 of an edge */
        icc_match_free(match);
    }
}
END_TEST

/* Landmarks, on vertices or edges, are among the common vertices, elastic or by arc length. */
START_TEST(passes_through_landmarks)
{
    const double other[] = {2, 0, 2, 1, 2, 2, 0, 2, 0, 0};
    const double landmarks[] = {.5, 0, 2, .75, 1, 1, 0, 2};
    for (int between = ICC_BETWEEN_ELASTIC; between <= ICC_BETWEEN_ARC; ++between) {
        icc_match *match = NULL;
        const icc_match_options options = {.size = sizeof options, .between = between};
        icc_error err = {.size = sizeof err};
        const icc_status status =
            match_of(&match, 4, square, 5, other, 2, landmarks, &options, &err);
        ck_assert_msg(status == ICC_OK, "%s", err.message);
        icc_match_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
        double xy[2][64];
        ck_assert_uint_le(info.n_vertices, 32);
        (void)icc_domain_get_boundary(icc_match_source(match), xy[0], NULL);
        (void)icc_domain_get_boundary(icc_match_target(match), xy[1], NULL);
        for (size_t k = 0; k < 2; ++k) {
            size_t n_hits = 0;
            for (size_t v = 0; v < info.n_vertices; ++v)
                n_hits += hypot(xy[0][2 * v] - landmarks[4 * k],
                                xy[0][2 * v + 1] - landmarks[4 * k + 1]) < 1e-12 &&
                          hypot(xy[1][2 * v] - landmarks[4 * k + 2],
                                xy[1][2 * v + 1] - landmarks[4 * k + 3]) < 1e-12;
            ck_assert_uint_eq(n_hits, 1);
        }
        check_exact(match, 4, square, 5, other);
        icc_match_free(match);
    }
}
END_TEST

/* A corner beside a landmark, which is far from it in the other outline: that they are paired would
 * stretch the edge between too much, and apart they must not lie in one place. */
START_TEST(takes_apart_what_stretches_too_much)
{
    const double other[] = {2, 0, 2, 1, 2, 2, 0, 2, 0, 0};
    for (int way = 0; way < 2; ++way) {
        const double near = 1 - 4e-6, far = 2 - 2 * .017;
        const double landmarks[] = {
            0, 0, 0, 0, way == 0 ? near : far / 2, 0, way == 0 ? far : 2 * near, 0};
        icc_match *match = NULL;
        icc_error err = {.size = sizeof err};
        const icc_status status = match_of(&match, 4, square, 5, other, 2, landmarks, NULL, &err);
        ck_assert_msg(status == ICC_OK, "%s", err.message);
        icc_match_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
        ck_assert_uint_eq(info.n_joined, 3);
        check_exact(match, 4, square, 5, other);
        icc_match_free(match);
    }
}
END_TEST

/* Landmarks close together on one side and far apart on the other: where shapes alone would follow
 * one outline while the other stands still, edges keep within the limit all the same. */
START_TEST(unlike_pieces_keep_the_limit)
{
    static const double a[] = {.8,   .1,  0,    .8,  -.2, .5,  -.9, .9,  -.5, .3,
                               -1.2, .5,  -1.4, .6,  -.5, 0,   -.8, -.4, -.5, -.4,
                               -.2,  -.9, 0,    -.8, .1,  -.6, .2,  -.6, .5,  -.4};
    static const double b[] = {1.5, .1,  .2,  .9,  -.4, 1,  -1.3, .1,   -1.3, -.3, -.7, -.4,
                               -.5, -.5, -.2, -.6, -.1, -1, 0,    -1.3, .1,   -.7, .5,  -.3};
    static const double landmarks[] = {-.57, .72, 1.12, .28, -.67, .55, -.71, -.39};
    icc_match *match = NULL;
    const icc_match_options options = {.size = sizeof options, .least_sure = 1};
    icc_error err = {.size = sizeof err};
    const icc_status status = match_of(&match, 15, a, 12, b, 2, landmarks, &options, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    check_exact(match, 15, a, 12, b);
    icc_match_free(match);
}
END_TEST

/* Landmarks out of order, off an outline, or twice are refused by their numbers. */
START_TEST(names_bad_landmarks)
{
    const struct {
        double landmarks[12];
        size_t n;
        int64_t index;
    } cases[] = {
        {{0, 0, 0, 0, 1, 0, 0, 1, 1, 1, 1, 1}, 3, 2},
        {{0, 0, 0, 0, .5, .5, 1, 1}, 2, 1},
        {{0, 0, 0, 0, 0, 0, 1, 1}, 2, 1},
        {{0, 0, 1, 1, 1, 1, 1, 1}, 2, 1},
        {{0, NAN, 1, 1}, 1, 0},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        icc_match *match = NULL;
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(
            match_of(&match, 4, square, 4, square, cases[k].n, cases[k].landmarks, NULL, &err),
            ICC_ERR_ARGUMENT);
        ck_assert_ptr_null(match);
        ck_assert_int_eq(err.item, ICC_ITEM_POINT);
        ck_assert_int_eq(err.index, cases[k].index);
    }
}
END_TEST

/* Vertex k of n, as far off the outline as a random share says. */
typedef void vertex_of(double *xy, size_t k, size_t n, double random, double bend);

/* A rough outline without every `without`-th vertex; 0: with all. How many are left. */
static size_t thinned(double *xy, vertex_of *vertex, size_t n, double bend, size_t without)
{
    size_t kept = 0;
    uint32_t state = 1;
    for (size_t k = 0; k < n; ++k) {
        state = state * 1664525u + 1013904223u;
        if (without == 0 || k % without != without - 1)
            vertex(xy + 2 * kept++, k, n, (double)(state >> 8) / 16777216.0, bend);
    }
    return kept;
}

/* A coast with a straight stretch; bent. */
static void coast(double *xy, size_t k, size_t n, double random, double bend)
{
    const double turn = 6.283185307179586 * (double)k / (double)n;
    const double rough = turn < 1 ? 0 : .05 * (random - .5);
    const double radius = (turn < 1 ? .8 / cos(turn - .5) : 1 + .4 * cos(3 * turn)) + rough;
    const double x = radius * cos(turn), y = radius * sin(turn);
    xy[0] = x + bend * y * y;
    xy[1] = y - bend * x * y;
}

/* Of outlines whose edges are finer than samples, most vertices that both have are found: without
 * their pairing it would be two in five, and not all can be, where half of so rough a coast lacks. */
START_TEST(pairs_vertices_with_vertices)
{
    enum { N = 1500 };
    static double a[2 * N], b[2 * N];
    for (size_t without = 2; without < 6; ++without) {
        const size_t n = thinned(a, coast, N, 0, 0), m = thinned(b, coast, N, .2, without);
        icc_match *match = NULL;
        icc_error err = {.size = sizeof err};
        const icc_status status = match_of(&match, n, a, m, b, 0, NULL, NULL, &err);
        ck_assert_msg(status == ICC_OK, "%s", err.message);
        check_exact(match, n, a, m, b);
        icc_match_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
        ck_assert_msg(info.n_joined >= m * 5 / 6, "%zu of %zu", info.n_joined, m);
        icc_match_free(match);
    }
}
END_TEST

/* What is dropped makes outlines simpler, and stretches no edge more than three times as much as the
 * pairing itself does. */
START_TEST(drops_what_stretches_little)
{
    enum { N = 1500 };
    static double a[2 * N], b[2 * N];
    for (size_t without = 2; without < 6; ++without) {
        const size_t n = thinned(a, coast, N, 0, 3), m = thinned(b, coast, N, .2, without + 2);
        icc_match_info info[2];
        for (int k = 0; k < 2; ++k) {
            icc_match *match = NULL;
            icc_error err = {.size = sizeof err};
            const icc_match_options options = {.size = sizeof options, .drop = k * .003};
            const icc_status status = match_of(&match, n, a, m, b, 0, NULL, &options, &err);
            ck_assert_msg(status == ICC_OK, "%s", err.message);
            check_exact(match, n, a, m, b);
            info[k] = (icc_match_info){.size = sizeof info[k]};
            ck_assert_int_eq(icc_match_get_info(match, &info[k]), ICC_OK);
            icc_match_free(match);
        }
        ck_assert_uint_lt(info[1].n_vertices, info[0].n_vertices);
        ck_assert_double_ge(3 * info[1].least_slope, info[0].least_slope);
        ck_assert_double_le(info[1].most_slope, 3 * info[0].most_slope);
    }
}
END_TEST

/* A strip with rough sides, straight or, if `bend` is not 0, bent by so many radians. */
static void strip(double *xy, size_t k, size_t n, double random, double bend)
{
    const double rough = .06 * random;
    const bool is_back = k >= n / 2;
    const double x = 12 * (double)(is_back ? n - k : k) / (double)n;
    const double y = is_back ? 1 + rough : -rough, out = 2 - y, turn = bend * x / 6;
    xy[0] = bend != 0 ? out * sin(turn) : x;
    xy[1] = bend != 0 ? -out * cos(turn) : y;
}

/* No one rotation takes the directions of what is straight to those of what is bent; after that of
 * its own place, and by what is near alone, three in four vertices are found, else two in three; with
 * a landmark, which says where the ends are, five in six. */
START_TEST(follows_what_is_bent)
{
    enum { N = 900 };
    static double a[2 * N], b[2 * N];
    for (size_t k = 0; k < 6; ++k) {
        const size_t without = 3 + k / 2, n_landmarks = k % 2;
        const size_t n = thinned(a, strip, N, 0, 0), m = thinned(b, strip, N, 4, without);
        icc_match *match = NULL;
        icc_error err = {.size = sizeof err};
        const icc_match_options options = {.size = sizeof options, .least_sure = 1};
        const double landmark[4] = {a[0], a[1], b[0], b[1]};
        const icc_status status =
            match_of(&match, n, a, m, b, n_landmarks, landmark, &options, &err);
        ck_assert_msg(status == ICC_OK, "%s", err.message);
        icc_match_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
        const size_t least = n_landmarks > 0 ? m * 5 / 6 : m * 3 / 4;
        ck_assert_msg(info.n_joined >= least, "%zu of %zu", info.n_joined, m);
        icc_match_free(match);
    }
}
END_TEST

/* What a match gave comes out of another match as it went in. */
START_TEST(matched_outlines_stay)
{
    enum { N = 400 };
    static double a[2 * N], b[2 * N], before[2][4 * N], after[2][4 * N];
    const size_t n = thinned(a, coast, N, 0, 0), m = thinned(b, coast, N, .3, 3);
    icc_match *match = NULL, *again = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(match_of(&match, n, a, m, b, 0, NULL, NULL, &err) == ICC_OK, "%s", err.message);
    ck_assert_msg(icc_match_create(&again, icc_match_source(match), icc_match_target(match), 0,
                                   NULL, NULL, NULL, &err) == ICC_OK,
                  "%s", err.message);
    icc_match_info info[2] = {{.size = sizeof info[0]}, {.size = sizeof info[0]}};
    ck_assert_int_eq(icc_match_get_info(match, &info[0]), ICC_OK);
    ck_assert_int_eq(icc_match_get_info(again, &info[1]), ICC_OK);
    ck_assert_uint_lt(info[0].n_joined, info[0].n_vertices);
    ck_assert_uint_eq(info[1].n_vertices, info[0].n_vertices);
    ck_assert_uint_eq(info[1].n_joined, info[0].n_vertices);
    const size_t size = 2 * info[0].n_vertices * sizeof(double);
    ck_assert_uint_le(size, sizeof before[0]);
    ck_assert_int_eq(icc_domain_get_boundary(icc_match_source(match), before[0], NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_get_boundary(icc_match_target(match), before[1], NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_get_boundary(icc_match_source(again), after[0], NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_get_boundary(icc_match_target(again), after[1], NULL), ICC_OK);
    for (int e = 0; e < 2; ++e)
        ck_assert_mem_eq(after[e], before[e], size);
    icc_match_free(again);
    icc_match_free(match);
}
END_TEST

static icc_status make_one(const icc_env *env, icc_error *err, void *argument)
{
    double a[2 * N_CUT];
    cut_key(a, 5, 0, 1, false);
    icc_domain *source = domain_of_polygon(N_KEY, key), *target = domain_of_polygon(N_CUT, a);
    icc_match *match = NULL;
    const size_t *const n = argument;
    const double landmark[] = {0, 0, 3, -5};
    const icc_status status =
        icc_match_create(&match, source, target, *n, landmark, NULL, env, err);
    ck_assert((status == ICC_OK) == (match != NULL));
    icc_match_free(match);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

START_TEST(fails_cleanly)
{
    for (size_t n = 0; n < 2; ++n)
        faulty_sweep(make_one, &n);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("match");
    TCase *tests = tcase_create("match");
    tcase_add_test(tests, finds_the_same_shape);
    tcase_add_test(tests, tells_a_mirror_image);
    tcase_add_test(tests, tells_what_has_y_down);
    tcase_add_test(tests, refuses_what_is_ambiguous);
    tcase_add_test(tests, pairs_discs_by_arc_length);
    tcase_add_test(tests, passes_through_landmarks);
    tcase_add_test(tests, takes_apart_what_stretches_too_much);
    tcase_add_test(tests, unlike_pieces_keep_the_limit);
    tcase_add_test(tests, names_bad_landmarks);
    tcase_add_test(tests, pairs_vertices_with_vertices);
    tcase_add_test(tests, drops_what_stretches_little);
    tcase_add_test(tests, follows_what_is_bent);
    tcase_add_test(tests, matched_outlines_stay);
    tcase_add_test(tests, fails_cleanly);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
