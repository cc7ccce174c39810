/* Finds compression and expansion facets. Based on: L. Huynh, Bijective Deformations in R^n via
 * Integral Curve Coordinates, thesis, 2013, chapter 5 and section 6.4, which have the edges of the
 * plane.
 *
 * The function is linear on each simplex. So the exact sign of one second difference decides to
 * which side of a facet the gradient of a simplex points. Walks decide by the same sign
 * (gradient/trace/walkn.c). */
#include "gradient/function/merging.h"

#include "gradient/grid/kuhn_facets.h"
#include "gradient/grid/kuhn_simplex.h"

#include <math.h>

typedef struct scan {
    const icc_function *function;
    iccp_kuhn_facets all;
    size_t capacity;
    uint32_t *facets;
    int32_t *kinds;
    iccp_facet_count count;
} scan;

/* The vertices around one vertex, by slot: kuhn_facets.h. */
typedef struct surroundings {
    uint32_t vertex[(1 << ICC_MAX_DIM) + ICC_MAX_DIM];
    bool valid[(1 << ICC_MAX_DIM) + ICC_MAX_DIM], inside[(1 << ICC_MAX_DIM) + ICC_MAX_DIM];
    uint64_t valid_corners, inside_corners; /* of the cell, as in iccp_kuhn_facets */
} surroundings;

static void set_slot(surroundings *near, const icc_function *function, int slot, uint32_t v)
{
    near->vertex[slot] = v;
    near->valid[slot] = v != ICCP_NONE && !isnan(function->values[v]);
    near->inside[slot] = near->valid[slot] && function->tree->grid->inside[v];
}

/* Returns false if no facet has this lowest corner. */
static bool look_around(surroundings *near, const icc_function *function, uint32_t v)
{
    const icc_grid *grid = function->tree->grid;
    if (isnan(function->values[v]))
        return false;
    for (int32_t k = 0; k < grid->dim; ++k) {
        const uint32_t at = iccp_grid_coordinate(grid, v, k);
        if (at + 1 == grid->shape[k])
            return false;
        set_slot(near, function, (1 << grid->dim) + k,
                 at > 0 ? v - (uint32_t)grid->stride[k] : ICCP_NONE);
    }
    near->valid_corners = near->inside_corners = 0;
    for (int c = 0, highest = 0; c < 1 << grid->dim; ++c) {
        highest += c >> (highest + 1) & 1;
        const uint32_t low = c > 0 ? near->vertex[c & ~(1 << highest)] : v;
        set_slot(near, function, c, c > 0 ? low + (uint32_t)grid->stride[highest] : v);
        near->valid_corners |= (uint64_t)near->valid[c] << c;
        near->inside_corners |= (uint64_t)near->inside[c] << c;
    }
    return true;
}

/* Returns +1 if the gradient on that side of these facets points away from them, -1 if it points to
 * them. */
static int away(const scan *s, const iccp_facet_group *group, const surroundings *near, int side)
{
    const uint32_t v[3] = {near->vertex[group->before[side]], near->vertex[group->apex[side]],
                           near->vertex[group->after[side]]};
    double f[3];
    iccp_function_local(s->function, 3, v, f);
    return iccp_kuhn_leads_away(f[0], f[1], f[2]);
}

static void record(scan *s, uint64_t facet, const surroundings *near, int32_t kind)
{
    const size_t n = s->count.n_compression + s->count.n_expansion;
    if (n < s->capacity) {
        uint32_t *corner = s->facets + n * (size_t)s->function->tree->grid->dim;
        for (int c = 0; c < 1 << s->function->tree->grid->dim; ++c)
            if (facet >> c & 1)
                *corner++ = near->vertex[c];
        s->kinds[n] = kind;
    }
    s->count.n_compression += kind == ICC_EDGE_COMPRESSION;
    s->count.n_expansion += kind == ICC_EDGE_EXPANSION;
}

/* Looks at facets with the same apexes, all of which have the same kind. */
static void look_at(scan *s, const iccp_facet_group *group, const surroundings *near)
{
    if (!near->valid[group->apex[0]] || !near->valid[group->apex[1]])
        return;
    const bool any_inside = near->inside[group->apex[0]] || near->inside[group->apex[1]];
    const uint64_t missing = ~near->valid_corners;
    int32_t kind = -1;
    for (size_t i = group->first; i < group->end; ++i) {
        const uint64_t facet = s->all.facet[i];
        if ((facet & missing) != 0 || !(any_inside || (facet & near->inside_corners) != 0))
            continue;
        ++s->count.n_tested;
        if (kind < 0) {
            const int sign = away(s, group, near, 0);
            const bool both = sign != 0 && sign == away(s, group, near, 1);
            kind = !both ? 0 : sign < 0 ? ICC_EDGE_COMPRESSION : ICC_EDGE_EXPANSION;
        }
        if (kind > 0)
            record(s, facet, near, kind);
    }
}

icc_status iccp_function_facets(const icc_function *function, size_t capacity, uint32_t *facets,
                                int32_t *kinds, iccp_facet_count *count, const iccp_env *env)
{
    const icc_grid *grid = function->tree->grid;
    scan s = {.function = function, .capacity = capacity, .facets = facets, .kinds = kinds};
    surroundings near;
    icc_status status = iccp_kuhn_facets_create(&s.all, grid->dim, &env->memory);
    for (size_t v = 0; v < grid->n_vertices && status == ICC_OK; ++v) {
        if (v % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "check", (double)v / (double)grid->n_vertices);
        if (!look_around(&near, function, (uint32_t)v))
            continue;
        for (size_t g = 0; g < s.all.n_groups; ++g)
            look_at(&s, &s.all.group[g], &near);
    }
    iccp_kuhn_facets_free(&s.all, &env->memory);
    *count = s.count;
    return status;
}
