/* Decides which vertices of two outlines become one: those that the pairing takes close to each
 * other. */
#include "match/outline/merge_order.h"

#include "base/sort.h"

#include <math.h>

#define NONE UINT32_MAX

/* Vertices are joined within `reach`, as a share of the shorter edge at them on both sides. They
 * are also joined if they count as one place, because an edge between them would be lost. The
 * coasts d14 and d15 have such edges. */
static const double reach = 0.3;

/* With a larger `drop`, vertices farther apart are joined. Two neighbouring joins must then not
 * stretch the piece between them by more than this factor, compared with the pairing. */
static const double most_uneven = 3;

static int by_distance(const void *a, const void *b)
{
    const iccp_event *const p = a, *const q = b;
    if (p->d != q->d)
        return p->d < q->d ? -1 : 1;
    return p->at[0] < q->at[0] ? -1 : p->at[0] > q->at[0];
}

int iccp_event_by_source(const void *a, const void *b)
{
    const iccp_event *const p = a, *const q = b;
    for (int e = 0; e < 2; ++e)
        if (p->at[e] != q->at[e])
            return p->at[e] < q->at[e] ? -1 : 1;
    return 0;
}

double iccp_merge_order_follow(const double *knot, size_t n, int from, double x)
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

/* Proposes joins: pairs of a source vertex and one of the two target vertices next to its image, if
 * close enough. */
static void propose(iccp_merge_order *w, double drop)
{
    const double *const a = w->place, *const b = w->place + w->n[0];
    const double *const edge_b = w->edge + w->n[0];
    size_t y = 0;
    for (size_t x = 0; x < w->n[0]; ++x) {
        const uint32_t i = w->order[0][x];
        const double image = iccp_merge_order_follow(w->knot, w->n_knots, 0, a[i]);
        while (y < w->n[1] && b[w->order[1][y]] < image)
            ++y;
        for (size_t k = y > 0 ? y - 1 : 0; k <= y && k < w->n[1]; ++k) {
            const uint32_t j = w->order[1][k];
            const double da = fabs(a[i] - iccp_merge_order_follow(w->knot, w->n_knots, 1, b[j]));
            const double db = fabs(b[j] - image);
            const double d = da / w->edge[i] > db / edge_b[j] ? da / w->edge[i] : db / edge_b[j];
            const bool must_join = d < reach || da < iccp_one_place || db < iccp_one_place;
            if (must_join || (da < drop && db < drop))
                w->join[w->n_joins++] =
                    (iccp_event){{a[i], b[j]}, {i, j}, must_join && d > reach ? reach : d, false};
        }
    }
}

/* Turns landmarks into joins that stay. A landmark at a vertex uses that vertex. */
static void add_landmarks(iccp_merge_order *w, size_t n, const double *landmarks)
{
    for (size_t k = 0; k < n; ++k) {
        iccp_event *const to = &w->join[w->n_joins++];
        *to = (iccp_event){.vertex = {NONE, NONE}, .d = -1, .is_fixed = true};
        for (size_t e = 0, base = 0; e < 2; base += w->n[e], ++e) {
            const double at = iccp_outline_wrap(landmarks[2 * k + e]);
            double along;
            const size_t edge = iccp_outline_edge(w->outline[e], at, &along);
            const double *const s = w->outline[e]->share;
            const size_t near = at - s[edge] <= s[edge + 1] - at ? edge : (edge + 1) % w->n[e];
            to->at[e] = w->cut[e] + iccp_outline_wrap(at - w->cut[e]);
            if (fabs(iccp_outline_wrap(at - s[near] + 0.5) - 0.5) < 1e-14) {
                to->vertex[e] = (uint32_t)near;
                to->at[e] = w->place[base + near];
            }
        }
    }
}

/* Returns true if stretch permits two successive joins together. */
static bool is_even(const iccp_merge_order *w, const iccp_event *p, const iccp_event *q)
{
    const double given = iccp_merge_order_follow(w->knot, w->n_knots, 0, q->at[0]) -
                         iccp_merge_order_follow(w->knot, w->n_knots, 0, p->at[0]);
    const double joined = q->at[1] - p->at[1];
    return (p->d <= reach && q->d <= reach) ||
           (joined <= most_uneven * given && given <= most_uneven * joined);
}

/* Returns true if the last kept join must give way to a join that follows it along the source. */
static bool gives_way(const iccp_merge_order *w, const iccp_event *last, const iccp_event *join)
{
    const bool is_in_order = join->at[1] > last->at[1];
    if (last->is_fixed)
        return false;
    return is_in_order ? !is_even(w, last, join) && last->d >= join->d : join->is_fixed;
}

static bool may_follow(const iccp_merge_order *w, const iccp_event *last, const iccp_event *join)
{
    return join->at[1] > last->at[1] && join->at[0] > last->at[0] &&
           (join->is_fixed || is_even(w, last, join));
}

/* Selects joins, the closest first, so that each vertex is used once. Then keeps those, along the
 * source, that are also in order along the target, and even. */
static void select(iccp_merge_order *w)
{
    iccp_sort(w->join, w->n_joins, sizeof *w->join, by_distance);
    size_t n = 0;
    for (size_t k = 0; k < w->n_joins; ++k) {
        const iccp_event join = w->join[k];
        bool is_free = true;
        for (size_t e = 0, base = 0; e < 2; base += w->n[e], ++e)
            is_free = is_free && (join.vertex[e] == NONE || !w->is_joined[base + join.vertex[e]]);
        for (size_t e = 0, base = 0; e < 2 && is_free; base += w->n[e], ++e)
            if (join.vertex[e] != NONE)
                w->is_joined[base + join.vertex[e]] = 1;
        if (is_free)
            w->join[n++] = join;
    }
    iccp_sort(w->join, n, sizeof *w->join, iccp_event_by_source);
    size_t kept = 0;
    for (size_t k = 0; k < n; ++k) {
        const iccp_event join = w->join[k];
        while (kept > 0 && gives_way(w, &w->join[kept - 1], &join))
            --kept;
        if (kept == 0 || may_follow(w, &w->join[kept - 1], &join))
            w->join[kept++] = join;
    }
    w->n_joins = kept;
}

void iccp_merge_vertices(iccp_merge_order *w, size_t n_landmarks, const double *landmarks,
                         double drop)
{
    add_landmarks(w, n_landmarks, landmarks);
    propose(w, drop);
    select(w);
}
