/* Which simplices of a grid a boundary meets, and at which vertices its facets are noted. */
#include "field/incidence.h"
#include "gradient/grid/rasterise.h"

#include "../../default_env.h"
#include "../../random.h"
#include "../../share.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CELLS = 256 };

static const double NEAR = 1e-9;

/* A box with boxes cut out of it, tried until it is one piece without holes. */
static icc_domain *random_mask(random_source *r, int32_t dim)
{
    for (;;) {
        size_t shape[ICC_MAX_DIM], n = 1;
        uint8_t cells[MAX_CELLS];
        for (int32_t k = 0; k < dim; ++k)
            n *= shape[k] = (size_t)(2 + random_below(r, dim > 2 && k > 0 ? 1 : 3));
        memset(cells, 1, sizeof cells);
        for (int cut = 0; cut < 2; ++cut) {
            size_t low[ICC_MAX_DIM], high[ICC_MAX_DIM];
            for (int32_t k = 0; k < dim; ++k) {
                low[k] = (size_t)random_below(r, (int)shape[k]);
                high[k] = low[k] + (size_t)random_below(r, 2);
            }
            for (size_t c = 0; c < n; ++c) {
                bool in = true;
                size_t rest = c;
                for (int32_t k = 0; k < dim; rest /= shape[k++])
                    in = in && rest % shape[k] >= low[k] && rest % shape[k] <= high[k];
                cells[c] = in ? 0 : cells[c];
            }
        }
        icc_domain *domain;
        if (icc_domain_create_mask(&domain, dim, shape, cells, NULL, NULL) == ICC_OK)
            return domain;
    }
}

static void corner_of(const icc_domain *domain, const icc_grid *grid, size_t facet, int32_t i,
                      double *x)
{
    const size_t dim = (size_t)grid->dim, v = domain->facets[dim * facet + (size_t)i];
    for (size_t k = 0; k < dim; ++k)
        x[k] = (domain->vertices[dim * v + k] - grid->origin[k]) / grid->spacing;
}

/* By Gauss: the weights of the corners that give the point, if there are any; none is negative. */
static bool lies_in(const icc_domain *domain, const icc_grid *grid, size_t facet, const double *p)
{
    const int32_t dim = grid->dim;
    double a[ICC_MAX_DIM + 1][ICC_MAX_DIM + 1], reach = 0;
    for (int32_t i = 0; i <= dim; ++i) {
        double x[ICC_MAX_DIM];
        if (i < dim)
            corner_of(domain, grid, facet, i, x);
        for (int32_t k = 0; i == 1 && k < dim; ++k)
            reach = fmax(reach, fabs(a[k][0] - x[k]));
        for (int32_t k = 0; k < dim; ++k)
            a[k][i] = i < dim ? x[k] : p[k];
        a[dim][i] = 1;
    }
    /* Most are far off: an edge of a mask's facet is as long as the facet along some axis. */
    for (int32_t k = 0; k < dim; ++k)
        if (fabs(a[k][0] - p[k]) > reach + NEAR)
            return false;
    for (int32_t c = 0; c < dim; ++c) {
        int32_t best = c;
        for (int32_t row = c; row <= dim; ++row)
            best = fabs(a[row][c]) > fabs(a[best][c]) ? row : best;
        for (int32_t k = 0; k <= dim; ++k) {
            const double swap = a[c][k];
            a[c][k] = a[best][k];
            a[best][k] = swap;
        }
        for (int32_t row = 0; row <= dim; ++row) {
            const double factor = row != c ? a[row][c] / a[c][c] : 0;
            for (int32_t k = 0; k <= dim; ++k)
                a[row][k] -= factor * a[c][k];
        }
    }
    bool in = fabs(a[dim][dim]) < NEAR;
    for (int32_t c = 0; c < dim; ++c)
        in = in && a[c][dim] / a[c][c] > -NEAR;
    return in;
}

static bool is_noted(const iccp_incidence *incidence, uint32_t v, uint32_t facet)
{
    for (uint32_t i = incidence->first[v]; i < incidence->first[v + 1]; ++i)
        if (incidence->facet[i] == facet)
            return true;
    return false;
}

/* Facets are noted exactly where they pass. */
static void check_notes(const iccp_incidence *incidence)
{
    const icc_grid *grid = incidence->grid;
    for (uint32_t v = 0; v < grid->n_vertices; ++v) {
        double p[ICC_MAX_DIM];
        for (int32_t k = 0; k < grid->dim; ++k)
            p[k] = iccp_grid_coordinate(grid, v, k);
        uint32_t n = 0;
        for (uint32_t f = 0; f < incidence->domain->n_facets; ++f)
            if (lies_in(incidence->domain, grid, f, p)) {
                ck_assert(is_noted(incidence, v, f));
                ++n;
            }
        ck_assert_uint_eq(n, incidence->first[v + 1] - incidence->first[v]);
    }
}

static bool middle_is_inside(const iccp_incidence *incidence, uint32_t lowest, const int8_t *axis)
{
    const icc_grid *grid = incidence->grid;
    double x[ICC_MAX_DIM];
    for (int32_t i = 0; i < grid->dim; ++i)
        x[axis[i]] =
            grid->origin[axis[i]] + grid->spacing * (iccp_grid_coordinate(grid, lowest, axis[i]) +
                                                     (double)(grid->dim - i) / (grid->dim + 1));
    return iccp_domain_locate(incidence->domain, x, true, NULL, NULL) == ICC_INSIDE;
}

/* The simplices in the mask with a vertex on the boundary have a bit, and no others; and their
 * faces there. */
static void check_bits(const iccp_incidence *incidence)
{
    const icc_grid *grid = incidence->grid;
    const int32_t dim = grid->dim;
    iccp_orders *orders = malloc(sizeof *orders);
    iccp_orders_init(orders, grid);
    for (uint32_t lowest = 0; lowest < grid->n_vertices; ++lowest) {
        uint32_t bits = 0, faces = 0;
        bool in_grid = true;
        for (int32_t k = 0; k < dim; ++k)
            in_grid = in_grid && iccp_grid_coordinate(grid, lowest, k) + 1 < grid->shape[k];
        for (int32_t r = 0; in_grid && r < orders->n; ++r) {
            if (!middle_is_inside(incidence, lowest, orders->axis[r]))
                continue;
            for (int32_t k = 0, v = (int32_t)lowest; k <= dim; ++k) {
                if (incidence->first[v] < incidence->first[v + 1]) {
                    bits |= (uint32_t)1 << (r % 32);
                    for (int32_t i = 0; i <= dim; ++i)
                        faces |= i != k ? iccp_incidence_face_bit(dim, r, i) : 0;
                }
                v += k < dim ? (int32_t)grid->stride[orders->axis[r][k]] : 0;
            }
        }
        ck_assert_uint_eq(bits, incidence->bits[lowest]);
        ck_assert_uint_eq(faces, incidence->faces[lowest]);
    }
    free(orders);
}

/* Against a cover that does not know of the mask, which may note more. */
static void check_against(const iccp_incidence *mask, const iccp_incidence *any)
{
    const size_t dim = (size_t)mask->grid->dim;
    for (size_t i = 0; i < dim * mask->domain->n_facets; ++i)
        ck_assert(fabs(mask->normal[i] - any->normal[i]) < NEAR);
    for (uint32_t v = 0; v < mask->grid->n_vertices; ++v) {
        ck_assert_uint_eq(mask->bits[v] & ~any->bits[v], 0);
        ck_assert_uint_eq(mask->faces[v] & ~any->faces[v], 0);
        for (uint32_t i = mask->first[v]; i < mask->first[v + 1]; ++i)
            ck_assert(is_noted(any, v, mask->facet[i]));
    }
}

START_TEST(facets_of_masks_are_noted_where_they_pass)
{
    const iccp_env env = default_env();
    random_source r = {1};
    for (int round = 0; round < 6; ++round) {
        const int32_t dim = 2 + round % 3;
        icc_domain *domain = random_mask(&r, dim);
        icc_grid *grid;
        /* Two, or four, grid steps to a cell. */
        const int32_t cells = dim < 4 && round % 2 == 0 ? 12 : 2;
        ck_assert_int_eq(iccp_grid_create(&grid, domain, cells, &env, NULL), ICC_OK);
        iccp_incidence mask, any;
        ck_assert_int_eq(iccp_incidence_create(&mask, domain, grid, &env), ICC_OK);
        check_notes(&mask);
        check_bits(&mask);
        if (dim < 4) {
            struct iccp_mask *own = domain->mask;
            domain->mask = NULL;
            ck_assert_int_eq(iccp_incidence_create(&any, domain, grid, &env), ICC_OK);
            domain->mask = own;
            check_against(&mask, &any);
            iccp_incidence_free(&any);
        }
        iccp_incidence_free(&mask);
        iccp_grid_release(grid);
        icc_domain_free(domain);
    }
}
END_TEST

/* Vertices of the grid may have been given up: then only simplices that lie in the mask count. */
START_TEST(vertices_given_up_have_no_facets)
{
    const iccp_env env = default_env();
    static const size_t SHAPE[3] = {2, 2, 2};
    static const uint8_t CELLS[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    icc_domain *domain;
    icc_grid *grid, *part;
    iccp_incidence incidence;
    ck_assert_int_eq(icc_domain_create_mask(&domain, 3, SHAPE, CELLS, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_grid_create(&grid, domain, 2, &env, NULL), ICC_OK);
    uint8_t *keep = calloc(grid->n_vertices, 1);
    const uint32_t middle = (uint32_t)(grid->n_vertices / 2);
    keep[middle] = 1;
    ck_assert_int_eq(iccp_grid_restrict(&part, grid, keep, &env, NULL), ICC_OK);
    ck_assert_int_eq(iccp_incidence_create(&incidence, domain, part, &env), ICC_OK);
    for (uint32_t v = 0; v < part->n_vertices; ++v) {
        double p[3];
        bool any = false;
        for (int32_t k = 0; k < 3; ++k)
            p[k] = iccp_grid_coordinate(grid, v, k);
        for (uint32_t f = 0; f < domain->n_facets; ++f)
            any = any || lies_in(domain, grid, f, p);
        ck_assert_int_eq(any, incidence.first[v + 1] > incidence.first[v]);
        /* Outside, in the cell beyond a corner of the mask. */
        if (iccp_grid_coordinate(grid, v, 0) == 1)
            ck_assert_uint_eq(incidence.bits[v], 0);
    }
    free(keep);
    iccp_incidence_free(&incidence);
    iccp_grid_release(part);
    iccp_grid_release(grid);
    icc_domain_free(domain);
}
END_TEST

enum { N_LATTICE = 6 };

/* A tetrahedron with its corners on the lattice, in a grid without vertices inside. */
static icc_domain *random_tetrahedron(random_source *r, icc_grid **grid, const uint32_t *order)
{
    const iccp_env env = default_env();
    static const uint32_t FACES[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    static const size_t SHAPE[3] = {N_LATTICE, N_LATTICE, N_LATTICE};
    uint32_t faces[12];
    icc_domain *domain = NULL;
    while (domain == NULL) {
        double corners[12];
        for (int i = 0; i < 12; ++i)
            corners[i] = 1 + random_below(r, N_LATTICE - 2);
        for (int i = 0; i < 12; ++i)
            faces[i] = FACES[3 * order[i / 3] + (uint32_t)(i % 3)];
        (void)icc_domain_create(&domain, 3, 4, corners, 4, faces, NULL, NULL);
    }
    ck_assert_int_eq(iccp_grid_new(grid, 3, SHAPE, &env, NULL), ICC_OK);
    const double zero[3] = {0};
    iccp_frame_in(&domain->frame, 3, zero, (*grid)->origin);
    (*grid)->spacing = domain->frame.in[0] * domain->frame.in[1];
    return domain;
}

/* What one facet only grazes another may run through, before or after it. */
START_TEST(the_order_of_the_facets_does_not_matter)
{
    static const uint32_t ORDERS[2][4] = {{0, 1, 2, 3}, {3, 2, 1, 0}};
    const iccp_env env = default_env();
    for (uint64_t seed = 0; seed < (uint64_t)share_of(2000); ++seed) {
        iccp_incidence incidence[2];
        icc_domain *domain[2];
        icc_grid *grid[2];
        for (int i = 0; i < 2; ++i) {
            random_source r = {seed};
            domain[i] = random_tetrahedron(&r, &grid[i], ORDERS[i]);
            ck_assert_int_eq(iccp_incidence_create(&incidence[i], domain[i], grid[i], &env),
                             ICC_OK);
        }
        for (uint32_t v = 0; v < grid[0]->n_vertices; ++v) {
            ck_assert_uint_eq(incidence[0].bits[v], incidence[1].bits[v]);
            ck_assert_uint_eq(incidence[0].first[v], incidence[1].first[v]);
            for (uint32_t i = incidence[0].first[v]; i < incidence[0].first[v + 1]; ++i) {
                ck_assert(i == incidence[0].first[v] ||
                          incidence[0].facet[i - 1] < incidence[0].facet[i]);
                ck_assert(is_noted(&incidence[1], v, 3 - incidence[0].facet[i]));
            }
        }
        for (int i = 0; i < 2; ++i) {
            iccp_incidence_free(&incidence[i]);
            iccp_grid_release(grid[i]);
            icc_domain_free(domain[i]);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("cover");
    TCase *tests = tcase_create("cover");
    tcase_add_test(tests, facets_of_masks_are_noted_where_they_pass);
    tcase_add_test(tests, vertices_given_up_have_no_facets);
    tcase_add_test(tests, the_order_of_the_facets_does_not_matter);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
