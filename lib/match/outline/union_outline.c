/* Makes the union of the vertices of two outlines. Vertices that lie close to each other are
 * joined. Otherwise an edge of one outline would be cut very close to its end. The pairing is bent
 * to pass through the joined vertices, and all other vertices follow it, so their order is kept. */
#include "match/outline/union_outline.h"

#include "base/sort.h"
#include "match/outline/merge_order.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

/* Knots keep this distance from joined vertices, as a share of the perimeter. */
static const double clear = 1e-7;

static bool is_before(const void *context, uint32_t a, uint32_t b)
{
    const double *const place = context;
    return place[a] < place[b];
}

static void release(iccp_merge_order *w, const iccp_memory *memory)
{
    iccp_free(memory, w->place);
    iccp_free(memory, w->edge);
    iccp_free(memory, w->order[0]);
    iccp_free(memory, w->work);
    iccp_free(memory, w->knot);
    iccp_free(memory, w->bent);
    iccp_free(memory, w->join);
    iccp_free(memory, w->event);
    iccp_free(memory, w->is_joined);
}

static icc_status reserve(iccp_merge_order *w, size_t n_knots, size_t n_landmarks,
                          const iccp_memory *memory)
{
    const size_t n = w->n[0] + w->n[1];
    w->place = iccp_alloc(memory, n, sizeof *w->place);
    w->edge = iccp_alloc(memory, n, sizeof *w->edge);
    w->order[0] = iccp_alloc(memory, n, sizeof *w->order[0]);
    w->work = iccp_alloc(memory, n, sizeof *w->work);
    w->knot = iccp_alloc(memory, 2 * (n_knots + 2), sizeof *w->knot);
    w->bent = iccp_alloc(memory, 2 * (n_knots + 2 + w->n[0] + n_landmarks), sizeof *w->bent);
    w->join = iccp_alloc(memory, 2 * w->n[0] + n_landmarks, sizeof *w->join);
    w->event = iccp_alloc(memory, n + n_landmarks, sizeof *w->event);
    w->is_joined = iccp_alloc_zero(memory, n, 1);
    if (w->place == NULL || w->edge == NULL || w->order[0] == NULL || w->work == NULL ||
        w->knot == NULL || w->bent == NULL || w->join == NULL || w->event == NULL ||
        w->is_joined == NULL)
        return ICC_ERR_MEMORY;
    w->order[1] = w->order[0] + w->n[0];
    return ICC_OK;
}

/* Chooses where to cut along the source: in the pairing's first piece, from `from` to `to`. Of the
 * edge at the middle of the piece, takes the middle of what lies in the piece. A vertex at the cut
 * could end up at the other end than its partner. */
static double find_cut(const iccp_outline *source, double from, double to)
{
    const double middle = (from + to) / 2;
    double along;
    const size_t edge = iccp_outline_edge(source, middle, &along);
    const double length = source->share[edge + 1] - source->share[edge];
    const double begin = middle - along * length, end = begin + length;
    return ((begin > from ? begin : from) + (end < to ? end : to)) / 2;
}

/* Cuts the pairing and the outlines open in the pairing's first piece. */
static void open(iccp_merge_order *w, const iccp_pairing_knots *knots)
{
    const double *const k = knots->knot;
    const double next[2] = {knots->n > 1 ? k[2] : k[0] + 1, knots->n > 1 ? k[3] : k[1] + 1};
    w->cut[0] = find_cut(w->outline[0], k[0], next[0]);
    w->cut[1] = k[1] + (w->cut[0] - k[0]) / (next[0] - k[0]) * (next[1] - k[1]);
    for (size_t e = 0; e < 2; ++e) {
        w->knot[e] = w->cut[e];
        for (size_t m = 1; m < knots->n; ++m)
            w->knot[2 * m + e] = k[2 * m + e];
        w->knot[2 * knots->n + e] = k[e] + 1;
        w->knot[2 * knots->n + 2 + e] = w->cut[e] + 1;
    }
    w->n_knots = knots->n + 2;
    for (size_t e = 0, base = 0; e < 2; base += w->n[e], ++e) {
        const double *const s = w->outline[e]->share;
        for (size_t v = 0; v < w->n[e]; ++v) {
            const double on = s[v + 1] - s[v];
            const double back = v > 0 ? s[v] - s[v - 1] : 1 - s[w->n[e] - 1];
            w->place[base + v] = w->cut[e] + iccp_outline_wrap(s[v] - w->cut[e]);
            w->edge[base + v] = on < back ? on : back;
            w->order[e][v] = (uint32_t)v;
        }
        iccp_sort_indices(w->order[e], w->work, w->n[e], w->place + base, is_before);
    }
}

/* Bends the pairing through all joins. Between two joins it is stretched along the target. Knots
 * next to a join are dropped. */
static void bend(iccp_merge_order *w)
{
    double *last = w->bent;
    memcpy(last, w->knot, 2 * sizeof *last);
    size_t knot = 1;
    for (size_t k = 0; k <= w->n_joins; ++k) {
        const double *const next = k < w->n_joins ? w->join[k].at : w->knot + 2 * (w->n_knots - 1);
        const double from[2] = {last[0], last[1]};
        const double image = iccp_merge_order_follow(w->knot, w->n_knots, 0, from[0]);
        const double width = iccp_merge_order_follow(w->knot, w->n_knots, 0, next[0]) - image;
        const double stretch = width > 0 ? (next[1] - from[1]) / width : 1;
        for (; knot + 1 < w->n_knots && w->knot[2 * knot] < next[0]; ++knot) {
            const double p[2] = {w->knot[2 * knot],
                                 from[1] + stretch * (w->knot[2 * knot + 1] - image)};
            if (p[0] > last[0] + clear && p[1] > last[1] + clear && p[0] < next[0] - clear &&
                p[1] < next[1] - clear)
                memcpy(last += 2, p, sizeof p);
        }
        memcpy(last += 2, next, 2 * sizeof *next);
    }
    w->n_bent = (size_t)(last - w->bent) / 2 + 1;
}

/* Lists all vertices in order. */
static void line_up(iccp_merge_order *w)
{
    memset(w->is_joined, 0, w->n[0] + w->n[1]);
    w->n_events = 0;
    for (size_t k = 0; k < w->n_joins; ++k) {
        w->event[w->n_events++] = w->join[k];
        for (size_t e = 0, base = 0; e < 2; base += w->n[e], ++e)
            if (w->join[k].vertex[e] != NONE)
                w->is_joined[base + w->join[k].vertex[e]] = 1;
    }
    for (int e = 0; e < 2; ++e)
        for (size_t v = 0; v < w->n[e]; ++v) {
            const size_t k = v + (e == 0 ? 0 : w->n[0]);
            if (w->is_joined[k])
                continue;
            iccp_event *const to = &w->event[w->n_events++];
            to->d = 0;
            to->is_fixed = true;
            to->at[e] = w->place[k];
            to->at[1 - e] = iccp_merge_order_follow(w->bent, w->n_bent, e, w->place[k]);
            to->vertex[e] = (uint32_t)v;
            to->vertex[1 - e] = NONE;
        }
    iccp_sort(w->event, w->n_events, sizeof *w->event, iccp_event_by_source);
}

/* The stretch of the edge from event k: its length in the target divided by its length in the
 * source. */
static double slope(const iccp_merge_order *w, size_t k)
{
    const iccp_event *const p = &w->event[k], *const q = &w->event[(k + 1) % w->n_events];
    const double turn = k + 1 == w->n_events ? 1 : 0;
    return (q->at[1] + turn - p->at[1]) / (q->at[0] + turn - p->at[0]);
}

/* Drops the knots at joins that are undone, because they would hold the vertices together. */
static void forget(iccp_merge_order *w)
{
    size_t n = 1, knot = 1;
    for (size_t k = 0; k < w->n_events; ++k) {
        const iccp_event *const at = &w->event[k];
        if (at->d < HUGE_VAL)
            continue;
        for (; knot + 1 < w->n_knots && w->knot[2 * knot] <= at->at[0] + clear; ++knot) {
            const double *const p = w->knot + 2 * knot;
            if (fabs(p[0] - at->at[0]) > clear || fabs(p[1] - at->at[1]) > clear)
                memmove(w->knot + 2 * n++, p, 2 * sizeof *p);
        }
    }
    memmove(w->knot + 2 * n, w->knot + 2 * knot, 2 * (w->n_knots - knot) * sizeof *w->knot);
    w->n_knots -= knot - n;
}

/* Undoes the worse of the two joins at each edge that they stretch too much. Returns true if there
 * were any. */
static bool relent(iccp_merge_order *w)
{
    bool has_any = false;
    for (size_t k = 0; k < w->n_events; ++k) {
        const double q = slope(w, k);
        if (q >= 1 / ICCP_MOST_SLOPE && q <= ICCP_MOST_SLOPE)
            continue;
        iccp_event *const a = &w->event[k], *const b = &w->event[(k + 1) % w->n_events];
        iccp_event *const worse = b->is_fixed || (!a->is_fixed && a->d >= b->d) ? a : b;
        if (!worse->is_fixed) {
            worse->d = HUGE_VAL;
            has_any = true;
        }
    }
    w->n_joins = 0;
    for (size_t k = 0; k < w->n_events; ++k) {
        const iccp_event *const at = &w->event[k];
        const bool is_pair = (at->vertex[0] != NONE && at->vertex[1] != NONE) || at->d < 0;
        if (is_pair && at->d < HUGE_VAL)
            w->join[w->n_joins++] = *at;
    }
    forget(w);
    return has_any;
}

/* Joins vertices and undoes joins until none stretches an edge too much. Outlines in
 * tests/unit/match/test_match.c need this. */
static void merge(iccp_merge_order *w)
{
    bend(w);
    line_up(w);
    while (relent(w)) {
        bend(w);
        line_up(w);
    }
}

static icc_status finish(iccp_union_outline *common, const iccp_merge_order *w,
                         const iccp_memory *memory)
{
    common->n = w->n_events;
    common->share = iccp_alloc(memory, 2 * w->n_events, sizeof *common->share);
    common->vertex = iccp_alloc(memory, 2 * w->n_events, sizeof *common->vertex);
    if (common->share == NULL || common->vertex == NULL)
        return ICC_ERR_MEMORY;
    common->least = HUGE_VAL;
    for (size_t k = 0; k < w->n_events; ++k) {
        const double q = slope(w, k);
        common->least = q < common->least ? q : common->least;
        common->most = q > common->most ? q : common->most;
        memcpy(common->share + 2 * k, w->event[k].at, 2 * sizeof(double));
        memcpy(common->vertex + 2 * k, w->event[k].vertex, 2 * sizeof(uint32_t));
        common->n_joined += w->event[k].vertex[0] != NONE && w->event[k].vertex[1] != NONE;
    }
    return ICC_OK;
}

icc_status iccp_union_outline_create(iccp_union_outline *common, const iccp_pairing_knots *knots,
                                     const iccp_outline *source, const iccp_outline *target,
                                     size_t n_landmarks, const double *landmarks, double drop,
                                     const iccp_memory *memory)
{
    *common = (iccp_union_outline){0};
    iccp_merge_order w = {.outline = {source, target}, .n = {source->n, target->n}};
    icc_status status = reserve(&w, knots->n, n_landmarks, memory);
    if (status == ICC_OK) {
        open(&w, knots);
        iccp_merge_vertices(&w, n_landmarks, landmarks, drop);
        merge(&w);
        status = finish(common, &w, memory);
    }
    release(&w, memory);
    return status;
}

void iccp_union_outline_free(iccp_union_outline *common, const iccp_memory *memory)
{
    iccp_free(memory, common->share);
    iccp_free(memory, common->vertex);
}
