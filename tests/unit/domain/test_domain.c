/* Polygon domains against brute force in 64-bit integers: which polygons are accepted, what is
 * listed of the others, and where points lie. */
#include "domain/domain.h"
#include "geometry/avl.h"
#include "geometry/crossings.h"
#include "geometry/locate.h"
#include "geometry/simple.h"
#include "geometry/sweep.h"
#include "icc/icc.h"

#include "../../default_env.h"
#include "../../random.h"
#include "../../share.h"
#include "../../suite.h"

#include "features.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_N = 4096, MAX_DEFECTS = 4096 };

static random_source source = {1};

static int32_t below(int32_t n)
{
    return (int32_t)(random_bits(&source) % (uint64_t)n);
}

static double unit(void)
{
    return random_unit(&source);
}

/* ------------------------------------------------ brute force on integers */

typedef struct shape {
    int n;
    spot at[MAX_N];
} shape;

typedef struct defects {
    size_t n;
    int32_t kinds[MAX_DEFECTS];
    uint32_t items[2 * MAX_DEFECTS];
} defects;

static spot vertex(const shape *s, int i)
{
    return s->at[i % s->n];
}

static void add(defects *d, int32_t kind, int a, int b)
{
    if (d->n < MAX_DEFECTS) {
        d->kinds[d->n] = kind;
        d->items[2 * d->n] = (uint32_t)a;
        d->items[2 * d->n + 1] = (uint32_t)b;
    }
    ++d->n;
}

/* By the ends that lie on the other edge: if the edges share one, two different ones overlap. */
static int32_t slow_meet(const shape *s, int e, int f)
{
    const spot a = vertex(s, e), b = vertex(s, e + 1), c = vertex(s, f), d = vertex(s, f + 1);
    if ((e + 1) % s->n == f || (f + 1) % s->n == e || same(a, b) || same(c, d))
        return 0;
    const spot ends[4] = {a, b, c, d};
    spot shared[4];
    int n_shared = 0;
    for (int i = 0; i < 4; ++i)
        if (on(a, b, ends[i]) && on(c, d, ends[i]) && !(n_shared > 0 && same(shared[0], ends[i])))
            shared[n_shared++] = ends[i];
    if (same(a, c) || same(a, d) || same(b, c) || same(b, d))
        return n_shared > 1 ? ICC_DEFECT_TOUCH : 0;
    if (n_shared > 0)
        return ICC_DEFECT_TOUCH;
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0
               ? ICC_DEFECT_CROSSING
               : 0;
}

static bool slow_flat(const shape *s)
{
    for (int i = 0; i < s->n; ++i)
        for (int j = 0; j < s->n; ++j)
            if (turn(s->at[0], s->at[i], s->at[j]) != 0)
                return false;
    return true;
}

static bool slow_spike(const shape *s, int i)
{
    const spot p = vertex(s, i + s->n - 1), v = vertex(s, i), q = vertex(s, i + 1);
    return !same(p, v) && !same(q, v) && turn(p, v, q) == 0 &&
           (p.x - v.x) * (q.x - v.x) + (p.y - v.y) * (q.y - v.y) > 0;
}

static void slow_defects(defects *d, const shape *s)
{
    d->n = 0;
    if (slow_flat(s))
        add(d, ICC_DEFECT_FLAT, 0, 0);
    for (int a = 0; a < s->n; ++a) {
        if (slow_spike(s, a))
            add(d, ICC_DEFECT_SPIKE, a, a);
        bool repeated = false;
        for (int b = a + 1; b < s->n; ++b) {
            if (!repeated && same(s->at[a], s->at[b])) {
                add(d, ICC_DEFECT_REPEATED, a, b);
                repeated = true;
            }
            const int32_t kind = slow_meet(s, a, b);
            if (kind != 0)
                add(d, kind, a, b);
        }
    }
}

static int32_t slow_where(const shape *s, spot p)
{
    bool inside = false;
    for (int i = 0; i < s->n; ++i) {
        const spot a = vertex(s, i), b = vertex(s, i + 1);
        if (on(a, b, p))
            return ICC_BOUNDARY;
        if ((a.y > p.y) != (b.y > p.y))
            inside ^= (turn(a, b, p) > 0) == (b.y > a.y);
    }
    return inside ? ICC_INSIDE : ICC_OUTSIDE;
}

/* --------------------------------------------------------------- helpers */

static void to_doubles(const shape *s, double scale, double x, double y, double *out)
{
    for (int i = 0; i < s->n; ++i) {
        out[2 * i] = scale * (double)s->at[i].x + x;
        out[2 * i + 1] = scale * (double)s->at[i].y + y;
    }
}

static icc_status create_polygon(icc_domain **out, size_t n, const double *points, icc_error *err)
{
    *err = (icc_error){.size = sizeof *err};
    return icc_domain_create(out, 2, n, points, 0, NULL, NULL, err);
}

static void list(defects *d, size_t n, const double *points)
{
    const icc_status status =
        icc_boundary_defects(n, points, MAX_DEFECTS, d->kinds, d->items, &d->n, NULL, NULL);
    ck_assert(status == ICC_OK);
}

/* icc_domain_create() names the first defect of the list. */
static void check_agreement(size_t n, const double *points, const defects *d)
{
    icc_domain *domain;
    icc_error err;
    const icc_status status = create_polygon(&domain, n, points, &err);
    ck_assert(status == (d->n == 0 ? ICC_OK : ICC_ERR_BOUNDARY));
    ck_assert((domain != NULL) == (status == ICC_OK));
    icc_domain_free(domain);
    if (status == ICC_OK)
        return;
    const int64_t a = d->items[0], b = d->items[1];
    const int32_t kind = d->kinds[0];
    ck_assert(err.index == (kind == ICC_DEFECT_FLAT ? -1 : kind == ICC_DEFECT_REPEATED ? b : a));
    static const char *const words[] = {"",      "finite", "repeats", "back over",
                                        "cross", "touch",  "line"};
    ck_assert_msg(strstr(err.message, words[kind]) != NULL, "%d: %s", kind, err.message);
}

/* The quick test of n points, the first of which follow once more. */
static iccp_simple find_simple(size_t n, const double *points)
{
    const iccp_env env = default_env();
    iccp_simple quick;
    ck_assert(iccp_simple_find(&quick, points, n, &env) == ICC_OK);
    return quick;
}

/* The number of the first defect but that all points lie on one line. */
static size_t first_number(const defects *d)
{
    const size_t k = d->kinds[0] == ICC_DEFECT_FLAT;
    ck_assert(d->n > k);
    return d->items[2 * k];
}

static bool has_empty_edge(const shape *s)
{
    for (int i = 0; i < s->n; ++i)
        if (same(vertex(s, i), vertex(s, i + 1)))
            return true;
    return false;
}

/* The quick test, unless it gives up, and the sweep. */
static void check_tests(const shape *s, const defects *list)
{
    static double points[2 * MAX_N + 2];
    const iccp_env env = default_env();
    const bool expected = list->n == 0;
    const size_t n = (size_t)s->n;
    const iccp_polygon polygon = {.n = n, .points = points};
    iccp_defect found;
    to_doubles(s, 1, 0, 0, points);
    points[2 * n] = points[0];
    points[2 * n + 1] = points[1];
    const iccp_simple quick = find_simple(n, points);
    if (quick.answer == ICCP_UNDECIDED)
        ck_assert(quick.n_tests > ICCP_SIMPLE_TESTS * n || quick.n_pairs > ICCP_SIMPLE_PAIRS * n);
    else
        ck_assert((quick.answer == ICCP_SIMPLE) == expected);
    if (quick.answer != ICCP_NOT_SIMPLE || has_empty_edge(s))
        ck_assert(quick.first == n);
    else
        ck_assert(quick.first == first_number(list));
    ck_assert(iccp_sweep(&found, &polygon, &env) == ICC_OK);
    ck_assert((found.kind == 0) == expected);
}

static void check_shape(const shape *s, double scale, double x, double y)
{
    static double points[2 * MAX_N];
    static defects expected, got;
    to_doubles(s, scale, x, y, points);
    slow_defects(&expected, s);
    if (s->n >= 3)
        check_tests(s, &expected);
    list(&got, (size_t)s->n, points);
    ck_assert(got.n == expected.n);
    ck_assert(memcmp(got.kinds, expected.kinds, got.n * sizeof *got.kinds) == 0);
    ck_assert(memcmp(got.items, expected.items, 2 * got.n * sizeof *got.items) == 0);
    if (s->n >= 3)
        check_agreement((size_t)s->n, points, &got);
}

/* ---------------------------------------------------------- what is wrong */

START_TEST(test_known_defects)
{
    static const struct {
        size_t n;
        double points[16];
        const char *text;
        int64_t index;
    } cases[] = {
        {4, {0, 0, 2, 2, 2, 0, 0, 2}, "edges 0 and 2 cross near (1, 1)", 0},
        {5, {0, 0, 2, 0, 2, 0, 2, 2, 0, 2}, "vertex 2 repeats vertex 1", 2},
        {4, {0, 0, 2, 0, 0, 2, 0, 0}, "vertex 3 repeats vertex 0", 3},
        {4, {0, 0, 2, 0, HUGE_VAL, 2, 0, 1}, "vertex 2 is not finite", 2},
        {4, {0, 0, 2, 0, 2, 2, 0, -HUGE_VAL}, "vertex 3 is not finite", 3},
        {4, {0, 0, 1, 1, 3, 3, 2, 2}, "all vertices lie on one line: the shape has no area", -1},
        {3, {5, 5, 5, 5, 5, 5}, "all vertices lie on one line: the shape has no area", -1},
        {1, {3, 4}, "a polygon needs at least 3 vertices, not 1", -1},
        {2, {3, 4, 5, 6}, "a polygon needs at least 3 vertices, not 2", -1},
        {0, {0}, "a polygon needs at least 3 vertices, not 0", -1},
        {5, {0, 0, 4, 0, 4, 4, 2, 4, 4, 4}, "vertex 4 repeats vertex 2", 4},
        {4, {0, 0, 4, 0, 2, 0, 0, 4}, "edges 0 and 2 touch near (2, 0)", 0},
        {5, {0, 0, 4, 0, 4, 3, 2, 0, 0, 3}, "edges 0 and 2 touch near (2, 0)", 0},
        {6, {0, 0, 2, 2, 4, 0, 4, 4, 2, 2, 0, 4}, "vertex 4 repeats vertex 1", 4},
        {5, {0, 0, 1, 0, 3, 1, 2, 0, 4, 0}, "at vertex 0 the boundary runs back over itself", 0},
        {6, {0, 0, 3, 0, 3, 3, 2, 0, 1, 0, 0, 3}, "edges 0 and 2 touch near (2, 0)", 0},
        {3,
         {1e300, 0, 0, 1e300, 1, 1},
         "vertex 2 (1, 1): a coordinate is not 0, but less than 2^-200 "
         "of the largest one",
         2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        icc_domain *domain = (icc_domain *)&source;
        icc_error err;
        ck_assert_int_eq(create_polygon(&domain, cases[i].n, cases[i].points, &err),
                         ICC_ERR_BOUNDARY);
        ck_assert_ptr_null(domain);
        ck_assert_str_eq(err.message, cases[i].text);
        ck_assert_int_eq(err.index, cases[i].index);
        ck_assert_int_eq(err.item, err.index < 0           ? ICC_ITEM_NONE
                                   : err.message[0] == 'e' ? ICC_ITEM_FACET
                                                           : ICC_ITEM_VERTEX);
        ck_assert_int_eq(err.status, ICC_ERR_BOUNDARY);
    }
}
END_TEST

START_TEST(test_list_of_not_finite)
{
    const double nan = HUGE_VAL - HUGE_VAL;
    const double points[] = {0, 0, nan, 1, 2, 2, 1, HUGE_VAL, 2, 0, 0, 2};
    defects d;
    list(&d, 6, points);
    ck_assert_uint_eq(d.n, 2);
    ck_assert(d.kinds[0] == ICC_DEFECT_NOT_FINITE && d.items[0] == 1 && d.items[1] == 1);
    ck_assert(d.kinds[1] == ICC_DEFECT_NOT_FINITE && d.items[2] == 3 && d.items[3] == 3);
    const double none[] = {nan, 0, 0, nan, nan, nan};
    list(&d, 3, none);
    ck_assert_uint_eq(d.n, 4);
    ck_assert_int_eq(d.kinds[0], ICC_DEFECT_FLAT);
    list(&d, 0, NULL);
    ck_assert_uint_eq(d.n, 1);
    size_t n = 0;
    const double small[] = {1e300, 0, 0, 1e300, 1, 1};
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_boundary_defects(3, small, 0, NULL, NULL, &n, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.index, 2);
}
END_TEST

/* The list is cut off at `capacity`, its length is not. */
START_TEST(test_list_capacity)
{
    const double points[] = {0, 0, 2, 2, 2, 0, 0, 2, 1, 1, 3, 1, 1, 5};
    defects all, some;
    list(&all, 7, points);
    ck_assert_uint_gt(all.n, 3);
    for (size_t capacity = 0; capacity <= all.n; ++capacity) {
        memset(&some, 0x7f, sizeof some);
        ck_assert_int_eq(
            icc_boundary_defects(7, points, capacity, some.kinds, some.items, &some.n, NULL, NULL),
            ICC_OK);
        ck_assert_uint_eq(some.n, all.n);
        ck_assert_int_eq(memcmp(some.kinds, all.kinds, capacity * sizeof *all.kinds), 0);
        ck_assert_int_eq(memcmp(some.items, all.items, 2 * capacity * sizeof *all.items), 0);
        ck_assert_int_eq(some.kinds[capacity], 0x7f7f7f7f);
    }
}
END_TEST

/* Of a star all of whose edges cross the list ends where the header says. */
START_TEST(test_list_ends)
{
    enum { N = 1201 };
    static double points[2 * N];
    size_t n;
    for (size_t k = 0; k < N; ++k) {
        const double angle = 6.283185307179586 * (double)(k * (N / 2) % N) / N;
        points[2 * k] = cos(angle);
        points[2 * k + 1] = sin(angle);
    }
    ck_assert_int_eq(icc_boundary_defects(N, points, 0, NULL, NULL, &n, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(n, 10000 + 4 * N);
}
END_TEST

/* Small grids make every degeneracy frequent. */
START_TEST(test_random_integers)
{
    static shape s;
    int n_simple = 0;
    for (int round = 0; round < share_of(60000); ++round) {
        s.n = 1 + below(round % 100 == 0 ? 60 : 9);
        const int32_t side = 2 + below(round % 100 == 0 ? 40 : 5);
        for (int i = 0; i < s.n; ++i)
            s.at[i] = (spot){below(side), below(side)};
        defects d;
        slow_defects(&d, &s);
        n_simple += d.n == 0;
        switch (round % 4) {
        case 0:
            check_shape(&s, 1, 0, 0);
            break;
        case 1:
            check_shape(&s, 0x1p-1074, 0, 0);
            break;
        case 2:
            check_shape(&s, 0x1p1015, 0, 0);
            break;
        default:
            check_shape(&s, 0.125, 1e9, -1e15);
            break;
        }
    }
    ck_assert_int_gt(n_simple, share_of(1000));
}
END_TEST

/* --------------------------------------------------------- simple shapes */

/* Walks round a random tree of grid cells: many collinear corners and close neighbours. */
static void make_maze(shape *s, int32_t cells)
{
    enum { N_ROOMS = 40 };
    static bool full[2 * N_ROOMS + 3][2 * N_ROOMS + 3];
    memset(full, 0, sizeof full);
    int32_t x = N_ROOMS, y = N_ROOMS;
    full[y][x] = true;
    while (cells > 0) {
        const int32_t dx = below(2) == 0 ? 0 : below(2) * 2 - 1;
        const int32_t dy = dx != 0 ? 0 : below(2) * 2 - 1;
        const int32_t nx = x + 2 * dx, ny = y + 2 * dy;
        if (nx < 1 || ny < 1 || nx > 2 * N_ROOMS || ny > 2 * N_ROOMS)
            continue;
        if (!full[ny][nx]) {
            full[ny][nx] = full[y + dy][x + dx] = true;
            --cells;
        } else if (!full[y + dy][x + dx]) {
            continue;
        }
        x = nx;
        y = ny;
    }
    /* Follow the outline with the shape on the left, from below a cell of the lowest row. */
    int32_t cx = 0, cy = 0, dx = 1, dy = 0;
    while (!full[cy][cx])
        if (++cx > 2 * N_ROOMS + 1) {
            cx = 0;
            ++cy;
        }
    const int32_t sx = cx, sy = cy;
    s->n = 0;
    do {
        s->at[s->n++] = (spot){cx, cy};
        cx += dx;
        cy += dy;
        const int32_t lx = -dy, ly = dx; /* left */
        const bool left = full[cy + (dy + ly - 1) / 2][cx + (dx + lx - 1) / 2];
        const bool right = full[cy + (dy - ly - 1) / 2][cx + (dx - lx - 1) / 2];
        if (right) {
            const int32_t t = dx;
            dx = dy;
            dy = -t;
        } else if (!left) {
            const int32_t t = dx;
            dx = -dy;
            dy = t;
        }
    } while ((cx != sx || cy != sy) && s->n < MAX_N);
    ck_assert_int_lt(s->n, MAX_N);
}

/* Teeth along a direction: (1, 1) makes the boxes of all edges overlap. */
static void make_comb(shape *s, int teeth, int64_t length, int64_t dx, int64_t dy)
{
    s->n = 0;
    for (int i = 0; i < teeth; ++i) {
        s->at[s->n++] = (spot){-dy * 2 * i, dx * 2 * i};
        s->at[s->n++] = (spot){dx * length - dy * (2 * i + 1), dy * length + dx * (2 * i + 1)};
    }
    s->at[s->n++] = (spot){-dx * 2 - dy * 2 * teeth, -dy * 2 + dx * 2 * teeth};
    s->at[s->n++] = (spot){-dx * 2, -dy * 2};
}

/* A band that winds round the origin. */
static void make_spiral(shape *s, int turns)
{
    static const spot way[4] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    s->n = 0;
    for (int i = 0; i < 4 * turns; ++i)
        s->at[s->n++] = (spot){way[i % 4].x * (10 + 4 * (i / 4 + (i % 4 == 3))),
                               way[i % 4].y * (10 + 4 * (i / 4 + (i % 4 >= 2)))};
    for (int i = 4 * turns; i-- > 0;) {
        const spot outer = s->at[i];
        s->at[s->n++] = (spot){outer.x - way[i % 4].x, outer.y - way[i % 4].y};
    }
}

static void make_star(shape *s, int n)
{
    s->n = n;
    for (int i = 0; i < n; ++i) {
        const double angle = 6.283185307179586 * i / n, radius = 1000 + 100000 * unit();
        s->at[i] = (spot){(int64_t)(radius * cos(angle)), (int64_t)(radius * sin(angle))};
    }
}

static void make_any(shape *s, int round)
{
    switch (round % 6) {
    case 0:
        make_maze(s, 1 + below(150));
        break;
    case 1:
        make_comb(s, 2 + below(60), 1 + below(400), 1, 1);
        break;
    case 2:
        make_comb(s, 2 + below(60), 1 + below(400), 0, 1);
        break;
    case 3:
        make_comb(s, 2 + below(60), 1 + below(400), 1 + below(5), -below(5));
        break;
    case 4:
        make_spiral(s, 1 + below(12));
        break;
    default:
        make_star(s, 3 + below(150));
        break;
    }
}

/* Simple shapes as they are, turned about, and with one or two vertices moved. */
START_TEST(test_shapes)
{
    static shape s;
    int n_simple = 0, n_spoilt = 0;
    defects d;
    for (int round = 0; round < share_of(600); ++round) {
        make_any(&s, round);
        slow_defects(&d, &s);
        ck_assert_msg(round % 6 == 5 || d.n == 0, "round %d is not simple", round);
        n_simple += d.n == 0;
        check_shape(&s, 1, 0, 0);
        check_shape(&s, 8, -3e15, 0);
        for (int i = 0, j = s.n - 1; i < j; ++i, --j) {
            const spot t = s.at[i];
            s.at[i] = s.at[j];
            s.at[j] = t;
        }
        check_shape(&s, 0x1p600, 0, 0);
        const int32_t moved = below(s.n), other = below(s.n);
        if (round % 2 == 0)
            s.at[moved] = (spot){s.at[moved].x + below(7) - 3, s.at[moved].y + below(7) - 3};
        else
            s.at[moved] = s.at[other];
        slow_defects(&d, &s);
        n_spoilt += d.n > 0;
        check_shape(&s, 1, 0, 0);
    }
    ck_assert_int_gt(n_simple, share_of(500));
    ck_assert_int_gt(n_spoilt, share_of(300));
}
END_TEST

static spot polar_spot(double radius, double angle)
{
    return (spot){(int64_t)(radius * cos(angle)), (int64_t)(radius * sin(angle))};
}

/* Long stretches that lead one way: round outlines, windings, stairs with flat and steep parts. */
static void make_long(shape *s, int kind, int n)
{
    const double turn = 6.283185307179586;
    s->n = n;
    for (int i = 0; i < n; ++i) {
        const double angle = turn * i / n, half = 8 * turn * (i < n / 2 ? i : n - 1 - i) / n;
        if (kind == 0)
            s->at[i] = polar_spot(1e5 * (1 + 0.5 * sin(3 * angle) + 0.1 * sin(11 * angle)), angle);
        else if (kind == 1)
            s->at[i] = polar_spot(1e4 * ((i < n / 2 ? 1 : 3) + half), half);
        else
            s->at[i] = i == 0 ? (spot){0, 0} : s->at[i - 1];
        if (kind == 2 && i + 1 < n)
            *(below(2) == 0 ? &s->at[i].x : &s->at[i].y) += 2 + 2 * below(9);
        if (kind == 2 && i + 1 == n)
            s->at[i] = (spot){-2 - 2 * below(3), s->at[i].y + 2 * below(3)};
    }
}

/* Begins elsewhere, and another way round or up. */
static void turn_about(shape *s)
{
    static shape old;
    const int start = below(s->n), way = below(2), swap = below(2), sign = 1 - 2 * below(2);
    old = *s;
    for (int i = 0; i < s->n; ++i) {
        const spot p = vertex(&old, way == 0 ? start + i : start + s->n - i);
        s->at[i] = swap == 0 ? (spot){sign * p.x, p.y} : (spot){p.y, sign * p.x};
    }
}

/* Makes vertices meet others, or edges, or a whole stretch run along another. */
static void make_touch(shape *s, int way)
{
    const int a = below(s->n), b = below(s->n), reach = way < 2 ? 1 : 1 + below(5);
    for (int i = 0; i < reach; ++i) {
        const spot p = vertex(s, b + i), q = vertex(s, b + i + 1);
        spot *v = &s->at[(way == 3 ? a + s->n - i : a + i) % s->n];
        *v = way == 0 ? (spot){(p.x + q.x) / 2, (p.y + q.y) / 2} : p;
    }
}

/* Chains of many edges, whole and touching themselves. */
START_TEST(test_chains)
{
    static shape s;
    defects d;
    int n_simple[3] = {0}, n_spoilt[4] = {0};
    for (int round = 0; round < share_of(1200); ++round) {
        make_long(&s, round % 3, 12 + below(round % 40 == 0 ? 900 : 120));
        turn_about(&s);
        slow_defects(&d, &s);
        n_simple[round % 3] += d.n == 0;
        check_shape(&s, 1, 0, 0);
        make_touch(&s, round % 4);
        slow_defects(&d, &s);
        n_spoilt[round % 4] += d.n > 0;
        check_shape(&s, 1, 0, 0);
    }
    for (int kind = 0; kind < 3; ++kind)
        ck_assert_int_gt(n_simple[kind], share_of(1200) / 5);
    for (int way = 0; way < 4; ++way)
        ck_assert_int_gt(n_spoilt[way], share_of(1200) / 5);
}
END_TEST

/* A slit one unit in the last place wide is open; of width zero it is not. */
START_TEST(test_slit)
{
    for (int direction = -1; direction <= 1; ++direction) {
        const double tip = direction == 0 ? 1.0 / 3 : nextafter(1.0 / 3, direction);
        const double points[] = {0, 0, 1, 0, 1, 1.0 / 3, 0.25,  tip,
                                 1, 1, 0, 1, 0, 1.0 / 3, 0.125, 1.0 / 3};
        const double touching[] = {0, 0, 1, 0, 1, 1, 0.5, tip, 0, 1, 0, 1.0 / 3, 0.75, 1.0 / 3};
        icc_domain *domain;
        icc_error err;
        ck_assert_int_eq(create_polygon(&domain, 6, points, &err), ICC_OK);
        icc_domain_free(domain);
        const icc_status status = create_polygon(&domain, 7, touching, &err);
        ck_assert_int_eq(status, direction > 0 ? ICC_OK : ICC_ERR_BOUNDARY);
        icc_domain_free(domain);
        defects d;
        list(&d, 7, touching);
        ck_assert_int_eq(d.n == 0, direction > 0);
        ck_assert(direction != 0 || (d.kinds[0] == ICC_DEFECT_TOUCH && d.n == 2));
    }
}
END_TEST

/* Moves everything by at most one unit in the last place: sweep and list, which look at different
 * pairs of edges, must still say the same. */
START_TEST(test_nearly_degenerate)
{
    static shape s;
    static double points[2 * MAX_N];
    static defects d;
    int n_simple = 0, n_rounds = 20000;
    for (int round = 0; round < n_rounds; ++round) {
        if (round % 16 == 0) {
            make_maze(&s, 1 + below(20));
        } else {
            s.n = 3 + below(6);
            for (int i = 0; i < s.n; ++i)
                s.at[i] = (spot){below(4), below(4)};
        }
        to_doubles(&s, 1.0 / 3, round % 2 == 0 ? 0 : 0.7, 0, points);
        for (int i = 0; i < 2 * s.n; ++i)
            points[i] = below(2) == 0 ? points[i] : nextafter(points[i], below(2) == 0 ? 9 : -9);
        for (int i = 0; i < 2 * s.n; ++i)
            points[i] = fabs(points[i]) < 1e-20 ? 0 : points[i];
        list(&d, (size_t)s.n, points);
        check_agreement((size_t)s.n, points, &d);
        n_simple += d.n == 0;
    }
    ck_assert(n_simple > n_rounds / 20 && n_simple < n_rounds / 2);
}
END_TEST

/* ------------------------------------------------------------------- work */

enum { MANY = 1 << 15 };

static double many[2 * MANY + 2];

static void set(size_t i, double x, double y)
{
    many[2 * i] = x;
    many[2 * i + 1] = y;
}

static void set_polar(size_t i, double radius, double angle)
{
    set(i, radius * cos(angle), radius * sin(angle));
}

enum { SMOOTH, ROUGH, WINDING, STAIRS, TEETH, ROWS, FAN, DIAGONAL, SLANTED, N_KINDS };

/* Polygons of n points, n a multiple of 4. From FAN on most edges lie in the boxes of most others. */
static void make_many(int kind, size_t n)
{
    const double turn = 6.283185307179586, step = 1 / (double)n;
    for (size_t i = 0; i < n; ++i) {
        const bool last = i + 1 == n, inner = i + 2 < n;
        const double a = turn * (double)i * step, odd = (double)(i % 2);
        const size_t half = i < n / 2 ? i : n - 1 - i;
        const double shift = i < n / 2 ? 0 : 4;
        switch (kind) {
        case SMOOTH:
            set_polar(i, 1 + 0.5 * sin(7 * a), a);
            break;
        case ROUGH:
            set_polar(i, 1 + 0.5 * sin(7 * a) + 20 * unit() * step, a);
            break;
        case WINDING: {
            const double b = turn * fmin(30, (double)n / 128) * 2 * step * (double)half;
            set_polar(i, 1 + shift / 2 + b, b);
            break;
        }
        case STAIRS: /* two, one beside the other */
            set(i, (double)(half / 2) + shift, (double)((half + 1) / 2));
            break;
        case TEETH:
            set(i, inner ? (double)i : last ? -1 : (double)n, inner ? odd : -9);
            break;
        case ROWS:
            set(i, inner ? odd : -1, inner ? (double)i * step : last ? -step : 1);
            break;
        case FAN:
            set_polar(i, i % 2 == 0 ? 1 : 1e-3, a);
            break;
        default: {
            const double dx = kind == DIAGONAL ? 1 : 3, u = inner ? odd : -0.01;
            const double v = inner ? (double)(i / 2) * step : last ? 0 : 1;
            set(i, dx * u - v, u + dx * v);
        }
        }
    }
    set(n, many[0], many[1]);
}

/* Ordinary polygons take a number of tests in proportion to n, and spirals that have a few hundred
 * edges a turn. The search gives up between two leaves, of which one is compared with at most 4 n
 * edges. */
START_TEST(test_work)
{
    for (int kind = 0; kind < N_KINDS; ++kind)
        for (size_t n = 1 << 9; n <= MANY; n *= 4) {
            icc_domain *domain;
            make_many(kind, n);
            const iccp_simple quick = find_simple(n, many);
            const bool easy = kind < FAN, dense = kind == WINDING && n < MANY;
            ck_assert_msg(dense || quick.answer == (easy ? ICCP_SIMPLE : ICCP_UNDECIDED),
                          "kind %d, %zu points: %d after %zu tests", kind, n, quick.answer,
                          quick.n_tests);
            ck_assert_uint_le(quick.n_tests, (ICCP_SIMPLE_TESTS + 32) * n);
            ck_assert_uint_le(quick.n_pairs, (ICCP_SIMPLE_PAIRS + 4) * n);
            ck_assert_int_eq(icc_domain_create(&domain, 2, n, many, 0, NULL, NULL, NULL), ICC_OK);
            icc_domain_free(domain);
        }
}
END_TEST

/* ---------------------------------------------------------------- facets */

START_TEST(test_facets)
{
    const double points[] = {0, 0, 1, 1, 1, 0, 0, 1, -1, 0.5};
    const uint32_t good[] = {1, 3, 0, 2, 4, 0, 2, 1, 3, 4};
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_create(&domain, 2, 5, points, 5, good, NULL, &err), ICC_OK);
    icc_domain_info info = {.size = sizeof info};
    icc_domain_get_info(domain, &info);
    ck_assert_int_eq(info.orientation, 1);
    double vertices[10];
    uint32_t facets[10];
    ck_assert_int_eq(icc_domain_get_boundary(domain, vertices, facets), ICC_OK);
    ck_assert_int_eq(memcmp(vertices, points, sizeof points), 0);
    ck_assert_int_eq(memcmp(facets, good, sizeof good), 0);
    /* The middle of each facet is found on it. */
    for (uint32_t f = 0; f < 5; ++f) {
        const double *a = points + 2 * good[2 * f], *b = points + 2 * good[2 * f + 1];
        const double middle[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
        int32_t where;
        uint32_t facet;
        double bary[2];
        icc_domain_locate(domain, 1, middle, &where, &facet, bary, NULL);
        ck_assert_int_eq(where, ICC_BOUNDARY);
        ck_assert_uint_eq(facet, f);
        ck_assert(bary[0] == 0.5 && bary[1] == 0.5);
    }
    icc_domain_free(domain);
    static const struct {
        uint32_t facets[10];
        int64_t index;
        const char *text;
    } bad[] = {
        {{0, 2, 2, 1, 1, 3, 3, 4, 4, 5}, 4, "facet 4 names vertex 5"},
        {{0, 2, 2, 1, 1, 3, 4, 3, 4, 0}, 4, "facets 3 and 4 both start at vertex 4"},
        {{0, 2, 2, 0, 1, 3, 3, 4, 4, 1}, 1, "not one ring"},
        {{0, 2, 2, 1, 1, 3, 3, 2, 4, 0}, 2, "not one ring"},
        {{0, 0, 2, 1, 1, 3, 3, 4, 4, 2}, 0, "not one ring"},
        {{0, 1, 1, 2, 2, 3, 3, 4, 4, 0}, 0, "edges 0 and 2 cross near (0.5, 0.5)"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        ck_assert_int_eq(icc_domain_create(&domain, 2, 5, points, 5, bad[i].facets, NULL, &err),
                         ICC_ERR_BOUNDARY);
        ck_assert_ptr_null(domain);
        ck_assert_msg(strstr(err.message, bad[i].text) != NULL, "%s", err.message);
        ck_assert_msg(i == 3 || err.index == bad[i].index, "%zu: %s", i, err.message);
    }
    ck_assert_int_eq(icc_domain_create(&domain, 2, 5, points, 4, good, NULL, &err),
                     ICC_ERR_BOUNDARY);
}
END_TEST

/* ---------------------------------------------------------------- locate */

static double edge_distance(const double *a, const double *b, const double *p)
{
    const double d[2] = {b[0] - a[0], b[1] - a[1]};
    double t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(a[0] + t * d[0] - p[0], a[1] + t * d[1] - p[1]);
}

static double reach(const double *points, int n, int edge, const double *p)
{
    return edge_distance(points + 2 * edge, points + 2 * ((edge + 1) % n), p);
}

static void check_nearest(const double *points, int n, const double *p, uint32_t facet,
                          const double *bary, double size)
{
    double least = HUGE_VAL;
    for (int e = 0; e < n; ++e)
        least = fmin(least, reach(points, n, e, p));
    ck_assert((int)facet < n);
    const double *a = points + 2 * facet, *b = points + 2 * ((facet + 1) % (uint32_t)n);
    const double at[2] = {bary[0] * a[0] + bary[1] * b[0], bary[0] * a[1] + bary[1] * b[1]};
    ck_assert(bary[0] >= 0 && bary[1] >= 0 && bary[0] + bary[1] == 1);
    ck_assert(fabs(reach(points, n, (int)facet, p) - least) <= 1e-14 * size);
    ck_assert(fabs(hypot(at[0] - p[0], at[1] - p[1]) - least) <= 1e-14 * size);
}

/* What asks for an edge within reach finds the nearest one and none that is nearer. */
static void check_reach(const icc_domain *domain, const double *x)
{
    double p[2], t, distance2;
    iccp_frame_in(&domain->frame, 2, x, p);
    const iccp_boxtree *tree = &iccp_locator_trees(domain->locator)->edges;
    (void)iccp_boxtree_nearest(tree, p, &t, &distance2);
    ck_assert(iccp_boxtree_reaches(tree, p, distance2));
    ck_assert(iccp_boxtree_reaches(tree, p, 3 * distance2));
    ck_assert(!(distance2 > 0) || !iccp_boxtree_reaches(tree, p, nextafter(distance2, 0)));
    ck_assert(!(distance2 > 0) || !iccp_boxtree_reaches(tree, p, distance2 / 3));
}

/* Trees without boxes, for want of memory, answer the same. */
static void check_without_boxes(const icc_domain *domain, const double *x)
{
    const iccp_edge_trees *full = iccp_locator_trees(domain->locator),
                          *bare = &domain->locator->bare_trees;
    double p[2], t[2], distance2[2], bary[2][2], share[2];
    uint32_t facet[2] = {0, 0};
    iccp_frame_in(&domain->frame, 2, x, p);
    ck_assert(full->edges.boxes != NULL && bare->edges.boxes == NULL);
    ck_assert(iccp_boxtree_nearest(&full->edges, p, &t[0], &distance2[0]) ==
              iccp_boxtree_nearest(&bare->edges, p, &t[1], &distance2[1]));
    ck_assert(t[0] == t[1] && distance2[0] == distance2[1]);
    ck_assert(iccp_boxtree_reaches(&bare->edges, p, distance2[0]));
    ck_assert(!(distance2[0] > 0) || !iccp_boxtree_reaches(&bare->edges, p, distance2[0] / 3));
    ck_assert(iccp_facet_tree_nearest(&full->facets, p, bary[0], &distance2[0]) ==
              iccp_facet_tree_nearest(&domain->tree, p, bary[1], &distance2[1]));
    ck_assert(memcmp(bary[0], bary[1], sizeof bary[0]) == 0 && distance2[0] == distance2[1]);
    const bool crosses =
        iccp_segment_crossing(&full->facets, p, domain->vertices, &share[0], &facet[0]);
    ck_assert(crosses ==
              iccp_segment_crossing(&domain->tree, p, domain->vertices, &share[1], &facet[1]));
    ck_assert(!crosses || (share[0] == share[1] && facet[0] == facet[1]));
}

static void widen(int64_t *low, int64_t *high, int64_t x)
{
    *low = x < *low ? x : *low;
    *high = x > *high ? x : *high;
}

/* The cells, which locating a point makes. */
static const iccp_buckets *buckets_of(const icc_domain *domain)
{
    (void)iccp_domain_locate(domain, (double[]){0, 0}, true, NULL, NULL);
    const iccp_buckets *buckets = iccp_once_get(&domain->locator->buckets);
    ck_assert_ptr_nonnull(buckets);
    return buckets;
}

/* Points on a grid four times as fine as the shape's: on vertices, edges, and between. */
START_TEST(test_locate_exactly)
{
    static shape s, fine;
    static double points[2 * MAX_N];
    int n_points[4] = {0};
    for (int round = 0; round < share_of(300); ++round) {
        make_any(&s, round % 6 == 5 ? 4 : round);
        to_doubles(&s, 1, 0, 0, points);
        fine.n = s.n;
        int64_t low = 0, high = 0;
        for (int i = 0; i < s.n; ++i) {
            fine.at[i] = (spot){4 * s.at[i].x, 4 * s.at[i].y};
            widen(&low, &high, fine.at[i].x);
            widen(&low, &high, fine.at[i].y);
        }
        icc_domain *domain;
        icc_error err;
        ck_assert(create_polygon(&domain, (size_t)s.n, points, &err) == ICC_OK);
        for (int i = 0; i < 500; ++i) {
            spot p = {low - 4 + below((int32_t)(high - low + 8)),
                      low - 4 + below((int32_t)(high - low + 8))};
            const spot a = vertex(&fine, i), b = vertex(&fine, i + 1);
            const int64_t quarter = below(5);
            if (i % 3 == 0)
                p = (spot){a.x + (b.x - a.x) / 4 * quarter, a.y + (b.y - a.y) / 4 * quarter};
            const double x[2] = {(double)p.x / 4, (double)p.y / 4};
            int32_t where, again;
            uint32_t facet;
            double bary[2];
            icc_domain_locate(domain, 1, x, &where, &facet, bary, NULL);
            icc_domain_locate(domain, 1, x, &again, NULL, NULL, NULL);
            ck_assert(where == slow_where(&fine, p));
            ck_assert(where == again);
            ++n_points[where];
            check_nearest(points, s.n, x, facet, bary, (double)(high - low));
            check_reach(domain, x);
            check_without_boxes(domain, x);
            if (i % 3 == 0 && (quarter == 0 || quarter == 4))
                ck_assert(fmax(bary[0], bary[1]) == 1);
        }
        icc_domain_free(domain);
    }
    ck_assert(n_points[ICC_INSIDE] > share_of(5000) && n_points[ICC_BOUNDARY] > share_of(30000) &&
              n_points[ICC_OUTSIDE] > share_of(20000));
}
END_TEST

/* Vertices much closer together than the tolerance are still distinguished. */
START_TEST(test_clustered_vertices)
{
    double points[2 * 12];
    int n_simple = 0;
    for (int round = 0; round < share_of(20000); ++round) {
        const size_t n = 3 + (size_t)below(round % 2 == 0 ? 2 : 6);
        for (size_t i = 0; i < 2 * n; ++i)
            points[i] = (unit() - 0.5) * ldexp(1, -below(120));
        icc_domain *domain;
        icc_error err;
        if (create_polygon(&domain, n, points, &err) != ICC_OK)
            continue;
        ++n_simple;
        for (uint32_t i = 0; i < n; ++i)
            for (int nearest = 0; nearest < 2; ++nearest) {
                uint32_t facet;
                double bary[2];
                const double *p = domain->vertices + 2 * i;
                ck_assert(iccp_domain_locate(domain, p, nearest == 0, &facet, bary) ==
                          ICC_BOUNDARY);
                ck_assert((facet == i && bary[0] == 1 && bary[1] == 0) ||
                          ((facet + 1) % n == i && bary[0] == 0 && bary[1] == 1));
            }
        icc_domain_free(domain);
    }
    ck_assert_int_gt(n_simple, share_of(5000));
}
END_TEST

/* A vertex less than one unit in the last place from the middle of a slanting edge. */
START_TEST(test_vertex_near_edge)
{
    int n_simple = 0;
    for (int round = 0; round < share_of(20000); ++round) {
        const double slope = unit(), t = unit();
        double points[] = {0, 0, 1, slope, 1, 2, t, t * slope, 0, 2};
        icc_domain *domain;
        icc_error err;
        if (create_polygon(&domain, 5, points, &err) != ICC_OK) {
            points[7] = nextafter(points[7], 2);
            if (create_polygon(&domain, 5, points, &err) != ICC_OK)
                continue;
        }
        ++n_simple;
        int32_t where;
        uint32_t facet;
        double bary[2];
        icc_domain_locate(domain, 1, points + 6, &where, &facet, bary, NULL);
        ck_assert(where == ICC_BOUNDARY);
        ck_assert((facet == 2 && bary[1] == 1) || (facet == 3 && bary[0] == 1));
        icc_domain_free(domain);
    }
    ck_assert_int_gt(n_simple, share_of(15000));
}
END_TEST

/* Where edges pass from cell to cell of the buckets, points on either side of them and of the
 * cells' sides are on the boundary up to the tolerance and not beyond. */
START_TEST(test_sides_of_cells)
{
    static shape s;
    static double points[2 * MAX_N];
    for (int round = 0; round < share_of(60); ++round) {
        make_any(&s, round);
        to_doubles(&s, 1.0 / 7, 0.3, 1000, points);
        icc_domain *domain;
        icc_error err;
        if (create_polygon(&domain, (size_t)s.n, points, &err) != ICC_OK)
            continue;
        const iccp_buckets *b = buckets_of(domain);
        for (int i = 0; i < 1000; ++i) {
            const uint32_t e = (uint32_t)below(s.n);
            const double *p = domain->vertices + 2 * domain->facets[2 * e];
            const double *q = domain->vertices + 2 * domain->facets[2 * e + 1];
            const int axis = below(2);
            const double length = hypot(q[0] - p[0], q[1] - p[1]);
            const double first = floor((fmin(p[axis], q[axis]) - b->origin[axis]) * b->rate[axis]);
            const double side = b->origin[axis] + (first + 1) * b->step[axis];
            const double t = (side - p[axis]) / (q[axis] - p[axis]);
            if (!(t > 0.01 && t < 0.99))
                continue;
            const double off = 1.8 * (unit() - 0.5) * domain->band.tolerance,
                         along = 1e-15 * (unit() - 0.5);
            double x[2] = {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])};
            x[axis] = side;
            x[0] += along * (q[0] - p[0]) / length - off * (q[1] - p[1]) / length;
            x[1] += along * (q[1] - p[1]) / length + off * (q[0] - p[0]) / length;
            ck_assert(iccp_domain_locate(domain, x, true, NULL, NULL) == ICC_BOUNDARY);
        }
        icc_domain_free(domain);
    }
}
END_TEST

/* An edge through the point of a cell for which the answer would be known. */
START_TEST(test_edge_through_known_point)
{
    double points[] = {0, 0, 1, 0, 1, 1, 0.6, 1, 0.5, 0.25, 0.5, 1, 0, 1};
    double x = 0.5;
    for (int round = 0; round < 2; ++round) {
        points[8] = points[10] = x;
        icc_domain *domain;
        icc_error err;
        ck_assert_int_eq(create_polygon(&domain, 7, points, &err), ICC_OK);
        for (int i = 0; i < 20000; ++i) {
            const double p[2] = {x + 0.2 * (unit() - 0.5), unit()};
            int32_t where;
            icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL);
            const double right = x + (0.6 - x) * (p[1] - 0.25) / 0.75;
            if (fabs(p[0] - right) > 1e-9 && fabs(p[0] - x) > 1e-9)
                ck_assert(where ==
                          (p[1] > 0.25 && p[0] > x && p[0] < right ? ICC_OUTSIDE : ICC_INSIDE));
        }
        /* The next edge goes where this grid has such a point; the grid stays the same. */
        const iccp_buckets *b = buckets_of(domain);
        const double scale = domain->frame.out[0] * domain->frame.out[1];
        const double column = floor((0.5 / scale - b->origin[0]) * b->rate[0]) + 0.5;
        x = (b->origin[0] + column * b->step[0]) * scale;
        icc_domain_free(domain);
    }
    ck_assert(x == points[8]);
}
END_TEST

/* Wherever the shape lies and however large it is, the same points lie inside. Points are spaced by
 * what the coarsest of the placements can tell apart. */
START_TEST(test_invariance)
{
    static const struct {
        double scale, x, y;
    } places[] = {{1, 0, 0},         {0x1p-1060, 0, 0}, {0x1p990, 0, 0}, {0x1p-10, 1e8, -1e8},
                  {1, 1e11, 0x1p36}, {0x1p14, 0, 1e15}, {0x1p-1, -7, 3}};
    enum { PLACES = sizeof places / sizeof places[0] };
    static shape s;
    static double points[2 * MAX_N];
    for (int round = 0; round < share_of(120); ++round) {
        make_any(&s, round);
        icc_domain *domains[PLACES];
        icc_error err;
        for (int k = 0; k < PLACES; ++k) {
            to_doubles(&s, places[k].scale, places[k].x, places[k].y, points);
            if (create_polygon(&domains[k], (size_t)s.n, points, &err) != ICC_OK)
                ck_assert(round % 6 == 5);
        }
        for (int i = 0; i < 200 && domains[0] != NULL; ++i) {
            const spot near = vertex(&s, i);
            const double p[2] = {(double)near.x + 0.25 * (below(41) - 20),
                                 (double)near.y + 0.25 * (below(41) - 20)};
            int32_t first = 0;
            double bary[2];
            for (int k = 0; k < PLACES; ++k) {
                const double q[2] = {places[k].scale * p[0] + places[k].x,
                                     places[k].scale * p[1] + places[k].y};
                int32_t where;
                uint32_t facet;
                icc_domain_locate(domains[k], 1, q, &where, &facet, bary, NULL);
                first = k == 0 ? where : first;
                ck_assert(where == first);
            }
        }
        for (int k = 0; k < PLACES; ++k)
            icc_domain_free(domains[k]);
    }
}
END_TEST

/* On both sides of an edge points up to 1e-14 of the box count as on it. */
START_TEST(test_tolerance)
{
    const double square[] = {0, 0, 8, 0, 8, 8, 0, 8};
    icc_domain *domain;
    icc_error err;
    ck_assert_int_eq(create_polygon(&domain, 4, square, &err), ICC_OK);
    for (int k = -40; k <= 40; ++k) {
        const double p[4] = {3, 8e-14 * (k / 10.0), 8e-14 * (k / 10.0), 5};
        const int32_t expected = k < -10 ? ICC_OUTSIDE : k > 10 ? ICC_INSIDE : ICC_BOUNDARY;
        int32_t where[2];
        icc_domain_locate(domain, 2, p, where, NULL, NULL, NULL);
        if (abs(k) != 10)
            ck_assert(where[0] == expected && where[1] == expected);
    }
    icc_domain_free(domain);
}
END_TEST

START_TEST(test_odd_points)
{
    const double nan = HUGE_VAL - HUGE_VAL;
    const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    const double odd[] = {nan,    0.5, 0.5, nan,    HUGE_VAL, 0.5,    -HUGE_VAL, -HUGE_VAL, 1e308,
                          -1e308, 2,   0.5, 5e-324, 0.5,      1e-300, -1e-300,   0.5,       1e-320};
    icc_domain *domain;
    icc_error err;
    ck_assert_int_eq(create_polygon(&domain, 4, square, &err), ICC_OK);
    int32_t where[9];
    uint32_t facet[9];
    double bary[18];
    icc_domain_locate(domain, 9, odd, where, facet, bary, NULL);
    for (int i = 0; i < 9; ++i) {
        ck_assert_int_eq(where[i], i < 6 ? ICC_OUTSIDE : ICC_BOUNDARY);
        ck_assert_uint_lt(facet[i], 4);
        ck_assert(bary[2 * i] >= 0 && bary[2 * i + 1] >= 0 && bary[2 * i] + bary[2 * i + 1] == 1);
    }
    icc_domain_free(domain);
}
END_TEST

START_TEST(test_facet_point)
{
    static shape s;
    static double points[2 * MAX_N];
    make_star(&s, 100);
    to_doubles(&s, 1.0 / 3, 0.1, 0.2, points);
    icc_domain *domain;
    icc_error err;
    ck_assert(create_polygon(&domain, (size_t)s.n, points, &err) == ICC_OK);
    for (uint32_t f = 0; f < domain->n_facets; ++f)
        for (int k = 0; k <= 8; ++k) {
            const double bary[2] = {1 - k / 8.0, k / 8.0};
            double p[2], back[2];
            uint32_t facet;
            iccp_domain_facet_point(domain, f, bary, p);
            ck_assert(iccp_domain_locate(domain, p, true, &facet, back) == ICC_BOUNDARY);
            const uint32_t end = domain->facets[2 * f + (k == 8)];
            if (k == 0 || k == 8)
                ck_assert(p[0] == domain->vertices[2 * end] && fmax(back[0], back[1]) == 1);
            else
                ck_assert(facet == f && fabs(back[1] - bary[1]) < 1e-12);
        }
    icc_domain_free(domain);
}
END_TEST

/* ------------------------------------------------------------------ info */

START_TEST(test_info)
{
    static shape s;
    static double points[2 * MAX_N];
    for (int round = 0; round < share_of(60); ++round) {
        make_any(&s, round % 6 == 5 ? 0 : round);
        static const double places[][3] = {{1, 0, 0}, {0.125, 1e9, -1e9}, {0x1p20, 0x1p60, 0}};
        const double *place = places[round % 3];
        to_doubles(&s, place[0], place[1], place[2], points);
        int64_t twice = 0;
        for (int i = 0; i < s.n; ++i)
            twice += vertex(&s, i).x * vertex(&s, i + 1).y - vertex(&s, i).y * vertex(&s, i + 1).x;
        icc_domain *domain;
        icc_error err;
        icc_domain_info info = {.size = sizeof info};
        ck_assert_int_eq(create_polygon(&domain, (size_t)s.n, points, &err), ICC_OK);
        ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
        ck_assert_int_eq(info.dim, 2);
        ck_assert_int_eq(info.orientation, twice > 0 ? 1 : -1);
        ck_assert(info.n_vertices == (size_t)s.n && info.n_facets == (size_t)s.n);
        ck_assert(info.measure == 0.5 * (double)llabs(twice) * place[0] * place[0]);
        for (int i = 0; i < s.n; ++i)
            for (int k = 0; k < 2; ++k)
                ck_assert(info.lower[k] <= points[2 * i + k] && points[2 * i + k] <= info.upper[k]);
        icc_domain_free(domain);
    }
    const double huge[] = {0, 0, 1e300, 0, 0, 1e300};
    icc_domain *domain;
    icc_error err;
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(create_polygon(&domain, 3, huge, &err), ICC_OK);
    icc_domain_get_info(domain, &info);
    ck_assert(info.measure == HUGE_VAL && info.upper[0] == 1e300);
    icc_domain_free(domain);
}
END_TEST

/* Triangles a few units thin, whose products have more bits than a double. */
START_TEST(test_area_of_slivers)
{
    for (int round = 0; round < share_of(20000); ++round) {
        const int64_t x = (1 << 30) + below(1 << 30), y = (1 << 30) + below(1 << 30);
        const int64_t u = x + below(9) - 4, v = y + below(9) - 4;
        const double points[] = {0, 0, (double)x, (double)y, (double)u, (double)v};
        const int64_t twice = x * v - y * u;
        icc_domain *domain;
        icc_error err;
        icc_domain_info info = {.size = sizeof info};
        if (create_polygon(&domain, 3, points, &err) != ICC_OK)
            continue;
        icc_domain_get_info(domain, &info);
        ck_assert(info.measure == 0.5 * (double)llabs(twice));
        ck_assert(info.orientation == (twice > 0 ? 1 : -1));
        icc_domain_free(domain);
    }
}
END_TEST

START_TEST(test_arguments)
{
    const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    icc_env env = {.size = sizeof env, .threads = -1};
    int32_t where;
    size_t n;
    ck_assert_int_eq(icc_domain_create(NULL, 2, 4, square, 0, NULL, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create(&domain, 0, 4, square, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create(&domain, 7, 4, square, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create(&domain, 3, 2, square, 4, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, NULL, 0, NULL, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create(&domain, 2, SIZE_MAX / 8, square, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(
        icc_domain_create(&domain, 2, 4, square, SIZE_MAX, (const uint32_t *)square, NULL, &err),
        ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, square, 0, NULL, &env, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(domain);
    ck_assert_int_eq(icc_boundary_defects(4, square, 0, NULL, NULL, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_boundary_defects(4, square, 1, NULL, NULL, &n, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_boundary_defects(4, NULL, 0, NULL, NULL, &n, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_boundary_defects(4, square, 0, NULL, NULL, &n, &env, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_get_info(NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_get_boundary(NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_locate(NULL, 1, square, &where, NULL, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(create_polygon(&domain, 4, square, &err), ICC_OK);
    ck_assert_int_eq(icc_domain_locate(domain, 1, NULL, &where, NULL, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_locate(domain, 1, square, NULL, NULL, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_locate(domain, 1, square, &where, NULL, NULL, &env),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_locate(domain, 0, NULL, NULL, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_get_info(domain, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_get_boundary(domain, NULL, NULL), ICC_OK);
    icc_domain_info info = {.size = 0};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_ERR_ARGUMENT);
    iccp_domain_release(iccp_domain_retain(domain));
    icc_domain_free(domain);
    icc_domain_free(NULL);
}
END_TEST

/* ------------------------------------------------- memory, cancel, threads */

typedef struct budget {
    long left, live; /* allocations that still succeed, and that are not freed */
    long calls, cancel_at;
} budget;

static void *take(void *user, size_t size)
{
    budget *b = user;
    if (b->left-- <= 0)
        return NULL;
    ++b->live;
    return malloc(size);
}

static void give(void *user, void *memory)
{
    --((budget *)user)->live;
    free(memory);
}

static int32_t count(void *user, const char *stage, double share)
{
    budget *b = user;
    ck_assert(stage != NULL && share >= 0 && share <= 1);
    return b->calls++ == b->cancel_at;
}

static icc_status try_create(budget *b, const shape *s, double *points)
{
    const icc_env env = {
        .size = sizeof env, .user = b, .alloc = take, .dealloc = give, .progress = count};
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    to_doubles(s, 1, 0, 0, points);
    const icc_status status =
        icc_domain_create(&domain, 2, (size_t)s->n, points, 0, NULL, &env, &err);
    ck_assert((domain != NULL) == (status == ICC_OK));
    ck_assert_int_eq(err.status, status);
    icc_domain_free(domain);
    ck_assert_int_eq(b->live, 0);
    return status;
}

static icc_status try_list(budget *b, const shape *s, double *points)
{
    const icc_env env = {
        .size = sizeof env, .user = b, .alloc = take, .dealloc = give, .progress = count};
    size_t n;
    to_doubles(s, 1, 0, 0, points);
    const icc_status status =
        icc_boundary_defects((size_t)s->n, points, 0, NULL, NULL, &n, &env, NULL);
    ck_assert_int_eq(b->live, 0);
    return status;
}

typedef icc_status (*attempt)(budget *b, const shape *s, double *points);

START_TEST(test_memory_and_cancel)
{
    static shape shapes[2];
    static double points[2 * MAX_N];
    static const attempt attempts[2] = {try_create, try_list};
    make_star(&shapes[0], 2500);
    make_star(&shapes[1], 2500);
    shapes[1].at[7] = shapes[1].at[2000];
    for (int i = 0; i < 4; ++i) {
        const attempt run = attempts[i / 2];
        const shape *s = &shapes[i % 2];
        budget b = {.left = 1000, .cancel_at = -1};
        const icc_status expected = run(&b, s, points);
        ck_assert_int_eq(expected, i == 1 ? ICC_ERR_BOUNDARY : ICC_OK);
        const long n_allocations = 1000 - b.left, n_calls = b.calls;
        ck_assert(n_allocations > 3 && n_calls > 0);
        for (long k = 0; k < n_allocations; ++k) {
            b = (budget){.left = k, .cancel_at = -1};
            ck_assert_int_eq(run(&b, s, points), ICC_ERR_MEMORY);
        }
        for (long k = 0; k < n_calls; ++k) {
            b = (budget){.left = 1000, .cancel_at = k};
            ck_assert_int_eq(run(&b, s, points), ICC_ERR_CANCELLED);
        }
    }
}
END_TEST

/* Where there is no memory for the cells points are found without. */
START_TEST(test_locate_without_memory)
{
    enum { N = 3000 };
    static shape s;
    static double points[2 * MAX_N], queries[2 * N], bary[2][2 * N];
    static int32_t where[2][N];
    static uint32_t facet[2][N];
    for (int round = 0; round < 12; ++round) {
        icc_domain *domain, *poor;
        icc_error err;
        make_any(&s, round == 5 || round == 11 ? 4 : round);
        to_doubles(&s, 1, round % 2 == 0 ? 0 : 1e9, 0, points);
        ck_assert_int_eq(create_polygon(&domain, (size_t)s.n, points, &err), ICC_OK);
        icc_domain_info info = {.size = sizeof info};
        icc_domain_get_info(domain, &info);
        for (int i = 0; i < N; ++i)
            for (int k = 0; k < 2; ++k) {
                const double *p = points + 2 * below(s.n);
                const double at = info.lower[k] + unit() * (info.upper[k] - info.lower[k]);
                queries[2 * i + k] = i % 3 == 0 ? p[k] : at;
            }
        icc_domain_locate(domain, N, queries, where[0], facet[0], bary[0], NULL);
        budget b = {.left = 1000, .cancel_at = -1};
        const icc_env env = {.size = sizeof env, .user = &b, .alloc = take, .dealloc = give};
        ck_assert_int_eq(icc_domain_create(&poor, 2, (size_t)s.n, points, 0, NULL, &env, NULL),
                         ICC_OK);
        for (b.left = 0; b.left < 4; ++b.left) {
            const long left = b.left, live = b.live;
            icc_domain_locate(poor, N, queries, where[1], facet[1], bary[1], NULL);
            ck_assert_int_eq(memcmp(where[0], where[1], sizeof where[0]), 0);
            ck_assert_int_eq(memcmp(facet[0], facet[1], sizeof facet[0]), 0);
            ck_assert_int_eq(memcmp(bary[0], bary[1], sizeof bary[0]), 0);
            ck_assert_int_eq(b.live > live, left == 3);
            b.left = left;
        }
        icc_domain_free(poor);
        ck_assert_int_eq(b.live, 0);
        icc_domain_free(domain);
    }
}
END_TEST

START_TEST(test_threads)
{
    enum { N = 20000 };
    static shape s;
    static double points[2 * MAX_N], queries[2 * N], bary[2][2 * N];
    static int32_t where[2][N];
    static uint32_t facet[2][N];
    make_spiral(&s, 40);
    to_doubles(&s, 1, 0, 0, points);
    icc_domain *domain;
    icc_error err;
    ck_assert_int_eq(create_polygon(&domain, (size_t)s.n, points, &err), ICC_OK);
    for (int i = 0; i < 2 * N; ++i)
        queries[i] = 400 * unit() - 200;
    icc_domain_locate(domain, N, queries, where[0], facet[0], bary[0], NULL);
    for (int32_t threads = 2; threads <= 8; threads += 3) {
        const icc_env env = {.size = sizeof env, .threads = threads};
        icc_domain_free(domain); /* the threads shall make the cells of a new one */
        ck_assert_int_eq(create_polygon(&domain, (size_t)s.n, points, &err), ICC_OK);
        ck_assert_int_eq(icc_domain_locate(domain, N, queries, where[1], facet[1], bary[1], &env),
                         ICC_OK);
        ck_assert_int_eq(memcmp(where[0], where[1], sizeof where[0]), 0);
        ck_assert_int_eq(memcmp(facet[0], facet[1], sizeof facet[0]), 0);
        ck_assert_int_eq(memcmp(bary[0], bary[1], sizeof bary[0]), 0);
    }
    budget b = {.cancel_at = 3};
    const icc_env env = {.size = sizeof env, .user = &b, .progress = count};
    ck_assert_int_eq(icc_domain_locate(domain, N, queries, where[1], NULL, NULL, &env),
                     ICC_ERR_CANCELLED);
    icc_domain_free(domain);
}
END_TEST

/* ------------------------------------------------------------------- tree */

static int32_t check_node(const iccp_avl *tree, uint32_t node, uint32_t parent, uint32_t *last)
{
    if (node == 0)
        return 0;
    const iccp_avl_node *n = &tree->nodes[node];
    ck_assert(n->parent == parent);
    const int32_t left = check_node(tree, n->left, node, last);
    ck_assert(tree->nodes[*last].after == node && n->before == *last);
    *last = node;
    const int32_t right = check_node(tree, n->right, node, last);
    ck_assert(abs(left - right) <= 1);
    ck_assert(n->height == 1 + (left > right ? left : right));
    return n->height;
}

/* Random insertions and removals keep the order, the links and the balance. */
START_TEST(test_tree)
{
    enum { N = 300 };
    iccp_avl tree;
    uint32_t order[N];
    int n = 0;
    iccp_avl_create(&tree, N, &iccp_memory_default);
    ck_assert_ptr_nonnull(tree.nodes);
    for (int round = 0; round < share_of(6000); ++round) {
        const bool grow = n == 0 || (n < N && below(100) < (round / 1500 % 2 == 0 ? 70 : 30));
        const int at = below(grow ? n + 1 : n);
        if (grow) {
            memmove(order + at + 1, order + at, (size_t)(n - at) * sizeof *order);
            order[at] = iccp_avl_insert(&tree, at > 0 ? order[at - 1] : 0, (uint32_t)round);
            ck_assert(tree.nodes[order[at]].item == (uint32_t)round);
            ++n;
        } else {
            iccp_avl_remove(&tree, order[at]);
            --n;
            memmove(order + at, order + at + 1, (size_t)(n - at) * sizeof *order);
        }
        uint32_t last = 0;
        check_node(&tree, tree.root, 0, &last);
        uint32_t node = tree.nodes[0].after;
        for (int i = 0; i < n; ++i, node = tree.nodes[node].after)
            ck_assert(node == order[i]);
        ck_assert(node == 0);
    }
    iccp_avl_free(&tree, &iccp_memory_default);
}
END_TEST

int main(void)
{
    TCase *checks = tcase_create("domain");
    tcase_add_test(checks, test_known_defects);
    tcase_add_test(checks, test_list_of_not_finite);
    tcase_add_test(checks, test_list_capacity);
    tcase_add_test(checks, test_list_ends);
    tcase_add_test(checks, test_random_integers);
    tcase_add_test(checks, test_shapes);
    tcase_add_test(checks, test_chains);
    tcase_add_test(checks, test_slit);
    tcase_add_test(checks, test_nearly_degenerate);
    tcase_add_test(checks, test_work);
    tcase_add_test(checks, test_facets);
    tcase_add_test(checks, test_locate_exactly);
    tcase_add_test(checks, test_clustered_vertices);
    tcase_add_test(checks, test_vertex_near_edge);
    tcase_add_test(checks, test_sides_of_cells);
    tcase_add_test(checks, test_edge_through_known_point);
    tcase_add_test(checks, test_invariance);
    tcase_add_test(checks, test_tolerance);
    tcase_add_test(checks, test_odd_points);
    tcase_add_test(checks, test_facet_point);
    tcase_add_test(checks, test_info);
    tcase_add_test(checks, test_area_of_slivers);
    tcase_add_test(checks, test_arguments);
    tcase_add_test(checks, test_memory_and_cancel);
    tcase_add_test(checks, test_locate_without_memory);
    tcase_add_test(checks, test_threads);
    tcase_add_test(checks, test_tree);
    tcase_set_timeout(checks, 120);
    Suite *suite = suite_create("domain");
    suite_add_tcase(suite, checks);
    return suite_run(suite);
}
