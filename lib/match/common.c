/* The union of the vertices of two outlines. Near ones join, else an edge of the one would be cut
 * as close to its end as rounding; the pairing is bent to pass through those that do, and all
 * others follow it, so that their order stays. */
#include "match/common.h"

#include "base/sort.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

/* Vertices join within this share of the shorter edge at them, on both sides, or when so near, in
 * shares of the perimeter, that an edge between them would be lost; but not where an edge would be
 * stretched by more than `limit` for it. */
static const double reach = .3, least_edge = 1e-9, limit = 1e3;

/* Knots keep away from joined vertices by so much of the perimeter. */
static const double clear = 1e-7;

typedef struct event {
    double at[2]; /* shares, unwrapped from the cut */
    uint32_t vertex[2];
    double d; /* how far, by the shorter edge, they were; less than 0: a landmark */
    bool is_fixed;
} event;

typedef struct weave {
    const iccp_outline *outline[2];
    size_t n[2];
    double cut[2]; /* where both outlines are cut open */
    double *place; /* of all vertices, source's first: shares from the cut */
    double *edge;  /* the shorter edge at each */
    uint32_t *order[2], *work;
    double *knot; /* pairs: the pairing from the cut to the cut */
    size_t n_knots;
    double *bent; /* the same through all joined vertices */
    size_t n_bent;
    event *join, *event;
    size_t n_joins, n_events;
    unsigned char *is_joined; /* of all vertices */
} weave;

static bool is_before(const void *context, uint32_t a, uint32_t b)
{
    const double *const place = context;
    return place[a] < place[b];
}

static int by_distance(const void *a, const void *b)
{
    const event *const p = a, *const q = b;
    if (p->d != q->d)
        return p->d < q->d ? -1 : 1;
    return p->at[0] < q->at[0] ? -1 : p->at[0] > q->at[0];
}

static int by_source(const void *a, const void *b)
{
    const event *const p = a, *const q = b;
    for (int e = 0; e < 2; ++e)
        if (p->at[e] != q->at[e])
            return p->at[e] < q->at[e] ? -1 : 1;
    return 0;
}

/* Where monotone knots take x on side `from`. */
static double follow(const double *knot, size_t n, int from, double x)
{
    size_t low = 0, high = n - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (knot[2 * middle + (size_t)from] <= x)
            low = middle;
        else
            high = middle;
    }
    const double *const p = knot + 2 * low, *const q = p + 2;
    const double width = q[from] - p[from];
    const double part = width > 0 ? (x - p[from]) / width : 0;
    return p[1 - from] + part * (q[1 - from] - p[1 - from]);
}

static void release(weave *w, const iccp_memory *memory)
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

static icc_status reserve(weave *w, size_t n_knots, size_t n_landmarks, const iccp_memory *memory)
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

/* Cuts the pairing open in the middle of its first piece, and the outlines with it. */
static void open(weave *w, const iccp_pairing_knots *knots)
{
    const double *const k = knots->knot;
    const double next[2] = {knots->n > 1 ? k[2] : k[0] + 1, knots->n > 1 ? k[3] : k[1] + 1};
    for (size_t e = 0; e < 2; ++e) {
        w->cut[e] = (k[e] + next[e]) / 2;
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

/* Pairs of a vertex of the source and one of the two of the target next to its image that are near
 * enough. */
static void propose(weave *w, double drop)
{
    const double *const a = w->place, *const b = w->place + w->n[0];
    const double *const edge_b = w->edge + w->n[0];
    size_t y = 0;
    for (size_t x = 0; x < w->n[0]; ++x) {
        const uint32_t i = w->order[0][x];
        const double image = follow(w->knot, w->n_knots, 0, a[i]);
        while (y < w->n[1] && b[w->order[1][y]] < image)
            ++y;
        for (size_t k = y > 0 ? y - 1 : 0; k <= y && k < w->n[1]; ++k) {
            const uint32_t j = w->order[1][k];
            const double da = fabs(a[i] - follow(w->knot, w->n_knots, 1, b[j]));
            const double db = fabs(b[j] - image);
            const double d = da / w->edge[i] > db / edge_b[j] ? da / w->edge[i] : db / edge_b[j];
            if (d < reach || da < least_edge || db < least_edge || (da < drop && db < drop))
                w->join[w->n_joins++] = (event){{a[i], b[j]}, {i, j}, d, false};
        }
    }
}

/* Landmarks become joins that stay; of vertices where there are some. */
static void add_landmarks(weave *w, size_t n, const double *landmarks)
{
    for (size_t k = 0; k < n; ++k) {
        event *const to = &w->join[w->n_joins++];
        *to = (event){.vertex = {NONE, NONE}, .d = -1, .is_fixed = true};
        for (size_t e = 0, base = 0; e < 2; base += w->n[e], ++e) {
            const double at = iccp_outline_wrap(landmarks[2 * k + e]);
            double along;
            const size_t edge = iccp_outline_edge(w->outline[e], at, &along);
            const double *const s = w->outline[e]->share;
            const size_t near = at - s[edge] <= s[edge + 1] - at ? edge : (edge + 1) % w->n[e];
            to->at[e] = w->cut[e] + iccp_outline_wrap(at - w->cut[e]);
            if (fabs(iccp_outline_wrap(at - s[near] + .5) - .5) < 1e-14) {
                to->vertex[e] = (uint32_t)near;
                to->at[e] = w->place[base + near];
            }
        }
    }
}

/* Of the proposed joins, the nearest first, those that use each vertex once; then, along the
 * source, those that are in order along the target. */
static void select(weave *w)
{
    iccp_sort(w->join, w->n_joins, sizeof *w->join, by_distance);
    size_t n = 0;
    for (size_t k = 0; k < w->n_joins; ++k) {
        const event join = w->join[k];
        bool is_free = true;
        for (size_t e = 0, base = 0; e < 2; base += w->n[e], ++e)
            is_free = is_free && (join.vertex[e] == NONE || !w->is_joined[base + join.vertex[e]]);
        for (size_t e = 0, base = 0; e < 2 && is_free; base += w->n[e], ++e)
            if (join.vertex[e] != NONE)
                w->is_joined[base + join.vertex[e]] = 1;
        if (is_free)
            w->join[n++] = join;
    }
    iccp_sort(w->join, n, sizeof *w->join, by_source);
    size_t kept = 0;
    for (size_t k = 0; k < n; ++k) {
        while (kept > 0 && w->join[k].is_fixed && !w->join[kept - 1].is_fixed &&
               w->join[k].at[1] <= w->join[kept - 1].at[1])
            --kept;
        if (kept == 0 || (w->join[k].at[1] > w->join[kept - 1].at[1] &&
                          w->join[k].at[0] > w->join[kept - 1].at[0]))
            w->join[kept++] = w->join[k];
    }
    w->n_joins = kept;
}

/* The pairing through all joins: these, and the knots between that keep away from them. */
static void bend(weave *w)
{
    double *last = w->bent;
    memcpy(last, w->knot, 2 * sizeof *last);
    size_t knot = 1;
    for (size_t k = 0; k <= w->n_joins; ++k) {
        const double *const next = k < w->n_joins ? w->join[k].at : w->knot + 2 * (w->n_knots - 1);
        for (; knot + 1 < w->n_knots && w->knot[2 * knot] < next[0]; ++knot) {
            const double *const p = w->knot + 2 * knot;
            if (p[0] > last[0] + clear && p[1] > last[1] + clear && p[0] < next[0] - clear &&
                p[1] < next[1] - clear)
                memcpy(last += 2, p, 2 * sizeof *p);
        }
        memcpy(last += 2, next, 2 * sizeof *next);
    }
    w->n_bent = (size_t)(last - w->bent) / 2 + 1;
}

/* All vertices, in order. */
static void line_up(weave *w)
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
            event *const to = &w->event[w->n_events++];
            to->d = 0;
            to->is_fixed = true;
            to->at[e] = w->place[k];
            to->at[1 - e] = follow(w->bent, w->n_bent, e, w->place[k]);
            to->vertex[e] = (uint32_t)v;
            to->vertex[1 - e] = NONE;
        }
    iccp_sort(w->event, w->n_events, sizeof *w->event, by_source);
}

/* How much longer the edge from event k is in the target. */
static double slope(const weave *w, size_t k)
{
    const event *const p = &w->event[k], *const q = &w->event[(k + 1) % w->n_events];
    const double turn = k + 1 == w->n_events ? 1 : 0;
    return (q->at[1] + turn - p->at[1]) / (q->at[0] + turn - p->at[0]);
}

/* Takes joins apart at edges that they stretch too much; whether there were any. */
static bool relent(weave *w)
{
    bool has_any = false;
    for (size_t k = 0; k < w->n_events; ++k) {
        const double q = slope(w, k);
        if (q >= 1 / limit && q <= limit)
            continue;
        event *const a = &w->event[k], *const b = &w->event[(k + 1) % w->n_events];
        event *const worse = b->is_fixed || (!a->is_fixed && a->d >= b->d) ? a : b;
        if (!worse->is_fixed) {
            worse->d = HUGE_VAL;
            has_any = true;
        }
    }
    w->n_joins = 0;
    for (size_t k = 0; k < w->n_events; ++k) {
        const event *const at = &w->event[k];
        const bool is_pair = (at->vertex[0] != NONE && at->vertex[1] != NONE) || at->d < 0;
        if (is_pair && at->d < HUGE_VAL)
            w->join[w->n_joins++] = *at;
    }
    return has_any;
}

static icc_status finish(iccp_common *common, const weave *w, const iccp_memory *memory)
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

icc_status iccp_common_create(iccp_common *common, const iccp_pairing_knots *knots,
                              const iccp_outline *source, const iccp_outline *target,
                              size_t n_landmarks, const double *landmarks, double drop,
                              const iccp_memory *memory)
{
    *common = (iccp_common){0};
    weave w = {.outline = {source, target}, .n = {source->n, target->n}};
    icc_status status = reserve(&w, knots->n, n_landmarks, memory);
    if (status == ICC_OK) {
        open(&w, knots);
        add_landmarks(&w, n_landmarks, landmarks);
        propose(&w, drop);
        select(&w);
        do {
            bend(&w);
            line_up(&w);
        } while (relent(&w));
        status = finish(common, &w, memory);
    }
    release(&w, memory);
    return status;
}

void iccp_common_free(iccp_common *common, const iccp_memory *memory)
{
    iccp_free(memory, common->share);
    iccp_free(memory, common->vertex);
}
