/* Filling surfaces: the surface stays as it is, what comes out is a mesh, and what cannot be filled is
 * named; and the exact signs that all this rests on. */
#include "../../domains.h"
#include "../../faulty.h"
#include "../../flat_mesh.h"
#include "../../hard_bodies.h"
#include "../../hollow_bodies.h"
#include "../../obj.h"
#include "../../suite.h"
#include "domain/domain.h"
#include "fill/fixed.h"
#include "fill/points.h"
#include "icc/icc.h"

#include <check.h>
#include <stdlib.h>

static icc_domain *make(const surface *s)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create(&domain, 3, s->n_vertices, s->vertices, s->n_faces, s->faces,
                                    NULL, &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

static double volume_of(const icc_domain *domain)
{
    const icc_domain_info info = info_of_domain(domain);
    double *x = malloc(3 * info.n_mesh_vertices * sizeof *x);
    uint32_t *t = malloc(4 * info.n_mesh_simplices * sizeof *t);
    ck_assert_int_eq(flat_domain_mesh(domain, x, t), ICC_OK);
    double volume = 0;
    for (size_t i = 0; i < info.n_mesh_simplices; ++i) {
        const double *p[4];
        for (size_t k = 0; k < 4; ++k) {
            ck_assert_uint_lt(t[4 * i + k], info.n_mesh_vertices);
            p[k] = x + 3 * t[4 * i + k];
        }
        const double six = iccp_points_volume(p[0], p[1], p[2], p[3]);
        ck_assert(six > -1e-9 * info.measure);
        volume += six / 6;
    }
    free(x);
    free(t);
    return volume;
}

/* Fills a surface, of which every vertex belongs to a face, and checks that it has its own vertices
 * and faces, bit by bit. */
static icc_domain *fill(const surface *s, const icc_fill_options *options)
{
    icc_domain *domain = make(s), *filled;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_fill(&filled, domain, options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    const icc_domain_info info = info_of_domain(filled);
    ck_assert_uint_eq(info.n_vertices, s->n_vertices);
    ck_assert_uint_eq(info.n_facets, s->n_faces);
    double *vertices = malloc(3 * info.n_vertices * sizeof *vertices);
    uint32_t *faces = malloc(3 * info.n_facets * sizeof *faces);
    ck_assert_int_eq(icc_domain_get_boundary(filled, vertices, faces), ICC_OK);
    ck_assert_mem_eq(vertices, s->vertices, 3 * info.n_vertices * sizeof *vertices);
    ck_assert_mem_eq(faces, s->faces, 3 * info.n_facets * sizeof *faces);
    free(vertices);
    free(faces);
    ck_assert_double_eq_tol(volume_of(filled), info.measure, 1e-9 * info.measure);
    icc_domain_free(domain);
    return filled;
}

static void check_fills(const surface *s)
{
    icc_domain_free(fill(s, NULL));
}

static void turn(surface *s, double stretch)
{
    static const double c[3] = {0.28, 0.6, 0.8}, n[3] = {0.96, 0.8, 0.6};
    for (size_t v = 0; v < s->n_vertices; ++v) {
        double *x = s->vertices + 3 * v;
        x[1] *= stretch;
        for (int k = 0; k < 3; ++k) {
            const double a = x[k], b = x[(k + 1) % 3];
            x[k] = c[k] * a - n[k] * b;
            x[(k + 1) % 3] = n[k] * a + c[k] * b;
        }
    }
}

static surface shape;

START_TEST(simple_shapes)
{
    random_source r = {1};
    surface_octahedron(&shape);
    check_fills(&shape);
    for (int splits = 1; splits < 5; ++splits) {
        surface_star(&shape, splits, 0.0, &r);
        check_fills(&shape);
        surface_star(&shape, splits, 0.5, &r);
        check_fills(&shape);
        turn(&shape, 1e-2);
        check_fills(&shape);
    }
}
END_TEST

START_TEST(a_tetrahedron_is_one)
{
    static const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    const icc_fill_options options = {.size = sizeof options, .ratio = HUGE_VAL};
    shape.n_vertices = shape.n_faces = 4;
    memcpy(shape.vertices, corners, sizeof corners);
    memcpy(shape.faces, faces, sizeof faces);
    icc_domain *filled = fill(&shape, &options);
    ck_assert_uint_eq(info_of_domain(filled).n_mesh_simplices, 1);
    ck_assert_uint_eq(info_of_domain(filled).n_mesh_vertices, 4);
    icc_domain_free(filled);
}
END_TEST

/* Rods, a thousand times as long as they are thick, and askew. */
START_TEST(stretched_bodies)
{
    for (uint64_t seed = 6; seed < 6 + (uint64_t)share_of(6); ++seed) {
        random_source r = {seed};
        surface_star(&shape, 4, 0.5, &r);
        turn(&shape, 1);
        turn(&shape, 1e3);
        check_fills(&shape);
    }
}
END_TEST

/* The same with steps, whose corners are on lines and in planes but for the last bit; simple shares
 * of edges are there, too. */
START_TEST(stretched_grids)
{
    static const uint64_t seeds[] = {30, 36, 28};
    for (int i = 0; i < share_of(3); ++i) {
        random_source r = {seeds[i]};
        surface_star(&shape, 4, 0.5, &r);
        surface_heap(&shape, 9, &r);
        turn(&shape, 1);
        turn(&shape, 1e3);
        check_fills(&shape);
    }
}
END_TEST

static int any_cell(int x, int y, int z)
{
    return (x + y + z) % 2 == 0 || x == 1 || y == 1 || z == 1;
}

START_TEST(coplanar_grids)
{
    for (int n = 1; n < 7; ++n) {
        surface_cells(&shape, n, any_cell);
        icc_domain *domain;
        if (icc_domain_create(&domain, 3, shape.n_vertices, shape.vertices, shape.n_faces,
                              shape.faces, NULL, NULL) != ICC_OK)
            continue;
        icc_domain_free(domain);
        check_fills(&shape);
        turn(&shape, 1);
        check_fills(&shape);
        turn(&shape, 1e-4);
        check_fills(&shape);
    }
}
END_TEST

START_TEST(twisted_prisms)
{
    static const double twists[] = {.1, .3, .5, .52, .523, .5235};
    static const double heights[] = {2, 200, .002};
    for (size_t i = 0; i < sizeof twists / sizeof *twists; ++i)
        for (int sign = -1; sign < 2; sign += 2) {
            surface_prism(&shape, 3, sign * twists[i], 1);
            check_fills(&shape);
        }
    for (int i = 0; i < 3; ++i) {
        surface_prism(&shape, 12, 0.3, heights[i]);
        check_fills(&shape);
        surface_prism(&shape, 40, 0.05, heights[i]);
        check_fills(&shape);
    }
}
END_TEST

START_TEST(saddles)
{
    for (uint32_t n = 2; n < 7; ++n) {
        surface_saddle(&shape, 2 * n + 1, .02);
        check_fills(&shape);
    }
}
END_TEST

static surface inner;

START_TEST(handles)
{
    static const uint32_t sides[] = {3, 8, 16};
    for (size_t i = 0; i < sizeof sides / sizeof *sides; ++i) {
        surface_tube(&shape, 24, sides[i], 0.3, tube_circle);
        check_fills(&shape);
        surface_tube(&shape, 60, sides[i], 0.4, tube_trefoil);
        check_fills(&shape);
        turn(&shape, 1e-2);
        check_fills(&shape);
    }
}
END_TEST

/* A plate with four holes, and a scaffold of bars. */
static int plate_cell(int x, int y, int z)
{
    return z == 0 && (x % 2 == 0 || y % 2 == 0);
}

static int scaffold_cell(int x, int y, int z)
{
    return x % 2 + y % 2 + z % 2 < 2;
}

START_TEST(many_handles)
{
    surface_cells(&shape, 5, plate_cell);
    icc_domain *filled = fill(&shape, NULL);
    ck_assert_uint_eq(info_of_domain(filled).genus, 4);
    icc_domain_free(filled);
    surface_cells(&shape, 7, scaffold_cell);
    check_fills(&shape);
    turn(&shape, 1);
    check_fills(&shape);
}
END_TEST

START_TEST(voids)
{
    random_source r = {3};
    for (int n = 1; n <= 6; ++n) {
        surface_star(&shape, 3, 0.1, &r);
        for (int i = 0; i < n; ++i) {
            surface_star(&inner, 1 + i % 3, 0.3, &r);
            surface_place(&inner, 0, 0.15, 0.6 * cos(i), 0.6 * sin(i), 0);
            surface_add_void(&shape, &inner);
        }
        icc_domain *filled = fill(&shape, NULL);
        ck_assert_uint_eq(info_of_domain(filled).n_voids, (size_t)n);
        icc_domain_free(filled);
    }
}
END_TEST

/* Two rings that are linked, one void each. */
START_TEST(linked_voids)
{
    random_source r = {4};
    surface_star(&shape, 3, 0, &r);
    for (int i = 0; i < 2; ++i) {
        surface_tube(&inner, 20, 6, 0.2, tube_circle);
        surface_place(&inner, i, 0.4, i == 0 ? 0.2 : -0.2, 0, 0);
        surface_add_void(&shape, &inner);
    }
    icc_domain *filled = fill(&shape, NULL);
    ck_assert_uint_eq(info_of_domain(filled).n_voids, 2);
    ck_assert_uint_eq(info_of_domain(filled).genus, 2);
    icc_domain_free(filled);
}
END_TEST

START_TEST(the_same_bits_again)
{
    random_source r = {5};
    surface_star(&shape, 3, 0.7, &r);
    icc_domain *a = fill(&shape, NULL), *b = fill(&shape, NULL);
    const icc_domain_info info = info_of_domain(a);
    ck_assert_uint_eq(info.n_mesh_vertices, info_of_domain(b).n_mesh_vertices);
    ck_assert_uint_eq(info.n_mesh_simplices, info_of_domain(b).n_mesh_simplices);
    const size_t n = 3 * info.n_mesh_vertices;
    double *x = malloc(2 * n * sizeof *x);
    ck_assert_int_eq(flat_domain_mesh(a, x, NULL), ICC_OK);
    ck_assert_int_eq(flat_domain_mesh(b, x + n, NULL), ICC_OK);
    ck_assert_mem_eq(x, x + n, n * sizeof *x);
    free(x);
    icc_domain_free(a);
    icc_domain_free(b);
}
END_TEST

START_TEST(arguments_are_checked)
{
    static const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    icc_error err = {.size = sizeof err};
    icc_fill_options options = {.size = sizeof options, .ratio = 1.1};
    icc_domain *out, *flat;
    surface_octahedron(&shape);
    icc_domain *domain = make(&shape), *filled = fill(&shape, NULL);
    ck_assert_int_eq(icc_domain_fill(NULL, domain, NULL, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_fill(&out, NULL, NULL, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_fill(&out, domain, &options, NULL, &err), ICC_ERR_ARGUMENT);
    options.ratio = NAN;
    ck_assert_int_eq(icc_domain_fill(&out, domain, &options, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_fill(&out, filled, NULL, NULL, &err), ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(icc_domain_create(&flat, 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_fill(&out, flat, NULL, NULL, &err), ICC_ERR_UNSUPPORTED);
    ck_assert_ptr_null(out);
    ck_assert_int_eq(flat_domain_mesh(domain, NULL, NULL), ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(flat_domain_mesh(NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_uint_eq(info_of_domain(domain).n_mesh_vertices, 0);
    icc_domain_free(domain);
    icc_domain_free(filled);
    icc_domain_free(flat);
}
END_TEST

START_TEST(few_points_suffice)
{
    random_source r = {5};
    surface_star(&shape, 3, 0, &r);
    icc_fill_options options = {.size = sizeof options, .max_points = 10};
    icc_domain *filled = fill(&shape, &options);
    ck_assert_uint_le(info_of_domain(filled).n_mesh_vertices, shape.n_vertices + 10);
    icc_domain_free(filled);
}
END_TEST

/* The least sine of a tetrahedron's dihedral angles. */
static double least_sine(const double *const p[4])
{
    double normal[4][3], length[4], least = 1;
    for (int i = 0; i < 4; ++i) {
        const double *a = p[(i + 1) % 4], *b = p[(i + 2) % 4], *c = p[(i + 3) % 4];
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            normal[i][k] = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
        }
        length[i] = sqrt(normal[i][0] * normal[i][0] + normal[i][1] * normal[i][1] +
                         normal[i][2] * normal[i][2]);
    }
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) {
            double cosine = 0;
            for (int k = 0; k < 3; ++k)
                cosine += normal[i][k] * normal[j][k] / (length[i] * length[j]);
            least = fmin(least, sqrt(fmax(0, 1 - cosine * cosine)));
        }
    return least;
}

static double least_sine_of(const icc_domain *domain)
{
    const icc_domain_info info = info_of_domain(domain);
    double *x = malloc(3 * info.n_mesh_vertices * sizeof *x), least = 1;
    uint32_t *t = malloc(4 * info.n_mesh_simplices * sizeof *t);
    ck_assert_int_eq(flat_domain_mesh(domain, x, t), ICC_OK);
    for (size_t i = 0; i < info.n_mesh_simplices; ++i) {
        const double *p[4];
        for (size_t k = 0; k < 4; ++k)
            p[k] = x + 3 * t[4 * i + k];
        least = fmin(least, least_sine(p));
    }
    free(x);
    free(t);
    return least;
}

/* All tetrahedra of a ball have its centre as their circumcentre. It is inserted first, and then
 * the tetrahedra at the centre are long. */
START_TEST(balls_are_refined)
{
    random_source r = {5};
    for (int splits = 3; splits <= 5; ++splits) {
        surface_star(&shape, splits, 0, &r);
        icc_domain *filled = fill(&shape, NULL);
        ck_assert_double_gt(least_sine_of(filled), sin(0.2));
        ck_assert_uint_lt(info_of_domain(filled).n_mesh_simplices, 5 * shape.n_vertices);
        icc_domain_free(filled);
    }
}
END_TEST

/* Vertices in circles have many flat Delaunay tetrahedra. Few inner points suffice if these go
 * first. */
START_TEST(flat_tetrahedra_go_before_refinement)
{
    surface_tube(&shape, 48, 48, 0.6, tube_circle);
    icc_domain *filled = fill(&shape, NULL);
    ck_assert_double_gt(least_sine_of(filled), sin(0.05));
    ck_assert_uint_lt(info_of_domain(filled).n_mesh_simplices, 8 * shape.n_vertices);
    icc_domain_free(filled);
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
    surface_prism(&shape, 3, -.5, 1);
    icc_domain *domain = make(&shape);
    faulty_sweep(fill_once, domain);
    icc_domain_free(domain);
    surface_saddle(&shape, 5, .02);
    domain = make(&shape);
    faulty_sweep(fill_once, domain);
    icc_domain_free(domain);
    surface_octahedron(&shape);
    surface_tube(&inner, 3, 3, 0.2, tube_circle);
    surface_place(&inner, 0, 0.3, 0, 0, 0);
    surface_add_void(&shape, &inner);
    domain = make(&shape);
    faulty_sweep(fill_once, domain);
    icc_domain_free(domain);
}
END_TEST

static int fixed_sign(double x[4][3])
{
    iccp_fixed p[4] = {0};
    for (int i = 0; i < 4; ++i)
        iccp_fixed_add(&p[i], x[i], 1);
    return iccp_fixed_orient3d(&p[0], &p[1], &p[2], &p[3]);
}

START_TEST(fixed_signs_are_those_of_doubles)
{
    random_source r = {7};
    for (int round = 0; round < 20000; ++round) {
        double x[4][3];
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 3; ++k)
                x[i][k] = round % 2 ? random_unit(&r) - 0.5
                                    : floor(8 * random_unit(&r)) * ldexp(1, -(round / 2 % 190));
        if (round % 3 == 0)
            for (int k = 0; k < 3; ++k)
                x[3][k] = 0.25 * x[0][k] + 0.5 * x[1][k] + 0.25 * x[2][k];
        ck_assert_int_eq(fixed_sign(x), iccp_orient3d(x[0], x[1], x[2], x[3]));
    }
}
END_TEST

/* Points on a line and in a plane are so exactly, and beside it they are not. */
START_TEST(shares_are_exact)
{
    random_source r = {9};
    for (int round = 0; round < 5000; ++round) {
        double x[4][3];
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 3; ++k)
                x[i][k] = (random_unit(&r) - 0.5) * ldexp(1, -(int)(20 * random_unit(&r)));
        const double first = ldexp(floor(ldexp(random_unit(&r), 47)), -48);
        const double second = ldexp(floor(ldexp(random_unit(&r), 47)), -48);
        iccp_fixed p[4] = {0}, q = {0}, beside = {0};
        for (int i = 0; i < 4; ++i)
            iccp_fixed_add(&p[i], x[i], 1);
        iccp_fixed_add(&q, x[0], first);
        iccp_fixed_add(&q, x[1], second);
        iccp_fixed_add(&q, x[2], 1 - first - second);
        ck_assert_int_eq(iccp_fixed_orient3d(&p[0], &p[1], &p[2], &q), 0);
        iccp_fixed_add(&beside, x[0], first);
        iccp_fixed_add(&beside, x[1], second);
        iccp_fixed_add(&beside, x[2], 1 - first - second - 0x1p-48);
        iccp_fixed_add(&beside, x[3], 0x1p-48);
        ck_assert_int_eq(iccp_fixed_orient3d(&p[0], &p[1], &p[2], &beside),
                         iccp_fixed_orient3d(&p[0], &p[1], &p[2], &p[3]));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fill");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, fixed_signs_are_those_of_doubles);
    tcase_add_test(tests, shares_are_exact);
    tcase_add_test(tests, a_tetrahedron_is_one);
    tcase_add_test(tests, simple_shapes);
    tcase_add_test(tests, stretched_bodies);
    tcase_add_test(tests, stretched_grids);
    tcase_add_test(tests, coplanar_grids);
    tcase_add_test(tests, twisted_prisms);
    tcase_add_test(tests, saddles);
    tcase_add_test(tests, handles);
    tcase_add_test(tests, many_handles);
    tcase_add_test(tests, voids);
    tcase_add_test(tests, linked_voids);
    tcase_add_test(tests, the_same_bits_again);
    tcase_add_test(tests, arguments_are_checked);
    tcase_add_test(tests, few_points_suffice);
    tcase_add_test(tests, balls_are_refined);
    tcase_add_test(tests, flat_tetrahedra_go_before_refinement);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
