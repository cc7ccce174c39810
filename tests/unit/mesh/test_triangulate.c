/* Constrained Delaunay triangulations of many shapes, and of data that has none. */
#include "../../random.h"
#include "../../suite.h"
#include "../../triangulation.h"
#include "base/env.h"
#include "mesh/triangulate.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ROOM = 40000 };

typedef struct shape {
    size_t n_boundary, n_points;
    double points[2 * ROOM];
} shape;

static size_t pick(random_source *r, size_t n)
{
    return (size_t)random_below(r, (int)n);
}

static void add(shape *s, double x, double y)
{
    ck_assert_uint_lt(s->n_points, ROOM);
    s->points[2 * s->n_points] = x;
    s->points[2 * s->n_points + 1] = y;
    ++s->n_points;
}

static shape *shape_new(void)
{
    shape *s = calloc(1, sizeof *s);
    ck_assert_ptr_nonnull(s);
    return s;
}

/* The polygon is complete: what follows are points inside. */
static void close_polygon(shape *s)
{
    s->n_boundary = s->n_points;
}

static bool is_new(const shape *s, const double *p)
{
    for (size_t i = 0; i < s->n_points; ++i)
        if (memcmp(point_at(s->points, i), p, 2 * sizeof *p) == 0)
            return false;
    return true;
}

/* Adds a point if it lies inside and is not there yet. */
static void offer(shape *s, double x, double y)
{
    const double p[2] = {x + 0.0, y + 0.0};
    if (place_in_polygon(s->n_boundary, s->points, p) > 0 && is_new(s, p))
        add(s, p[0], p[1]);
}

static void reverse_polygon(shape *s)
{
    for (size_t i = 0, j = s->n_boundary - 1; i < j; ++i, --j)
        for (size_t k = 0; k < 2; ++k) {
            const double x = s->points[2 * i + k];
            s->points[2 * i + k] = s->points[2 * j + k];
            s->points[2 * j + k] = x;
        }
}

static const iccp_env *plain(void)
{
    static iccp_env env;
    env = (iccp_env){.memory = iccp_memory_default, .threads = 1};
    return &env;
}

static double area(size_t n, const uint32_t *vertices, const double *points)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i) {
        const double *a = point_at(points, vertices[i]),
                     *b = point_at(points, vertices[(i + 1) % n]);
        sum += a[0] * b[1] - b[0] * a[1];
    }
    return sum;
}

static void check_area(const shape *s, const uint32_t *triangles)
{
    uint32_t *all = malloc(s->n_boundary * sizeof *all);
    ck_assert_ptr_nonnull(all);
    double sum = 0.0;
    for (size_t i = 0; i < s->n_boundary; ++i)
        all[i] = (uint32_t)i;
    for (size_t t = 0; t < 2 * s->n_points - s->n_boundary - 2; ++t)
        sum += area(3, triangles + 3 * t, s->points);
    const double whole = fabs(area(s->n_boundary, all, s->points));
    /* 1e-6 of it: the sum of rounding errors in the corners' products, not a missing triangle. */
    ck_assert_double_le(fabs(sum - whole), 1e-6 * whole);
    free(all);
}

/* Triangulates in both orientations, through both entries. */
static void check_shape(shape *s, const char *name)
{
    const size_t n = 3 * (2 * s->n_points - s->n_boundary - 2);
    uint32_t *triangles = malloc(3 * n * sizeof *triangles);
    ck_assert_ptr_nonnull(triangles);
    for (int turn = 0; turn < 2; ++turn) {
        icc_error err = {.size = sizeof err};
        const icc_status status = iccp_triangulate_mesh(s->n_boundary, s->n_points, s->points,
                                                        triangles, triangles + n, plain(), &err);
        ck_assert_msg(status == ICC_OK, "%s: %s", name, err.message);
        const char *defect = find_triangulation_defect(s->n_boundary, s->n_points, s->points,
                                                       triangles, triangles + n);
        ck_assert_msg(defect == NULL, "%s: %s", name, defect);
        check_area(s, triangles);
        ck_assert_int_eq(iccp_triangulate(s->n_boundary, s->n_points, s->points, triangles + 2 * n,
                                          plain(), &err),
                         ICC_OK);
        ck_assert_mem_eq(triangles, triangles + 2 * n, n * sizeof *triangles);
        reverse_polygon(s);
    }
    free(triangles);
}

/* Checks a shape with more and more points inside, drawn from its box. */
static void check_filled(shape *s, const char *name, random_source *r, size_t n_offers)
{
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    close_polygon(s);
    for (size_t i = 0; i < 2 * s->n_boundary; ++i) {
        low[i % 2] = fmin(low[i % 2], s->points[i]);
        high[i % 2] = fmax(high[i % 2], s->points[i]);
    }
    check_shape(s, name);
    for (size_t i = 0; i < n_offers; ++i)
        offer(s, low[0] + random_unit(r) * (high[0] - low[0]),
              low[1] + random_unit(r) * (high[1] - low[1]));
    check_shape(s, name);
}

START_TEST(smallest)
{
    shape *s = shape_new();
    add(s, 0, 0);
    add(s, 1, 0);
    add(s, 0, 1);
    close_polygon(s);
    check_shape(s, "triangle");
    add(s, 0.25, 0.25);
    check_shape(s, "triangle with a point");
    offer(s, 0.5, 0.5 - 0x1p-53);
    offer(s, 0x1p-200, 0x1p-200);
    ck_assert_uint_eq(s->n_points, 6);
    check_shape(s, "triangle with points close to its edges");
    free(s);
}
END_TEST

START_TEST(stars)
{
    random_source r = {1};
    for (int i = 0; i < 300; ++i) {
        shape *s = shape_new();
        const size_t n = 5 + pick(&r, 60);
        const double least = i % 3 == 0 ? 0.01 : 0.6;
        for (size_t k = 0; k < n; ++k) {
            const double angle =
                6.283185307179586 * ((double)k + 0.9 * random_unit(&r)) / (double)n;
            const double radius = least + (1.0 - least) * random_unit(&r);
            add(s, 5.0 + radius * cos(angle), radius * sin(angle));
        }
        check_filled(s, "star", &r, pick(&r, 200));
        free(s);
    }
}
END_TEST

/* Teeth longer than the comb is wide; points inside every tooth. */
START_TEST(combs)
{
    random_source r = {2};
    for (size_t n = 2; n < 100; n += 7) {
        shape *s = shape_new();
        for (size_t i = 0; i < 2 * n; ++i)
            add(s, (double)i, i % 2 == 0 ? 0.0 : 0.01 * (double)n + random_unit(&r) * (double)n);
        add(s, 2.0 * (double)n - 1.0, -1.0);
        add(s, 0.0, -1.0);
        check_filled(s, "comb", &r, 500);
        free(s);
    }
}
END_TEST

START_TEST(spirals)
{
    random_source r = {3};
    for (size_t n = 120; n <= 420; n += 100) {
        shape *s = shape_new();
        for (size_t side = 0; side < 2; ++side)
            for (size_t k = 0; k < n; ++k) {
                const double at = (double)(side == 0 ? k : n - 1 - k) / (double)n;
                const double radius = 0.1 + at + (side == 0 ? 0.0 : 0.04);
                add(s, radius * cos(40.0 * at), radius * sin(40.0 * at));
            }
        check_filled(s, "spiral", &r, 300);
        free(s);
    }
}
END_TEST

/* Many collinear vertices on the polygon, and nothing but ties in the circles. */
START_TEST(lattices)
{
    for (int n = 2; n <= 40; n += n < 6 ? 1 : 11) {
        const double scale[3] = {1.0, 0.1, 0x1p190};
        for (int k = 0; k < 3; ++k) {
            shape *s = shape_new();
            const double h = scale[k];
            for (int i = 0; i < 4 * n; ++i) {
                const int side = i / n, at = i % n;
                const int x = side == 0 ? at : side == 1 ? n : side == 2 ? n - at : 0;
                const int y = side == 0 ? 0 : side == 1 ? at : side == 2 ? n : n - at;
                add(s, x * h, y * h);
            }
            close_polygon(s);
            check_shape(s, "square");
            for (int i = 1; i < n; ++i)
                for (int j = 1; j < n; ++j)
                    add(s, i * h, j * h);
            check_shape(s, "lattice");
            free(s);
        }
    }
}
END_TEST

/* Points exactly on the segments between any two vertices. */
START_TEST(points_on_diagonals)
{
    static const double outline[16] = {0, 0, 8, 0, 16, 0, 16, 16, 8, 16, 8, 8, 0, 8, 0, 4};
    shape *s = shape_new();
    for (int i = 0; i < 8; ++i)
        add(s, outline[2 * i], outline[2 * i + 1]);
    close_polygon(s);
    for (int i = 0; i < 8; ++i)
        for (int j = i + 1; j < 8; ++j)
            for (int k = 1; k < 8; ++k)
                offer(s, (outline[2 * i] * k + outline[2 * j] * (8 - k)) / 8.0,
                      (outline[2 * i + 1] * k + outline[2 * j + 1] * (8 - k)) / 8.0);
    ck_assert_uint_gt(s->n_points, 60);
    check_shape(s, "diagonals");
    free(s);
}
END_TEST

/* Points as close to the polygon as doubles allow, on every edge. */
START_TEST(points_close_to_the_polygon)
{
    random_source r = {4};
    for (int i = 0; i < 50; ++i) {
        shape *s = shape_new();
        for (int k = 0; k < 9; ++k) {
            const double angle = 6.283185307179586 * k / 9.0, radius = 0.3 + random_unit(&r);
            add(s, 1.0 + radius * cos(angle), 1.0 + radius * sin(angle));
        }
        close_polygon(s);
        for (size_t k = 0; k < 400; ++k) {
            const double *a = point_at(s->points, k % 9), *b = point_at(s->points, (k + 1) % 9);
            const double at = random_unit(&r);
            double p[2];
            for (int axis = 0; axis < 2; ++axis) {
                p[axis] = a[axis] + at * (b[axis] - a[axis]);
                p[axis] = nextafter(p[axis], (double)pick(&r, 3));
            }
            offer(s, p[0], p[1]);
        }
        ck_assert_uint_gt(s->n_points, 100);
        check_shape(s, "close points");
        free(s);
    }
}
END_TEST

/* The polygon through random points in random order, untangled: long edges that cross many others
 * of the Delaunay triangulation. */
static void add_tangle(shape *s, random_source *r, size_t n, size_t grid)
{
    while (s->n_points < n) {
        const double p[2] = {grid == 0 ? random_unit(r) : (double)pick(r, grid),
                             grid == 0 ? random_unit(r) : (double)pick(r, grid)};
        if (is_new(s, p))
            add(s, p[0], p[1]);
    }
    bool again = true;
    for (int rounds = 0; again && rounds < 1000; ++rounds) {
        again = false;
        for (size_t i = 0; i + 2 < n; ++i)
            for (size_t j = i + 2; j < n; ++j) {
                const double *a = point_at(s->points, i), *b = point_at(s->points, i + 1);
                const double *c = point_at(s->points, j), *d = point_at(s->points, (j + 1) % n);
                if ((j + 1) % n == i || !segments_meet(a, b, c, d))
                    continue;
                again = true;
                for (size_t low = i + 1, high = j; low < high; ++low, --high)
                    for (size_t k = 0; k < 2; ++k) {
                        const double x = s->points[2 * low + k];
                        s->points[2 * low + k] = s->points[2 * high + k];
                        s->points[2 * high + k] = x;
                    }
            }
    }
}

START_TEST(tangles)
{
    random_source r = {5};
    int n_simple = 0;
    for (int i = 0; i < 200; ++i) {
        shape *s = shape_new();
        const size_t n = 4 + pick(&r, i < 150 ? 40 : 120);
        add_tangle(s, &r, n, i % 3 == 0 ? 14 : 0);
        if (is_simple(n, s->points)) {
            ++n_simple;
            check_filled(s, "tangle", &r, pick(&r, 3) * 150);
        }
        free(s);
    }
    ck_assert_int_gt(n_simple, 100);
}
END_TEST

/* A polygon with an edge from vertex 0 to 1 that crosses more than 2 n triangles of the Delaunay
 * triangulation: on either side of it runs a row of n vertices at a small distance, jagged or along
 * an arc that bends towards the edge or away from it. Below the edge the polygon is a box. */
static void add_long_edge(shape *s, random_source *r, int kind, size_t n)
{
    const double width = (double)n + 1.0;
    add(s, 0, 0);
    add(s, width, 0);
    for (int side = 0; side < 2; ++side) {
        for (size_t i = n; i > 0; --i) {
            const double x = (double)i + 0.25 * side, at = x / width;
            const double arc =
                kind == 1 ? 1.0 + width * at * (1.0 - at) : 0.01 + (at - 0.5) * (at - 0.5);
            const double y = kind == 0 ? 0.01 + random_unit(r) : arc;
            add(s, x, side == 0 ? y : -y);
        }
        if (side == 1)
            break;
        add(s, -1, 0x1p-30);
        add(s, -1, -2.0 * width);
        add(s, width + 1.0, -2.0 * width);
        add(s, width + 1.0, -0x1p-30);
    }
    close_polygon(s);
}

START_TEST(long_edges)
{
    random_source r = {6};
    for (int kind = 0; kind < 3; ++kind)
        for (size_t n = 4; n <= 4096; n *= 4) {
            shape *s = shape_new();
            add_long_edge(s, &r, kind, n);
            check_shape(s, "a long edge");
            for (size_t i = 0; n < 300 && i < 300; ++i)
                offer(s, random_unit(&r) * (double)n, 0.02 * random_unit(&r));
            check_shape(s, "a long edge, and points");
            free(s);
        }
}
END_TEST

/* Clusters within clusters, each smaller by 2^-20. */
START_TEST(clusters)
{
    random_source r = {11};
    shape *s = shape_new();
    for (int k = 0; k < 4; ++k)
        add(s, k == 1 || k == 2 ? 1 : -1, k >= 2 ? 1 : -1);
    close_polygon(s);
    for (int level = 1; level < 8; ++level)
        for (int i = 0; i < 1000; ++i)
            add(s, ldexp(1.0 + random_unit(&r), -20 * level), ldexp(random_unit(&r), -20 * level));
    check_shape(s, "clusters");
    free(s);
}
END_TEST

START_TEST(every_scale)
{
    random_source r = {7};
    for (int e = -150; e <= 190; e += 17) {
        shape *s = shape_new();
        const double h = ldexp(1.0, e);
        for (int k = 0; k < 12; ++k)
            add(s, h * (1.0 + (k % 2 ? 1.0 : 0.5) * cos(k * 0.5235987755982988)),
                h * (k % 2 ? 1.0 : 0.5) * sin(k * 0.5235987755982988 + 0.1));
        check_filled(s, "scaled", &r, 100);
        free(s);
    }
}
END_TEST

START_TEST(many_points)
{
    random_source r = {8};
    shape *s = shape_new();
    for (int k = 0; k < 2000; ++k) {
        const double angle = 6.283185307179586 * k / 2000.0, radius = 1.0 + 0.1 * sin(60.0 * angle);
        add(s, radius * cos(angle), radius * sin(angle));
    }
    close_polygon(s);
    while (s->n_points < 30000)
        add(s, random_unit(&r) - 0.5, random_unit(&r) - 0.5);
    check_shape(s, "many points");
    free(s);
}
END_TEST

/* What data may be refused for; bits. */
enum { REPEATED_VERTEX = 1, NOT_SIMPLE = 2, NOT_INSIDE = 4, REPEATED_POINT = 8 };

static int find_faults(const shape *s, bool at_fault[])
{
    int faults = is_simple(s->n_boundary, s->points) ? 0 : NOT_SIMPLE;
    for (size_t i = 0; i < s->n_points; ++i) {
        const double *p = point_at(s->points, i);
        at_fault[i] = false;
        for (size_t j = 0; j < i; ++j)
            if (memcmp(p, point_at(s->points, j), 2 * sizeof *p) == 0) {
                faults |= i < s->n_boundary   ? REPEATED_VERTEX
                          : j < s->n_boundary ? 0
                                              : REPEATED_POINT;
                at_fault[i] = true;
            }
        if (i >= s->n_boundary && place_in_polygon(s->n_boundary, s->points, p) <= 0) {
            faults |= NOT_INSIDE;
            at_fault[i] = true;
        }
    }
    return faults;
}

static bool is_explained(icc_status status, int faults)
{
    switch (status) {
    case ICC_OK:
        return faults == 0;
    case ICC_ERR_BOUNDARY:
        return (faults & (REPEATED_VERTEX | NOT_SIMPLE)) != 0;
    case ICC_ERR_OUTSIDE:
        return (faults & (NOT_INSIDE | NOT_SIMPLE)) != 0;
    case ICC_ERR_ARGUMENT:
        return (faults & REPEATED_POINT) != 0;
    default:
        return false;
    }
}

/* Random data on a tiny grid, most of it bad: refused exactly when it is, for a reason that
 * holds. */
START_TEST(accepts_exactly_what_is_good)
{
    random_source r = {9};
    int n_status[16] = {0};
    for (int i = 0; i < 200000; ++i) {
        static shape s;
        bool at_fault[16];
        const size_t grid = 2 + pick(&r, 4);
        s.n_boundary = 3 + pick(&r, 5);
        s.n_points = 0;
        const size_t n = s.n_boundary + pick(&r, 4);
        while (s.n_points < n) {
            const double p[2] = {(double)pick(&r, grid), (double)pick(&r, grid)};
            if (is_new(&s, p) || pick(&r, 8) == 0)
                add(&s, p[0], p[1]);
            else if (s.n_points >= grid * grid)
                break;
        }
        if (s.n_points < s.n_boundary)
            continue;
        uint32_t triangles[60], neighbours[60];
        icc_error err = {.size = sizeof err};
        const icc_status status = iccp_triangulate_mesh(s.n_boundary, s.n_points, s.points,
                                                        triangles, neighbours, plain(), &err);
        const int faults = find_faults(&s, at_fault);
        ck_assert_msg(is_explained(status, faults), "status %d, faults %d", status, faults);
        ++n_status[status];
        if (status == ICC_OK)
            ck_assert_ptr_null(find_triangulation_defect(s.n_boundary, s.n_points, s.points,
                                                         triangles, neighbours));
        else if (status != ICC_ERR_BOUNDARY && (faults & NOT_SIMPLE) == 0)
            ck_assert(err.index >= 0 && err.index < (int64_t)s.n_points && at_fault[err.index]);
    }
    ck_assert_int_gt(n_status[ICC_OK], 1000);
    ck_assert_int_gt(n_status[ICC_ERR_BOUNDARY], 1000);
    ck_assert_int_gt(n_status[ICC_ERR_OUTSIDE], 1000);
    ck_assert_int_gt(n_status[ICC_ERR_ARGUMENT], 100);
}
END_TEST

/* A polygon that needs everything: a long edge, flips, points; more than one progress report. */
static shape *demanding(void)
{
    random_source r = {10};
    shape *s = shape_new();
    add_long_edge(s, &r, 0, 600);
    while (s->n_points < 10000)
        add(s, 600.0 * random_unit(&r), -2.0 - 1000.0 * random_unit(&r));
    return s;
}

typedef struct budget {
    int left; /* allocations, or progress reports, until one fails */
    int n_live;
} budget;

static void *limited_alloc(void *user, size_t size)
{
    budget *b = user;
    if (b->left-- == 0)
        return NULL;
    ++b->n_live;
    return malloc(size);
}

static void limited_dealloc(void *user, void *memory)
{
    budget *b = user;
    --b->n_live;
    free(memory);
}

START_TEST(every_allocation_may_fail)
{
    shape *s = demanding();
    uint32_t *triangles = malloc(6 * s->n_points * sizeof *triangles);
    ck_assert_ptr_nonnull(triangles);
    icc_status status = ICC_ERR_MEMORY;
    int k = 0;
    for (; status == ICC_ERR_MEMORY; ++k) {
        budget b = {k, 0};
        const iccp_env env = {.memory = {&b, limited_alloc, limited_dealloc}, .threads = 1};
        icc_error err = {.size = sizeof err};
        status = iccp_triangulate(s->n_boundary, s->n_points, s->points, triangles, &env, &err);
        ck_assert_int_eq(b.n_live, 0);
        ck_assert_int_eq(err.status, status);
    }
    ck_assert_int_eq(status, ICC_OK);
    ck_assert_int_gt(k, 20); /* the growing arrays have grown, several times */
    free(triangles);
    free(s);
}
END_TEST

static int32_t limited_progress(void *user, const char *stage, double share)
{
    budget *b = user;
    ck_assert_ptr_nonnull(stage);
    ck_assert(share >= 0.0 && share <= 1.0);
    return b->left-- == 0;
}

START_TEST(can_be_cancelled)
{
    shape *s = demanding();
    uint32_t *triangles = malloc(6 * s->n_points * sizeof *triangles);
    ck_assert_ptr_nonnull(triangles);
    icc_status status = ICC_ERR_CANCELLED;
    int k = 0;
    for (; status == ICC_ERR_CANCELLED; ++k) {
        budget b = {k, 0};
        iccp_env env = {.memory = {&b, limited_alloc, limited_dealloc}, .threads = 1};
        budget reports = {k, 0};
        b.left = -1;
        env.user = &reports;
        env.progress = limited_progress;
        status = iccp_triangulate(s->n_boundary, s->n_points, s->points, triangles, &env, NULL);
        ck_assert_int_eq(b.n_live, 0);
    }
    ck_assert_int_eq(status, ICC_OK);
    ck_assert_int_gt(k, 3);
    free(triangles);
    free(s);
}
END_TEST

static void check_refusal(size_t n_boundary, size_t n_points, const double *points,
                          icc_status expected, int64_t index, const char *words)
{
    uint32_t triangles[60];
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(iccp_triangulate(n_boundary, n_points, points, triangles, plain(), &err),
                     expected);
    ck_assert_int_eq(err.status, expected);
    ck_assert_int_eq(err.index, index);
    ck_assert_msg(strstr(err.message, words) != NULL, "%s", err.message);
}

START_TEST(refusals_name_the_culprit)
{
    const double square[12] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 1, 1};
    check_refusal(4, 6, square, ICC_ERR_ARGUMENT, 5, "point 5 repeats point 4");
    const double on_edge[10] = {0, 0, 4, 0, 4, 4, 0, 4, 4, 1};
    check_refusal(4, 5, on_edge, ICC_ERR_OUTSIDE, 4, "edge from vertex 1 to 2");
    const double on_vertex[10] = {0, 0, 4, 0, 4, 4, 0, 4, 4, 4};
    check_refusal(4, 5, on_vertex, ICC_ERR_OUTSIDE, 4, "repeats vertex 2");
    const double beside[10] = {0, 0, 4, 0, 4, 4, 0, 4, 5, 5};
    check_refusal(4, 5, beside, ICC_ERR_OUTSIDE, 4, "outside");
    const double bay[14] = {0, 0, 4, 0, 4, 4, 2, 1, 0, 4, 2, 2, 2, 0.5};
    check_refusal(5, 7, bay, ICC_ERR_OUTSIDE, 5, "outside");
    const double bow[8] = {0, 0, 4, 4, 5, 0, 0, 4};
    check_refusal(4, 4, bow, ICC_ERR_BOUNDARY, 2, "crosses itself");
    const double spike[10] = {0, 0, 4, 0, 8, 0, 6, 0, 0, 4};
    check_refusal(5, 5, spike, ICC_ERR_BOUNDARY, 3, "vertex 3 lies on");
    const double twice[10] = {0, 0, 4, 0, 4, 4, 0, 0, 0, 4};
    check_refusal(5, 5, twice, ICC_ERR_BOUNDARY, 3, "vertex 3 repeats vertex 0");
    const double line[6] = {0, 0, 1, 1, 2, 2};
    check_refusal(3, 3, line, ICC_ERR_BOUNDARY, -1, "one line");
}
END_TEST

/* A ring in a ring in a ring, and a line inside: what lies inside an odd number of rings is the
 * part. The line is no bound, so triangles on both sides of it are neighbours. */
START_TEST(walls_and_bounds)
{
    enum { N = 14, N_RINGS = 12, N_WALLS = 13 };
    const double points[2 * N] = {0, 0, 12, 0, 12, 12, 0, 12, 3, 3, 9, 3,  9,  9,
                                  3, 9, 5,  5, 7,  5,  7, 7,  5, 7, 2, 11, 10, 11};
    uint32_t pairs[2 * N_WALLS], triangles[6 * N], twins[6 * N];
    size_t n = 0, n_lines = 0;
    iccp_env env;
    iccp_walls walls, bounds;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (uint32_t k = 0; k < N_RINGS; ++k) {
        pairs[2 * k] = k;
        pairs[2 * k + 1] = k % 4 < 3 ? k + 1 : k - 3;
    }
    pairs[2 * N_RINGS] = N_RINGS;
    pairs[2 * N_RINGS + 1] = N_RINGS + 1;
    ck_assert_int_eq(iccp_walls_create(&walls, N, N_WALLS, pairs, &env.memory), ICC_OK);
    ck_assert_int_eq(iccp_walls_create(&bounds, N, N_RINGS, pairs, &env.memory), ICC_OK);
    ck_assert_int_eq(iccp_triangulate_walls(N, points, &walls, &bounds, triangles, twins, &n, &env),
                     ICC_OK);
    /* 8 between the outer two rings, 2 more for each end of the line, and 2 in the last ring */
    ck_assert_uint_eq(n, 8 + 4 + 2);
    for (size_t c = 0; c < 3 * n; ++c) {
        const uint32_t a = triangles[c - c % 3 + (c + 1) % 3];
        const uint32_t b = triangles[c - c % 3 + (c + 2) % 3];
        ck_assert_int_eq(twins[c] == ICCP_NO_NEIGHBOUR, iccp_walls_have(&bounds, a, b));
        n_lines += iccp_walls_find(&walls, a, b) / 2 == N_RINGS;
    }
    ck_assert_uint_eq(n_lines, 2);
    iccp_walls_free(&bounds, &env.memory);
    /* A ring with a gap. */
    ck_assert_int_eq(iccp_walls_create(&bounds, N, N_RINGS - 1, pairs, &env.memory), ICC_OK);
    ck_assert_int_eq(iccp_triangulate_walls(N, points, &walls, &bounds, triangles, twins, &n, &env),
                     ICC_ERR_TOPOLOGY);
    iccp_walls_free(&bounds, &env.memory);
    iccp_walls_free(&walls, &env.memory);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("triangulate");
    TCase *tests = tcase_create("triangulate");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, smallest);
    tcase_add_test(tests, stars);
    tcase_add_test(tests, combs);
    tcase_add_test(tests, spirals);
    tcase_add_test(tests, lattices);
    tcase_add_test(tests, points_on_diagonals);
    tcase_add_test(tests, points_close_to_the_polygon);
    tcase_add_test(tests, tangles);
    tcase_add_test(tests, long_edges);
    tcase_add_test(tests, clusters);
    tcase_add_test(tests, every_scale);
    tcase_add_test(tests, many_points);
    tcase_add_test(tests, accepts_exactly_what_is_good);
    tcase_add_test(tests, every_allocation_may_fail);
    tcase_add_test(tests, can_be_cancelled);
    tcase_add_test(tests, refusals_name_the_culprit);
    tcase_add_test(tests, walls_and_bounds);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
