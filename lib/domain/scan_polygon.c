/* Scan conversion of a polygon by the parity rule: all edges first, then all rows.
 *
 * Where an edge crosses a row, it toggles the first point beyond it. Adding up the toggles along
 * the row tells which points are inside. Edges are half open, so a row through a polygon vertex
 * counts its two edges once or as a pair. Points on an edge are marked separately, because they are
 * outside. */
#include "domain/scan_polygon.h"

#include "base/minmax.h"
#include "domain/network.h"
#include "math/predicates.h"

#include <math.h>

enum { TOGGLE = 1, ON_EDGE = 2 };

typedef struct work {
    const iccp_raster *raster;
    uint8_t *inside;
} work;

static double position(const work *w, int k, size_t i)
{
    return w->raster->origin[k] + w->raster->spacing * (double)i;
}

/* Returns the first index whose position is at least x. Rounding moves the estimate only by a
 * few. */
static size_t first_from(const work *w, int k, double x)
{
    const double estimate = floor((x - w->raster->origin[k]) / w->raster->spacing);
    size_t i = estimate > 0.0 ? (size_t)estimate : 0;
    while (i > 0 && position(w, k, i - 1) >= x)
        --i;
    while (position(w, k, i) < x)
        ++i;
    return i;
}

static uint8_t *row(const work *w, size_t j)
{
    return w->inside + w->raster->shape[0] * j;
}

static void mark_horizontal(const work *w, const double *a, const double *b)
{
    const size_t j = first_from(w, 1, a[1]);
    if (position(w, 1, j) > a[1])
        return;
    const double end = iccp_max(a[0], b[0]);
    for (size_t i = first_from(w, 0, iccp_min(a[0], b[0])); position(w, 0, i) <= end; ++i)
        row(w, j)[i] |= ON_EDGE;
}

/* Finds the first vertex of row j on the right of the edge that rises from a to b. */
static void mark_crossing(const work *w, size_t j, const double *a, const double *b)
{
    double p[2] = {0.0, position(w, 1, j)};
    const double x = a[0] + (b[0] - a[0]) * ((p[1] - a[1]) / (b[1] - a[1]));
    size_t i = first_from(w, 0, iccp_max(iccp_min(a[0], b[0]), iccp_min(x, iccp_max(a[0], b[0]))));
    for (; i > 0; --i) {
        p[0] = position(w, 0, i - 1);
        if (iccp_orient2d(a, b, p) > 0)
            break;
    }
    int side = 0;
    for (;; ++i) {
        p[0] = position(w, 0, i);
        side = iccp_orient2d(a, b, p);
        if (side < 0)
            break;
        if (side == 0)
            row(w, j)[i] |= ON_EDGE;
    }
    if (p[1] < b[1])
        row(w, j)[i] ^= TOGGLE;
}

/* Follows each edge upwards through the rows from its lower to its upper end, which is excluded for
 * toggles. The work is the number of crossings, so progress counts these, not edges. */
static icc_status mark_edges(const work *w, const icc_domain *domain, const iccp_env *env)
{
    const iccp_network *network = iccp_network_of(domain);
    size_t n_crossings = 0, next_report = 0;
    for (size_t e = 0; e < domain->n_facets; ++e) {
        if (network != NULL && !iccp_network_is_rim(network, (uint32_t)e))
            continue;
        if (n_crossings >= next_report) {
            const double share = 0.5 * (double)e / (double)domain->n_facets;
            if (iccp_progress(env, "grid", share) != ICC_OK)
                return ICC_ERR_CANCELLED;
            next_report = n_crossings + ICCP_VERTICES_PER_REPORT;
        }
        const double *a = domain->vertices + 2 * (size_t)domain->facets[2 * e];
        const double *b = domain->vertices + 2 * (size_t)domain->facets[2 * e + 1];
        if (a[1] > b[1]) {
            const double *lower = b;
            b = a;
            a = lower;
        }
        if (a[1] < b[1])
            for (size_t j = first_from(w, 1, a[1]); position(w, 1, j) <= b[1]; ++j)
                mark_crossing(w, j, a, b);
        else
            mark_horizontal(w, a, b);
        n_crossings += 1 + (size_t)((b[1] - a[1]) / w->raster->spacing);
    }
    return ICC_OK;
}

static icc_status fill_rows(const work *w, size_t *n_inside, const iccp_env *env)
{
    const size_t n = w->raster->shape[0], n_rows = w->raster->shape[1];
    size_t next_report = 0, count = 0;
    for (size_t j = 0; j < n_rows; ++j) {
        uint8_t *at = row(w, j);
        if (j * n >= next_report) {
            const double share = 0.5 + 0.5 * (double)j / (double)n_rows;
            if (iccp_progress(env, "grid", share) != ICC_OK)
                return ICC_ERR_CANCELLED;
            next_report += ICCP_VERTICES_PER_REPORT;
        }
        uint8_t parity = 0;
        for (size_t i = 0; i < n; ++i) {
            parity ^= at[i] & TOGGLE;
            at[i] = parity && !(at[i] & ON_EDGE);
            count += at[i];
        }
    }
    *n_inside = count;
    return ICC_OK;
}

icc_status iccp_scan_polygon(const icc_domain *polygon, const iccp_raster *raster, uint8_t *inside,
                             size_t *n_inside, const iccp_env *env)
{
    const work w = {raster, inside};
    const icc_status status = mark_edges(&w, polygon, env);
    return status == ICC_OK ? fill_rows(&w, n_inside, env) : status;
}
