#include "mesh/finder.h"

#include "base/budget.h"
#include "math/predicates.h"

#include <math.h>

/* Cells that a triangle misses by less than this, in cells, list it too: the slab arithmetic below
 * is rounded. */
static const double SLACK = 1e-9;

/* Of twice a triangle's area in the products that it is the sum of: below it barycentric
 * coordinates in plain doubles would be off by more than 1e-14. */
static const double FLATTEST = 0.05;

static size_t cell_of(double x, size_t n)
{
    if (!(x > 0))
        return 0;
    return x < (double)n ? (size_t)x : n - 1;
}

static void corner_in_cells(const iccp_finder *f, uint32_t triangle, int k, double q[2])
{
    const double *p = f->points + 2 * (size_t)f->triangles[3 * (size_t)triangle + (size_t)k];
    q[0] = (p[0] - f->origin[0]) * f->rate;
    q[1] = (p[1] - f->origin[1]) * f->rate;
}

/* Widens [low, high] to the part of the segment a b with y in [bottom, bottom + 1]. */
static void clip_to_row(const double a[2], const double b[2], double bottom, double *low,
                        double *high)
{
    const double lower = fmin(a[1], b[1]), upper = fmax(a[1], b[1]);
    if (upper < bottom - SLACK || lower > bottom + 1 + SLACK)
        return;
    double x[2] = {a[0], b[0]};
    const double ends[2] = {a[1], b[1]};
    for (int k = 0; k < 2; ++k) {
        const double y = fmin(fmax(ends[k], bottom), bottom + 1);
        if (upper > lower)
            x[k] = a[0] + (b[0] - a[0]) * fmin(fmax((y - a[1]) / (b[1] - a[1]), 0), 1);
    }
    *low = fmin(*low, fmin(x[0], x[1]));
    *high = fmax(*high, fmax(x[0], x[1]));
}

/* Returns the number of cells. */
static size_t visit_triangle(iccp_finder *f, uint32_t triangle, bool fill)
{
    double q[3][2];
    for (int k = 0; k < 3; ++k)
        corner_in_cells(f, triangle, k, q[k]);
    const double bottom = fmin(fmin(q[0][1], q[1][1]), q[2][1]);
    const double top = fmax(fmax(q[0][1], q[1][1]), q[2][1]);
    const size_t last = cell_of(top + SLACK, f->size[1]);
    size_t n = 0;
    for (size_t j = cell_of(bottom - SLACK, f->size[1]); j <= last; ++j) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int k = 0; k < 3; ++k)
            clip_to_row(q[k], q[(k + 1) % 3], (double)j, &low, &high);
        if (low > high)
            continue;
        const size_t i_last = cell_of(high + SLACK, f->size[0]);
        for (size_t i = cell_of(low - SLACK, f->size[0]); i <= i_last; ++i, ++n) {
            const size_t cell = i + f->size[0] * j;
            if (fill)
                f->entries[--f->first[cell]] = triangle;
            else
                ++f->first[cell];
        }
    }
    return n;
}

/* Cells per triangle: more make queries faster and the finder larger. */
static const double DENSITY = 4;

/* Entries per triangle that need no budget: two to five times what there are in fair meshes. */
enum { PLENTY = 64 };

static void choose_cells(iccp_finder *f, const iccp_planar *mesh)
{
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t v = 0; v < mesh->n_vertices; ++v)
        for (int k = 0; k < 2; ++k) {
            lower[k] = fmin(lower[k], f->points[2 * v + (size_t)k]);
            upper[k] = fmax(upper[k], f->points[2 * v + (size_t)k]);
        }
    const double width = upper[0] - lower[0], height = upper[1] - lower[1];
    const double longest = fmax(width, height);
    const double area = fmax(width * height, longest * longest / (double)mesh->n_triangles);
    f->rate = sqrt(DENSITY * (double)mesh->n_triangles / area);
    f->size[0] = (size_t)(width * f->rate) + 1;
    f->size[1] = (size_t)(height * f->rate) + 1;
    f->origin[0] = lower[0];
    f->origin[1] = lower[1];
}

/* Two passes over the triangles: the first counts the entries of each cell, the second,
 * backwards, fills them in, which moves `first` from the ends of the cells to where they begin. */
icc_status iccp_finder_create(iccp_finder *finder, const iccp_planar *mesh, const double *points,
                              const iccp_env *env)
{
    iccp_finder *f = finder;
    *f = (iccp_finder){.memory = env->memory, .points = points, .triangles = mesh->triangles};
    choose_cells(f, mesh);
    const size_t n_cells = f->size[0] * f->size[1];
    f->first = iccp_alloc_zero(&f->memory, n_cells + 1, sizeof *f->first);
    if (f->first == NULL)
        return ICC_ERR_MEMORY;
    size_t n_entries = 0;
    icc_status status = ICC_OK;
    for (uint32_t t = 0; t < mesh->n_triangles && status == ICC_OK; ++t) {
        n_entries += visit_triangle(f, t, false);
        if (n_entries > PLENTY * mesh->n_triangles)
            status = iccp_budget_borrow(env, (double)n_entries * sizeof *f->entries);
    }
    if (status != ICC_OK) {
        iccp_finder_free(f);
        return status;
    }
    for (size_t c = 1; c <= n_cells; ++c)
        f->first[c] += f->first[c - 1];
    f->entries = iccp_alloc(&f->memory, f->first[n_cells], sizeof *f->entries);
    if (f->entries == NULL) {
        iccp_finder_free(f);
        return ICC_ERR_MEMORY;
    }
    for (uint32_t t = (uint32_t)mesh->n_triangles; t-- > 0;)
        (void)visit_triangle(f, t, true);
    return ICC_OK;
}

void iccp_finder_free(iccp_finder *finder)
{
    iccp_free(&finder->memory, finder->first);
    iccp_free(&finder->memory, finder->entries);
    *finder = (iccp_finder){.memory = finder->memory};
}

/* Of the sum of magnitudes: the rounding of an area's differences, products and their difference
 * stays below it, so that beyond it the sign is right. */
static const double CERTAIN = 1e-15;

/* The doubtful case: p is next to an edge, or the triangle is flat. */
static bool holds_exactly(const double *const q[3], const double p[2], double bary[3])
{
    for (int k = 0; k < 3; ++k)
        if (iccp_orient2d(q[(k + 1) % 3], q[(k + 2) % 3], p) < 0)
            return false;
    for (int k = 0; k < 3; ++k)
        bary[k] = fmax(iccp_area2d(q[(k + 1) % 3], q[(k + 2) % 3], p), 0);
    return bary[0] + bary[1] + bary[2] > 0;
}

/* Whether the triangle holds p, exactly; then `bary` are the areas that p makes with its edges. All
 * three are computed before anything is decided: one branch that is hard to predict, not three. */
static bool holds(const iccp_finder *f, uint32_t triangle, const double p[2], double bary[3])
{
    const uint32_t *v = f->triangles + 3 * (size_t)triangle;
    const double *const q[3] = {f->points + 2 * (size_t)v[0], f->points + 2 * (size_t)v[1],
                                f->points + 2 * (size_t)v[2]};
    const double ax = q[0][0] - p[0], ay = q[0][1] - p[1], bx = q[1][0] - p[0];
    const double by = q[1][1] - p[1], cx = q[2][0] - p[0], cy = q[2][1] - p[1];
    const double bc = bx * cy, cb = by * cx, ca = cx * ay, ac = cy * ax, ab = ax * by, ba = ay * bx;
    const double size = fabs(bc) + fabs(cb) + fabs(ca) + fabs(ac) + fabs(ab) + fabs(ba);
    bary[0] = bc - cb;
    bary[1] = ca - ac;
    bary[2] = ab - ba;
    const double least01 = bary[0] < bary[1] ? bary[0] : bary[1];
    const double least = least01 < bary[2] ? least01 : bary[2];
    if (least < -CERTAIN * size)
        return false;
    if (least > CERTAIN * size && bary[0] + bary[1] + bary[2] > FLATTEST * size)
        return true;
    return holds_exactly(q, p, bary);
}

bool iccp_finder_find(const iccp_finder *finder, const double p[2], uint32_t *triangle,
                      double bary[3])
{
    const size_t i = cell_of((p[0] - finder->origin[0]) * finder->rate, finder->size[0]);
    const size_t j = cell_of((p[1] - finder->origin[1]) * finder->rate, finder->size[1]);
    const size_t cell = i + finder->size[0] * j;
    for (size_t e = finder->first[cell]; e < finder->first[cell + 1]; ++e)
        if (holds(finder, finder->entries[e], p, bary)) {
            const double scale = 1 / (bary[0] + bary[1] + bary[2]);
            for (int k = 0; k < 3; ++k)
                bary[k] *= scale;
            *triangle = finder->entries[e];
            return true;
        }
    return false;
}
