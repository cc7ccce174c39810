/* Any mask with any root: every stage works, the two forms of the tree agree, and what the stages
 * say about each other is consistent. On small masks, any solved function too. */
#include "fuzz.h"
#include "icc/stages.h"

#include <math.h>

enum { MAX_VERTICES = 1 << 12, MAX_SOLVED = 256 };

/* The input, one byte at a time; zeros when it has ended. */
typedef struct reader {
    const uint8_t *data;
    size_t size;
} reader;

static unsigned next_byte(reader *in)
{
    if (in->size == 0)
        return 0;
    --in->size;
    return *in->data++;
}

typedef struct shape {
    int32_t dim;
    size_t sides[ICC_MAX_DIM], n;
    uint8_t inside[MAX_VERTICES];
} shape;

/* One byte for the dimension, one for each side, then one bit for each vertex. */
static void read_shape(shape *s, reader *in)
{
    s->dim = 1 + (int32_t)(next_byte(in) % ICC_MAX_DIM);
    s->n = 1;
    for (int32_t k = 0; k < s->dim; ++k) {
        s->sides[k] = 1 + next_byte(in) % 64;
        if (s->sides[k] > MAX_VERTICES / s->n)
            s->sides[k] = MAX_VERTICES / s->n;
        s->n *= s->sides[k];
    }
    unsigned bits = 0;
    for (size_t v = 0; v < s->n; ++v) {
        if (v % 8 == 0)
            bits = next_byte(in);
        s->inside[v] = bits >> v % 8 & 1;
    }
}

static icc_tree *make_tree(const icc_grid *grid, uint32_t root, int32_t form, int32_t dim,
                           unsigned turn)
{
    int32_t order[ICC_MAX_DIM];
    for (int32_t k = 0; k < dim; ++k)
        order[k] = (k + (int32_t)turn) % dim;
    const icc_tree_options options = {.size = sizeof options, .form = form, .axis_order = order};
    icc_tree *tree;
    require(icc_tree_create(&tree, grid, root, &options, NULL, NULL) == ICC_OK);
    return tree;
}

static void check_parents(const icc_tree *tree, const shape *s, uint32_t root, int32_t form)
{
    const uint32_t *parent = icc_tree_parents(tree);
    const int32_t *generation = icc_tree_generations(tree);
    require(generation[root] == 0 && parent[root] == UINT32_MAX);
    for (size_t v = 0; v < s->n; ++v) {
        const bool has_parent = parent[v] != UINT32_MAX;
        require(has_parent == (generation[v] > 0 && (s->inside[v] || form == ICC_TREE_THESIS)));
        if (has_parent) {
            require(generation[parent[v]] == generation[v] - 1);
            require(s->inside[parent[v]] || !s->inside[v]);
        }
    }
}

static void check_report(const icc_tree *tree, const icc_grid *grid)
{
    icc_tree_report report = {.size = sizeof report};
    icc_grid_info info = {.size = sizeof info};
    require(icc_tree_get_report(tree, &report, NULL, NULL) == ICC_OK);
    require(icc_grid_get_info(grid, &info) == ICC_OK);
    require(report.n_inside >= 1 && report.n_inside + report.n_unreachable == info.n_inside);
    require(report.n_cousin_violations <= report.n_pairs);
    require((report.violation[0] == UINT32_MAX) == (report.n_cousin_violations == 0));
}

static void check_field(const icc_tree *tree, const shape *s, int32_t function)
{
    const icc_function_options options = {.size = sizeof options, .function = function};
    icc_function *field;
    icc_function_report report = {.size = sizeof report};
    require(icc_function_create(&field, tree, &options, NULL, NULL) == ICC_OK);
    const double *f = icc_function_values(field);
    for (size_t v = 0; v < s->n; ++v) {
        const uint32_t parent = icc_tree_parents(tree)[v];
        require(isnan(f[v]) == (icc_tree_generations(tree)[v] < 0));
        require(parent == UINT32_MAX || f[v] < f[parent]);
    }
    require(icc_function_get_report(field, &report, NULL, NULL) == ICC_OK);
    require(report.n_maxima >= 1);
    size_t n_edges = 0, n_tested = 0;
    const icc_status status = icc_function_get_edges(field, 0, NULL, NULL, &n_edges, &n_tested);
    require(status == (s->dim == 2 ? ICC_OK : ICC_ERR_UNSUPPORTED) && n_edges <= n_tested);
    icc_facet_report facets = {.size = sizeof facets};
    require(icc_function_get_facets(field, 0, NULL, NULL, &facets, NULL, NULL) == ICC_OK);
    require(status != ICC_OK || facets.n_tested == n_tested);
    icc_function_free(field);
}

/* Two bytes: what to solve for and how, and how large the falls and the bounds shall be. */
static icc_function_options read_options(reader *in)
{
    static const double ETAS[4] = {0, 1e-12, 1e-3, 1e-2}, LEAVES[4] = {0, 1e-15, 1e-4, 1e-2};
    const unsigned what = next_byte(in), sizes = next_byte(in);
    return (icc_function_options){
        .size = sizeof(icc_function_options),
        .function = what < 216 ? ICC_FUNCTION_LAPLACE + (int32_t)(what % 3) : ICC_FUNCTION_HARMONIC,
        .constraints = (int32_t)(what / 3 % 4),
        .solver = (int32_t)(what / 12 % 3),
        .min_fall = ETAS[sizes % 4],
        .leaf_min = LEAVES[sizes / 4 % 4]};
}

/* Whether the tree is so deep that falls and bounds cannot both be kept. */
static bool is_infeasible(const icc_tree *tree, const shape *s, const icc_function_options *options)
{
    const double eta = options->min_fall > 0 ? options->min_fall : 1e-6;
    const double leaf = options->leaf_min > 0 ? options->leaf_min : 1e-9;
    int32_t deepest = 0;
    for (size_t v = 0; v < s->n; ++v)
        if (s->inside[v] && icc_tree_generations(tree)[v] > deepest)
            deepest = icc_tree_generations(tree)[v];
    return options->function != ICC_FUNCTION_LAPLACE && leaf * pow(1 + eta, deepest) > 1;
}

static void check_values(const icc_function *field, const shape *s,
                         const icc_function_options *options)
{
    const double *f = icc_function_values(field), *u = icc_function_logs(field);
    const double eta = options->min_fall > 0 ? options->min_fall : 1e-6;
    const double leaf = options->function == ICC_FUNCTION_LAPLACE ? 0
                        : options->leaf_min > 0                   ? options->leaf_min
                                                                  : 1e-9;
    const icc_tree *tree = icc_function_tree(field);
    icc_function_info info = {.size = sizeof info};
    require(icc_function_get_info(field, &info) == ICC_OK);
    require(info.constrained || options->constraints != ICC_CONSTRAINTS_ALL);
    for (size_t v = 0; v < s->n; ++v) {
        const uint32_t parent = icc_tree_parents(tree)[v];
        require(isnan(f[v]) == (icc_tree_generations(tree)[v] < 0));
        if (isnan(f[v]) || !s->inside[v])
            continue;
        require(f[v] <= 1 || (!info.constrained && options->function != ICC_FUNCTION_LAPLACE));
        require(u != NULL || options->function == ICC_FUNCTION_CLAMPED);
        require(u == NULL ||
                (isfinite(u[v]) && fabs(exp(u[v]) - f[v]) <= 1e-12 * (1 + fabs(f[v]))));
        require(!info.constrained || f[v] >= leaf);
        require(!info.constrained || parent == UINT32_MAX || f[parent] >= (1 + eta) * f[v]);
    }
}

/* The header says so of bounds that are large beside the falls. */
static bool may_give_up(const icc_function_options *options)
{
    return options->function != ICC_FUNCTION_LAPLACE && options->leaf_min > 1e-3;
}

static void check_solution(const icc_tree *tree, const shape *s,
                           const icc_function_options *options)
{
    icc_function *field;
    icc_tree_report report = {.size = sizeof report};
    require(icc_tree_get_report(tree, &report, NULL, NULL) == ICC_OK);
    const icc_status status = icc_function_create(&field, tree, options, NULL, NULL);
    if (report.n_inside == 1)
        require(status == ICC_ERR_RESOLUTION);
    else if (options->function == ICC_FUNCTION_HARMONIC) /* a mask by itself has no boundary */
        require(status == ICC_ERR_UNSUPPORTED);
    else if (is_infeasible(tree, s, options))
        require(status != ICC_OK || options->constraints != ICC_CONSTRAINTS_ALL);
    else
        require(status == ICC_OK || (status == ICC_ERR_SOLVER && may_give_up(options)));
    if (status == ICC_OK)
        check_values(field, s, options);
    icc_function_free(field);
}

/* Most masks are no balls. What growth places is regular by itself all the same. */
static void check_order(const icc_tree *tree, const shape *s)
{
    static uint32_t rank[MAX_VERTICES];
    icc_grow_report report = {.size = sizeof report};
    icc_function_report found = {.size = sizeof found};
    const icc_status status = icc_tree_grow(tree, NULL, rank, &report, NULL, NULL);
    require(status == ICC_OK || (status == ICC_ERR_TOPOLOGY && report.n_remaining > 0));
    require(report.n_tests <= report.n_vertices << (s->dim + 3));
    size_t n_ranked = 0;
    for (size_t v = 0; v < s->n; ++v)
        n_ranked += rank[v] != UINT32_MAX;
    require(n_ranked == report.n_vertices - (status == ICC_OK ? 0 : report.n_unplaced));
    require(icc_tree_get_rank_report(tree, rank, &found, NULL, NULL) == ICC_OK);
    require(status != ICC_OK || (found.critical == UINT32_MAX && found.n_maxima == 1));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static shape s;
    reader in = {data, size};
    const unsigned choice = next_byte(&in);
    read_shape(&s, &in);
    icc_grid *grid;
    require(icc_grid_create_mask(&grid, s.dim, s.sides, s.inside, NULL, NULL) == ICC_OK);
    uint32_t maximum, rounds, root = next_byte(&in) % (uint32_t)s.n;
    const icc_status status = icc_grid_find_maximum(grid, &maximum, &rounds, NULL, NULL);
    if (status == ICC_OK) {
        require(s.inside[maximum]);
        if (!s.inside[root])
            root = maximum;
        const icc_function_options options = read_options(&in);
        icc_tree *trees[2];
        for (int32_t form = ICC_TREE_THESIS; form <= ICC_TREE_PAPER; ++form) {
            icc_tree *tree = make_tree(grid, root, form, s.dim, choice / 2);
            check_parents(tree, &s, root, form);
            check_report(tree, grid);
            check_order(tree, &s);
            check_field(tree, &s, 1 + (int32_t)(choice % 2));
            if (s.n <= MAX_SOLVED)
                check_solution(tree, &s, &options);
            trees[form - 1] = tree;
        }
        for (size_t v = 0; v < s.n; ++v)
            require(icc_tree_generations(trees[0])[v] == icc_tree_generations(trees[1])[v]);
        icc_tree_free(trees[0]);
        icc_tree_free(trees[1]);
    } else {
        require(status == ICC_ERR_RESOLUTION);
    }
    icc_grid_free(grid);
    return 0;
}
