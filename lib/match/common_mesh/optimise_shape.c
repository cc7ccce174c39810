/* Makes two surfaces with common triangles coarser and their triangles rounder. Based on: H. Hoppe,
 * T. DeRose, T. Duchamp, J. McDonald, W. Stuetzle, Mesh Optimization, 1993. There are three kinds
 * of changes: a collapse, a flip, and a move of a vertex. A change is made if the surface stays
 * close enough. Here there are two surfaces at once. When an edge is collapsed, a vertex may take
 * its place on one surface from one end and on the other surface from the other end. So vertices of
 * the two surfaces become one. */
#include "match/common_mesh/optimise_shape.h"

#include "base/heap.h"
#include "base/minmax.h"
#include "match/surface/corner_angle.h"

#include <string.h>

/* More rounds make triangles a little rounder, and each takes as long. */
enum { ROUNDS = 2 };

/* Flips and moves must improve triangles that are not fair by this factor. A collapse may leave
 * triangles that are fair or not thinner than before. */
static const double better = 0.98;

/* Vertices at triangles with a smaller sine go first. */
static const double thin_sine = 0.12;

/* After a collapse, neighbours wait until this multiple of its cost before they are tested
 * again. */
static const double later = 1.2;

typedef struct optimisation {
    iccp_patch_state s;
    iccp_heap heap; /* vertices by the cost of their cheapest collapse, or less */
} optimisation;

/* ---- collapses ---- */

/* Finds the cheapest collapse of a vertex, or ICCP_NO_EDGE if none is allowed. */
static uint32_t find_cheapest(iccp_patch_state *s, uint32_t u, iccp_patch *best, double *cost)
{
    const iccp_half_edges *const m = &s->m;
    const double share = s->cells != NULL ? iccp_worse_if_kept : 1;
    uint32_t found = ICCP_NO_EDGE, h = m->out[u];
    iccp_patch ring = {.vertex = ICCP_NO_EDGE};
    *cost = HUGE_VAL;
    if (m->degree[u] > ICCP_MERGED_NEIGHBOURS || s->keep[u] != 0)
        return found;
    iccp_patch_add_ring(s, &ring, u, ICCP_NO_EDGE, u);
    const iccp_patch_shape round_u = iccp_patch_before(s, &ring);
    for (uint32_t k = 0; k < m->degree[u]; ++k, h = iccp_edge_turn(m, h)) {
        const uint32_t v = iccp_edge_end(m, h);
        double length = 0;
        for (int side = 0; side < 2; ++side)
            length +=
                sqrt(iccp_vec_distance2(3, s->x[side] + 3 * (size_t)u, s->x[side] + 3 * (size_t)v) /
                     s->edge2[side]);
        if (m->degree[u] + m->degree[v] - 4 > ICCP_MERGED_NEIGHBOURS ||
            length * iccp_readily >= *cost || !iccp_edge_collapsible(m, h))
            continue;
        iccp_patch_shape before = round_u, after;
        /* Takes both places from v, or one from u. */
        for (int from_u = -1; from_u < 2; ++from_u) {
            if (!iccp_patch_may_unite(s, from_u, u, v))
                continue;
            iccp_patch p = {.vertex = v, .place = {s->at[0][v], s->at[1][v]}};
            iccp_patch_add_ring(s, &p, u, ICCP_NO_EDGE, v);
            if (from_u >= 0) {
                p.place[from_u] = s->at[from_u][u];
                iccp_patch_add_ring(s, &p, v, u, v);
            }
            if (from_u == 0 || (from_u > 0 && !iccp_patch_may_unite(s, 0, u, v)))
                before = iccp_patch_before(s, &p);
            if ((from_u >= 0 && before.least > iccp_fair_sine) ||
                !iccp_patch_after(s, &p, &before, iccp_min(iccp_fair_sine, share * before.least),
                                  HUGE_VAL, &after))
                continue;
            const double sum =
                length * (before.least < thin_sine ? iccp_readily : 1) * iccp_thinness(after.least);
            if (sum < *cost && iccp_patch_allowed(s, &p, before.least)) {
                *cost = sum;
                *best = p;
                found = h;
            }
        }
    }
    return found;
}

/* Collapses vertices in the order of their costs. A vertex is tested when its turn comes, and waits
 * for another turn if its cost has risen. *any becomes true if something was collapsed. */
static icc_status collapse_all(optimisation *t, bool *any, const iccp_env *env)
{
    iccp_half_edges *const m = &t->s.m;
    icc_status status = ICC_OK;
    for (uint32_t v = 0; v < m->n_vertices; ++v)
        if (m->degree[v] > 0)
            iccp_heap_put(&t->heap, v, 0);
    for (size_t n = 0; t->heap.n_entries > 0 && status == ICC_OK; ++n) {
        const double key = t->heap.entry[0].key;
        double cost;
        iccp_patch p;
        if (n % 1024 == 0)
            status = iccp_progress(env, "match", 0);
        const uint32_t u = iccp_heap_pop(&t->heap), h = find_cheapest(&t->s, u, &p, &cost);
        if (h == ICCP_NO_EDGE)
            continue;
        if (cost > key) {
            iccp_heap_put(&t->heap, u, cost);
            continue;
        }
        iccp_patch_apply(&t->s, &p);
        iccp_edge_collapse(m, h);
        *any = true;
        iccp_heap_put(&t->heap, p.vertex, later * cost);
        uint32_t e = m->out[p.vertex];
        for (uint32_t k = 0; k < m->degree[p.vertex]; ++k, e = iccp_edge_turn(m, e))
            iccp_heap_put(&t->heap, iccp_edge_end(m, e), later * cost);
    }
    return status;
}

/* ---- flips and moves ---- */

static bool flip_all(iccp_patch_state *s)
{
    iccp_half_edges *const m = &s->m;
    bool any = false;
    for (uint32_t h = 0; h < 3 * m->n_faces; ++h) {
        const uint32_t g = m->twin[h], u = m->origin[h], v = iccp_edge_end(m, h);
        const uint32_t b = m->origin[iccp_before(h)], a = m->origin[iccp_before(g)];
        /* Triangles that were removed have a corner that was removed. */
        if (g < h || m->degree[u] < 4 || m->degree[v] < 4 || m->degree[b] == 0 ||
            iccp_are_neighbours(m, a, b) || !iccp_patch_may_flip(s, (const uint32_t[]){u, v, a, b}))
            continue;
        const iccp_patch p = {.before = {2, {h / 3, g / 3}, {{u, v, b}, {v, u, a}}},
                              .after = {2, {h / 3, g / 3}, {{b, a, v}, {a, b, u}}},
                              .vertex = ICCP_NO_EDGE};
        const iccp_patch_shape before = iccp_patch_before(s, &p);
        iccp_patch_shape after;
        if (before.least > iccp_fair_sine ||
            !iccp_patch_after(s, &p, &before, 0, better * before.sum, &after) ||
            !iccp_patch_allowed(s, &p, before.least))
            continue;
        iccp_patch_apply(s, &p);
        iccp_edge_flip(m, h);
        any = true;
    }
    return any;
}

/* Moves a vertex, on the sides whose bits are set, to the place with the best triangles. The places
 * tried are those of the points of these triangles. Returns true if one is better than its own. */
static bool move(iccp_patch_state *s, uint32_t v, uint32_t sides)
{
    const iccp_covering *const points = &s->covering[sides == 2];
    iccp_patch p = {.vertex = v, .place = {s->at[0][v], s->at[1][v]}}, best;
    iccp_patch_add_ring(s, &p, v, ICCP_NO_EDGE, v);
    const iccp_patch_shape before = iccp_patch_before(s, &p);
    double most = better * before.sum;
    bool any = false;
    for (uint32_t t = 0; t < p.before.n && before.least < iccp_fair_sine; ++t)
        for (uint32_t i = points->first[p.before.number[t]]; i != ICCP_NO_EDGE;
             i = points->next[i]) {
            iccp_patch_shape after;
            if (!iccp_patch_may_move(s, v, sides, i))
                continue;
            for (uint32_t side = 0; side < 2; ++side)
                if ((sides >> side & 1) != 0)
                    p.place[side] = i;
            if (iccp_patch_after(s, &p, &before, 0, most, &after) &&
                iccp_patch_allowed(s, &p, before.least)) {
                most = after.sum;
                best = p;
                any = true;
            }
        }
    if (any)
        iccp_patch_apply(s, &best);
    return any;
}

static bool move_all(iccp_patch_state *s)
{
    bool any = false;
    for (uint32_t v = 0; v < s->m.n_vertices; ++v)
        for (uint32_t sides = 1; sides <= 3; ++sides)
            if (s->m.degree[v] > 0 && s->m.degree[v] <= ICCP_MERGED_NEIGHBOURS &&
                (s->keep[v] & sides) == 0)
                any = move(s, v, sides) || any;
    return any;
}

/* ---- from beginning to end ---- */

static icc_status run(optimisation *t, const iccp_env *env)
{
    icc_status status = ICC_OK;
    bool any = true;
    for (size_t k = 0; k < ROUNDS && any && status == ICC_OK; ++k) {
        any = false;
        status = collapse_all(t, &any, env);
        if (status == ICC_OK) {
            any = flip_all(&t->s) || any;
            any = move_all(&t->s) || any;
            status = iccp_progress(env, "match", (double)(k + 1) / ROUNDS);
        }
    }
    return status;
}

/* Returns true if a vertex of the whole is still present as a vertex of the result. */
static bool is_left(const iccp_patch_state *s, const iccp_common_surface *c, uint32_t v,
                    uint32_t left)
{
    bool is = true;
    for (int side = 0; side < 2; ++side)
        is = is && s->whole->origin[side][v] == c->origin[side][left] &&
             memcmp(iccp_patch_point(s, side, v), c->x[side] + 3 * (size_t)left,
                    3 * sizeof(double)) == 0;
    return is;
}

static double area_of(const iccp_common_surface *c, int side)
{
    double area = 0;
    for (size_t f = 0; f < c->n_faces; ++f) {
        const uint32_t *const v = c->faces + 3 * f;
        const double *const x = c->x[side];
        double normal[3];
        iccp_triangle_normal(normal, x + 3 * (size_t)v[0], x + 3 * (size_t)v[1],
                             x + 3 * (size_t)v[2]);
        area += iccp_vec_norm(3, normal);
    }
    return area;
}

/* The mean energy, weighted by the areas on both sides. */
static double energy_of(const iccp_common_surface *c, double scale)
{
    double sum[2] = {0, 0};
    for (size_t f = 0; f < c->n_faces; ++f) {
        iccp_corners on[2];
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < 3; ++i)
                on[side].at[i] = c->x[side] + 3 * (size_t)c->faces[3 * f + (size_t)i];
        iccp_patch_add_energy(sum, &on[0], &on[1], scale);
    }
    return sum[0] / sum[1];
}

static icc_status optimise(optimisation *t, iccp_common_surface *c, uint32_t *became, double *rise,
                           const uint32_t *left, const iccp_half_edges *const given[2],
                           const double *const x[2], const double *off, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    iccp_patch_state *const s = &t->s;
    bool has_memory = iccp_heap_create(&t->heap, c->n_vertices, memory);
    for (int side = 0; side < 2 && has_memory; ++side) {
        s->x[side] = c->x[side];
        s->at[side] = iccp_alloc(memory, c->n_vertices, sizeof *s->at[side]);
        has_memory =
            s->at[side] != NULL &&
            iccp_clearance_create(&s->clearance[side], &s->m, c->x[side], memory) &&
            iccp_covering_create(&s->covering[side], given[side], x[side], s->whole->n_vertices,
                                 s->whole->x[side], off[side], &s->clearance[side].tree, memory);
        for (uint32_t v = 0; v < s->whole->n_vertices && has_memory; ++v)
            if (is_left(s, c, v, left[v]))
                s->at[side][left[v]] = v;
    }
    s->scale = sqrt(area_of(c, 0) / area_of(c, 1));
    const double before = energy_of(c, s->scale);
    const icc_status status = has_memory ? run(t, env) : ICC_ERR_MEMORY;
    if (status != ICC_OK)
        return status;
    for (int side = 0; side < 2; ++side)
        for (uint32_t v = 0; v < c->n_vertices; ++v)
            c->origin[side][v] = s->whole->origin[side][s->at[side][v]];
    iccp_common_surface_compact(c, &s->m, became);
    *rise = energy_of(c, s->scale) / before;
    return status;
}

icc_status iccp_optimise_shape(iccp_common_surface *common, uint32_t *became, double *rise,
                               iccp_patch_caution caution, const iccp_common_surface *whole,
                               const uint32_t *left, const iccp_half_edges *const given[2],
                               const double *const x[2], const iccp_simplify_limits *limits,
                               const iccp_env *env)
{
    optimisation t = {
        .s = {.whole = whole, .keep = limits->keep, .cells = limits->cells, .caution = caution}};
    icc_status status = iccp_half_edges_create(&t.s.m, common->n_vertices, common->n_faces,
                                               common->faces, env, NULL);
    for (int side = 0; side < 2; ++side)
        t.s.edge2[side] = limits->edge[side] * limits->edge[side];
    if (status == ICC_OK)
        status = optimise(&t, common, became, rise, left, given, x, limits->off, env);
    for (int side = 0; side < 2; ++side) {
        iccp_covering_free(&t.s.covering[side], &env->memory);
        iccp_clearance_free(&t.s.clearance[side], &env->memory);
        iccp_free(&env->memory, t.s.at[side]);
    }
    iccp_heap_free(&t.heap, &env->memory);
    iccp_half_edges_free(&t.s.m);
    return status;
}
