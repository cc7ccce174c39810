/* Makes what a comparison needs of two regions. */
#include "map/topology/region_pair.h"

#include "base/error.h"

#include <string.h>

static icc_status find_edges(iccp_region_pair *pair, int k, icc_error *err)
{
    const iccp_region_surface *surface = &pair->surface;
    pair->at[k] = iccp_alloc(&pair->memory, surface->n_edges, sizeof *pair->at[k]);
    if (pair->at[k] == NULL)
        return iccp_fail_memory(err);
    for (size_t e = 0; e < surface->n_edges; ++e) {
        const uint32_t *ends = surface->ends + 2 * e;
        const size_t edge = iccp_region_edge(&pair->cells[k], ends[0], ends[1]);
        if (edge == pair->cells[k].n_edges)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, ends[0],
                                "vertices %lu and %lu are joined by an edge of the source's "
                                "surface only",
                                (unsigned long)ends[0], (unsigned long)ends[1]);
        pair->at[k][e] = (uint32_t)edge;
    }
    return ICC_OK;
}

/* Sums a class along the tree, from the roots to all vertices, and then along the loops. */
static void add_periods(const iccp_region_pair *pair, int k, size_t c, const uint64_t *value,
                        uint64_t *sum)
{
    const iccp_region_surface *s = &pair->surface;
    for (size_t i = 0; i < s->n_tree; ++i) {
        const uint32_t v = s->tree[i], e = s->parent[v];
        sum[v] = 0;
        if (e == ICCP_OUTSIDE)
            continue;
        const uint32_t from =
            s->ends[2 * (size_t)e] == v ? s->ends[2 * (size_t)e + 1] : s->ends[2 * (size_t)e];
        sum[v] = iccp_residue_add(sum[from], iccp_class_along(value, s->ends, e, from));
    }
    for (size_t l = 0; l < iccp_surface_n_loops(s); ++l) {
        const uint32_t e = s->loops[l], *ends = s->ends + 2 * (size_t)e;
        pair->periods[k][pair->classes[k].n * l + c] =
            iccp_residue_subtract(iccp_residue_add(sum[ends[0]], value[e]), sum[ends[1]]);
    }
}

static icc_status find_periods(iccp_region_pair *pair, int k, const iccp_env *env)
{
    const iccp_memory *memory = &pair->memory;
    const size_t n = pair->classes[k].n, n_loops = iccp_surface_n_loops(&pair->surface);
    uint64_t *unit = iccp_alloc_zero(memory, n, sizeof *unit);
    uint64_t *value = iccp_alloc(memory, pair->surface.n_edges, sizeof *value);
    uint64_t *sum = iccp_alloc(memory, pair->surface.n_vertices, sizeof *sum);
    icc_status status = ICC_ERR_MEMORY;
    pair->periods[k] = iccp_alloc(memory, n * n_loops, sizeof *pair->periods[k]);
    if (unit != NULL && value != NULL && sum != NULL && pair->periods[k] != NULL)
        status = ICC_OK;
    for (size_t c = 0; c < n && status == ICC_OK; ++c) {
        unit[c] = 1;
        iccp_region_pair_class(pair, k, unit, value);
        unit[c] = 0;
        add_periods(pair, k, c, value, sum);
        status = iccp_progress(env, "check", (double)c / (double)n);
    }
    iccp_free(memory, unit);
    iccp_free(memory, value);
    iccp_free(memory, sum);
    return status;
}

static icc_status make_side(iccp_region_pair *pair, int k, const iccp_region *region,
                            const iccp_env *env, icc_error *err)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = iccp_region_cells_create(&pair->cells[k], region, &pair->memory);
    if (status == ICC_OK)
        status = iccp_region_classes_create(&pair->classes[k], &pair->cells[k], &part[0]);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    status = find_edges(pair, k, err);
    return status != ICC_OK ? status : iccp_explain(err, find_periods(pair, k, &part[1]));
}

icc_status iccp_region_pair_create(iccp_region_pair *pair, const iccp_region regions[2],
                                   const iccp_env *env, icc_error *err)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    memset(pair, 0, sizeof *pair);
    pair->memory = env->memory;
    icc_status status =
        iccp_explain(err, iccp_region_surface_create(&pair->surface, &regions[0], &env->memory));
    const bool has_handles = status == ICC_OK && iccp_surface_n_loops(&pair->surface) > 0;
    for (int k = 0; k < 2 && has_handles && status == ICC_OK; ++k)
        status = make_side(pair, k, &regions[k], &part[k], err);
    if (status != ICC_OK)
        iccp_region_pair_free(pair);
    return status;
}

void iccp_region_pair_free(iccp_region_pair *pair)
{
    const iccp_memory memory = pair->memory;
    iccp_region_surface_free(&pair->surface);
    for (int k = 0; k < 2; ++k) {
        pair->cells[k].memory = pair->classes[k].memory = memory;
        iccp_region_cells_free(&pair->cells[k]);
        iccp_region_classes_free(&pair->classes[k]);
        iccp_free(&memory, pair->at[k]);
        iccp_free(&memory, pair->periods[k]);
    }
    memset(pair, 0, sizeof *pair);
    pair->memory = memory;
}

void iccp_region_pair_class(iccp_region_pair *pair, int k, const uint64_t *coefficients,
                            uint64_t *values)
{
    const uint64_t *all = iccp_region_class(&pair->classes[k], coefficients);
    for (size_t e = 0; e < pair->surface.n_edges; ++e)
        values[e] = all[pair->at[k][e]];
}
