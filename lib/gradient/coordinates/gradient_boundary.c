/* Extends functions to more vertices outside. */
#include "gradient/coordinates/gradient_boundary.h"

/* Returns the neighbour in a layer with the highest or the lowest value, or ICCP_NONE. */
static uint32_t extreme(const icc_function *field, const uint8_t *layer, uint32_t v, int wanted,
                        int sign)
{
    const icc_grid *grid = field->tree->grid;
    uint32_t best = ICCP_NONE;
    for (int32_t i = 0; i < 2 * grid->dim; ++i) {
        const uint32_t u = iccp_grid_neighbour(grid, v, i / 2, i % 2 * 2 - 1);
        if (u != ICCP_NONE && layer[u] == wanted &&
            (best == ICCP_NONE || sign * iccp_function_compare(field, u, best) > 0))
            best = u;
    }
    return best;
}

/* f(v) = f(u) + (f(u) - f(t)). */
static void extrapolate(icc_function *field, uint32_t v, uint32_t u, uint32_t t)
{
    if (field->plain != NULL)
        field->plain[v] = 2 * field->plain[u] - field->plain[t];
    if (field->exponent == NULL) {
        field->values[v] = 2 * field->values[u] - field->values[t];
        return;
    }
    const uint32_t ends[2] = {u, t};
    double f[2];
    iccp_function_local(field, 2, ends, f);
    field->values[v] = 2 * f[0] - f[1];
    field->exponent[v] =
        field->exponent[u] > field->exponent[t] ? field->exponent[u] : field->exponent[t];
}

static void mark_layers(const icc_tree *tree, uint8_t *layer)
{
    for (size_t i = tree->n_inside; i < tree->n_reached; ++i) {
        const uint32_t v = tree->order[i];
        layer[v] = 2;
        for (int32_t d = 0; d < 2 * tree->grid->dim; ++d) {
            const uint32_t u = iccp_grid_neighbour(tree->grid, v, d / 2, d % 2 * 2 - 1);
            if (u != ICCP_NONE && tree->grid->inside[u] && tree->generation[u] >= 0)
                layer[v] = 1;
        }
    }
}

icc_status iccp_gradient_extend(icc_function *field, const iccp_env *env)
{
    const icc_grid *grid = field->tree->grid;
    if (grid->dim <= 2)
        return ICC_OK;
    uint8_t *layer = iccp_alloc_zero(&env->memory, grid->n_vertices, sizeof *layer);
    if (layer == NULL)
        return ICC_ERR_MEMORY;
    mark_layers(field->tree, layer);
    icc_status status = ICC_OK;
    for (int l = 3; l <= grid->dim && status == ICC_OK; ++l) {
        status = iccp_progress(env, "grid", (double)(l - 3) / grid->dim);
        for (uint32_t v = 0; v < grid->n_vertices; ++v) {
            if (layer[v] != 0 || grid->inside[v])
                continue;
            const uint32_t u = extreme(field, layer, v, l - 1, -1);
            if (u == ICCP_NONE)
                continue;
            extrapolate(field, v, u, extreme(field, layer, u, l - 2, 1));
            layer[v] = (uint8_t)l;
        }
    }
    iccp_free(&env->memory, layer);
    return status;
}
