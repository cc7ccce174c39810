/* Random outlines that are drawn twice, each time by other vertices, the second time bent, with
 * holes, lines and points in another order: they are matched and mapped, or it is said that they
 * are ambiguous; nothing is written beyond its memory. */
#include <icc/icc.h>

#include "../faulty.h"
#include "../random.h"
#include "../suite.h"

#include <math.h>
#include <stdbool.h>

enum { MOST_OUTER = 80, MOST_PART = 8, MOST_PARTS = 6, N_PAIRS = 200 };

static const double full_turn = 6.283185307179586;

/* What both drawings show. */
typedef struct picture {
    double wave[3][2];            /* amplitude and phase of the outline's 2nd, 3rd and 5th wave */
    double bend, turn, size;      /* of the second drawing */
    double centre[MOST_PARTS][3]; /* and the radius of the disc that a part lies in */
    int32_t kind[MOST_PARTS];     /* of each part */
    double shape[MOST_PARTS];     /* where its first vertex lies */
    size_t n_vertices[MOST_PARTS];
    size_t n_parts;
} picture;

/* Parts lie in discs that are apart from one another, and from the outline. */
static void draw_parts(picture *p, random_source *r)
{
    p->n_parts = 0;
    for (int tries = random_below(r, 2 * MOST_PARTS); tries-- > 0 && p->n_parts < MOST_PARTS;) {
        double *const c = p->centre[p->n_parts];
        const double away = random_between(r, 0, .3), at = random_between(r, 0, full_turn);
        c[0] = away * cos(at);
        c[1] = away * sin(at);
        c[2] = random_between(r, .01, .08);
        bool is_apart = true;
        for (size_t k = 0; k < p->n_parts && is_apart; ++k) {
            const double *const other = p->centre[k];
            is_apart = hypot(c[0] - other[0], c[1] - other[1]) > 1.5 * (c[2] + other[2]);
        }
        if (!is_apart)
            continue;
        static const int32_t kinds[] = {ICC_FEATURE_HOLE, ICC_FEATURE_LINE, ICC_FEATURE_POINT};
        const int kind = random_below(r, 3);
        p->kind[p->n_parts] = kinds[kind];
        p->n_vertices[p->n_parts] = kind == 2 ? 1 : (size_t)(4 + random_below(r, MOST_PART - 3));
        p->shape[p->n_parts++] = random_between(r, 0, full_turn);
    }
}

static void draw(picture *p, random_source *r)
{
    static const double most[3] = {.2, .15, .1};
    for (int k = 0; k < 3; ++k) {
        p->wave[k][0] = most[k] * random_unit(r);
        p->wave[k][1] = random_between(r, 0, full_turn);
    }
    p->bend = random_between(r, -.15, .15);
    p->turn = random_between(r, -.5, .5);
    p->size = random_between(r, .1, 10);
    draw_parts(p, r);
}

/* Where a place of the first drawing lies in the second. */
static void bend(double *xy, const picture *p)
{
    const double x = xy[0] + p->bend * sin(2 * xy[1] + 1), y = xy[1] + p->bend * sin(2 * xy[0]);
    xy[0] = p->size * (cos(p->turn) * x - sin(p->turn) * y) + 3;
    xy[1] = p->size * (sin(p->turn) * x + cos(p->turn) * y) + 1;
}

static size_t draw_outline(double *xy, const picture *p, random_source *r)
{
    const size_t n = (size_t)(10 + random_below(r, MOST_OUTER - 9));
    const double first = random_between(r, 0, full_turn);
    for (size_t k = 0; k < n; ++k) {
        const double at = first + full_turn * ((double)k + .8 * random_unit(r)) / (double)n;
        const double radius = 1 + p->wave[0][0] * cos(2 * at + p->wave[0][1]) +
                              p->wave[1][0] * cos(3 * at + p->wave[1][1]) +
                              p->wave[2][0] * cos(5 * at + p->wave[2][1]);
        xy[2 * k] = radius * cos(at);
        xy[2 * k + 1] = radius * sin(at);
    }
    return n;
}

static void draw_part(double *xy, const picture *p, size_t part)
{
    const double *const c = p->centre[part];
    const size_t n = p->n_vertices[part];
    for (size_t k = 0; k < n; ++k) {
        const double share = (double)k / (double)n, at = full_turn * share + p->shape[part];
        const bool is_line = p->kind[part] == ICC_FEATURE_LINE;
        const double along = is_line ? 2 * (share - .5) : cos(at);
        const double across = is_line ? .3 * sin(3 * share + p->shape[part]) : sin(at);
        xy[2 * k] = c[0] + (n > 1 ? c[2] * along : 0);
        xy[2 * k + 1] = c[1] + (n > 1 ? c[2] * across : 0);
    }
}

/* One of the two drawings; parts of the second one begin with the last. NULL: edges of the outline
 * or of a hole do not leave room for what is inside. */
static icc_domain *domain_of(const picture *p, bool is_second, random_source *r)
{
    double outer[2 * MOST_OUTER], inner[MOST_PARTS][2 * MOST_PART];
    icc_feature features[MOST_PARTS];
    const size_t n = draw_outline(outer, p, r);
    for (size_t k = 0; k < n && is_second; ++k)
        bend(outer + 2 * k, p);
    for (size_t f = 0; f < p->n_parts; ++f) {
        const size_t part = is_second ? p->n_parts - 1 - f : f;
        draw_part(inner[f], p, part);
        for (size_t k = 0; k < p->n_vertices[part] && is_second; ++k)
            bend(inner[f] + 2 * k, p);
        features[f] = (icc_feature){.size = sizeof features[f],
                                    .kind = p->kind[part],
                                    .n_vertices = p->n_vertices[part],
                                    .vertices = inner[f]};
    }
    icc_domain *domain = NULL;
    const icc_status status =
        icc_domain_create_features(&domain, n, outer, p->n_parts, features, NULL, NULL);
    ck_assert(status == ICC_OK || status == ICC_ERR_OUTSIDE || status == ICC_ERR_BOUNDARY);
    return domain;
}

/* Maps what was matched. */
static void check_map(const icc_match *match, const icc_env *env)
{
    icc_map *map = NULL;
    icc_map_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    const icc_status status =
        icc_map_create(&map, icc_match_source(match), icc_match_target(match), NULL, env, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert_int_eq(info.certified, 1);
    icc_map_free(map);
}

/* All vertices of a domain, those inside too; free() them. */
static double *vertices_of(const icc_domain *domain, size_t *n)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    double *const xy = calloc(info.n_vertices, 2 * sizeof *xy);
    ck_assert_ptr_nonnull(xy);
    ck_assert_int_eq(icc_domain_get_boundary(domain, xy, NULL), ICC_OK);
    *n = info.n_vertices;
    return xy;
}

/* The middles of the segments of lines go to middles. */
static void check_lines(const icc_match *match, const double *from, const double *to)
{
    icc_feature_info line = {.size = sizeof line};
    for (size_t f = 0; icc_domain_get_feature(icc_match_source(match), f, &line) == ICC_OK; ++f)
        for (size_t v = line.first_vertex;
             line.kind == ICC_FEATURE_LINE && v + 1 < line.first_vertex + line.n_vertices; ++v) {
            double p[2], off;
            for (size_t e = 0; e < 2; ++e)
                p[e] = (from[2 * v + e] + from[2 * v + 2 + e]) / 2;
            ck_assert_int_eq(icc_match_apply(match, 1, p, p, &off, NULL), ICC_OK);
            for (size_t e = 0; e < 2; ++e)
                ck_assert_double_le(fabs(p[e] - (to[2 * v + e] + to[2 * v + 2 + e]) / 2), 1e-9);
            ck_assert_double_le(off, 1e-12);
        }
}

/* Common vertices go to their partners bit by bit, both ways, and are the given ones bit by bit. */
static void check_bits(const icc_match *match, const icc_domain *const *given)
{
    size_t n[2], n_given;
    double *const xy[2] = {vertices_of(icc_match_source(match), &n[0]),
                           vertices_of(icc_match_target(match), &n[1])};
    ck_assert_uint_eq(n[0], n[1]);
    double *const image = calloc(n[0], 2 * sizeof *image), *const off = calloc(n[0], sizeof *off);
    uint32_t *const origin = calloc(n[0], 2 * sizeof *origin);
    ck_assert_int_eq(icc_match_get_origins(match, origin, origin + n[0]), ICC_OK);
    for (int e = 0; e < 2; ++e) {
        ck_assert_int_eq((e == 0 ? icc_match_apply : icc_match_apply_inverse)(match, n[0], xy[e],
                                                                              image, off, NULL),
                         ICC_OK);
        ck_assert_mem_eq(image, xy[1 - e], 2 * n[0] * sizeof *image);
        size_t n_known = 0;
        double *const old = vertices_of(given[e], &n_given);
        for (size_t v = 0; v < n[0]; ++v) {
            const uint32_t from = origin[n[0] * (size_t)e + v];
            ck_assert_double_eq(off[v], 0);
            n_known += from != UINT32_MAX;
            if (from != UINT32_MAX)
                ck_assert_mem_eq(xy[e] + 2 * v, old + 2 * (size_t)from, 2 * sizeof *old);
        }
        ck_assert_uint_eq(n_known, n_given);
        free(old);
    }
    check_lines(match, xy[0], xy[1]);
    free(origin);
    free(image);
    free(off);
    free(xy[0]);
    free(xy[1]);
}

START_TEST(matched_and_mapped)
{
    random_source r = {.state = 11};
    size_t n_matched = 0, n_ambiguous = 0, n_drawn = 0;
    for (int k = 0; k < share_of(N_PAIRS); ++k) {
        picture p;
        draw(&p, &r);
        icc_domain *source = domain_of(&p, false, &r), *target = domain_of(&p, true, &r);
        const icc_match_options options = {
            .size = sizeof options,
            .turning = k % 3 == 0 ? ICC_TURNING_FREE : ICC_TURNING_UPRIGHT,
            .between = k % 5 == 0 && p.n_parts == 0 ? ICC_BETWEEN_ARC : ICC_BETWEEN_ELASTIC};
        if (source != NULL && target != NULL) {
            faulty counts = {0};
            icc_env env = faulty_env(&counts);
            icc_error err = {.size = sizeof err};
            icc_match *match = NULL;
            const icc_status status =
                icc_match_create(&match, source, target, 0, NULL, &options, &env, &err);
            ck_assert_msg(status == ICC_OK || status == ICC_ERR_AMBIGUOUS, "pair %d: %s", k,
                          err.message);
            ck_assert_int_eq(status == ICC_OK, match != NULL);
            ck_assert(status == ICC_OK || err.message[0] != '\0');
            n_matched += status == ICC_OK;
            n_ambiguous += status != ICC_OK;
            if (match != NULL) {
                check_map(match, &env);
                check_bits(match, (const icc_domain *[]){source, target});
            }
            icc_match_free(match);
            ck_assert_uint_eq(counts.n_live, 0);
        }
        n_drawn += source != NULL && target != NULL;
        icc_domain_free(source);
        icc_domain_free(target);
    }
    /* Nearly all of what is drawn has room, and nearly all of that is matched. */
    ck_assert_uint_ge(10 * n_drawn, 9 * (size_t)share_of(N_PAIRS));
    ck_assert_msg(n_ambiguous * 5 <= n_drawn, "%zu of %zu are ambiguous", n_ambiguous, n_drawn);
    ck_assert_uint_eq(n_matched + n_ambiguous, n_drawn);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("pairs of outlines");
    TCase *tests = tcase_create("pairs");
    tcase_set_timeout(tests, 600);
    tcase_add_test(tests, matched_and_mapped);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
