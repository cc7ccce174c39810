/* Finds the points of a raster inside a surface: parity along its rows, then a closer look at the
 * points next to a facet.
 *
 * The place where a row crosses the boundary is rounded, and a row that runs in a facet is moved
 * aside by an infinitesimal. So parity means nothing for a point in a facet, or so near to one
 * that rounding matters. These points are found facet by facet and located exactly. */
#include "domain/scan_surface.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "domain/tree_cross.h"
#include "domain/tree_locate.h"
#include "geometry/simplex.h"

#include <assert.h>
#include <math.h>

enum {
    MOST_CROSSINGS = 256
}; /* Crossings of a row. If there are more, its points are located one by one. */

static const size_t ROWS_PER_CHUNK = 64, FACETS_PER_REPORT = 1 << 10;

/* Points within this distance of a facet are located, in units of the bounding box's longest
 * side. The distance of a crossing from the facet's plane has an error of a few units of rounding,
 * 1e-16. */
static const double NEAR = 1e-12;

typedef struct work {
    const icc_domain *domain;
    const iccp_raster *raster;
    size_t stride[ICC_MAX_DIM];
    uint8_t *inside;
} work;

static void position(const work *w, uint32_t v, double *p)
{
    for (int32_t k = 0; k < w->domain->dim; ++k) {
        const uint32_t i = v / (uint32_t)w->stride[k] % (uint32_t)w->raster->shape[k];
        p[k] = w->raster->origin[k] + w->raster->spacing * i;
    }
}

static uint8_t locate(const work *w, uint32_t v)
{
    double p[ICC_MAX_DIM];
    position(w, v, p);
    return iccp_tree_locate(w->domain, p, false, NULL, NULL) == ICC_INSIDE;
}

static void scan_row(const work *w, uint32_t first)
{
    const iccp_raster *raster = w->raster;
    iccp_line_crossing crossings[MOST_CROSSINGS];
    double p[ICC_MAX_DIM];
    position(w, first, p);
    const size_t n = iccp_tree_line(w->domain, 0, p, MOST_CROSSINGS, crossings);
    const bool usable = n <= MOST_CROSSINGS && n % 2 == 0;
    size_t n_passed = 0;
    for (uint32_t i = 0; i < raster->shape[0]; ++i) {
        const double x = raster->origin[0] + raster->spacing * i;
        while (usable && n_passed < n && crossings[n_passed].at < x)
            ++n_passed;
        w->inside[first + i] = usable ? n_passed % 2 : locate(w, first + i);
    }
}

static icc_status scan_rows(void *argument, size_t begin, size_t end)
{
    const work *w = argument;
    for (size_t row = begin; row < end; ++row)
        scan_row(w, (uint32_t)(row * w->raster->shape[0]));
    return ICC_OK;
}

/* Finds the points in a facet's bounding box, enlarged by `near`: the first one, and the number
 * along each axis. Returns false if there are none. */
static bool find_range(const work *w, uint32_t facet, double near, size_t *first, size_t *n)
{
    const iccp_raster *raster = w->raster;
    const size_t dim = w->domain->tree.dim;
    double box[2 * ICC_MAX_DIM];
    iccp_facet_box(&w->domain->tree, facet, box);
    for (size_t k = 0; k < dim; ++k) {
        const double low = (box[k] - near - raster->origin[k]) / raster->spacing;
        const double high = (box[dim + k] + near - raster->origin[k]) / raster->spacing;
        if (floor(high) < ceil(low))
            return false;
        first[k] = (size_t)ceil(low);
        n[k] = (size_t)(floor(high) - ceil(low)) + 1;
        assert(first[k] + n[k] <= raster->shape[k]);
    }
    return true;
}

/* Decides again about the points within `near` of a facet. The odometer at[] visits the points
 * of the enlarged box. Few of them are near enough to be located, which costs most. */
static void locate_near_facet(const work *w, uint32_t facet, double near)
{
    const size_t dim = w->domain->tree.dim;
    const double *corners[ICC_MAX_DIM];
    size_t first[ICC_MAX_DIM], n[ICC_MAX_DIM], at[ICC_MAX_DIM] = {0};
    if (!find_range(w, facet, near, first, n))
        return;
    iccp_facet_corners(&w->domain->tree, facet, corners);
    for (;;) {
        double p[ICC_MAX_DIM], bary[ICC_MAX_DIM];
        uint32_t v = 0;
        for (size_t k = 0; k < dim; ++k)
            v += (uint32_t)((first[k] + at[k]) * w->stride[k]);
        position(w, v, p);
        if (iccp_simplex_nearest(dim, dim, corners, p, bary) <= near * near)
            w->inside[v] = locate(w, v);
        size_t k = 0;
        while (k < dim && ++at[k] == n[k])
            at[k++] = 0;
        if (k == dim)
            return;
    }
}

static icc_status locate_near_facets(const work *w, const iccp_env *env)
{
    const icc_domain *domain = w->domain;
    double longest = 0;
    for (int32_t k = 0; k < domain->dim; ++k)
        longest = iccp_max(longest, domain->upper[k] - domain->lower[k]);
    for (uint32_t f = 0; f < domain->n_facets; ++f) {
        if (f % FACETS_PER_REPORT == 0 &&
            iccp_progress(env, "grid", (double)f / (double)domain->n_facets) != ICC_OK)
            return ICC_ERR_CANCELLED;
        locate_near_facet(w, f, NEAR * longest);
    }
    return ICC_OK;
}

icc_status iccp_scan_surface(const icc_domain *domain, const iccp_raster *raster, uint8_t *inside,
                             size_t *n_inside, const iccp_env *env)
{
    work w = {.domain = domain, .raster = raster, .inside = inside};
    size_t n = 1;
    for (int32_t k = 0; k < domain->dim; n *= raster->shape[k++])
        w.stride[k] = n;
    icc_status status =
        iccp_for_chunks(env, "grid", n / raster->shape[0], ROWS_PER_CHUNK, scan_rows, &w);
    if (status == ICC_OK)
        status = locate_near_facets(&w, env);
    *n_inside = 0;
    for (size_t v = 0; v < n && status == ICC_OK; ++v)
        *n_inside += inside[v];
    return status;
}
