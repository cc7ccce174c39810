/* Incidence of masks, in whole numbers. Source: docs/theory/charts-space.md, "fields on grids",
 * step 4.
 *
 * A facet of a mask's boundary follows an order of all axes but one, like the simplices of the
 * grid. It takes a number of grid steps on each of these axes (domain/mask_boundary.c). So each
 * boundary vertex of the grid is examined once, instead of each pair of a facet and a simplex. */
#include "field/incidence_mask.h"

#include "base/minmax.h"
#include "domain/mask.h"

#include <math.h>
#include <string.h>

enum { FACETS_PER_REPORT = 1 << 12 };

/* A number closer than this to a whole number counts as whole (lattice units). */
static const double ROUNDING = 1e-9;

/* The mask in lattice coordinates. */
typedef struct layout {
    iccp_incidence *incidence;
    const iccp_orders *orders;
    int64_t first[ICC_MAX_DIM]; /* lattice coordinates of the mask's lowest corner */
    int64_t half;               /* grid steps in half a cell of the mask */
    uint32_t *count;            /* by vertex: the number of facets that it lies in, then the
                                   position of the next note */
} layout;

/* A facet as a chain of steps: from its lowest corner along each of the axes in turn. */
typedef struct chain {
    uint32_t lowest;
    int8_t axis[ICC_MAX_DIM];
    int32_t normal_axis;
} chain;

static bool is_whole(double x)
{
    return fabs(x - round(x)) < ROUNDING;
}

/* Finds where the mask lies in the lattice. Half a cell must be a whole number of grid steps,
 * and the mask's corner a lattice point. A layer of the grid must lie beyond the mask on all
 * sides. Otherwise it returns false. */
static bool find_layout(layout *l)
{
    const icc_grid *grid = l->incidence->grid;
    const icc_domain *domain = l->incidence->domain;
    if (domain->mask == NULL)
        return false;
    const double half = 0.5 * domain->frame.in[0] * domain->frame.in[1] / grid->spacing;
    const double zero[ICC_MAX_DIM] = {0};
    double corner[ICC_MAX_DIM];
    iccp_frame_in(&domain->frame, grid->dim, zero, corner);
    l->half = (int64_t)round(half);
    bool fits = is_whole(half) && l->half >= 1;
    for (int32_t k = 0; fits && k < grid->dim; ++k) {
        const double first = (corner[k] - grid->origin[k]) / grid->spacing;
        l->first[k] = (int64_t)round(first);
        fits = is_whole(first) && l->first[k] >= 1 &&
               l->first[k] + 2 * l->half * (int64_t)domain->mask->shape[k] + 2 <=
                   (int64_t)grid->shape[k];
    }
    return fits;
}

/* Returns true if the cell of the grid with this lowest corner lies in the mask. */
static bool is_solid(const layout *l, uint32_t lowest)
{
    const iccp_mask *mask = l->incidence->domain->mask;
    size_t cell = 0;
    for (int32_t k = 0; k < mask->dim; ++k) {
        const int64_t at =
            (int64_t)iccp_grid_coordinate(l->incidence->grid, lowest, k) - l->first[k];
        if (at < 0 || at >= 2 * l->half * (int64_t)mask->shape[k])
            return false;
        cell += mask->stride[k] * (size_t)(1 + at / (2 * l->half));
    }
    return mask->cells[cell];
}

/* Loads a facet, whose corners come in any order. The more corners are high along an axis, the
 * earlier the chain takes that axis. */
static void load_chain(const layout *l, uint32_t facet, chain *c)
{
    const icc_grid *grid = l->incidence->grid;
    const icc_domain *domain = l->incidence->domain;
    const int32_t dim = grid->dim;
    c->lowest = 0;
    c->normal_axis = 0;
    for (int32_t k = 0; k < dim; ++k) {
        double least = HUGE_VAL, most = -HUGE_VAL, sum = 0;
        for (int32_t i = 0; i < dim; ++i) {
            const size_t v = domain->facets[(size_t)dim * facet + (size_t)i];
            const double x = round(
                (domain->vertices[(size_t)dim * v + (size_t)k] - grid->origin[k]) / grid->spacing);
            least = iccp_min(least, x);
            most = iccp_max(most, x);
            sum += x;
        }
        c->lowest += (uint32_t)(least * (double)grid->stride[k]);
        const int64_t n_high = (int64_t)(sum - dim * least) / l->half;
        if (most > least)
            c->axis[dim - 1 - n_high] = (int8_t)k;
        else
            c->normal_axis = k;
    }
}

/* Goes to the next lattice point of a facet. A point is given by steps along the facet's axes:
 * numbers from 0 to `half` that never increase. */
static bool next_point(int32_t n, int64_t half, int64_t *step)
{
    int32_t i = n - 1;
    while (i >= 0 && step[i] == (i > 0 ? step[i - 1] : half))
        --i;
    if (i < 0)
        return false;
    ++step[i];
    for (int32_t j = i + 1; j < n; ++j)
        step[j] = 0;
    return true;
}

static uint32_t point_of(const layout *l, const chain *c, const int64_t *step)
{
    const icc_grid *grid = l->incidence->grid;
    size_t v = c->lowest;
    for (int32_t i = 0; i + 1 < grid->dim; ++i)
        v += (size_t)step[i] * grid->stride[c->axis[i]];
    return (uint32_t)v;
}

static void count_facet(layout *l, uint32_t facet)
{
    const int32_t dim = l->incidence->grid->dim;
    double *normal = l->incidence->normal + (size_t)dim * facet;
    int64_t step[ICC_MAX_DIM] = {0};
    chain c;
    load_chain(l, facet, &c);
    for (int32_t k = 0; k < dim; ++k)
        normal[k] = 0;
    normal[c.normal_axis] = is_solid(l, c.lowest) ? 1 : -1;
    do
        ++l->count[point_of(l, &c, step)];
    while (next_point(dim - 1, l->half, step));
}

static void note_facet(layout *l, uint32_t facet)
{
    int64_t step[ICC_MAX_DIM] = {0};
    chain c;
    load_chain(l, facet, &c);
    do {
        const uint32_t v = point_of(l, &c, step);
        if (l->incidence->first[v] < l->incidence->first[v + 1])
            l->incidence->facet[l->count[v]++] = facet;
    } while (next_point(l->incidence->grid->dim - 1, l->half, step));
}

/* The lowest corner of the simplex with order r whose corner k is the vertex. `*any_inside`
 * tells whether a corner of it is inside. */
static uint32_t lowest_of(const layout *l, uint32_t v, int32_t r, int32_t k, bool *any_inside)
{
    const icc_grid *grid = l->incidence->grid;
    const int8_t *axis = l->orders->axis[r];
    uint32_t lowest = v;
    for (int32_t i = 0; i < k; ++i)
        lowest -= (uint32_t)grid->stride[axis[i]];
    uint32_t corner = lowest;
    *any_inside = grid->inside[corner];
    for (int32_t i = 0; i < grid->dim; ++i) {
        corner += (uint32_t)grid->stride[axis[i]];
        *any_inside = *any_inside || grid->inside[corner];
    }
    return lowest;
}

/* Notes the simplices at a boundary vertex, and their faces at it. Returns true if one of them
 * meets the domain. */
static bool mark_star(const layout *l, uint32_t v)
{
    const int32_t dim = l->incidence->grid->dim;
    bool met = false;
    for (int32_t r = 0; r < l->orders->n; ++r)
        for (int32_t k = 0; k <= dim; ++k) {
            bool active;
            const uint32_t lowest = lowest_of(l, v, r, k, &active);
            if (!active && !is_solid(l, lowest))
                continue;
            met = true;
            l->incidence->bits[lowest] |= (uint32_t)1 << (r % 32);
            for (int32_t i = 0; i <= dim; ++i)
                if (i != k)
                    l->incidence->faces[lowest] |= iccp_incidence_face_bit(dim, r, i);
        }
    return met;
}

static icc_status visit(layout *l, void (*visit_facet)(layout *l, uint32_t facet), double share,
                        const iccp_env *env)
{
    const size_t n = l->incidence->domain->n_facets;
    icc_status status = ICC_OK;
    for (size_t f = 0; status == ICC_OK && f < n; ++f) {
        if (f % FACETS_PER_REPORT == 0)
            status = iccp_progress(env, "grid", 0.5 * (double)f / (double)n + share);
        visit_facet(l, (uint32_t)f);
    }
    return status;
}

bool iccp_incidence_fits_mask(const iccp_incidence *incidence)
{
    layout l = {.incidence = (iccp_incidence *)incidence};
    return find_layout(&l);
}

icc_status iccp_incidence_mask(iccp_incidence *incidence, const iccp_orders *orders,
                               const iccp_env *env)
{
    const size_t n = incidence->grid->n_vertices;
    layout l = {.incidence = incidence, .orders = orders};
    (void)find_layout(&l);
    l.count = iccp_alloc_zero(&env->memory, n, sizeof *l.count);
    if (l.count == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = visit(&l, count_facet, 0, env);
    for (uint32_t v = 0; status == ICC_OK && v < n; ++v)
        if (l.count[v] > 0 && !mark_star(&l, v))
            l.count[v] = 0;
    if (status == ICC_OK)
        status = iccp_incidence_make_room(incidence, l.count);
    if (status == ICC_OK)
        status = visit(&l, note_facet, 0.5, env);
    iccp_free(&env->memory, l.count);
    return status;
}
