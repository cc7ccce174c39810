/* Plane sweep after M. I. Shamos and D. Hoey, Geometric intersection problems, 1976, section 4:
 * edges that the sweep line meets are kept in their order along it, and only neighbours are
 * compared. The first place where two edges meet is met by edges that were neighbours just before.
 *
 * Points are swept by x, then y, as if the plane were sheared a little; so no edge is vertical and
 * no two points are met at once. All comparisons are exact, and repeated points and spikes are
 * looked for first: so edges on the line have one order until they meet. */
#include "domain/sweep.h"

#include "domain/avl.h"
#include "domain/point_order.h"
#include "domain/segment.h"
#include "math/predicates.h"

typedef struct sweep {
    const iccp_polygon *polygon;
    iccp_avl line;     /* edges that the sweep line meets, from below to above */
    uint32_t *node_of; /* by edge */
    iccp_defect found;
} sweep;

static const double *point(const sweep *s, uint32_t k)
{
    return s->polygon->points + 2 * (size_t)k;
}

static void found(sweep *s, int32_t kind, uint32_t a, uint32_t b)
{
    s->found = a < b ? (iccp_defect){kind, a, b} : (iccp_defect){kind, b, a};
}

/* Edges that share a vertex meet nowhere else: there is no spike. */
static void compare(sweep *s, uint32_t below, uint32_t above)
{
    if (below == 0 || above == 0)
        return;
    const uint32_t e = s->line.nodes[below].item, f = s->line.nodes[above].item;
    if (e == iccp_polygon_before(s->polygon, f) || f == iccp_polygon_before(s->polygon, e))
        return;
    const int32_t kind =
        iccp_segments_meet(point(s, e), point(s, e + 1), point(s, f), point(s, f + 1));
    if (kind != 0)
        found(s, kind, e, f);
}

/* The highest edge below point v. An edge through v counts as above; it becomes a neighbour of v's
 * edges, and comparing them decides. */
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

static void start_two(sweep *s, uint32_t v, uint32_t in, uint32_t out)
{
    const uint32_t below = find_below(s, v);
    const bool out_is_lower = iccp_orient2d(point(s, v), point(s, v + 1), point(s, in)) > 0;
    const uint32_t lower = out_is_lower ? out : in, upper = out_is_lower ? in : out;
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

static void meet_point(sweep *s, uint32_t v)
{
    const uint32_t in = iccp_polygon_before(s->polygon, v), out = v;
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

/* Repeated points and spikes. */
static void check_points(sweep *s, const uint32_t *order)
{
    for (size_t i = 1; i < s->polygon->n; ++i)
        if (iccp_point_equal(point(s, order[i - 1]), point(s, order[i]))) {
            found(s, ICC_DEFECT_REPEATED, order[i - 1], order[i]);
            return;
        }
    for (uint32_t v = 0; v < s->polygon->n; ++v)
        if (iccp_point_folds(point(s, v), point(s, iccp_polygon_before(s->polygon, v)),
                             point(s, v + 1))) {
            found(s, ICC_DEFECT_SPIKE, v, v);
            return;
        }
}

static icc_status run(sweep *s, uint32_t *order, uint32_t *work, const iccp_env *env)
{
    const size_t n = s->polygon->n;
    for (uint32_t v = 0; v < n; ++v)
        order[v] = v;
    iccp_order_points(order, work, n, s->polygon->points);
    check_points(s, order);
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

icc_status iccp_sweep(iccp_defect *result, const iccp_polygon *polygon, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    sweep s = {.polygon = polygon};
    iccp_avl_create(&s.line, (uint32_t)polygon->n, memory);
    s.node_of = iccp_alloc(memory, polygon->n, sizeof *s.node_of);
    uint32_t *order = iccp_alloc(memory, polygon->n, sizeof *order);
    icc_status status = ICC_ERR_MEMORY;
    /* The sort is done with its work space before the sweep needs node_of. */
    if (s.line.nodes != NULL && s.node_of != NULL && order != NULL)
        status = run(&s, order, s.node_of, env);
    iccp_free(memory, order);
    iccp_free(memory, s.node_of);
    iccp_avl_free(&s.line, memory);
    *result = s.found;
    return status;
}
