/* Finds rings. A walk keeps its area on the left: at a node it continues with the next side
 * clockwise. A walk that comes back to a node is divided there, so that no ring passes through a
 * place twice. The walk of a hole belongs to the smallest ring of its region around it. */
#include "match/coverage/layer_rings.h"

#include "base/sort.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

void iccp_layer_rings_free(iccp_layer_rings *rings, const iccp_memory *memory)
{
    iccp_free(memory, rings->ring);
    iccp_free(memory, rings->course);
}

typedef struct walking {
    iccp_layer_rings *rings;
    iccp_layer_graph *graph;
    size_t n_courses; /* of all rings */
    uint32_t *walk;   /* of each course */
    uint32_t *stack;  /* courses of the walk that belong to no ring yet */
    size_t depth;
    uint32_t *on_stack; /* of each place: where a course on the stack begins there, from 1 on */
    double *net;        /* of each walk: its area */
} walking;

/* The course that continues a walk. */
static uint32_t next_course(const iccp_layer_graph *graph, uint32_t course)
{
    const iccp_border *const border = &graph->border[course / 2];
    if (border->is_island)
        return course;
    const uint32_t back = border->half[1 - course % 2];
    const uint32_t v = iccp_half_from(graph->layer, back), n = iccp_graph_degree(graph, v);
    const uint32_t *const leaving = graph->leaving + graph->first[v];
    uint32_t k = 0;
    while (leaving[k] != back)
        ++k;
    return graph->course[leaving[(k + n - 1) % n]];
}

static void measure(iccp_ring *ring, const iccp_layer_rings *rings)
{
    const iccp_layer_graph *const graph = rings->graph;
    const double *const place = graph->layer->place;
    const uint32_t *const course = rings->course + ring->first;
    const double *const o = place + 2 * (size_t)iccp_course_place(graph, course[0], 0);
    ring->box = iccp_box_of(o, o);
    for (size_t c = 0; c < ring->n; ++c)
        for (size_t k = 0; k < graph->border[course[c] / 2].n; ++k) {
            const double *const p = place + 2 * (size_t)iccp_course_place(graph, course[c], k);
            const double *const q = place + 2 * (size_t)iccp_course_place(graph, course[c], k + 1);
            ring->area += (p[0] - o[0]) * (q[1] - o[1]) - (q[0] - o[0]) * (p[1] - o[1]);
            ring->box = iccp_box_hull(ring->box, iccp_box_of(q, q));
        }
}

/* Makes a ring of the courses on the stack from `from` on. */
static void close_ring(walking *w, size_t from, uint32_t region, uint32_t walk)
{
    iccp_layer_rings *const rings = w->rings;
    iccp_ring *const ring = &rings->ring[rings->n++];
    *ring = (iccp_ring){
        .first = w->n_courses, .n = w->depth - from, .region = region, .walk = walk, .piece = walk};
    for (size_t k = from; k < w->depth; ++k) {
        rings->course[w->n_courses++] = w->stack[k];
        w->on_stack[iccp_course_place(w->graph, w->stack[k], 0)] = 0;
    }
    w->depth = from;
    measure(ring, rings);
    w->net[walk] += ring->area;
}

/* Follows the walk from one course on, and divides it into rings. */
static void follow(walking *w, uint32_t start)
{
    const iccp_layer_graph *const graph = w->graph;
    const uint32_t walk = (uint32_t)w->rings->n_walks++;
    const uint32_t region = graph->border[start / 2].region[start % 2];
    uint32_t course = start;
    w->net[walk] = 0;
    do {
        const uint32_t end = iccp_course_place(graph, course, graph->border[course / 2].n);
        w->walk[course] = walk;
        w->stack[w->depth++] = course;
        w->on_stack[iccp_course_place(graph, course, 0)] = (uint32_t)w->depth;
        if (w->on_stack[end] > 0)
            close_ring(w, w->on_stack[end] - 1, region, walk);
        course = next_course(graph, course);
    } while (course != start);
}

/* Returns +1 if p lies inside a ring, 0 on it, and -1 outside. */
static int find(const iccp_layer_rings *rings, const iccp_ring *ring, const double *p)
{
    const iccp_layer_graph *const graph = rings->graph;
    const double *const place = graph->layer->place;
    int inside = -1;
    for (size_t c = ring->first; c < ring->first + ring->n; ++c)
        for (size_t k = 0; k < graph->border[rings->course[c] / 2].n; ++k) {
            const double *a = place + 2 * (size_t)iccp_course_place(graph, rings->course[c], k);
            const double *b = place + 2 * (size_t)iccp_course_place(graph, rings->course[c], k + 1);
            if (a[0] == p[0] && a[1] == p[1])
                return 0;
            if ((a[1] <= p[1]) == (b[1] <= p[1]))
                continue;
            const bool is_up = a[1] <= p[1];
            const int side = iccp_orient2d(is_up ? a : b, is_up ? b : a, p);
            if (side == 0)
                return 0;
            inside = side > 0 ? -inside : inside;
        }
    return inside;
}

/* Returns true if the outer ring contains the walk of another ring of the same region. */
static bool contains(const iccp_layer_rings *rings, const iccp_ring *outer, const iccp_ring *ring)
{
    const iccp_layer_graph *const graph = rings->graph;
    if (!iccp_boxes_meet(&outer->box, &ring->box))
        return false;
    int where = 0;
    for (size_t c = ring->first; c < ring->first + ring->n && where == 0; ++c)
        for (size_t k = 0; k < graph->border[rings->course[c] / 2].n && where == 0; ++k)
            where = find(rings, outer,
                         graph->layer->place +
                             2 * (size_t)iccp_course_place(graph, rings->course[c], k));
    return where > 0;
}

/* Finds the piece of each walk around a hole, among the rings [begin, end) of one region. */
static void find_pieces(walking *w, size_t begin, size_t end)
{
    iccp_ring *const ring = w->rings->ring;
    for (size_t k = begin; k < end; ++k) {
        double least = HUGE_VAL;
        if (w->net[ring[k].walk] > 0)
            continue;
        for (size_t m = begin; m < end; ++m)
            if (ring[m].area > 0 && ring[m].area < least && w->net[ring[m].walk] > 0 &&
                contains(w->rings, &ring[m], &ring[k])) {
                least = ring[m].area;
                ring[k].piece = ring[m].walk;
            }
    }
}

static int by_region(const void *a, const void *b)
{
    const iccp_ring *const p = a, *const q = b;
    if (p->region != q->region)
        return p->region < q->region ? -1 : 1;
    return p->first < q->first ? -1 : p->first > q->first;
}

/* Sorts the rings, finds pieces, and tells the borders. */
static void finish(walking *w)
{
    iccp_layer_rings *const rings = w->rings;
    iccp_sort(rings->ring, rings->n, sizeof *rings->ring, by_region);
    for (size_t k = 0, end; k < rings->n; k = end) {
        for (end = k; end < rings->n && rings->ring[end].region == rings->ring[k].region;)
            ++end;
        find_pieces(w, k, end);
    }
    for (size_t b = 0; b < w->graph->n_borders; ++b)
        w->graph->border[b].piece[0] = w->graph->border[b].piece[1] = NONE;
    for (size_t r = 0; r < rings->n; ++r)
        for (size_t k = 0; k < rings->ring[r].n; ++k) {
            const uint32_t course = rings->course[rings->ring[r].first + k];
            w->graph->border[course / 2].piece[course % 2] = rings->ring[r].piece;
        }
}

icc_status iccp_layer_rings_create(iccp_layer_rings *rings, iccp_layer_graph *graph,
                                   const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n = 2 * graph->n_borders;
    walking w = {.rings = rings, .graph = graph};
    *rings = (iccp_layer_rings){.graph = graph};
    rings->ring = iccp_alloc(memory, n, sizeof *rings->ring);
    rings->course = iccp_alloc(memory, n, sizeof *rings->course);
    w.walk = iccp_alloc(memory, n, sizeof *w.walk);
    w.stack = iccp_alloc(memory, n, sizeof *w.stack);
    w.net = iccp_alloc(memory, n, sizeof *w.net);
    w.on_stack = iccp_alloc_zero(memory, graph->layer->n, sizeof *w.on_stack);
    const bool has_all = rings->ring != NULL && rings->course != NULL && w.walk != NULL &&
                         w.stack != NULL && w.net != NULL && w.on_stack != NULL;
    if (has_all) {
        memset(w.walk, 0xff, n * sizeof *w.walk);
        for (uint32_t c = 0; c < n; ++c)
            if (w.walk[c] == NONE && graph->border[c / 2].region[c % 2] != ICCP_NO_REGION)
                follow(&w, c);
        finish(&w);
    }
    iccp_free(memory, w.walk);
    iccp_free(memory, w.stack);
    iccp_free(memory, w.net);
    iccp_free(memory, w.on_stack);
    return has_all ? ICC_OK : ICC_ERR_MEMORY;
}
