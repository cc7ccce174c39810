/* Walks in any dimension, against what can be said without walking, and against walks in the
 * plane. */
#include "gradient/grid/rasterise.h"
#include "gradient/trace/walk2.h"
#include "gradient/trace/walkn.h"

#include "../../../random.h"
#include "../../../share.h"
#include "../../../suite.h"
#include "../../../surfaces.h"

#include <check.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VERTICES = 20000 };

/* A function on a small lattice, put together without the modules below the tracer. */
typedef struct world {
    icc_grid grid;
    icc_tree tree;
    icc_function field;
    double values[MAX_VERTICES];
} world;

static world W;

static void world_init(world *w, int32_t dim, const size_t *shape, uint32_t root)
{
    memset(w, 0, offsetof(world, values));
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
    if (!iccp_kuhn_simplex_at(&s, &w->grid, x, lambda))
        ck_abort_msg("beyond the lattice");
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
    for (int round = 0; round < share_of(10000); ++round) {
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
        ck_assert_int_eq(
            iccp_walkn_start(&walk, &W.field, direction, p, round % 2 ? ahead : NULL, NULL),
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
    for (int round = 0; round < share_of(500); ++round) {
        cube_init(&W, 2, 0);
        set_random(&W, &r);
        for (int k = 0; k < 100; ++k) {
            const double p[2] = {random_between(&r, 0, 13), random_between(&r, 0, 13)};
            const int direction = k % 2 ? ICCP_UPHILL : ICCP_DOWNHILL;
            iccp_walk2 flat;
            iccp_walkn walk;
            ck_assert_int_eq(iccp_walk2_start(&flat, &W.field, direction, p[0], p[1], NULL),
                             ICC_OK);
            ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, direction, p, NULL, NULL), ICC_OK);
            icc_status status = ICC_OK;
            while (status == ICC_OK) {
                status = iccp_walk2_step(&flat);
                const icc_status other = iccp_walkn_step(&walk);
                if (other != status || fabs(walk.to[0] - flat.to[0]) > 1e-11 ||
                    fabs(walk.to[1] - flat.to[1]) > 1e-11 || fabs(walk.s - flat.s) > 1e-10 ||
                    (status == ICC_OK && walk.merged != flat.merged))
                    ck_abort_msg("(%.17g, %.17g), not (%.17g, %.17g); status %d, not %d",
                                 walk.to[0], walk.to[1], flat.to[0], flat.to[1], (int)other,
                                 (int)status);
                ++n_steps;
            }
            ++n_ends;
        }
    }
    ck_assert_uint_gt(n_steps, 3 * n_ends);
}
END_TEST

/* A direction of length 1, and whether a point moved a little that way stays on the lattice. */
static bool pick_direction(const world *w, random_source *r, const double *p, double step,
                           double *d, double *moved)
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
    for (int round = 0; round < share_of(1500); ++round) {
        const int32_t dim = 1 + round % 5;
        cube_init(&W, dim, UINT32_MAX);
        set_random(&W, &r);
        for (int k = 0; k < 10; ++k) {
            double p[ICC_MAX_DIM];
            pick_start(&W, &r, p);
            iccp_walkn walk;
            const int direction = k % 2 ? ICCP_UPHILL : ICCP_DOWNHILL;
            ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, direction, p, NULL, NULL), ICC_OK);
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
    ck_assert(n_slides > share_of(5000) && n_crossings > share_of(5000) &&
              n_peaks > share_of(2000));
}
END_TEST

/* Growing from the root: each vertex is lower than one that shares a simplex with it. With
 * `levels`, or as low. The border is lowest. */
static void set_one_maximum(world *w, random_source *r, bool levels)
{
    const size_t n = w->grid.n_vertices;
    static uint32_t queue[MAX_VERTICES];
    size_t n_queue = 0;
    double x[ICC_MAX_DIM], next = 1000;
    uint32_t root = 0;
    for (int32_t k = 0; k < w->grid.dim; ++k)
        root += (uint32_t)w->grid.stride[k] *
                (1 + (uint32_t)random_below(r, (int)w->grid.shape[k] - 2));
    w->tree.root = root;
    for (size_t v = 0; v < n; ++v)
        w->values[v] = NAN;
    queue[n_queue++] = root;
    w->values[root] = next;
    while (n_queue > 0) {
        const size_t i = (size_t)random_below(r, (int)n_queue);
        const uint32_t v = queue[i];
        bool done = true;
        for (unsigned set = 1; set < 2u << w->grid.dim && done; ++set) {
            const int sign = set & 1 ? 1 : -1;
            uint32_t u = v;
            position(w, v, x);
            bool inner = true;
            for (int32_t k = 0; k < w->grid.dim; ++k)
                if (set >> (k + 1) & 1) {
                    u += (uint32_t)sign * (uint32_t)w->grid.stride[k];
                    inner =
                        inner && x[k] + sign > 0 && x[k] + sign < (double)(w->grid.shape[k] - 1);
                }
            if (!inner || !isnan(w->values[u]))
                continue;
            next -= levels ? random_below(r, 2) : random_unit(r);
            w->values[u] = next;
            queue[n_queue++] = u;
            done = random_below(r, 3) == 0;
        }
        if (done)
            queue[i] = queue[--n_queue];
    }
    for (size_t v = 0; v < n; ++v)
        if (isnan(w->values[v]))
            w->values[v] = next - 2;
}

START_TEST(every_ascent_ends_at_the_only_maximum)
{
    random_source r = {4};
    for (int round = 0; round < share_of(1200); ++round) {
        const bool levels = round / 6 % 2;
        const int32_t dim = 1 + round % ICC_MAX_DIM;
        cube_init(&W, dim, 0);
        set_one_maximum(&W, &r, levels);
        for (int k = 0; k < 20; ++k) {
            double p[ICC_MAX_DIM];
            pick_start(&W, &r, p);
            iccp_walkn walk;
            ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, p, NULL, NULL), ICC_OK);
            const size_t budget = walk.steps_left;
            const icc_status status = iccp_walkn_uphill(&walk, NULL);
            /* Of several vertices as high as their neighbours, one may be a maximum by its
             * index. */
            ck_assert(levels || status == ICC_OK);
            ck_assert_uint_lt(budget - walk.steps_left, 20 * W.grid.n_vertices);
        }
    }
}
END_TEST

/* Few different values: many faces are level, many simplices as steep as each other. */
START_TEST(level_functions_end)
{
    random_source r = {5};
    for (int round = 0; round < share_of(1500); ++round) {
        const int32_t dim = 1 + round % ICC_MAX_DIM;
        const int n_values = 1 + round / 6 % 4;
        cube_init(&W, dim, UINT32_MAX);
        for (size_t v = 0; v < W.grid.n_vertices; ++v)
            W.values[v] = random_below(&r, n_values);
        for (int k = 0; k < 20; ++k) {
            double p[ICC_MAX_DIM], before;
            pick_start(&W, &r, p);
            const int direction = k % 2 ? ICCP_UPHILL : ICCP_DOWNHILL;
            iccp_walkn walk;
            ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, direction, p, NULL, NULL), ICC_OK);
            int n = 0;
            for (before = interpolate(&W, p); iccp_walkn_step(&walk) == ICC_OK; ++n) {
                const double after = interpolate(&W, walk.to);
                if (!(direction * (after - before) >= -1e-12))
                    ck_abort_msg("falls by %g", direction * (before - after));
                before = after;
            }
            ck_assert_int_lt(n, 40 * (int)SIDE[dim]);
            ck_assert(on_border(&W, walk.to) ||
                      (is_vertex(&walk) && is_peak(&W, walk.to, direction)));
        }
    }
}
END_TEST

/* f = slope x_last - the sum of |x_k - 2| over the others. Lines get to the planes x_k = 2 one by
 * one, and go on in them. */
START_TEST(lines_merge_in_lower_and_lower_faces)
{
    random_source r = {6};
    for (int round = 0; round < share_of(3000); ++round) {
        const int32_t dim = 2 + round % 5;
        const size_t shape[ICC_MAX_DIM] = {5, 5, 5, 5, 5, 5};
        size_t sides[ICC_MAX_DIM];
        double p[ICC_MAX_DIM], off[ICC_MAX_DIM], x[ICC_MAX_DIM];
        for (int32_t k = 0; k < dim; ++k)
            sides[k] = k == dim - 1 ? 5 : shape[k];
        world_init(&W, dim, sides, 0);
        const double slope = random_between(&r, 0.01, 0.3);
        for (uint32_t v = 0; v < W.grid.n_vertices; ++v) {
            position(&W, v, x);
            W.values[v] = slope * x[dim - 1];
            for (int32_t k = 0; k < dim - 1; ++k)
                W.values[v] -= fabs(x[k] - 2);
        }
        for (int32_t k = 0; k < dim - 1; ++k) {
            W.tree.root += 2 * (uint32_t)W.grid.stride[k];
            p[k] = random_between(&r, 0.5, 3.5);
            const double distance = fabs(p[k] - 2);
            int32_t i = k;
            for (; i > 0 && off[i - 1] > distance; --i)
                off[i] = off[i - 1];
            off[i] = distance;
        }
        W.tree.root += 4 * (uint32_t)W.grid.stride[dim - 1];
        p[dim - 1] = random_between(&r, 0.5, 2);
        double length = 0, at = 0, merge = 0;
        for (int32_t k = 0; k < dim - 1; ++k) {
            length += (off[k] - at) * sqrt(dim - 1 - k + slope * slope);
            at = off[k];
            merge = k == 0 ? length : merge;
        }
        length += 4 - (p[dim - 1] + slope * at);
        iccp_walkn walk;
        ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, p, NULL, NULL), ICC_OK);
        ck_assert_int_eq(iccp_walkn_uphill(&walk, NULL), ICC_OK);
        ck_assert_double_eq_tol(walk.s, length, 1e-11);
        ck_assert_double_eq_tol(walk.alone, merge, 1e-11);
        ck_assert(walk.merged);
    }
}
END_TEST

/* f = |x_k - 2|: where two slopes part, the walk goes to the side that is asked for. */
START_TEST(starts_go_ahead)
{
    random_source r = {7};
    for (int round = 0; round < share_of(2000); ++round) {
        const int32_t dim = 1 + round % ICC_MAX_DIM, axis = random_below(&r, dim);
        const size_t shape[ICC_MAX_DIM] = {5, 5, 5, 5, 5, 5};
        double p[ICC_MAX_DIM], x[ICC_MAX_DIM], ahead[ICC_MAX_DIM];
        world_init(&W, dim, shape, UINT32_MAX);
        for (uint32_t v = 0; v < W.grid.n_vertices; ++v) {
            position(&W, v, x);
            W.values[v] = fabs(x[axis] - 2);
        }
        for (int32_t k = 0; k < dim; ++k) {
            p[k] = random_between(&r, 0.5, 3.5);
            ahead[k] = random_between(&r, -1, 1);
        }
        p[axis] = 2;
        iccp_walkn walk;
        ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, p, ahead, NULL), ICC_OK);
        const double end = ahead[axis] > 0 ? 4 : 0;
        while (fabs(walk.to[axis] - end) > 0) {
            const icc_status status = iccp_walkn_step(&walk);
            if (!(ahead[axis] * (walk.to[axis] - 2) > 0) ||
                (status != ICC_OK && fabs(walk.to[axis] - end) > 0))
                ck_abort_msg("strays to %g", walk.to[axis]);
        }
        ck_assert_double_eq_tol(walk.s, 2, 1e-14);
        ck_assert_int_eq(iccp_walkn_slope_sign(&W.field, p, ahead), 1);
    }
}
END_TEST

/* Whether two walks go the same way, to the bit. */
static void check_same(const icc_function *a, const icc_function *b, const double *p, int direction)
{
    iccp_walkn one, other;
    ck_assert_int_eq(iccp_walkn_start(&one, a, direction, p, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_walkn_start(&other, b, direction, p, NULL, NULL), ICC_OK);
    for (icc_status status = ICC_OK; status == ICC_OK;) {
        status = iccp_walkn_step(&one);
        if (iccp_walkn_step(&other) != status || memcmp(one.to, other.to, sizeof one.to) != 0)
            ck_abort_msg("walks part");
    }
}

START_TEST(only_ratios_of_values_count)
{
    static double tiny[MAX_VERTICES], fractions[MAX_VERTICES];
    static int32_t exponents[MAX_VERTICES];
    random_source r = {8};
    for (int round = 0; round < share_of(300); ++round) {
        const int32_t dim = 1 + round % 5;
        cube_init(&W, dim, UINT32_MAX);
        set_random(&W, &r);
        for (size_t v = 0; v < W.grid.n_vertices; ++v) {
            /* Steep falls beside gentle rises, too. */
            W.values[v] = ldexp(W.values[v], -random_below(&r, 30));
            tiny[v] = ldexp(W.values[v], -850);
            fractions[v] = frexp(W.values[v], &exponents[v]);
            exponents[v] -= 5000;
        }
        icc_function small = W.field, scaled = W.field;
        small.values = tiny;
        scaled.values = fractions;
        scaled.exponent = exponents;
        for (int k = 0; k < 20; ++k) {
            double p[ICC_MAX_DIM];
            pick_start(&W, &r, p);
            const int direction = k % 2 ? ICCP_UPHILL : ICCP_DOWNHILL;
            check_same(&W.field, &small, p, direction);
            check_same(&W.field, &scaled, p, direction);
        }
    }
}
END_TEST

START_TEST(starts_without_values_are_refused)
{
    const double places[][3] = {{-1e-9, 1, 1}, {1, 1, 7.001}, {NAN, 1, 1}, {1, HUGE_VAL, 1}};
    const double vertex[3] = {3, 3, 3}, edge[3] = {3.5, 3, 3}, inner[3] = {3.1, 3.2, 3.3};
    const double other[3] = {3.3, 3.2, 3.1}, forward[3] = {1, 1, 1}, back[3] = {-1, -1, -1};
    iccp_walkn walk;
    cube_init(&W, 3, 0);
    set_linear(&W, forward);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; ++i)
        ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, places[i], NULL, NULL),
                         ICC_ERR_TRACE);
    W.values[3 + 8 * 3 + 64 * 4] = NAN; /* (3, 3, 4) */
    ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, vertex, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, edge, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, inner, NULL, NULL),
                     ICC_ERR_TRACE);
    ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, other, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_walkn_slope_sign(&W.field, inner, forward), 0);
    ck_assert_int_eq(iccp_walkn_slope_sign(&W.field, other, forward), 1);
    ck_assert_int_eq(iccp_walkn_slope_sign(&W.field, other, back), -1);
    W.values[3 + 8 * 3 + 64 * 3] = NAN;
    ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, vertex, NULL, NULL),
                     ICC_ERR_TRACE);
}
END_TEST

START_TEST(lines_that_leave_what_has_values_end)
{
    const double up[3] = {1, 0.5, 0.25};
    random_source r = {9};
    cube_init(&W, 3, UINT32_MAX);
    set_linear(&W, up);
    for (uint32_t v = 0; v < W.grid.n_vertices; ++v)
        if (iccp_grid_coordinate(&W.grid, v, 0) > 4)
            W.values[v] = NAN;
    for (int k = 0; k < 200; ++k) {
        double p[3];
        for (int i = 0; i < 3; ++i)
            p[i] = random_between(&r, 0, 3);
        iccp_walkn walk;
        ck_assert_int_eq(iccp_walkn_start(&walk, &W.field, ICCP_UPHILL, p, NULL, NULL), ICC_OK);
        ck_assert_int_eq(iccp_walkn_uphill(&walk, NULL), ICC_ERR_TRACE);
        ck_assert_double_eq(walk.to[0], 4);
    }
}
END_TEST

START_TEST(crossing_a_facet_twice_comes_back)
{
    random_source r = {12};
    int n_border = 0;
    for (int round = 0; round < share_of(6000); ++round) {
        const int32_t dim = 1 + round % ICC_MAX_DIM, i = random_below(&r, dim + 1);
        double x[ICC_MAX_DIM], back[ICC_MAX_DIM], lambda[ICC_MAX_DIM + 1];
        iccp_kuhn_simplex s, other;
        int32_t fresh, again;
        cube_init(&W, dim, 0);
        for (int32_t k = 0; k < dim; ++k)
            x[k] = random_between(&r, 0, (double)SIDE[dim] - 1);
        ck_assert(iccp_kuhn_simplex_at(&s, &W.grid, x, lambda));
        iccp_kuhn_simplex_point(&s, &W.grid, lambda, back);
        for (int32_t k = 0; k < dim; ++k)
            ck_assert_double_eq_tol(back[k], x[k], 1e-14 * (double)SIDE[dim]);
        other = s;
        if (!iccp_kuhn_simplex_cross(&other, &W.grid, i, &fresh)) {
            ck_assert_mem_eq(&other, &s, sizeof s);
            ++n_border;
            continue;
        }
        /* The corners that stay keep their order. */
        for (int32_t k = 0, m = 0; k <= dim; ++k)
            if (k != fresh) {
                m += m == i;
                ck_assert_uint_eq(other.corner[k], s.corner[m++]);
            }
        ck_assert_uint_ne(other.corner[fresh], s.corner[i]);
        ck_assert(iccp_kuhn_simplex_cross(&other, &W.grid, fresh, &again));
        ck_assert_int_eq(again, i);
        ck_assert_mem_eq(other.corner, s.corner, sizeof *s.corner * (size_t)(dim + 1));
        ck_assert_mem_eq(other.axis, s.axis, sizeof *s.axis * (size_t)dim);
    }
    ck_assert_int_gt(n_border, share_of(100));
}
END_TEST

/* ---- the boundary ---- */

/* A rough ball, or a block of cells of a mask. */
static icc_domain *pick_domain(random_source *r, int32_t dim)
{
    static surface s;
    const size_t shape[ICC_MAX_DIM] = {2, 1, 2, 1, 1, 1};
    static const uint8_t full[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    icc_domain *domain = NULL;
    if (dim == 3) {
        surface_star(&s, 1 + random_below(r, 3), 0.3, r);
        ck_assert_int_eq(
            icc_domain_create(&domain, 3, s.n_vertices, s.vertices, s.n_faces, s.faces, NULL, NULL),
            ICC_OK);
    } else {
        ck_assert_int_eq(icc_domain_create_mask(&domain, dim, shape, full, NULL, NULL), ICC_OK);
    }
    return domain;
}

static uint32_t cell_of(const icc_grid *grid, const double *x)
{
    size_t cell = 0;
    for (int32_t k = 0; k < grid->dim; ++k)
        cell += (size_t)x[k] * grid->stride[k];
    return (uint32_t)cell;
}

static bool is_marked(const iccp_boundary_cellsn *cells, uint32_t cell)
{
    return cells->bits[cell / 64] >> (cell % 64) & 1;
}

/* A point of the boundary, in lattice coordinates. */
static void pick_on_boundary(const icc_domain *domain, const icc_grid *grid, random_source *r,
                             double *x)
{
    double bary[ICC_MAX_DIM], rest = 1, p[ICC_MAX_DIM];
    for (int32_t k = 0; k < domain->dim; ++k) {
        bary[k] = k + 1 < domain->dim ? rest * random_unit(r) : rest;
        rest -= bary[k];
    }
    iccp_domain_facet_point(domain, (uint32_t)random_below(r, (int)domain->n_facets), bary, p);
    for (int32_t k = 0; k < domain->dim; ++k)
        x[k] = (p[k] - grid->origin[k]) / grid->spacing;
}

static double from_boundary(const icc_domain *domain, const icc_grid *grid, const double *x)
{
    double p[ICC_MAX_DIM], q[ICC_MAX_DIM], bary[ICC_MAX_DIM], square = 0;
    uint32_t facet;
    for (int32_t k = 0; k < domain->dim; ++k)
        p[k] = x[k] * grid->spacing + grid->origin[k];
    (void)iccp_domain_locate(domain, p, false, &facet, bary);
    iccp_domain_facet_point(domain, facet, bary, q);
    for (int32_t k = 0; k < domain->dim; ++k)
        square += (p[k] - q[k]) * (p[k] - q[k]);
    return sqrt(square) / grid->spacing;
}

START_TEST(cells_of_the_cage_are_those_at_the_boundary)
{
    random_source r = {10};
    for (int round = 0; round < 24; ++round) {
        const int32_t dim = round % 2 ? 3 : 4;
        const iccp_env env = {.memory = iccp_memory_default};
        icc_domain *domain = pick_domain(&r, dim);
        icc_grid *grid;
        iccp_boundary_cellsn cells;
        ck_assert_int_eq(
            iccp_grid_create(&grid, domain, 2 + random_below(&r, dim == 3 ? 30 : 8), &env, NULL),
            ICC_OK);
        ck_assert_int_eq(iccp_boundary_cellsn_create(&cells, domain, grid, &env), ICC_OK);
        for (int k = 0; k < 2000; ++k) {
            double x[ICC_MAX_DIM];
            pick_on_boundary(domain, grid, &r, x);
            for (int32_t m = 0; m < dim; ++m)
                x[m] += (random_below(&r, 3) - 1) * 1e-12;
            if (!is_marked(&cells, cell_of(grid, x)))
                ck_abort_msg("a cell is not marked");
        }
        size_t n_marked = 0;
        for (uint32_t v = 0; v < grid->n_vertices; ++v)
            if (is_marked(&cells, v)) {
                double middle[ICC_MAX_DIM];
                for (int32_t m = 0; m < dim; ++m)
                    middle[m] = iccp_grid_coordinate(grid, v, m) + 0.5;
                ck_assert_double_le(from_boundary(domain, grid, middle), 1.5 * sqrt(dim));
                ++n_marked;
            }
        ck_assert(n_marked > 0);
        iccp_boundary_cellsn_free(&cells);
        icc_grid_free(grid);
        icc_domain_free(domain);
    }
}
END_TEST

START_TEST(no_step_slips_through_the_cage)
{
    random_source r = {11};
    size_t n_hits = 0;
    for (int round = 0; round < 20; ++round) {
        const int32_t dim = round % 2 ? 3 : 4;
        const iccp_env env = {.memory = iccp_memory_default};
        icc_domain *domain = pick_domain(&r, dim);
        icc_grid *grid;
        iccp_boundary_cellsn cells;
        ck_assert_int_eq(iccp_grid_create(&grid, domain, 9, &env, NULL), ICC_OK);
        ck_assert_int_eq(iccp_boundary_cellsn_create(&cells, domain, grid, &env), ICC_OK);
        for (int k = 0; k < 2000; ++k) {
            double x[2][ICC_MAX_DIM], local[2][ICC_MAX_DIM], share, bary[ICC_MAX_DIM];
            uint32_t facet, cell = 0;
            for (int32_t m = 0; m < dim; ++m) {
                const int at = random_below(&r, (int)grid->shape[m] - 1);
                cell += (uint32_t)at * (uint32_t)grid->stride[m];
                for (int i = 0; i < 2; ++i) {
                    x[i][m] = at + (random_below(&r, 4) ? random_unit(&r) : random_below(&r, 2));
                    local[i][m] = x[i][m] * grid->spacing + grid->origin[m];
                }
            }
            iccp_boundary_hitn hit;
            const bool found = iccp_boundary_cellsn_cross(&cells, cell, x[0], x[1], &hit);
            ck_assert_int_eq(found,
                             iccp_domain_cross(domain, local[0], local[1], &share, &facet, bary));
            n_hits += found;
            if (!found)
                continue;
            ck_assert(hit.facet == facet && hit.share >= share && hit.share <= share);
            ck_assert_double_le(from_boundary(domain, grid, hit.point), 1e-12);
            ck_assert(iccp_boundary_cellsn_touch(&cells, hit.point, &hit));
            ck_assert(!iccp_boundary_cellsn_touch(&cells, (double[ICC_MAX_DIM]){0.5}, &hit));
        }
        iccp_boundary_cellsn_free(&cells);
        icc_grid_free(grid);
        icc_domain_free(domain);
    }
    ck_assert_uint_gt(n_hits, 2000);
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
    tcase_add_test(tests, every_ascent_ends_at_the_only_maximum);
    tcase_add_test(tests, level_functions_end);
    tcase_add_test(tests, lines_merge_in_lower_and_lower_faces);
    tcase_add_test(tests, starts_go_ahead);
    tcase_add_test(tests, only_ratios_of_values_count);
    tcase_add_test(tests, starts_without_values_are_refused);
    tcase_add_test(tests, lines_that_leave_what_has_values_end);
    tcase_add_test(tests, crossing_a_facet_twice_comes_back);
    tcase_add_test(tests, cells_of_the_cage_are_those_at_the_boundary);
    tcase_add_test(tests, no_step_slips_through_the_cage);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
