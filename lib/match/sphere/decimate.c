/* Makes a surface coarse by collapses of edges. Based on: M. Garland, P. Heckbert, Surface
 * Simplification Using Quadric Error Metrics, 1997; with half-edge collapses, L. Kobbelt, S.
 * Campagna, H.-P. Seidel, A General Framework for Mesh Decimation, 1998. */
#include "match/sphere/decimate.h"

#include "base/heap.h"
#include "base/minmax.h"
#include "match/sphere/landmark_paths.h"
#include "math/vec.h"

#include <math.h>

/* A quadric is the sum of the squared distances to planes, weighted by area. A plane has a unit
 * normal n, and n . p = d. It stores n n^T (six entries), -d n and d^2. */
enum { QUADRIC = 10 };

/* Weight of the collapsed edge's length beside the change of shape. It thins out flat parts
 * evenly. */
static const double length_weight = 1e-4;

typedef struct decimation {
    iccp_half_edges *m;
    const double *x;
    double (*quadric)[QUADRIC];
    double area;                  /* twice that of the surface */
    uint32_t most;                /* the most neighbours; doubled if no collapse is left */
    const iccp_decimate_web *web; /* or NULL */
    iccp_heap heap; /* vertices by the cost of their cheapest collapse, as computed last */
} decimation;

static const double *at(const decimation *d, uint32_t vertex)
{
    return d->x + 3 * (size_t)vertex;
}

static void normal(double n[3], const double *a, const double *b, const double *c)
{
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    iccp_vec_cross(u, v, n);
}

/* Adds the plane of each face to its corners' quadrics. */
static void add_planes(decimation *d)
{
    const iccp_half_edges *const m = d->m;
    for (size_t f = 0; f < m->n_faces; ++f) {
        const uint32_t *const v = m->origin + 3 * f;
        double n[4];
        normal(n, at(d, v[0]), at(d, v[1]), at(d, v[2]));
        const double area = iccp_vec_norm(3, n);
        if (!(area > 0))
            continue;
        n[3] = -iccp_vec_dot(3, n, at(d, v[0]));
        for (int corner = 0; corner < 3; ++corner)
            for (int i = 0, k = 0; i < 4; ++i)
                for (int j = i; j < 4; ++j, ++k)
                    d->quadric[v[corner]][k] += n[i] * n[j] / area;
    }
}

/* The trace of the quadric, because normals have length 1. */
static double area_round(const decimation *d, uint32_t vertex)
{
    const double *const q = d->quadric[vertex];
    return q[0] + q[4] + q[7];
}

static double quadric_at(const double q[QUADRIC], const double *p)
{
    return q[0] * p[0] * p[0] + q[4] * p[1] * p[1] + q[7] * p[2] * p[2] + q[9] +
           2 * (q[1] * p[0] * p[1] + q[2] * p[0] * p[2] + q[5] * p[1] * p[2] + q[3] * p[0] +
                q[6] * p[1] + q[8] * p[2]);
}

/* The factor on a collapse's cost for faces that it turns over or makes thin. */
static double penalty(const decimation *d, uint32_t h)
{
    const iccp_half_edges *const m = d->m;
    const double *const u = at(d, m->origin[h]), *const v = at(d, iccp_edge_end(m, h));
    double factor = 1;
    uint32_t e = iccp_edge_turn(m, h);
    for (uint32_t next = iccp_edge_turn(m, e); next != h; e = next, next = iccp_edge_turn(m, e)) {
        const double *const a = at(d, iccp_edge_end(m, e));
        const double *const b = at(d, iccp_edge_end(m, next));
        double before[3], after[3];
        normal(before, u, a, b);
        normal(after, v, a, b);
        const double longest =
            iccp_max(iccp_vec_distance2(3, a, b),
                     iccp_max(iccp_vec_distance2(3, v, a), iccp_vec_distance2(3, v, b)));
        const double area = iccp_vec_norm(3, after);
        if (iccp_vec_dot(3, before, after) < 0.2 * iccp_vec_norm(3, before) * area)
            factor *= 4;
        if (area < 0.1 * longest)
            factor *= 3;
    }
    return factor;
}

/* ---- paths ---- */

static bool is_landmark(uint32_t holder)
{
    return holder != ICCP_NO_EDGE && holder >= ICCP_LANDMARK;
}

bool iccp_share_path(const iccp_decimate_web *web, uint32_t a, uint32_t b)
{
    const uint32_t p = web->holder[a], q = web->holder[b];
    if (p == ICCP_NO_EDGE || q == ICCP_NO_EDGE)
        return false;
    if (is_landmark(p) && is_landmark(q))
        return web->joined[(p - ICCP_LANDMARK) * web->n_landmarks + (q - ICCP_LANDMARK)] != 0;
    if (!is_landmark(p) && !is_landmark(q))
        return p == q;
    const uint32_t *const ends = web->ends[is_landmark(p) ? q : p];
    const uint32_t k = (is_landmark(p) ? p : q) - ICCP_LANDMARK;
    return ends[0] == k || ends[1] == k;
}

/* A vertex of a path may only move along the path. No collapse may make an edge that joins two
 * vertices of one path beside it, because the path could never shrink to that edge. */
static bool is_allowed(const decimation *d, uint32_t h)
{
    const iccp_half_edges *const m = d->m;
    if (d->web == NULL)
        return true;
    const uint32_t own = d->web->holder[m->origin[h]], end = iccp_edge_end(m, h);
    if (is_landmark(own) || (own != ICCP_NO_EDGE && d->web->path[h] != own))
        return false;
    uint32_t e = iccp_edge_turn(m, iccp_edge_turn(m, h));
    for (; iccp_edge_turn(m, e) != h; e = iccp_edge_turn(m, e))
        if ((own == ICCP_NO_EDGE || d->web->path[e] != own) &&
            iccp_share_path(d->web, iccp_edge_end(m, e), end))
            return false;
    return true;
}

/* Two edges become one. If one of them belongs to a path, the result does. */
static void merge_paths(const iccp_decimate_web *web, const iccp_half_edges *m, uint32_t h)
{
    for (int way = 0; way < 2; ++way, h = m->twin[h]) {
        const uint32_t a = m->twin[iccp_after(h)], b = m->twin[iccp_before(h)];
        const uint32_t path = web->path[a] != ICCP_NO_EDGE ? web->path[a] : web->path[b];
        web->path[a] = web->path[b] = path;
    }
}

/* Finds the cheapest collapse of a vertex, or ICCP_NO_EDGE. */
static uint32_t find_cheapest(const decimation *d, uint32_t vertex, double *cost)
{
    const iccp_half_edges *const m = d->m;
    uint32_t best = ICCP_NO_EDGE, h = m->out[vertex];
    *cost = HUGE_VAL;
    if (m->degree[vertex] > d->most)
        return best;
    do {
        const uint32_t end = iccp_edge_end(m, h);
        if (m->degree[vertex] + m->degree[end] - 4 <= d->most) {
            const double *const p = at(d, end);
            const double change =
                quadric_at(d->quadric[vertex], p) + quadric_at(d->quadric[end], p);
            const double length = iccp_vec_distance2(3, at(d, vertex), p);
            double sum = iccp_max(change, 0) + length_weight * length * area_round(d, vertex);
            if (sum < *cost && (sum *= penalty(d, h)) < *cost && is_allowed(d, h) &&
                iccp_edge_collapsible(m, h)) {
                *cost = sum;
                best = h;
            }
        }
        h = iccp_edge_turn(m, h);
    } while (h != m->out[vertex]);
    return best;
}

static void look_at(decimation *d, uint32_t vertex)
{
    double cost;
    if (find_cheapest(d, vertex, &cost) != ICCP_NO_EDGE)
        iccp_heap_put(&d->heap, vertex, cost);
}

static void look_at_all(decimation *d)
{
    for (uint32_t v = 0; v < d->m->n_vertices; ++v)
        if (d->m->degree[v] > 0)
            look_at(d, v);
}

static void collapse(decimation *d, uint32_t h)
{
    iccp_half_edges *const m = d->m;
    const uint32_t u = m->origin[h], v = iccp_edge_end(m, h);
    const uint32_t first = iccp_edge_turn(m, h), n = m->degree[u] - 1;
    if (d->web != NULL)
        merge_paths(d->web, m, h);
    iccp_edge_collapse(m, h);
    for (int k = 0; k < QUADRIC; ++k)
        d->quadric[v][k] += d->quadric[u][k];
    look_at(d, v);
    uint32_t e = first;
    for (uint32_t k = 0; k < n; ++k, e = iccp_edge_turn(m, e))
        look_at(d, iccp_edge_end(m, e));
}

/* The cost of a vertex depends on the faces around it and around its neighbours. After a collapse
 * only the next vertices are computed anew. Others are computed again when their turn comes, and go
 * back into the queue if they have become more expensive.
 *
 * If the queue ends too early, all vertices are computed once more. If that does not help either,
 * vertices may have more neighbours. There is always a vertex with at most five neighbours, which
 * has a collapsible edge. So the loop ends. */
static icc_status run(decimation *d, size_t n_left, const iccp_env *env)
{
    iccp_half_edges *const m = d->m;
    const size_t n_first = m->n_left;
    icc_status status = ICC_OK;
    while (m->n_left > n_left && status == ICC_OK) {
        const size_t n_before = m->n_left;
        look_at_all(d);
        while (m->n_left > n_left && d->heap.n_entries > 0 && status == ICC_OK) {
            const double key = d->heap.entry[0].key;
            double cost;
            const uint32_t vertex = iccp_heap_pop(&d->heap);
            const uint32_t h = find_cheapest(d, vertex, &cost);
            if (h != ICCP_NO_EDGE && cost > key)
                iccp_heap_put(&d->heap, vertex, cost);
            else if (h != ICCP_NO_EDGE)
                collapse(d, h);
            if (m->n_left % 1024 == 0)
                status = iccp_progress(env, "match",
                                       (double)(n_first - m->n_left) / (double)(n_first - n_left));
        }
        if (m->n_left == n_before && d->most > m->n_vertices)
            return ICC_ERR_RESOLUTION;
        if (m->n_left == n_before)
            d->most *= 2;
    }
    return status;
}

static icc_status decimate(iccp_half_edges *m, const double *x, size_t n_left,
                           const iccp_decimate_web *web, const iccp_env *env)
{
    decimation d = {.m = m, .x = x, .most = ICCP_MERGED_NEIGHBOURS, .web = web};
    icc_status status = ICC_ERR_MEMORY;
    d.quadric = iccp_alloc_zero(&m->memory, m->n_vertices, sizeof *d.quadric);
    if (iccp_heap_create(&d.heap, m->n_vertices, &m->memory) && d.quadric != NULL) {
        add_planes(&d);
        status = run(&d, n_left, env);
    }
    iccp_heap_free(&d.heap, &m->memory);
    iccp_free(&m->memory, d.quadric);
    return status;
}

icc_status iccp_decimate(iccp_half_edges *m, const double *x, size_t n_left, const iccp_env *env)
{
    return decimate(m, x, n_left, NULL, env);
}

icc_status iccp_decimate_along(iccp_half_edges *m, const double *x, const iccp_decimate_web *web,
                               const iccp_env *env)
{
    return decimate(m, x, web->n_landmarks, web, env);
}
