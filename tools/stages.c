#include "stages.h"

#include "memory.h"

#include <math.h>
#include <stdlib.h>

static void find_range(stages *s)
{
    const double *values = icc_field_values(s->field);
    const uint8_t *inside = icc_grid_inside(s->grid);
    s->low = HUGE_VAL;
    s->high = -HUGE_VAL;
    for (size_t i = 0; i < s->lattice.n_vertices; i++)
        if (inside[i] && !isnan(values[i])) {
            s->low = fmin(s->low, values[i]);
            s->high = fmax(s->high, values[i]);
        }
}

static int find_edges(stages *s, job *j)
{
    size_t n = 0;
    icc_status status = icc_field_edges(s->field, 0, NULL, NULL, &n, NULL);
    s->edges = need(n, 2 * sizeof *s->edges);
    s->kinds = need(n, sizeof *s->kinds);
    if (status == ICC_OK && n > 0)
        status = icc_field_edges(s->field, n, s->edges, s->kinds, &n, NULL);
    s->n_edges = n;
    return status == ICC_OK ? DONE : job_failed_status(j, status);
}

static icc_status make(stages *s, const job *j, icc_error *err)
{
    icc_tree_options form = {.size = sizeof form, .form = j->args->tree};
    icc_field_options function = {.size = sizeof function, .function = j->args->function};
    uint32_t root;
    icc_status status = icc_grid_create(&s->grid, s->domain, j->args->cells, &j->env, err);
    if (status == ICC_OK)
        status = icc_grid_get_info(s->grid, &s->lattice);
    if (status == ICC_OK)
        status = icc_grid_nearest(s->grid, s->chart_info.maximum, &root);
    if (status == ICC_OK)
        status = icc_tree_create(&s->tree, s->grid, root, &form, &j->env, err);
    if (status == ICC_OK)
        status = icc_field_create(&s->field, s->tree, &function, &j->env, err);
    return status;
}

int stages_make(stages *out, job *j, int side)
{
    *out = (stages){.box = {.size = sizeof out->box},
                    .chart_info = {.size = sizeof out->chart_info},
                    .lattice = {.size = sizeof out->lattice}};
    out->domain = j->domains[side == 2];
    out->chart = j->map == NULL ? j->chart
                 : side == 2    ? icc_map_target_chart(j->map)
                                : icc_map_source_chart(j->map);
    icc_domain_get_info(out->domain, &out->box);
    icc_chart_get_info(out->chart, &out->chart_info);
    out->high = 1;
    if (out->chart_info.method != ICC_METHOD_GRADIENT)
        return DONE;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_status status = make(out, j, &err);
    if (status != ICC_OK) {
        err.side = side;
        err.status = status;
        return job_failed(j, &err);
    }
    find_range(out);
    return find_edges(out, j);
}

void stages_free(stages *s)
{
    icc_field_free(s->field);
    icc_tree_free(s->tree);
    icc_grid_free(s->grid);
    free(s->edges);
    free(s->kinds);
}

void stages_position(const stages *s, uint32_t vertex, double out[2])
{
    size_t columns = s->lattice.shape[0];
    out[0] = s->lattice.origin[0] + s->lattice.spacing * (double)(vertex % columns);
    out[1] = s->lattice.origin[1] + s->lattice.spacing * (double)(vertex / columns);
}

double stages_value(const stages *s, const double p[2])
{
    const icc_grid_info *g = &s->lattice;
    double u = (p[0] - g->origin[0]) / g->spacing, v = (p[1] - g->origin[1]) / g->spacing;
    if (!(u >= 0 && v >= 0 && u < (double)(g->shape[0] - 1) && v < (double)(g->shape[1] - 1)))
        return NAN;
    const double *at = icc_field_values(s->field) + (size_t)u + g->shape[0] * (size_t)v;
    double low = at[0], high = at[g->shape[0] + 1], side;
    u -= floor(u);
    v -= floor(v);
    /* The diagonal of a cell runs from its lowest corner to its highest. */
    side = u >= v ? at[1] : at[g->shape[0]];
    return u >= v ? low + u * (side - low) + v * (high - side)
                  : low + v * (side - low) + u * (high - side);
}

int stages_values(const stages *s, job *j, size_t n, const double *points, double *values)
{
    for (size_t i = 0; i < n && s->field != NULL; i++)
        values[i] = stages_value(s, points + 2 * i);
    if (s->field != NULL)
        return DONE;
    uint32_t *facet = need(n, sizeof *facet);
    double *bary = need(n, 2 * sizeof *bary);
    icc_status ran =
        icc_chart_encode(s->chart, n, points, facet, bary, values, NULL, NULL, &j->env);
    free(facet);
    free(bary);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
}
