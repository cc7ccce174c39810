/* Algorithm 2 against itself as it is printed, what becomes of the vertices outside, and the cousin
 * rule where it is known to hold and known to fail. */
#include "gradient/tree/cousin.h"
#include "icc/stages.h"

#include "../../../faulty.h"
#include "../../../grids.h"
#include "../../../random.h"
#include "../../../shapes.h"
#include "../../../suite.h"

#include <check.h>
#include <string.h>

enum { MAX_VERTICES = 4096 };

static icc_tree *tree_of(const icc_grid *grid, uint32_t root, int32_t form,
                         const int32_t *axis_order)
{
    const icc_tree_options options = {
        .size = sizeof options, .form = form, .axis_order = axis_order};
    icc_tree *tree;
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, &options, NULL, NULL), ICC_OK);
    return tree;
}

static icc_tree_report report_on(const icc_tree *tree)
{
    icc_tree_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_tree_get_report(tree, &report, NULL, NULL), ICC_OK);
    return report;
}

/* A random mask with at least one vertex inside. */
static icc_grid *random_grid(random_source *r, int32_t dim)
{
    uint8_t inside[MAX_VERTICES] = {0};
    size_t sides[ICC_MAX_DIM], n = 1;
    for (int32_t k = 0; k < dim; ++k)
        n *= sides[k] = (size_t)(1 + random_below(r, dim > 3 ? 4 : dim == 2 ? 20 : 9));
    const int density = 3 + random_below(r, 8);
    for (size_t v = 0; v < n; ++v)
        inside[v] = random_below(r, 10) < density;
    inside[random_below(r, (int)n)] = 1;
    return grid_of(dim, sides, inside);
}

static void random_order(random_source *r, int32_t dim, int32_t *order)
{
    for (int32_t k = 0; k < dim; ++k) {
        const int32_t at = random_below(r, k + 1);
        order[k] = order[at];
        order[at] = k;
    }
}

/* --------------------------------------------------------- the pseudocode */

typedef struct printed {
    uint32_t parent[MAX_VERTICES];
    int32_t generation[MAX_VERTICES];
    uint32_t frontier[MAX_VERTICES], next[MAX_VERTICES];
    size_t n_frontier, n_next;
} printed;

static bool near_inside(const icc_grid *grid, uint32_t v)
{
    bool near = grid->inside[v];
    for (int32_t k = 0; k < grid->dim; ++k)
        for (int32_t step = -1; step <= 1; step += 2) {
            const uint32_t u = iccp_grid_neighbour(grid, v, k, step);
            near = near || (u != ICCP_NONE && grid->inside[u]);
        }
    return near;
}

static void printed_visit(printed *p, const icc_grid *grid, int32_t form, uint32_t v, uint32_t u)
{
    if (u == ICCP_NONE || p->generation[u] >= 0)
        return;
    if (form == ICC_TREE_THESIS ? grid->inside[u] && !grid->inside[v] : !grid->inside[u])
        return;
    p->parent[u] = v;
    p->generation[u] = p->generation[v] + 1;
    p->next[p->n_next++] = u;
}

/* Algorithm 2 of the thesis, or that of the paper without the vertices outside. */
static void run_printed(printed *p, const icc_grid *grid, uint32_t root, int32_t form,
                        const int32_t *axis_order)
{
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        p->parent[v] = ICCP_NONE;
        p->generation[v] = -1;
    }
    p->generation[root] = 0;
    p->frontier[0] = root;
    p->n_frontier = 1;
    while (p->n_frontier > 0) {
        p->n_next = 0;
        for (int32_t a = 0; a < grid->dim; ++a)
            for (size_t i = 0; i < p->n_frontier; ++i)
                for (int32_t step = -1; step <= 1; step += 2) {
                    const uint32_t v = p->frontier[i];
                    if (near_inside(grid, v))
                        printed_visit(p, grid, form, v,
                                      iccp_grid_neighbour(grid, v, axis_order[a], step));
                }
        memcpy(p->frontier, p->next, p->n_next * sizeof *p->next);
        p->n_frontier = p->n_next;
    }
}

START_TEST(inside_the_tree_is_the_printed_one)
{
    static printed p;
    random_source r = {1};
    for (int round = 0; round < 3000; ++round) {
        const int32_t dim = 1 + round % ICC_MAX_DIM;
        icc_grid *grid = random_grid(&r, dim);
        const uint32_t root = grid_random_inside(&r, grid);
        int32_t order[ICC_MAX_DIM];
        random_order(&r, dim, order);
        for (int32_t form = ICC_TREE_THESIS; form <= ICC_TREE_PAPER; ++form) {
            run_printed(&p, grid, root, form, order);
            icc_tree *tree = tree_of(grid, root, form, order);
            size_t n_wrong = 0;
            for (size_t v = 0; v < grid->n_vertices; ++v)
                n_wrong += grid->inside[v] && (icc_tree_parents(tree)[v] != p.parent[v] ||
                                               icc_tree_generations(tree)[v] != p.generation[v]);
            ck_assert_uint_eq(n_wrong, 0);
            icc_tree_free(tree);
        }
        icc_grid_free(grid);
    }
}
END_TEST

/* On shapes without gaps the layers outside are the printed ones too. */
START_TEST(round_boxes_the_whole_tree_is_the_printed_one)
{
    static printed p;
    random_source r = {2};
    for (int round = 0; round < 300; ++round) {
        uint8_t inside[400] = {0};
        const int x0 = 2 + random_below(&r, 8), x1 = x0 + random_below(&r, 8);
        const int y0 = 2 + random_below(&r, 8), y1 = y0 + random_below(&r, 8);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x)
                inside[x + 20 * y] = 1;
        icc_grid *grid = grid_of(2, (size_t[]){20, 20}, inside);
        const uint32_t root = grid_random_inside(&r, grid);
        const int32_t order[2] = {round % 2, 1 - round % 2};
        run_printed(&p, grid, root, ICC_TREE_THESIS, order);
        icc_tree *tree = tree_of(grid, root, ICC_TREE_THESIS, order);
        ck_assert_mem_eq(tree->parent, p.parent, sizeof inside * sizeof *p.parent);
        ck_assert_mem_eq(tree->generation, p.generation, sizeof inside * sizeof *p.generation);
        icc_tree_free(tree);
        icc_grid_free(grid);
    }
}
END_TEST

/* ------------------------------------------------------------ the outside */

/* The smallest generation among the neighbours that are inside (or outside), or -1. */
static int32_t least_around(const icc_tree *tree, uint32_t v, bool inside)
{
    const icc_grid *grid = tree->grid;
    int32_t least = -1;
    for (int32_t k = 0; k < grid->dim; ++k)
        for (int32_t step = -1; step <= 1; step += 2) {
            const uint32_t u = iccp_grid_neighbour(grid, v, k, step);
            if (u == ICCP_NONE || grid->inside[u] != inside || tree->generation[u] < 0)
                continue;
            if (least < 0 || tree->generation[u] < least)
                least = tree->generation[u];
        }
    return least;
}

/* 1: the first layer; 2: the second one; 0: neither. */
static int layer_of(const icc_tree *tree, uint32_t v)
{
    const icc_grid *grid = tree->grid;
    if (grid->inside[v])
        return 0;
    if (least_around(tree, v, true) >= 0)
        return 1;
    for (int32_t k = 0; k < grid->dim; ++k)
        for (int32_t step = -1; step <= 1; step += 2) {
            const uint32_t u = iccp_grid_neighbour(grid, v, k, step);
            if (u != ICCP_NONE && !grid->inside[u] && least_around(tree, u, true) >= 0)
                return 2;
        }
    return 0;
}

static int32_t least_first_layer(const icc_tree *tree, uint32_t v)
{
    const icc_grid *grid = tree->grid;
    int32_t least = INT32_MAX;
    for (int32_t k = 0; k < grid->dim; ++k)
        for (int32_t step = -1; step <= 1; step += 2) {
            const uint32_t u = iccp_grid_neighbour(grid, v, k, step);
            if (u != ICCP_NONE && layer_of(tree, u) == 1 && tree->generation[u] < least)
                least = tree->generation[u];
        }
    return least;
}

static void check_outside(const icc_tree *tree)
{
    const icc_grid *grid = tree->grid;
    size_t n_wrong = 0; /* one assertion for all: each costs a system call */
    for (uint32_t v = 0; v < grid->n_vertices; ++v) {
        if (grid->inside[v])
            continue;
        const int layer = layer_of(tree, v);
        const int32_t expected = layer == 1   ? least_around(tree, v, true) + 1
                                 : layer == 2 ? least_first_layer(tree, v) + 1
                                              : -1;
        const uint32_t parent = tree->parent[v];
        n_wrong += tree->generation[v] != expected;
        n_wrong += (parent != ICCP_NONE) != (layer > 0 && tree->form == ICC_TREE_THESIS);
        if (parent != ICCP_NONE) {
            n_wrong += grid->inside[parent] ? layer != 1 : layer_of(tree, parent) != 1;
            n_wrong += tree->generation[parent] + 1 != expected;
        }
    }
    ck_assert_uint_eq(n_wrong, 0);
}

/* Every vertex with a generation once, parents first, inside before outside. */
static void check_order(const icc_tree *tree)
{
    static size_t place[MAX_VERTICES];
    size_t n_reached = 0, n_wrong = 0;
    for (size_t v = 0; v < tree->grid->n_vertices; ++v) {
        place[v] = SIZE_MAX;
        n_reached += tree->generation[v] >= 0;
    }
    ck_assert_uint_eq(n_reached, tree->n_reached);
    for (size_t i = 0; i < tree->n_reached; ++i) {
        const uint32_t v = tree->order[i];
        n_wrong += place[v] != SIZE_MAX;
        place[v] = i;
        n_wrong += tree->grid->inside[v] != (i < tree->n_inside);
        n_wrong += tree->parent[v] != ICCP_NONE && place[tree->parent[v]] >= i;
        n_wrong += i > 0 && i != tree->n_inside &&
                   tree->generation[v] < tree->generation[tree->order[i - 1]];
    }
    ck_assert_uint_eq(n_wrong, 0);
}

/* A cell with a corner inside and reached has all corners reached, but for those inside that no
 * tree can reach. */
static void check_cells(const icc_tree *tree)
{
    const icc_grid *grid = tree->grid;
    size_t n_wrong = 0;
    for (size_t j = 0; j + 1 < grid->shape[1]; ++j)
        for (size_t i = 0; i + 1 < grid->shape[0]; ++i) {
            const size_t v = i + j * grid->shape[0];
            const size_t corner[4] = {v, v + 1, v + grid->shape[0], v + grid->shape[0] + 1};
            bool reached = false;
            for (int c = 0; c < 4; ++c)
                reached = reached || (grid->inside[corner[c]] && tree->generation[corner[c]] >= 0);
            for (int c = 0; c < 4 && reached; ++c)
                n_wrong += !grid->inside[corner[c]] && tree->generation[corner[c]] < 0;
        }
    ck_assert_uint_eq(n_wrong, 0);
}

START_TEST(two_layers_outside)
{
    random_source r = {3};
    for (int round = 0; round < 1500; ++round) {
        const int32_t dim = 1 + round % 4;
        icc_grid *grid = random_grid(&r, dim);
        const uint32_t root = grid_random_inside(&r, grid);
        for (int32_t form = ICC_TREE_THESIS; form <= ICC_TREE_PAPER; ++form) {
            icc_tree *tree = tree_of(grid, root, form, NULL);
            check_outside(tree);
            check_order(tree);
            if (dim == 2)
                check_cells(tree);
            icc_tree_free(tree);
        }
        icc_grid_free(grid);
    }
}
END_TEST

/* Two arms, two cells apart. Neither arm's neighbours in the gap lie higher than they should. */
START_TEST(a_gap_is_not_bridged)
{
    uint8_t inside[7 * 14] = {0};
    for (int y = 2; y < 12; ++y)
        inside[2 + 7 * y] = inside[5 + 7 * y] = 1;
    inside[3 + 7 * 11] = inside[4 + 7 * 11] = 1;
    icc_grid *grid = grid_of(2, (size_t[]){7, 14}, inside);
    icc_tree *tree = tree_of(grid, 2 + 7 * 2, ICC_TREE_THESIS, NULL);
    check_outside(tree);
    ck_assert_int_eq(tree->generation[5 + 7 * 2], 21);
    ck_assert_int_eq(tree->generation[4 + 7 * 2], 22);
    ck_assert_int_eq(tree->generation[3 + 7 * 2], 1);
    icc_tree_free(tree);
    icc_grid_free(grid);
}
END_TEST

START_TEST(polygons_have_no_holes_in_their_values)
{
    size_t n_unreachable = 0;
    for (int k = 0; k < N_SHAPES; ++k)
        for (int32_t cells = 4; cells <= 60; cells += 7) {
            const shape s = shape_number(k);
            icc_domain *domain;
            icc_grid *grid;
            ck_assert_int_eq(icc_domain_create(&domain, 2, s.n, s.xy, 0, NULL, NULL, NULL), ICC_OK);
            if (icc_grid_create(&grid, domain, cells, NULL, NULL) == ICC_OK) {
                uint32_t root;
                ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
                for (int32_t form = ICC_TREE_THESIS; form <= ICC_TREE_PAPER; ++form) {
                    icc_tree *tree = tree_of(grid, root, form, NULL);
                    check_cells(tree);
                    const icc_tree_report report = report_on(tree);
                    ck_assert_uint_eq(report.n_cousin_violations, 0);
                    ck_assert_uint_eq(report.n_inside + report.n_unreachable, grid->n_inside);
                    n_unreachable += report.n_unreachable;
                    icc_tree_free(tree);
                }
            }
            icc_grid_free(grid);
            icc_domain_free(domain);
        }
    ck_assert_uint_gt(n_unreachable, 0); /* coarse grids cut thin parts off */
}
END_TEST

/* ---------------------------------------------------------- the cousin rule */

/* The pairs by the definition, one after the other. */
static icc_tree_report count_pairs(const icc_tree *tree)
{
    const icc_grid *grid = tree->grid;
    icc_tree_report report = {.violation = {UINT32_MAX, UINT32_MAX}};
    for (uint32_t a = 0; a < grid->n_vertices; ++a)
        for (int32_t k = 0; k < grid->dim; ++k) {
            const uint32_t b = iccp_grid_neighbour(grid, a, k, 1);
            if (b == ICCP_NONE || !grid->inside[a] || !grid->inside[b] || tree->generation[a] < 0)
                continue;
            ++report.n_pairs;
            const uint32_t pa = tree->parent[a], pb = tree->parent[b];
            bool fine = pa == b || pb == a;
            for (int32_t m = 0; m < grid->dim && pa != ICCP_NONE && pb != ICCP_NONE; ++m)
                fine = fine || iccp_grid_neighbour(grid, pa, m, 1) == pb ||
                       iccp_grid_neighbour(grid, pa, m, -1) == pb;
            if (!fine && report.n_cousin_violations++ == 0) {
                report.violation[0] = a;
                report.violation[1] = b;
            }
        }
    return report;
}

START_TEST(the_verifier_counts_what_the_definition_says)
{
    random_source r = {4};
    size_t n_violations = 0;
    for (int round = 0; round < 2000; ++round) {
        icc_grid *grid = random_grid(&r, 2 + round % 5);
        icc_tree *tree = tree_of(grid, grid_random_inside(&r, grid), 0, NULL);
        const icc_tree_report found = report_on(tree), expected = count_pairs(tree);
        ck_assert_uint_eq(found.n_pairs, expected.n_pairs);
        ck_assert_uint_eq(found.n_cousin_violations, expected.n_cousin_violations);
        ck_assert_uint_eq(found.violation[0], expected.violation[0]);
        ck_assert_uint_eq(found.violation[1], expected.violation[1]);
        ck_assert_uint_eq(found.n_inside, tree->n_inside);
        ck_assert_uint_eq(found.n_outside, tree->n_reached - tree->n_inside);
        n_violations += found.n_cousin_violations;
        icc_tree_free(tree);
        icc_grid_free(grid);
    }
    ck_assert_uint_gt(n_violations, 1000);
}
END_TEST

/* Three cubes in an L, the smallest solid against Theorem 2: found in one order of the axes
 * only. */
START_TEST(the_l_of_three_cubes)
{
    static const int cubes[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    static const int32_t orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                         {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    uint8_t inside[3 * 2 * 3] = {0};
    for (int c = 0; c < 3; ++c)
        for (int corner = 0; corner < 8; ++corner)
            inside[cubes[c][0] + (corner & 1) + 3 * (cubes[c][1] + (corner >> 1 & 1)) +
                   6 * (cubes[c][2] + (corner >> 2))] = 1;
    icc_grid *grid = grid_of(3, (size_t[]){3, 2, 3}, inside);
    ck_assert_uint_eq(grid->n_inside, 16);
    for (int i = 0; i < 6; ++i) {
        icc_tree *tree = tree_of(grid, 2, 0, orders[i]);
        const icc_tree_report report = report_on(tree);
        ck_assert_uint_eq(report.n_cousin_violations, i == 0);
        ck_assert_uint_eq(report.violation[0], i == 0 ? 1 + 3 + 6 : UINT32_MAX);
        ck_assert_uint_eq(report.violation[1], i == 0 ? 1 + 3 + 12 : UINT32_MAX);
        icc_tree_free(tree);
    }
    icc_grid_free(grid);
}
END_TEST

START_TEST(boxes_obey_the_rule)
{
    random_source r = {5};
    uint8_t inside[MAX_VERTICES];
    memset(inside, 1, sizeof inside);
    for (int32_t dim = 1; dim <= ICC_MAX_DIM; ++dim)
        for (int round = 0; round < 30; ++round) {
            size_t sides[ICC_MAX_DIM];
            int32_t order[ICC_MAX_DIM];
            for (int32_t k = 0; k < dim; ++k)
                sides[k] = (size_t)(1 + random_below(&r, dim > 4 ? 4 : 6));
            random_order(&r, dim, order);
            icc_grid *grid = grid_of(dim, sides, inside);
            const uint32_t root = grid_random_inside(&r, grid);
            icc_tree *tree = tree_of(grid, root, ICC_TREE_PAPER, order);
            const icc_tree_report report = report_on(tree);
            ck_assert_uint_eq(report.n_cousin_violations, 0);
            ck_assert_uint_eq(report.n_inside, grid->n_vertices);
            ck_assert_uint_eq(report.n_outside + report.n_unreachable, 0);
            for (uint32_t v = 0; v < grid->n_vertices; ++v) { /* the L1 distance */
                int64_t distance = 0;
                for (int32_t k = 0; k < dim; ++k)
                    distance += llabs((int64_t)iccp_grid_coordinate(grid, v, k) -
                                      (int64_t)iccp_grid_coordinate(grid, root, k));
                ck_assert_int_eq(tree->generation[v], distance);
            }
            icc_tree_free(tree);
            icc_grid_free(grid);
        }
}
END_TEST

START_TEST(what_the_root_does_not_reach)
{
    const uint8_t inside[7] = {1, 1, 0, 1, 1, 1, 0};
    icc_grid *grid = grid_of(1, (size_t[]){7}, inside);
    icc_tree *tree = tree_of(grid, 0, 0, NULL);
    icc_grid_free(grid); /* the tree keeps it */
    const icc_tree_report report = report_on(tree);
    ck_assert_uint_eq(report.n_inside, 2);
    ck_assert_uint_eq(report.n_outside, 1);
    ck_assert_uint_eq(report.n_unreachable, 3);
    ck_assert_uint_eq(report.n_pairs, 1);
    ck_assert_int_eq(icc_tree_generations(tree)[2], 2);
    ck_assert_int_eq(icc_tree_generations(tree)[3], -1);
    icc_tree_free(tree);
}
END_TEST

/* ---------------------------------------------------------- failing, wrong */

static icc_status make_and_verify(const icc_env *env, icc_error *err, void *grid)
{
    icc_tree *tree = (icc_tree *)&tree;
    icc_status status = icc_tree_create(&tree, grid, 0, NULL, env, err);
    ck_assert((tree == NULL) == (status != ICC_OK));
    icc_tree_report report = {.size = sizeof report, .n_pairs = 77};
    if (status == ICC_OK) {
        status = icc_tree_get_report(tree, &report, env, err);
        ck_assert_uint_eq(report.n_pairs, status == ICC_OK ? 1 : 77);
    }
    icc_tree_free(tree);
    return status;
}

START_TEST(every_failure_is_reported)
{
    const uint8_t inside[5] = {1, 1, 0, 0, 0};
    icc_grid *grid = grid_of(1, (size_t[]){5}, inside);
    faulty_sweep(make_and_verify, grid);
    ck_assert_uint_eq(atomic_load(&grid->references), 1);
    icc_grid_free(grid);
}
END_TEST

START_TEST(threads_do_not_change_the_report)
{
    random_source r = {6};
    enum { SIDE = 300 };
    uint8_t *inside = malloc(SIDE * SIDE);
    for (size_t v = 0; v < SIDE * SIDE; ++v)
        inside[v] = random_below(&r, 10) < 8;
    inside[0] = 1;
    icc_grid *grid = grid_of(2, (size_t[]){SIDE, SIDE}, inside);
    icc_tree *tree = tree_of(grid, grid_random_inside(&r, grid), 0, NULL);
    const icc_tree_report one = report_on(tree);
    ck_assert_uint_gt(one.n_pairs, 10000);
    ck_assert_uint_gt(one.n_cousin_violations, 0);
    for (int32_t threads = 2; threads <= 8; ++threads) {
        const icc_env env = {.size = sizeof env, .threads = threads};
        icc_tree_report many = {.size = sizeof many};
        ck_assert_int_eq(icc_tree_get_report(tree, &many, &env, NULL), ICC_OK);
        ck_assert_mem_eq(&one, &many, sizeof one);
    }
    icc_tree_free(tree);
    icc_grid_free(grid);
    free(inside);
}
END_TEST

START_TEST(wrong_arguments)
{
    const uint8_t inside[4] = {1, 1, 1, 0};
    icc_grid *grid = grid_of(2, (size_t[]){2, 2}, inside);
    icc_tree *tree = (icc_tree *)&tree;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_tree_create(NULL, grid, 0, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_create(&tree, NULL, 0, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(tree);
    ck_assert_int_eq(icc_tree_create(&tree, grid, 4, NULL, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_create(&tree, grid, 3, NULL, NULL, &err), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(err.index, 3);
    static const int32_t orders[4][2] = {{0, 0}, {0, 2}, {-1, 0}, {1, 1}};
    icc_tree_options options = {.size = sizeof options};
    for (int i = 0; i < 4; ++i) {
        options.axis_order = orders[i];
        ck_assert_int_eq(icc_tree_create(&tree, grid, 0, &options, NULL, NULL), ICC_ERR_ARGUMENT);
    }
    options.axis_order = NULL;
    options.form = 3;
    ck_assert_int_eq(icc_tree_create(&tree, grid, 0, &options, NULL, NULL), ICC_ERR_ARGUMENT);
    options = (icc_tree_options){.size = 1};
    ck_assert_int_eq(icc_tree_create(&tree, grid, 0, &options, NULL, NULL), ICC_ERR_ARGUMENT);
    const icc_env env = {.size = sizeof env, .threads = -1};
    ck_assert_int_eq(icc_tree_create(&tree, grid, 0, NULL, &env, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_create(&tree, grid, 0, NULL, NULL, NULL), ICC_OK);
    icc_tree_report report = {.size = 0};
    ck_assert_int_eq(icc_tree_get_report(tree, &report, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_get_report(tree, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_get_report(NULL, &report, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(icc_tree_parents(NULL));
    ck_assert_ptr_null(icc_tree_generations(NULL));
    icc_tree_free(NULL);
    icc_tree_free(tree);
    icc_grid_free(grid);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("tree");
    TCase *tests = tcase_create("tree");
    tcase_add_test(tests, inside_the_tree_is_the_printed_one);
    tcase_add_test(tests, round_boxes_the_whole_tree_is_the_printed_one);
    tcase_add_test(tests, two_layers_outside);
    tcase_add_test(tests, a_gap_is_not_bridged);
    tcase_add_test(tests, polygons_have_no_holes_in_their_values);
    tcase_add_test(tests, the_verifier_counts_what_the_definition_says);
    tcase_add_test(tests, the_l_of_three_cubes);
    tcase_add_test(tests, boxes_obey_the_rule);
    tcase_add_test(tests, what_the_root_does_not_reach);
    tcase_add_test(tests, every_failure_is_reported);
    tcase_add_test(tests, threads_do_not_change_the_report);
    tcase_add_test(tests, wrong_arguments);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
