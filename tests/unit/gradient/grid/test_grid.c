/* The lattice, rasterisation against brute force, Algorithm 1 against itself as it is printed, and
 * links of the Kuhn triangulation against their Euler characteristic. */
#include "gradient/grid/kuhn.h"
#include "gradient/grid/lattice.h"
#include "gradient/grid/rasterise.h"
#include "math/predicates.h"

#include "../../../domains.h"
#include "../../../faulty.h"
#include "../../../grids.h"
#include "../../../random.h"
#include "../../../shapes.h"
#include "../../../share.h"
#include "../../../suite.h"
#include "../../../surfaces.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_N = 64, MAX_VERTICES = 4096 };

/* Shapes of every dimension, axes of one vertex among them. */
static int32_t random_shape(random_source *r, size_t *sides)
{
    const int32_t dim = 1 + random_below(r, ICC_MAX_DIM);
    for (int32_t k = 0; k < dim; ++k)
        sides[k] = (size_t)(1 + random_below(r, dim > 3 ? 4 : 9));
    return dim;
}

static icc_grid *random_grid(random_source *r, int density)
{
    uint8_t inside[MAX_VERTICES];
    size_t sides[ICC_MAX_DIM];
    const int32_t dim = random_shape(r, sides);
    for (size_t v = 0; v < MAX_VERTICES; ++v)
        inside[v] = (uint8_t)(random_below(r, 10) < density ? 1 + random_below(r, 255) : 0);
    return grid_of(dim, sides, inside);
}

/* ---------------------------------------------------------------- lattice */

START_TEST(neighbours_differ_by_one_step)
{
    random_source r = {1};
    for (int round = 0; round < share_of(200); ++round) {
        icc_grid *grid = random_grid(&r, 5);
        for (uint32_t v = 0; v < grid->n_vertices; ++v)
            for (int32_t k = 0; k < grid->dim; ++k)
                for (int32_t step = -1; step <= 1; step += 2) {
                    const uint32_t u = iccp_grid_neighbour(grid, v, k, step);
                    const int64_t to = (int64_t)iccp_grid_coordinate(grid, v, k) + step;
                    ck_assert((u == ICCP_NONE) == (to < 0 || to >= (int64_t)grid->shape[k]));
                    for (int32_t m = 0; u != ICCP_NONE && m < grid->dim; ++m)
                        ck_assert_int_eq((int64_t)iccp_grid_coordinate(grid, u, m),
                                         m == k ? to : iccp_grid_coordinate(grid, v, m));
                }
        icc_grid_free(grid);
    }
}
END_TEST

START_TEST(masks_are_copied_as_zeros_and_ones)
{
    const uint8_t inside[6] = {0, 1, 255, 0, 7, 0};
    icc_grid *grid = grid_of(2, (size_t[]){3, 2}, inside);
    const uint8_t *copy = icc_grid_inside(grid);
    for (int v = 0; v < 6; ++v)
        ck_assert_uint_eq(copy[v], inside[v] != 0);
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
    ck_assert_int_eq(info.dim, 2);
    ck_assert_uint_eq(info.shape[0], 3);
    ck_assert_uint_eq(info.shape[1], 2);
    ck_assert_uint_eq(info.n_vertices, 6);
    ck_assert_uint_eq(info.n_inside, 3);
    ck_assert(info.spacing == 1 && info.origin[0] == 0 && info.origin[1] == 0);
    icc_grid_free(grid);
    icc_grid_free(NULL);
}
END_TEST

START_TEST(too_large_a_mask_is_refused)
{
    static const size_t shapes[4][3] = {{1 << 14, (1 << 14) + 1, 1},
                                        {SIZE_MAX, SIZE_MAX, 1},
                                        {1 << 28, 1 << 28, 1 << 28},
                                        {1, 1, SIZE_MAX}};
    const uint8_t inside = 1;
    for (int i = 0; i < 4; ++i) {
        icc_grid *grid = (icc_grid *)&grid;
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(icc_grid_create_mask(&grid, 3, shapes[i], &inside, NULL, &err),
                         ICC_ERR_RESOLUTION);
        ck_assert_ptr_null(grid);
        ck_assert_int_eq(err.status, ICC_ERR_RESOLUTION);
    }
}
END_TEST

START_TEST(nearest_is_the_first_of_the_nearest)
{
    random_source r = {2};
    for (int round = 0; round < share_of(300); ++round) {
        icc_grid *grid = random_grid(&r, 3);
        double point[ICC_MAX_DIM];
        for (int32_t k = 0; k < grid->dim; ++k)
            point[k] = 0.5 * (random_below(&r, 24) - 3); /* ties are common */
        uint32_t expected = ICCP_NONE, found = 0;
        double least = HUGE_VAL;
        for (uint32_t v = 0; v < grid->n_vertices; ++v) {
            double square = 0;
            for (int32_t k = 0; k < grid->dim; ++k)
                square += pow(iccp_grid_coordinate(grid, v, k) - point[k], 2);
            if (grid->inside[v] && square < least) {
                least = square;
                expected = v;
            }
        }
        const icc_status status = icc_grid_find_nearest(grid, point, &found);
        ck_assert_int_eq(status, expected != ICCP_NONE ? ICC_OK : ICC_ERR_RESOLUTION);
        ck_assert_uint_eq(found, expected);
        point[0] = 1e308;
        ck_assert_int_eq(icc_grid_find_nearest(grid, point, &found), status);
        point[0] = NAN;
        ck_assert_int_eq(icc_grid_find_nearest(grid, point, &found), ICC_ERR_ARGUMENT);
        icc_grid_free(grid);
    }
}
END_TEST

/* ---------------------------------------------------------- rasterisation */

static icc_grid *grid_in(const icc_domain *domain, int32_t cells)
{
    icc_grid *grid;
    ck_assert_int_eq(icc_grid_create(&grid, domain, cells, NULL, NULL), ICC_OK);
    return grid;
}

/* How far vertices lie within the bounding box, in cells. */
static void check_layout(const icc_domain *domain, const icc_grid *grid, size_t cells)
{
    const double h = grid->spacing;
    const double side[2] = {domain->upper[0] - domain->lower[0],
                            domain->upper[1] - domain->lower[1]};
    for (int k = 0; k < 2; ++k) {
        const size_t within = grid->shape[k] - 4;
        const double first = (grid->origin[k] + 2 * h - domain->lower[k]) / h;
        const double last = (domain->upper[k] - grid->origin[k]) / h - (double)within - 1;
        ck_assert_double_eq_tol(first, last, 1e-9);
        ck_assert(first < 0.75 + 1e-9 && first > (within > 1 ? 0.25 - 1e-9 : 0));
        if (side[k] >= side[1 - k]) {
            ck_assert_double_eq_tol(first, 0.5, 1e-9);
            ck_assert_uint_eq(within, cells);
        }
    }
    size_t n_inside = 0, n_margin = 0;
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        const size_t i = v % grid->shape[0], j = v / grid->shape[0];
        n_inside += grid->inside[v];
        if (i < 2 || j < 2 || i + 2 >= grid->shape[0] || j + 2 >= grid->shape[1])
            n_margin += grid->inside[v];
    }
    ck_assert_uint_eq(n_inside, grid->n_inside);
    ck_assert_uint_eq(n_margin, 0);
}

/* +1 inside, 0 on the boundary, -1 outside: by crossings of a ray, exactly, one edge after the
 * other. */
static int where(const icc_domain *domain, const double *p)
{
    int side = -1;
    for (size_t e = 0; e < domain->n_facets; ++e) {
        const double *a = domain->vertices + 2 * domain->facets[2 * e];
        const double *b = domain->vertices + 2 * domain->facets[2 * e + 1];
        const int turn = iccp_orient2d(a, b, p);
        if (turn == 0 && fmin(a[0], b[0]) <= p[0] && p[0] <= fmax(a[0], b[0]) &&
            fmin(a[1], b[1]) <= p[1] && p[1] <= fmax(a[1], b[1]))
            return 0;
        if ((a[1] > p[1]) != (b[1] > p[1]) && (turn > 0) == (b[1] > a[1]))
            side = -side;
    }
    return side;
}

/* Returns how many vertices lie exactly on the boundary. */
static size_t check_against_brute_force(const icc_domain *domain, const icc_grid *grid)
{
    size_t n_on = 0, n_wrong = 0; /* one assertion for all: each costs a system call */
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        const double p[2] = {grid->origin[0] + grid->spacing * (double)(v % grid->shape[0]),
                             grid->origin[1] + grid->spacing * (double)(v / grid->shape[0])};
        const int side = where(domain, p);
        n_on += side == 0;
        n_wrong += grid->inside[v] != (side > 0);
    }
    ck_assert_uint_eq(n_wrong, 0);
    return n_on;
}

static double unit(void *source)
{
    return random_unit(source);
}

START_TEST(polygons_of_every_kind)
{
    random_source r = {3};
    for (int round = 0; round < share_of(400); ++round) {
        shape s = round < N_SHAPES ? shape_number(round)
                                   : shape_blob((size_t)(3 + random_below(&r, 40)), unit, &r);
        if (round % 3 == 1)
            s = shape_moved(&s, ldexp(1, random_below(&r, 80) - 40), 1e9 * random_unit(&r), -5e8);
        if (round % 5 == 2)
            s = shape_reversed(&s);
        icc_domain *domain;
        if (icc_domain_create(&domain, 2, s.n, s.xy, 0, NULL, NULL, NULL) != ICC_OK)
            continue; /* a blob's edges may cross, or moving it may have made vertices coincide */
        const int32_t cells = 3 + random_below(&r, 40);
        icc_grid *grid;
        const icc_status status = icc_grid_create(&grid, domain, cells, NULL, NULL);
        ck_assert(status == ICC_OK || status == ICC_ERR_RESOLUTION);
        if (status == ICC_OK) {
            check_layout(domain, grid, (size_t)cells);
            check_against_brute_force(domain, grid);
        }
        icc_grid_free(grid);
        icc_domain_free(domain);
    }
}
END_TEST

/* Edges along the axes and whole-number coordinates: with a spacing of 2, every odd point is a
 * vertex of the grid, and many lie on the boundary. */
static shape random_skyline(random_source *r, int width, int height)
{
    shape s = {.n = 2, .xy = {0, 0, width, 0}};
    int x = width, y = height;
    while (x > 0) {
        const double turn[2] = {x, y};
        memcpy(s.xy + 2 * s.n++, turn, sizeof turn);
        x -= 1 + random_below(r, 4);
        x = x < 0 ? 0 : x;
        const double end[2] = {x, y};
        memcpy(s.xy + 2 * s.n++, end, sizeof end);
        const int old = y;
        while (y == old)
            y = 1 + random_below(r, height);
    }
    return s;
}

static shape turned(const shape *s)
{
    shape t = *s;
    for (size_t i = 0; i < s->n; ++i) {
        t.xy[2 * i] = -s->xy[2 * i + 1];
        t.xy[2 * i + 1] = s->xy[2 * i];
    }
    return t;
}

START_TEST(boundaries_through_grid_vertices)
{
    random_source r = {4};
    size_t n_on = 0;
    for (int round = 0; round < share_of(300); ++round) {
        const int cells = 4 + random_below(&r, 20);
        shape s = random_skyline(&r, 2 * cells, 2 * cells - 2 * random_below(&r, 3));
        if (round % 2 == 1)
            s = turned(&s);
        if (round % 3 == 1)
            for (size_t i = 0; i < s.n; ++i) /* slanted edges through vertices */
                s.xy[2 * i + 1] += s.xy[2 * i];
        icc_domain *domain = domain_of_polygon(s.n, s.xy);
        icc_grid *grid = grid_in(domain, cells);
        n_on += check_against_brute_force(domain, grid);
        icc_grid_free(grid);
        icc_domain_free(domain);
    }
    ck_assert_uint_gt(n_on, (size_t)share_of(5000));
}
END_TEST

START_TEST(extreme_shapes)
{
    const double needle[8] = {0, 0, 1e12, 0, 1e12, 1, 0, 1};
    icc_domain *domain = domain_of_polygon(4, needle);
    icc_grid *grid = grid_in(domain, 50);
    ck_assert_uint_eq(grid->shape[0], 54);
    ck_assert_uint_eq(grid->shape[1], 5);
    ck_assert_uint_eq(grid->n_inside, 50);
    icc_grid_free(grid);
    icc_domain_free(domain);
    for (int exponent = -1000; exponent <= 1000; exponent += 500) {
        shape s = shape_star(5, 0.4, 0.1);
        for (size_t i = 0; i < 2 * s.n; ++i)
            s.xy[i] = ldexp(s.xy[i], exponent);
        domain = domain_of_polygon(s.n, s.xy);
        grid = grid_in(domain, 30);
        check_against_brute_force(domain, grid);
        icc_grid_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
        ck_assert(fabs(ldexp(info.spacing, -exponent) - 2.0 / 30) < 0.01);
        icc_grid_free(grid);
        icc_domain_free(domain);
    }
}
END_TEST

START_TEST(info_is_in_the_callers_coordinates)
{
    const double square[8] = {1e6, -3, 1e6 + 64, -3, 1e6 + 64, 29, 1e6, 29};
    icc_domain *domain = domain_of_polygon(4, square);
    icc_grid *grid = grid_in(domain, 32);
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
    ck_assert(info.spacing == 2 && info.origin[0] == 1e6 - 3 && info.origin[1] == -6);
    ck_assert_uint_eq(info.n_inside, 32 * 16);
    uint32_t vertex;
    const double point[2] = {1e6 + 64, 29};
    ck_assert_int_eq(icc_grid_find_nearest(grid, point, &vertex), ICC_OK);
    ck_assert_uint_eq(vertex, 33 + 17 * info.shape[0]);
    icc_grid_free(grid);
    ck_assert_int_eq(icc_grid_create(&grid, domain, 0, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(grid->shape[0], 54);
    icc_grid_free(grid);
    icc_domain_free(domain);
}
END_TEST

START_TEST(no_grid_without_vertices_inside)
{
    const double thin[12] = {0, 0, 1, 0, 1, .01, .01, .01, .01, 1, 0, 1};
    icc_domain *domain = domain_of_polygon(6, thin);
    icc_grid *grid = (icc_grid *)&grid;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_grid_create(&grid, domain, 10, NULL, &err), ICC_ERR_RESOLUTION);
    ck_assert_ptr_null(grid);
    ck_assert_ptr_nonnull(strstr(err.message, "no grid vertex lies inside"));
    ck_assert_ptr_nonnull(strstr(err.message, "more than 10 cells"));
    icc_domain_free(domain);

    const shape s = shape_square();
    domain = domain_of_polygon(s.n, s.xy);
    ck_assert_int_eq(icc_grid_create(&grid, domain, 16384, NULL, &err), ICC_ERR_RESOLUTION);
    ck_assert_ptr_nonnull(strstr(err.message, "more than 268435456 vertices"));
    icc_domain_free(domain);
}
END_TEST

/* -------------------------------------------------------- closed surfaces */

static icc_domain *domain_in(int32_t dim, size_t n_vertices, const double *vertices,
                             size_t n_facets, const uint32_t *facets)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    const icc_status status =
        icc_domain_create(&domain, dim, n_vertices, vertices, n_facets, facets, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    return domain;
}

/* Vertex by vertex; nothing may be stray. Returns how many lie on the boundary. */
static size_t check_against_locate(const icc_domain *domain, const icc_grid *grid)
{
    size_t n_on = 0, n_wrong = 0, n_inside = 0;
    for (uint32_t v = 0; v < grid->n_vertices; ++v) {
        double p[ICC_MAX_DIM];
        for (int32_t k = 0; k < grid->dim; ++k)
            p[k] = grid->origin[k] + grid->spacing * iccp_grid_coordinate(grid, v, k);
        const int32_t place = iccp_domain_locate(domain, p, false, NULL, NULL);
        n_on += place == ICC_BOUNDARY;
        n_inside += place == ICC_INSIDE;
        n_wrong += grid->inside[v] != (place == ICC_INSIDE);
    }
    ck_assert_uint_eq(n_wrong, 0);
    ck_assert_uint_eq(n_inside, grid->n_inside);
    ck_assert_uint_eq(grid->n_stray, 0);
    return n_on;
}

START_TEST(surfaces_of_every_kind)
{
    static surface s;
    random_source r = {7};
    for (int round = 0; round < 24; ++round) {
        surface_octahedron(&s);
        for (int i = 0; i < round % 4; ++i)
            surface_split(&s);
        for (size_t i = 0; i < s.n_vertices && round % 3 > 0;
             ++i) { /* sheared; then bent as well */
            double *v = s.vertices + 3 * i;
            v[0] += 0.25 * v[1] + (round % 3 == 2 ? 0.3 * v[2] * v[2] : 0);
            v[1] += round % 3 == 2 ? 0.1 * random_unit(&r) * 0.125 : 0.5 * v[2];
        }
        icc_domain *domain = domain_in(3, s.n_vertices, s.vertices, s.n_faces, s.faces);
        icc_grid *grid = grid_in(domain, 5 + random_below(&r, 20));
        check_against_locate(domain, grid);
        icc_grid_free(grid);
        icc_domain_free(domain);
    }
}
END_TEST

/* The boundary of a box of cells, as one that does not know of them; flat along the axes. */
static icc_domain *box_domain(int32_t dim, const size_t *sides, const uint8_t *cells)
{
    icc_domain *mask;
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_create_mask(&mask, dim, sides, cells, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_get_info(mask, &info), ICC_OK);
    double *vertices = calloc(info.n_vertices * (size_t)dim, sizeof *vertices);
    uint32_t *facets = calloc(info.n_facets * (size_t)dim, sizeof *facets);
    ck_assert_int_eq(icc_domain_get_boundary(mask, vertices, facets), ICC_OK);
    icc_domain *domain = domain_in(dim, info.n_vertices, vertices, info.n_facets, facets);
    free(vertices);
    free(facets);
    icc_domain_free(mask);
    return domain;
}

START_TEST(boundaries_along_the_rows)
{
    const uint8_t l[8] = {1, 1, 1, 0, 1, 0, 0, 0};
    const uint8_t line[3] = {1, 1, 1};
    size_t n_on = 0;
    for (int32_t dim = 1; dim <= 4; ++dim) {
        icc_domain *domain = dim == 3   ? box_domain(3, (size_t[]){2, 2, 2}, l)
                             : dim == 1 ? box_domain(1, (size_t[]){3}, line)
                                        : box_domain(dim, (size_t[]){3, 1, 1, 1}, line);
        for (int32_t cells = 2; cells <= (dim < 4 ? 13 : 7); ++cells) {
            icc_grid *grid;
            const icc_status status = icc_grid_create(&grid, domain, cells, NULL, NULL);
            ck_assert(status == ICC_OK || status == ICC_ERR_RESOLUTION);
            if (status == ICC_OK)
                n_on += check_against_locate(domain, grid);
            icc_grid_free(grid);
        }
        icc_domain_free(domain);
    }
    ck_assert_uint_gt(n_on, 500);
}
END_TEST

/* Two blocks joined by a rod that lies between the rows of a coarse grid. */
START_TEST(stray_pieces_are_dropped)
{
    enum { LONG = 21, WIDE = 5 };
    uint8_t cells[LONG * WIDE * WIDE];
    for (int i = 0; i < LONG * WIDE * WIDE; ++i) {
        const int x = i % LONG, y = i / LONG % WIDE, z = i / (LONG * WIDE);
        cells[i] = x < 5 || x > 10 || (y == 0 && z == 0);
    }
    icc_domain *domain = box_domain(3, (size_t[]){LONG, WIDE, WIDE}, cells);
    icc_grid *coarse = grid_in(domain, 7), *fine = grid_in(domain, 34);
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(coarse, &info), ICC_OK);
    ck_assert_uint_gt(info.n_stray, 0);
    ck_assert_uint_gt(info.n_inside, info.n_stray);
    ck_assert_int_eq(info.cells, 7);
    icc_tree *tree;
    uint32_t root;
    icc_tree_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_grid_find_maximum(coarse, &root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, coarse, root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_get_report(tree, &report, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(report.n_unreachable, 0);
    ck_assert_uint_eq(report.n_inside, info.n_inside);
    ck_assert_int_eq(icc_grid_get_info(fine, &info), ICC_OK);
    ck_assert_uint_eq(info.n_stray, 0);
    icc_tree_free(tree);
    icc_grid_free(fine);
    icc_grid_free(coarse);
    icc_domain_free(domain);
}
END_TEST

/* ---------------------------------------------------------- the grassfire */

/* Algorithm 1, as printed; what is left in the end stays marked. */
static uint32_t burn(const icc_grid *grid, uint8_t *candidate)
{
    uint8_t keep[MAX_VERTICES];
    memcpy(candidate, grid->inside, grid->n_vertices);
    for (uint32_t rounds = 0;; ++rounds) {
        size_t n_kept = 0;
        for (uint32_t v = 0; v < grid->n_vertices; ++v) {
            keep[v] = candidate[v];
            for (int32_t k = 0; k < grid->dim; ++k)
                for (int32_t step = -1; step <= 1; step += 2) {
                    const uint32_t u = iccp_grid_neighbour(grid, v, k, step);
                    keep[v] = keep[v] && u != ICCP_NONE && candidate[u];
                }
            n_kept += keep[v];
        }
        if (n_kept == 0)
            return rounds;
        memcpy(candidate, keep, grid->n_vertices);
    }
}

/* The candidate nearest to the mean, in whole numbers. */
static uint32_t middle(const icc_grid *grid, const uint8_t *candidate)
{
    int64_t n = 0, sum[ICC_MAX_DIM] = {0}, least = INT64_MAX;
    uint32_t best = ICCP_NONE;
    for (uint32_t v = 0; v < grid->n_vertices; ++v)
        for (int32_t k = 0; candidate[v] && k < grid->dim; ++k)
            sum[k] += iccp_grid_coordinate(grid, v, k);
    for (uint32_t v = 0; v < grid->n_vertices; ++v)
        n += candidate[v];
    for (uint32_t v = 0; v < grid->n_vertices; ++v) {
        int64_t square = 0;
        for (int32_t k = 0; k < grid->dim; ++k) {
            const int64_t off = n * iccp_grid_coordinate(grid, v, k) - sum[k];
            square += off * off;
        }
        if (candidate[v] && square < least) {
            least = square;
            best = v;
        }
    }
    return best;
}

START_TEST(the_maximum_burns_last)
{
    random_source r = {5};
    uint8_t candidate[MAX_VERTICES];
    uint32_t most_rounds = 0;
    for (int round = 0; round < 2000; ++round) {
        icc_grid *grid = random_grid(&r, round % 2 ? 10 : 8);
        uint32_t vertex, rounds;
        const icc_status status = icc_grid_find_maximum(grid, &vertex, &rounds, NULL, NULL);
        if (grid->n_inside == 0) {
            ck_assert_int_eq(status, ICC_ERR_RESOLUTION);
        } else {
            ck_assert_int_eq(status, ICC_OK);
            ck_assert_uint_eq(rounds, burn(grid, candidate));
            ck_assert_uint_eq(vertex, middle(grid, candidate));
            most_rounds = rounds > most_rounds ? rounds : most_rounds;
        }
        icc_grid_free(grid);
    }
    ck_assert_uint_ge(most_rounds, 4);
}
END_TEST

START_TEST(the_maximum_of_polygons)
{
    const shape square = shape_square(), l = shape_l();
    icc_domain *domain = domain_of_polygon(square.n, square.xy);
    icc_grid *grid = grid_in(domain, 51);
    uint32_t vertex, rounds;
    ck_assert_int_eq(icc_grid_find_maximum(grid, &vertex, &rounds, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(vertex, (2 + 25) * (1 + grid->shape[0]));
    ck_assert_uint_eq(rounds, 25);
    icc_grid_free(grid);
    icc_domain_free(domain);
    /* Four vertices tie in the middle: the one with the smallest index. */
    domain = domain_of_polygon(square.n, square.xy);
    grid = grid_in(domain, 50);
    ck_assert_int_eq(icc_grid_find_maximum(grid, &vertex, NULL, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(vertex, (2 + 24) * (1 + grid->shape[0]));
    icc_grid_free(grid);
    icc_domain_free(domain);
    /* In the corner of the L, on its axis of symmetry. */
    domain = domain_of_polygon(l.n, l.xy);
    grid = grid_in(domain, 60);
    ck_assert_int_eq(icc_grid_find_maximum(grid, &vertex, NULL, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(vertex % grid->shape[0], vertex / grid->shape[0]);
    icc_grid_free(grid);
    icc_domain_free(domain);
}
END_TEST

/* ------------------------------------------------------------------ links */

static bool joined(const iccp_kuhn *kuhn, int i, int j)
{
    return iccp_link_has(&kuhn->joined[i], j);
}

/* Cliques of a set with more vertices counted from `from` on: +1 for odd numbers of vertices, -1
 * for even ones. At most six vertices deep. */
static int euler(const iccp_kuhn *kuhn, const iccp_link_set *set, const iccp_link_set *common,
                 int from)
{
    int sum = 0;
    for (int i = from; i < kuhn->n_neighbours; ++i) {
        if (!iccp_link_has(set, i) || !iccp_link_has(common, i))
            continue;
        const iccp_link_set shared = {
            {common->word[0] & kuhn->joined[i].word[0], common->word[1] & kuhn->joined[i].word[1]}};
        sum += 1 - euler(kuhn, set, &shared, i + 1);
    }
    return sum;
}

static int euler_of(const iccp_kuhn *kuhn, const iccp_link_set *set)
{
    const iccp_link_set all = {{UINT64_MAX, UINT64_MAX}};
    return euler(kuhn, set, &all, 0);
}

static bool connected(const iccp_kuhn *kuhn, const iccp_link_set *set)
{
    iccp_link_set reached = {{0, 0}};
    int stack[ICCP_LINK_SIZE], n_stack = 0, n_reached = 0, n = 0;
    for (int i = 0; i < kuhn->n_neighbours; ++i) {
        if (!iccp_link_has(set, i))
            continue;
        if (n++ == 0) {
            iccp_link_add(&reached, i);
            stack[n_stack++] = i;
        }
    }
    while (n_stack > 0) {
        const int i = stack[--n_stack];
        ++n_reached;
        for (int j = 0; j < kuhn->n_neighbours; ++j)
            if (iccp_link_has(set, j) && joined(kuhn, i, j) && !iccp_link_has(&reached, j)) {
                iccp_link_add(&reached, j);
                stack[n_stack++] = j;
            }
    }
    return n > 0 && n_reached == n;
}

/* A part of a circle or a sphere is contractible when it is connected and its Euler characteristic
 * is 1. */
static bool is_disc(const iccp_kuhn *kuhn, const iccp_link_set *set)
{
    return connected(kuhn, set) && euler_of(kuhn, set) == 1;
}

START_TEST(regular_sets_up_to_3d)
{
    static iccp_kuhn kuhn;
    for (int round = 0; round < 6; ++round) { /* each dimension without and with a table */
        const int32_t dim = 1 + round / 2;
        size_t n_wrong = 0;
        iccp_kuhn_init(&kuhn, dim);
        if (round % 2 == 1)
            iccp_kuhn_tabulate(&kuhn);
        ck_assert_int_eq(kuhn.n_neighbours, 2 * ((1 << dim) - 1));
        for (uint64_t bits = 0; bits < (uint64_t)1 << kuhn.n_neighbours; ++bits) {
            const iccp_link_set set = {{bits, 0}}, rest = iccp_link_rest(&kuhn, &set);
            const bool regular = is_disc(&kuhn, &set);
            n_wrong += regular != is_disc(&kuhn, &rest);
            n_wrong += regular != iccp_kuhn_regular(&kuhn, &set);
        }
        ck_assert_uint_eq(n_wrong, 0);
    }
}
END_TEST

static iccp_link_set random_set(random_source *r, const iccp_kuhn *kuhn, int of_ten)
{
    iccp_link_set set = {{0, 0}};
    for (int i = 0; i < kuhn->n_neighbours; ++i)
        if (random_below(r, 10) < of_ten)
            iccp_link_add(&set, i);
    return set;
}

/* Known sets: single vertices and pairs, cones, and what is left of the sphere without them. */
static void check_known_sets(const iccp_kuhn *kuhn)
{
    const iccp_link_set none = {{0, 0}};
    ck_assert(!iccp_kuhn_regular(kuhn, &none));
    ck_assert(!iccp_kuhn_regular(kuhn, &kuhn->all));
    for (int i = 0; i < kuhn->n_neighbours; ++i) {
        iccp_link_set one = {{0, 0}};
        iccp_link_add(&one, i);
        const iccp_link_set ball = iccp_link_rest(kuhn, &one);
        ck_assert(iccp_kuhn_regular(kuhn, &one));
        ck_assert(iccp_kuhn_regular(kuhn, &ball));
        ck_assert(iccp_kuhn_regular(kuhn, &kuhn->joined[i]));
        for (int j = 0; j < i; ++j) {
            iccp_link_set two = one;
            iccp_link_add(&two, j);
            ck_assert(joined(kuhn, i, j) == joined(kuhn, j, i));
            ck_assert(iccp_kuhn_regular(kuhn, &two) == joined(kuhn, i, j));
        }
    }
}

/* The halves of a sphere on two sides of a plane are balls, wherever the plane lies, unless one of
 * them is empty: what a linear function sees. */
static void check_halves(const iccp_kuhn *kuhn, random_source *r)
{
    double slope[ICC_MAX_DIM];
    for (int32_t k = 0; k < kuhn->dim; ++k)
        slope[k] = random_between(r, -1, 1);
    iccp_link_set higher = {{0, 0}};
    for (int i = 0; i < kuhn->n_neighbours; ++i) {
        double rise = 0;
        for (int32_t k = 0; k < kuhn->dim; ++k)
            rise += slope[k] * kuhn->step[i][k];
        if (rise > 0)
            iccp_link_add(&higher, i);
    }
    ck_assert(iccp_kuhn_regular(kuhn, &higher));
}

START_TEST(regular_sets_beyond_3d)
{
    static iccp_kuhn kuhn;
    random_source r = {6};
    for (int32_t dim = 4; dim <= ICC_MAX_DIM; ++dim) {
        iccp_kuhn_init(&kuhn, dim);
        ck_assert_int_eq(kuhn.n_neighbours, 2 * ((1 << dim) - 1));
        check_known_sets(&kuhn);
        int n_regular = 0;
        for (int round = 0; round < 1000; ++round) {
            check_halves(&kuhn, &r);
            const iccp_link_set set = random_set(&r, &kuhn, 1 + round % 9);
            const iccp_link_set rest = iccp_link_rest(&kuhn, &set);
            const bool regular = iccp_kuhn_regular(&kuhn, &set);
            ck_assert(regular == iccp_kuhn_regular(&kuhn, &rest));
            if (!regular)
                continue;
            ++n_regular;
            ck_assert(connected(&kuhn, &set) && connected(&kuhn, &rest));
            if (dim < 6 && round % 10 == 0) {
                ck_assert_int_eq(euler_of(&kuhn, &set), 1);
                ck_assert_int_eq(euler_of(&kuhn, &rest), 1);
            }
        }
        ck_assert_int_gt(n_regular, 20);
    }
}
END_TEST

/* --------------------------------------------------------- failing, wrong */

static icc_status make_and_burn(const icc_env *env, icc_error *err, void *domain)
{
    icc_grid *grid = (icc_grid *)&grid;
    icc_status status = icc_grid_create(&grid, domain, 20, env, err);
    ck_assert((grid == NULL) == (status != ICC_OK));
    uint32_t vertex;
    if (status == ICC_OK)
        status = icc_grid_find_maximum(grid, &vertex, NULL, env, err);
    icc_grid_free(grid);
    return status;
}

static icc_status make_mask_and_burn(const icc_env *env, icc_error *err, void *unused)
{
    (void)unused;
    const uint8_t inside[3] = {0, 1, 0};
    icc_grid *grid = (icc_grid *)&grid;
    icc_status status = icc_grid_create_mask(&grid, 1, (size_t[]){3}, inside, env, err);
    ck_assert((grid == NULL) == (status != ICC_OK));
    uint32_t vertex;
    if (status == ICC_OK)
        status = icc_grid_find_maximum(grid, &vertex, NULL, env, err);
    icc_grid_free(grid);
    return status;
}

START_TEST(every_failure_is_reported)
{
    const shape s = shape_star(5, 0.4, 0.1);
    icc_domain *domain = domain_of_polygon(s.n, s.xy);
    faulty_sweep(make_and_burn, domain);
    faulty_sweep(make_mask_and_burn, NULL);
    icc_domain_free(domain);
    static surface octahedron;
    surface_octahedron(&octahedron);
    domain = domain_in(3, octahedron.n_vertices, octahedron.vertices, octahedron.n_faces,
                       octahedron.faces);
    faulty_sweep(make_and_burn, domain);
    icc_domain_free(domain);
}
END_TEST

START_TEST(wrong_arguments)
{
    const shape s = shape_square();
    icc_domain *domain = domain_of_polygon(s.n, s.xy);
    icc_grid *grid = (icc_grid *)&grid;
    const uint8_t inside = 1;
    const size_t sides[ICC_MAX_DIM + 1] = {1, 1, 0};
    uint32_t vertex;
    const double point[2] = {0, 0};
    ck_assert_int_eq(icc_grid_create(NULL, domain, 0, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_create(&grid, NULL, 0, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(grid);
    static const int32_t cells[4] = {-1, 1, 16385, INT32_MIN};
    for (int i = 0; i < 4; ++i)
        ck_assert_int_eq(icc_grid_create(&grid, domain, cells[i], NULL, NULL), ICC_ERR_ARGUMENT);
    static const int32_t dims[4] = {0, -1, 7, 3};
    for (int i = 0; i < 4; ++i)
        ck_assert_int_eq(icc_grid_create_mask(&grid, dims[i], sides, &inside, NULL, NULL),
                         ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_create_mask(&grid, 2, NULL, &inside, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_create_mask(&grid, 2, sides, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_create_mask(NULL, 2, sides, &inside, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_create_mask(&grid, 2, sides, &inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_maximum(NULL, &vertex, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_find_maximum(grid, NULL, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_find_nearest(NULL, point, &vertex), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_find_nearest(grid, NULL, &vertex), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_find_nearest(grid, point, NULL), ICC_ERR_ARGUMENT);
    icc_grid_info info = {.size = 0};
    ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_get_info(grid, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_grid_get_info(NULL, &info), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(icc_grid_inside(NULL));
    icc_grid_free(grid);
    icc_domain_free(domain);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("grid");
    TCase *tests = tcase_create("grid");
    tcase_add_test(tests, neighbours_differ_by_one_step);
    tcase_add_test(tests, masks_are_copied_as_zeros_and_ones);
    tcase_add_test(tests, too_large_a_mask_is_refused);
    tcase_add_test(tests, nearest_is_the_first_of_the_nearest);
    tcase_add_test(tests, polygons_of_every_kind);
    tcase_add_test(tests, boundaries_through_grid_vertices);
    tcase_add_test(tests, extreme_shapes);
    tcase_add_test(tests, info_is_in_the_callers_coordinates);
    tcase_add_test(tests, no_grid_without_vertices_inside);
    tcase_add_test(tests, surfaces_of_every_kind);
    tcase_add_test(tests, boundaries_along_the_rows);
    tcase_add_test(tests, stray_pieces_are_dropped);
    tcase_add_test(tests, the_maximum_burns_last);
    tcase_add_test(tests, the_maximum_of_polygons);
    tcase_add_test(tests, regular_sets_up_to_3d);
    tcase_add_test(tests, regular_sets_beyond_3d);
    tcase_add_test(tests, every_failure_is_reported);
    tcase_add_test(tests, wrong_arguments);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
