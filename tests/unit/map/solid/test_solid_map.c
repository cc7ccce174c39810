/* Map kind mesh in space: every tetrahedron positive, there and back, derivatives, and what happens
 * when the repair fails. */
#include "../../../domains.h"
#include "../../../faulty.h"
#include "../../../flat_mesh.h"
#include "../../../infos.h"
#include "../../../meshes.h"
#include "../../../share.h"
#include "../../../suite.h"

#include "math/predicates.h"

#include <icc/icc.h>

/* Two domains with different insides; the vertices of the boundary are the same. */
static void make_pair(domain_pair *p, size_t n)
{
    random_source r = {1};
    test_mesh before = mesh_cells(3, n, NULL);
    mesh_shake(&before, n, 0.1, &r);
    test_mesh other = mesh_cells(3, n, NULL);
    mesh_shake(&other, n, 0.1, &r);
    test_mesh after = mesh_moved(&other, mesh_bend);
    ck_assert_int_eq(mesh_domain(&p->source, &before, NULL, NULL), ICC_OK);
    ck_assert_int_eq(mesh_domain(&p->target, &after, NULL, NULL), ICC_OK);
    mesh_free(&before);
    mesh_free(&other);
    mesh_free(&after);
}

static double determinant(const double *j)
{
    return j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) +
           j[2] * (j[3] * j[7] - j[4] * j[6]);
}

START_TEST(there_and_back)
{
    domain_pair p;
    icc_map *map;
    make_pair(&p, 4);
    ck_assert_int_eq(icc_map_create(&map, p.source, p.target, NULL, NULL, NULL), ICC_OK);
    const icc_map_info info = info_of_map(map);
    ck_assert_int_eq(info.kind, ICC_MAP_MESH);
    ck_assert_int_eq(info.certified, 1);
    ck_assert(info.energy >= 6);
    random_source r = {2};
    size_t n_inside = 0;
    for (int i = 0; i < 2000; ++i) {
        double x[3], y[3], z[3], j[9];
        icc_status status;
        for (int k = 0; k < 3; ++k)
            x[k] = 4 * random_unit(&r);
        ck_assert_int_eq(icc_map_apply(map, 1, x, y, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        ck_assert_int_eq(icc_map_apply_inverse(map, 1, y, z, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        for (int k = 0; k < 3; ++k)
            ck_assert_double_eq_tol(x[k], z[k], 1e-13);
        ck_assert_int_eq(icc_map_jacobian(map, 1, x, j, &status, NULL, NULL), ICC_OK);
        ck_assert(determinant(j) > 0);
        ++n_inside;
    }
    ck_assert_uint_eq(n_inside, 2000);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

/* What icc_map_get_mesh() hands out is the map: linear in each of its tetrahedra. */
START_TEST(mesh_is_the_map)
{
    domain_pair p;
    icc_map *map;
    make_pair(&p, 3);
    ck_assert_int_eq(icc_map_create(&map, p.source, p.target, NULL, NULL, NULL), ICC_OK);
    const icc_map_info info = info_of_map(map);
    double *before = calloc(info.n_vertices, 3 * sizeof *before);
    double *after = calloc(info.n_vertices, 3 * sizeof *after);
    uint32_t *corners = calloc(info.n_simplices, 4 * sizeof *corners);
    ck_assert_int_eq(flat_get_mesh(map, before, after, corners), ICC_OK);
    for (size_t t = 0; t < info.n_simplices; ++t) {
        double x[3] = {0, 0, 0}, y[3] = {0, 0, 0}, image[3], jacobian[9], edges[9];
        icc_status status;
        for (size_t k = 0; k < 12; ++k) {
            x[k % 3] += 0.25 * before[3 * corners[4 * t + k / 3] + k % 3];
            y[k % 3] += 0.25 * after[3 * corners[4 * t + k / 3] + k % 3];
        }
        ck_assert_int_eq(icc_map_apply(map, 1, x, image, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_jacobian(map, 1, x, jacobian, &status, NULL, NULL), ICC_OK);
        for (int k = 0; k < 3; ++k)
            ck_assert_double_eq_tol(image[k], y[k], 1e-13);
        for (size_t e = 0; e < 3; ++e)
            for (size_t i = 0; i < 3; ++i) {
                const double *a = before + 3 * corners[4 * t],
                             *b = before + 3 * corners[4 * t + e + 1];
                edges[3 * i + e] =
                    after[3 * corners[4 * t + e + 1] + i] - after[3 * corners[4 * t] + i];
                double along = 0;
                for (size_t k = 0; k < 3; ++k)
                    along += jacobian[3 * i + k] * (b[k] - a[k]);
                ck_assert_double_eq_tol(along, edges[3 * i + e], 1e-11);
            }
        ck_assert(determinant(edges) > 0);
    }
    free(before);
    free(after);
    free(corners);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

/* Corners of the boundary that meet in one tetrahedron: turned inside out by the target, no images
 * of inner vertices help, and the map is one along curves, which says so. */
static void turn_corner(int32_t dim, const double *x, double *y)
{
    (void)dim;
    memcpy(y, x, 3 * sizeof *y);
    if (x[0] + x[1] + x[2] < 0.5)
        y[0] = y[1] = y[2] = 0.9;
}

START_TEST(falls_back_on_curves)
{
    domain_pair p;
    icc_map *map;
    icc_error err = {.size = sizeof err};
    test_mesh before = mesh_cells(3, 3, NULL), after = mesh_moved(&before, turn_corner);
    icc_status status = mesh_domain(&p.target, &after, NULL, &err);
    ck_assert_int_eq(mesh_domain(&p.source, &before, NULL, NULL), ICC_OK);
    if (status == ICC_OK) {
        ck_assert_int_eq(icc_map_create(&map, p.source, p.target, NULL, NULL, NULL), ICC_OK);
        ck_assert(info_of_map(map).certified);
        icc_map_free(map);
    } else {
        ck_assert_int_eq(status, ICC_ERR_BOUNDARY);
        p.target = NULL;
    }
    mesh_free(&before);
    mesh_free(&after);
    domain_pair_free(&p);
}
END_TEST

START_TEST(kinds)
{
    domain_pair p;
    icc_map *map;
    icc_map_options options = {.size = sizeof options, .kind = ICC_MAP_CURVES};
    make_pair(&p, 3);
    ck_assert_int_eq(icc_map_create(&map, p.source, p.target, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(info_of_map(map).kind, ICC_MAP_CURVES);
    ck_assert_int_eq(flat_get_mesh(map, NULL, NULL, NULL), ICC_ERR_UNSUPPORTED);
    icc_map_free(map);
    domain_pair_free(&p);
}
END_TEST

/* Corners 0 to 3 nearly lie in one plane, 4 and 5 on either side of it. Corner 3 is rounded from a
 * point of the plane. Returns whether doubles find a negative volume in the tetrahedron of the first
 * four, which is positive. */
static bool draw_flat_quad(double *x, random_source *r)
{
    double edge[9];
    for (size_t i = 0; i < 9; ++i)
        x[i] = random_between(r, -1, 1) + (i % 4 == 0 ? 3 : 0);
    for (size_t k = 0; k < 3; ++k) {
        x[9 + k] = x[k] + x[6 + k] - (0.9 * x[3 + k] + 0.1 * x[6 + k]);
        x[12 + k] = (x[k] + x[3 + k] + x[6 + k] + x[9 + k]) / 4;
        x[15 + k] = x[12 + k];
    }
    for (size_t i = 0; i < 9; ++i)
        edge[i] = x[3 + i] - x[i % 3];
    const double normal[3] = {edge[1] * edge[5] - edge[2] * edge[4],
                              edge[2] * edge[3] - edge[0] * edge[5],
                              edge[0] * edge[4] - edge[1] * edge[3]};
    for (size_t k = 0; k < 3; ++k) {
        x[12 + k] += normal[k] / 8;
        x[15 + k] -= normal[k] / 8;
    }
    return iccp_orient3d(x, x + 3, x + 6, x + 9) > 0 &&
           normal[0] * edge[6] + normal[1] * edge[7] + normal[2] * edge[8] < 0;
}

/* An octahedron about that tetrahedron, with four more. */
static icc_status create_octahedron(icc_domain **out, const double *x)
{
    static const uint32_t CORNERS[5][4] = {
        {0, 1, 2, 3}, {0, 1, 3, 4}, {1, 2, 3, 4}, {0, 2, 1, 5}, {0, 3, 2, 5}};
    static const uint32_t FACETS[8][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                                          {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
    return flat_create_mesh(out, 3, 6, x, 5, CORNERS[0], 8, FACETS[0], NULL, NULL);
}

static void check_improved(const icc_map *map)
{
    icc_improve_report report = {.size = sizeof report};
    icc_map *better;
    ck_assert_int_eq(icc_map_improve(&better, map, NULL, &report, NULL, NULL), ICC_OK);
    ck_assert_double_eq(report.energy_start, info_of_map(map).energy);
    ck_assert(report.energy >= 6 - 1e-12 && report.energy <= report.energy_start);
    icc_map_free(better);
}

/* From flat tetrahedra to others, to flat ones and back: energies are those of shapes, whatever
 * doubles find. Refining gives every flat tetrahedron room, though all of its corners are fixed. */
START_TEST(flat_tetrahedra_have_energies)
{
    const icc_map_options start = {.size = sizeof start, .iterations = -1};
    random_source r = {3};
    size_t n_drawn = 0;
    for (int k = 0; k < 2000; ++k) {
        double x[18], y[18];
        icc_domain *d[3];
        if (!draw_flat_quad(x, &r))
            continue;
        for (size_t i = 0; i < 18; ++i)
            y[i] = x[i] * (i % 3 == 0 ? 2 : 1);
        if (create_octahedron(&d[0], x) != ICC_OK)
            continue;
        ++n_drawn;
        ck_assert_int_eq(create_octahedron(&d[1], y), ICC_OK);
        for (size_t i = 0; i < 3; ++i) /* lifts the upper edge from the lower one */
            y[3 + i] = y[3 + i] + (x[12 + i] - x[15 + i]) / 8;
        ck_assert_int_eq(create_octahedron(&d[2], y), ICC_OK);
        for (int from = 0; from < 3; ++from)
            for (int to = 0; to < 3; ++to) {
                icc_map *map;
                ck_assert_int_eq(icc_map_create(&map, d[from], d[to], NULL, NULL, NULL), ICC_OK);
                const icc_map_info info = info_of_map(map);
                ck_assert_int_eq(info.kind, ICC_MAP_MESH);
                ck_assert(info.energy >= 6 - 1e-12);
                ck_assert_double_le(info.energy, from == to ? 6 + 1e-12 : 7.5);
                icc_map_free(map);
                ck_assert_int_eq(icc_map_create(&map, d[from], d[to], &start, NULL, NULL), ICC_OK);
                const double energy = info_of_map(map).energy;
                ck_assert_double_lt(energy, HUGE_VAL);
                if (from != to && (from == 2 || to == 2))
                    ck_assert_double_ge(energy, 1e10);
                check_improved(map);
                icc_map_free(map);
            }
        for (int i = 0; i < 3; ++i)
            icc_domain_free(d[i]);
    }
    ck_assert_uint_gt(n_drawn, 10);
}
END_TEST

/* The surface of a domain, without its mesh. */
static icc_domain *surface_of(const icc_domain *filled)
{
    icc_domain_info info = {.size = sizeof info};
    icc_domain *plain;
    ck_assert_int_eq(icc_domain_get_info(filled, &info), ICC_OK);
    double *vertices = calloc(info.n_vertices, 3 * sizeof *vertices);
    uint32_t *facets = calloc(info.n_facets, 3 * sizeof *facets);
    ck_assert_int_eq(icc_domain_get_boundary(filled, vertices, facets), ICC_OK);
    ck_assert_int_eq(
        icc_domain_create(&plain, 3, info.n_vertices, vertices, info.n_facets, facets, NULL, NULL),
        ICC_OK);
    free(vertices);
    free(facets);
    return plain;
}

/* Surfaces without a mesh get one, whatever is said of kind, unless a grid is asked for. A map has
 * charts if a method or kind curves is asked for. */
START_TEST(surfaces_are_filled)
{
    static const struct {
        int32_t kind, method, made, by;
    } CASES[] = {{0, 0, ICC_MAP_MESH, 0},
                 {ICC_MAP_MESH, 0, ICC_MAP_MESH, 0},
                 {ICC_MAP_CURVES, 0, ICC_MAP_CURVES, ICC_METHOD_FOLIATION},
                 {0, ICC_METHOD_FOLIATION, ICC_MAP_MESH, ICC_METHOD_FOLIATION},
                 {0, ICC_METHOD_FIELD, ICC_MAP_CURVES, ICC_METHOD_FIELD}};
    domain_pair p;
    make_pair(&p, 3);
    icc_domain *source = surface_of(p.source), *target = surface_of(p.target);
    const icc_domain *const PAIRS[][2] = {{source, target}, {p.source, target}, {source, p.target}};
    for (size_t k = 0; k < 3; ++k)
        for (size_t i = 0; i < sizeof CASES / sizeof *CASES; ++i) {
            const icc_chart_options chart = {
                .size = sizeof chart, .method = CASES[i].method, .cells = 12};
            const icc_map_options options = {
                .size = sizeof options, .kind = CASES[i].kind, .chart = &chart};
            icc_error err = {.size = sizeof err};
            icc_map *map;
            ck_assert_msg(icc_map_create(&map, PAIRS[k][0], PAIRS[k][1], &options, NULL, &err) ==
                              ICC_OK,
                          "pair %zu, case %zu: %s", k, i, err.message);
            icc_chart_info chart_info = {.size = sizeof chart_info};
            const icc_chart *made = icc_map_source_chart(map);
            ck_assert_int_eq(made == NULL, CASES[i].by == 0);
            if (made != NULL)
                ck_assert_int_eq(icc_chart_get_info(made, &chart_info), ICC_OK);
            ck_assert_int_eq(chart_info.method, CASES[i].by);
            ck_assert_int_eq(info_of_map(map).kind, CASES[i].made);
            ck_assert(CASES[i].by == ICC_METHOD_FIELD || info_of_map(map).certified);
            icc_map_free(map);
        }
    icc_domain_free(source);
    icc_domain_free(target);
    domain_pair_free(&p);
}
END_TEST

/* A triangle drawn out to 10^14 times its width, askew: some of its edges are as long as doubles are
 * apart there. It is refused, and both the side and the facet are named; a grid is no better. */
START_TEST(what_cannot_be_filled)
{
    static const double ROD[8][3] = {
        {-0.23813772081825824, 0.89798926029555348, 0.37000772196986603},
        {-0.70827082765604821, -0.57709551380807222, -0.40658726324617434},
        {0.946408548474306, -0.32089374648748137, 0.036579541276308219},
        {-17503089249170.525, -41440982919622.422, 89310059911474.344},
        {-17503089249169.34, -41440982919623.641, 89310059911474},
        {-17503089249168.869, -41440982919622.164, 89310059911474.781},
        {0.052509267747508734, 0.12432294875886822, -0.26793017973442312},
        {-17503089249169.631, -41440982919622.867, 89310059911474.641}};
    static const uint32_t FACES[12][3] = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4},
                                          {2, 0, 3}, {2, 3, 5}, {6, 1, 0}, {7, 3, 4},
                                          {6, 2, 1}, {7, 4, 5}, {6, 0, 2}, {7, 5, 3}};
    double easy[8][3];
    icc_error err = {.size = sizeof err};
    icc_domain *rod, *prism;
    icc_map *map = NULL;
    for (int v = 0; v < 8; ++v)
        for (int k = 0; k < 3; ++k)
            easy[v][k] = v < 3 || v == 6 ? ROD[v][k] : ROD[v - (v == 7 ? 1 : 3)][k] + (k == 2) * 4;
    easy[6][2] -= 1;
    easy[7][2] += 1;
    ck_assert_int_eq(icc_domain_create(&rod, 3, 8, ROD[0], 12, FACES[0], NULL, NULL), ICC_OK);
    ck_assert_msg(icc_domain_create(&prism, 3, 8, easy[0], 12, FACES[0], NULL, &err) == ICC_OK,
                  "%s", err.message);
    ck_assert_int_eq(icc_map_create(&map, prism, rod, NULL, NULL, &err), ICC_ERR_RESOLUTION);
    ck_assert(map == NULL && err.side == 2 && err.item == ICC_ITEM_FACET && err.index >= 0);
    ck_assert_int_eq(icc_map_create(&map, rod, prism, NULL, NULL, &err), ICC_ERR_RESOLUTION);
    ck_assert(map == NULL && err.side == 1 && err.item == ICC_ITEM_FACET && err.index >= 0);
    icc_domain_free(rod);
    icc_domain_free(prism);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
    domain_pair p;
    make_pair(&p, 2);
    for (size_t k = 1;; k = share_next(k)) {
        faulty f = {.fail_at = k};
        const icc_env env = faulty_env(&f);
        icc_map *map;
        const icc_status status = icc_map_create(&map, p.source, p.target, NULL, &env, NULL);
        if (f.n_allocs < k) {
            ck_assert_int_eq(status, ICC_OK);
            icc_map_free(map);
            ck_assert_uint_eq(f.n_live, 0);
            break;
        }
        ck_assert_int_eq(status, ICC_ERR_MEMORY);
        ck_assert_ptr_null(map);
        ck_assert_uint_eq(f.n_live, 0);
    }
    domain_pair_free(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("maps of meshes in space");
    TCase *tcase = tcase_create("all");
    tcase_set_timeout(tcase, 120);
    tcase_add_test(tcase, there_and_back);
    tcase_add_test(tcase, mesh_is_the_map);
    tcase_add_test(tcase, falls_back_on_curves);
    tcase_add_test(tcase, kinds);
    tcase_add_test(tcase, flat_tetrahedra_have_energies);
    tcase_add_test(tcase, surfaces_are_filled);
    tcase_add_test(tcase, what_cannot_be_filled);
    tcase_add_test(tcase, every_allocation_may_fail);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
