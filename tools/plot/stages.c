/* Gets the stages of a chart from the library, and evaluates its function. */
#include "plot/stages.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>

/* For a range above this, in orders of magnitude, a linear scale shows little besides the
 * maximum. */
static const double many_decades = 2;

static void find_range(stages *s)
{
    const uint8_t *inside = icc_grid_inside(s->grid);
    s->low = HUGE_VAL;
    s->high = -HUGE_VAL;
    for (size_t i = 0; i < s->lattice.n_vertices; i++)
        if (inside[i] && !isnan(s->values[i])) {
            s->low = fmin(s->low, s->values[i]);
            s->high = fmax(s->high, s->values[i]);
        }
}

static void find_scale(stages *s)
{
    s->values = icc_function_logs(s->field);
    if (s->values != NULL)
        find_range(s);
    s->logarithmic = s->values != NULL && s->high - s->low >= many_decades * log(10);
    if (s->logarithmic)
        return;
    s->values = icc_function_values(s->field);
    find_range(s);
}

static bool inner_edge(const stages *s, uint32_t a, uint32_t b)
{
    const uint8_t *inside = icc_grid_inside(s->grid);
    const size_t row = s->lattice.shape[0],
                 step = b - a; /* 1, row, or row + 1: a is the lower one */
    size_t left = step == 1 ? a + row + 1 : step == row ? a - 1 : a + row;
    size_t right = step == 1 ? a - row : step == row ? a + row + 1 : a + 1;
    return inside[a] && inside[b] && inside[left] && inside[right];
}

static int find_edges(stages *s, job *j)
{
    size_t n = 0;
    icc_status status = icc_function_get_edges(s->field, 0, NULL, NULL, &n, NULL);
    s->edges = need(n, 2 * sizeof *s->edges);
    s->kinds = need(n, sizeof *s->kinds);
    if (status == ICC_OK && n > 0)
        status = icc_function_get_edges(s->field, n, s->edges, s->kinds, &n, NULL);
    s->n_edges = n;
    for (size_t i = 0; i < n && status == ICC_OK; i++)
        if (s->kinds[i] == ICC_EDGE_EXPANSION) {
            s->n_expansion++;
            s->n_inner_expansion += inner_edge(s, s->edges[2 * i], s->edges[2 * i + 1]);
        }
    return status == ICC_OK ? DONE : job_failed_status(j, status);
}

int stages_make(stages *out, job *j, int side)
{
    *out = (stages){.box = {.size = sizeof out->box},
                    .chart_info = {.size = sizeof out->chart_info},
                    .lattice = {.size = sizeof out->lattice},
                    .field_info = {.size = sizeof out->field_info},
                    .solved = {.size = sizeof out->solved},
                    .high = 1};
    out->domain = j->domains[side == 2];
    out->map = j->map;
    out->chart = j->map == NULL ? j->chart
                 : side == 2    ? icc_map_target_chart(j->map)
                                : icc_map_source_chart(j->map);
    icc_domain_get_info(out->domain, &out->box);
    if (out->chart == NULL)
        return DONE;
    icc_chart_get_info(out->chart, &out->chart_info);
    out->field = icc_chart_function(out->chart);
    if (out->field == NULL)
        return DONE;
    out->tree = icc_function_tree(out->field);
    out->grid = icc_tree_grid(out->tree);
    icc_function_get_info(out->field, &out->field_info);
    icc_function_get_solver_report(out->field, &out->solved);
    icc_grid_get_info(out->grid, &out->lattice);
    find_scale(out);
    return out->box.dim == 2 ? find_edges(out, j) : DONE;
}

void stages_free(stages *s)
{
    free(s->edges);
    free(s->kinds);
}

void stages_position(const stages *s, uint32_t vertex, double *out)
{
    size_t rest = vertex;
    for (int32_t k = 0; k < s->lattice.dim; k++) {
        out[k] = s->lattice.origin[k] + s->lattice.spacing * (double)(rest % s->lattice.shape[k]);
        rest /= s->lattice.shape[k];
    }
}

static bool in_shape(const stages *s, size_t vertex)
{
    return icc_grid_inside(s->grid)[vertex] && icc_tree_generations(s->tree)[vertex] >= 0;
}

/* The region is connected by the tree, so by Euler's formula there are 1 - (vertices - edges +
 * triangles) holes. Each vertex counts the edges and triangles of which it is the highest corner.
 * No vertex inside lies on the border of the grid. */
size_t stages_holes(const stages *s)
{
    const size_t row = s->lattice.shape[0];
    size_t n_vertices = 0, n_edges = 0, n_triangles = 0;
    for (size_t i = 0; i < s->lattice.n_vertices; i++) {
        if (!in_shape(s, i))
            continue;
        size_t left = in_shape(s, i - 1), below = in_shape(s, i - row),
               diagonal = in_shape(s, i - row - 1);
        n_vertices++;
        n_edges += left + below + diagonal;
        n_triangles += diagonal * (left + below);
    }
    return 1 + n_edges - n_vertices - n_triangles;
}

/* The logarithm of a mean of three numbers that are given by their logarithms. Towards the outside,
 * where it falls to minus infinity, it is cut off at the last number inside. */
static double log_mean(const double logs[3], const double shares[3])
{
    double top = -HUGE_VAL, least = HUGE_VAL, sum = 0;
    for (int k = 0; k < 3; k++) {
        top = fmax(top, logs[k]);
        least = logs[k] > -HUGE_VAL ? fmin(least, logs[k]) : least;
    }
    if (!(top > -HUGE_VAL))
        return top;
    for (int k = 0; k < 3; k++)
        sum += shares[k] * exp(logs[k] - top);
    return fmax(top + log(sum), least);
}

double stages_value(const stages *s, const double p[2])
{
    const icc_grid_info *g = &s->lattice;
    double u = (p[0] - g->origin[0]) / g->spacing, v = (p[1] - g->origin[1]) / g->spacing;
    if (!(u >= 0 && v >= 0 && u < (double)(g->shape[0] - 1) && v < (double)(g->shape[1] - 1)))
        return NAN;
    const double *at = s->values + (size_t)u + g->shape[0] * (size_t)v;
    u -= floor(u);
    v -= floor(v);
    /* The diagonal of a cell runs from its lowest corner to its highest. */
    double corners[3] = {at[0], u >= v ? at[1] : at[g->shape[0]], at[g->shape[0] + 1]};
    double shares[3] = {1 - fmax(u, v), fabs(u - v), fmin(u, v)};
    if (isnan(corners[0]) || isnan(corners[1]) || isnan(corners[2]))
        return NAN;
    return s->logarithmic
               ? log_mean(corners, shares)
               : shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2];
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
