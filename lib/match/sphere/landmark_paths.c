/* Joins the landmarks of two surfaces by paths that triangulate both in the same way. Based on: E.
 * Praun, W. Sweldens, P. Schroeder, Consistent Mesh Parameterizations, 2001. A tree of paths comes
 * first, which leaves one face; then come diagonals of faces. At each landmark a path begins in the
 * same sector on both surfaces. */
#include "match/sphere/landmark_paths.h"

#include "base/minmax.h"
#include "match/sphere/landmark_web.h"

#include <string.h>

enum { MOST_ADDED = 20 };

/* ---- halves ---- */

/* Halves the edges at a vertex of the web that lead to other vertices of the web. The number of its
 * edges stays the same, but their numbers may change. */
static bool make_room_at(const iccp_landmark_web *w, int side, uint32_t v)
{
    iccp_split_surface *const s = &w->s[side];
    size_t n = 0;
    uint32_t h = s->out[v];
    do {
        ++n;
        h = iccp_split_turn(s, h);
    } while (h != s->out[v]);
    for (; n > 0; --n, h = iccp_split_turn(s, h))
        if (s->path[h] == ICCP_NO_EDGE && s->holder[iccp_split_end(s, h)] != ICCP_NO_EDGE &&
            !iccp_split_halve(s, h))
            return false;
    return true;
}

/* ---- one path ---- */

/* Lays the next path on one side and measures it. */
static bool lay(iccp_landmark_web *w, int side, uint32_t from, uint32_t to, double *length)
{
    iccp_split_surface *const s = &w->s[side];
    const uint32_t path = (uint32_t)w->n_paths;
    iccp_web_search(w, side, from, HUGE_VAL);
    *length = w->scale[side] * w->arrival[to];
    const uint32_t start = w->vertices[side][iccp_web_landmark_of(w, from)];
    for (uint32_t h = w->entered[to];; h = w->via[s->origin[h]]) {
        s->path[h] = s->path[s->twin[h]] = path;
        if (s->origin[h] == start)
            break;
        s->holder[s->origin[h]] = path;
    }
    /* Halving changes half-edges. So the path's vertices are found again by following it. */
    uint32_t v = w->vertices[side][iccp_web_landmark_of(w, to)], before = ICCP_NO_EDGE;
    while (v != start) {
        uint32_t h = s->out[v];
        while (s->path[h] != path || iccp_split_end(s, h) == before)
            h = iccp_split_turn(s, h);
        before = v;
        v = iccp_split_end(s, h);
        if (v != start && !make_room_at(w, side, v))
            return false;
    }
    return make_room_at(w, side, start) &&
           make_room_at(w, side, w->vertices[side][iccp_web_landmark_of(w, to)]);
}

static icc_status add_path(iccp_landmark_web *w, uint32_t from, uint32_t to, const iccp_env *env)
{
    const uint32_t a = iccp_web_landmark_of(w, from), b = iccp_web_landmark_of(w, to);
    double length[2];
    for (int side = 0; side < 2; ++side) {
        if (!lay(w, side, from, to, &length[side]))
            return ICC_ERR_MEMORY;
        if (w->s[side].n_vertices > w->most_vertices[side]) {
            w->report.side = side;
            w->report.landmark = a;
            return ICC_ERR_RESOLUTION;
        }
        if (!iccp_web_make_room(w, w->s[side].n_vertices, &env->memory))
            return ICC_ERR_MEMORY;
    }
    w->ends[w->n_paths][0] = a;
    w->ends[w->n_paths][1] = b;
    w->is_in[a] = w->is_in[b] = true;
    w->joined[a * w->n + b] = w->joined[b * w->n + a] = 1;
    ++w->n_paths;
    w->report.worst =
        iccp_max(w->report.worst, iccp_max(length[0] / length[1], length[1] / length[0]));
    if (w->report.worst > w->most_ratio)
        return ICC_ERR_RESOLUTION;
    return iccp_progress(env, "match", (double)w->n_paths / (double)w->most_paths);
}

/* ---- all paths ---- */

/* R. C. Prim's form of J. Kruskal's rule: takes the cheapest path from a landmark outside to the
 * tree. */
static icc_status make_tree(iccp_landmark_web *w, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (size_t n = 1; n < w->n && status == ICC_OK; ++n) {
        const uint32_t lonely = (uint32_t)(2 * w->most_paths);
        uint32_t best[2] = {0, 0};
        double least = HUGE_VAL;
        for (uint32_t k = 0; k < w->n; ++k) {
            if (w->is_in[k] || k == w->root)
                continue;
            iccp_web_find_costs(w, lonely + k, least);
            for (uint32_t to = 0; to < w->n_sectors; ++to) {
                const bool is_in_tree = n == 1 ? to == lonely + w->root : to < 2 * w->n_paths;
                if (is_in_tree && w->cost[w->n_sectors * (lonely + k) + to] < least) {
                    least = w->cost[w->n_sectors * (lonely + k) + to];
                    best[0] = lonely + k;
                    best[1] = to;
                }
            }
        }
        status = least < HUGE_VAL ? add_path(w, best[0], best[1], env) : ICC_ERR_RESOLUTION;
    }
    return status;
}

static icc_status add_diagonals(iccp_landmark_web *w, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (size_t k = 0; k < w->n_sectors * w->n_sectors; ++k)
        w->cost[k] = HUGE_VAL;
    for (uint32_t k = 0; k < 2 * w->n_paths; ++k)
        iccp_web_find_costs(w, k, HUGE_VAL);
    while (w->n_paths < w->most_paths && status == ICC_OK) {
        uint32_t best[2] = {0, 0};
        double least = HUGE_VAL;
        const uint32_t n = (uint32_t)(2 * w->n_paths);
        for (uint32_t a = 0; a < n; ++a)
            for (uint32_t b = 0; b < a; ++b) {
                const uint32_t p = iccp_web_landmark_of(w, a), q = iccp_web_landmark_of(w, b);
                const double cost = w->cost[w->n_sectors * a + b];
                if (p != q && !w->joined[p * w->n + q] && cost < least) {
                    least = cost;
                    best[0] = a;
                    best[1] = b;
                }
            }
        if (!(least < HUGE_VAL))
            return ICC_ERR_RESOLUTION;
        status = add_path(w, best[0], best[1], env);
        /* The sectors of the face are those that could be reached from there. */
        for (uint32_t k = 0; k < n + 2; ++k)
            w->is_stale[k] =
                k >= n || k == best[0] || w->cost[w->n_sectors * best[0] + k] < HUGE_VAL;
        for (uint32_t k = 0; k < n + 2 && status == ICC_OK; ++k)
            if (w->is_stale[k])
                iccp_web_find_costs(w, k, HUGE_VAL);
    }
    return status;
}

static icc_status run(iccp_landmark_web *w, const iccp_env *env)
{
    for (int side = 0; side < 2; ++side) {
        iccp_split_surface *const s = &w->s[side];
        for (uint32_t k = 0; k < w->n; ++k)
            s->holder[w->vertices[side][k]] = ICCP_LANDMARK + k;
        for (size_t k = 0; k < w->n; ++k)
            if (!make_room_at(w, side, w->vertices[side][k]))
                return ICC_ERR_MEMORY;
        if (!iccp_web_make_room(w, s->n_vertices, &env->memory))
            return ICC_ERR_MEMORY;
    }
    icc_status status = make_tree(w, env);
    if (status == ICC_OK)
        status = add_diagonals(w, env);
    return status;
}

icc_status iccp_landmark_paths(iccp_split_surface s[2], size_t n, const uint32_t *const vertices[2],
                               const double scale[2], uint32_t root, bool is_even,
                               double most_ratio, uint32_t (*ends)[2], uint8_t *joined,
                               iccp_paths_report *report, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    iccp_landmark_web w = {.s = s,
                           .n = n,
                           .most_paths = 3 * n - 6,
                           .vertices = vertices,
                           .root = root,
                           .is_even = is_even,
                           .scale = scale,
                           .report = {.worst = 1},
                           .most_ratio = most_ratio,
                           .ends = ends,
                           .joined = joined};
    icc_status status = ICC_ERR_MEMORY;
    w.n_sectors = 2 * w.most_paths + n;
    for (int side = 0; side < 2; ++side)
        w.most_vertices[side] = MOST_ADDED * (s[0].n_vertices + s[1].n_vertices);
    memset(joined, 0, n * n);
    w.is_in = iccp_alloc_zero(memory, n, sizeof *w.is_in);
    w.is_stale = iccp_alloc(memory, w.n_sectors, sizeof *w.is_stale);
    w.cost = iccp_alloc(memory, w.n_sectors * w.n_sectors, sizeof *w.cost);
    w.arrival = iccp_alloc(memory, w.n_sectors, sizeof *w.arrival);
    w.entered = iccp_alloc(memory, w.n_sectors, sizeof *w.entered);
    if (w.is_in != NULL && w.is_stale != NULL && w.cost != NULL && w.arrival != NULL &&
        w.entered != NULL)
        status = run(&w, env);
    *report = w.report;
    iccp_heap_free(&w.heap, memory);
    iccp_free(memory, w.is_in);
    iccp_free(memory, w.is_stale);
    iccp_free(memory, w.cost);
    iccp_free(memory, w.distance);
    iccp_free(memory, w.via);
    iccp_free(memory, w.arrival);
    iccp_free(memory, w.entered);
    return status;
}
