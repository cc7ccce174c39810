/* Finds orders with one critical vertex. Based on: Huynh and Gingold, section 5.2, for the aim; J.
 * H. C. Whitehead, Simplicial Spaces, Nuclei and m-Groups, 1939, for the method. Suppose that the
 * neighbours of a vertex in a set form a contractible part of its link. Then the vertex may be
 * added to the set, or removed from it, without changing the homotopy type.
 *
 * In dimensions above 2, the tree's order (Algorithm 2) has critical vertices. Here it only sets
 * the priority. A set grows from the root. Among the vertices that touch it, it takes the first one
 * in that order whose neighbours in the set are contractible. Its other neighbours are then
 * contractible, too (gradient/grid/kuhn.h). Any other vertex has to wait until the set has taken
 * another neighbour of it. When all vertices are taken, only the root is critical, whatever the
 * shape.
 *
 * If growth gets stuck, the set of all vertices is thinned in the same way. The last vertex whose
 * neighbours in the set are contractible is removed, except the root, and the order is read
 * backwards. There are shapes, even balls, for which both fail, such as Bing's house with two
 * rooms. */
#include "gradient/tree/grow.h"

#include "base/error.h"
#include "base/sort.h"
#include "gradient/grid/star.h"
#include "gradient/tree/queue.h"

#include <assert.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum {
    MEMBER = 1, /* will be taken: inside and reached by the tree; not the root */
    IN_SET = 2, /* belongs to the set at present */
    CUT = 4,    /* has neighbours beyond the grid */
    WAITED = 8  /* was refused at least once */
};

static const size_t TESTS_PER_REPORT = 1 << 12; /* tests of links: at most 0.1 s, in 6-D */

typedef struct growth {
    const icc_tree *tree;
    const iccp_env *env;
    const uint32_t *priority; /* the n vertices, including the root, in order of priority */
    uint32_t *sorted;         /* memory of `priority` if the tree does not own it */
    uint32_t *place;          /* by grid vertex: its index in `priority` */
    uint8_t *state;           /* by grid vertex: MEMBER | IN_SET | .. */
    uint32_t *rank;           /* by grid vertex: the result */
    /* Places of vertices to be tried, counted from the front or from the end */
    iccp_queue queue;
    iccp_star star;
    bool thinning;
    size_t n, n_taken, n_tests, n_waited;
} growth;

/* ---------------------------------------------------- growing and thinning */

static uint8_t in_set(const growth *g, uint32_t v, int i)
{
    return g->state[iccp_star_vertex(&g->star, v, i)] / IN_SET & 1;
}

static iccp_link_set neighbours_in_set(const growth *g, uint32_t v)
{
    iccp_link_set set = {{0, 0}};
    if (g->state[v] & CUT) {
        const iccp_link_set within = iccp_star_within(&g->star, v);
        for (int i = 0; i < g->star.kuhn.n_neighbours; ++i)
            if (iccp_link_has(&within, i) && in_set(g, v, i))
                iccp_link_add(&set, i);
        return set;
    }
    for (int i = 0; i < g->star.kuhn.n_neighbours; ++i)
        set.word[i / 64] |= (uint64_t)in_set(g, v, i) << (i % 64);
    return set;
}

/* Puts the neighbours that are not taken yet into the queue. */
static void queue_neighbours(growth *g, uint32_t v)
{
    const uint8_t wanted = g->thinning ? MEMBER | IN_SET : MEMBER;
    const iccp_link_set within =
        g->state[v] & CUT ? iccp_star_within(&g->star, v) : g->star.kuhn.all;
    for (int i = 0; i < g->star.kuhn.n_neighbours; ++i) {
        if (!iccp_link_has(&within, i))
            continue;
        const uint32_t u = iccp_star_vertex(&g->star, v, i);
        if ((g->state[u] & (MEMBER | IN_SET)) != wanted)
            continue;
        const uint32_t place = g->place[u];
        iccp_queue_push(&g->queue, g->thinning ? (uint32_t)g->n - 1 - place : place);
    }
}

/* Moves a vertex into the set, or out of it. */
static void take_vertex(growth *g, uint32_t v)
{
    g->state[v] ^= IN_SET;
    g->rank[v] = (uint32_t)(g->thinning ? g->n - g->n_taken : g->n_taken);
    ++g->n_taken;
    queue_neighbours(g, v);
}

/* Takes vertices until there are none left to try. A vertex is tried at most once for each of its
 * neighbours that is taken. */
static icc_status take_vertices(growth *g)
{
    for (;;) {
        const uint32_t key = iccp_queue_pop(&g->queue);
        if (key == UINT32_MAX)
            return ICC_OK;
        if (g->n_tests++ % TESTS_PER_REPORT == 0 &&
            iccp_progress(g->env, "tree", (double)g->n_taken / (double)g->n) != ICC_OK)
            return ICC_ERR_CANCELLED;
        const uint32_t v = g->priority[g->thinning ? (uint32_t)g->n - 1 - key : key];
        const iccp_link_set set = neighbours_in_set(g, v);
        if (iccp_kuhn_regular(&g->star.kuhn, &set)) {
            take_vertex(g, v);
        } else {
            g->n_waited += (g->state[v] & WAITED) == 0;
            g->state[v] |= WAITED;
        }
    }
}

/* The root counts as taken in both directions, and is never tried. */
static icc_status grow(growth *g)
{
    const uint32_t root = g->tree->root;
    g->thinning = false;
    g->n_taken = 1;
    for (size_t i = 0; i < g->n; ++i) {
        g->rank[g->priority[i]] = ICCP_NONE;
        g->state[g->priority[i]] &= (uint8_t)~IN_SET;
    }
    g->rank[root] = 0;
    g->state[root] |= IN_SET;
    queue_neighbours(g, root);
    return take_vertices(g);
}

static icc_status thin(growth *g)
{
    g->thinning = true;
    g->n_taken = 1;
    for (size_t i = 0; i < g->n; ++i) {
        g->state[g->priority[i]] |= IN_SET;
        if (g->priority[i] != g->tree->root)
            iccp_queue_push(&g->queue, (uint32_t)(g->n - 1 - i));
    }
    return take_vertices(g);
}

/* ------------------------------------------------------------------ set-up */

static bool is_higher(const void *context, uint32_t u, uint32_t v)
{
    const double *values = context;
    return values[u] > values[v];
}

static icc_status set_priority(growth *g, const double *values)
{
    g->priority = g->tree->order;
    if (values == NULL)
        return ICC_OK;
    uint32_t *work = iccp_alloc(&g->env->memory, g->n, sizeof *work);
    g->sorted = iccp_alloc(&g->env->memory, g->n, sizeof *g->sorted);
    if (work != NULL && g->sorted != NULL) {
        memcpy(g->sorted, g->tree->order, g->n * sizeof *g->sorted);
        iccp_sort_indices(g->sorted, work, g->n, values, is_higher);
    }
    const bool done = work != NULL && g->sorted != NULL;
    iccp_free(&g->env->memory, work);
    g->priority = g->sorted;
    return done ? ICC_OK : ICC_ERR_MEMORY;
}

/* Makes place[] the inverse of priority[], marks the vertices to be taken, and clears all ranks.
 * The root is no MEMBER, because it is in the set from the start. */
static icc_status begin_growth(growth *g, const double *values)
{
    const iccp_memory *memory = &g->env->memory;
    const size_t n_vertices = g->tree->grid->n_vertices;
    g->state = iccp_alloc_zero(memory, n_vertices, sizeof *g->state);
    g->place = iccp_alloc(memory, n_vertices, sizeof *g->place);
    iccp_queue_create(&g->queue, g->n, memory);
    if (g->state == NULL || g->place == NULL || g->queue.level[0] == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = set_priority(g, values);
    if (status != ICC_OK)
        return status;
    iccp_star_init(&g->star, g->tree->grid, g->n);
    for (size_t v = 0; v < n_vertices; ++v)
        g->rank[v] = ICCP_NONE;
    for (size_t i = 0; i < g->n; ++i) {
        const uint32_t v = g->priority[i];
        g->place[v] = (uint32_t)i;
        g->state[v] = iccp_star_is_cut(&g->star, v) ? MEMBER | CUT : MEMBER;
    }
    g->state[g->tree->root] &= (uint8_t)~MEMBER;
    return ICC_OK;
}

static void free_growth(growth *g)
{
    const iccp_memory *memory = &g->env->memory;
    iccp_queue_free(&g->queue, memory);
    iccp_free(memory, g->sorted);
    iccp_free(memory, g->place);
    iccp_free(memory, g->state);
}

/* ------------------------------------------------------------- the result */

/* Counts the edges whose direction in the order found differs from priority[]. */
static size_t count_reversed(const growth *g)
{
    size_t n_reversed = 0;
    for (size_t k = 0; k < g->n; ++k) {
        const uint32_t v = g->priority[k];
        const iccp_link_set within =
            g->state[v] & CUT ? iccp_star_within(&g->star, v) : g->star.kuhn.all;
        for (int i = 0; i < g->star.kuhn.n_neighbours; ++i) {
            const uint32_t u = iccp_star_vertex(&g->star, v, i);
            n_reversed += iccp_link_has(&within, i) && g->rank[u] < g->rank[v] && g->place[u] > k;
        }
    }
    return n_reversed;
}

static uint32_t first_without_rank(const growth *g)
{
    for (size_t i = 0; i < g->n; ++i)
        if (g->rank[g->priority[i]] == ICCP_NONE)
            return g->priority[i];
    return ICCP_NONE;
}

static icc_status fail_stuck(const growth *g, const icc_grow_report *report, icc_error *err)
{
    char at[96];
    int used = 0;
    for (int32_t k = 0; k < g->tree->grid->dim; ++k)
        used += snprintf(at + used, sizeof at - (size_t)used, "%s%" PRIu32, k == 0 ? "" : ", ",
                         iccp_grid_coordinate(g->tree->grid, report->vertex, k));
    return iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_GRID_VERTEX, report->vertex,
                        "no order with one critical vertex was found: growth stops before vertex "
                        "%" PRIu32 " (%s), %zu of %zu left, thinning leaves %zu; try a finer grid",
                        report->vertex, at, report->n_unplaced, g->n, report->n_remaining);
}

/* Grows and, if that gets stuck, thins. If both get stuck, grows once more, because the ranks of
 * growth are more useful. */
static icc_status find_order(growth *g, icc_grow_report *report, icc_error *err)
{
    icc_status status = grow(g);
    if (status != ICC_OK)
        return status;
    report->n_deferred = g->n_waited;
    report->n_unplaced = g->n - g->n_taken;
    report->vertex = first_without_rank(g);
    report->method = g->n_waited > 0 ? ICC_GROW_GROWN : ICC_GROW_AS_GIVEN;
    if (report->n_unplaced > 0) {
        status = thin(g);
        report->method = ICC_GROW_THINNED;
        report->n_remaining = g->n - g->n_taken;
    }
    if (status == ICC_OK && report->n_remaining > 0)
        status = grow(g);
    if (status != ICC_OK)
        return status;
    report->n_tests = g->n_tests;
    if (report->n_remaining > 0)
        return fail_stuck(g, report, err);
    if (report->method != ICC_GROW_AS_GIVEN)
        report->n_reversed = count_reversed(g);
    return ICC_OK;
}

icc_status iccp_tree_grow(const icc_tree *tree, const double *values, uint32_t *rank,
                          icc_grow_report *report, const iccp_env *env, icc_error *err)
{
    growth g = {.tree = tree, .env = env, .rank = rank, .n = tree->n_inside};
    *report = (icc_grow_report){.n_vertices = g.n, .vertex = ICCP_NONE};
    icc_status status = begin_growth(&g, values);
    if (status == ICC_OK)
        status = find_order(&g, report, err);
    free_growth(&g);
    return iccp_explain(err, status);
}

/* ---- trees that give up a few vertices ---- */

enum { MOST_ROUNDS = 8 }; /* two were enough for all surfaces tried */

/* Makes a copy of the grid in which only vertices with a rank are inside. */
static icc_status keep_ranked(icc_grid **out, const icc_grid *grid, const uint32_t *rank,
                              const iccp_env *env, icc_error *err)
{
    *out = NULL;
    uint8_t *keep = iccp_alloc(&env->memory, grid->n_vertices, sizeof *keep);
    if (keep == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < grid->n_vertices; ++v)
        keep[v] = rank[v] != ICCP_NONE;
    const icc_status status = iccp_grid_restrict(out, grid, keep, env, err);
    iccp_free(&env->memory, keep);
    return status;
}

icc_status iccp_tree_create_ranked(icc_tree **out, const icc_grid *grid, uint32_t root,
                                   int32_t form, const int32_t *axis_order, double most_lost,
                                   uint32_t *rank, icc_grow_report *report, const iccp_env *env,
                                   icc_error *err)
{
    const double n_whole = (double)grid->n_inside;
    icc_grid *part = iccp_grid_retain(grid);
    icc_status status = ICC_ERR_TOPOLOGY;
    *out = NULL;
    for (int round = 0; round < MOST_ROUNDS && status == ICC_ERR_TOPOLOGY; ++round) {
        icc_tree *tree;
        status = iccp_tree_create(&tree, part, root, form, axis_order, env, err);
        if (status != ICC_OK)
            break;
        status = iccp_tree_grow(tree, NULL, rank, report, env, err);
        if (status == ICC_OK) {
            *out = tree;
            break;
        }
        iccp_tree_release(tree);
        const double n_placed = (double)(report->n_vertices - report->n_unplaced);
        if (status != ICC_ERR_TOPOLOGY || n_whole - n_placed > most_lost * n_whole)
            break;
        icc_grid *smaller;
        const icc_status kept = keep_ranked(&smaller, part, rank, env, err);
        iccp_grid_release(part);
        part = smaller;
        status = kept == ICC_OK ? status : kept;
    }
    iccp_grid_release(part);
    return status;
}
