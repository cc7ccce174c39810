/* Orders with one critical vertex: bowls, random balls and given wishes, where the tree's own order
 * fails; houses with two rooms, where growth must give up. Every order is counted by the verifier,
 * which knows nothing of how it was found. */
#include "base/error.h"
#include "gradient/grid/kuhn.h"
#include "gradient/tree/cousin.h"
#include "gradient/tree/grow.h"
#include "gradient/tree/queue.h"
#include "gradient/tree/ranks.h"

#include "../../../faulty.h"
#include "../../../grids.h"
#include "../../../random.h"
#include "../../../share.h"
#include "../../../suite.h"

#include <check.h>
#include <math.h>
#include <string.h>

enum { MAX_VERTICES = 1 << 17, MAX_CELLS = 1 << 12 };

/* ------------------------------------------------------------------ shapes */

/* Cells in a box, the first axis fastest. */
typedef struct cells {
    int32_t dim;
    size_t shape[ICC_MAX_DIM];
    uint8_t solid[MAX_CELLS];
} cells;

static size_t count(int32_t dim, const size_t *shape)
{
    size_t n = 1;
    for (int32_t k = 0; k < dim; ++k)
        n *= shape[k];
    return n;
}

/* The closed solid on a lattice with `cuts` vertices to a cell: all vertices of all cells. */
static icc_grid *closed_grid(const cells *c, size_t cuts)
{
    static uint8_t inside[MAX_VERTICES];
    size_t shape[ICC_MAX_DIM], stride[ICC_MAX_DIM], n = 1;
    for (int32_t k = 0; k < c->dim; ++k) {
        stride[k] = n;
        shape[k] = cuts * c->shape[k] + 1;
        n *= shape[k];
    }
    ck_assert_uint_le(n, MAX_VERTICES);
    memset(inside, 0, n);
    size_t corners[ICC_MAX_DIM];
    for (int32_t k = 0; k < c->dim; ++k)
        corners[k] = cuts + 1;
    for (size_t cell = 0; cell < count(c->dim, c->shape); ++cell) {
        size_t lowest = 0, rest = cell;
        for (int32_t k = 0; k < c->dim; rest /= c->shape[k++])
            lowest += cuts * (rest % c->shape[k]) * stride[k];
        for (size_t corner = 0; c->solid[cell] && corner < count(c->dim, corners); ++corner) {
            size_t at = lowest;
            rest = corner;
            for (int32_t k = 0; k < c->dim; rest /= cuts + 1, ++k)
                at += rest % (cuts + 1) * stride[k];
            inside[at] = 1;
        }
    }
    icc_grid *grid;
    ck_assert_int_eq(icc_grid_create_mask(&grid, c->dim, shape, inside, NULL, NULL), ICC_OK);
    return grid;
}

/* A box with a square well, all walls one cell thick. */
static cells open_box(size_t well, size_t depth)
{
    cells c = {.dim = 3, .shape = {well + 2, well + 2, depth + 1}};
    for (size_t i = 0; i < count(3, c.shape); ++i) {
        const size_t x = i % c.shape[0], y = i / c.shape[0] % c.shape[1];
        const size_t z = i / (c.shape[0] * c.shape[1]);
        c.solid[i] = x == 0 || y == 0 || z == 0 || x == well + 1 || y == well + 1;
    }
    return c;
}

/* Bing's house: the room above is entered from below through a shaft in the room below, and the
 * other way round; each shaft hangs on a wall. */
static cells house(void)
{
    cells c = {.dim = 3, .shape = {11, 11, 5}};
    for (int i = 0; i < 11 * 11 * 5; ++i) {
        const int x = i % 11, y = i / 11 % 11, z = i / 121;
        const int shaft = z < 2 ? 3 : 7; /* z == 2: both */
        const int dx = abs(x - shaft), dy = abs(y - 5);
        const int wing = z < 2 ? 1 : 9;
        const bool hole = (z <= 2 && x == 3 && y == 5) || (z >= 2 && x == 7 && y == 5);
        const bool shell = x % 10 == 0 || y % 10 == 0 || z % 2 == 0;
        c.solid[i] = !hole && (shell || (dx <= 1 && dy <= 1) || (x == wing && y == 5));
    }
    return c;
}

/* Some vertices of a ball are added to it: random ones whose neighbours in it are contractible. */
static icc_grid *random_ball(random_source *r, int32_t dim, size_t side, size_t rounds)
{
    static uint8_t inside[MAX_VERTICES];
    static iccp_kuhn kuhn;
    iccp_kuhn_init(&kuhn, dim);
    size_t sides[ICC_MAX_DIM];
    for (int32_t k = 0; k < dim; ++k)
        sides[k] = side;
    grid_grow_ball(r, &kuhn, sides, rounds, inside);
    return grid_of(dim, sides, inside);
}

static icc_tree *tree_of(const icc_grid *grid, uint32_t root)
{
    icc_tree *tree;
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
    return tree;
}

/* ------------------------------------------------------------------ checks */

/* The ranks are 0 (the root), 1, .. without a gap, and the root is the only critical vertex. */
static void check_ranks(const icc_tree *tree, const uint32_t *rank)
{
    static uint8_t seen[MAX_VERTICES];
    size_t n_wrong = rank[tree->root] != 0, n = 0;
    memset(seen, 0, tree->n_inside);
    for (size_t v = 0; v < tree->grid->n_vertices; ++v) {
        const bool ranked = tree->grid->inside[v] && tree->generation[v] >= 0;
        n_wrong += ranked != (rank[v] != UINT32_MAX);
        if (!ranked || rank[v] >= tree->n_inside)
            continue;
        n_wrong += seen[rank[v]];
        seen[rank[v]] = 1;
        ++n;
    }
    ck_assert_uint_eq(n_wrong, 0);
    ck_assert_uint_eq(n, tree->n_inside);
    icc_function_report found = {.size = sizeof found};
    ck_assert_int_eq(icc_tree_get_rank_report(tree, rank, &found, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(found.n_maxima, 1);
    ck_assert_uint_eq(found.n_minima + found.n_saddles, 0);
    ck_assert_uint_eq(found.critical, UINT32_MAX);
}

/* What was placed is regular by itself. Its vertices need not be joined along the axes: a tree on
 * them may reach fewer, but is asked for those that it reaches only. */
static void check_placed(const icc_tree *tree, const uint32_t *rank, size_t n_unplaced)
{
    static uint8_t keep[MAX_VERTICES];
    size_t n_placed = 0, n_wrong = 0;
    for (uint32_t v = 0; v < tree->grid->n_vertices; ++v) {
        keep[v] = rank[v] != UINT32_MAX;
        n_wrong += keep[v] && !tree->grid->inside[v];
        n_placed += keep[v];
    }
    ck_assert_uint_eq(n_wrong, 0);
    ck_assert_uint_eq(n_placed + n_unplaced, tree->n_inside);
    icc_grid *part;
    ck_assert_int_eq(icc_grid_restrict(&part, tree->grid, keep, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(part->n_inside, n_placed);
    ck_assert_uint_eq(part->n_stray, tree->grid->n_inside - n_placed);
    icc_tree *rest = tree_of(part, tree->root);
    if (rest->n_inside == n_placed)
        check_ranks(rest, rank);
    icc_tree_free(rest);
    icc_grid_free(part);
}

static size_t most_tests(const icc_tree *tree)
{
    return tree->n_inside << (tree->grid->dim + 3);
}

/* Grows; an order that is found is checked. */
static icc_grow_report grow(const icc_tree *tree, const double *values, uint32_t *rank)
{
    icc_grow_report report = {.size = sizeof report};
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_tree_grow(tree, values, rank, &report, NULL, &err);
    ck_assert_uint_le(report.n_tests, most_tests(tree));
    ck_assert_uint_eq(report.n_vertices, tree->n_inside);
    ck_assert(status == ICC_OK || status == ICC_ERR_TOPOLOGY);
    ck_assert((status == ICC_OK) == (report.n_remaining == 0));
    ck_assert((report.n_unplaced > 0) == (report.method == ICC_GROW_THINNED));
    ck_assert((report.n_unplaced > 0) == (report.vertex != UINT32_MAX));
    if (status == ICC_OK) {
        check_ranks(tree, rank);
    } else {
        check_placed(tree, rank, report.n_unplaced);
        ck_assert_int_eq(err.index, report.vertex);
        ck_assert_ptr_nonnull(strstr(err.message, "finer grid"));
    }
    return report;
}

static uint32_t rank[MAX_VERTICES];

static bool is_regular(const icc_tree *tree)
{
    icc_function_report found = {.size = sizeof found};
    ck_assert_int_eq(icc_tree_get_rank_report(tree, rank, &found, NULL, NULL), ICC_OK);
    return found.critical == UINT32_MAX && found.n_maxima == 1;
}

/* ------------------------------------------------------------------- tests */

START_TEST(the_queue_gives_out_the_smallest)
{
    random_source r = {1};
    static const size_t sizes[6] = {1, 63, 64, 65, 4096, 5000};
    for (int i = 0; i < 6; ++i) {
        static uint8_t in[5000];
        iccp_queue queue;
        iccp_queue_create(&queue, sizes[i], &iccp_memory_default);
        memset(in, 0, sizeof in);
        for (int round = 0; round < share_of(20000); ++round) {
            if (random_below(&r, 2) == 0) {
                const uint32_t number = (uint32_t)random_below(&r, (int)sizes[i]);
                iccp_queue_push(&queue, number);
                in[number] = 1;
                continue;
            }
            uint32_t least = 0;
            while (least < sizes[i] && !in[least])
                ++least;
            const uint32_t found = iccp_queue_pop(&queue);
            ck_assert_uint_eq(found, least < sizes[i] ? least : UINT32_MAX);
            if (least < sizes[i])
                in[least] = 0;
        }
        iccp_queue_free(&queue, &iccp_memory_default);
    }
}
END_TEST

/* A well of one cell by one, two deep, each cell cut in two. The generations alone leave half of
 * the roots with a critical vertex besides; how many depends on how ties are broken. */
START_TEST(every_root_in_an_open_box)
{
    const cells box = open_box(1, 2);
    icc_grid *grid = closed_grid(&box, 2);
    ck_assert_uint_eq(grid->n_inside, 339);
    size_t n_irregular = 0;
    for (uint32_t root = 0; root < grid->n_vertices; ++root) {
        if (!grid->inside[root])
            continue;
        icc_tree *tree = tree_of(grid, root);
        for (uint32_t v = 0; v < grid->n_vertices; ++v) /* lower indices first */
            rank[v] = (uint32_t)tree->generation[v] * (uint32_t)grid->n_vertices + v;
        n_irregular += !is_regular(tree);
        for (uint32_t i = 0; i < tree->n_inside; ++i)
            rank[tree->order[i]] = i;
        const bool regular = is_regular(tree);
        const icc_grow_report report = grow(tree, NULL, rank);
        ck_assert_uint_eq(report.n_unplaced, 0);
        ck_assert((report.method == ICC_GROW_AS_GIVEN) == regular);
        ck_assert((report.n_deferred == 0) == regular);
        icc_tree_free(tree);
    }
    ck_assert_uint_eq(n_irregular, 171);
    icc_grid_free(grid);
}
END_TEST

/* The smallest solid against Theorem 2: its tree is no cousin tree, though its order will do. */
START_TEST(three_cubes_in_an_l)
{
    const cells l = {.dim = 3, .shape = {2, 1, 2}, .solid = {1, 1, 1, 0}};
    icc_grid *grid = closed_grid(&l, 1);
    ck_assert_uint_eq(grid->n_inside, 16);
    icc_tree *tree = tree_of(grid, 2);
    icc_tree_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_tree_get_report(tree, &report, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(report.n_cousin_violations, 1);
    ck_assert_int_eq(grow(tree, NULL, rank).method, ICC_GROW_AS_GIVEN);
    icc_tree_free(tree);
    icc_grid_free(grid);
}
END_TEST

START_TEST(a_house_with_thin_walls)
{
    const cells h = house();
    icc_grid *grid;
    ck_assert_int_eq(icc_grid_create_mask(&grid, 3, h.shape, h.solid, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(grid->n_inside, 457);
    for (uint32_t root = 0; root < grid->n_vertices; root += 7)
        if (grid->inside[root]) {
            icc_tree *tree = tree_of(grid, root);
            const icc_grow_report report = grow(tree, NULL, rank);
            ck_assert_uint_gt(report.n_remaining, 0);
            icc_tree_free(tree);
        }
    icc_grid *fine;
    ck_assert_int_eq(icc_grid_refine(&fine, grid, NULL, NULL), ICC_OK);
    icc_tree *tree = tree_of(fine, 0);
    ck_assert_uint_gt(grow(tree, NULL, rank).n_remaining, 0);
    icc_tree_free(tree);
    icc_grid_free(fine);
    icc_grid_free(grid);
}
END_TEST

/* Thick walls make the house a ball. Growth gets stuck in it all the same; thinning need not. */
START_TEST(a_house_with_thick_walls)
{
    const cells h = house();
    random_source r = {2};
    size_t n_stuck = 0, n_thinned = 0;
    for (size_t cuts = 1; cuts <= 3; ++cuts) {
        icc_grid *grid = closed_grid(&h, cuts);
        for (int i = 0; i < 12; ++i) {
            icc_tree *tree = tree_of(grid, grid_random_inside(&r, grid));
            const icc_grow_report report = grow(tree, NULL, rank);
            n_stuck += report.n_unplaced > 0;
            n_thinned += report.n_unplaced > 0 && report.n_remaining == 0;
            icc_tree_free(tree);
        }
        icc_grid_free(grid);
    }
    ck_assert_uint_gt(n_stuck, 0);
    ck_assert_uint_gt(n_thinned, 0);
}
END_TEST

START_TEST(random_balls)
{
    static const struct {
        int32_t dim;
        size_t side, rounds;
        int n_shapes;
    } kinds[4] = {{2, 40, 20000, 50}, {3, 12, 20000, 40}, {4, 6, 5000, 10}, {5, 4, 2000, 4}};
    random_source r = {3};
    for (int k = 0; k < 4; ++k) {
        size_t n_irregular = 0;
        for (int i = 0; i < kinds[k].n_shapes; ++i) {
            icc_grid *grid = random_ball(&r, kinds[k].dim, kinds[k].side, kinds[k].rounds);
            icc_tree *tree = tree_of(grid, grid_random_inside(&r, grid));
            ck_assert_uint_eq(tree->n_inside, grid->n_inside);
            const icc_grow_report report = grow(tree, NULL, rank);
            ck_assert_uint_eq(report.n_remaining, 0);
            n_irregular += report.method != ICC_GROW_AS_GIVEN;
            icc_tree_free(tree);
            icc_grid_free(grid);
        }
        if (kinds[k].dim == 2)
            ck_assert_uint_eq(n_irregular, 0);
        if (kinds[k].dim == 3)
            ck_assert_uint_gt(n_irregular, 0);
    }
}
END_TEST

/* The order wished for is kept where it is regular, and hardly changed elsewhere. */
START_TEST(given_values)
{
    random_source r = {4};
    static double values[MAX_VERTICES];
    size_t n_turned = 0, n_vertices = 0;
    for (int round = 0; round < 40; ++round) {
        icc_grid *grid = random_ball(&r, 3, 10, 10000);
        const uint32_t root = grid_random_inside(&r, grid);
        icc_tree *tree = tree_of(grid, root);
        for (uint32_t v = 0; v < grid->n_vertices; ++v) {
            double square = 0;
            for (int32_t k = 0; k < 3; ++k)
                square += pow((double)iccp_grid_coordinate(grid, v, k) -
                                  (double)iccp_grid_coordinate(grid, root, k),
                              2);
            values[v] = grid->inside[v] ? -square : NAN;
        }
        const icc_grow_report report = grow(tree, values, rank);
        ck_assert_uint_eq(report.n_remaining, 0);
        n_turned += report.n_reversed;
        n_vertices += report.n_vertices;
        if (report.method == ICC_GROW_AS_GIVEN)
            for (size_t i = 0; i < tree->n_inside; ++i)
                for (size_t j = 0; j < tree->n_inside; j += 7)
                    ck_assert(rank[tree->order[i]] > rank[tree->order[j]] ||
                              values[tree->order[i]] >= values[tree->order[j]]);
        for (size_t i = 0; i < tree->n_inside; ++i)
            values[tree->order[i]] = random_unit(&r);
        (void)grow(tree, values, rank);
        values[tree->order[tree->n_inside - 1]] = NAN;
        ck_assert_int_eq(icc_tree_grow(tree, values, rank, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
        icc_tree_free(tree);
        icc_grid_free(grid);
    }
    ck_assert_uint_lt(n_turned, n_vertices / 2);
}
END_TEST

/* How far a function lies from falling by `gap` along the edges, at most: 0 if it does. */
static double worst_edge(const icc_tree *tree, double gap, const double *values, size_t *n_tight,
                         uint32_t v)
{
    static iccp_kuhn kuhn;
    const icc_grid *grid = tree->grid;
    double worst = 0;
    iccp_kuhn_init(&kuhn, grid->dim);
    for (int i = 0; i < kuhn.n_neighbours; ++i) {
        int64_t u = v;
        bool in_grid = true;
        for (int32_t k = 0; k < grid->dim; ++k) {
            const int64_t at = (int64_t)iccp_grid_coordinate(grid, v, k) + kuhn.step[i][k];
            in_grid = in_grid && at >= 0 && at < (int64_t)grid->shape[k];
            u += kuhn.step[i][k] * (int64_t)grid->stride[k];
        }
        if (!in_grid || rank[u] >= rank[v])
            continue;
        worst = fmax(worst, values[v] - (values[u] - gap));
        *n_tight += values[v] >= values[u] - gap;
    }
    return worst;
}

START_TEST(values_fall_with_the_ranks)
{
    static double before[MAX_VERTICES], after[MAX_VERTICES];
    random_source r = {5};
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (int round = 0; round < 20; ++round) {
        icc_grid *grid = random_ball(&r, 2 + round % 3, 8, 4000);
        icc_tree *tree = tree_of(grid, grid_random_inside(&r, grid));
        ck_assert_uint_eq(grow(tree, NULL, rank).n_remaining, 0);
        const double gap = round % 2 == 0 ? 1e-3 : 0.25;
        for (uint32_t v = 0; v < grid->n_vertices; ++v)
            before[v] = after[v] = grid->inside[v] ? -(double)tree->generation[v] : (double)NAN;
        ck_assert_int_eq(iccp_tree_lower(tree, rank, gap, after, &env), ICC_OK);
        double worst = 0;
        size_t n_loose = 0, n_raised = 0;
        for (size_t i = 0; i < tree->n_inside; ++i) {
            const uint32_t v = tree->order[i];
            size_t n_tight = 0;
            worst = fmax(worst, worst_edge(tree, gap, after, &n_tight, v));
            n_raised += after[v] > before[v];
            n_loose += after[v] < before[v] && n_tight == 0;
        }
        ck_assert(worst <= 0);
        ck_assert_uint_eq(n_raised + n_loose, 0);
        icc_tree_free(tree);
        icc_grid_free(grid);
    }
}
END_TEST

/* A refined grid is the same complex: as many vertices and edges as there are, cut in two. */
START_TEST(refined_grids)
{
    random_source r = {6};
    for (int round = 0; round < 12; ++round) {
        icc_grid *grid = random_ball(&r, 1 + round % 4, 6, 1500), *fine;
        ck_assert_int_eq(icc_grid_refine(&fine, grid, NULL, NULL), ICC_OK);
        static iccp_kuhn kuhn;
        iccp_kuhn_init(&kuhn, grid->dim);
        size_t n_edges = 0;
        for (uint32_t v = 0; v < grid->n_vertices; ++v)
            for (int i = 0; i < kuhn.n_neighbours; i += 2) { /* upwards */
                uint32_t u = v;
                for (int32_t k = 0; k < grid->dim && u != ICCP_NONE; ++k)
                    if (kuhn.step[i][k] != 0)
                        u = iccp_grid_neighbour(grid, u, k, kuhn.step[i][k]);
                n_edges += u != ICCP_NONE && grid->inside[v] && grid->inside[u];
            }
        ck_assert_uint_eq(fine->n_inside, grid->n_inside + n_edges);
        ck_assert(2 * fine->spacing == grid->spacing);
        icc_tree *tree = tree_of(fine, grid_random_inside(&r, fine));
        ck_assert_uint_eq(grow(tree, NULL, rank).n_remaining, 0);
        icc_tree_free(tree);
        icc_grid_free(fine);
        icc_grid_free(grid);
    }
    icc_grid *grid = NULL, *fine = (icc_grid *)&grid;
    ck_assert_int_eq(icc_grid_refine(&fine, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(fine);
}
END_TEST

/* A tunnel through a cube, and a hollow one: no order has one critical vertex. */
START_TEST(shapes_that_are_no_balls)
{
    for (int hollow = 0; hollow < 2; ++hollow) {
        cells c = {.dim = 3, .shape = {3, 3, 3}};
        memset(c.solid, 1, sizeof c.solid);
        for (int z = hollow; z < 3 - hollow; ++z)
            c.solid[4 + 9 * z] = 0;
        icc_grid *grid = closed_grid(&c, 2);
        icc_tree *tree = tree_of(grid, 0);
        const icc_grow_report report = grow(tree, NULL, rank);
        ck_assert_uint_gt(report.n_remaining, 0);
        icc_tree_free(tree);
        icc_grid_free(grid);
    }
}
END_TEST

/* A ring one vertex thick on a cube: it is opened where growth meets itself, and what is lost is
 * counted; if nothing may be lost there is no tree. */
START_TEST(rings_are_opened)
{
    enum { SIDE = 13 };
    static uint8_t inside[SIDE * SIDE * SIDE];
    for (int v = 0; v < SIDE * SIDE * SIDE; ++v) {
        const int x = v % SIDE, y = v / SIDE % SIDE, z = v / (SIDE * SIDE);
        const bool handle = y == 6 && (z == 11 ? x >= 3 && x <= 9 : z > 8 && z < 11 && x % 6 == 3);
        inside[v] = handle || (x > 0 && x < 12 && y > 0 && y < 12 && z > 0 && z < 9);
    }
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    icc_grid *grid;
    ck_assert_int_eq(
        icc_grid_create_mask(&grid, 3, (size_t[]){SIDE, SIDE, SIDE}, inside, NULL, NULL), ICC_OK);
    const uint32_t root = 6 + SIDE * (6 + SIDE * 4);
    icc_grow_report report;
    icc_error err = {.size = sizeof err};
    for (int lenient = 0; lenient < 2; ++lenient) {
        icc_tree *tree;
        const icc_status status =
            iccp_tree_create_ranked(&tree, grid, root, ICC_TREE_THESIS, NULL, lenient ? 0.01 : 0.0,
                                    rank, &report, &env, &err);
        ck_assert_int_eq(status, lenient ? ICC_OK : ICC_ERR_TOPOLOGY);
        ck_assert((tree != NULL) == lenient);
        if (lenient) {
            check_ranks(tree, rank);
            ck_assert_uint_ge(tree->grid->n_stray, 1);
            ck_assert_uint_le(tree->grid->n_stray, 3);
            ck_assert_uint_eq(tree->grid->n_stray + tree->grid->n_inside, grid->n_inside);
        }
        icc_tree_free(tree);
    }
    icc_grid_free(grid);
}
END_TEST

/* Wrong orders are noticed: two neighbours of different height change places. */
START_TEST(the_verifier_sees_spoilt_orders)
{
    random_source r = {7};
    size_t n_seen = 0;
    for (int round = 0; round < 40; ++round) {
        icc_grid *grid = random_ball(&r, 3, 8, 4000);
        icc_tree *tree = tree_of(grid, grid_random_inside(&r, grid));
        ck_assert_uint_eq(grow(tree, NULL, rank).n_remaining, 0);
        const uint32_t last = tree->order[tree->n_inside - 1];
        rank[last] = 0;
        rank[tree->root] = (uint32_t)tree->n_inside;
        icc_function_report found = {.size = sizeof found};
        ck_assert_int_eq(icc_tree_get_rank_report(tree, rank, &found, NULL, NULL), ICC_OK);
        n_seen += found.critical != UINT32_MAX;
        icc_tree_free(tree);
        icc_grid_free(grid);
    }
    ck_assert_uint_eq(n_seen, 40);
}
END_TEST

typedef struct job {
    const icc_tree *tree;
    const double *values;
} job;

/* Stuck is as good an end as any other here. */
static icc_status grow_and_lower(const icc_env *env, icc_error *err, void *argument)
{
    const job *j = argument;
    icc_function_report report = {.size = sizeof report};
    icc_status status = icc_tree_grow(j->tree, j->values, rank, NULL, env, err);
    if (status == ICC_OK)
        status = icc_tree_get_rank_report(j->tree, rank, &report, env, err);
    icc_grid *fine = NULL;
    if (status == ICC_OK)
        status = icc_grid_refine(&fine, j->tree->grid, env, err);
    icc_grid_free(fine);
    iccp_env full;
    icc_grow_report grown;
    icc_tree *ranked = NULL;
    if (status == ICC_OK || status == ICC_ERR_TOPOLOGY)
        status = iccp_env_read(&full, env, err);
    if (status == ICC_OK)
        status = iccp_tree_create_ranked(&ranked, j->tree->grid, j->tree->root, ICC_TREE_PAPER,
                                         NULL, 0.9, rank, &grown, &full, err);
    icc_tree_free(ranked);
    return iccp_explain(err, status == ICC_ERR_TOPOLOGY ? ICC_OK : status);
}

START_TEST(every_failure_is_reported)
{
    static double values[MAX_VERTICES];
    const cells h = house(), box = open_box(2, 2);
    for (int i = 0; i < 2; ++i) {
        icc_grid *grid;
        if (i == 0) /* walls of one vertex */
            ck_assert_int_eq(icc_grid_create_mask(&grid, 3, h.shape, h.solid, NULL, NULL), ICC_OK);
        else
            grid = closed_grid(&box, 1);
        job j = {tree_of(grid, 0), i == 0 ? NULL : values};
        faulty_sweep(grow_and_lower, &j);
        icc_tree_free((icc_tree *)j.tree);
        icc_grid_free(grid);
    }
}
END_TEST

START_TEST(wrong_arguments)
{
    const uint8_t inside[3] = {1, 1, 1};
    icc_grid *grid;
    ck_assert_int_eq(icc_grid_create_mask(&grid, 1, (size_t[]){3}, inside, NULL, NULL), ICC_OK);
    icc_tree *tree = tree_of(grid, 1);
    icc_grow_report report = {.size = 0};
    icc_function_report found = {.size = sizeof found};
    ck_assert_int_eq(icc_tree_grow(NULL, NULL, rank, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_grow(tree, NULL, NULL, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_grow(tree, NULL, rank, &report, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_grow(tree, NULL, rank, NULL, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(rank[1], 0);
    ck_assert_int_eq(icc_tree_get_rank_report(NULL, rank, &found, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_get_rank_report(tree, NULL, &found, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_tree_get_rank_report(tree, rank, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    icc_tree_free(tree);
    icc_grid_free(grid);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("grow");
    TCase *tests = tcase_create("grow");
    tcase_add_test(tests, the_queue_gives_out_the_smallest);
    tcase_add_test(tests, every_root_in_an_open_box);
    tcase_add_test(tests, three_cubes_in_an_l);
    tcase_add_test(tests, a_house_with_thin_walls);
    tcase_add_test(tests, a_house_with_thick_walls);
    tcase_add_test(tests, random_balls);
    tcase_add_test(tests, given_values);
    tcase_add_test(tests, values_fall_with_the_ranks);
    tcase_add_test(tests, refined_grids);
    tcase_add_test(tests, shapes_that_are_no_balls);
    tcase_add_test(tests, rings_are_opened);
    tcase_add_test(tests, the_verifier_sees_spoilt_orders);
    tcase_add_test(tests, every_failure_is_reported);
    tcase_add_test(tests, wrong_arguments);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
