#include <icc/icc.h>

#include "../../faulty.h"
#include "../../glyphs.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* ---- domains ---- */

static double area_of(size_t n, const double *xy)
{
    double sum = 0;
    for (size_t k = 0; k < n; ++k)
        sum += xy[2 * k] * xy[2 * ((k + 1) % n) + 1] - xy[2 * k + 1] * xy[2 * ((k + 1) % n)];
    return sum / 2;
}

static icc_domain *domain_of(size_t n_outer, const double *outer, size_t n,
                             const icc_feature *features)
{
    icc_domain *domain = NULL;
    icc_error err = {.size = sizeof err};
    const icc_status status =
        icc_domain_create_features(&domain, n_outer, outer, n, features, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    return domain;
}

/* The holes of a glyph run against its largest ring. */
static icc_domain *domain_of_glyph(const glyph *g)
{
    icc_feature features[GLYPH_RINGS];
    double area[GLYPH_RINGS], largest = 0;
    const double *xy = g->xy;
    size_t n = 0;
    for (; n < GLYPH_RINGS && g->n[n] > 0; ++n) {
        features[n] =
            (icc_feature){.size = sizeof *features, .n_vertices = g->n[n], .vertices = xy};
        area[n] = area_of(g->n[n], xy);
        largest = fabs(area[n]) > fabs(largest) ? area[n] : largest;
        xy += 2 * g->n[n];
    }
    for (size_t k = 0; k < n; ++k)
        features[k].kind = area[k] * largest > 0 ? ICC_FEATURE_REGION : ICC_FEATURE_HOLE;
    return domain_of(0, NULL, n, features);
}

/* A square with these lower left corner and side, as a feature. */
static icc_feature square(double xy[8], int32_t kind, double x, double y, double side)
{
    const double corners[] = {x, y, x + side, y, x + side, y + side, x, y + side};
    memcpy(xy, corners, sizeof corners);
    return (icc_feature){
        .size = sizeof(icc_feature), .kind = kind, .n_vertices = 4, .vertices = xy};
}

/* Two squares. */
static icc_domain *two_squares(const double *p, const double *q)
{
    double xy[2][8];
    const icc_feature features[] = {square(xy[0], ICC_FEATURE_REGION, p[0], p[1], 1),
                                    square(xy[1], ICC_FEATURE_REGION, q[0], q[1], 1)};
    return domain_of(0, NULL, 2, features);
}

static icc_status match_of(icc_match **match, icc_domain *source, icc_domain *target, size_t n,
                           const double *landmarks, icc_error *err)
{
    *err = (icc_error){.size = sizeof *err, .index = -1};
    *match = NULL;
    const icc_status status =
        icc_match_create(match, source, target, n, landmarks, NULL, NULL, err);
    ck_assert((status == ICC_OK) == (*match != NULL));
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

/* ---- what was paired ---- */

enum { MOST = 400 };

typedef struct ring_pair {
    icc_feature_info info;
    double centre[2][2]; /* means of vertices, shares of the boxes of both sides */
    double turn;         /* degrees by which the vertices are turned */
} ring_pair;

static void box_of(size_t n, const double *xy, double *box)
{
    for (size_t e = 0; e < 2; ++e) {
        box[e] = HUGE_VAL;
        box[2 + e] = -HUGE_VAL;
        for (size_t k = 0; k < n; ++k) {
            box[e] = fmin(box[e], xy[2 * k + e]);
            box[2 + e] = fmax(box[2 + e], xy[2 * k + e]);
        }
    }
}

static double turn_of(size_t n, const double *a, const double *b)
{
    double mean[4] = {0, 0, 0, 0}, sine = 0, cosine = 0;
    for (size_t k = 0; k < 2 * n; ++k) {
        mean[k % 2] += a[k] / (double)n;
        mean[2 + k % 2] += b[k] / (double)n;
    }
    for (size_t k = 0; k < n; ++k) {
        const double x = a[2 * k] - mean[0], y = a[2 * k + 1] - mean[1];
        const double u = b[2 * k] - mean[2], v = b[2 * k + 1] - mean[3];
        cosine += x * u + y * v;
        sine += x * v - y * u;
    }
    return 57.29577951308232 * atan2(sine, cosine);
}

/* Describes the rings of a match, feature by feature. Returns how many there are. */
static size_t describe(ring_pair *out, const icc_match *match)
{
    static double xy[2][2 * MOST];
    double box[2][4];
    const icc_domain *const domains[2] = {icc_match_source(match), icc_match_target(match)};
    icc_domain_info size = {.size = sizeof size};
    for (int e = 0; e < 2; ++e) {
        ck_assert_int_eq(icc_domain_get_info(domains[e], &size), ICC_OK);
        ck_assert_uint_le(size.n_vertices, MOST);
        ck_assert_int_eq(icc_domain_get_boundary(domains[e], xy[e], NULL), ICC_OK);
        box_of(size.n_vertices, xy[e], box[e]);
    }
    for (size_t f = 0; f < size.n_features; ++f) {
        icc_feature_info other = {.size = sizeof other};
        icc_feature_info *const info = &out[f].info;
        info->size = sizeof *info;
        ck_assert_int_eq(icc_domain_get_feature(domains[0], f, info), ICC_OK);
        ck_assert_int_eq(icc_domain_get_feature(domains[1], f, &other), ICC_OK);
        ck_assert_int_eq(info->kind, other.kind);
        ck_assert_uint_eq(info->first_vertex, other.first_vertex);
        ck_assert_uint_eq(info->n_vertices, other.n_vertices);
        const size_t first = 2 * info->first_vertex, n = info->n_vertices;
        for (int e = 0; e < 2; ++e)
            for (size_t d = 0; d < 2; ++d) {
                out[f].centre[e][d] = 0;
                for (size_t k = 0; k < n; ++k)
                    out[f].centre[e][d] += (xy[e][first + 2 * k + d] - box[e][d]) /
                                           (box[e][2 + d] - box[e][d]) / (double)n;
            }
        out[f].turn = turn_of(n, xy[0] + first, xy[1] + first);
    }
    return size.n_features;
}

/* ---- tests ---- */

/* Rings go to rings of the same place, and none is turned: not even the round dot of an i, whose
 * shape does not tell. */
START_TEST(pairs_glyphs)
{
    static const glyph *const glyphs[] = {glyph_i, glyph_quotes, glyph_percent, glyph_colon};
    static const size_t n_rings[] = {2, 2, 5, 2};
    for (size_t g = 0; g < sizeof glyphs / sizeof *glyphs; ++g) {
        icc_match *match;
        icc_error err;
        ring_pair rings[GLYPH_RINGS];
        const icc_status status = match_of(&match, domain_of_glyph(&glyphs[g][0]),
                                           domain_of_glyph(&glyphs[g][1]), 0, NULL, &err);
        ck_assert_msg(status == ICC_OK, "%s", err.message);
        ck_assert_uint_eq(describe(rings, match), n_rings[g]);
        for (size_t k = 0; k < n_rings[g]; ++k) {
            ck_assert_double_lt(fabs(rings[k].turn), 15);
            for (int d = 0; d < 2; ++d)
                ck_assert_double_lt(fabs(rings[k].centre[0][d] - rings[k].centre[1][d]), .15);
        }
        icc_match_free(match);
    }
}
END_TEST

enum { ROUND = 32 };

/* Takes n points by a matrix. */
static void take(size_t n, const double *matrix, const double *from, double *to)
{
    for (size_t k = 0; k < 2 * n; ++k)
        to[k] =
            matrix[2 * (k % 2)] * from[k - k % 2] + matrix[2 * (k % 2) + 1] * from[k - k % 2 + 1];
}

/* Makes a disc of n_disc vertices above another shape, both taken by a matrix. */
static icc_domain *disc_of(size_t n_disc, size_t n, const double *shape, const double *matrix)
{
    double disc[4 * ROUND], xy[2][4 * ROUND];
    for (size_t k = 0; k < n_disc; ++k) {
        const double t = 6.283185307179586 * (double)k / (double)n_disc;
        disc[2 * k] = .7 * cos(t);
        disc[2 * k + 1] = 2 + .7 * sin(t);
    }
    take(n_disc, matrix, disc, xy[0]);
    take(n, matrix, shape, xy[1]);
    const icc_feature features[] = {
        {.size = sizeof *features,
         .kind = ICC_FEATURE_REGION,
         .n_vertices = n_disc,
         .vertices = xy[0]},
        {.size = sizeof *features, .kind = ICC_FEATURE_REGION, .n_vertices = n, .vertices = xy[1]}};
    return domain_of(0, NULL, 2, features);
}

static icc_domain *disc_over(size_t n, const double *shape, const double *matrix)
{
    return disc_of(ROUND, n, shape, matrix);
}

static const double same[] = {1, 0, 0, 1};
static const double turned[] = {.955336489125606, -.29552020666134, .29552020666134,
                                .955336489125606}; /* by 17.2 degrees */
static const double bar[] = {-3, -2, 3, -2, 3, -1, -3, -1.5};

/* The bar tells how all is turned, and the disc follows. */
START_TEST(turns_discs_with_the_rest)
{
    icc_match *match;
    icc_error err;
    ring_pair rings[2];
    const icc_status status =
        match_of(&match, disc_over(4, bar, same), disc_over(4, bar, turned), 0, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    ck_assert_uint_eq(describe(rings, match), 2);
    for (int k = 0; k < 2; ++k)
        ck_assert_double_lt(fabs(rings[k].turn - 17.2), 1);
    icc_match_free(match);
}
END_TEST

/* The bar also tells how all is stretched and sheared, and all places of the disc go with it, also
 * if the disc has other vertices. */
START_TEST(stretches_discs_with_the_rest)
{
    static const double oblique[] = {1.3, .7, 0, .8};
    static const size_t n_disc[] = {ROUND, 45, 2 * ROUND};
    for (size_t d = 0; d < sizeof n_disc / sizeof *n_disc; ++d) {
        icc_match *match;
        icc_error err;
        ring_pair rings[2];
        double xy[2][2 * MOST], to[2];
        const icc_status status = match_of(&match, disc_over(4, bar, same),
                                           disc_of(n_disc[d], 4, bar, oblique), 0, NULL, &err);
        ck_assert_msg(status == ICC_OK, "%s", err.message);
        ck_assert_uint_eq(describe(rings, match), 2);
        ck_assert_int_eq(icc_domain_get_boundary(icc_match_source(match), xy[0], NULL), ICC_OK);
        ck_assert_int_eq(icc_domain_get_boundary(icc_match_target(match), xy[1], NULL), ICC_OK);
        for (size_t k = 0; k < rings[0].info.n_vertices; ++k) {
            const size_t v = rings[0].info.first_vertex + k;
            take(1, oblique, xy[0] + 2 * v, to);
            ck_assert_double_lt(hypot(xy[1][2 * v] - to[0], xy[1][2 * v + 1] - to[1]), .1);
        }
        icc_match_free(match);
    }
}
END_TEST

/* Nothing but the whole tells how two discs lie. */
START_TEST(describes_what_the_whole_has_placed)
{
    icc_match *match;
    icc_error err;
    double low[2 * ROUND];
    icc_match_info info = {.size = sizeof info};
    for (size_t k = 0; k < ROUND; ++k) {
        const double t = 6.283185307179586 * (double)k / ROUND;
        low[2 * k] = cos(t);
        low[2 * k + 1] = -1 + sin(t);
    }
    const icc_status status =
        match_of(&match, disc_over(ROUND, low, same), disc_over(ROUND, low, turned), 0, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    ck_assert_double_lt(fabs(info.turn - 17.2), .5);
    ck_assert(info.cost >= 0 && info.cost < .1);
    ck_assert(isinf(info.second) && isinf(info.sure) && info.mirrored == 0);
    ck_assert_uint_eq(info.n_joined, 2 * ROUND);
    icc_match_free(match);
}
END_TEST

/* Parts are paired side by side, and the bits do not tell. */
START_TEST(threads_change_nothing)
{
    static uint8_t bytes[2][1 << 16];
    size_t n[2];
    for (int k = 0; k < 2; ++k) {
        const icc_env env = {.size = sizeof env, .threads = 1 + 2 * k};
        icc_domain *const domain[2] = {disc_over(4, bar, same), disc_over(4, bar, turned)};
        icc_match *match;
        ck_assert_int_eq(icc_match_create(&match, domain[0], domain[1], 0, NULL, NULL, &env, NULL),
                         ICC_OK);
        ck_assert_int_eq(icc_match_save(match, sizeof bytes[k], bytes[k], &n[k]), ICC_OK);
        icc_match_free(match);
        icc_domain_free(domain[0]);
        icc_domain_free(domain[1]);
    }
    ck_assert_uint_eq(n[0], n[1]);
    ck_assert_mem_eq(bytes[0], bytes[1], n[0]);
}
END_TEST

/* Two squares side by side, and one over the other: which goes where is open until a landmark
 * says. */
START_TEST(refuses_what_could_be_exchanged)
{
    static const double across[2][2] = {{0, 0}, {3, 0}}, up[2][2] = {{0, 0}, {0, 3}};
    icc_match *match;
    icc_error err;
    ring_pair rings[2];
    ck_assert_int_eq(match_of(&match, two_squares(across[0], across[1]), two_squares(up[0], up[1]),
                              0, NULL, &err),
                     ICC_ERR_AMBIGUOUS);
    ck_assert_int_eq(err.item, ICC_ITEM_FEATURE);
    ck_assert_ptr_nonnull(strstr(err.message, "landmark"));
    static const double landmark[] = {3, 0, 0, 0};
    const icc_status status = match_of(&match, two_squares(across[0], across[1]),
                                       two_squares(up[0], up[1]), 1, landmark, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    ck_assert_uint_eq(describe(rings, match), 2);
    ck_assert_double_gt(rings[0].centre[1][1], .5);
    ck_assert_double_lt(rings[1].centre[1][1], .5);
    icc_match_free(match);
}
END_TEST

START_TEST(names_what_differs)
{
    icc_match *match;
    icc_error err;
    double xy[4][8];
    ck_assert_int_eq(match_of(&match, domain_of_glyph(&glyph_percent[0]),
                              domain_of_glyph(&glyph_i[0]), 0, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_str_eq(err.message, "the source has 3 parts, the target 2");

    /* the same numbers, in other parts */
    const icc_feature far_apart[] = {
        square(xy[0], ICC_FEATURE_REGION, 0, 0, 3), square(xy[1], ICC_FEATURE_REGION, 9, 9, 3),
        square(xy[2], ICC_FEATURE_HOLE, 1, 1, 1), square(xy[3], ICC_FEATURE_HOLE, 10, 10, 1)};
    double other[8];
    icc_feature in_one[4];
    memcpy(in_one, far_apart, sizeof in_one);
    in_one[3] = square(other, ICC_FEATURE_HOLE, .2, .2, .5);
    ck_assert_int_eq(match_of(&match, domain_of(0, NULL, 4, far_apart),
                              domain_of(0, NULL, 4, in_one), 0, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_ptr_nonnull(strstr(err.message, "part 0 has 1 holes"));

    /* a hole that touches */
    const icc_feature touching[] = {square(xy[0], ICC_FEATURE_REGION, 0, 0, 3),
                                    square(xy[1], ICC_FEATURE_REGION, 3, 3, 3)};
    ck_assert_int_eq(match_of(&match, domain_of(0, NULL, 2, touching),
                              domain_of(0, NULL, 2, far_apart), 0, NULL, &err),
                     ICC_ERR_UNSUPPORTED);
    ck_assert_ptr_nonnull(strstr(err.message, "feature 1 meets feature 0 at (3, 3)"));
}
END_TEST

/* An outline with a lake, an island in it, a closed contour around the lake. */
static icc_domain *lake(double by)
{
    static const double outer[] = {0, 0, 10, 0, 10, 10, 4, 10, 0, 12};
    static double xy[3][10];
    icc_feature features[] = {square(xy[0], ICC_FEATURE_HOLE, 3, 3, 4),
                              square(xy[1], ICC_FEATURE_LINE, 2, 2, 6),
                              square(xy[2], ICC_FEATURE_REGION, 4, 4 + by, 2)};
    memcpy(xy[1] + 8, xy[1], 2 * sizeof(double));
    features[1].n_vertices = 5;
    xy[1][5] += by; /* so that it is no square */
    return domain_of(5, outer, 3, features);
}

START_TEST(keeps_islands_and_contours)
{
    icc_match *match;
    icc_error err;
    ring_pair rings[3];
    const icc_status status = match_of(&match, lake(.2), lake(.3), 0, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    ck_assert_uint_eq(describe(rings, match), 3);
    static const int32_t kinds[] = {ICC_FEATURE_HOLE, ICC_FEATURE_LINE, ICC_FEATURE_REGION};
    for (int k = 0; k < 3; ++k) {
        ck_assert_int_eq(rings[k].info.kind, kinds[k]);
        ck_assert_double_lt(fabs(rings[k].turn), 2);
    }
    ck_assert_uint_eq(rings[1].info.n_vertices, 5);
    icc_match_free(match);
}
END_TEST

static icc_status make_one(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *const source = domain_of_glyph(&glyph_percent[0]);
    icc_domain *const target = domain_of_glyph(&glyph_percent[1]);
    const icc_match_options options = {.size = sizeof options, .between = ICC_BETWEEN_ARC};
    icc_match *match = NULL;
    (void)argument;
    const icc_status status = icc_match_create(&match, source, target, 0, NULL, &options, env, err);
    ck_assert((status == ICC_OK) == (match != NULL));
    icc_match_free(match);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

START_TEST(fails_cleanly)
{
    faulty_sweep(make_one, NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("match_parts");
    TCase *tests = tcase_create("match_parts");
    tcase_add_test(tests, pairs_glyphs);
    tcase_add_test(tests, turns_discs_with_the_rest);
    tcase_add_test(tests, stretches_discs_with_the_rest);
    tcase_add_test(tests, describes_what_the_whole_has_placed);
    tcase_add_test(tests, threads_change_nothing);
    tcase_add_test(tests, refuses_what_could_be_exchanged);
    tcase_add_test(tests, names_what_differs);
    tcase_add_test(tests, keeps_islands_and_contours);
    tcase_add_test(tests, fails_cleanly);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
