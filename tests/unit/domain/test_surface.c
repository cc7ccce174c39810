/* Domains in 1 and in 3 to 6 dimensions: which boundaries are accepted, what is said of the others,
 * and where points and lines meet them, against brute force. */
#include "../../faulty.h"
#include "../../obj.h"
#include "../../share.h"
#include "../../suite.h"
#include "../../surfaces.h"
#include "base/error.h"
#include "domain/domain.h"
#include "domain/tree_cross.h"
#include "geometry/facet_tree.h"
#include "geometry/fans.h"
#include "geometry/needles.h"
#include "geometry/simplex.h"
#include "geometry/triangles.h"
#include "icc/icc.h"

#include <check.h>
#include <glob.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* Where the sets of real surfaces are, if they are there at all. */
static const char *shared(void)
{
    const char *folder = getenv("ICC_TEST_DATA");
    return folder != NULL ? folder : TEST_SHARED_DATA;
}

static icc_status create(icc_domain **out, const surface *s, icc_error *err)
{
    *err = (icc_error){.size = sizeof *err};
    return icc_domain_create(out, 3, s->n_vertices, s->vertices, s->n_faces, s->faces, NULL, err);
}

static icc_domain *make(const surface *s)
{
    icc_domain *domain;
    icc_error err;
    ck_assert_msg(create(&domain, s, &err) == ICC_OK, "%s", err.message);
    return domain;
}

static int32_t where_is(const icc_domain *domain, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    int32_t where;
    ck_assert(icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL) == ICC_OK);
    return where;
}

/* ------------------------------------------------------------------- defects */

typedef struct expected {
    icc_status status;
    int64_t index;
    const char *text; /* part of the message */
} expected;

static void refuse(const surface *s, const expected *e)
{
    icc_domain *domain = (icc_domain *)&domain;
    icc_error err;
    const icc_status status = create(&domain, s, &err);
    ck_assert_ptr_null(domain);
    ck_assert_msg(status == e->status && err.status == status, "%s: %ld (%s)", e->text,
                  (long)status, err.message);
    ck_assert_msg(err.index == e->index, "%s: %ld", err.message, (long)err.index);
    ck_assert_msg(strstr(err.message, e->text) != NULL, "%s", err.message);
    ck_assert_ptr_null(strchr(err.message, '\n'));
}

static void flip(surface *s, size_t face)
{
    const uint32_t swap = s->faces[3 * face];
    s->faces[3 * face] = s->faces[3 * face + 1];
    s->faces[3 * face + 1] = swap;
}

static void turn_over(surface *s)
{
    for (size_t f = 0; f < s->n_faces; ++f)
        flip(s, f);
}

/* Adds a copy: scaled, then moved along x. */
static void add_copy(surface *s, const surface *other, double scale, double x)
{
    const uint32_t first = (uint32_t)s->n_vertices;
    for (size_t i = 0; i < 3 * other->n_vertices; ++i)
        s->vertices[3 * first + i] = scale * other->vertices[i] + (i % 3 == 0 ? x : 0);
    s->n_vertices += other->n_vertices;
    for (size_t f = 0; f < other->n_faces; ++f)
        surface_face(s, first + other->faces[3 * f], first + other->faces[3 * f + 1],
                     first + other->faces[3 * f + 2]);
}

static surface s, t;

/* Every face of a sphere in turn is left out, doubled, turned over, or given a wrong index. */
START_TEST(each_face_is_named)
{
    random_source r = {1};
    char text[64];
    surface_star(&t, 2, 0.2, &r);
    for (size_t f = 0; f < t.n_faces; ++f) {
        s = t;
        flip(&s, f);
        refuse(&s, &(expected){ICC_ERR_BOUNDARY, (int64_t)f, "turned over"});
        s = t;
        surface_face(&s, t.faces[3 * f], t.faces[3 * f + 1], t.faces[3 * f + 2]);
        refuse(&s, &(expected){ICC_ERR_BOUNDARY, (int64_t)t.n_faces, "belongs to 3 faces"});
        s = t;
        s.faces[3 * f + f % 3] = (uint32_t)(s.n_vertices + f % 7);
        refuse(&s, &(expected){ICC_ERR_BOUNDARY, (int64_t)f, "but there are only 66 vertices"});
        s = t;
        s.faces[3 * f + f % 3] = s.faces[3 * f + (f + 1) % 3];
        refuse(&s, &(expected){ICC_ERR_BOUNDARY, (int64_t)f, "twice"});
    }
    for (size_t v = 0; v < t.n_vertices; ++v) {
        s = t;
        s.vertices[3 * v + v % 3] = v % 2 == 0 ? HUGE_VAL : nan("");
        (void)snprintf(text, sizeof text, "vertex %zu is not finite", v);
        refuse(&s, &(expected){ICC_ERR_BOUNDARY, (int64_t)v, text});
    }
}
END_TEST

START_TEST(holes_are_named)
{
    surface_octahedron(&t);
    s = t;
    --s.n_faces; /* face 7 was 1, 5, 3 */
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, 3,
                           "edge (1, 3) of face 3 belongs to no other face: "
                           "the boundary is open (3 such edges)"});
    s.n_faces = 3;
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, -1, "at least 4 facets, not 3"});
    s.n_faces = 0;
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, -1, "at least 4 facets, not 0"});
    s = t;
    s.n_vertices = 3;
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, -1, "at least 4 vertices, not 3"});
}
END_TEST

START_TEST(components_are_named)
{
    surface_octahedron(&t);
    s = t;
    add_copy(&s, &t, 1, 5);
    refuse(&s, &(expected){ICC_ERR_TOPOLOGY, 8,
                           "more than one component: the surface with face 8 lies beside the "
                           "surface with face 0"});
    s = t;
    add_copy(&s, &t, 0.5, 0);
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, 8, "face 0 and is turned the same way"});
    s = t;
    turn_over(&t);
    add_copy(&s, &t, 0.5, 0);
    turn_over(&t);
    add_copy(&s, &t, 0.25, 0);
    refuse(&s, &(expected){ICC_ERR_TOPOLOGY, 16,
                           "the surface with face 16 lies in the void with face 8"});
    s = t;
    turn_over(&t);
    add_copy(&s, &t, 0.5, 0.5);
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, 6, "the surface meets itself"});
    turn_over(&t);
    s = t;
    add_copy(&s, &t, 1, 2);
    for (size_t i = 24; i < 48; ++i) /* corner (-1, 0, 0) of the copy is vertex 0 */
        s.faces[i] = s.faces[i] == 7 ? 0 : s.faces[i];
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, 0, "two surfaces share vertex 0"});
}
END_TEST

static int in_ring(int x, int y, int z)
{
    return z == 0 && !(x == 1 && y == 1);
}

static int in_two_rings(int x, int y, int z)
{
    return z == 0 && !(x % 2 == 1 && y == 1) && y < 3;
}

static int in_row_at_edge(int x, int y, int z)
{
    return z == 0 && ((x == 0 && y == 0) || (x == 1 && y == 1));
}

static void check_topology(const surface *given, size_t genus, size_t n_voids, double measure)
{
    icc_domain *d = make(given);
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(d, &info), ICC_OK);
    ck_assert_uint_eq(info.genus, genus);
    ck_assert_uint_eq(info.n_voids, n_voids);
    ck_assert_double_eq_tol(info.measure, measure, 1e-12 * measure);
    icc_domain_free(d);
}

START_TEST(handles_are_counted)
{
    surface_cells(&s, 3, in_ring);
    check_topology(&s, 1, 0, 8);
    turn_over(&s);
    check_topology(&s, 1, 0, 8);
    surface_cells(&s, 5, in_two_rings);
    check_topology(&s, 2, 0, 13);
    surface_cells(&s, 2, in_row_at_edge);
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, 13, "belongs to 4 faces, among them 2, 7 and 13"});
}
END_TEST

/* Voids listed before and after the outer surface, either way round. */
START_TEST(voids_are_counted)
{
    for (int way = 0; way < 2; ++way) {
        icc_domain *d;
        surface_octahedron(&t);
        turn_over(&t);
        s = (surface){.n_vertices = 0};
        add_copy(&s, &t, 0.25, 0.5);
        turn_over(&t);
        add_copy(&s, &t, 1, 0);
        turn_over(&t);
        add_copy(&s, &t, 0.25, -0.5);
        if (way == 1)
            turn_over(&s);
        check_topology(&s, 0, 2, 4.0 / 3 * (1 - 2.0 / 64));
        d = make(&s);
        ck_assert_int_eq(where_is(d, 0.5, 0.01, 0.02), ICC_OUTSIDE);
        ck_assert_int_eq(where_is(d, -0.5, 0.01, 0.02), ICC_OUTSIDE);
        ck_assert_int_eq(where_is(d, 0, 0.01, 0.02), ICC_INSIDE);
        ck_assert_int_eq(where_is(d, 0.75, 0, 0), ICC_BOUNDARY);
        icc_domain_free(d);
    }
}
END_TEST

START_TEST(flat_shapes_are_refused)
{
    surface_octahedron(&s);
    for (size_t v = 0; v < s.n_vertices; ++v)
        s.vertices[3 * v + 2] = 0.1 * s.vertices[3 * v];
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, -1, "all vertices lie in one plane"});
    surface_octahedron(&s);
    s.vertices[12] = 0.5; /* (1, 0, 0), (0.5, 0.5, 0), (0, 1, 0) */
    s.vertices[13] = 0.5;
    s.vertices[14] = 0;
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, 0, "face 0 has area 0: its corners lie on one line"});
    s.n_vertices = 4;
    s.n_faces = 0;
    for (int i = 0; i < 4; ++i) /* one triangle, twice on either side, is not even a manifold */
        surface_face(&s, 0, i % 2 ? 1 : 2, i % 2 ? 2 : 1);
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, 2, "belongs to 4 faces"});
}
END_TEST

/* A corner of a refined octahedron is pushed out through the opposite side, or just onto it. */
START_TEST(intersections_are_named)
{
    static const double depths[] = {-1, -1.5, -0x1.0000000000001p0};
    for (size_t i = 0; i < sizeof depths / sizeof depths[0]; ++i) {
        surface_octahedron(&s);
        surface_split(&s);
        s.vertices[12 + 2] = depths[i]; /* was (0, 0, 1) */
        icc_domain *domain;
        icc_error err;
        ck_assert_int_eq(create(&domain, &s, &err), ICC_ERR_BOUNDARY);
        unsigned long a, b;
        const char *faces = strstr(err.message, "faces ");
        ck_assert_msg(faces != NULL && sscanf(faces, "faces %lu and %lu", &a, &b) == 2, "%s",
                      err.message);
        ck_assert(a < b && b < s.n_faces && err.index == (int64_t)a);
        ck_assert(iccp_triangles_meet(s.vertices, s.faces + 3 * a, s.faces + 3 * b));
    }
    surface_octahedron(&s);
    surface_split(&s);
    s.vertices[12 + 2] = -0.99999999999999989; /* the last double before */
    icc_domain_free(make(&s));
}
END_TEST

/* ------------------------------------------------------ triangles in integers */

typedef struct spot {
    int64_t x[3];
} spot;

static spot minus(spot a, spot b)
{
    return (spot){{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}

static spot cross(spot a, spot b)
{
    return (spot){{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                   a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

static int64_t dot(spot a, spot b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static spot times(spot a, int64_t factor)
{
    return (spot){{a.x[0] * factor, a.x[1] * factor, a.x[2] * factor}};
}

/* Whether the point p / scale, which lies in the plane of t, is in t. */
static bool in_triangle(const spot *v, spot p, int64_t scale)
{
    const spot normal = cross(minus(v[1], v[0]), minus(v[2], v[0]));
    for (int i = 0; i < 3; ++i) {
        const spot side = minus(v[(i + 1) % 3], v[i]), way = minus(p, times(v[i], scale));
        if (dot(cross(side, way), normal) < 0)
            return false;
    }
    return true;
}

/* Whether p / scale is more than what the triangles share: corners s[0..n_shared). */
static bool is_news(const spot *v, int n_shared, spot p, int64_t scale)
{
    if (n_shared == 0)
        return true;
    const spot way = minus(p, times(v[0], scale));
    if (n_shared == 1)
        return dot(way, way) != 0;
    const spot across = cross(way, minus(v[1], v[0]));
    return dot(across, across) != 0;
}

/* The points where a side p q of one triangle enters, leaves or crosses the sides of t. */
static bool side_meets(spot p, spot q, const spot *v, const spot *first, int n_shared)
{
    const spot normal = cross(minus(v[1], v[0]), minus(v[2], v[0])), d = minus(q, p);
    const int64_t hp = dot(normal, minus(p, v[0])), hq = dot(normal, minus(q, v[0]));
    if ((hp > 0 && hq > 0) || (hp < 0 && hq < 0))
        return false;
    if (hp != 0 || hq != 0) {
        const int64_t a = llabs(hq), b = llabs(hp);
        spot at;
        for (int k = 0; k < 3; ++k)
            at.x[k] = p.x[k] * a + q.x[k] * b;
        return in_triangle(v, at, a + b) && is_news(first, n_shared, at, a + b);
    }
    if ((in_triangle(v, p, 1) && is_news(first, n_shared, p, 1)) ||
        (in_triangle(v, q, 1) && is_news(first, n_shared, q, 1)))
        return true;
    for (int i = 0; i < 3; ++i) {
        const spot e = minus(v[(i + 1) % 3], v[i]), w = minus(v[i], p), c = cross(d, e);
        const int64_t scale = dot(c, c), t0 = dot(cross(w, e), c), t1 = dot(cross(w, d), c);
        const spot at = {{p.x[0] * scale + d.x[0] * t0, p.x[1] * scale + d.x[1] * t0,
                          p.x[2] * scale + d.x[2] * t0}};
        if (scale != 0 && t0 >= 0 && t0 <= scale && t1 >= 0 && t1 <= scale &&
            is_news(first, n_shared, at, scale))
            return true;
    }
    return false;
}

/* The corners that the triangles share come first in both. */
static bool slow_meet(const spot *a, const spot *b, int n_shared)
{
    for (int i = 0; i < 3; ++i)
        if (side_meets(a[i], a[(i + 1) % 3], b, a, n_shared) ||
            side_meets(b[i], b[(i + 1) % 3], a, a, n_shared))
            return true;
    return n_shared == 3;
}

static bool has_area(const spot *v)
{
    const spot normal = cross(minus(v[1], v[0]), minus(v[2], v[0]));
    return dot(normal, normal) != 0;
}

static void random_spot(spot *p, random_source *r, int size, int flatness)
{
    for (int k = 0; k < 3; ++k)
        p->x[k] = k < flatness ? 0 : random_below(r, 2 * size + 1) - size;
}

/* Lattice points, so that triangles touch, overlap and lie in one plane all the time. */
START_TEST(triangles_agree_with_integers)
{
    random_source r = {2};
    int n_met[4] = {0}, n_all[4] = {0};
    for (int round = 0; round < share_of(400000); ++round) {
        const int n_shared = random_below(&r, 3), size = 1 + random_below(&r, 4);
        const int flatness = random_below(&r, 4) == 0;
        spot a[3], b[3];
        double vertices[18];
        uint32_t first[3], second[3];
        for (int i = 0; i < 3; ++i) {
            random_spot(&a[i], &r, size, flatness);
            random_spot(&b[i], &r, size, flatness);
            if (i < n_shared)
                b[i] = a[i];
        }
        if (!has_area(a) || !has_area(b))
            continue;
        const int turn = random_below(&r, 3), other = random_below(&r, 3);
        for (int i = 0; i < 3; ++i) {
            first[(i + turn) % 3] = (uint32_t)i;
            second[(i + other) % 3] = (uint32_t)(i < n_shared ? i : 3 + i);
            for (int k = 0; k < 3; ++k) {
                vertices[3 * i + k] = (double)a[i].x[k] / 4;
                vertices[9 + 3 * i + k] = (double)b[i].x[k] / 4;
            }
        }
        const bool met = slow_meet(a, b, n_shared);
        ck_assert(iccp_triangles_meet(vertices, first, second) == met);
        ck_assert(iccp_triangles_meet(vertices, second, first) == met);
        n_met[n_shared] += met;
        ++n_all[n_shared];
    }
    for (int i = 0; i < 3; ++i)
        ck_assert_msg(n_met[i] > n_all[i] / 50 && n_met[i] < n_all[i] * 49 / 50, "%d: %d of %d", i,
                      n_met[i], n_all[i]);
}
END_TEST

/* A pair is found in a soup if and only if there is one. */
START_TEST(soups_are_searched)
{
    enum { N = 60 };
    random_source r = {3};
    int n_found = 0;
    const iccp_env env = {.memory = iccp_memory_default};
    for (int round = 0; round < share_of(400); ++round) {
        const double size = 0.02 + 0.2 * random_unit(&r);
        double vertices[9 * N];
        uint32_t faces[3 * N], pair[2];
        for (uint32_t i = 0; i < 9 * N; ++i) {
            if (i % 9 < 3)
                vertices[i] = random_unit(&r);
            else
                vertices[i] = vertices[i - i % 9 + i % 3] + size * (random_unit(&r) - 0.5);
            if (i < 3 * N)
                faces[i] = i;
        }
        bool met = false;
        for (uint32_t i = 0; i < N; ++i)
            for (uint32_t j = 0; j < i; ++j)
                met |= iccp_triangles_meet(vertices, faces + 3 * i, faces + 3 * j);
        iccp_facet_tree tree;
        iccp_facet_tree_create(&tree, 3, vertices, N, faces, &env.memory);
        ck_assert(tree.boxes != NULL);
        ck_assert(iccp_triangles_find(&tree, 3 * N, pair, &env) == ICC_OK);
        ck_assert((pair[0] != pair[1]) == met);
        if (met)
            ck_assert(iccp_triangles_meet(vertices, faces + 3 * pair[0], faces + 3 * pair[1]));
        iccp_facet_tree_free(&tree, &env.memory);
        n_found += met;
    }
    ck_assert(n_found > share_of(50) && n_found < share_of(350));
}
END_TEST

/* A double cone over a ring of n points: fans with apexes n and n + 1. Rings wind `turns` times, or
 * lie anywhere (0). */
static void make_cones(uint32_t n, int turns, random_source *r, double *vertices, uint32_t *faces)
{
    for (uint32_t i = 0; i < n; ++i) {
        const double angle = 6.283185307179586 * turns * i / n;
        for (int k = 0; k < 3; ++k) {
            const double at = k == 0 ? cos(angle) : k == 1 ? sin(angle) : 0;
            vertices[3 * i + (uint32_t)k] =
                turns > 0 ? at + 0.3 * (random_unit(r) - 0.5) : random_unit(r) - 0.5;
        }
        const uint32_t next = i + 1 < n ? i + 1 : 0;
        const uint32_t two_faces[6] = {n, i, next, n + 1, next, i};
        memcpy(faces + 6 * i, two_faces, sizeof two_faces);
    }
    for (uint32_t k = 0; k < 6; ++k)
        vertices[3 * n + k] = 0.2 * random_unit(r) + (k == 2 ? 1 : k == 5 ? -1 : 0);
    for (uint32_t k = 0; k < 3; ++k) { /* turns the axis */
        const uint32_t a = (uint32_t)random_below(r, 3), b = (uint32_t)random_below(r, 3);
        for (uint32_t v = 0; v < n + 2; ++v) {
            const double swap = vertices[3 * v + a];
            vertices[3 * v + a] = vertices[3 * v + b];
            vertices[3 * v + b] = swap;
        }
    }
}

/* Vertices at which triangles cannot meet are such, pentagrams are none, and the pair that is found
 * is the first in the order of the tree. */
START_TEST(fans_are_safe)
{
    enum { N = 12 };
    random_source r = {5};
    const iccp_env env = {.memory = iccp_memory_default};
    int n_good = 0, n_met = 0, n_rounds = share_of(4000);
    for (int round = 0; round < n_rounds; ++round) {
        const int turns = round % 4 < 2 ? 1 : round % 4 == 2 ? 2 : 0;
        const uint32_t n = turns == 2 ? 5 + 2 * (uint32_t)random_below(&r, 3)
                                      : 3 + (uint32_t)random_below(&r, N - 2);
        double vertices[3 * (N + 2)];
        uint32_t faces[6 * N], pair[2], first[2] = {0, 0};
        iccp_facet_tree tree;
        make_cones(n, turns, &r, vertices, faces);
        iccp_facet_tree_create(&tree, 3, vertices, 2 * n, faces, &env.memory);
        uint8_t *good = iccp_fans_find(&tree, n + 2, &env.memory);
        ck_assert(tree.boxes != NULL && good != NULL);
        for (uint32_t p = 2 * n; p-- > 0;)
            for (uint32_t q = 2 * n; --q > p;) {
                const uint32_t f = tree.order[p], g = tree.order[q];
                if (!iccp_triangles_meet(vertices, faces + 3 * f, faces + 3 * g))
                    continue;
                first[0] = f < g ? f : g;
                first[1] = f < g ? g : f;
                for (uint32_t i = 0; i < 9; ++i)
                    ck_assert(faces[3 * f + i / 3] != faces[3 * g + i % 3] ||
                              !good[faces[3 * f + i / 3]]);
            }
        ck_assert(iccp_triangles_find(&tree, n + 2, pair, &env) == ICC_OK);
        ck_assert(pair[0] == first[0] && pair[1] == first[1]);
        ck_assert(turns != 2 || !good[n]);
        n_good += good[n];
        n_met += first[0] != first[1];
        iccp_free(&env.memory, good);
        iccp_facet_tree_free(&tree, &env.memory);
    }
    ck_assert(n_good > n_rounds / 5 && n_met > n_rounds / 5 && n_met < n_rounds * 4 / 5);
}
END_TEST

/* ------------------------------------------------------------------- needles */

typedef struct needles {
    const iccp_facet_tree *tree;
    size_t n_compared;
    bool met;
} needles;

static bool compare_needles(void *context, uint32_t p, uint32_t q)
{
    needles *all = context;
    const iccp_facet_tree *tree = all->tree;
    ++all->n_compared;
    all->met = iccp_triangles_meet(tree->vertices, tree->facets + 3 * (size_t)tree->order[p],
                                   tree->facets + 3 * (size_t)tree->order[q]);
    return all->met;
}

/* Whether triangles meet, which the search for needles finds if and only if a comparison of all
 * pairs does. */
static bool needles_meet(const double *vertices, size_t n_vertices, const uint32_t *faces, size_t n,
                         size_t *n_compared)
{
    const iccp_env env = {.memory = iccp_memory_default};
    iccp_facet_tree tree;
    iccp_facet_tree_create(&tree, 3, vertices, n, faces, &env.memory);
    needles slow = {.tree = &tree}, fast = slow;
    for (uint32_t p = 0; p < n && !slow.met; ++p)
        for (uint32_t q = 0; q < p && !slow.met; ++q)
            (void)compare_needles(&slow, p, q);
    ck_assert(iccp_needles_compare(&tree, n_vertices, compare_needles, &fast, &env) == ICC_OK);
    ck_assert(fast.met == slow.met);
    *n_compared += fast.n_compared;
    iccp_facet_tree_free(&tree, &env.memory);
    return fast.met;
}

/* Needles anywhere, and arcs of all lengths round one vertex or two. */
START_TEST(needles_are_searched)
{
    enum { N = 200 };
    random_source r = {7};
    int n_met[3] = {0};
    size_t n_compared = 0;
    const int n_rounds = share_of(150);
    double *vertices = malloc((9 * N + 6) * sizeof *vertices);
    uint32_t *faces = malloc(3 * N * sizeof *faces);
    for (int round = 0; round < n_rounds; ++round) {
        const int kind = round % 3;
        for (uint32_t i = 0; i < 9 * N + 6; ++i)
            vertices[i] = random_unit(&r) - 0.5;
        for (uint32_t i = 0; i < N; ++i) {
            double *p = vertices + 9 * i;
            const double width = kind == 1   ? 0.1 * pow(random_unit(&r), 4)
                                 : kind == 0 ? 1e-4
                                             : 1e-3;
            for (int k = 0; k < 3; ++k)
                p[6 + k] = p[3 + k] + width * (random_unit(&r) - 0.5);
            faces[3 * i] = kind == 0 ? 3 * i : 3 * N + (kind == 2 ? i % 2 : 0);
            faces[3 * i + 1] = 3 * i + 1;
            faces[3 * i + 2] = 3 * i + 2;
        }
        vertices[9 * N + 3] *= 0.01;
        n_met[kind] += needles_meet(vertices, 3 * N + 2, faces, N, &n_compared);
    }
    /* Both outcomes are common; a few rounds may miss one. */
    for (int kind = 0; kind < 3 && n_rounds >= 90; ++kind)
        ck_assert_msg(n_met[kind] > n_rounds / 30 && n_met[kind] < n_rounds * 29 / 90,
                      "kind %d: %d of %d", kind, n_met[kind], n_rounds / 3);
    ck_assert_uint_lt(n_compared, (size_t)n_rounds * N * N / 8);
    free(faces);
    free(vertices);
}
END_TEST

/* A double cone over a rim that goes up and down, as places of a tree. */
static icc_status search_cones(const icc_env *caller, icc_error *err, void *argument)
{
    enum { N = 400 };
    static double vertices[3 * (N + 2)];
    static uint32_t faces[6 * N];
    iccp_env env;
    iccp_facet_tree tree;
    needles all = {.tree = &tree};
    (void)argument;
    ck_assert(iccp_env_read(&env, caller, err) == ICC_OK);
    for (uint32_t i = 0; i < N; ++i) {
        const double angle = 6.283185307179586 * i / N;
        const double rim[3] = {cos(angle), sin(angle), i % 2 == 0 ? -0.1 : 0.1};
        const uint32_t next = (i + 1) % N, two_faces[6] = {N, i, next, N + 1, next, i};
        memcpy(vertices + 3 * i, rim, sizeof rim);
        memcpy(faces + 6 * i, two_faces, sizeof two_faces);
    }
    vertices[3 * N + 2] = 1;
    vertices[3 * N + 5] = -1;
    iccp_facet_tree_create(&tree, 3, vertices, 2 * N, faces, &env.memory);
    const icc_status status = tree.boxes == NULL
                                  ? ICC_ERR_MEMORY
                                  : iccp_needles_compare(&tree, N + 2, compare_needles, &all, &env);
    iccp_facet_tree_free(&tree, &env.memory);
    ck_assert(!all.met && all.n_compared < 40 * N);
    return iccp_explain(err, status);
}

START_TEST(needles_leak_nothing)
{
    faulty_sweep(search_cones, NULL);
}
END_TEST

/* ------------------------------------------------------------------ accepted */

/* How often the surface winds round p: A. van Oosterom, J. Strackee, The Solid Angle of a Plane
 * Triangle, 1983. */
static double winding(size_t n_faces, const uint32_t *faces, const double *vertices,
                      const double *p)
{
    double sum = 0;
    for (size_t f = 0; f < n_faces; ++f) {
        double v[3][3], length[3], product[3];
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k)
                v[i][k] = vertices[3 * faces[3 * f + (size_t)i] + (size_t)k] - p[k];
            length[i] = sqrt(v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]);
        }
        for (int i = 0; i < 3; ++i) {
            const double *a = v[(i + 1) % 3], *b = v[(i + 2) % 3];
            product[i] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        }
        const double det = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                           v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                           v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
        sum += atan2(det, length[0] * length[1] * length[2] + product[0] * length[0] +
                              product[1] * length[1] + product[2] * length[2]);
    }
    return sum / 6.283185307179586;
}

static double volume(const surface *of)
{
    double sum = 0;
    for (size_t f = 0; f < of->n_faces; ++f) {
        const double *a = of->vertices + 3 * of->faces[3 * f];
        const double *b = of->vertices + 3 * of->faces[3 * f + 1];
        const double *c = of->vertices + 3 * of->faces[3 * f + 2];
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6;
}

static void check_distance(const icc_domain *domain, const double *p, const uint32_t *faces,
                           const double *vertices, size_t n_faces)
{
    int32_t where;
    uint32_t facet;
    double bary[3], best = HUGE_VAL, ignored[3], found = 0;
    ck_assert(icc_domain_locate(domain, 1, p, &where, &facet, bary, NULL) == ICC_OK);
    for (size_t f = 0; f < n_faces; ++f) {
        const double *corners[3];
        for (int i = 0; i < 3; ++i)
            corners[i] = vertices + 3 * faces[3 * f + (size_t)i];
        best = fmin(best, iccp_simplex_nearest(3, 3, corners, p, ignored));
    }
    ck_assert(bary[0] >= 0 && bary[1] >= 0 && bary[2] >= 0);
    ck_assert(fabs(bary[0] + bary[1] + bary[2] - 1) < 1e-15);
    for (int k = 0; k < 3; ++k) {
        double x = -p[k];
        for (int i = 0; i < 3; ++i)
            x += bary[i] * vertices[3 * faces[3 * facet + (uint32_t)i] + (uint32_t)k];
        found += x * x;
    }
    ck_assert(fabs(sqrt(found) - sqrt(best)) < 1e-14);
}

static void check_points(const icc_domain *domain, const surface *of, int n, random_source *r)
{
    for (int i = 0; i < n; ++i) {
        double p[3];
        for (int k = 0; k < 3; ++k)
            p[k] = 2.4 * random_unit(r) - 1.2;
        const double turns = fabs(winding(of->n_faces, of->faces, of->vertices, p));
        ck_assert(where_is(domain, p[0], p[1], p[2]) == (turns > 0.5 ? ICC_INSIDE : ICC_OUTSIDE));
        check_distance(domain, p, of->faces, of->vertices, of->n_faces);
    }
}

/* Vertices are found as themselves, points of edges and faces on the boundary. */
static void check_own_points(const icc_domain *domain, const surface *of, random_source *r)
{
    for (size_t f = 0; f < of->n_faces; ++f) {
        double weights[3] = {1, random_unit(r), random_unit(r)};
        weights[2] = f % 2 ? 0 : weights[2];
        const double sum = weights[0] + weights[1] + weights[2];
        double p[3] = {0};
        for (int i = 0; i < 3; ++i) {
            const double *v = of->vertices + 3 * of->faces[3 * f + (size_t)i];
            int32_t where;
            uint32_t facet;
            double bary[3];
            ck_assert(icc_domain_locate(domain, 1, v, &where, &facet, bary, NULL) == ICC_OK);
            int corner = 0;
            while (corner < 3 && !(bary[corner] == 1))
                ++corner;
            ck_assert(where == ICC_BOUNDARY && corner < 3);
            ck_assert(of->faces[3 * facet + (uint32_t)corner] == of->faces[3 * f + (size_t)i]);
            for (int k = 0; k < 3; ++k)
                p[k] += weights[i] / sum * v[k];
        }
        ck_assert(where_is(domain, p[0], p[1], p[2]) == ICC_BOUNDARY);
    }
}

START_TEST(stars_are_domains)
{
    random_source r = {4};
    for (int round = 0; round < share_of(60); ++round) {
        surface_star(&s, round % 5, 0.9 * random_unit(&r), &r);
        const int orientation = round % 2 ? -1 : 1;
        if (orientation < 0)
            turn_over(&s);
        icc_domain *domain = make(&s);
        icc_domain_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
        ck_assert_int_eq(info.orientation, orientation);
        ck_assert_int_eq(info.dim, 3);
        ck_assert_uint_eq(info.n_facets, s.n_faces);
        ck_assert(fabs(info.measure - fabs(volume(&s))) < 1e-13);
        ck_assert_int_eq(where_is(domain, 0, 0, 0), ICC_INSIDE);
        check_points(domain, &s, round % 5 < 4 ? 100 : 20, &r);
        check_own_points(domain, &s, &r);
        icc_domain_free(domain);
    }
}
END_TEST

/* The lowest vertex and its neighbours decide on the orientation: all kinds of ties between
 * them. */
START_TEST(orientation_is_exact)
{
    random_source r = {5};
    int n_made = 0;
    for (int round = 0; round < share_of(40000); ++round) {
        surface_octahedron(&s);
        for (size_t i = 0; i < 18; ++i)
            s.vertices[i] = random_below(&r, 4);
        icc_domain *domain;
        icc_error err;
        if (create(&domain, &s, &err) != ICC_OK)
            continue;
        icc_domain_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
        const double expect = volume(&s);
        ck_assert((expect > 0) == (info.orientation > 0) && fabs(expect) > 0.1);
        ck_assert(fabs(info.measure - fabs(expect)) < 1e-13);
        icc_domain_free(domain);
        ++n_made;
    }
    ck_assert_int_gt(n_made, share_of(100));
}
END_TEST

static int in_shape(int x, int y, int z)
{
    return x >= 0 && y >= 0 && z >= 0 && x < 5 && y < 5 && z < 5 &&
           (z == 0 || (x == 0 && y < 4) || (y == 2 && x < 4 && z > 2) ||
            (x == 3 && y == 2 && z > 1));
}

/* Lines through lattice points run along edges and through vertices everywhere. */
START_TEST(lattice_points_are_placed)
{
    surface_cells(&s, 5, in_shape);
    icc_domain *domain;
    icc_error err;
    if (create(&domain, &s, &err) != ICC_OK)
        ck_abort_msg("%s", err.message);
    for (int code = 0; code < 12 * 12 * 12; ++code) {
        const int at[3] = {code % 12 - 1, code / 12 % 12 - 1, code / 144 - 1}; /* half cells */
        int n = 0, all = 0;
        for (int corner = 0; corner < 8; ++corner) {
            int cell[3];
            for (int k = 0; k < 3; ++k) {
                const int shift = corner >> k & 1;
                cell[k] = (at[k] + 20) / 2 - 10;
                cell[k] -= (at[k] & 1) == 0 && shift;
            }
            n += in_shape(cell[0], cell[1], cell[2]);
            ++all;
        }
        const int32_t expect = n == 0 ? ICC_OUTSIDE : n == all ? ICC_INSIDE : ICC_BOUNDARY;
        ck_assert(where_is(domain, 0.5 * at[0], 0.5 * at[1], 0.5 * at[2]) == expect);
        double p[3] = {0.5 * at[0], 0.5 * at[1], 0.5 * at[2]}, local[3];
        iccp_frame_in(&domain->frame, 3, p, local);
        for (int axis = 0; axis < 3; ++axis) {
            iccp_line_crossing crossings[64];
            const size_t n_crossings = iccp_tree_line(domain, axis, local, 64, crossings);
            ck_assert(n_crossings % 2 == 0 && n_crossings <= 64);
            size_t n_before = 0;
            for (size_t i = 0; i < n_crossings; ++i) {
                ck_assert(i == 0 || crossings[i - 1].at <= crossings[i].at);
                n_before += crossings[i].at < local[axis];
            }
            if (expect != ICC_BOUNDARY)
                ck_assert((n_before % 2 == 1) == (expect == ICC_INSIDE));
            ck_assert(iccp_tree_line(domain, axis, local, 1, crossings) == n_crossings);
        }
    }
    icc_domain_free(domain);
}
END_TEST

/* Segments from the inside to vertices, edges and faces and beyond. */
START_TEST(segments_do_not_slip_through)
{
    random_source r = {6};
    surface_star(&s, 3, 0.4, &r);
    icc_domain *domain = make(&s);
    for (size_t i = 0; i < 3 * s.n_faces; ++i) {
        const uint32_t *face = domain->facets + i - i % 3;
        const double origin[3] = {0, 0, 0};
        double target[3] = {0}, bary[3], share, sum = 0, end[3], at[3];
        uint32_t facet;
        for (size_t j = 0; j < 3; ++j) { /* a vertex, a point of an edge, a point of the face */
            const double weight = j == 0 ? 1 : j <= i % 3 ? random_unit(&r) : 0;
            sum += weight;
            for (int k = 0; k < 3; ++k)
                target[k] += weight * domain->vertices[3 * face[j] + (uint32_t)k];
        }
        for (int k = 0; k < 3; ++k)
            end[k] = 1.5 * target[k] / sum;
        ck_assert(iccp_domain_cross(domain, origin, end, &share, &facet, bary));
        ck_assert(fabs(share - 1 / 1.5) < 1e-14);
        iccp_domain_facet_point(domain, facet, bary, at);
        for (int k = 0; k < 3; ++k) {
            ck_assert(fabs(at[k] - target[k] / sum) < 1e-14);
            end[k] = 0.5 * target[k] / sum;
        }
        ck_assert(!iccp_domain_cross(domain, origin, end, &share, &facet, bary));
    }
    icc_domain_free(domain);
}
END_TEST

/* The same shape at other places and sizes, all exact. */
START_TEST(frames_keep_surfaces)
{
    static const double scales[] = {1e300, 1e-310, 0x1p-20, 0x1p-20};
    static const double offsets[] = {0, 0, 1e9, -0x1p30};
    random_source r = {7};
    surface_star(&t, 2, 0.5, &r);
    for (size_t i = 0; i < 3 * t.n_vertices; ++i)
        t.vertices[i] = round(1024 * t.vertices[i]);
    for (int round = 0; round < 4; ++round) {
        s = t;
        for (size_t i = 0; i < 3 * s.n_vertices; ++i)
            s.vertices[i] =
                s.vertices[i] * (round < 2 ? scales[round] / 1024 : scales[round]) + offsets[round];
        icc_domain *domain = make(&s);
        if (round == 0) /* elsewhere points of edges and faces are rounded by more than the
                           tolerance */
            check_own_points(domain, &s, &r);
        for (size_t i = 0; i < 3 * s.n_vertices; i += 3)
            ck_assert_int_eq(where_is(domain, s.vertices[i], s.vertices[i + 1], s.vertices[i + 2]),
                             ICC_BOUNDARY);
        const double o = offsets[round];
        ck_assert_int_eq(where_is(domain, o, o, o), ICC_INSIDE);
        ck_assert_int_eq(where_is(domain, o, o + 1e6 * scales[round], o), ICC_OUTSIDE);
        ck_assert_int_eq(where_is(domain, nan(""), o, o), ICC_OUTSIDE);
        ck_assert_int_eq(where_is(domain, HUGE_VAL, o, o), ICC_OUTSIDE);
        icc_domain_free(domain);
    }
    s = t;
    s.vertices[4] = 1e-300;
    refuse(&s, &(expected){ICC_ERR_BOUNDARY, 1, "less than 2^-200 of the largest one"});
}
END_TEST

START_TEST(unused_vertices_are_ignored)
{
    random_source r = {8};
    surface_star(&s, 1, 0.5, &r);
    s.vertices[3 * s.n_vertices] = nan("");
    s.vertices[3 * s.n_vertices + 1] = 1e308;
    s.vertices[3 * s.n_vertices + 2] = 1e-320;
    ++s.n_vertices;
    icc_domain *domain = make(&s);
    icc_domain_info info = {.size = sizeof info};
    double vertices[3 * 100];
    uint32_t faces[3 * 100];
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    ck_assert_uint_eq(info.n_vertices, s.n_vertices);
    ck_assert(info.upper[0] <= 1 && info.upper[1] <= 1);
    ck_assert_int_eq(icc_domain_get_boundary(domain, vertices, faces), ICC_OK);
    ck_assert_mem_eq(vertices, s.vertices, 3 * s.n_vertices * sizeof *vertices);
    ck_assert_mem_eq(faces, s.faces, 3 * s.n_faces * sizeof *faces);
    check_points(domain, &s, 100, &r);
    icc_domain_free(domain);
}
END_TEST

static icc_status make_and_free(const icc_env *env, icc_error *err, void *argument)
{
    const surface *of = argument;
    icc_domain *domain;
    const icc_status status = icc_domain_create(&domain, 3, of->n_vertices, of->vertices,
                                                of->n_faces, of->faces, env, err);
    ck_assert((domain != NULL) == (status == ICC_OK));
    icc_domain_free(domain);
    return status;
}

START_TEST(nothing_leaks)
{
    random_source r = {9};
    surface_star(&s, 3, 0.5, &r);
    faulty_sweep(make_and_free, &s);
}
END_TEST

/* ----------------------------------------------------------- other dimensions */

/* The cross-polytope |x_1| + ... + |x_n| <= 1 with 2^n facets. */
static void cross_polytope(surface *of, int dim)
{
    memset(of->vertices, 0, sizeof of->vertices);
    of->n_vertices = 2 * (size_t)dim;
    of->n_faces = 1u << dim;
    for (int k = 0; k < dim; ++k) {
        of->vertices[2 * k * dim + k] = 1;
        of->vertices[(2 * k + 1) * dim + k] = -1;
    }
    for (int f = 0; f < 1 << dim; ++f) {
        uint32_t *facet = of->faces + f * dim;
        int odd = 0;
        for (int k = 0; k < dim; ++k) {
            facet[k] = (uint32_t)(2 * k + (f >> k & 1));
            odd ^= f >> k & 1;
        }
        if (odd) {
            const uint32_t swap = facet[0];
            facet[0] = facet[1];
            facet[1] = swap;
        }
    }
}

static icc_status create_n(icc_domain **out, int dim, const surface *of, icc_error *err)
{
    *err = (icc_error){.size = sizeof *err};
    return icc_domain_create(out, dim, of->n_vertices, of->vertices, of->n_faces, of->faces, NULL,
                             err);
}

/* In local coordinates, where the polytope has a power of two in place of 1. */
static void check_lines(const icc_domain *domain, int dim, const double *p, int axis)
{
    const double one = domain->upper[0], origin[6] = {0};
    double sum = 0, share, bary[6];
    uint32_t facet;
    iccp_line_crossing line[2];
    for (int k = 0; k < dim; ++k)
        sum += fabs(p[k]);
    const double half = one - (sum - fabs(p[axis]));
    const size_t n = iccp_tree_line(domain, axis, p, 2, line);
    ck_assert(n == 2 || (n == 0 && half < 1e-14));
    if (n == 2 && half > 1e-9)
        ck_assert(fabs(line[0].at + half) < 1e-13 && fabs(line[1].at - half) < 1e-13);
    if (fabs(sum - one) < 1e-13)
        return;
    const bool out = iccp_domain_cross(domain, origin, p, &share, &facet, bary);
    ck_assert(out == (sum > one));
    ck_assert(!out || fabs(share - one / sum) < 1e-13);
}

static void check_cross_polytope(const icc_domain *domain, int dim, random_source *r)
{
    for (int i = 0; i < 4000; ++i) {
        double p[6], local[6], at[6], bary[6], sum = 0, distance2 = 0;
        int32_t where;
        uint32_t facet;
        for (int k = 0; k < dim; ++k) {
            p[k] = i % 2 ? (random_below(r, 9) - 4) / 8.0 : 1.5 * random_unit(r) - 0.75;
            sum += fabs(p[k]);
        }
        ck_assert(icc_domain_locate(domain, 1, p, &where, &facet, bary, NULL) == ICC_OK);
        ck_assert(where == (fabs(sum - 1) < 1e-14 ? ICC_BOUNDARY
                            : sum < 1             ? ICC_INSIDE
                                                  : ICC_OUTSIDE));
        iccp_domain_facet_point(domain, facet, bary, at);
        iccp_frame_out(&domain->frame, dim, at, at);
        for (int k = 0; k < dim; ++k)
            distance2 += (at[k] - p[k]) * (at[k] - p[k]);
        if (where != ICC_OUTSIDE) /* the nearest facet is the one of p's own orthant */
            ck_assert(fabs(sqrt(distance2) - fabs(1 - sum) / sqrt(dim)) < 1e-13);
        iccp_frame_in(&domain->frame, dim, p, local);
        check_lines(domain, dim, local, i % dim);
    }
}

START_TEST(polytopes_are_domains)
{
    random_source r = {10};
    double factorial = 2;
    for (int dim = 3; dim <= 6; ++dim) {
        icc_domain *domain;
        icc_error err;
        factorial *= dim;
        for (int turned = 0; turned < 2; ++turned) {
            cross_polytope(&s, dim);
            for (size_t f = 0; turned && f < s.n_faces; ++f) {
                uint32_t *facet = s.faces + f * (size_t)dim, swap = facet[1];
                facet[1] = facet[2];
                facet[2] = swap;
            }
            ck_assert_msg(create_n(&domain, dim, &s, &err) == ICC_OK, "%s", err.message);
            icc_domain_info info = {.size = sizeof info};
            ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
            ck_assert_int_eq(info.orientation, turned ? -1 : 1);
            ck_assert(fabs(info.measure - ldexp(1, dim) / factorial) < 1e-13);
            check_cross_polytope(domain, dim, &r);
            icc_domain_free(domain);
        }
    }
}
END_TEST

START_TEST(polytopes_are_checked)
{
    for (int dim = 4; dim <= 6; ++dim) {
        icc_domain *domain;
        icc_error err;
        const uint32_t n = 1u << dim;
        for (uint32_t f = 0; f < n; ++f) {
            cross_polytope(&s, dim);
            uint32_t *facet = s.faces + f * (uint32_t)dim, swap = facet[1];
            facet[1] = facet[2];
            facet[2] = swap;
            ck_assert_int_eq(create_n(&domain, dim, &s, &err), ICC_ERR_BOUNDARY);
            ck_assert_int_eq(err.index, f);
            ck_assert(strstr(err.message, "turned over") != NULL);
        }
        cross_polytope(&s, dim);
        --s.n_faces;
        ck_assert_int_eq(create_n(&domain, dim, &s, &err), ICC_ERR_BOUNDARY);
        ck_assert(strstr(err.message, "the boundary is open") != NULL);
        cross_polytope(&s, dim);
        for (size_t v = 0; v < s.n_vertices; ++v)
            s.vertices[v * (size_t)dim] = 0;
        ck_assert_int_eq(create_n(&domain, dim, &s, &err), ICC_ERR_BOUNDARY);
        ck_assert(strstr(err.message, "all vertices lie in one hyperplane") != NULL ||
                  strstr(err.message, "flat") != NULL);
        cross_polytope(&s, dim);
        s.vertices[1] = s.vertices[dim + 1] = 0.25; /* moves, stays convex */
        ck_assert_msg(create_n(&domain, dim, &s, &err) == ICC_OK, "%s", err.message);
        icc_domain_free(domain);
    }
}
END_TEST

/* A point x of a simplex is the nearest to p if and only if all corners v have (p - x)(v - x) <= 0:
 * else going that way makes the squared distance smaller by up to the square of that over (v
 * - x)^2. */
START_TEST(nearest_points_are_nearest)
{
    random_source r = {13};
    int n_inner = 0;
    for (int round = 0; round < share_of(200000); ++round) {
        const size_t dim = 1 + (size_t)random_below(&r, 6),
                     n = 1 + (size_t)random_below(&r, (int)dim);
        const double thin = random_below(&r, 3) == 0 ? ldexp(1, -random_below(&r, 70)) : 1;
        double v[6][6], p[6], x[6] = {0}, bary[6], sum = 0, away2 = 0;
        const double *corners[6];
        for (size_t i = 0; i < n; ++i) {
            corners[i] = v[i];
            for (size_t k = 0; k < dim; ++k)
                v[i][k] = (k == 0 ? 1 : thin) *
                          (random_below(&r, 2) ? random_unit(&r) : random_below(&r, 3) * 0.5);
        }
        for (size_t k = 0; k < dim; ++k)
            p[k] = (k == 0 ? 1 : thin) * (2 * random_unit(&r) - 0.5);
        const double distance2 = iccp_simplex_nearest(dim, n, corners, p, bary);
        for (size_t i = 0; i < n; ++i) {
            ck_assert(bary[i] >= 0);
            sum += bary[i];
            for (size_t k = 0; k < dim; ++k)
                x[k] += bary[i] * v[i][k];
        }
        ck_assert(fabs(sum - 1) < 1e-15);
        for (size_t k = 0; k < dim; ++k)
            away2 += (p[k] - x[k]) * (p[k] - x[k]);
        ck_assert(fabs(sqrt(away2) - sqrt(distance2)) < 1e-14);
        for (size_t i = 0; i < n; ++i) {
            double product = 0, length2 = 0;
            for (size_t k = 0; k < dim; ++k) {
                product += (p[k] - x[k]) * (v[i][k] - x[k]);
                length2 += (v[i][k] - x[k]) * (v[i][k] - x[k]);
            }
            ck_assert(product <= 0 || product * product <= length2 * (1e-15 * distance2 + 1e-31));
            n_inner += product > -1e-13;
        }
    }
    ck_assert_int_gt(n_inner, share_of(100000));
}
END_TEST

/* Two polytopes side by side, with or without a common vertex, and one within another. */
START_TEST(polytopes_are_counted)
{
    for (size_t dim = 4; dim <= 6; ++dim) {
        icc_domain *domain;
        icc_error err;
        for (int kind = 0; kind < 3; ++kind) {
            cross_polytope(&s, (int)dim);
            const uint32_t n = (uint32_t)s.n_vertices, n_facets = (uint32_t)s.n_faces;
            for (size_t i = 0; i < dim * n; ++i)
                s.vertices[dim * n + i] =
                    kind == 2 ? 0.5 * s.vertices[i] : s.vertices[i] + (i % dim == 0 ? 2 + kind : 0);
            for (size_t i = 0; i < dim * n_facets; ++i) {
                const uint32_t v = s.faces[i] + n;
                s.faces[dim * n_facets + i] = kind == 0 && v == n + 1 ? 0 : v;
            }
            s.n_vertices *= 2;
            s.n_faces *= 2;
            const icc_status status = create_n(&domain, (int)dim, &s, &err);
            ck_assert_int_eq(status, kind == 0 ? ICC_ERR_BOUNDARY : ICC_ERR_TOPOLOGY);
            ck_assert_int_eq(err.index, kind == 0 ? 0 : n_facets);
            ck_assert(strstr(err.message, kind == 0 ? "two surfaces share vertex 0"
                                                    : "more than one component") != NULL);
        }
    }
}
END_TEST

START_TEST(intervals_are_domains)
{
    const double ends[3] = {5, 2, 9};
    const uint32_t facets[2] = {2, 1};
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_create(&domain, 1, 3, ends, 2, facets, NULL, &err), ICC_OK);
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    ck_assert(info.orientation == -1 && info.measure == 7 && info.lower[0] == 2 &&
              info.upper[0] == 9);
    const double points[6] = {1, 2, 4, 8, 9, 10};
    const int32_t expect[6] = {ICC_OUTSIDE, ICC_BOUNDARY, ICC_INSIDE,
                               ICC_INSIDE,  ICC_BOUNDARY, ICC_OUTSIDE};
    const uint32_t nearest[6] = {1, 1, 1, 0, 0, 0};
    int32_t where[6];
    uint32_t facet[6];
    double bary[6];
    ck_assert_int_eq(icc_domain_locate(domain, 6, points, where, facet, bary, NULL), ICC_OK);
    for (int i = 0; i < 6; ++i)
        ck_assert(where[i] == expect[i] && facet[i] == nearest[i] && bary[i] == 1);
    double local[6], share, one;
    iccp_line_crossing line[2];
    for (int i = 0; i < 6; ++i)
        iccp_frame_in(&domain->frame, 1, points + i, local + i);
    ck_assert_uint_eq(iccp_tree_line(domain, 0, local, 2, line), 2);
    ck_assert(line[0].at == local[1] && line[0].facet == 1);
    ck_assert(line[1].at == local[4] && line[1].facet == 0);
    ck_assert(iccp_domain_cross(domain, local + 2, local + 5, &share, facet, &one));
    ck_assert(facet[0] == 0 && one == 1 && fabs(share - 5.0 / 6) < 1e-15);
    ck_assert(!iccp_domain_cross(domain, local + 2, local + 3, &share, facet, &one));
    icc_domain_free(domain);
    ck_assert_int_eq(icc_domain_create(&domain, 1, 3, ends, 3, facets, NULL, &err),
                     ICC_ERR_BOUNDARY);
    const uint32_t same[2] = {1, 1}, beyond[2] = {0, 3};
    ck_assert_int_eq(icc_domain_create(&domain, 1, 3, ends, 2, same, NULL, &err), ICC_ERR_BOUNDARY);
    ck_assert_int_eq(icc_domain_create(&domain, 1, 3, ends, 2, beyond, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.index, 1);
}
END_TEST

/* The queries for any dimension, on polygons. */
START_TEST(polygons_answer_too)
{
    enum { N = 200 };
    random_source r = {11};
    double polygon[2 * N];
    for (int i = 0; i < N; ++i) {
        const double radius = 0.5 + 0.5 * random_unit(&r), angle = 6.283185307179586 * i / N;
        polygon[2 * i] = radius * cos(angle);
        polygon[2 * i + 1] = radius * sin(angle);
    }
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, N, polygon, 0, NULL, NULL, NULL), ICC_OK);
    for (int i = 0; i < 20000; ++i) {
        const double p[2] = {2 * random_unit(&r) - 1,
                             i % 2 ? domain->vertices[2 * (i % N) + 1] : 2 * random_unit(&r) - 1};
        const double origin[2] = {0, 0};
        iccp_line_crossing line[N];
        double share, bary[2];
        uint32_t facet;
        const size_t n = iccp_tree_line(domain, 0, p, N, line);
        size_t n_before = 0;
        for (size_t k = 0; k < n; ++k)
            n_before += line[k].at < p[0];
        const bool inside = iccp_domain_locate(domain, p, true, NULL, NULL) == ICC_INSIDE;
        ck_assert(n % 2 == 0 && (n_before % 2 == 1) == inside);
        ck_assert(iccp_domain_cross(domain, origin, p, &share, &facet, bary) || inside);
    }
    icc_domain_free(domain);
}
END_TEST

/* --------------------------------------------------------------- real surfaces */

START_TEST(real_surfaces_are_accepted)
{
    char pattern[512];
    glob_t files;
    random_source r = {12};
    (void)snprintf(pattern, sizeof pattern, "%s/3d/*.obj", shared());
    if (glob(pattern, 0, NULL, &files) != 0)
        return;
    for (size_t i = 0; i < files.gl_pathc; ++i) {
        obj o;
        icc_domain *domain;
        icc_error err = {.size = sizeof err};
        icc_domain_info info = {.size = sizeof info};
        ck_assert(obj_read(&o, files.gl_pathv[i]));
        const icc_status status =
            icc_domain_create(&domain, 3, o.n_vertices, o.vertices, o.n_faces, o.faces, NULL, &err);
        ck_assert_msg(status == ICC_OK, "%s: %s", files.gl_pathv[i], err.message);
        ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
        ck_assert_int_eq(info.orientation, 1);
        for (int k = 0; k < 200; ++k) {
            double p[3];
            for (int a = 0; a < 3; ++a)
                p[a] = random_between(&r, info.lower[a], info.upper[a]);
            const double turns = winding(o.n_faces, o.faces, o.vertices, p);
            ck_assert(where_is(domain, p[0], p[1], p[2]) ==
                      (turns > 0.5 ? ICC_INSIDE : ICC_OUTSIDE));
        }
        icc_domain_free(domain);
        obj_free(&o);
    }
    globfree(&files);
}
END_TEST

START_TEST(bad_files_are_refused)
{
    static const struct {
        const char *name;
        expected error;
    } files[] = {
        {"c01_open.src", {ICC_ERR_BOUNDARY, 14, "open (3 such edges)"}},
        {"c02_open_tgt_only.tgt", {ICC_ERR_BOUNDARY, 14, "open (3 such edges)"}},
        {"c03_nonmanifold_edge.src", {ICC_ERR_BOUNDARY, 576, "belongs to 3 faces"}},
        {"c04_nonmanifold_vertex.src", {ICC_ERR_BOUNDARY, 0, "two surfaces share vertex 0"}},
        {"c05_inside_out.src", {ICC_OK, -1, NULL}},
        {"c06_one_flipped_face.src", {ICC_ERR_BOUNDARY, 5, "turned over"}},
        {"c07_tgt_mirrored.tgt", {ICC_OK, -1, NULL}},
        {"c08_genus1.src", {ICC_OK, -1, NULL}},
        {"c09_two_components.src", {ICC_ERR_TOPOLOGY, 576, "more than one component"}},
        {"c10_inner_void.src", {ICC_ERR_BOUNDARY, 58, "faces 58 and 895"}},
        {"c11_nan.src", {ICC_ERR_BOUNDARY, 3, "vertex 3 is not finite"}},
        {"c12_degenerate_face.src", {ICC_ERR_BOUNDARY, 81, "faces 81 and 261"}},
        {"c13_unreferenced_vertex_ok.src", {ICC_OK, -1, NULL}},
        {"c14_soup_unwelded.src", {ICC_ERR_BOUNDARY, 0, "open (1728 such edges)"}},
        {"c15_count_mismatch.tgt", {ICC_ERR_BOUNDARY, 501, "names vertex 289"}},
        {"c16_huge_1e300.src", {ICC_OK, -1, NULL}},
        {"c17_denormal.src", {ICC_OK, -1, NULL}},
        {"c18_flat_tgt.tgt", {ICC_ERR_BOUNDARY, -1, "in one plane"}},
        {"c19_tgt_selfint.tgt", {ICC_ERR_BOUNDARY, 79, "faces 79 and 302"}},
        {"c20_permuted_faces_ok.tgt", {ICC_OK, -1, NULL}},
        {"c21_zero_based.src", {ICC_ERR_BOUNDARY, 0, "names vertex"}},
        {"c22_neg_index_ok.src", {ICC_OK, -1, NULL}},
        {"c24_empty.src", {ICC_ERR_BOUNDARY, -1, "at least 4 facets, not 0"}},
        {"n_cylinder_open.src", {ICC_ERR_BOUNDARY, 0, "open (40 such edges)"}},
        {"n_dolphin_open.src", {ICC_ERR_BOUNDARY, 70, "open (6 such edges)"}},
        {"n_flag_2comp_selfint.src", {ICC_ERR_BOUNDARY, 0, "faces 0 and 199"}},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        char path[512];
        obj o;
        icc_domain *domain;
        icc_error err = {.size = sizeof err, .index = -1};
        const expected *e = &files[i].error;
        (void)snprintf(path, sizeof path, "%s/bad/3d/%s.obj", shared(), files[i].name);
        if (!obj_read(&o, path))
            continue;
        const icc_status status =
            icc_domain_create(&domain, 3, o.n_vertices, o.vertices, o.n_faces, o.faces, NULL, &err);
        ck_assert_msg(status == e->status && err.index == e->index &&
                          (e->text == NULL || strstr(err.message, e->text) != NULL),
                      "%s: %ld %ld %s", files[i].name, (long)status, (long)err.index, err.message);
        icc_domain_free(domain);
        obj_free(&o);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("surface");
    TCase *tests = tcase_create("surface");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, each_face_is_named);
    tcase_add_test(tests, holes_are_named);
    tcase_add_test(tests, components_are_named);
    tcase_add_test(tests, handles_are_counted);
    tcase_add_test(tests, voids_are_counted);
    tcase_add_test(tests, flat_shapes_are_refused);
    tcase_add_test(tests, intersections_are_named);
    tcase_add_test(tests, triangles_agree_with_integers);
    tcase_add_test(tests, soups_are_searched);
    tcase_add_test(tests, fans_are_safe);
    tcase_add_test(tests, needles_are_searched);
    tcase_add_test(tests, needles_leak_nothing);
    tcase_add_test(tests, stars_are_domains);
    tcase_add_test(tests, orientation_is_exact);
    tcase_add_test(tests, lattice_points_are_placed);
    tcase_add_test(tests, segments_do_not_slip_through);
    tcase_add_test(tests, frames_keep_surfaces);
    tcase_add_test(tests, unused_vertices_are_ignored);
    tcase_add_test(tests, nothing_leaks);
    tcase_add_test(tests, polytopes_are_domains);
    tcase_add_test(tests, polytopes_are_checked);
    tcase_add_test(tests, polytopes_are_counted);
    tcase_add_test(tests, nearest_points_are_nearest);
    tcase_add_test(tests, intervals_are_domains);
    tcase_add_test(tests, polygons_answer_too);
    tcase_add_test(tests, real_surfaces_are_accepted);
    tcase_add_test(tests, bad_files_are_refused);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
