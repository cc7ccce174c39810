/* Time grows in proportion to the input, up to a logarithm: four times the input takes less than
 * eight times the time, where a square would take sixteen. Only processor time counts. */
#include <icc/icc.h>

#include "../random.h"
#include "../suite.h"
#include "../surfaces.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

/* Seconds below which everything is noise. */
static const double NOISE = 0.06;
static const double TURN = 6.283185307179586;

typedef struct input {
    size_t n;
    double *x, *y; /* coordinates, before and after */
    uint32_t *facets;
    size_t n_facets;
    icc_feature *features;
    icc_domain *domain, *other;
    void *bytes;
    size_t n_bytes;
} input;

typedef struct subject {
    const char *name;
    size_t n;
    void (*prepare)(input *in);
    void (*run)(const input *in);
} subject;

static void *room(size_t n, size_t size)
{
    void *memory = calloc(n, size);
    ck_assert_ptr_nonnull(memory);
    return memory;
}

static void release(input *in)
{
    free(in->x);
    free(in->y);
    free(in->facets);
    free(in->features);
    free(in->bytes);
    icc_domain_free(in->domain);
    icc_domain_free(in->other);
}

/* ---- in the plane ---- */

static double *star(size_t n, double phase)
{
    double *x = room(2 * n, sizeof *x);
    for (size_t k = 0; k < n; ++k) {
        const double a = TURN * (double)k / (double)n, r = 1 + 0.2 * sin(5 * a + phase);
        x[2 * k] = r * cos(a);
        x[2 * k + 1] = r * sin(a);
    }
    return x;
}

static void prepare_polygons(input *in)
{
    in->x = star(in->n, 0);
    in->y = star(in->n, 0.7);
}

static icc_domain *polygon(size_t n, const double *x)
{
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, n, x, 0, NULL, NULL, NULL), ICC_OK);
    return domain;
}

static void make_polygon(const input *in)
{
    icc_domain_free(polygon(in->n, in->x));
}

static void list_defects(const input *in)
{
    size_t n;
    ck_assert_int_eq(icc_boundary_defects(in->n, in->x, 0, NULL, NULL, &n, NULL, NULL), ICC_OK);
}

/* A star all of whose edges cross. */
static void prepare_crossings(input *in)
{
    in->n |= 1;
    in->x = room(2 * in->n, sizeof *in->x);
    for (size_t k = 0; k < in->n; ++k) {
        const double a = TURN * (double)(k * (in->n / 2) % in->n) / (double)in->n;
        in->x[2 * k] = cos(a);
        in->x[2 * k + 1] = sin(a);
    }
}

static void map_polygons(const input *in)
{
    icc_map *map;
    ck_assert_int_eq(icc_map_create_polygons(&map, in->n, in->x, in->y, NULL, NULL), ICC_OK);
    icc_map_free(map);
}

static void prepare_match(input *in)
{
    prepare_polygons(in);
    in->domain = polygon(in->n, in->x);
    in->other = polygon(in->n, in->y);
}

static void match_polygons(const input *in)
{
    icc_match *match;
    const icc_status status =
        icc_match_create(&match, in->domain, in->other, 0, NULL, NULL, NULL, NULL);
    ck_assert(status == ICC_OK || status == ICC_ERR_AMBIGUOUS);
    icc_match_free(match);
}

/* Square holes in rows that move a little. */
static void prepare_holes(input *in)
{
    const size_t side = (size_t)ceil(sqrt((double)in->n));
    random_source r = {1};
    in->features = room(in->n, sizeof *in->features);
    for (int k = 0; k < 2; ++k) {
        const double w = (double)side, outer[] = {0, 0, w, 0, w, w, 0, w};
        double *x = room(8 * in->n, sizeof *x);
        for (size_t i = 0; i < in->n; ++i) {
            const double u = (double)(i % side) + 0.5 + k * random_between(&r, -0.1, 0.1);
            const double v = (double)(i / side) + 0.5 + k * random_between(&r, -0.1, 0.1);
            for (size_t c = 0; c < 4; ++c) {
                x[8 * i + 2 * c] = u + 0.2 * cos(TURN * (double)c / 4);
                x[8 * i + 2 * c + 1] = v + 0.2 * sin(TURN * (double)c / 4);
            }
            in->features[i] = (icc_feature){.size = sizeof(icc_feature),
                                            .kind = ICC_FEATURE_HOLE,
                                            .n_vertices = 4,
                                            .vertices = x + 8 * i};
        }
        ck_assert_int_eq(icc_domain_create_features(k == 0 ? &in->domain : &in->other, 4, outer,
                                                    in->n, in->features, NULL, NULL),
                         ICC_OK);
        free(x);
    }
}

static void map_holes(const input *in)
{
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, in->domain, in->other, NULL, NULL, NULL), ICC_OK);
    icc_map_free(map);
}

/* ---- in space ---- */

/* n triangles at each of two vertices, over a rim that goes up and down by `wave`. */
static void cone(input *in, double wave)
{
    const uint32_t n = (uint32_t)in->n;
    in->x = room(3 * (in->n + 2), sizeof *in->x);
    in->facets = room(6 * in->n, sizeof *in->facets);
    in->n_facets = 2 * in->n;
    for (uint32_t k = 0; k < n; ++k) {
        const double a = TURN * k / n;
        const double place[3] = {cos(a), sin(a), wave * (k % 2 == 0 ? 1 : -1)};
        const uint32_t two[6] = {k, (k + 1) % n, n, (k + 1) % n, k, n + 1};
        for (size_t i = 0; i < 3; ++i)
            in->x[3 * k + i] = place[i];
        for (size_t i = 0; i < 6; ++i)
            in->facets[6 * k + i] = two[i];
    }
    in->x[3 * n + 2] = 1;
    in->x[3 * n + 5] = -1;
    in->n += 2;
}

static void prepare_double_cone(input *in)
{
    cone(in, 0);
}

static void prepare_wavy_cone(input *in)
{
    cone(in, 0.3);
}

static icc_domain *surface_domain(const input *in)
{
    icc_domain *domain;
    ck_assert_int_eq(
        icc_domain_create(&domain, 3, in->n, in->x, in->n_facets, in->facets, NULL, NULL), ICC_OK);
    return domain;
}

static void make_surface(const input *in)
{
    icc_domain_free(surface_domain(in));
}

/* Of a chart on it. */
static void prepare_bytes(input *in)
{
    prepare_double_cone(in);
    const icc_chart_options options = {
        .size = sizeof options, .method = ICC_METHOD_FIELD, .cells = 6};
    icc_chart *chart;
    in->domain = surface_domain(in);
    ck_assert_int_eq(icc_chart_create(&chart, in->domain, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_save(chart, 0, NULL, &in->n_bytes), ICC_OK);
    in->bytes = room(in->n_bytes, 1);
    ck_assert_int_eq(icc_chart_save(chart, in->n_bytes, in->bytes, &in->n_bytes), ICC_OK);
    icc_chart_free(chart);
}

static void load_chart(const input *in)
{
    icc_chart *chart;
    ck_assert_int_eq(icc_chart_load(&chart, in->n_bytes, in->bytes, NULL, NULL), ICC_OK);
    icc_chart_free(chart);
}

/* The tetrahedra that were made last: a ball with few faces needs no vertices inside, so there are
 * more than four times as many for four times as many faces. */
static size_t n_made;

static void fill_surface(const input *in)
{
    icc_domain *filled;
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_fill(&filled, in->domain, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_get_info(filled, &info), ICC_OK);
    n_made = info.n_mesh_simplices;
    icc_domain_free(filled);
}

/* A ball of 8 * 4^k faces, for n = 2 * 4^k. */
static void prepare_ball(input *in)
{
    static surface s;
    surface_octahedron(&s);
    for (size_t n = 2; n < in->n; n *= 4)
        surface_split(&s);
    in->n = s.n_vertices;
    in->n_facets = s.n_faces;
    in->x = room(3 * s.n_vertices, sizeof *in->x);
    in->facets = room(3 * s.n_faces, sizeof *in->facets);
    for (size_t v = 0; v < s.n_vertices; ++v) {
        const double *p = s.vertices + 3 * v,
                     length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        for (size_t k = 0; k < 3; ++k)
            in->x[3 * v + k] = p[k] / length;
    }
    memcpy(in->facets, s.faces, 3 * s.n_faces * sizeof *in->facets);
    in->domain = surface_domain(in);
}

static const subject SUBJECTS[] = {
    {"a polygon", 20000, prepare_polygons, make_polygon},
    {"defects of a polygon", 20000, prepare_polygons, list_defects},
    {"defects of crossing edges", 500, prepare_crossings, list_defects},
    {"a map of polygons", 500, prepare_polygons, map_polygons},
    {"a match of polygons", 200, prepare_match, match_polygons},
    {"a map with holes", 100, prepare_holes, map_holes},
    {"a double cone", 3000, prepare_double_cone, make_surface},
    {"a wavy double cone", 3000, prepare_wavy_cone, make_surface},
    {"a chart that is loaded", 2200, prepare_bytes, load_chart},
    {"a ball", 2 * 64, prepare_ball, make_surface},
    {"a ball that is filled", 2 * 64, prepare_ball, fill_surface},
};
enum { N_SUBJECTS = sizeof SUBJECTS / sizeof *SUBJECTS };

static double least_seconds(const subject *s, size_t n)
{
    input in = {.n = n};
    double least = HUGE_VAL;
    s->prepare(&in);
    for (int k = 0; k < 3; ++k) {
        const clock_t begin = clock();
        s->run(&in);
        least = fmin(least, (double)(clock() - begin) / CLOCKS_PER_SEC);
    }
    release(&in);
    return least;
}

START_TEST(time_is_in_proportion)
{
    const subject *s = &SUBJECTS[_i];
    n_made = 1;
    const double one = least_seconds(s, s->n), made = (double)n_made;
    n_made = 4;
    const double four = least_seconds(s, 4 * s->n), growth = (double)n_made / made;
    ck_assert_msg(four < 2 * growth * one + NOISE, "%s: %g s for %zu, %g s for four times as many",
                  s->name, one, s->n, four);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("growth");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_loop_test(tests, time_is_in_proportion, 0, N_SUBJECTS);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
