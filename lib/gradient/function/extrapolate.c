/* Values outside, for functions whose zeros lie on the boundary itself. They continue along lines
 * through the zeros, as the equation assumes (gradient/solver/unknowns.h): F. Gibou, R. P. Fedkiw,
 * L.-T. Cheng, M. Kang, A second-order-accurate symmetric discretization of the Poisson equation on
 * irregular domains, J. Comput. Phys. 176, 2002. */
#include "gradient/function/extrapolate.h"

/* Calls an action for each pair of an outside vertex and an unknown beside it. The action also gets
 * the share of the way from the unknown at which the function is 0. */
static void for_ends(icc_function *function, const iccp_unknowns *unknowns, double *weight,
                     void (*act)(icc_function *, double *, uint32_t, uint32_t, double))
{
    const icc_grid *grid = function->tree->grid;
    for (size_t k = 0; k < unknowns->n; ++k)
        for (int32_t d = 0; d < unknowns->n_neighbours; ++d) {
            const size_t at = k * (size_t)unknowns->n_neighbours + (size_t)d;
            const uint32_t u = unknowns->vertex[k];
            if (unknowns->neighbour[at] == ICCP_NONE)
                act(function, weight, u, iccp_grid_neighbour(grid, u, d / 2, 2 * (d % 2) - 1),
                    unknowns->reach[at]);
        }
}

static void raise_exponent(icc_function *function, double *weight, uint32_t u, uint32_t v,
                           double reach)
{
    (void)weight, (void)reach;
    if (function->exponent[u] > function->exponent[v])
        function->exponent[v] = function->exponent[u];
}

static void add_end(icc_function *function, double *weight, uint32_t u, uint32_t v, double reach)
{
    const uint32_t ends[2] = {u, v};
    double local[2];
    iccp_function_local(function, 2, ends, local);
    function->values[v] -= (1 - reach) * local[0];
    weight[v] += reach;
}

/* Extrapolates values beyond zeros on the boundary itself: linearly, from an inside vertex through
 * 0 at the boundary. If several lines lead to a vertex, longer distances inside count more. */
static icc_status go_on(icc_function *function, const iccp_unknowns *unknowns)
{
    const icc_tree *tree = function->tree;
    double *weight = iccp_alloc_zero(&function->memory, tree->grid->n_vertices, sizeof *weight);
    if (weight == NULL)
        return ICC_ERR_MEMORY;
    if (function->exponent != NULL)
        for_ends(function, unknowns, weight, raise_exponent);
    for_ends(function, unknowns, weight, add_end);
    for (size_t i = tree->n_inside; i < tree->n_reached; ++i) {
        const uint32_t v = tree->order[i];
        if (weight[v] > 0)
            function->values[v] /= weight[v];
        if (function->plain != NULL)
            function->plain[v] = ldexp(function->values[v], function->exponent[v]);
    }
    iccp_free(&function->memory, weight);
    return ICC_OK;
}

static int32_t highest_exponent(const icc_function *function, size_t n, const uint32_t *vertices)
{
    int32_t highest = ICCP_ZERO_EXPONENT;
    for (size_t i = 0; i < n; ++i)
        if (function->exponent[vertices[i]] > highest)
            highest = function->exponent[vertices[i]];
    return highest;
}

/* Returns the highest inside vertex two steps from an outside vertex, and the vertex between them.
 * Returns ICCP_NONE if the outside vertex is next to the inside. */
static uint32_t highest_behind(const icc_function *function, uint32_t v, uint32_t *between)
{
    const icc_grid *grid = function->tree->grid;
    uint32_t best = ICCP_NONE;
    for (int32_t i = 0; i < 2 * grid->dim; ++i) {
        const uint32_t outside = iccp_grid_neighbour(grid, v, i / 2, i % 2 * 2 - 1);
        if (outside == ICCP_NONE)
            continue;
        if (grid->inside[outside])
            return ICCP_NONE;
        for (int32_t j = 0; j < 2 * grid->dim; ++j) {
            const uint32_t u = iccp_grid_neighbour(grid, outside, j / 2, j % 2 * 2 - 1);
            if (u != ICCP_NONE && grid->inside[u] && !isnan(function->values[u]) &&
                (best == ICCP_NONE || iccp_function_compare(function, u, best) > 0)) {
                best = u;
                *between = outside;
            }
        }
    }
    return best;
}

/* Gives the layer beyond the zeros the negative values of the layer before them. With zeros there
 * too, a boundary that cuts the corner of a cell would meet a level triangle. Mirroring leaves a
 * third less area uncovered, and the gradient fails to point inward at fewer boundary points
 * (tests/bench/bench_collapse). If the layer between is not 0, the three values lie on a line, or
 * on a plane with the fourth corner of a square. */
static void mirror(icc_function *function, uint32_t v, bool has_zeros)
{
    uint32_t between = ICCP_NONE;
    const uint32_t behind = highest_behind(function, v, &between);
    if (behind == ICCP_NONE)
        return;
    const uint32_t at[3] = {behind, between, behind + v - between};
    double local[3];
    iccp_function_local(function, 3, at, local);
    function->values[v] = has_zeros ? -local[0] : local[1] + local[2] - local[0];
    if (function->exponent != NULL)
        function->exponent[v] = highest_exponent(function, 3, at);
    if (function->plain != NULL)
        function->plain[v] = has_zeros ? -function->plain[behind]
                                       : ldexp(function->values[v], function->exponent[v]);
}

void iccp_function_extend_line(icc_function *function, uint32_t vertex)
{
    mirror(function, vertex, false);
}

icc_status iccp_function_extrapolate(icc_function *function, const iccp_unknowns *unknowns)
{
    const icc_status status = unknowns->reach != NULL ? go_on(function, unknowns) : ICC_OK;
    const icc_tree *tree = function->tree;
    for (size_t i = tree->n_inside; status == ICC_OK && i < tree->n_reached; ++i)
        mirror(function, tree->order[i], unknowns->reach == NULL);
    return status;
}
