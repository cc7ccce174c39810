/* Walks in any dimension, against what can be said without walking, and against walks in the plane. */
#include "trace/walk2.h"
#include "trace/walkn.h"

#include "../random.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VERTICES = 20000 };

/* A function on a small lattice, put together without the modules below the tracer. */
typedef struct world {
    icc_grid grid;
    icc_tree tree;
    icc_field field;
    double values[MAX_VERTICES];
} world;

static world W;

static void world_init(world *w, int32_t dim, const size_t *shape, uint32_t root)
{
    memset(w, 0, sizeof *w);
    w->grid.dim = dim;
    w->grid.spacing = 1;
    w->grid.n_vertices = 1;
    for (int32_t k = 0; k < dim; ++k) {
        w->grid.shape[k] = shape[k];
        w->grid.stride[k] = w->grid.n_vertices;
        w->grid.n_vertices *= shape[k];
    }
    ck_assert_uint_le(w->grid.n_vertices, MAX_VERTICES);
    w->tree.grid = &w->grid;
    w->tree.root = root;
    w->field.tree = &w->tree;
    w->field.values = w->values;
}

/* Sides of the lattices used here, by dimension. */
static const size_t SIDE[ICC_MAX_DIM + 1] = {0, 40, 14, 8, 6, 5, 4};

static void cube_init(world *w, int32_t dim, uint32_t root)
{
    size_t shape[ICC_MAX_DIM];
    for (int32_t k = 0; k < dim; ++k)
        shape[k] = SIDE[dim];
    world_init(w, dim, shape, root);
}

static double dot(int32_t dim, const double *a, const double *b)
{
    double sum = 0;
    for (int32_t k = 0; k < dim; ++k)
        sum += a[k] * b[k];
    return sum;
}

static void position(const world *w, uint32_t v, double *x)
{
    for (int32_t k = 0; k < w->grid.dim; ++k)
        x[k] = iccp_grid_coordinate(&w->grid, v, k);
}

static void set_linear(world *w, const double *slope)
{
    double x[ICC_MAX_DIM];
    for (uint32_t v = 0; v < w->grid.n_vertices; ++v) {
        position(w, v, x);
        w->values[v] = dot(w->grid.dim, slope, x);
    }
}

/* f at a point, by linear interpolation in its simplex. */
static double interpolate(const world *w, const double *x)
{
    iccp_kuhn_simplex s;
    double lambda[ICC_MAX_DIM + 1], f = 0;
    ck_assert(iccp_kuhn_simplex_at(&s, &w->grid, x, lambda));
    for (int32_t i = 0; i <= w->grid.dim; ++i)
        f += lambda[i] * w->values[s.corner[i]];
    return f;
}

/* How far it is from a point to the border of the lattice along a direction. */
static double way_out(const world *w, const double *p, const double *d)
{
    double share = HUGE_VAL;
    for (int32_t k = 0; k < w->grid.dim; ++k)
        if (fabs(d[k]) > 0)
            share = fmin(share, ((d[k] > 0 ? (double)(w->grid.shape[k] - 1) : 0) - p[k]) / d[k]);
    return share * sqrt(dot(w->grid.dim, d, d));
}

static bool on_border(const world *w, const double *p)
{
    for (int32_t k = 0; k < w->grid.dim; ++k)
        if (p[k] <= 0 || p[k] >= (double)(w->grid.shape[k] - 1))
            return true;
    return false;
}

/* Starts of every kind: anywhere, and on faces of every dimension. */
static void pick_start(const world *w, random_source *r, double *p)
{
    const int32_t dim = w->grid.dim;
    const int kind = random_below(r, 3);
    for (int32_t k = 0; k < dim; ++k) {
        const int inner = (int)w->grid.shape[k] - 3;
        p[k] = 1 + random_below(r, inner) + (kind == 0 ? random_unit(r) : random_below(r, 8) / 8.0);
    }
    for (int32_t k = 0; k < dim && kind == 2; ++k) {
        const int from = random_below(r, 3 * dim);
        if (from < dim)
            p[k] = floor(p[k]) + p[from] - floor(p[from]);
        else if (from < 2 * dim)
            p[k] = floor(p[k]);
    }
}

static double off_line(int32_t dim, const double *p, const double *from, const double *along)
{
    double offset[ICC_MAX_DIM];
    for (int32_t k = 0; k < dim; ++k)
        offset[k] = p[k] - from[k];
    const double share = dot(dim, offset, along) / dot(dim, along, along);
    for (int32_t k = 0; k < dim; ++k)
        offset[k] -= share * along[k];
    return sqrt(dot(dim, offset, offset));
}

START_TEST(a_linear_function_gives_straight_lines)
{
    random_source r = {1};
    for (int round = 0; round < 10000; ++round) {
        const int32_t dim = 1 + round % ICC_MAX_DIM;
        double d[ICC_MAX_DIM], ahead[ICC_MAX_DIM], p[ICC_MAX_DIM];
        cube_init(&W, dim, 0);
        for (int32_t k = 0; k < dim; ++k)
            d[k] = round / 6 % 2 ? random_below(&r, 7) - 3 : random_between(&r, -1, 1);
        if (dot(dim, d, d) <= 0)
            continue;
        set_linear(&W, d);
        pick_start(&W, &r, p);
        const int direction = random_below(&r, 2) ? ICCP_UPHILL : ICCP_DOWNHILL;
        for (int32_t k = 0; k < dim; ++k)
            ahead[k] = direction * d[k];
        iccp_walkn walk;
        ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, direction, p, round % 2 ? ahead : NULL),
                         ICC_OK);
        icc_status status = ICC_OK;
        double at[ICC_MAX_DIM];
        memcpy(at, p, sizeof at);
        for (int n = 0; status == ICC_OK && !on_border(&W, at); ++n) {
            status = iccp_walkn_step(&walk);
            if (memcmp(walk.from, at, (size_t)dim * sizeof *at) != 0)
                ck_abort_msg("a step does not begin where the last one ended");
            memcpy(at, walk.to, sizeof at);
            if (!(off_line(dim, at, p, ahead) <= 1e-12) || n > 200)
                ck_abort_msg("%d-D: %g off the straight line after %d steps", (int)dim,
                             off_line(dim, at, p, ahead), n);
        }
        ck_assert(on_border(&W, at));
        ck_assert_double_eq_tol(walk.s, way_out(&W, p, ahead), 1e-12);
    }
}
END_TEST

/* Values on a lattice whose sides are one vertex longer all round may be anything. */
static void set_random(world *w, random_source *r)
{
    for (size_t v = 0; v < w->grid.n_vertices; ++v)
        w->values[v] = random_unit(r);
}

/* The same points one after the other, and the same end, on random functions. */
START_TEST(in_the_plane_walks_are_those_of_walk2)
{
    random_source r = {2};
    size_t n_steps = 0, n_ends = 0;
    for (int round = 0; round < 500; ++round) {
        cube_init(&W, 2, 0);
        set_random(&W, &r);
        for (int k = 0; k < 100; ++k) {
            const double p[2] = {random_between(&r, 0, 13), random_between(&r, 0, 13)};
            const int direction = k % 2 ? ICCP_UPHILL : ICCP_DOWNHILL;
            iccp_walk2 flat;
            iccp_walkn walk;
            ck_assert_int_eq(iccp_walk2_start(&flat, &W.field, direction, p[0], p[1], NULL), ICC_OK);
            ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, direction, p, NULL), ICC_OK);
            icc_status status = ICC_OK;
            while (status == ICC_OK) {
                status = iccp_walk2_step(&flat);
                const icc_status other = iccp_walkn_step(&walk);
                if (other != status || fabs(walk.to[0] - flat.to[0]) > 1e-11 ||
                    fabs(walk.to[1] - flat.to[1]) > 1e-11 || fabs(walk.s - flat.s) > 1e-10 ||
                    (status == ICC_OK && walk.merged != flat.merged))
                    ck_abort_msg("(%.17g, %.17g), not (%.17g, %.17g); status %d, not %d", walk.to[0],
                                 walk.to[1], flat.to[0], flat.to[1], (int)other, (int)status);
                ++n_steps;
            }
            ++n_ends;
        }
    }
    ck_assert_uint_gt(n_steps, 3 * n_ends);
}
END_TEST

/* A direction of length 1, and whether a point moved a little that way stays on the lattice. */
static bool pick_direction(const world *w, random_source *r, const double *p, double step, double *d,
                           double *moved)
{
    double length = 0;
    bool inside = true;
    for (int32_t k = 0; k < w->grid.dim; ++k) {
        d[k] = random_below(r, 3) == 0 ? random_below(r, 3) - 1 : random_between(r, -1, 1);
        length += d[k] * d[k];
    }
    for (int32_t k = 0; k < w->grid.dim; ++k) {
        moved[k] = p[k] + step * d[k] / sqrt(length);
        inside = inside && moved[k] >= 0 && moved[k] <= (double)(w->grid.shape[k] - 1);
    }
    return length > 0 && inside;
}

/* No direction is steeper than the one that a step takes. */
static void check_steepest(const world *w, random_source *r, const iccp_walkn *before, double slope)
{
    static const double STEP = 1e-6;
    const double *p = before->to, f = interpolate(w, p);
    double d[ICC_MAX_DIM], q[ICC_MAX_DIM];
    for (int k = 0; k < 20; ++k)
        if (pick_direction(w, r, p, STEP, d, q)) {
            const double other = before->slope.direction * (interpolate(w, q) - f) / STEP;
            if (!(other <= slope + 1e-7))
                ck_abort_msg("%d-D, corners %x: %.12g is steeper than %.12g", (int)w->grid.dim,
                             before->place.face, other, slope);
        }
}

static bool is_vertex(const iccp_walkn *w)
{
    return (w->place.face & (w->place.face - 1)) == 0;
}

/* Whether a vertex is higher than all that share a simplex with it. */
static bool is_peak(const world *w, const double *x, int direction)
{
    for (unsigned set = 1; set < 1u << w->grid.dim; ++set)
        for (int sign = -1; sign <= 1; sign += 2) {
            double q[ICC_MAX_DIM];
            bool inside = true;
            for (int32_t k = 0; k < w->grid.dim; ++k) {
                q[k] = x[k] + sign * (int)(set >> k & 1);
                inside = inside && q[k] >= 0 && q[k] <= (double)(w->grid.shape[k] - 1);
            }
            if (inside && direction * (interpolate(w, q) - interpolate(w, x)) > 0)
                return false;
        }
    return true;
}

START_TEST(walks_rise_the_steepest_way)
{
    random_source r = {3};
    int n_slides = 0, n_crossings = 0, n_peaks = 0;
    for (int round = 0; round < 1500; ++round) {
        const int32_t dim = 1 + round % 5;
        cube_init(&W, dim, UINT32_MAX);
        set_random(&W, &r);
        for (int k = 0; k < 10; ++k) {
            double p[ICC_MAX_DIM];
            pick_start(&W, &r, p);
            iccp_walkn walk;
            const int direction = k % 2 ? ICCP_UPHILL : ICCP_DOWNHILL;
            ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, direction, p, NULL), ICC_OK);
            for (double before = interpolate(&W, p), s = 0;;) {
                const iccp_walkn last = walk;
                const icc_status status = iccp_walkn_step(&walk);
                const double after = interpolate(&W, walk.to);
                const double rise = direction * (after - before), length = walk.s - s;
                if (length > 1e-6)
                    check_steepest(&W, &r, &last, rise / length);
                if (!(rise >= -1e-14))
                    ck_abort_msg("falls by %g", -rise);
                n_slides += !walk.ahead;
                n_crossings += walk.ahead;
                before = after;
                s = walk.s;
                if (status == ICC_OK)
                    continue;
                ck_assert(on_border(&W, walk.to) ||
                          (is_vertex(&walk) && is_peak(&W, walk.to, direction)));
                n_peaks += is_vertex(&walk) && is_peak(&W, walk.to, direction);
                break;
            }
        }
    }
    ck_assert(n_slides > 5000 && n_crossings > 5000 && n_peaks > 2000);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("walkn");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, a_linear_function_gives_straight_lines);
    tcase_add_test(tests, in_the_plane_walks_are_those_of_walk2);
    tcase_add_test(tests, walks_rise_the_steepest_way);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
