/* What holds for the gradient coordinates of every shape, whatever the options. */
#include "chart/chart.h"
#include "gradient/coordinates/gradient_state.h"

#include "../random.h"
#include "../shapes.h"
#include "../share.h"
#include "../suite.h"

#include <check.h>
#include <stdlib.h>

typedef struct subject {
    icc_domain *domain;
    icc_chart *chart;
    icc_domain_info shape;
    icc_chart_info info;
} subject;

static bool subject_init(subject *s, const shape *outline, const icc_chart_options *options)
{
    *s = (subject){.shape = {.size = sizeof s->shape}, .info = {.size = sizeof s->info}};
    ck_assert_int_eq(icc_domain_create(&s->domain, 2, outline->n, outline->xy, 0, NULL, NULL, NULL),
                     ICC_OK);
    const icc_status status = icc_chart_create(&s->chart, s->domain, options, NULL, NULL);
    /* With two or three cells no vertex may lie inside. */
    ck_assert(status == ICC_OK || (status == ICC_ERR_RESOLUTION && options->cells < 4));
    (void)icc_domain_get_info(s->domain, &s->shape);
    (void)icc_chart_get_info(s->chart, &s->info);
    return status == ICC_OK;
}

static void subject_clear(subject *s)
{
    icc_domain_free(s->domain);
    icc_chart_free(s->chart);
}

static double width(const subject *s)
{
    return fmax(s->shape.upper[0] - s->shape.lower[0], s->shape.upper[1] - s->shape.lower[1]);
}

typedef struct code {
    uint32_t facet;
    double bary[2], t;
    icc_status status;
} code;

static code encode(const subject *s, const double p[2])
{
    code c;
    size_t n_failed;
    ck_assert_int_eq(
        icc_chart_encode(s->chart, 1, p, &c.facet, c.bary, &c.t, &c.status, &n_failed, NULL),
        ICC_OK);
    if (n_failed != (c.status != ICC_OK))
        ck_abort_msg("wrong number of failures");
    return c;
}

static icc_status decode(const subject *s, const code *c, double p[2])
{
    icc_status status;
    ck_assert_int_eq(
        icc_chart_decode(s->chart, 1, &c->facet, c->bary, &c->t, p, &status, NULL, NULL), ICC_OK);
    return status;
}

/* A point of the bounding box. */
static void pick(const subject *s, random_source *r, double p[2])
{
    for (int k = 0; k < 2; ++k)
        p[k] = random_between(r, s->shape.lower[k], s->shape.upper[k]);
}

static void to_lattice(const subject *s, const double p[2], double lattice[2])
{
    double local[2];
    iccp_frame_in(&s->domain->frame, 2, p, local);
    iccp_gradient_to_lattice(s->chart->state, local, lattice);
}

/* Whether the line from a point down to the boundary meets others: then another line leads up. */
static bool merges_below(const subject *s, const double p[2])
{
    const iccp_gradient_state *state = s->chart->state;
    double q[2];
    iccp_walk2 walk;
    iccp_boundary_hit2 hit;
    to_lattice(s, p, q);
    if (iccp_walk2_start(&walk, state->field, ICCP_DOWNHILL, q[0], q[1], NULL) != ICC_OK ||
        iccp_trace_downhill(&walk, &state->cells2, NULL, &hit) != ICC_OK)
        return true;
    return walk.merged;
}

/* The share of the boundary before the point with these coordinates. */
static void boundary_point(const subject *s, const code *c, double p[2])
{
    const code foot = {.facet = c->facet, .bary = {c->bary[0], c->bary[1]}, .t = 0};
    ck_assert_int_eq(decode(s, &foot, p), ICC_OK);
}

static double distance(const double a[2], const double b[2])
{
    return hypot(a[0] - b[0], a[1] - b[1]);
}

/* All combinations of form and function, with grids from hopeless to fine. */
static icc_chart_options options_number(int k)
{
    static const int32_t CELLS[] = {2, 3, 7, 20, 50, 200};
    return (icc_chart_options){.size = sizeof(icc_chart_options),
                               .method = ICC_METHOD_GRADIENT,
                               .tree = k % 2 ? ICC_TREE_PAPER : ICC_TREE_THESIS,
                               .function = k / 2 % 2 ? ICC_FUNCTION_DISTANCE : ICC_FUNCTION_DECAY,
                               .cells = CELLS[k / 4]};
}
enum { N_OPTIONS = 24 };

static icc_chart_options cells(int32_t n)
{
    return (icc_chart_options){
        .size = sizeof(icc_chart_options), .method = ICC_METHOD_GRADIENT, .cells = n};
}

/* Errors of one round trip, in units of the shape's width and as they are. */
static void check_round_trip(const subject *s, const double p[2])
{
    const code c = encode(s, p);
    double back[2];
    if (c.status == ICC_ERR_TRACE) {
        if (!isnan(c.t) || !isnan(c.bary[0]) || !isnan(c.bary[1]) || c.facet != UINT32_MAX)
            ck_abort_msg("a failed point has coordinates");
        return;
    }
    ck_assert_int_eq(c.status, ICC_OK);
    if (!(c.t >= 0 && c.t <= 1 && c.bary[0] >= 0 && c.bary[1] >= 0 &&
          fabs(c.bary[0] + c.bary[1] - 1) < 1e-15))
        ck_abort_msg("coordinates out of range");
    const icc_status status = decode(s, &c, back);
    if (merges_below(s, p)) {
        ck_assert(status == ICC_OK || (status == ICC_ERR_TRACE && isnan(back[0])));
        return;
    }
    ck_assert_int_eq(status, ICC_OK);
    /* The finer the grid the more often a line bends; 1e-11 was seen at 200 cells. */
    if (distance(p, back) > 1e-10 * width(s))
        ck_abort_msg("(%.17g, %.17g) comes back %g away", p[0], p[1], distance(p, back));
    const code again = encode(s, back);
    if (again.facet == c.facet &&
        (fabs(again.t - c.t) > 1e-12 || fabs(again.bary[1] - c.bary[1]) > 1e-11))
        ck_abort_msg("coordinates come back %g away", fabs(again.t - c.t));
}

START_TEST(points_come_back_where_lines_do_not_merge)
{
    random_source r = {1};
    for (int k = 0; k < N_SHAPES * N_OPTIONS; ++k) {
        const shape outline = shape_number(k / N_OPTIONS);
        const icc_chart_options options = options_number(k % N_OPTIONS);
        subject s;
        int n_inside = 0;
        if (subject_init(&s, &outline, &options))
            while (n_inside < 60) {
                double p[2];
                int32_t where;
                pick(&s, &r, p);
                ck_assert_int_eq(icc_domain_locate(s.domain, 1, p, &where, NULL, NULL, NULL),
                                 ICC_OK);
                if (where != ICC_INSIDE)
                    continue;
                ++n_inside;
                check_round_trip(&s, p);
            }
        subject_clear(&s);
    }
}
END_TEST

static double random_number(void *source)
{
    return random_unit(source);
}

START_TEST(random_shapes_have_charts)
{
    random_source r = {2};
    for (int k = 0; k < share_of(150); ++k) {
        shape outline = shape_blob(5 + (size_t)random_below(&r, 40), random_number, &r);
        if (k % 3 == 0)
            outline = shape_reversed(&outline);
        icc_chart_options options = options_number(8 + k % 12);
        subject s;
        ck_assert(subject_init(&s, &outline, &options));
        ck_assert_int_eq(s.shape.orientation, k % 3 == 0 ? -1 : 1);
        for (int i = 0; i < 40; ++i) {
            double p[2];
            int32_t where;
            pick(&s, &r, p);
            (void)icc_domain_locate(s.domain, 1, p, &where, NULL, NULL, NULL);
            if (where == ICC_INSIDE)
                check_round_trip(&s, p);
            else
                ck_assert_int_eq(encode(&s, p).status, ICC_ERR_OUTSIDE);
        }
        subject_clear(&s);
    }
}
END_TEST

/* f at a point of a chart. */
static double height(const subject *s, const double p[2])
{
    const iccp_gradient_state *state = s->chart->state;
    const double *f = state->field->values;
    const size_t nx = state->tree->grid->shape[0];
    double q[2];
    to_lattice(s, p, q);
    const double i = floor(q[0]), j = floor(q[1]), u = q[0] - i, v = q[1] - j;
    f += (size_t)i + nx * (size_t)j;
    return v > u ? (1 - v) * f[0] + (v - u) * f[nx] + u * f[nx + 1]
                 : (1 - u) * f[0] + (u - v) * f[1] + v * f[nx + 1];
}

static double *trace(const subject *s, const double p[2], size_t *n)
{
    if (icc_chart_trace(s->chart, p, 0, NULL, n, NULL, NULL) != ICC_OK)
        return NULL;
    double *curve = malloc(2 * *n * sizeof *curve);
    ck_assert_ptr_nonnull(curve);
    size_t again;
    ck_assert_int_eq(icc_chart_trace(s->chart, p, *n, curve, &again, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(*n, again);
    return curve;
}

/* Points along the part of a curve below p, where it is the curve of all of them. */
static void check_shares(const subject *s, const double *curve, size_t n, const double p[2])
{
    double total = 0, length = 0, last = -1;
    for (size_t k = 0; k + 1 < n; ++k)
        total += distance(curve + 2 * k, curve + 2 * k + 2);
    for (size_t k = 0; k + 1 < n; ++k) {
        const double middle[2] = {(curve[2 * k] + curve[2 * k + 2]) / 2,
                                  (curve[2 * k + 1] + curve[2 * k + 3]) / 2};
        const double piece = distance(curve + 2 * k, curve + 2 * k + 2);
        if (height(s, middle) >= height(s, p))
            break;
        const code c = encode(s, middle);
        if (c.status != ICC_OK || fabs(c.t - (length + piece / 2) / total) > 1e-9 || c.t < last)
            ck_abort_msg("t is %g, not %g", c.t, (length + piece / 2) / total);
        last = c.t;
        length += piece;
    }
}

START_TEST(curves_rise_from_the_boundary_to_the_maximum)
{
    random_source r = {3};
    for (int k = 0; k < N_SHAPES * N_OPTIONS; ++k) {
        const shape outline = shape_number(k / N_OPTIONS);
        const icc_chart_options options = options_number(k % N_OPTIONS);
        subject s;
        for (int i = subject_init(&s, &outline, &options) ? 0 : 20; i < 20; ++i) {
            double p[2];
            size_t n;
            int32_t where;
            pick(&s, &r, p);
            double *curve = trace(&s, p, &n);
            const code c = encode(&s, p);
            ck_assert_int_eq(curve != NULL, c.status == ICC_OK);
            if (curve == NULL)
                continue;
            double foot[2];
            boundary_point(&s, &c, foot);
            ck_assert_double_le(distance(curve, foot), 1e-13 * width(&s));
            (void)icc_domain_locate(s.domain, 1, curve, &where, NULL, NULL, NULL);
            ck_assert_int_eq(where, ICC_BOUNDARY);
            ck_assert_mem_eq(curve + 2 * n - 2, s.info.maximum, 2 * sizeof(double));
            double last = height(&s, curve), nearest = HUGE_VAL;
            for (size_t m = 1; m < n; ++m) {
                const double now = height(&s, curve + 2 * m);
                if (now < last - 1e-12)
                    ck_abort_msg("f falls from %.17g to %.17g", last, now);
                last = now;
                nearest = fmin(nearest, distance(p, curve + 2 * m));
            }
            ck_assert_double_le(nearest, 1e-13 * width(&s));
            if (!merges_below(&s, p))
                check_shares(&s, curve, n, p);
            free(curve);
        }
        subject_clear(&s);
    }
}
END_TEST

START_TEST(boundary_points_have_t_zero)
{
    random_source r = {4};
    for (int k = 0; k < 4 * N_SHAPES; ++k) {
        shape outline = shape_number(k / 4);
        if (k % 2)
            outline = shape_reversed(&outline);
        const icc_chart_options options = cells(k / 2 % 2 ? 50 : 9);
        subject s;
        ck_assert(subject_init(&s, &outline, &options));
        for (size_t f = 0; f < outline.n; ++f)
            for (int i = 0; i < 6; ++i) {
                const double *a = outline.xy + 2 * f, *b = outline.xy + 2 * ((f + 1) % outline.n);
                const double along = i == 0 ? 0 : i == 1 ? 1 : random_unit(&r);
                const code on = {.facet = (uint32_t)f, .bary = {1 - along, along}, .t = 0};
                double p[2];
                ck_assert_int_eq(decode(&s, &on, p), ICC_OK);
                if (i < 2)
                    ck_assert_mem_eq(p, i == 0 ? a : b, sizeof p);
                const double expected[2] = {a[0] + along * (b[0] - a[0]),
                                            a[1] + along * (b[1] - a[1])};
                ck_assert_double_le(distance(p, expected), 1e-15 * width(&s));
                const code c = encode(&s, p);
                ck_assert_int_eq(c.status, ICC_OK);
                ck_assert_double_eq(c.t, 0);
                double again[2];
                ck_assert_int_eq(decode(&s, &c, again), ICC_OK);
                if (i < 2) {
                    ck_assert_mem_eq(again, p, sizeof p);
                    ck_assert(c.bary[0] == 1 || c.bary[1] == 1);
                } else {
                    ck_assert_double_le(distance(again, p), 1e-12 * width(&s));
                    ck_assert_uint_eq(c.facet, f);
                    ck_assert_double_eq_tol(c.bary[1], along, 1e-12);
                }
            }
        subject_clear(&s);
    }
}
END_TEST

START_TEST(the_maximum_has_t_one)
{
    for (int k = 0; k < N_SHAPES * N_OPTIONS; ++k) {
        const shape outline = shape_number(k / N_OPTIONS);
        const icc_chart_options options = options_number(k % N_OPTIONS);
        subject s;
        if (subject_init(&s, &outline, &options)) {
            const code c = encode(&s, s.info.maximum);
            ck_assert_int_eq(c.status, ICC_OK);
            ck_assert(c.facet == 0 && c.bary[0] == 0.5 && c.bary[1] == 0.5 && c.t == 1);
            const code other = {.facet = 2, .bary = {0.25, 0.75}, .t = 1};
            double p[2];
            ck_assert_int_eq(decode(&s, &c, p), ICC_OK);
            ck_assert_mem_eq(p, s.info.maximum, sizeof p);
            ck_assert_int_eq(decode(&s, &other, p), ICC_OK);
            ck_assert_mem_eq(p, s.info.maximum, sizeof p);
        }
        subject_clear(&s);
    }
}
END_TEST

START_TEST(points_elsewhere_have_no_coordinates)
{
    static const double BAD[][2] = {{2, 2},           {-1e-9, 0.5},  {0.5, 1 + 1e-12}, {1e300, 0.5},
                                    {-1e308, -1e308}, {HUGE_VAL, 0}, {0.5, NAN},       {0.5, 0.5}};
    enum { N_BAD = sizeof BAD / sizeof *BAD };
    const shape outline = shape_square();
    const icc_chart_options options = cells(10);
    subject s;
    ck_assert(subject_init(&s, &outline, &options));
    uint32_t facet[N_BAD];
    double bary[N_BAD][2], t[N_BAD];
    icc_status status[N_BAD];
    size_t n_failed;
    ck_assert_int_eq(
        icc_chart_encode(s.chart, N_BAD, BAD[0], facet, bary[0], t, status, &n_failed, NULL),
        ICC_OK);
    ck_assert_uint_eq(n_failed, N_BAD - 1);
    for (int k = 0; k < N_BAD - 1; ++k) {
        ck_assert_int_eq(status[k], k < 5 ? ICC_ERR_OUTSIDE : ICC_ERR_ARGUMENT);
        ck_assert(facet[k] == UINT32_MAX && isnan(bary[k][0]) && isnan(bary[k][1]) && isnan(t[k]));
        size_t n;
        ck_assert_int_eq(icc_chart_trace(s.chart, BAD[k], 0, NULL, &n, NULL, NULL), status[k]);
        ck_assert_uint_eq(n, 0);
    }
    ck_assert_int_eq(status[N_BAD - 1], ICC_OK);
    /* Rounding of the input is forgiven. */
    const double near[2] = {0.25, -1e-15};
    const code c = encode(&s, near);
    ck_assert(c.status == ICC_OK && c.facet == 0 && c.t == 0 && c.bary[1] == 0.25);
    const code codes[] = {
        {4, {0.5, 0.5}, 0.5, 0}, {0, {0.5, 0.6}, 0.5, 0},  {0, {-0.5, 1.5}, 0.5, 0},
        {0, {0.5, 0.5}, 1.1, 0}, {0, {0.5, 0.5}, -0.1, 0}, {0, {NAN, 0.5}, 0.5, 0},
        {0, {0.5, 0.5}, NAN, 0}, {0, {HUGE_VAL, 0}, 0, 0}, {UINT32_MAX, {1, 0}, 0, 0}};
    for (size_t k = 0; k < sizeof codes / sizeof *codes; ++k) {
        double p[2] = {0, 0};
        ck_assert_int_eq(decode(&s, codes + k, p), ICC_ERR_ARGUMENT);
        ck_assert(isnan(p[0]) && isnan(p[1]));
    }
    const code nearly = {1, {0.5 + 4e-10, 0.5}, 0, 0};
    double p[2];
    ck_assert_int_eq(decode(&s, &nearly, p), ICC_OK);
    ck_assert_double_eq(p[0], 1);
    ck_assert_double_eq_tol(p[1], 0.5 / (1 + 4e-10), 1e-15);
    subject_clear(&s);
}
END_TEST

/* Shapes without symmetry, so that rounding decides nothing. */
static shape plain_shape(int k)
{
    random_source r = {100 + (uint64_t)k};
    return shape_blob(9 + (size_t)k, random_number, &r);
}

/* The same point of two charts of which one is `scale` times the other, moved. */
static void compare(const subject *a, const subject *b, const double p[2], const double q[2],
                    double tolerance)
{
    const code c = encode(a, p), d = encode(b, q);
    ck_assert_int_eq(c.status, d.status);
    if (c.status != ICC_OK)
        return;
    if (tolerance <= 0) {
        ck_assert_uint_eq(c.facet, d.facet);
        ck_assert_mem_eq(c.bary, d.bary, sizeof c.bary);
        ck_assert_mem_eq(&c.t, &d.t, sizeof c.t);
        return;
    }
    double foot[2][2];
    boundary_point(a, &c, foot[0]);
    boundary_point(b, &d, foot[1]);
    for (int k = 0; k < 2; ++k)
        ck_assert_double_eq_tol((foot[0][k] - a->shape.lower[k]) / width(a),
                                (foot[1][k] - b->shape.lower[k]) / width(b), tolerance);
    ck_assert_double_eq_tol(c.t, d.t, tolerance);
}

START_TEST(sizes_do_not_matter)
{
    static const int EXPONENTS[] = {-996, -300, -20, 7, 300, 996};
    random_source r = {5};
    const icc_chart_options options = cells(30);
    for (int k = 0; k < 8; ++k) {
        const shape outline = plain_shape(k);
        subject a, b;
        ck_assert(subject_init(&a, &outline, &options));
        for (size_t e = 0; e < sizeof EXPONENTS / sizeof *EXPONENTS; ++e) {
            const double scale = ldexp(1, EXPONENTS[e]);
            const shape scaled = shape_moved(&outline, scale, 0, 0);
            ck_assert(subject_init(&b, &scaled, &options));
            for (int i = 0; i < 20; ++i) {
                double p[2];
                pick(&a, &r, p);
                const double q[2] = {p[0] * scale, p[1] * scale};
                compare(&a, &b, p, q, 0);
            }
            ck_assert_double_eq(b.info.maximum[0], a.info.maximum[0] * scale);
            ck_assert_double_eq(b.info.spacing, a.info.spacing * scale);
            subject_clear(&b);
        }
        const shape odd = shape_moved(&outline, 0.3, 0, 0);
        ck_assert(subject_init(&b, &odd, &options));
        for (int i = 0; i < 100; ++i) {
            double p[2];
            pick(&a, &r, p);
            const double q[2] = {p[0] * 0.3, p[1] * 0.3};
            compare(&a, &b, p, q, 1e-9);
        }
        subject_clear(&b);
        subject_clear(&a);
    }
}
END_TEST

/* Far away a shape has rounded coordinates. Moved back, exactly, it is the same shape near zero. */
START_TEST(positions_do_not_matter)
{
    static const double OFFSETS[][2] = {{1e9, -1e9}, {-3e5, 0}, {1e15, 7}, {0, 1.5}};
    random_source r = {6};
    const icc_chart_options options = cells(30);
    for (int k = 0; k < 32; ++k) {
        const double *o = OFFSETS[k % 4];
        const double scale = k % 4 == 2 ? 1e6 : 10;
        shape outline = plain_shape(k / 4);
        outline = shape_moved(&outline, scale, o[0], o[1]);
        const shape back = shape_moved(&outline, 1, -o[0], -o[1]);
        subject a, b;
        ck_assert(subject_init(&a, &outline, &options));
        ck_assert(subject_init(&b, &back, &options));
        for (int i = 0; i < 50; ++i) {
            double p[2];
            pick(&a, &r, p);
            const double q[2] = {p[0] - o[0], p[1] - o[1]};
            compare(&a, &b, p, q, 1e-9 + hypot(o[0], o[1]) * 0x1p-51 / width(&a));
        }
        subject_clear(&b);
        subject_clear(&a);
    }
}
END_TEST

START_TEST(the_caller_may_choose_the_maximum)
{
    random_source r = {7};
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape outline = shape_number(k);
        icc_chart_options options = cells(40);
        subject s;
        ck_assert(subject_init(&s, &outline, &options));
        icc_domain *domain = s.domain;
        for (int i = 0; i < 40; ++i) {
            double p[2];
            int32_t where;
            pick(&s, &r, p);
            (void)icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL);
            options.maximum = p;
            subject own = s;
            icc_error err = {.size = sizeof err};
            const icc_status status = icc_chart_create(&own.chart, domain, &options, NULL, &err);
            ck_assert_int_eq(status, where == ICC_INSIDE ? ICC_OK : ICC_ERR_OUTSIDE);
            if (status != ICC_OK) {
                ck_assert(err.status == status && own.chart == NULL);
                continue;
            }
            own.info = (icc_chart_info){.size = sizeof own.info};
            ck_assert_int_eq(icc_chart_get_info(own.chart, &own.info), ICC_OK);
            if (k == 0)
                ck_assert_double_le(distance(p, own.info.maximum), own.info.spacing);
            ck_assert_double_eq(encode(&own, own.info.maximum).t, 1);
            icc_chart_free(own.chart);
        }
        subject_clear(&s);
    }
}
END_TEST

START_TEST(measures_are_shares)
{
    for (int k = 0; k < N_SHAPES * N_OPTIONS; ++k) {
        const shape outline = shape_number(k / N_OPTIONS);
        const icc_chart_options options = options_number(k % N_OPTIONS);
        subject s;
        if (subject_init(&s, &outline, &options)) {
            icc_chart_report m = {.size = sizeof m}, again = {.size = sizeof again};
            ck_assert_int_eq(icc_chart_get_report(s.chart, 500, &m, NULL, NULL), ICC_OK);
            ck_assert_int_eq(icc_chart_get_report(s.chart, 500, &again, NULL, NULL), ICC_OK);
            ck_assert_mem_eq(&m, &again, sizeof m);
            ck_assert_uint_eq(m.n_boundary, 500);
            ck_assert(m.n_points > 400 && m.n_points < 600);
            ck_assert(m.unreachable >= 0 && m.uncovered >= 0 && m.unreachable + m.uncovered <= 1);
            ck_assert(m.collapsed > 0 && m.collapsed <= 1);
            ck_assert(m.not_inward >= 0 && m.not_inward <= 1);
            if (k / N_OPTIONS == 0)
                ck_assert(m.unreachable == 0 && m.not_inward == 0 && m.uncovered == 0);
        }
        subject_clear(&s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("charts");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, points_come_back_where_lines_do_not_merge);
    tcase_add_test(tests, random_shapes_have_charts);
    tcase_add_test(tests, curves_rise_from_the_boundary_to_the_maximum);
    tcase_add_test(tests, boundary_points_have_t_zero);
    tcase_add_test(tests, the_maximum_has_t_one);
    tcase_add_test(tests, points_elsewhere_have_no_coordinates);
    tcase_add_test(tests, sizes_do_not_matter);
    tcase_add_test(tests, positions_do_not_matter);
    tcase_add_test(tests, the_caller_may_choose_the_maximum);
    tcase_add_test(tests, measures_are_shares);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
