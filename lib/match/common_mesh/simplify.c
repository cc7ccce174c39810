/* Makes two surfaces with common triangles coarse. Based on: J. Cohen, D. Manocha, M. Olano,
 * Simplifying Polygonal Models Using Successive Mappings, 1997; for the planes of a vertex, R.
 * Ronfard, J. Rossignac, Full-range Approximation of Triangulated Polyhedra, 1996. A vertex that
 * replaces another must be close to all planes that the other stood for, and stands for them from
 * then on. Here both surfaces must agree to each change. */
#include "match/common_mesh/simplify.h"

#include "base/heap.h"
#include "base/minmax.h"
#include "match/surface/corner_angle.h"

#include <string.h>

/* A collapse may leave triangles whose least angle has the sine iccp_fair_sine, or the share
 * `not_much_worse` of the least one before. */
static const double not_much_worse = 0.7;

/* Vertices at triangles with a smaller sine go first. */
static const double thin_sine = 0.05;

typedef struct plane {
    double normal[3], at; /* normal . p = at */
} plane;

/* The planes that a vertex stands for, as a linked list. */
typedef struct link {
    uint32_t plane, next; /* the next link, or ICCP_NO_EDGE */
} link;

typedef struct simplification {
    iccp_half_edges m;
    const iccp_common_surface *c;
    const iccp_simplify_limits *limits;
    plane *plane[2];     /* by given face */
    uint32_t *first[2];  /* by vertex: its first link; or ICCP_NO_EDGE */
    link *links[2];      /* one for each corner, which is more than needed */
    uint32_t *marked[2]; /* by given face: the last vertex that visited it */
    uint32_t mark;
    iccp_heap heap; /* vertices by the cost of their cheapest collapse, as computed last */
    uint32_t *best; /* by vertex: that collapse; or ICCP_NO_EDGE */
    uint32_t n_collapsed;
    uint32_t *known;   /* by vertex: n_collapsed when `best` was computed */
    uint32_t *changed; /* by vertex: n_collapsed after a triangle at it last changed */
} simplification;

static const double *at(const simplification *s, int side, uint32_t vertex)
{
    return s->c->x[side] + 3 * (size_t)vertex;
}

/* ---- planes ---- */

static void find_planes(const simplification *s, int side, const iccp_half_edges *given,
                        const double *x)
{
    for (size_t f = 0; f < given->n_faces; ++f) {
        const uint32_t *const v = given->origin + 3 * f;
        plane *const p = &s->plane[side][f];
        iccp_triangle_normal(p->normal, x + 3 * (size_t)v[0], x + 3 * (size_t)v[1],
                             x + 3 * (size_t)v[2]);
        const double length = iccp_vec_norm(3, p->normal);
        for (int k = 0; k < 3; ++k)
            p->normal[k] /= length > 0 ? length : 1;
        p->at = iccp_vec_dot(3, p->normal, x + 3 * (size_t)v[0]);
    }
}

/* Links each vertex to the planes of the triangles around it, each plane once. */
static void link_planes(simplification *s, int side)
{
    const iccp_half_edges *const m = &s->m;
    uint32_t n = 0;
    for (uint32_t v = 0; v < m->n_vertices; ++v) {
        uint32_t h = m->out[v];
        s->first[side][v] = ICCP_NO_EDGE;
        ++s->mark;
        for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h)) {
            const uint32_t id = s->c->within[side][h / 3];
            if (s->marked[side][id] == s->mark)
                continue;
            s->marked[side][id] = s->mark;
            s->links[side][n] = (link){id, s->first[side][v]};
            s->first[side][v] = n++;
        }
    }
}

/* `v` now stands for the planes that `u` stood for. */
static void hand_over(simplification *s, int side, uint32_t u, uint32_t v)
{
    link *const links = s->links[side];
    ++s->mark;
    for (uint32_t i = s->first[side][v]; i != ICCP_NO_EDGE; i = links[i].next)
        s->marked[side][links[i].plane] = s->mark;
    for (uint32_t i = s->first[side][u], next; i != ICCP_NO_EDGE; i = next) {
        next = links[i].next;
        if (s->marked[side][links[i].plane] == s->mark)
            continue;
        links[i].next = s->first[side][v];
        s->first[side][v] = i;
    }
    s->first[side][u] = ICCP_NO_EDGE;
}

/* The distance of `v` from the planes of `u`, if the limit allows it. */
static double distance_off(const simplification *s, int side, uint32_t u, uint32_t v)
{
    double off = 0;
    for (uint32_t i = s->first[side][u]; i != ICCP_NO_EDGE && off <= s->limits->off[side];
         i = s->links[side][i].next) {
        const plane *const p = &s->plane[side][s->links[side][i].plane];
        off = iccp_max(off, fabs(iccp_vec_dot(3, p->normal, at(s, side, v)) - p->at));
    }
    return off;
}

/* ---- collapses ---- */

/* The sine of the least angle around a vertex, on both sides. */
static double thinnest_round(const simplification *s, uint32_t u)
{
    const iccp_half_edges *const m = &s->m;
    double least = HUGE_VAL;
    uint32_t h = m->out[u];
    for (uint32_t k = 0; k < m->degree[u]; ++k, h = iccp_edge_turn(m, h)) {
        const uint32_t a = iccp_edge_end(m, h), b = m->origin[iccp_before(h)];
        for (int side = 0; side < 2; ++side)
            least =
                iccp_min(least, iccp_least_sine(at(s, side, u), at(s, side, a), at(s, side, b)));
    }
    return least;
}

/* The cosine between a triangle's normal and that of the given face that contains it. */
static double facing(const simplification *s, int side, uint32_t face, const double *p,
                     const double *a, const double *b)
{
    double normal[3];
    iccp_triangle_normal(normal, p, a, b);
    const double length = iccp_vec_norm(3, normal);
    const double *const right = s->plane[side][s->c->within[side][face]].normal;
    return length > 0 ? iccp_vec_dot(3, normal, right) / length : -1;
}

/* The sine of the least angle, on both sides, of the triangles that a collapse changes. Returns -1
 * if one of them turns over or has too long an edge. */
static double thinnest_after(const simplification *s, uint32_t h)
{
    const iccp_half_edges *const m = &s->m;
    const uint32_t u = m->origin[h], v = iccp_edge_end(m, h);
    double least = HUGE_VAL;
    uint32_t e = iccp_edge_turn(m, h);
    for (uint32_t next = iccp_edge_turn(m, e); next != h; e = next, next = iccp_edge_turn(m, e)) {
        const uint32_t a = iccp_edge_end(m, e), b = iccp_edge_end(m, next);
        for (int side = 0; side < 2; ++side) {
            const double *const p = at(s, side, v), *const q = at(s, side, a);
            const double *const r = at(s, side, b);
            const double longest = s->limits->edge[side] * s->limits->edge[side];
            if (iccp_vec_distance2(3, p, q) > longest || iccp_vec_distance2(3, p, r) > longest)
                return -1;
            const double after = facing(s, side, e / 3, p, q, r);
            if (after < iccp_least_cosine &&
                !(after >= facing(s, side, e / 3, at(s, side, u), q, r)))
                return -1;
            least = iccp_min(least, iccp_least_sine(p, q, r));
        }
    }
    return least;
}

/* Finds the cheapest collapse of a vertex, or ICCP_NO_EDGE if none is allowed. */
static uint32_t find_cheapest(const simplification *s, uint32_t u, double *cost)
{
    const iccp_half_edges *const m = &s->m;
    uint32_t best = ICCP_NO_EDGE, h = m->out[u];
    *cost = HUGE_VAL;
    if (m->degree[u] == 0 || m->degree[u] > ICCP_MERGED_NEIGHBOURS ||
        (s->limits->keep != NULL && s->limits->keep[u] != 0))
        return best;
    const iccp_kept_cells *const cells = s->limits->cells;
    const double thin = thinnest_round(s, u), factor = thin < thin_sine ? iccp_readily : 1;
    const double fair =
        iccp_min(iccp_fair_sine, (cells != NULL ? iccp_worse_if_kept : not_much_worse) * thin);
    for (uint32_t k = 0; k < m->degree[u]; ++k, h = iccp_edge_turn(m, h)) {
        const uint32_t v = iccp_edge_end(m, h);
        double sum = 0, off = 0;
        if (m->degree[u] + m->degree[v] - 4 > ICCP_MERGED_NEIGHBOURS ||
            (cells != NULL && !iccp_kept_cells_may_go(cells, u, v)))
            continue;
        for (int side = 0; side < 2 && off <= 1; ++side) {
            sum += iccp_vec_distance(3, at(s, side, u), at(s, side, v)) / s->limits->edge[side];
            off = sum * factor < *cost ? distance_off(s, side, u, v) / s->limits->off[side]
                                       : HUGE_VAL;
            sum += off;
        }
        sum *= factor;
        if (off > 1 || sum >= *cost)
            continue;
        const double after = thinnest_after(s, h);
        if (after < fair)
            continue;
        sum *= iccp_thinness(after);
        if (sum < *cost && iccp_edge_collapsible(m, h)) {
            *cost = sum;
            best = h;
        }
    }
    return best;
}

static void examine(simplification *s, uint32_t vertex, double *cost)
{
    s->best[vertex] = find_cheapest(s, vertex, cost);
    s->known[vertex] = s->n_collapsed;
}

static void put(simplification *s, uint32_t vertex, double cost)
{
    if (s->best[vertex] != ICCP_NO_EDGE)
        iccp_heap_put(&s->heap, vertex, cost);
}

static void look_at(simplification *s, uint32_t vertex)
{
    double cost;
    examine(s, vertex, &cost);
    put(s, vertex, cost);
}

/* Returns true if a vertex was examined after the last change of the triangles at it and at its
 * neighbours, on which its collapses and their costs depend. */
static bool is_known(const simplification *s, uint32_t vertex)
{
    bool is = s->changed[vertex] <= s->known[vertex];
    uint32_t h = s->m.out[vertex];
    for (uint32_t k = 0; k < s->m.degree[vertex] && is; ++k, h = iccp_edge_turn(&s->m, h))
        is = s->changed[iccp_edge_end(&s->m, h)] <= s->known[vertex];
    return is;
}

static void collapse(simplification *s, uint32_t h)
{
    iccp_half_edges *const m = &s->m;
    const uint32_t u = m->origin[h], v = iccp_edge_end(m, h);
    const uint32_t first = iccp_edge_turn(m, h), n = m->degree[u] - 1;
    iccp_edge_collapse(m, h);
    for (int side = 0; side < 2; ++side)
        hand_over(s, side, u, v);
    s->changed[v] = ++s->n_collapsed;
    uint32_t e = first;
    for (uint32_t k = 0; k < n; ++k, e = iccp_edge_turn(m, e))
        s->changed[iccp_edge_end(m, e)] = s->n_collapsed;
    look_at(s, v);
    e = first;
    for (uint32_t k = 0; k < n; ++k, e = iccp_edge_turn(m, e))
        look_at(s, iccp_edge_end(m, e));
}

/* When a vertex's turn comes, it is examined again if something around it has changed. If its cost
 * has risen, it goes back into the queue. */
static icc_status run(simplification *s, const iccp_env *env)
{
    const size_t n_first = s->m.n_left;
    icc_status status = ICC_OK;
    for (uint32_t v = 0; v < s->m.n_vertices; ++v)
        look_at(s, v);
    for (size_t n = 0; s->heap.n_entries > 0 && status == ICC_OK; ++n) {
        const double key = s->heap.entry[0].key;
        double cost = key;
        const uint32_t vertex = iccp_heap_pop(&s->heap);
        if (!is_known(s, vertex))
            examine(s, vertex, &cost);
        if (cost > key)
            put(s, vertex, cost);
        else if (s->best[vertex] != ICCP_NO_EDGE)
            collapse(s, s->best[vertex]);
        if (n % 1024 == 0)
            status = iccp_progress(env, "match", 1 - (double)s->m.n_left / (double)n_first);
    }
    return status;
}

/* ---- from beginning to end ---- */

static icc_status simplify(simplification *s, iccp_common_surface *c, uint32_t *became,
                           const iccp_half_edges *const given[2], const double *const x[2],
                           const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    for (int side = 0; side < 2; ++side) {
        s->plane[side] = iccp_alloc(memory, given[side]->n_faces, sizeof *s->plane[side]);
        s->first[side] = iccp_alloc(memory, c->n_vertices, sizeof *s->first[side]);
        s->links[side] = iccp_alloc(memory, c->n_faces, 3 * sizeof *s->links[side]);
        s->marked[side] = iccp_alloc_zero(memory, given[side]->n_faces, sizeof *s->marked[side]);
        if (s->plane[side] == NULL || s->first[side] == NULL || s->links[side] == NULL ||
            s->marked[side] == NULL)
            return ICC_ERR_MEMORY;
        find_planes(s, side, given[side], x[side]);
        link_planes(s, side);
    }
    s->best = iccp_alloc(memory, c->n_vertices, sizeof *s->best);
    s->known = iccp_alloc(memory, c->n_vertices, sizeof *s->known);
    s->changed = iccp_alloc_zero(memory, c->n_vertices, sizeof *s->changed);
    if (!iccp_heap_create(&s->heap, c->n_vertices, memory) || s->best == NULL || s->known == NULL ||
        s->changed == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = run(s, env);
    if (status == ICC_OK)
        iccp_common_surface_compact(c, &s->m, became);
    return status;
}

icc_status iccp_simplify(iccp_common_surface *common, uint32_t *became,
                         const iccp_half_edges *const given[2], const double *const x[2],
                         const iccp_simplify_limits *limits, const iccp_env *env)
{
    simplification s = {.c = common, .limits = limits};
    icc_status status =
        iccp_half_edges_create(&s.m, common->n_vertices, common->n_faces, common->faces, env, NULL);
    if (status == ICC_OK)
        status = simplify(&s, common, became, given, x, env);
    for (int side = 0; side < 2; ++side) {
        iccp_free(&env->memory, s.plane[side]);
        iccp_free(&env->memory, s.first[side]);
        iccp_free(&env->memory, s.links[side]);
        iccp_free(&env->memory, s.marked[side]);
    }
    iccp_heap_free(&s.heap, &env->memory);
    iccp_free(&env->memory, s.best);
    iccp_free(&env->memory, s.known);
    iccp_free(&env->memory, s.changed);
    iccp_half_edges_free(&s.m);
    return status;
}
