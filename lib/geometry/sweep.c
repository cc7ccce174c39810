/* Plane sweep after M. I. Shamos and D. Hoey, Geometric intersection problems, 1976, section 4.
 * Edges that the sweep line meets are kept in order along the line, and only neighbours are
 * compared. The edges that meet first were neighbours just before.
 *
 * Points are visited by x, then y, as if the plane were sheared slightly. So no edge is vertical,
 * and no two points come at the same time. All comparisons are exact. Repeated points and spikes
 * are looked for first, so edges on the line have a unique order until they meet.
 *
 * The edge just below the first point of a chain tells which other chains contain it. */
#include "geometry/sweep.h"

#include "geometry/avl.h"
#include "geometry/point_order.h"
#include "geometry/segment.h"
#include "math/predicates.h"

static const uint32_t NONE = UINT32_MAX;

typedef struct sweep {
    const iccp_chains *chains;
    const double *points;
    uint32_t *before;  /* for each point: the edge that leads to it, or NONE */
    iccp_avl line;     /* edges that the sweep line meets, from below to above */
    uint32_t *node_of; /* by edge */
    iccp_chain_place *places;
    bool *met; /* by chain: a point of it was visited; NULL without places */
    iccp_defect found;
} sweep;

static const double *point(const sweep *s, uint32_t k)
{
    return s->points + 2 * (size_t)k;
}

/* Returns the edge that leaves a point. The point must not close a chain. */
static uint32_t edge_after(const sweep *s, uint32_t v)
{
    return s->before[v + 1] == v ? v : NONE;
}

static void found(sweep *s, int32_t kind, uint32_t a, uint32_t b)
{
    s->found = a < b ? (iccp_defect){kind, a, b} : (iccp_defect){kind, b, a};
}

/* Edges that share a vertex meet nowhere else, because there are no spikes. */
static void compare(sweep *s, uint32_t below, uint32_t above)
{
    if (below == 0 || above == 0)
        return;
    const uint32_t e = s->line.nodes[below].item, f = s->line.nodes[above].item;
    if (e == s->before[f] || f == s->before[e])
        return;
    const int32_t kind =
        iccp_segments_meet(point(s, e), point(s, e + 1), point(s, f), point(s, f + 1));
    if (kind != 0)
        found(s, kind, e, f);
}

/* Returns the highest edge below point v. An edge through v counts as above. It becomes a neighbour
 * of v's edges, and comparing them decides. */
static uint32_t find_below(const sweep *s, uint32_t v)
{
    const iccp_avl_node *const nodes = s->line.nodes;
    uint32_t below = 0;
    for (uint32_t node = s->line.root; node != 0;) {
        const uint32_t e = nodes[node].item;
        const double *a = point(s, e), *b = point(s, e + 1);
        const bool forward = iccp_point_less(a, b);
        const bool above = iccp_orient2d(forward ? a : b, forward ? b : a, point(s, v)) > 0;
        below = above ? node : below;
        node = above ? nodes[node].right : nodes[node].left;
    }
    return below;
}

/* Records where a chain lies, at its first point v. `below` is the next edge below, and `turn` the
 * orientation of a closed chain. The chain of `below` lies around v or beside it. If it lies
 * beside, v is inside whatever is around that chain. */
static void enter_chain(sweep *s, uint32_t v, uint32_t below, int32_t turn)
{
    if (s->places == NULL)
        return;
    const uint32_t chain = iccp_chain_of(s->chains, v);
    if (s->met[chain])
        return;
    s->met[chain] = true;
    s->places[chain] = (iccp_chain_place){s->chains->item[chain].closed ? turn : 0, ICCP_NO_CHAIN};
    if (below == 0)
        return;
    const uint32_t e = s->line.nodes[below].item, other = iccp_chain_of(s->chains, e);
    const int32_t to_the_left = iccp_point_less(point(s, e), point(s, e + 1)) ? 1 : -1;
    s->places[chain].around =
        s->places[other].orientation == to_the_left ? other : s->places[other].around;
}

static void start_two(sweep *s, uint32_t v, uint32_t in, uint32_t out)
{
    const uint32_t below = find_below(s, v);
    const bool out_is_lower = iccp_orient2d(point(s, v), point(s, v + 1), point(s, in)) > 0;
    const uint32_t lower = out_is_lower ? out : in, upper = out_is_lower ? in : out;
    enter_chain(s, v, below, out_is_lower ? 1 : -1);
    const uint32_t first = iccp_avl_insert(&s->line, below, lower);
    const uint32_t second = iccp_avl_insert(&s->line, first, upper);
    s->node_of[lower] = first;
    s->node_of[upper] = second;
    compare(s, below, first);
    compare(s, second, s->line.nodes[second].after);
}

static void end_two(sweep *s, uint32_t in, uint32_t out)
{
    iccp_avl_remove(&s->line, s->node_of[in]);
    const uint32_t below = s->line.nodes[s->node_of[out]].before;
    iccp_avl_remove(&s->line, s->node_of[out]);
    compare(s, below, s->line.nodes[below].after);
}

static void pass_on(sweep *s, uint32_t from, uint32_t to)
{
    const uint32_t node = s->node_of[from];
    s->node_of[to] = node;
    s->line.nodes[node].item = to;
    compare(s, s->line.nodes[node].before, node);
    compare(s, node, s->line.nodes[node].after);
}

static void start_one(sweep *s, uint32_t v, uint32_t edge)
{
    const uint32_t below = find_below(s, v);
    enter_chain(s, v, below, 0);
    const uint32_t node = iccp_avl_insert(&s->line, below, edge);
    s->node_of[edge] = node;
    compare(s, below, node);
    compare(s, node, s->line.nodes[node].after);
}

static void end_one(sweep *s, uint32_t edge)
{
    const uint32_t below = s->line.nodes[s->node_of[edge]].before;
    iccp_avl_remove(&s->line, s->node_of[edge]);
    compare(s, below, s->line.nodes[below].after);
}

/* Handles a chain of one point. If edges pass through it, one of them is the next above
 * find_below(). */
static void meet_lone_point(sweep *s, uint32_t v)
{
    const uint32_t below = find_below(s, v), above = s->line.nodes[below].after;
    enter_chain(s, v, below, 0);
    if (above == 0)
        return;
    const uint32_t e = s->line.nodes[above].item;
    if (iccp_segment_has(point(s, e), point(s, e + 1), point(s, v)))
        found(s, ICC_DEFECT_TOUCH, e, v);
}

static void meet_end(sweep *s, uint32_t v, uint32_t edge, uint32_t other_end)
{
    if (iccp_point_less(point(s, v), point(s, other_end)))
        start_one(s, v, edge);
    else
        end_one(s, edge);
}

static void meet_inner(sweep *s, uint32_t v, uint32_t in, uint32_t out)
{
    const bool in_starts = iccp_point_less(point(s, v), point(s, in));
    const bool out_starts = iccp_point_less(point(s, v), point(s, v + 1));
    if (in_starts && out_starts)
        start_two(s, v, in, out);
    else if (in_starts)
        pass_on(s, out, in);
    else if (out_starts)
        pass_on(s, in, out);
    else
        end_two(s, in, out);
}

static void meet_point(sweep *s, uint32_t v)
{
    const uint32_t in = s->before[v], out = edge_after(s, v);
    if (in != NONE && out != NONE)
        meet_inner(s, v, in, out);
    else if (out != NONE)
        meet_end(s, v, out, v + 1);
    else if (in != NONE)
        meet_end(s, v, in, in);
    else
        meet_lone_point(s, v);
}

/* Looks for repeated points and spikes. */
static void check_points(sweep *s, const uint32_t *order, size_t n)
{
    for (size_t i = 1; i < n; ++i)
        if (iccp_point_equal(point(s, order[i - 1]), point(s, order[i]))) {
            found(s, ICC_DEFECT_REPEATED, order[i - 1], order[i]);
            return;
        }
    for (size_t c = 0; c < s->chains->n; ++c) {
        const iccp_chain *chain = &s->chains->item[c];
        for (uint32_t v = chain->first; v < chain->first + chain->n; ++v)
            if (s->before[v] != NONE && edge_after(s, v) != NONE &&
                iccp_point_folds(point(s, v), point(s, s->before[v]), point(s, v + 1))) {
                found(s, ICC_DEFECT_SPIKE, v, v);
                return;
            }
    }
}

/* Fills in s->before, and lists all points except those that close a chain. Returns their
 * number. */
static size_t list_points(sweep *s, uint32_t *order)
{
    size_t n = 0;
    for (size_t c = 0; c < s->chains->n; ++c) {
        const iccp_chain *chain = &s->chains->item[c];
        const uint32_t end = chain->first + chain->n;
        for (uint32_t v = chain->first; v < end; ++v) {
            s->before[v] = v - 1;
            order[n++] = v;
        }
        s->before[chain->first] = chain->closed ? end - 1 : NONE;
        if (chain->closed)
            s->before[end] = end - 1;
    }
    s->before[s->chains->n_points] = NONE;
    return n;
}

static icc_status run(sweep *s, uint32_t *order, uint32_t *work, const iccp_env *env)
{
    const size_t n = list_points(s, order);
    iccp_order_points(order, work, n, s->points);
    check_points(s, order, n);
    for (size_t i = 0; i < n && s->found.kind == 0; ++i) {
        if (i % 4096 == 0) {
            const icc_status status = iccp_progress(env, "check", (double)i / (double)n);
            if (status != ICC_OK)
                return status;
        }
        meet_point(s, order[i]);
    }
    return ICC_OK;
}

icc_status iccp_sweep_chains(iccp_defect *result, iccp_chain_place *places,
                             const iccp_chains *chains, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = chains->n_points;
    sweep s = {.chains = chains, .points = chains->points, .places = places};
    iccp_avl_create(&s.line, (uint32_t)n, memory);
    s.before = iccp_alloc(memory, n + 1, sizeof *s.before);
    s.node_of = iccp_alloc(memory, n, sizeof *s.node_of);
    s.met = places != NULL ? iccp_alloc_zero(memory, chains->n, sizeof *s.met) : NULL;
    uint32_t *order = iccp_alloc(memory, n, sizeof *order);
    icc_status status = ICC_ERR_MEMORY;
    /* The sort is finished with its workspace before the sweep needs node_of. */
    if (s.line.nodes != NULL && s.before != NULL && s.node_of != NULL && order != NULL &&
        (places == NULL || s.met != NULL))
        status = run(&s, order, s.node_of, env);
    iccp_free(memory, order);
    iccp_free(memory, s.met);
    iccp_free(memory, s.node_of);
    iccp_free(memory, s.before);
    iccp_avl_free(&s.line, memory);
    *result = s.found;
    return status;
}

icc_status iccp_sweep(iccp_defect *result, const iccp_polygon *polygon, const iccp_env *env)
{
    const iccp_chain chain = {0, (uint32_t)polygon->n, true};
    const iccp_chains chains = {polygon->n + 1, polygon->points, 1, &chain};
    return iccp_sweep_chains(result, NULL, &chains, env);
}

uint32_t iccp_chain_of(const iccp_chains *chains, uint32_t point)
{
    size_t low = 0, high = chains->n;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (chains->item[middle].first <= point)
            low = middle;
        else
            high = middle;
    }
    return (uint32_t)low;
}
