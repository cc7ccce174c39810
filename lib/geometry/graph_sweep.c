/* Plane sweep after M. I. Shamos and D. Hoey, Geometric intersection problems, 1976, section 4, for
 * a graph. Sides that the sweep line meets are kept in order along the line, and only neighbours
 * are compared. The sides that meet first were neighbours just before.
 *
 * Nodes are visited by x, then y, as if the plane were sheared slightly. So no side is vertical.
 * At a node the sides from the left end, one above the other, and those to the right begin in the
 * order of their directions. All comparisons are exact.
 *
 * The number of rings around a place changes only across sides, by their gains. So it is carried
 * from below to above. */
#include "geometry/graph_sweep.h"

#include "base/sort.h"
#include "geometry/avl.h"
#include "geometry/segment.h"
#include "icc/icc.h"
#include "math/predicates.h"

typedef struct sweep {
    const iccp_graph *graph;
    iccp_avl line;     /* sides that the sweep line meets, from below to above */
    uint32_t *node_of; /* by side */
    int32_t *left;
    uint32_t *below;
    iccp_graph_defect found;
} sweep;

static const double *point(const iccp_graph *graph, uint32_t v)
{
    return graph->points + 2 * (size_t)v;
}

/* The point that half-side h leads to. */
static const double *target(const iccp_graph *graph, uint32_t h)
{
    return point(graph, graph->ends[h ^ 1]);
}

/* The point that half-side h leaves. */
static const double *origin(const iccp_graph *graph, uint32_t h)
{
    return point(graph, graph->ends[h]);
}

/* The half-side of a side that runs the way the sweep goes. */
static uint32_t forward_half(const iccp_graph *graph, uint32_t side)
{
    return 2 * side + !iccp_point_less(origin(graph, 2 * side), target(graph, 2 * side));
}

/* ---- directions ---- */

typedef struct around {
    const iccp_graph *graph;
    const double *centre;
} around;

static bool comes_first(const void *context, uint32_t g, uint32_t h)
{
    const around *a = context;
    const double *p = target(a->graph, g), *q = target(a->graph, h);
    const bool p_is_forward = iccp_point_less(a->centre, p);
    const bool q_is_forward = iccp_point_less(a->centre, q);
    if (p_is_forward != q_is_forward)
        return p_is_forward;
    return iccp_orient2d(a->centre, p, q) > 0;
}

static iccp_graph_defect defect_of(int32_t kind, uint32_t a, uint32_t b)
{
    return (iccp_graph_defect){kind, a < b ? a : b, a < b ? b : a, false};
}

bool iccp_graph_order_node(iccp_graph_defect *found, const iccp_graph *graph, uint32_t v,
                           uint32_t *leaving, uint32_t *work)
{
    const around a = {graph, point(graph, v)};
    const size_t n = graph->first[v + 1] - graph->first[v];
    iccp_sort_indices(leaving, work, n, &a, comes_first);
    for (size_t i = 1; i < n; ++i)
        if (!comes_first(&a, leaving[i - 1], leaving[i])) {
            *found = defect_of(ICC_DEFECT_TOUCH, leaving[i - 1] / 2, leaving[i] / 2);
            return false;
        }
    return true;
}

/* ---- the sweep ---- */

/* Returns true if sides with a common end have more in common: they end at the same node from the
 * same direction. At a common first node the order of directions has excluded that. */
static bool overlap(const iccp_graph *graph, uint32_t e, uint32_t f)
{
    const uint32_t g = forward_half(graph, e), h = forward_half(graph, f);
    return iccp_point_equal(target(graph, g), target(graph, h)) &&
           iccp_point_folds(target(graph, g), origin(graph, g), origin(graph, h));
}

static bool share_end(const iccp_graph *graph, uint32_t e, uint32_t f)
{
    for (uint32_t i = 0; i < 4; ++i)
        if (iccp_point_equal(origin(graph, 2 * e + i / 2), origin(graph, 2 * f + i % 2)))
            return true;
    return false;
}

static void compare(sweep *s, uint32_t below, uint32_t above)
{
    if (below == 0 || above == 0)
        return;
    const iccp_graph *graph = s->graph;
    const uint32_t e = s->line.nodes[below].item, f = s->line.nodes[above].item;
    const int32_t kind = iccp_segments_meet(origin(graph, 2 * e), target(graph, 2 * e),
                                            origin(graph, 2 * f), target(graph, 2 * f));
    if (kind != 0 && (!share_end(graph, e, f) || overlap(graph, e, f)))
        s->found = defect_of(kind, e, f);
}

/* Returns the highest side below node v. A side through v counts as above. It becomes a neighbour
 * of v's sides, and comparing them decides. */
static uint32_t find_below(const sweep *s, uint32_t v)
{
    const iccp_avl_node *const nodes = s->line.nodes;
    uint32_t below = 0;
    for (uint32_t node = s->line.root; node != 0;) {
        const uint32_t h = forward_half(s->graph, nodes[node].item);
        const bool above =
            iccp_orient2d(origin(s->graph, h), target(s->graph, h), point(s->graph, v)) > 0;
        below = above ? node : below;
        node = above ? nodes[node].right : nodes[node].left;
    }
    return below;
}

/* Removes the sides that end at a node. They are neighbours. Returns the side below them. */
static uint32_t end_sides(sweep *s, const uint32_t *leaving, size_t n)
{
    uint32_t below = 0;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t node = s->node_of[leaving[i] / 2];
        below = s->line.nodes[node].before;
        iccp_avl_remove(&s->line, node);
    }
    return below;
}

/* Returns the number of rings around the places just above a side of the line. */
static int32_t count_above(const sweep *s, uint32_t node)
{
    if (node == 0)
        return 0;
    const uint32_t side = s->line.nodes[node].item, h = forward_half(s->graph, side);
    return h % 2 == 0 ? s->left[side] : s->left[side] - s->graph->gain[side];
}

/* Inserts the sides that begin at a node above `below`, and compares neighbours. */
static void begin_sides(sweep *s, uint32_t below, const uint32_t *leaving, size_t n)
{
    int32_t count = count_above(s, below);
    uint32_t last = below;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t side = leaving[i] / 2;
        const int32_t gain = s->graph->gain[side];
        s->left[side] = leaving[i] % 2 == 0 ? count + gain : count;
        count += leaving[i] % 2 == 0 ? gain : -gain;
        last = iccp_avl_insert(&s->line, last, side);
        s->node_of[side] = last;
    }
    if (n > 0)
        compare(s, below, s->line.nodes[below].after);
    compare(s, last, s->line.nodes[last].after);
}

/* If sides pass through a lone node, one of them is the next above find_below(). */
static void meet_lone_node(sweep *s, uint32_t v, uint32_t below)
{
    const uint32_t above = s->line.nodes[below].after;
    if (above == 0)
        return;
    const uint32_t e = s->line.nodes[above].item;
    if (iccp_segment_has(origin(s->graph, 2 * e), target(s->graph, 2 * e), point(s->graph, v)))
        s->found = (iccp_graph_defect){ICC_DEFECT_TOUCH, e, v, true};
}

static void meet_node(sweep *s, uint32_t v)
{
    const iccp_graph *graph = s->graph;
    const uint32_t *leaving = graph->leaving + graph->first[v];
    const size_t n = graph->first[v + 1] - graph->first[v];
    size_t n_forward = 0;
    while (n_forward < n && iccp_point_less(point(graph, v), target(graph, leaving[n_forward])))
        ++n_forward;
    uint32_t below;
    if (n_forward < n) {
        below = end_sides(s, leaving + n_forward, n - n_forward);
    } else {
        below = find_below(s, v);
        s->below[v] = below == 0 ? ICCP_NO_HALF : forward_half(graph, s->line.nodes[below].item);
    }
    if (n == 0)
        meet_lone_node(s, v, below);
    else
        begin_sides(s, below, leaving, n_forward);
}

static icc_status run(sweep *s, const iccp_env *env)
{
    for (size_t i = 0; i < s->graph->n_nodes && s->found.kind == 0; ++i) {
        if (i % 4096 == 0) {
            const icc_status status =
                iccp_progress(env, "check", (double)i / (double)s->graph->n_nodes);
            if (status != ICC_OK)
                return status;
        }
        meet_node(s, s->graph->nodes[i]);
    }
    return ICC_OK;
}

icc_status iccp_graph_sweep(iccp_graph_defect *found, const iccp_graph *graph, int32_t *left,
                            uint32_t *below, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    sweep s = {.graph = graph, .left = left, .below = below};
    iccp_avl_create(&s.line, (uint32_t)graph->n_ends, memory);
    s.node_of = iccp_alloc(memory, graph->n_ends, sizeof *s.node_of);
    icc_status status = ICC_ERR_MEMORY;
    if (s.line.nodes != NULL && s.node_of != NULL)
        status = run(&s, env);
    iccp_free(memory, s.node_of);
    iccp_avl_free(&s.line, memory);
    *found = s.found;
    return status;
}
