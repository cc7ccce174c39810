/* Saves and reads the stages of a gradient chart. One function visits each part in both directions
 * (base/blob.h), except those whose arrays only a reader allocates. */
#include "gradient/coordinates/gradient_file.h"

#include "gradient/coordinates/chart_parameters.h"
#include "gradient/function/given_function.h"
#include "gradient/function/make_function.h"
#include "gradient/grid/rasterise.h"

#include <string.h>

/* ---- grid ---- */

/* Visits one bit per vertex, the first vertex lowest. The bits beyond the last vertex are 0. */
static void visit_bits(iccp_blob *b, size_t n, uint8_t *bit)
{
    for (size_t i = 0; i < n && b->status == ICC_OK; i += 32) {
        const size_t m = n - i < 32 ? n - i : 32;
        uint32_t word = 0;
        for (size_t k = 0; k < m && !b->reads; ++k)
            word |= (uint32_t)bit[i + k] << k;
        iccp_blob_u32(b, 1, &word);
        for (size_t k = 0; k < m && b->reads; ++k)
            bit[i + k] = word >> k & 1;
        iccp_blob_require(b, m == 32 || word >> m == 0);
    }
}

/* Moves vertices outside, as the bits say. All bits are of vertices inside. */
static icc_status read_restriction(icc_grid **grid, iccp_blob *b, const iccp_env *env)
{
    icc_grid *whole = *grid, *part = NULL;
    const size_t n = whole->n_vertices;
    uint8_t *keep = iccp_blob_has(b, n / 32, ICCP_U32) ? iccp_blob_alloc(b, n, 1) : NULL;
    if (keep == NULL)
        return b->status != ICC_OK ? b->status : ICC_ERR_FORMAT;
    visit_bits(b, n, keep);
    for (size_t v = 0; v < n; ++v)
        iccp_blob_require(b, whole->inside[v] || !keep[v]);
    icc_status status = b->status;
    if (status == ICC_OK)
        status = iccp_grid_restrict(&part, whole, keep, env, NULL);
    iccp_free(&b->memory, keep);
    if (status != ICC_OK)
        return status;
    iccp_grid_release(whole);
    *grid = part;
    return ICC_OK;
}

static icc_status read_grid(icc_grid **out, const icc_domain *domain, iccp_blob *b,
                            const iccp_env *env)
{
    int32_t cells = 0, is_restricted = 0;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){3, 1}, env);
    iccp_blob_i32(b, ICCP_U32, ICCP_MIN_CELLS,
                  domain->mask != NULL ? (int32_t)ICCP_MAX_VERTICES : ICCP_MAX_CELLS, &cells);
    iccp_blob_i32(b, ICCP_U32, 0, 1, &is_restricted);
    if (b->status != ICC_OK)
        return b->status;
    icc_status status = iccp_grid_create(out, domain, cells, &part[0], NULL);
    if (status == ICC_OK && (*out)->cells != cells)
        status = ICC_ERR_FORMAT;
    if (status == ICC_OK && is_restricted)
        status = read_restriction(out, b, &part[1]);
    return status;
}

static void write_grid(iccp_blob *b, const icc_grid *grid)
{
    int32_t cells = grid->cells, is_restricted = grid->is_restricted;
    iccp_blob_i32(b, ICCP_U32, 0, cells, &cells);
    iccp_blob_i32(b, ICCP_U32, 0, 1, &is_restricted);
    if (is_restricted)
        visit_bits(b, grid->n_vertices, grid->inside);
}

/* ---- tree ---- */

/* The parts of a tree that are numbers. */
typedef struct tree_numbers {
    uint32_t root, chosen;
    int32_t form, is_given, axis_order[ICC_MAX_DIM];
} tree_numbers;

static void visit_tree(iccp_blob *b, const icc_grid *grid, tree_numbers *t)
{
    uint32_t axes = 0;
    iccp_blob_u32(b, 1, &t->root);
    iccp_blob_u32(b, 1, &t->chosen);
    iccp_blob_require(b, t->root < grid->n_vertices && grid->inside[t->root]);
    iccp_blob_require(b, t->chosen < grid->n_vertices && grid->inside[t->chosen]);
    iccp_blob_i32(b, ICCP_U32, ICC_TREE_THESIS, ICC_TREE_PAPER, &t->form);
    for (int32_t k = 0; k < grid->dim; ++k) {
        iccp_blob_i32(b, ICCP_U32, 0, grid->dim - 1, &t->axis_order[k]);
        iccp_blob_require(b, (axes >> t->axis_order[k] & 1) == 0);
        axes |= (uint32_t)1 << t->axis_order[k];
    }
    iccp_blob_i32(b, ICCP_U32, 0, 1, &t->is_given);
}

/* Returns 1 plus the number of a neighbour among the others, or 0 for none. */
static uint32_t direction_to(const icc_grid *grid, uint32_t v, uint32_t neighbour)
{
    for (int32_t d = 0; neighbour != ICCP_NONE && d < 2 * grid->dim; ++d)
        if (iccp_grid_neighbour(grid, v, d / 2, d % 2 * 2 - 1) == neighbour)
            return (uint32_t)d + 1;
    return 0;
}

/* Returns the neighbour of that number, or ICCP_NONE for 0. Reading fails for other numbers. */
static uint32_t neighbour_of(iccp_blob *b, const icc_grid *grid, uint32_t v, uint32_t direction)
{
    if (direction == 0)
        return ICCP_NONE;
    const int32_t d = (int32_t)direction - 1;
    const uint32_t u =
        d < 2 * grid->dim ? iccp_grid_neighbour(grid, v, d / 2, d % 2 * 2 - 1) : ICCP_NONE;
    iccp_blob_require(b, u != ICCP_NONE);
    return u;
}

/* Visits the parents of the vertices inside, 8 to a word, the first lowest. Four bits number up to
 * 12 neighbours. */
static void visit_parents(iccp_blob *b, const icc_grid *grid, uint32_t *parents)
{
    uint32_t word = 0;
    int at = 0;
    for (uint32_t v = 0; v < grid->n_vertices && b->status == ICC_OK; ++v) {
        if (!grid->inside[v])
            continue;
        if (b->reads && at == 0)
            iccp_blob_u32(b, 1, &word);
        if (b->reads)
            parents[v] = neighbour_of(b, grid, v, word >> at & 15);
        else
            word |= direction_to(grid, v, parents[v]) << at;
        at = (at + 4) % 32;
        if (at != 0)
            continue;
        if (!b->reads)
            iccp_blob_u32(b, 1, &word);
        word = 0;
    }
    if (at != 0 && !b->reads)
        iccp_blob_u32(b, 1, &word);
    iccp_blob_require(b, at == 0 || word >> at == 0);
}

static icc_status read_tree(icc_tree **out, uint32_t *chosen, const icc_grid *grid, iccp_blob *b,
                            const iccp_env *env)
{
    tree_numbers t = {0};
    uint32_t *parents = NULL;
    *out = NULL;
    visit_tree(b, grid, &t);
    if (t.is_given) {
        iccp_blob_require(b, iccp_blob_has(b, grid->n_inside / 8, ICCP_U32));
        parents = iccp_blob_alloc(b, grid->n_vertices, sizeof *parents);
        if (parents != NULL)
            visit_parents(b, grid, parents);
    }
    *chosen = t.chosen;
    icc_status status = b->status;
    if (status == ICC_OK)
        status =
            iccp_tree_create_parents(out, grid, t.root, parents, t.form, t.axis_order, env, NULL);
    iccp_free(&b->memory, parents);
    return status;
}

static void write_tree(iccp_blob *b, const icc_tree *tree, uint32_t chosen)
{
    tree_numbers t = {tree->root, chosen, tree->form, tree->is_given, {0}};
    memcpy(t.axis_order, tree->axis_order, sizeof t.axis_order);
    visit_tree(b, tree->grid, &t);
    if (tree->is_given)
        visit_parents(b, tree->grid, tree->parent);
}

/* ---- function ---- */

static void visit_options(iccp_blob *b, icc_function_options *o)
{
    iccp_blob_i32(b, ICCP_U32, ICC_CONSTRAINTS_NEEDED, ICC_CONSTRAINTS_ALL, &o->constraints);
    iccp_blob_i32(b, ICCP_U32, 0, ICC_SOLVER_ITERATIVE, &o->solver);
    iccp_blob_f64(b, 1, &o->min_fall);
    iccp_blob_f64(b, 1, &o->leaf_min);
    iccp_blob_require(b, o->min_fall > 0 && o->min_fall <= ICCP_MAX_SHARE);
    iccp_blob_require(b, o->leaf_min > 0 && o->leaf_min <= ICCP_MAX_SHARE);
}

/* NaN has the same bits on every machine. */
static double plain_value(const icc_function *function, uint32_t v)
{
    return isnan(function->values[v]) ? NAN : function->values[v];
}

/* Returns true if a function has these values. It may have others where they are NaN, and then the
 * bytes are not those that it would be saved as. */
static bool has_values(const icc_function *function, const double *values)
{
    const icc_tree *tree = function->tree;
    for (size_t i = 0; i < tree->n_reached; ++i) {
        const double value = plain_value(function, tree->order[i]);
        if (memcmp(&value, &values[tree->order[i]], sizeof value) != 0)
            return false;
    }
    return true;
}

/* Reads the caller's values at all vertices of the tree, or the fractions and exponents inside. */
static icc_status read_given(icc_function **out, const icc_tree *tree, bool scaled, iccp_blob *b,
                             const iccp_env *env)
{
    const size_t n = scaled ? tree->n_inside : tree->n_reached;
    const size_t size = scaled ? ICCP_F64 + ICCP_U32 : ICCP_F64;
    const size_t n_vertices = tree->grid->n_vertices;
    iccp_blob_require(b, iccp_blob_has(b, n, size));
    const iccp_scaled f = {
        iccp_blob_alloc(b, n_vertices, sizeof *f.fraction),
        scaled ? iccp_blob_alloc(b, n_vertices, sizeof *f.exponent) : NULL,
    };
    for (size_t i = 0; i < n && b->status == ICC_OK; ++i) {
        const uint32_t v = tree->order[i];
        uint32_t bits = 0;
        iccp_blob_f64(b, 1, &f.fraction[v]);
        if (!scaled) {
            iccp_blob_require(b, fabs(f.fraction[v]) <= ICCP_MAX_VALUE ||
                                     (i >= tree->n_inside && isnan(f.fraction[v])));
            continue;
        }
        iccp_blob_u32(b, 1, &bits);
        memcpy(&f.exponent[v], &bits, sizeof bits);
        iccp_blob_require(b, f.fraction[v] >= 0.5 && f.fraction[v] < 1 &&
                                 f.exponent[v] > ICCP_ZERO_EXPONENT &&
                                 f.exponent[v] < -ICCP_ZERO_EXPONENT);
    }
    icc_status status = b->status;
    if (status == ICC_OK)
        status = scaled ? iccp_function_create_scaled(out, tree, &f, env)
                        : iccp_function_create_values(out, tree, f.fraction, env);
    if (status == ICC_OK && !scaled && !has_values(*out, f.fraction)) {
        iccp_function_release(*out);
        *out = NULL;
        status = ICC_ERR_FORMAT;
    }
    iccp_free(&b->memory, f.fraction);
    iccp_free(&b->memory, f.exponent);
    return status;
}

static void write_given(iccp_blob *b, const icc_function *function)
{
    const icc_tree *tree = function->tree;
    const size_t n = function->from_logs ? tree->n_inside : tree->n_reached;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t v = tree->order[i];
        double value = plain_value(function, v);
        int shift = 0;
        if (function->from_logs)
            value = iccp_frexp(value, &shift);
        iccp_blob_f64(b, 1, &value);
        if (!function->from_logs)
            continue;
        uint32_t bits =
            (uint32_t)(shift + (function->exponent != NULL ? function->exponent[v] : 0));
        iccp_blob_u32(b, 1, &bits);
    }
}

static icc_status read_function(icc_function **out, const icc_tree *tree, iccp_blob *b,
                                const iccp_env *env)
{
    icc_function_options options = {.size = sizeof options};
    int32_t from_logs = 0;
    iccp_blob_i32(b, ICCP_U32, ICC_FUNCTION_DECAY, ICC_FUNCTION_VALUES, &options.function);
    if (options.function == ICC_FUNCTION_VALUES)
        iccp_blob_i32(b, ICCP_U32, 0, 1, &from_logs);
    else
        visit_options(b, &options);
    if (b->status != ICC_OK)
        return b->status;
    return options.function == ICC_FUNCTION_VALUES
               ? read_given(out, tree, from_logs, b, env)
               : iccp_function_create(out, tree, &options, env, NULL);
}

static void write_function(iccp_blob *b, const icc_function *function)
{
    icc_function_options options = function->made;
    int32_t from_logs = function->from_logs;
    iccp_blob_i32(b, ICCP_U32, ICC_FUNCTION_DECAY, ICC_FUNCTION_VALUES, &options.function);
    if (options.function != ICC_FUNCTION_VALUES) {
        visit_options(b, &options);
        return;
    }
    iccp_blob_i32(b, ICCP_U32, 0, 1, &from_logs);
    write_given(b, function);
}

/* ---- all stages ---- */

void iccp_gradient_write(const icc_function *function, uint32_t chosen, iccp_blob *b)
{
    write_grid(b, function->tree->grid);
    write_tree(b, function->tree, chosen);
    write_function(b, function);
}

icc_status iccp_gradient_read(icc_function **out, uint32_t *chosen, const icc_domain *domain,
                              iccp_blob *b, const iccp_env *env)
{
    icc_grid *grid = NULL;
    icc_tree *tree = NULL;
    *out = NULL;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 1, 3}, env);
    icc_status status = read_grid(&grid, domain, b, &part[0]);
    if (status == ICC_OK)
        status = read_tree(&tree, chosen, grid, b, &part[1]);
    if (status == ICC_OK)
        status = read_function(out, tree, b, &part[2]);
    iccp_grid_release(grid);
    iccp_tree_release(tree);
    return status;
}
