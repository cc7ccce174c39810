/* Walks over hand-made functions, and the boundary, against what can be said without walking. */
#include "gradient/trace/walk2.h"

#include "../../../random.h"
#include "../../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 14, MAX_VERTICES = SIDE * SIDE };

/* A function on a small lattice, put together without the modules below the tracer. */
typedef struct world {
    icc_grid grid;
    icc_tree tree;
    icc_function field;
    double values[MAX_VERTICES];
} world;

static void world_init(world *w, size_t nx, size_t ny, uint32_t root)
{
    memset(w, 0, sizeof *w);
    w->grid.dim = 2;
    w->grid.shape[0] = nx;
    w->grid.shape[1] = ny;
    w->grid.spacing = 1;
    w->grid.n_vertices = nx * ny;
    w->tree.grid = &w->grid;
    w->tree.root = root;
    w->field.tree = &w->tree;
    w->field.values = w->values;
}

static double *value(world *w, size_t i, size_t j)
{
    return w->values + i + w->grid.shape[0] * j;
}

static void set_linear(world *w, double a, double b)
{
    for (size_t j = 0; j < w->grid.shape[1]; ++j)
        for (size_t i = 0; i < w->grid.shape[0]; ++i)
            *value(w, i, j) = a * (double)i + b * (double)j;
}

/* f at a point, by linear interpolation in its triangle. */
static double interpolate(world *w, double x, double y)
{
    const double last_i = (double)(w->grid.shape[0] - 2), last_j = (double)(w->grid.shape[1] - 2);
    const double i = fmin(floor(x), last_i), j = fmin(floor(y), last_j);
    const double *f = value(w, (size_t)i, (size_t)j);
    const double u = x - i, v = y - j;
    const size_t up = w->grid.shape[0];
    return v > u ? f[0] + u * (f[up + 1] - f[up]) + v * (f[up] - f[0])
                 : f[0] + u * (f[1] - f[0]) + v * (f[up + 1] - f[1]);
}

/* How far it is from a point to the border of the lattice along a direction. */
static double way_out(const world *w, const double p[2], const double d[2])
{
    double share = HUGE_VAL;
    for (int k = 0; k < 2; ++k) {
        const double end = d[k] > 0 ? (double)(w->grid.shape[k] - 1) : 0;
        if (fabs(d[k]) > 0)
            share = fmin(share, (end - p[k]) / d[k]);
    }
    return share * hypot(d[0], d[1]);
}

static bool on_border(const world *w, const double p[2])
{
    return p[0] <= 0 || p[1] <= 0 || p[0] >= (double)(w->grid.shape[0] - 1) ||
           p[1] >= (double)(w->grid.shape[1] - 1);
}

/* Starts of every kind: inside triangles, on each kind of edge, on vertices. */
static void pick_start(random_source *r, double p[2])
{
    for (int k = 0; k < 2; ++k)
        p[k] = 1 + random_below(r, SIDE - 3) + random_below(r, 8) / 8.0;
    const int kind = random_below(r, 4);
    if (kind == 0)
        p[0] += 0.1 * random_unit(r);
    if (kind == 1)
        p[1] = floor(p[1]) + p[0] - floor(p[0]);
    if (kind == 2)
        p[random_below(r, 2)] = 1 + random_below(r, SIDE - 3);
}

START_TEST(a_linear_function_gives_straight_lines)
{
    random_source r = {1};
    world w;
    world_init(&w, SIDE, SIDE, 0);
    for (int round = 0; round < 5000; ++round) {
        double d[2], p[2];
        for (int k = 0; k < 2; ++k)
            d[k] = round % 2 ? random_below(&r, 7) - 3 : random_between(&r, -1, 1);
        if (d[0] == 0 && d[1] == 0)
            continue;
        set_linear(&w, d[0], d[1]);
        pick_start(&r, p);
        const int direction = random_below(&r, 2) ? ICCP_UPHILL : ICCP_DOWNHILL;
        const double ahead[2] = {direction * d[0], direction * d[1]};
        iccp_walk2 walk;
        ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, direction, p[0], p[1], NULL), ICC_OK);
        icc_status status = ICC_OK;
        int n_steps = 0;
        double at[2] = {p[0], p[1]};
        while (status == ICC_OK && !on_border(&w, at)) {
            status = iccp_walk2_step(&walk);
            if (memcmp(walk.from, at, sizeof at) != 0)
                ck_abort_msg("a step does not begin where the last one ended");
            memcpy(at, walk.to, sizeof at);
            const double off = (at[0] - p[0]) * ahead[1] - (at[1] - p[1]) * ahead[0];
            if (!(fabs(off) <= 1e-12) || ++n_steps > 4 * SIDE + 4)
                ck_abort_msg("%g off the straight line after %d steps", off, n_steps);
        }
        ck_assert(on_border(&w, at));
        ck_assert_double_eq_tol(walk.s, way_out(&w, p, ahead), 1e-12);
    }
}
END_TEST

static double slope_sum(double across, double along)
{
    return sqrt(across * across + along * along) / across;
}

/* f = -|x - 5| + slope y: lines meet at x = 5 and go on along it. */
START_TEST(lines_merge_on_a_compression_edge)
{
    random_source r = {2};
    world w;
    world_init(&w, 11, 8, 5 + 11 * 7);
    for (int round = 0; round < 2000; ++round) {
        const double slope = random_between(&r, 0.01, 0.5);
        for (size_t j = 0; j < 8; ++j)
            for (size_t i = 0; i < 11; ++i)
                *value(&w, i, j) = slope * (double)j - fabs((double)i - 5);
        const double x = random_between(&r, 1, 9), y = random_between(&r, 0.5, 3);
        iccp_walk2 walk;
        iccp_path path;
        iccp_path_init(&path, &iccp_memory_default);
        ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, x, y, NULL), ICC_OK);
        ck_assert_int_eq(iccp_trace_uphill(&walk, &path), ICC_OK);
        const double across = fabs(x - 5), length = across * slope_sum(1, slope);
        ck_assert_double_eq_tol(walk.alone, length, 1e-12);
        ck_assert_double_eq_tol(walk.s, length + 7 - (y + slope * across), 1e-12);
        ck_assert(walk.merged && iccp_walk2_at_root(&walk));
        ck_assert_double_eq(iccp_path_at(&path, 0)[0], x);
        ck_assert_double_eq(iccp_path_at(&path, path.n - 1)[1], 7);
        for (size_t k = 0; k < path.n; ++k)
            if (iccp_path_length_at(&path, k) > length + 1e-9) {
                const double *p = iccp_path_at(&path, k);
                ck_assert(p[0] == 5 && p[1] == floor(p[1]));
            }
        double share;
        const size_t middle = iccp_path_find(&path, walk.s / 2, &share);
        ck_assert(iccp_path_length_at(&path, middle) <= walk.s / 2);
        ck_assert(iccp_path_length_at(&path, middle + 1) > walk.s / 2);
        ck_assert(share >= 0 && share < 1);
        iccp_path_clear(&path);
    }
}
END_TEST

/* f = -|x - y| + slope (x + y): the same on a diagonal. */
START_TEST(lines_merge_on_a_diagonal)
{
    random_source r = {3};
    world w;
    world_init(&w, 9, 9, 80);
    for (int round = 0; round < 2000; ++round) {
        const double slope = random_between(&r, 0.01, 0.4);
        for (size_t j = 0; j < 9; ++j)
            for (size_t i = 0; i < 9; ++i)
                *value(&w, i, j) = slope * (double)(i + j) - fabs((double)i - (double)j);
        const double x = random_between(&r, 1, 3), y = random_between(&r, 1, 3);
        iccp_walk2 walk;
        ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, x, y, NULL), ICC_OK);
        ck_assert_int_eq(iccp_trace_uphill(&walk, NULL), ICC_OK);
        const double across = fabs(x - y) / sqrt(2), length = across * slope_sum(1, slope);
        ck_assert_double_eq_tol(walk.alone, length, 1e-12);
        const double rest = (16 - x - y) / sqrt(2) - across * slope;
        ck_assert_double_eq_tol(walk.s, length + rest, 1e-12);
    }
}
END_TEST

/* f = |x - 5| + slope y: lines part at x = 5. Seen downhill they meet there. */
START_TEST(lines_part_at_an_expansion_edge)
{
    world w;
    world_init(&w, 11, 8, 0);
    for (size_t j = 0; j < 8; ++j)
        for (size_t i = 0; i < 11; ++i)
            *value(&w, i, j) = 0.25 * (double)j + fabs((double)i - 5);
    iccp_walk2 walk;
    ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, 5, 2.5, NULL), ICC_OK);
    ck_assert_int_eq(iccp_walk2_step(&walk), ICC_OK);
    ck_assert(walk.to[0] > 5 && walk.to[1] > 2.5 && !walk.merged);
    ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_DOWNHILL, 4.5, 2.5, NULL), ICC_OK);
    while (!walk.merged)
        ck_assert_int_eq(iccp_walk2_step(&walk), ICC_OK);
    ck_assert(walk.to[0] == 5 && walk.to[1] == 2);
    ck_assert_double_eq_tol(walk.s, 0.5 * slope_sum(1, 0.25) + 0.5 - 0.125, 1e-15);
}
END_TEST

/* Without any slope the order of the vertices decides: every walk ends, at the last vertex. */
START_TEST(flat_functions_end)
{
    random_source r = {4};
    world w;
    world_init(&w, SIDE, SIDE, SIDE * SIDE - 1);
    for (int round = 0; round < 2000; ++round) {
        double p[2];
        pick_start(&r, p);
        iccp_walk2 walk;
        ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, p[0], p[1], NULL), ICC_OK);
        icc_status status = ICC_OK;
        int n_steps = 0;
        while (status == ICC_OK && !iccp_walk2_at_root(&walk) && n_steps++ < 8 * SIDE)
            status = iccp_walk2_step(&walk);
        ck_assert_int_lt(n_steps, 8 * SIDE);
    }
    iccp_walk2 walk;
    ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, 3, 4, NULL), ICC_OK);
    ck_assert_int_eq(iccp_trace_uphill(&walk, NULL), ICC_OK);
    w.tree.root = 0;
    ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_DOWNHILL, 3, 4, NULL), ICC_OK);
    ck_assert_int_eq(iccp_trace_uphill(&walk, NULL), ICC_OK);
}
END_TEST

static bool has_higher_neighbour(world *w, size_t i, size_t j)
{
    static const int STEP[6][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}};
    for (int m = 0; m < 6; ++m) {
        const size_t a = i + (size_t)STEP[m][0], b = j + (size_t)STEP[m][1];
        if (a < w->grid.shape[0] && b < w->grid.shape[1] && *value(w, a, b) > *value(w, i, j))
            return true;
    }
    return false;
}

/* Values that fall as vertices are reached in random order from the root: one maximum. The
 * outermost vertices are lowest, so that no line leaves. With `levels`, many values are equal. */
static void set_one_maximum(world *w, random_source *r, bool levels)
{
    const size_t n = w->grid.shape[0];
    const size_t i = 1 + (size_t)random_below(r, (int)n - 2),
                 j = 1 + (size_t)random_below(r, (int)n - 2);
    w->tree.root = (uint32_t)(i + n * j);
    for (size_t v = 0; v < n * n; ++v)
        w->values[v] = -1e9;
    double next = 1000;
    *value(w, i, j) = next;
    for (size_t left = (n - 2) * (n - 2) - 1; left > 0;) {
        const size_t a = 1 + (size_t)random_below(r, (int)n - 2);
        const size_t b = 1 + (size_t)random_below(r, (int)n - 2);
        if (*value(w, a, b) > -1e8 || !has_higher_neighbour(w, a, b))
            continue;
        next -= levels ? random_below(r, 2) : random_unit(r);
        *value(w, a, b) = next;
        --left;
    }
    const double lowest = next - 1 - random_unit(r);
    for (size_t v = 0; v < n * n; ++v)
        if (w->values[v] < -1e8)
            w->values[v] = lowest;
}

static void check_ascent(world *w, const double p[2])
{
    iccp_walk2 walk;
    ck_assert_int_eq(iccp_walk2_start(&walk, &w->field, ICCP_UPHILL, p[0], p[1], NULL), ICC_OK);
    const size_t budget = walk.steps_left;
    double before = interpolate(w, p[0], p[1]), s = 0;
    while (!iccp_walk2_at_root(&walk)) {
        const bool was_vertex = walk.at_vertex;
        const double at_vertex = was_vertex ? *value(w, walk.i, walk.j) : 0;
        const icc_status status = iccp_walk2_step(&walk);
        const double after = interpolate(w, walk.to[0], walk.to[1]);
        if (status != ICC_OK || after < before - 1e-9 || walk.s < s ||
            (was_vertex && walk.at_vertex && *value(w, walk.i, walk.j) <= at_vertex))
            ck_abort_msg("status %d, f from %.17g to %.17g", (int)status, before, after);
        before = after;
        s = walk.s;
    }
    ck_assert_uint_lt(budget - walk.steps_left, 6 * w->grid.n_vertices);
}

START_TEST(every_ascent_ends_at_the_only_maximum)
{
    random_source r = {5};
    world w;
    world_init(&w, SIDE, SIDE, 0);
    for (int round = 0; round < 300; ++round) {
        /* Equal values are ordered by index, which may make further maxima. */
        const bool levels = round % 3 == 2;
        set_one_maximum(&w, &r, levels);
        for (int k = 0; k < 100; ++k) {
            double p[2];
            pick_start(&r, p);
            if (!levels) {
                check_ascent(&w, p);
                continue;
            }
            iccp_walk2 walk;
            (void)iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, p[0], p[1], NULL);
            (void)iccp_trace_uphill(&walk, NULL);
            ck_assert_uint_gt(walk.steps_left, 2 * w.grid.n_vertices);
        }
    }
}
END_TEST

/* Values so small that products of their differences vanish. */
START_TEST(tiny_values_are_values)
{
    random_source r = {6};
    world w;
    world_init(&w, SIDE, SIDE, 0);
    for (int round = 0; round < 100; ++round) {
        set_one_maximum(&w, &r, false);
        double lengths[2] = {0, 0};
        double p[2];
        pick_start(&r, p);
        for (int tiny = 0; tiny < 2; ++tiny) {
            iccp_walk2 walk;
            ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, p[0], p[1], NULL),
                             ICC_OK);
            ck_assert_int_eq(iccp_trace_uphill(&walk, NULL), ICC_OK);
            lengths[tiny] = walk.s;
            for (size_t v = 0; v < w.grid.n_vertices; ++v)
                w.values[v] = (w.values[v] + 1e4) * 0x1p-900;
        }
        ck_assert_double_eq_tol(lengths[0], lengths[1], 1e-6);
    }
}
END_TEST

/* Tiny steps up beside a fall by 1: where decay ends and whole numbers go on, see field.c. */
START_TEST(tiny_rises_count_beside_deep_falls)
{
    world w;
    world_init(&w, 5, 5, 24);
    for (size_t j = 0; j < 5; ++j)
        for (size_t i = 0; i < 5; ++i)
            *value(&w, i, j) =
                i + j < 3 ? (double)(i + j) - 3 : ldexp(1 + (double)(i + j) / 16, -1021);
    for (size_t j = 0; j < 4; ++j)
        for (size_t i = 0; i < 4; ++i) {
            iccp_walk2 walk;
            ck_assert_int_eq(
                iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, (double)i, (double)j, NULL), ICC_OK);
            ck_assert_int_eq(iccp_trace_uphill(&walk, NULL), ICC_OK);
        }
}
END_TEST

/* On the outermost edge with values there is a triangle on one side only. */
START_TEST(edges_with_one_triangle_are_starts)
{
    static const double STARTS[][2] = {{2, 2.5}, {2.5, 2}, {3, 2.5}, {2.5, 3}, {2.5, 2.5}};
    /* Vertex (i, j) that has no value, and the start on the edge opposite to it. */
    static const size_t MISSING[][3] = {{1, 2, 0}, {2, 1, 1}, {4, 3, 2},
                                        {3, 4, 3}, {3, 2, 4}, {2, 3, 4}};
    for (size_t k = 0; k < sizeof MISSING / sizeof *MISSING; ++k) {
        world w;
        world_init(&w, 7, 7, 0);
        set_linear(&w, 1, 1.25);
        *value(&w, MISSING[k][0], MISSING[k][1]) = NAN;
        const double *p = STARTS[MISSING[k][2]];
        int n_ways = 0;
        for (int direction = -1; direction <= 1; direction += 2) {
            iccp_walk2 walk;
            ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, direction, p[0], p[1], NULL),
                             ICC_OK);
            double q[2];
            iccp_walk2_position(&walk, q);
            ck_assert(q[0] == p[0] && q[1] == p[1]);
            icc_status status = iccp_walk2_step(&walk);
            if (status == ICC_OK && walk.s <= 0)
                status = iccp_walk2_step(&walk);
            n_ways += status == ICC_OK;
        }
        ck_assert_int_eq(n_ways, 1);
    }
}
END_TEST

/* A start on an edge where lines part goes to the side that is asked for. */
START_TEST(starts_face_the_side_that_is_asked_for)
{
    static const double STARTS[][2] = {{3, 2.5}, {2.5, 3}, {2.5, 2.5}};
    static const double NORMALS[][2] = {{1, 0}, {0, 1}, {1, -1}};
    for (int k = 0; k < 6; ++k) {
        world w;
        world_init(&w, 7, 7, 0);
        const double *p = STARTS[k / 2], *n = NORMALS[k / 2];
        for (size_t j = 0; j < 7; ++j)
            for (size_t i = 0; i < 7; ++i)
                *value(&w, i, j) = fabs(n[0] * ((double)i - p[0]) + n[1] * ((double)j - p[1]));
        const double side = k % 2 ? 1 : -1, ahead[2] = {side * n[0], side * n[1]};
        iccp_walk2 walk;
        ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, p[0], p[1], NULL), ICC_OK);
        iccp_walk2_face(&walk, ahead);
        ck_assert_int_eq(iccp_walk2_step(&walk), ICC_OK);
        ck_assert_double_gt((walk.to[0] - p[0]) * ahead[0] + (walk.to[1] - p[1]) * ahead[1], 0);
        /* Off the edges nothing changes. */
        for (int start = 0; start < 2; ++start) {
            const double x = start ? 3 : 3.25, y = start ? 2 : 2.5;
            ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, x, y, NULL), ICC_OK);
            const iccp_walk2 before = walk;
            iccp_walk2_face(&walk, ahead);
            ck_assert(walk.i == before.i && walk.j == before.j && walk.upper == before.upper &&
                      walk.at_vertex == before.at_vertex);
        }
    }
}
END_TEST

START_TEST(starts_without_values_are_refused)
{
    world w;
    world_init(&w, 5, 5, 12);
    set_linear(&w, 1, 2);
    *value(&w, 3, 3) = NAN;
    iccp_walk2 walk;
    static const double bad[][2] = {{3, 3}, {2.5, 2.6}, {3.5, 3.1}, {-0.1, 1},    {1, -0.1},
                                    {4, 1}, {1, 4},     {NAN, 1},   {1, HUGE_VAL}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k)
        ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, bad[k][0], bad[k][1], NULL),
                         ICC_ERR_TRACE);
    ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, 1.5, 1.25, NULL), ICC_OK);
    ck_assert_int_eq(iccp_trace_uphill(&walk, NULL), ICC_ERR_TRACE);
    /* The number of steps is bounded whatever happens. */
    ck_assert_int_eq(iccp_walk2_start(&walk, &w.field, ICCP_UPHILL, 0.5, 0.5, NULL), ICC_OK);
    walk.steps_left = 1;
    ck_assert_int_eq(iccp_walk2_step(&walk), ICC_OK);
    ck_assert_int_eq(iccp_walk2_step(&walk), ICC_ERR_TRACE);
    ck_assert_int_eq(iccp_walk2_step(&walk), ICC_ERR_TRACE);
}
END_TEST

START_TEST(slope_sign_is_that_of_the_gradient)
{
    world w;
    world_init(&w, 5, 5, 12);
    set_linear(&w, 1, -2);
    const double p[2] = {1.25, 2.5}, d[3][2] = {{2, 0}, {1, 1}, {2, 1}};
    ck_assert_int_eq(iccp_slope_sign(&w.field, p, d[0]), 1);
    ck_assert_int_eq(iccp_slope_sign(&w.field, p, d[1]), -1);
    ck_assert_int_eq(iccp_slope_sign(&w.field, p, d[2]), 0);
    const double outside[2] = {-1, 2};
    ck_assert_int_eq(iccp_slope_sign(&w.field, outside, d[0]), 0);
}
END_TEST

/* ---- the boundary ---- */

enum { MAX_CORNERS = 24 };

typedef struct field_with_boundary {
    world w;
    icc_domain domain;
    double corners[2 * MAX_CORNERS];
    uint32_t facets[2 * MAX_CORNERS];
    iccp_boundary_cells2 cells;
} bounded;

static const iccp_env ENV = {.memory = {NULL, NULL, NULL}, .threads = 1};

static void bounded_init(bounded *f, size_t n)
{
    iccp_env env = ENV;
    env.memory = iccp_memory_default;
    for (size_t k = 0; k < n; ++k) {
        f->facets[2 * k] = (uint32_t)k;
        f->facets[2 * k + 1] = (uint32_t)((k + 1) % n);
    }
    f->domain = (icc_domain){.dim = 2, .n_vertices = n, .n_facets = n};
    f->domain.vertices = f->corners;
    f->domain.facets = f->facets;
    ck_assert_int_eq(iccp_boundary_cells2_create(&f->cells, &f->domain, &f->w.grid, &env), ICC_OK);
}

static long cross(const long a[2], const long b[2], const long c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool between(const long a[2], const long b[2], const long c[2])
{
    return (a[0] - b[0]) * (c[0] - b[0]) <= 0 && (a[1] - b[1]) * (c[1] - b[1]) <= 0;
}

static double distance(const long a[2], const long b[2])
{
    return hypot((double)(a[0] - b[0]), (double)(a[1] - b[1]));
}

/* The share of the step p q at which it first meets the edge a b; 2 if never. In integers. */
static double meets(const long p[2], const long q[2], const long a[2], const long b[2])
{
    const long ap = cross(a, b, p), aq = cross(a, b, q), pa = cross(p, q, a), pb = cross(p, q, b);
    if (ap == 0 && aq == 0) {
        if (between(a, p, b))
            return 0;
        double nearest = 2 * distance(p, q);
        if (between(p, a, q))
            nearest = distance(p, a);
        if (between(p, b, q))
            nearest = fmin(nearest, distance(p, b));
        return nearest / distance(p, q);
    }
    if ((ap > 0 && aq > 0) || (ap < 0 && aq < 0) || (pa > 0 && pb > 0) || (pa < 0 && pb < 0))
        return 2;
    return (double)ap / (double)(ap - aq);
}

/* All coordinates are eighths, so the oracle is exact; corners, borders and overlaps are common. */
START_TEST(the_first_hit_is_that_of_all_edges)
{
    random_source r = {7};
    bounded f;
    world_init(&f.w, 7, 6, 0);
    int n_hits = 0, n_touches = 0;
    for (int round = 0; round < 100; ++round) {
        long corners[MAX_CORNERS][2];
        const size_t n = 3 + (size_t)random_below(&r, MAX_CORNERS - 2);
        for (size_t k = 0; k < n; ++k)
            do {
                corners[k][0] = 1 + random_below(&r, 47);
                corners[k][1] = 1 + random_below(&r, 39);
            } while (k > 0 && distance(corners[k], corners[k - 1]) < 1);
        for (size_t k = 0; k < 2 * n; ++k)
            f.corners[k] = (double)corners[k / 2][k % 2] / 8;
        bounded_init(&f, n);
        for (int k = 0; k < 200; ++k) {
            const int i = random_below(&r, 6), j = random_below(&r, 5);
            long p[2] = {8 * i + random_below(&r, 9), 8 * j + random_below(&r, 9)};
            long q[2] = {8 * i + random_below(&r, 9), 8 * j + random_below(&r, 9)};
            if (distance(p, q) < 1)
                continue;
            double first = 2;
            for (size_t e = 0; e < n; ++e)
                first = fmin(first, meets(p, q, corners[e], corners[(e + 1) % n]));
            const double from[2] = {(double)p[0] / 8, (double)p[1] / 8};
            const double to[2] = {(double)q[0] / 8, (double)q[1] / 8};
            iccp_boundary_hit2 hit;
            const bool found =
                iccp_boundary_cells2_first(&f.cells, (size_t)i, (size_t)j, from, to, &hit);
            ck_assert_int_eq(found, first <= 1);
            if (!found)
                continue;
            ck_assert_double_eq_tol(hit.share, first, 1e-15);
            const double *a = f.corners + 2 * f.facets[2 * hit.facet];
            const double *b = f.corners + 2 * f.facets[2 * hit.facet + 1];
            for (int c = 0; c < 2; ++c)
                ck_assert_double_eq_tol(a[c] + hit.along * (b[c] - a[c]),
                                        from[c] + hit.share * (to[c] - from[c]), 1e-13);
            ++n_hits;
            n_touches += hit.along <= 0 || hit.along >= 1;
        }
        iccp_boundary_cells2_free(&f.cells);
    }
    ck_assert_int_gt(n_hits, 2500);
    ck_assert_int_gt(n_touches, 125);
}
END_TEST

/* A polygon between the outermost vertices and the rest, so that every descent must cross it. */
static void random_bounded(bounded *f, random_source *r)
{
    const size_t n = 5 + (size_t)random_below(r, MAX_CORNERS - 5);
    for (size_t k = 0; k < n; ++k) {
        const double a = 6.28318530717958647692 * ((double)k + 0.8 * random_unit(r)) / (double)n;
        const double radius = 2 + random_unit(r) * (SIDE / 2.0 - 3.2);
        f->corners[2 * k] = (SIDE - 1) / 2.0 + radius * cos(a);
        f->corners[2 * k + 1] = (SIDE - 1) / 2.0 + radius * sin(a);
    }
    bounded_init(f, n);
}

static bool inside_boundary(const bounded *f, const double p[2])
{
    bool inside = false;
    for (size_t k = 0; k < f->domain.n_facets; ++k) {
        const double *a = f->corners + 2 * f->facets[2 * k],
                     *b = f->corners + 2 * f->facets[2 * k + 1];
        if ((a[1] > p[1]) != (b[1] > p[1]) &&
            (p[0] - a[0]) * fabs(b[1] - a[1]) <
                (b[0] - a[0]) * (p[1] - a[1]) * (b[1] > a[1] ? 1 : -1))
            inside = !inside;
    }
    return inside;
}

static void pick_inside(const bounded *f, random_source *r, double p[2])
{
    do {
        p[0] = random_between(r, 0, SIDE - 1);
        p[1] = random_between(r, 0, SIDE - 1);
    } while (!inside_boundary(f, p));
}

typedef struct descent {
    icc_status status;
    iccp_walk2 walk;
    iccp_boundary_hit2 hit;
    iccp_jet2 jet;
} descent;

static descent descend(const bounded *f, const double p[2], iccp_path *path)
{
    descent d = {.jet = {{1, 0}, {0, 1}, {0, 0}}};
    d.status = iccp_walk2_start(&d.walk, &f->w.field, ICCP_DOWNHILL, p[0], p[1], &d.jet);
    if (d.status == ICC_OK)
        d.status = iccp_trace_downhill(&d.walk, &f->cells, path, &d.hit);
    return d;
}

static double to_segment(const double p[2], const double a[2], const double b[2])
{
    const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    double t = length2 > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2 : 0;
    t = fmax(0, fmin(1, t));
    return hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1]);
}

START_TEST(ascending_from_the_end_of_a_descent_comes_back)
{
    random_source r = {8};
    bounded f;
    world_init(&f.w, SIDE, SIDE, 0);
    int n_alone = 0, n_merged = 0;
    for (int round = 0; round < 300; ++round) {
        set_one_maximum(&f.w, &r, false);
        random_bounded(&f, &r);
        iccp_path path;
        iccp_path_init(&path, &iccp_memory_default);
        for (int k = 0; k < 50; ++k) {
            double p[2];
            pick_inside(&f, &r, p);
            descent d = descend(&f, p, &path);
            /* The function may have a minimum inside. */
            if (d.status != ICC_OK)
                continue;
            ck_assert_double_eq(iccp_path_length(&path), d.walk.s);
            const double end[2] = {d.walk.to[0], d.walk.to[1]};
            ck_assert_mem_eq(iccp_path_at(&path, path.n - 1), end, sizeof end);
            const double *a = f.corners + 2 * f.facets[2 * d.hit.facet];
            const double *b = f.corners + 2 * f.facets[2 * d.hit.facet + 1];
            ck_assert_double_eq_tol(end[0], a[0] + d.hit.along * (b[0] - a[0]), 1e-12);
            ck_assert_double_eq_tol(end[1], a[1] + d.hit.along * (b[1] - a[1]), 1e-12);
            if (d.walk.merged) {
                ++n_merged;
                continue;
            }
            iccp_walk2 up;
            ck_assert_int_eq(iccp_walk2_start(&up, &f.w.field, ICCP_UPHILL, end[0], end[1], NULL),
                             ICC_OK);
            ck_assert_int_eq(iccp_trace_uphill(&up, &path), ICC_OK);
            double nearest = HUGE_VAL;
            for (size_t m = 0; m + 1 < path.n; ++m)
                nearest = fmin(nearest,
                               to_segment(p, iccp_path_at(&path, m), iccp_path_at(&path, m + 1)));
            ck_assert_double_le(nearest, 1e-9);
            iccp_walk2 rest;
            ck_assert_int_eq(iccp_walk2_start(&rest, &f.w.field, ICCP_UPHILL, p[0], p[1], NULL),
                             ICC_OK);
            ck_assert_int_eq(iccp_trace_uphill(&rest, NULL), ICC_OK);
            ck_assert_double_eq_tol(up.s, d.walk.s + rest.s, 1e-8);
            ++n_alone;
        }
        iccp_path_clear(&path);
        iccp_boundary_cells2_free(&f.cells);
    }
    ck_assert_int_gt(n_alone, 1000);
    ck_assert_int_gt(n_merged, 1000);
}
END_TEST

/* Whether two one-sided differences agree with each other, and then with the derivative. */
static bool agrees(double minus, double at, double plus, double step, double derivative)
{
    const double left = (at - minus) / step, right = (plus - at) / step;
    const double size = 1 + fabs(derivative) + fabs(left);
    if (fabs(left - right) > 1e-5 * size)
        return false;
    ck_assert_double_le(fabs((left + right) / 2 - derivative), 1e-4 * size);
    return true;
}

START_TEST(jets_are_derivatives)
{
    random_source r = {9};
    bounded f;
    world_init(&f.w, SIDE, SIDE, 0);
    int n_down = 0, n_up = 0;
    for (int round = 0; round < 200; ++round) {
        set_one_maximum(&f.w, &r, false);
        random_bounded(&f, &r);
        for (int k = 0; k < 100; ++k) {
            double p[2];
            const double h = 1e-7;
            pick_inside(&f, &r, p);
            if (k % 8 == 0) /* on an edge */
                p[0] = floor(p[0]);
            if (k % 8 == 0 && !inside_boundary(&f, p))
                continue;
            const int c = k % 2;
            double low[2] = {p[0], p[1]}, high[2] = {p[0], p[1]};
            low[c] -= h;
            high[c] += h;
            const descent d = descend(&f, p, NULL), l = descend(&f, low, NULL),
                          u = descend(&f, high, NULL);
            if (d.status == ICC_OK && l.status == ICC_OK && u.status == ICC_OK &&
                d.hit.facet == l.hit.facet && d.hit.facet == u.hit.facet)
                n_down += agrees(l.walk.s, d.walk.s, u.walk.s, h, d.jet.s[c]) &&
                          agrees(l.walk.to[0], d.walk.to[0], u.walk.to[0], h, d.jet.x[c]) &&
                          agrees(l.walk.to[1], d.walk.to[1], u.walk.to[1], h, d.jet.y[c]);
            iccp_jet2 jet = {{1, 0}, {0, 1}, {0, 0}};
            iccp_walk2 up[3];
            const double *from[3] = {low, p, high};
            for (int m = 0; m < 3; ++m) {
                (void)iccp_walk2_start(&up[m], &f.w.field, ICCP_UPHILL, from[m][0], from[m][1],
                                       m == 1 ? &jet : NULL);
                ck_assert_int_eq(iccp_trace_uphill(&up[m], NULL), ICC_OK);
            }
            n_up += agrees(up[0].s, up[1].s, up[2].s, h, jet.s[c]);
            ck_assert(fabs(jet.x[0]) + fabs(jet.x[1]) + fabs(jet.y[0]) + fabs(jet.y[1]) <= 0);
        }
        iccp_boundary_cells2_free(&f.cells);
    }
    ck_assert_int_gt(n_down, 5000);
    ck_assert_int_gt(n_up, 5000);
}
END_TEST

/* ---- memory ---- */

static void *no_memory(void *user, size_t size)
{
    size_t *left = user;
    if (*left == 0)
        return NULL;
    --*left;
    return malloc(size);
}

static void give_back(void *user, void *memory)
{
    (void)user;
    free(memory);
}

START_TEST(running_out_of_memory_is_reported)
{
    random_source r = {10};
    bounded f;
    world_init(&f.w, SIDE, SIDE, 0);
    set_one_maximum(&f.w, &r, false);
    random_bounded(&f, &r);
    size_t left = 0;
    iccp_env env = ENV;
    env.memory = (iccp_memory){&left, no_memory, give_back};
    for (size_t k = 0; k < 3; ++k) {
        iccp_boundary_cells2 cells;
        left = k;
        ck_assert_int_eq(iccp_boundary_cells2_create(&cells, &f.domain, &f.w.grid, &env),
                         ICC_ERR_MEMORY);
        ck_assert_ptr_null(cells.vertices);
    }
    iccp_path path;
    iccp_path_init(&path, &env.memory);
    left = 0;
    double p[2];
    pick_inside(&f, &r, p);
    ck_assert_int_eq(descend(&f, p, &path).status, ICC_ERR_MEMORY);
    iccp_walk2 walk;
    (void)iccp_walk2_start(&walk, &f.w.field, ICCP_UPHILL, p[0], p[1], NULL);
    ck_assert_int_eq(iccp_trace_uphill(&walk, &path), ICC_ERR_MEMORY);
    /* Room for 1024, 2048 and 4096 doubles, three of which make a point. */
    left = 3;
    iccp_path_start(&path, 2);
    for (int k = 0; k < 1000; ++k)
        ck_assert_int_eq(iccp_path_append(&path, (double[2]){k, 2 * k}, 3 * k), ICC_OK);
    for (int k = 0; k < 999; ++k) {
        double share, at[2];
        ck_assert_uint_eq(iccp_path_find(&path, 3 * k + 0.75, &share), (size_t)k);
        ck_assert_double_eq(share, 0.25);
        iccp_path_point(&path, (size_t)k, share, at);
        ck_assert(at[0] == k + 0.25 && at[1] == 2 * k + 0.5);
    }
    for (int k = 0; k < 365; ++k)
        ck_assert_int_eq(iccp_path_append(&path, p, 0), ICC_OK);
    ck_assert_int_eq(iccp_path_append(&path, p, 0), ICC_ERR_MEMORY);
    ck_assert_uint_eq(path.n, 1365);
    ck_assert_double_eq(iccp_path_at(&path, 999)[1], 1998);
    iccp_path_clear(&path);
    iccp_boundary_cells2_free(&f.cells);
}
END_TEST

/* A path that cannot grow in the middle of a descent. */
START_TEST(long_descents_need_memory)
{
    bounded f;
    world_init(&f.w, SIDE, SIDE, 0);
    set_linear(&f.w, 1, 1.5);
    memcpy(f.corners, (double[]){0.5, 0.25, 12.5, 0.25, 12.5, 12.5, 0.5, 12.5}, 8 * sizeof(double));
    bounded_init(&f, 4);
    size_t left = 0;
    const iccp_memory memory = {&left, no_memory, give_back};
    double points[9];
    iccp_path path = {.memory = &memory, .capacity = 9, .points = points};
    const double p[2] = {9.3, 11.9};
    ck_assert_int_eq(descend(&f, p, &path).status, ICC_ERR_MEMORY);
    ck_assert_uint_eq(path.n, 3);
    iccp_boundary_cells2_free(&f.cells);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("walk");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, a_linear_function_gives_straight_lines);
    tcase_add_test(tests, lines_merge_on_a_compression_edge);
    tcase_add_test(tests, lines_merge_on_a_diagonal);
    tcase_add_test(tests, lines_part_at_an_expansion_edge);
    tcase_add_test(tests, flat_functions_end);
    tcase_add_test(tests, every_ascent_ends_at_the_only_maximum);
    tcase_add_test(tests, tiny_values_are_values);
    tcase_add_test(tests, tiny_rises_count_beside_deep_falls);
    tcase_add_test(tests, edges_with_one_triangle_are_starts);
    tcase_add_test(tests, starts_face_the_side_that_is_asked_for);
    tcase_add_test(tests, starts_without_values_are_refused);
    tcase_add_test(tests, slope_sign_is_that_of_the_gradient);
    tcase_add_test(tests, the_first_hit_is_that_of_all_edges);
    tcase_add_test(tests, ascending_from_the_end_of_a_descent_comes_back);
    tcase_add_test(tests, jets_are_derivatives);
    tcase_add_test(tests, running_out_of_memory_is_reported);
    tcase_add_test(tests, long_descents_need_memory);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
