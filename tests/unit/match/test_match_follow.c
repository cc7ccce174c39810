/* Points of one boundary of a match are taken to the other, and a match is saved and loaded. */
#include "../../faulty.h"
#include "../../saved.h"
#include "../../suite.h"
#include "../../surfaces.h"

#include <math.h>
#include <stdbool.h>

enum { N_RING = 30, N_OTHER = 37, N_HOLE = 12 };

static surface one, two;

/* A bump on a ball, from a triangulation that is turned first. */
static icc_domain *ball(surface *s, double turn, double size)
{
    icc_domain *domain = NULL;
    surface_octahedron(s);
    for (int i = 0; i < 3; ++i)
        surface_split(s);
    for (size_t v = 0; v < s->n_vertices; ++v) {
        double *const p = s->vertices + 3 * v, r = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        const double x = (cos(turn) * p[0] - sin(turn) * p[1]) / r, z = p[2] / r;
        const double y = (sin(turn) * p[0] + cos(turn) * p[1]) / r;
        p[0] = size * (x + .6 * exp(4 * x - 4));
        p[1] = size * .8 * (cos(turn) * y - sin(turn) * z);
        p[2] = size * .7 * (sin(turn) * y + cos(turn) * z) - 7;
    }
    ck_assert_int_eq(
        icc_domain_create(&domain, 3, s->n_vertices, s->vertices, s->n_faces, s->faces, NULL, NULL),
        ICC_OK);
    return domain;
}

static icc_match *match_of(icc_domain *source, icc_domain *target, size_t n,
                           const double *landmarks)
{
    icc_match *match = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_match_create(&match, source, target, n, landmarks, NULL, NULL, &err) ==
                      ICC_OK,
                  "%s", err.message);
    icc_domain_free(source);
    icc_domain_free(target);
    return match;
}

/* An outline that is wide at one side, with a round hole off its middle. */
static icc_domain *plate(size_t n, size_t n_hole, double from, double size)
{
    double outer[2 * N_OTHER], inner[2 * N_HOLE + 2];
    icc_domain *domain = NULL;
    for (size_t k = 0; k < n; ++k) {
        const double t = 6.283185307179586 * ((double)k / (double)n + from);
        const double r = size * (1 + .4 * cos(t) + .2 * sin(2 * t) + .2 * cos(3 * t));
        outer[2 * k] = r * cos(t);
        outer[2 * k + 1] = r * sin(t);
    }
    for (size_t k = 0; k < n_hole; ++k) {
        const double t = 6.283185307179586 * (double)k / (double)n_hole;
        inner[2 * k] = size * (.3 + .2 * cos(t));
        inner[2 * k + 1] = size * (.1 + .1 * sin(t));
    }
    const icc_feature hole = {
        .size = sizeof hole, .kind = ICC_FEATURE_HOLE, .n_vertices = n_hole, .vertices = inner};
    ck_assert_int_eq(icc_domain_create_features(&domain, n, outer, 1, &hole, NULL, NULL), ICC_OK);
    return domain;
}

static icc_match *plates(void)
{
    return match_of(plate(N_RING, N_HOLE, 0, 1), plate(N_OTHER, N_HOLE + 1, .3, 2), 0, NULL);
}

static icc_match *balls(void)
{
    icc_domain *const a = ball(&one, 0, 1);
    return match_of(a, ball(&two, .4, 3), 0, NULL);
}

typedef struct boundary {
    icc_domain_info info;
    double *x;
    uint32_t *facets;
} boundary;

static boundary boundary_of(const icc_domain *domain)
{
    boundary b = {.info = {.size = sizeof b.info}};
    ck_assert_int_eq(icc_domain_get_info(domain, &b.info), ICC_OK);
    const size_t dim = (size_t)b.info.dim;
    b.x = saved_alloc(b.info.n_vertices * dim * sizeof *b.x);
    b.facets = saved_alloc(b.info.n_facets * dim * sizeof *b.facets);
    ck_assert_int_eq(icc_domain_get_boundary(domain, b.x, b.facets), ICC_OK);
    return b;
}

static void free_boundary(boundary *b)
{
    free(b->x);
    free(b->facets);
}

static double size_of(const boundary *b)
{
    double sum = 0;
    for (int k = 0; k < b->info.dim; ++k)
        sum += (b->info.upper[k] - b->info.lower[k]) * (b->info.upper[k] - b->info.lower[k]);
    return sqrt(sum);
}

/* Vertices go to their partners bit by bit, and middles of facets to middles, both ways. */
static void check_common(const icc_match *match)
{
    boundary b[2] = {boundary_of(icc_match_source(match)), boundary_of(icc_match_target(match))};
    const size_t n = b[0].info.n_vertices, dim = (size_t)b[0].info.dim;
    double *const image = saved_alloc(n * dim * sizeof *image);
    double *const off = saved_alloc(n * sizeof *off);
    for (int from = 0; from < 2; ++from) {
        const boundary *const a = &b[from], *const z = &b[1 - from];
        icc_status (*const apply)(const icc_match *, size_t, const double *, double *, double *,
                                  const icc_env *) =
            from == 0 ? icc_match_apply : icc_match_apply_inverse;
        ck_assert_int_eq(apply(match, n, a->x, image, off, NULL), ICC_OK);
        ck_assert_same(image, z->x, n * dim * sizeof *image, "partners of the vertices");
        for (size_t v = 0; v < n; ++v)
            ck_assert_double_eq(off[v], 0);
        for (size_t f = 0; f < a->info.n_facets; ++f) {
            double p[3] = {0}, right[3] = {0};
            for (size_t i = 0; i < dim; ++i)
                for (size_t k = 0; k < dim; ++k) {
                    p[k] += a->x[dim * a->facets[dim * f + i] + k] / (double)dim;
                    right[k] += z->x[dim * a->facets[dim * f + i] + k] / (double)dim;
                }
            ck_assert_int_eq(apply(match, 1, p, p, off, NULL), ICC_OK);
            for (size_t k = 0; k < dim; ++k)
                ck_assert_double_le(fabs(p[k] - right[k]), 1e-9 * size_of(z));
            ck_assert_double_le(off[0], 1e-12 * size_of(a));
        }
    }
    free(image);
    free(off);
    free_boundary(&b[0]);
    free_boundary(&b[1]);
}

START_TEST(common_vertices_go_to_their_partners)
{
    icc_match *match = plates();
    check_common(match);
    icc_match_free(match);
    match = balls();
    check_common(match);
    icc_match_free(match);
}
END_TEST

static double distance_off(const icc_domain *domain, const boundary *b, const double *p)
{
    int32_t where;
    uint32_t f;
    double w[3], sum = 0;
    ck_assert_int_eq(icc_domain_locate(domain, 1, p, &where, &f, w, NULL), ICC_OK);
    for (size_t k = 0; k < 3; ++k) {
        double x = -p[k];
        for (size_t i = 0; i < 3; ++i)
            x += w[i] * b->x[3 * b->facets[3 * f + i] + k];
        sum += x * x;
    }
    return sqrt(sum);
}

/* Points of the surfaces as they were given come to within the tolerance of the other one, from
 * within the tolerance. */
START_TEST(points_of_the_given_surfaces)
{
    icc_match *const match = balls();
    icc_match_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    ck_assert(info.off > 0);
    icc_domain *const given[2] = {ball(&one, 0, 1), ball(&two, .4, 3)};
    boundary b[2] = {boundary_of(given[0]), boundary_of(given[1])};
    bool some_off = false;
    for (int from = 0; from < 2; ++from) {
        const size_t n = b[from].info.n_vertices;
        double *const image = saved_alloc(3 * n * sizeof *image);
        double *const off = saved_alloc(n * sizeof *off);
        ck_assert_int_eq((from == 0 ? icc_match_apply : icc_match_apply_inverse)(
                             match, n, b[from].x, image, off, NULL),
                         ICC_OK);
        for (size_t v = 0; v < n; ++v) {
            ck_assert_double_le(off[v], 1.0001 * info.off * size_of(&b[from]));
            ck_assert_double_le(distance_off(given[1 - from], &b[1 - from], image + 3 * v),
                                1.0001 * info.off * size_of(&b[1 - from]));
            some_off = some_off || off[v] > 0;
        }
        free(image);
        free(off);
    }
    ck_assert(some_off);
    for (int s = 0; s < 2; ++s) {
        free_boundary(&b[s]);
        icc_domain_free(given[s]);
    }
    icc_match_free(match);
}
END_TEST

START_TEST(landmarks_and_what_is_no_point)
{
    static const uint32_t at[2][4] = {{0, 2, 4, 5}, {3, 40, 17, 90}};
    double landmarks[24], p[3 * 6] = {NAN, 0, 0, 0, INFINITY, 0}, image[3 * 6], off[6];
    icc_domain *const source = ball(&one, 0, 1), *const target = ball(&two, .4, 3);
    for (size_t k = 0; k < 4; ++k) {
        memcpy(landmarks + 6 * k, one.vertices + 3 * at[0][k], 3 * sizeof *p);
        memcpy(landmarks + 6 * k + 3, two.vertices + 3 * at[1][k], 3 * sizeof *p);
        memcpy(p + 6 + 3 * k, landmarks + 6 * k, 3 * sizeof *p);
    }
    icc_match *const match = match_of(source, target, 4, landmarks);
    ck_assert_int_eq(icc_match_apply(match, 6, p, image, off, NULL), ICC_OK);
    for (size_t k = 0; k < 6; ++k)
        if (k < 2)
            ck_assert(isnan(image[3 * k]) && isnan(image[3 * k + 1]) && isnan(image[3 * k + 2]) &&
                      isnan(off[k]));
        else
            ck_assert_mem_eq(image + 3 * k, landmarks + 6 * (k - 2) + 3, 3 * sizeof *image);
    ck_assert_int_eq(icc_match_apply(match, 6, p, p, NULL, NULL), ICC_OK);
    ck_assert_mem_eq(p + 6, image + 6, 12 * sizeof *p);
    ck_assert_int_eq(icc_match_apply(match, 0, NULL, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_match_apply(NULL, 1, p, p, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_match_apply_inverse(match, 1, NULL, p, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_match_apply(match, 1, p, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    icc_match_free(match);
}
END_TEST

/* ---- bytes ---- */

static bytes bytes_of(const icc_match *match)
{
    bytes b = {0};
    size_t again;
    ck_assert_int_eq(icc_match_save(match, 0, NULL, &b.n), ICC_OK);
    b.data = saved_alloc(b.n);
    ck_assert_int_eq(icc_match_save(match, b.n, b.data, &again), ICC_OK);
    ck_assert_uint_eq(again, b.n);
    return b;
}

/* With lines and points inside, a landmark on each of them; also of what was saved. */
START_TEST(what_lies_inside)
{
    static const double outer[] = {0, 0, 10, 0, 10, 8, 1, 9}, dot[] = {3, 4};
    static const double line[] = {5, 2, 6, 4, 8, 5}, other[] = {5, 2.1, 7, 4.2, 7.5, 5, 8, 5.5};
    static const double landmarks[] = {3, 4, 3.1, 4.2, 6, 4, 7, 4.2};
    static const double asked[] = {3, 4, 5, 2, 6, 4, 8, 5, 1, 9, 3.2, 4};
    static const double want[] = {3.1, 4.2, 5, 2.1, 7, 4.2, 8, 5.5, 1, 9, 3.1, 4.2};
    const double moved[] = {3.1, 4.2};
    icc_domain *domain[2] = {NULL, NULL};
    for (int e = 0; e < 2; ++e) {
        const icc_feature features[] = {
            {sizeof *features, ICC_FEATURE_POINT, 1, e == 0 ? dot : moved, 0, 0, NULL},
            {sizeof *features, ICC_FEATURE_LINE, e == 0 ? 3 : 4, e == 0 ? line : other, 0, 0,
             NULL}};
        ck_assert_int_eq(icc_domain_create_features(&domain[e], 4, outer, 2, features, NULL, NULL),
                         ICC_OK);
    }
    icc_match *match = match_of(domain[0], domain[1], 2, landmarks);
    for (int way = 0; way < 2; ++way) {
        double image[12], off[6];
        ck_assert_int_eq(icc_match_apply(match, 6, asked, image, off, NULL), ICC_OK);
        for (size_t k = 0; k < 12; ++k)
            ck_assert_double_eq(image[k], want[k]);
        ck_assert_double_eq_tol(off[5], .2, 1e-15);
        bytes b = bytes_of(match);
        icc_match_free(match);
        ck_assert_int_eq(icc_match_load(&match, b.n, b.data, NULL, NULL), ICC_OK);
        free(b.data);
    }
    icc_match_free(match);
}
END_TEST

static void check_loaded(icc_match *match)
{
    bytes b = bytes_of(match);
    icc_match *loaded = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_match_load(&loaded, b.n, b.data, NULL, &err) == ICC_OK, "%s", err.message);
    bytes c = bytes_of(loaded);
    ck_assert_uint_eq(b.n, c.n);
    ck_assert_same(b.data, c.data, b.n, "what is saved again");
    same_domain(icc_match_source(match), icc_match_source(loaded));
    same_domain(icc_match_target(match), icc_match_target(loaded));
    icc_match_info x = {.size = sizeof x}, y = {.size = sizeof y};
    ck_assert_int_eq(icc_match_get_info(match, &x), ICC_OK);
    ck_assert_int_eq(icc_match_get_info(loaded, &y), ICC_OK);
    ck_assert_same(&x, &y, sizeof x, "info");
    uint32_t *const origin = saved_alloc(4 * x.n_vertices * sizeof *origin);
    ck_assert_int_eq(icc_match_get_origins(match, origin, origin + x.n_vertices), ICC_OK);
    ck_assert_int_eq(
        icc_match_get_origins(loaded, origin + 2 * x.n_vertices, origin + 3 * x.n_vertices),
        ICC_OK);
    ck_assert_same(origin, origin + 2 * x.n_vertices, 2 * x.n_vertices * sizeof *origin, "origins");
    free(origin);
    check_common(loaded);
    icc_match_free(loaded);
    /* Every length, and changes that the checksum is made to fit. */
    for (size_t n = 0; n < b.n; n += n < 300 ? 1 : 211)
        ck_assert_int_eq(icc_match_load(&loaded, n, b.data, NULL, NULL), ICC_ERR_FORMAT);
    ck_assert_ptr_null(loaded);
    free(b.data);
    free(c.data);
}

START_TEST(what_is_saved_is_loaded)
{
    icc_match *match = plates();
    check_loaded(match);
    icc_match_free(match);
    match = balls();
    check_loaded(match);
    icc_match_free(match);
}
END_TEST

/* Domains that do not correspond are refused: of two matches the one's source with the other's
 * target, whose lengths are the same. */
START_TEST(what_does_not_correspond_is_refused)
{
    static const double square[8] = {0, 0, 2, 0, 2, 1, 0, 1};
    static const double turned[8] = {2, 0, 2, 1, 0, 1, 0, 0}, back[8] = {0, 1, 2, 1, 2, 0, 0, 0};
    icc_match *match = NULL, *loaded = NULL;
    for (int k = 0; k < 2; ++k) {
        icc_domain *source = NULL, *target = NULL;
        const double *const xy = k == 0 ? turned : back;
        ck_assert_int_eq(icc_domain_create(&source, 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_domain_create(&target, 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
        match = match_of(source, target, 1, (const double[]){0, 0, 0, 0});
        bytes b = bytes_of(match);
        /* The target's coordinates are behind the source's domain. */
        size_t at = 0, n_found = 0;
        for (size_t i = 24; i + sizeof square <= b.n; ++i)
            if (memcmp(b.data + i, square, sizeof square) == 0) {
                at = i;
                ++n_found;
            }
        ck_assert_uint_eq(n_found, 2);
        memcpy(b.data + at, xy, sizeof square);
        repair_bytes(&b, "MTCH");
        ck_assert_int_eq(icc_match_load(&loaded, b.n, b.data, NULL, NULL),
                         k == 0 ? ICC_OK : ICC_ERR_FORMAT);
        ck_assert((loaded != NULL) == (k == 0));
        icc_match_free(loaded);
        icc_match_free(match);
        free(b.data);
    }
}
END_TEST

static icc_status load_once(const icc_env *env, icc_error *err, void *argument)
{
    const bytes *const b = argument;
    icc_match *match = NULL;
    const icc_status status = icc_match_load(&match, b->n, b->data, env, err);
    ck_assert((status == ICC_OK) == (match != NULL));
    icc_match_free(match);
    return status;
}

START_TEST(loading_fails_cleanly)
{
    icc_match *const match = plates();
    bytes b = bytes_of(match);
    icc_match_free(match);
    faulty_sweep(load_once, &b);
    free(b.data);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("match_follow");
    TCase *tests = tcase_create("match_follow");
    tcase_add_test(tests, common_vertices_go_to_their_partners);
    tcase_add_test(tests, points_of_the_given_surfaces);
    tcase_add_test(tests, landmarks_and_what_is_no_point);
    tcase_add_test(tests, what_lies_inside);
    tcase_add_test(tests, what_is_saved_is_loaded);
    tcase_add_test(tests, what_does_not_correspond_is_refused);
    tcase_add_test(tests, loading_fails_cleanly);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
