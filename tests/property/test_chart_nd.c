/* What holds for the gradient coordinates of solids and masks of any dimension. */
#include "chart/chart.h"
#include "gradient/coordinates/gradient_line.h"
#include "gradient/grid/kuhn_simplex.h"

#include "../faulty.h"
#include "../npy.h"
#include "../obj.h"
#include "../random.h"
#include "../share.h"
#include "../suite.h"
#include "../surface_domains.h"
#include "../surfaces.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct subject {
    icc_domain *domain;
    icc_chart *chart;
    icc_domain_info shape;
    icc_chart_info info;
} subject;

static void subject_clear(subject *s)
{
    icc_domain_free(s->domain);
    icc_chart_free(s->chart);
}

static icc_chart_options options_of(int32_t function, int32_t cells)
{
    return (icc_chart_options){.size = sizeof(icc_chart_options),
                               .method = ICC_METHOD_GRADIENT,
                               .function = function,
                               .constraints = ICC_CONSTRAINTS_NONE,
                               .cells = cells};
}

/* ---- shapes ---- */

static int has_box_cell(int x, int y, int z)
{
    return x >= 0 && y >= 0 && z >= 0 && x < 3 && y < 2 && z < 2;
}

static icc_domain *box(void)
{
    static surface s;
    surface_cells(&s, 3, has_box_cell);
    for (size_t i = 0; i < s.n_vertices; ++i) {
        double *v = s.vertices + 3 * i;
        v[0] = 0.9 * v[0] + 0.1 * v[1];
        v[2] = v[2] + 0.05 * v[0] - 1;
    }
    return domain_of_surface(&s);
}

static icc_domain *rock(void)
{
    static surface s;
    random_source r = {5};
    surface_star(&s, 3, 0.15, &r);
    return domain_of_surface(&s);
}

static icc_domain *fox(void)
{
    obj o;
    icc_domain *domain = NULL;
    if (obj_read(&o, TEST_SHARED_DATA "/3d/t08_fox.src.obj"))
        ck_assert_int_eq(
            icc_domain_create(&domain, 3, o.n_vertices, o.vertices, o.n_faces, o.faces, NULL, NULL),
            ICC_OK);
    obj_free(&o);
    return domain;
}

static icc_domain *fox_through_time(void)
{
    npy a;
    icc_domain *domain = NULL;
    if (npy_read(&a, TEST_SHARED_DATA "/masks/n5_fox_4d.npy")) {
        ck_assert_int_eq(icc_mask_repair(a.dim, a.shape, a.cells, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_domain_create_mask(&domain, a.dim, a.shape, a.cells, NULL, NULL),
                         ICC_OK);
    }
    free(a.cells);
    return domain;
}

/* An L, extended along the other axes. */
static icc_domain *corner(int32_t dim)
{
    const size_t shape[ICC_MAX_DIM] = {3, 3, 2, 2, 1, 1};
    uint8_t cells[9 * 4];
    size_t n = 1;
    for (int32_t k = 0; k < dim; ++k)
        n *= shape[k];
    for (size_t i = 0; i < n; ++i)
        cells[i] = !(i % 3 > 0 && i / 3 % 3 > 1);
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create_mask(&domain, dim, shape, cells, NULL, NULL), ICC_OK);
    return domain;
}

/* The last one is large: only some tests include it. */
enum { FOX = 2, N_SMALL = 7, N_SHAPES = 8 };

static icc_domain *shape_number(int k)
{
    switch (k) {
    case 0:
        return box();
    case 1:
        return rock();
    case FOX:
        return fox();
    case N_SMALL:
        return fox_through_time();
    default:
        return corner(k - 1);
    }
}

static const int32_t CELLS[N_SHAPES] = {13, 16, 40, 20, 12, 8, 6, 0};

/* False when the shape is not at hand. */
static bool subject_init(subject *s, int shape, int32_t function)
{
    *s = (subject){.shape = {.size = sizeof s->shape}, .info = {.size = sizeof s->info}};
    s->domain = shape_number(shape);
    if (s->domain == NULL)
        return false;
    const icc_chart_options options = options_of(function, CELLS[shape]);
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_chart_create(&s->chart, s->domain, &options, NULL, &err);
    ck_assert_msg(status == ICC_OK, "shape %d: %s", shape, err.message);
    (void)icc_domain_get_info(s->domain, &s->shape);
    (void)icc_chart_get_info(s->chart, &s->info);
    return true;
}

/* ---- points ---- */

typedef struct code {
    uint32_t facet;
    double bary[ICC_MAX_DIM], t;
    icc_status status;
} code;

static code encode(const subject *s, const double *p)
{
    code c = {0};
    ck_assert_int_eq(
        icc_chart_encode(s->chart, 1, p, &c.facet, c.bary, &c.t, &c.status, NULL, NULL), ICC_OK);
    return c;
}

static icc_status decode(const subject *s, const code *c, double *p)
{
    icc_status status;
    ck_assert_int_eq(
        icc_chart_decode(s->chart, 1, &c->facet, c->bary, &c->t, p, &status, NULL, NULL), ICC_OK);
    return status;
}

static void pick_inside(const subject *s, random_source *r, double *p)
{
    int32_t where;
    do {
        for (int32_t k = 0; k < s->shape.dim; ++k)
            p[k] = random_between(r, s->shape.lower[k], s->shape.upper[k]);
        (void)icc_domain_locate(s->domain, 1, p, &where, NULL, NULL, NULL);
    } while (where != ICC_INSIDE);
}

static double width(const subject *s)
{
    double longest = 0;
    for (int32_t k = 0; k < s->shape.dim; ++k)
        longest = fmax(longest, s->shape.upper[k] - s->shape.lower[k]);
    return longest;
}

static double distance(const subject *s, const double *p, const double *q)
{
    double square = 0;
    for (int32_t k = 0; k < s->shape.dim; ++k)
        square += (p[k] - q[k]) * (p[k] - q[k]);
    return sqrt(square);
}

/* Whether the line from a point down to the boundary meets others: then another line leads up. */
static bool merges_below(const subject *s, const double *p)
{
    const iccp_gradient_state *state = s->chart->state;
    double local[ICC_MAX_DIM], q[ICC_MAX_DIM];
    iccp_gradient_line line;
    iccp_frame_in(&s->domain->frame, s->shape.dim, p, local);
    iccp_gradient_to_lattice(state, local, q);
    return iccp_gradient_down(state, q, NULL, NULL, &line) != ICC_OK || line.merged;
}

/* Whether what encode() gives for a point is well-formed. */
static void check_code(const subject *s, const code *c)
{
    double sum = 0;
    if (c->status != ICC_OK) {
        ck_assert(c->status == ICC_ERR_TRACE && isnan(c->t) && isnan(c->bary[0]));
        ck_assert_uint_eq(c->facet, UINT32_MAX);
        return;
    }
    for (int32_t k = 0; k < s->shape.dim; ++k) {
        ck_assert(c->bary[k] >= 0);
        sum += c->bary[k];
    }
    ck_assert_double_eq_tol(sum, 1, 1e-14);
    ck_assert(c->t > 0 && c->t < 1 && c->facet < s->shape.n_facets);
}

START_TEST(points_come_back_where_lines_do_not_merge)
{
    random_source r = {1};
    for (int k = 0; k < 3 * N_SHAPES; ++k) {
        subject s;
        int n_failed = 0, n_alone = 0;
        if (!subject_init(&s, k / 3, ICC_FUNCTION_DECAY + k % 3))
            continue;
        for (int i = 0; i < share_of(300); ++i) {
            double p[ICC_MAX_DIM], back[ICC_MAX_DIM];
            pick_inside(&s, &r, p);
            const code c = encode(&s, p);
            check_code(&s, &c);
            n_failed += c.status != ICC_OK;
            if (c.status != ICC_OK || merges_below(&s, p))
                continue;
            ++n_alone;
            ck_assert_int_eq(decode(&s, &c, back), ICC_OK);
            /* 2e-14 was seen where a line turns often. */
            if (!(distance(&s, p, back) <= 1e-12 * width(&s)))
                ck_abort_msg("shape %d: comes back %g away", k / 3, distance(&s, p, back));
        }
        /* The fox is thinner than a cell here and there. */
        ck_assert_int_le(n_failed, k / 3 == FOX ? 6 : 0);
        ck_assert_int_gt(n_alone, share_of(300) / 3);
        subject_clear(&s);
    }
}
END_TEST

/* Whatever the coordinates: points of the boundary and the maximum, from facets of all sizes. */
START_TEST(coordinates_give_points)
{
    random_source r = {2};
    for (int k = 0; k < N_SMALL; ++k) {
        subject s;
        int n_failed = 0;
        if (!subject_init(&s, k, ICC_FUNCTION_LAPLACE))
            continue;
        for (int i = 0; i < share_of(200); ++i) {
            double p[ICC_MAX_DIM], q[ICC_MAX_DIM], rest = 1;
            int32_t where;
            code c = {.facet = (uint32_t)random_below(&r, (int)s.shape.n_facets)};
            for (int32_t m = 0; m < s.shape.dim; ++m) {
                c.bary[m] = m + 1 < s.shape.dim ? rest * random_unit(&r) : rest;
                rest -= c.bary[m];
            }
            ck_assert_int_eq(decode(&s, &c, p), ICC_OK);
            (void)icc_domain_locate(s.domain, 1, p, &where, NULL, NULL, NULL);
            ck_assert_int_eq(where, ICC_BOUNDARY);
            const code at = encode(&s, p);
            ck_assert(at.status == ICC_OK && at.t <= 0);
            c.t = 1;
            ck_assert_int_eq(decode(&s, &c, p), ICC_OK);
            ck_assert_double_le(distance(&s, p, s.info.maximum), 0);
            c.t = random_unit(&r);
            if (decode(&s, &c, q) != ICC_OK) {
                ++n_failed;
                continue;
            }
            (void)icc_domain_locate(s.domain, 1, q, &where, NULL, NULL, NULL);
            ck_assert_int_ne(where, ICC_OUTSIDE);
        }
        ck_assert_int_le(n_failed, k == FOX ? 20 : 2);
        subject_clear(&s);
    }
}
END_TEST

START_TEST(the_maximum_is_a_point_like_others)
{
    for (int k = 0; k < N_SMALL; ++k) {
        subject s;
        if (!subject_init(&s, k, ICC_FUNCTION_DISTANCE))
            continue;
        const code c = encode(&s, s.info.maximum);
        ck_assert(c.status == ICC_OK && c.t >= 1 && c.facet == 0);
        for (int32_t m = 0; m < s.shape.dim; ++m)
            ck_assert_double_eq(c.bary[m], 1.0 / s.shape.dim);
        icc_gradient_info own = {.size = sizeof own};
        ck_assert_int_eq(icc_chart_get_gradient_info(s.chart, &own), ICC_OK);
        ck_assert_int_eq((int)own.n_maxima, 1);
        ck_assert(s.info.certified == 0 && own.n_inside <= own.n_grid);
        subject_clear(&s);
    }
}
END_TEST

/* f at a point of the chart, by linear interpolation. */
static double interpolate(const subject *s, const double *p)
{
    const iccp_gradient_state *state = s->chart->state;
    double local[ICC_MAX_DIM], x[ICC_MAX_DIM], lambda[ICC_MAX_DIM + 1], f = 0;
    iccp_kuhn_simplex simplex;
    iccp_frame_in(&s->domain->frame, s->shape.dim, p, local);
    iccp_gradient_to_lattice(state, local, x);
    if (!iccp_kuhn_simplex_at(&simplex, state->tree->grid, x, lambda))
        ck_abort_msg("beyond the grid");
    for (int32_t i = 0; i <= s->shape.dim; ++i)
        if (lambda[i] > 0)
            f += lambda[i] * state->field->values[simplex.corner[i]];
    return f;
}

START_TEST(curves_rise_from_the_boundary_to_the_maximum)
{
    enum { ROOM = 4000 };
    static double curve[ROOM * ICC_MAX_DIM];
    random_source r = {3};
    for (int k = 0; k < 2 * N_SMALL; ++k) {
        subject s;
        if (!subject_init(&s, k / 2, k % 2 ? ICC_FUNCTION_LAPLACE : ICC_FUNCTION_DECAY))
            continue;
        const size_t dim = (size_t)s.shape.dim;
        for (int i = 0; i < 50; ++i) {
            double p[ICC_MAX_DIM], nearest = HUGE_VAL;
            size_t n;
            int32_t where;
            pick_inside(&s, &r, p);
            if (icc_chart_trace(s.chart, p, ROOM, curve, &n, NULL, NULL) != ICC_OK)
                continue;
            ck_assert(n >= 3 && n <= ROOM);
            (void)icc_domain_locate(s.domain, 1, curve, &where, NULL, NULL, NULL);
            ck_assert_int_eq(where, ICC_BOUNDARY);
            ck_assert_double_le(distance(&s, curve + (n - 1) * dim, s.info.maximum),
                                1e-14 * width(&s));
            for (size_t m = 1; m < n; ++m) {
                const double *a = curve + (m - 1) * dim, *b = curve + m * dim;
                if (interpolate(&s, b) < interpolate(&s, a) - 1e-9)
                    ck_abort_msg("shape %d falls by %g", k / 2,
                                 interpolate(&s, a) - interpolate(&s, b));
                nearest = fmin(nearest, distance(&s, p, b));
            }
            ck_assert_double_le(nearest, 1e-13 * width(&s));
        }
        subject_clear(&s);
    }
}
END_TEST

/* A step from the middle of a facet along the vector ends inside, a step back outside. */
START_TEST(inward_is_inward)
{
    for (int k = 0; k < N_SMALL; ++k) {
        icc_domain *domain = shape_number(k);
        for (uint32_t f = 0; domain != NULL && f < domain->n_facets; f += 1 + f / 64) {
            double bary[ICC_MAX_DIM], inward[ICC_MAX_DIM], middle[ICC_MAX_DIM], p[ICC_MAX_DIM];
            double length = 0;
            for (int32_t m = 0; m < domain->dim; ++m)
                bary[m] = 1.0 / domain->dim;
            iccp_domain_facet_point(domain, f, bary, middle);
            iccp_facet_inward(domain, f, inward);
            for (int32_t m = 0; m < domain->dim; ++m)
                length += inward[m] * inward[m];
            ck_assert_double_gt(length, 0);
            for (int sign = -1; sign <= 1; sign += 2) {
                for (int32_t m = 0; m < domain->dim; ++m)
                    p[m] = middle[m] + sign * 1e-6 / sqrt(length) * inward[m];
                ck_assert_int_eq(iccp_domain_locate(domain, p, true, NULL, NULL),
                                 sign > 0 ? ICC_INSIDE : ICC_OUTSIDE);
            }
        }
        icc_domain_free(domain);
    }
}
END_TEST

/* Whether a derivative is that of three values a step apart, two times; false where they do not
 * tell, as where the function has a kink. */
static bool agrees(double low, double at, double high, double step, double derivative)
{
    const double left = (at - low) / step, right = (high - at) / step;
    if (fabs(left - right) > 1e-5 * (1 + fabs(left)))
        return false;
    ck_assert_double_eq_tol(0.5 * (left + right), derivative, 1e-4 * (1 + fabs(left)));
    return true;
}

START_TEST(jets_are_derivatives)
{
    static const double STEP = 1e-7;
    int n_encoded = 0, n_decoded = 0, n_tried = 0;
    for (int k = 0; k < 2 * N_SMALL; ++k) {
        subject s;
        random_source r = {(uint64_t)(6 + k)}; /* whatever shapes are at hand */
        iccp_path path;
        if (!subject_init(&s, k / 2, k % 2 ? ICC_FUNCTION_LAPLACE : ICC_FUNCTION_DECAY))
            continue;
        iccp_path_init(&path, &s.chart->memory);
        const int32_t dim = s.shape.dim, i = k % dim;
        for (int m = 0; m < share_of(100); ++m) {
            double p[ICC_MAX_DIM], q[3][ICC_MAX_DIM];
            iccp_coords c[3], start;
            iccp_encode_jet encoded;
            iccp_decode_jet decoded;
            bool good = true;
            pick_inside(&s, &r, p);
            iccp_frame_in(&s.domain->frame, dim, p, q[1]);
            ++n_tried;
            for (int n = 0; n < 3 && good; ++n) {
                memcpy(q[n], q[1], sizeof q[n]);
                q[n][i] += (n - 1) * STEP;
                good = iccp_chart_encode(s.chart, q[n], &c[n], n == 1 ? &encoded : NULL) == ICC_OK;
            }
            if (!good || c[0].facet != c[1].facet || c[2].facet != c[1].facet)
                continue;
            good = agrees(c[0].t, c[1].t, c[2].t, STEP, encoded.t[i]);
            for (int32_t b = 0; b < dim && good; ++b)
                good = agrees(c[0].bary[b], c[1].bary[b], c[2].bary[b], STEP,
                              encoded.bary[b * dim + i]);
            n_encoded += good;
            /* By t, and from the first corner of the facet to another. */
            for (int32_t b = 0; b < dim; ++b) {
                start = c[1];
                good = b == 0 || fmin(start.bary[0], start.bary[b]) > STEP; /* there are two
                                                                               sides */
                for (int n = 0; n < 3 && good; ++n) {
                    start = c[1];
                    start.t += b == 0 ? (n - 1) * STEP : 0;
                    start.bary[b] += b > 0 ? (n - 1) * STEP : 0;
                    start.bary[0] -= b > 0 ? (n - 1) * STEP : 0;
                    good = iccp_chart_decode(s.chart, &start, q[n], n == 1 ? &decoded : NULL,
                                             &path) == ICC_OK;
                }
                for (int32_t x = 0; x < dim && good; ++x)
                    good = agrees(q[0][x], q[1][x], q[2][x], STEP,
                                  b == 0 ? decoded.t[x] : decoded.bary[x * dim + b]);
                n_decoded += good;
            }
        }
        iccp_path_clear(&path);
        subject_clear(&s);
    }
    ck_assert_int_gt(n_encoded, n_tried / 2);
    ck_assert_int_gt(n_decoded, n_tried);
}
END_TEST

START_TEST(measures_are_shares)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        subject s;
        icc_chart_report m = {.size = sizeof m};
        if (!subject_init(&s, k, ICC_FUNCTION_LAPLACE))
            continue;
        ck_assert_int_eq(icc_chart_get_report(s.chart, 500, &m, NULL, NULL), ICC_OK);
        ck_assert_uint_eq(m.n_boundary, 500);
        ck_assert(m.n_points > 300 && m.n_points < 700);
        /* Lines merge a lot; but from nearly everywhere they reach both ends, and nearly everywhere
         * they start inward. */
        ck_assert(m.unreachable >= 0 && m.unreachable < 0.02);
        ck_assert(m.not_inward >= 0 && m.not_inward < 0.1);
        ck_assert(m.uncovered > 0 && m.uncovered < 1 && m.collapsed > 0.2 && m.collapsed < 1);
        subject_clear(&s);
    }
}
END_TEST

/* ---- threads, memory ---- */

enum { N_POINTS = 400 };

typedef struct answers {
    uint32_t facet[N_POINTS];
    double bary[3 * N_POINTS], t[N_POINTS], points[3 * N_POINTS];
    icc_status encoded[N_POINTS], decoded[N_POINTS];
    icc_chart_report measures;
} answers;

static icc_status ask(answers *a, const icc_domain *domain, const icc_env *env, icc_error *err)
{
    icc_chart *chart;
    const icc_chart_options options = options_of(ICC_FUNCTION_LAPLACE, 14);
    random_source r = {4};
    for (int i = 0; i < 3 * N_POINTS; ++i)
        a->points[i] = random_between(&r, -0.7, 0.7);
    a->measures = (icc_chart_report){.size = sizeof a->measures};
    icc_status status = icc_chart_create(&chart, domain, &options, env, err);
    if (status == ICC_OK)
        status = icc_chart_encode(chart, N_POINTS, a->points, a->facet, a->bary, a->t, a->encoded,
                                  NULL, env);
    if (status == ICC_OK)
        status = icc_chart_decode(chart, N_POINTS, a->facet, a->bary, a->t, a->points, a->decoded,
                                  NULL, env);
    if (status == ICC_OK)
        status = icc_chart_get_report(chart, 200, &a->measures, env, err);
    icc_chart_free(chart);
    return status;
}

START_TEST(results_do_not_depend_on_the_number_of_threads)
{
    static answers one, many;
    icc_domain *domain = rock();
    memset(&one, 0, sizeof one);
    memset(&many, 0, sizeof many);
    ck_assert_int_eq(ask(&one, domain, NULL, NULL), ICC_OK);
    for (int32_t n = 2; n <= 8; n *= 2) {
        const icc_env env = {.size = sizeof env, .threads = n};
        ck_assert_int_eq(ask(&many, domain, &env, NULL), ICC_OK);
        ck_assert_mem_eq(&one, &many, sizeof one);
    }
    icc_domain_free(domain);
}
END_TEST

static icc_status create_chart(const icc_env *env, icc_error *err, void *domain)
{
    icc_chart *chart = NULL;
    icc_chart_report measures = {.size = sizeof measures};
    const icc_chart_options options = options_of(ICC_FUNCTION_DISTANCE, 5);
    icc_status status = icc_chart_create(&chart, domain, &options, env, err);
    ck_assert((chart != NULL) == (status == ICC_OK));
    if (status == ICC_OK)
        status = icc_chart_get_report(chart, 64, &measures, env, err);
    icc_chart_free(chart);
    return status;
}

START_TEST(every_failure_is_reported)
{
    icc_domain *domain = corner(3);
    faulty_sweep(create_chart, domain);
    icc_domain_free(domain);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("charts in any dimension");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, points_come_back_where_lines_do_not_merge);
    tcase_add_test(tests, coordinates_give_points);
    tcase_add_test(tests, the_maximum_is_a_point_like_others);
    tcase_add_test(tests, curves_rise_from_the_boundary_to_the_maximum);
    tcase_add_test(tests, inward_is_inward);
    tcase_add_test(tests, jets_are_derivatives);
    tcase_add_test(tests, measures_are_shares);
    tcase_add_test(tests, results_do_not_depend_on_the_number_of_threads);
    tcase_add_test(tests, every_failure_is_reported);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
