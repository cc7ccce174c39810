/* Filling solids with features: all given vertices and faces stay, inner surfaces have the domain on
 * both sides, and lines are edges of the mesh. */
#include "../../domains.h"
#include "../../faulty.h"
#include "../../flat_mesh.h"
#include "../../hollow_bodies.h"
#include "../../share.h"
#include "../../suite.h"
#include "domain/domain.h"
#include "fill/points.h"
#include "geometry/simplices.h"
#include "icc/icc.h"
#include "math/predicates.h"

#include <check.h>
#include <stdlib.h>

enum { MOST = 64, MOST_POINTS = 4096 };

/* A body under construction. */
typedef struct body {
    surface outer;
    icc_feature feature[MOST];
    double volume[MOST]; /* inside closed surfaces */
    size_t n;
    double points[3 * MOST_POINTS];
    uint32_t facets[3 * MOST_POINTS];
    size_t n_points, n_facets;
} body;

static body b;
static surface shape;
static random_source r;

static double inside_of(const surface *s)
{
    static const double origin[3] = {0, 0, 0};
    double six = 0;
    for (size_t f = 0; f < s->n_faces; ++f) {
        const uint32_t *const v = s->faces + 3 * f;
        six += iccp_points_volume(origin, s->vertices + 3 * v[0], s->vertices + 3 * v[1],
                                  s->vertices + 3 * v[2]);
    }
    return fabs(six) / 6;
}

static void add(int32_t kind, size_t n_points, const double *points)
{
    double *const to = b.points + 3 * b.n_points;
    ck_assert_uint_le(b.n_points + n_points, MOST_POINTS);
    memcpy(to, points, 3 * n_points * sizeof *to);
    b.n_points += n_points;
    b.feature[b.n++] = (icc_feature){
        .size = sizeof(icc_feature), .kind = kind, .n_vertices = n_points, .vertices = to};
}

static void add_surface(int32_t kind)
{
    uint32_t *const to = b.facets + 3 * b.n_facets;
    ck_assert_uint_le(b.n_facets + shape.n_faces, MOST_POINTS);
    memcpy(to, shape.faces, 3 * shape.n_faces * sizeof *to);
    b.n_facets += shape.n_faces;
    b.volume[b.n] = inside_of(&shape);
    add(kind, shape.n_vertices, shape.vertices);
    b.feature[b.n - 1].n_facets = shape.n_faces;
    b.feature[b.n - 1].facets = to;
}

static void begin(int splits)
{
    b.n = b.n_points = b.n_facets = 0;
    r = (random_source){1};
    surface_star(&b.outer, splits, 0.1, &r);
}

static icc_domain *make(void)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create_solid(&domain, b.outer.n_vertices, b.outer.vertices,
                                          b.outer.n_faces, b.outer.faces, b.n, b.feature, NULL,
                                          &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

static void check_boundary(const icc_domain *solid, const icc_domain *filled)
{
    const icc_domain_info info = info_of_domain(filled);
    const size_t n = b.outer.n_vertices + b.n_points;
    double *const x = malloc(3 * info.n_mesh_vertices * sizeof *x);
    uint32_t *const cells = malloc(4 * info.n_mesh_simplices * sizeof *cells);
    ck_assert_uint_eq(info.n_vertices, n);
    ck_assert_uint_eq(solid->n_facets, filled->n_facets);
    ck_assert_mem_eq(solid->facets, filled->facets,
                     3 * (b.outer.n_faces + b.n_facets) * sizeof *filled->facets);
    ck_assert_int_eq(flat_domain_mesh(filled, x, cells), ICC_OK);
    ck_assert_mem_eq(x, b.outer.vertices, 3 * b.outer.n_vertices * sizeof *x);
    ck_assert_mem_eq(x + 3 * b.outer.n_vertices, b.points, 3 * b.n_points * sizeof *x);
    free(x);
    free(cells);
}

/* Writes the volume of each region. */
static void measure_regions(const icc_domain *filled, double *volume)
{
    const icc_domain_info info = info_of_domain(filled);
    double *const x = malloc(3 * info.n_mesh_vertices * sizeof *x);
    uint32_t *const t = malloc(4 * info.n_mesh_simplices * sizeof *t);
    uint32_t *const regions = malloc(info.n_mesh_simplices * sizeof *regions);
    ck_assert_int_eq(flat_domain_mesh(filled, x, t), ICC_OK);
    ck_assert_int_eq(icc_domain_get_regions(filled, regions), ICC_OK);
    for (size_t k = 0; k <= info.n_regions; ++k)
        volume[k] = 0;
    for (size_t i = 0; i < info.n_mesh_simplices; ++i) {
        const uint32_t *const c = t + 4 * i;
        const double six =
            iccp_points_volume(x + 3 * c[0], x + 3 * c[1], x + 3 * c[2], x + 3 * c[3]);
        ck_assert_uint_le(regions[i], info.n_regions);
        ck_assert(six > 0);
        ck_assert_int_gt(iccp_orient3d(x + 3 * c[0], x + 3 * c[1], x + 3 * c[2], x + 3 * c[3]), 0);
        volume[regions[i]] += six / 6;
    }
    free(x);
    free(t);
    free(regions);
}

/* Points on lines are no farther from the straight line than rounding puts them. */
static void check_lines(const icc_domain *filled)
{
    const iccp_simplices *const mesh = filled->mesh;
    for (size_t k = 0; k < mesh->n_on_lines; ++k) {
        const iccp_on_line *const p = &mesh->on_line[k];
        for (size_t i = 0; i < 3; ++i) {
            const double straight = (1 - p->share) * mesh->points[3 * (size_t)p->a + i] +
                                    p->share * mesh->points[3 * (size_t)p->b + i];
            ck_assert_double_eq_tol(mesh->points[3 * (size_t)p->point + i], straight, 1e-15);
        }
    }
}

/* The domain checks exactly that the mesh fills the solid. */
static icc_domain *fill(void)
{
    icc_domain *const solid = make(), *filled;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_fill(&filled, solid, NULL, NULL, &err) == ICC_OK, "%s", err.message);
    check_boundary(solid, filled);
    check_lines(filled);
    icc_domain_free(solid);
    return filled;
}

START_TEST(points)
{
    begin(3);
    for (int i = 0; i < 40; ++i) {
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = random_unit(&r) - 0.5;
        add(ICC_FEATURE_POINT, 1, x);
    }
    icc_domain_free(fill());
}
END_TEST

/* A void in a region in a region, and beside them a ring that divides the domain. */
START_TEST(nested_surfaces)
{
    double volume[4];
    begin(3);
    surface_star(&shape, 2, 0.2, &r);
    surface_place(&shape, 0, 0.1, 0.4, 0, 0);
    add_surface(ICC_FEATURE_HOLE);
    surface_star(&shape, 2, 0.1, &r);
    surface_place(&shape, 0, 0.2, 0.4, 0, 0);
    add_surface(ICC_FEATURE_REGION);
    surface_star(&shape, 2, 0, &r);
    surface_place(&shape, 0, 0.35, 0.4, 0, 0);
    add_surface(ICC_FEATURE_REGION);
    surface_tube(&shape, 16, 5, 0.3, tube_circle);
    surface_place(&shape, 1, 0.2, -0.4, 0.1, 0);
    add_surface(ICC_FEATURE_REGION);
    icc_domain *const filled = fill();
    const double all = info_of_domain(filled).measure;
    measure_regions(filled, volume);
    ck_assert_double_eq_tol(volume[1], b.volume[1] - b.volume[0], 1e-12);
    ck_assert_double_eq_tol(volume[2], b.volume[2] - b.volume[1], 1e-12);
    ck_assert_double_eq_tol(volume[3], b.volume[3], 1e-12);
    ck_assert_double_eq_tol(volume[0], inside_of(&b.outer) - b.volume[2] - b.volume[3], 1e-12);
    ck_assert_double_eq_tol(volume[0] + volume[1] + volume[2] + volume[3], all, 1e-12);
    icc_domain_free(filled);
}
END_TEST

/* Two rings that are linked. */
START_TEST(linked_regions)
{
    double volume[3];
    begin(3);
    for (int i = 0; i < 2; ++i) {
        surface_tube(&shape, 20, 6, 0.2, tube_circle);
        surface_place(&shape, i, 0.4, i == 0 ? 0.2 : -0.2, 0, 0);
        add_surface(ICC_FEATURE_REGION);
    }
    icc_domain *const filled = fill();
    measure_regions(filled, volume);
    for (int i = 0; i < 2; ++i)
        ck_assert_double_eq_tol(volume[1 + i], b.volume[i], 1e-12);
    icc_domain_free(filled);
}
END_TEST

/* Walls that bend in, so that points must be put on them, with the domain on both sides. */
START_TEST(twisted_regions)
{
    static const double corner[6][2] = {{1, 0},       {-0.5, 0.866}, {-0.5, -0.866},
                                        {0.87, 0.49}, {-0.86, 0.51}, {0, -1}};
    static const uint32_t faces[24] = {0, 2, 1, 3, 4, 5, 0, 1, 3, 1, 4, 3,
                                       1, 2, 4, 2, 5, 4, 2, 0, 5, 0, 3, 5};
    double volume[2];
    begin(3);
    shape.n_vertices = shape.n_faces = 0;
    for (int i = 0; i < 6; ++i)
        surface_vertex(&shape, 0.3 * corner[i][0], 0.3 * corner[i][1], i < 3 ? -0.3 : 0.3);
    for (size_t f = 0; f < 8; ++f)
        surface_face(&shape, faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]);
    add_surface(ICC_FEATURE_REGION);
    icc_domain *const filled = fill();
    measure_regions(filled, volume);
    ck_assert_double_eq_tol(volume[1], b.volume[0], 1e-12);
    icc_domain_free(filled);
}
END_TEST

/* Long lines side by side across many tetrahedra. Points must be put on them. */
static void add_lines(uint32_t n)
{
    for (uint32_t i = 0; i < n; ++i) {
        double line[9];
        for (int k = 0; k < 3; ++k) {
            line[3 * k] = 0.6 * (k - 1);
            line[3 * k + 1] = 0.5 * sin(2.4 * i + 0.3 * k);
            line[3 * k + 2] = 0.5 * cos(2.4 * i + 0.3 * k) + 1e-3 * i;
        }
        add(ICC_FEATURE_LINE, 3, line);
    }
}

START_TEST(lines)
{
    size_t n_on_lines = 0;
    for (uint32_t n = 1; n < 40; n += 6) {
        begin(2);
        add_lines(n);
        icc_domain *const filled = fill();
        n_on_lines += filled->mesh->n_on_lines;
        icc_domain_free(filled);
    }
    ck_assert_uint_gt(n_on_lines, 0);
}
END_TEST

/* ---- random solids ---- */

/* A ball inside the solid for one feature, or for one in another. */
typedef struct ball {
    double centre[3], radius;
} ball;

static int is_beam(int x, int y, int z)
{
    return (x % 2 != 0) + (y % 2 != 0) + (z % 2 != 0) < 2;
}

/* Draws a body: a star, a ring, a knot or a frame of cubes with six holes. */
static void draw_outer(int kind)
{
    switch (kind) {
    case 0:
        surface_star(&b.outer, 3, 0.3, &r);
        return;
    case 1:
        surface_tube(&b.outer, 24, 8, 0.35, tube_circle);
        return;
    case 2:
        surface_tube(&b.outer, 60, 8, 0.4, tube_trefoil);
        return;
    default:
        surface_cells(&b.outer, 3, is_beam);
        return;
    }
}

/* Draws a ball that lies in the body. */
static ball draw_ball(int kind)
{
    ball at = {{0}, random_between(&r, 0.5, 1)};
    const double angle = random_between(&r, 0, 6.28);
    switch (kind) {
    case 0:
        at.radius *= 0.2;
        for (int k = 0; k < 3; ++k)
            at.centre[k] = random_between(&r, -0.25, 0.25);
        break;
    case 1:
        at.radius *= 0.2;
        tube_circle(angle, at.centre);
        break;
    case 2:
        at.radius *= 0.2;
        tube_trefoil(angle, at.centre);
        break;
    default:
        at.radius *= 0.4;
        for (int k = 0; k < 3; ++k)
            at.centre[k] = (k == 0 ? 0 : 2) + 0.5;
        at.centre[random_below(&r, 3)] = random_between(&r, 0.5, 2.5);
        break;
    }
    return at;
}

static bool is_apart(const ball *balls, size_t n)
{
    for (size_t i = 0; i < n; ++i) {
        double square = 0;
        for (int k = 0; k < 3; ++k) {
            const double d = balls[i].centre[k] - balls[n].centre[k];
            square += d * d;
        }
        if (sqrt(square) < 1.05 * (balls[i].radius + balls[n].radius))
            return false;
    }
    return true;
}

/* Adds a star or a ring that fills a share of a at. */
static void draw_surface(const ball *at, double share, int32_t kind)
{
    const bool ring = random_below(&r, 3) == 0;
    const double scale = share * at->radius / (ring ? 1.3 : 1);
    if (ring)
        surface_tube(&shape, 14, 5, 0.25, tube_circle);
    else
        surface_star(&shape, 1 + random_below(&r, 2), 0.3, &r);
    surface_place(&shape, random_below(&r, 3), scale, at->centre[0], at->centre[1], at->centre[2]);
    add_surface(kind);
}

static void draw_line(const ball *at)
{
    double x[18];
    const size_t n = 2 + (size_t)random_below(&r, 5);
    for (size_t i = 0; i < 3 * n; ++i)
        x[i] = at->centre[i % 3] + 0.57 * at->radius * random_between(&r, -1, 1);
    add(ICC_FEATURE_LINE, n, x);
}

/* Draws a feature, or a void in a region. Adds the volumes of regions. */
static void draw_feature(const ball *at, double *volume, size_t *n_regions)
{
    const size_t first = b.n;
    const int kind = random_below(&r, 5);
    switch (kind) {
    case 0:
        draw_surface(at, 1, ICC_FEATURE_HOLE);
        break;
    case 1:
        draw_surface(at, 1, ICC_FEATURE_REGION);
        break;
    case 2:
        surface_star(&shape, 2, 0.2, &r);
        surface_place(&shape, 0, at->radius, at->centre[0], at->centre[1], at->centre[2]);
        add_surface(ICC_FEATURE_REGION);
        draw_surface(at, 0.5, ICC_FEATURE_HOLE);
        break;
    case 3:
        draw_line(at);
        return;
    default:
        add(ICC_FEATURE_POINT, 1, at->centre);
        return;
    }
    volume[0] -= b.volume[first];
    if (kind > 0)
        volume[++*n_regions] = b.volume[first] - (kind == 2 ? b.volume[first + 1] : 0);
}

static void draw_solid(uint64_t seed, double *volume)
{
    ball balls[6];
    size_t n_regions = 0;
    const int kind = (int)(seed % 4);
    begin(0);
    r = (random_source){seed};
    draw_outer(kind);
    volume[0] = inside_of(&b.outer);
    for (size_t n = 0, tries = 0; n < 6 && tries < 40; ++tries) {
        balls[n] = draw_ball(kind);
        if (is_apart(balls, n))
            draw_feature(&balls[n++], volume, &n_regions);
    }
}

/* Bodies with handles, with voids, regions, lines and points inside. The volume of each region is
 * that between its given surfaces. */
START_TEST(random_solids)
{
    for (uint64_t seed = 1; seed <= (uint64_t)share_of(100); ++seed) {
        double wanted[8], volume[8];
        draw_solid(seed, wanted);
        icc_domain *const filled = fill();
        measure_regions(filled, volume);
        for (size_t k = 0; k <= info_of_domain(filled).n_regions; ++k)
            ck_assert_double_eq_tol(volume[k], wanted[k], 1e-12 * inside_of(&b.outer));
        icc_domain_free(filled);
    }
}
END_TEST

static icc_status fill_once(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *filled;
    const icc_status status = icc_domain_fill(&filled, argument, NULL, env, err);
    ck_assert((filled != NULL) == (status == ICC_OK));
    icc_domain_free(filled);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    static const double point[3] = {-0.3, 0.2, 0.1};
    begin(0);
    surface_octahedron(&shape);
    surface_place(&shape, 0, 0.1, 0.3, 0, 0);
    add_surface(ICC_FEATURE_REGION);
    add(ICC_FEATURE_POINT, 1, point);
    for (uint32_t i = 0; i < 3; ++i) {
        const double line[6] = {-0.2 + 0.1 * i, -0.2, -0.2, 0.2, -0.2 + 0.1 * i, 0.2};
        add(ICC_FEATURE_LINE, 2, line);
    }
    icc_domain *const solid = make();
    faulty_sweep(fill_once, solid);
    icc_domain_free(solid);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fill_features");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, points);
    tcase_add_test(tests, nested_surfaces);
    tcase_add_test(tests, linked_regions);
    tcase_add_test(tests, twisted_regions);
    tcase_add_test(tests, lines);
    tcase_add_test(tests, random_solids);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
