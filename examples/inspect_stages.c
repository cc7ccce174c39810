/* Looks at every stage of Integral Curve Coordinates by itself: the grid, its maximum, the tree,
 * the function on it. Prints each as a small picture. */
#include <icc/stages.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 8 };

static const double L[N][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}};

static void check(icc_status status, const icc_error *error)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "inspect_stages: %s\n", error->message);
    exit(EXIT_FAILURE);
}

/* What to draw at a vertex. */
typedef struct stages {
    icc_grid_info grid;
    const uint8_t *inside;
    uint32_t maximum;
    const uint32_t *parents;
    const int32_t *generations;
    const double *values, *logs;
} stages;

static char grid_mark(const stages *s, uint32_t v)
{
    return v == s->maximum ? 'M' : s->inside[v] ? 'o' : '.';
}

/* An arrow from the vertex to its parent. */
static char tree_mark(const stages *s, uint32_t v)
{
    const uint32_t parent = s->parents[v];
    if (v == s->maximum)
        return 'M';
    if (parent == UINT32_MAX)
        return ' ';
    if (parent == v + 1 || parent + 1 == v)
        return parent > v ? '>' : '<';
    return parent > v ? '^' : 'v';
}

static char generation_mark(const stages *s, uint32_t v)
{
    static const char digits[] = "0123456789abcdefghijklmnopqrstuvwxyz";
    return s->generations[v] < 0 ? ' ' : digits[s->generations[v] % 36];
}

/* The function in tenths of its maximum, 10. */
static char value_mark(const stages *s, uint32_t v)
{
    return s->values[v] >= 0 ? " .:-=+*#%@@"[(int)s->values[v]] : ' ';
}

/* Steps by a factor of e below the maximum, 1. */
static char log_mark(const stages *s, uint32_t v)
{
    static const char digits[] = "0123456789abcdefghijklmnopqrstuvwxyz";
    return s->inside[v] ? digits[(int)-s->logs[v] % 36] : '.';
}

static void draw(const char *title, const stages *s, char (*mark)(const stages *, uint32_t))
{
    printf("\n%s\n", title);
    for (size_t j = s->grid.shape[1]; j-- > 0;) {
        for (size_t i = 0; i < s->grid.shape[0]; ++i)
            printf(" %c", mark(s, (uint32_t)(i + s->grid.shape[0] * j)));
        printf("\n");
    }
}

int main(void)
{
    icc_error error = {.size = sizeof error};
    icc_domain *domain;
    check(icc_domain_create(&domain, 2, N, L[0], 0, NULL, NULL, &error), &error);

    icc_grid *grid;
    stages s = {.grid.size = sizeof s.grid};
    uint32_t rounds;
    check(icc_grid_create(&grid, domain, 16, NULL, &error), &error);
    check(icc_grid_get_info(grid, &s.grid), &error);
    check(icc_grid_find_maximum(grid, &s.maximum, &rounds, NULL, &error), &error);
    s.inside = icc_grid_inside(grid);
    draw("the grid: o inside, M the maximum", &s, grid_mark);
    printf("%zu vertices, %zu inside; the fire takes %u rounds to the maximum\n", s.grid.n_vertices,
           s.grid.n_inside, (unsigned)rounds);

    icc_tree *tree;
    icc_tree_report report = {.size = sizeof report};
    check(icc_tree_create(&tree, grid, s.maximum, NULL, NULL, &error), &error);
    check(icc_tree_get_report(tree, &report, NULL, &error), &error);
    s.parents = icc_tree_parents(tree);
    s.generations = icc_tree_generations(tree);
    draw("the tree: arrows to the parents", &s, tree_mark);
    draw("the generations: 0 to 9, then a to z", &s, generation_mark);
    printf("%zu pairs of neighbours inside, %zu break the cousin rule; %zu vertices unreachable\n",
           report.n_pairs, report.n_cousin_violations, report.n_unreachable);

    icc_function *field;
    icc_function_report critical = {.size = sizeof critical};
    size_t n_edges, n_tested;
    check(icc_function_create(&field, tree, NULL, NULL, &error), &error);
    check(icc_function_get_report(field, &critical, NULL, &error), &error);
    check(icc_function_get_edges(field, 0, NULL, NULL, &n_edges, &n_tested), &error);
    s.values = icc_function_values(field);
    draw("the function: 10 at the maximum, times 0.95 from parent to child", &s, value_mark);
    printf("%zu maximum, %zu minima, %zu saddles; curves merge at %zu of %zu edges\n",
           critical.n_maxima, critical.n_minima, critical.n_saddles, n_edges, n_tested);

    icc_function_free(field);

    icc_function_options laplace = {.size = sizeof laplace, .function = ICC_FUNCTION_LAPLACE};
    icc_function_info info = {.size = sizeof info};
    check(icc_function_create(&field, tree, &laplace, NULL, &error), &error);
    check(icc_function_get_info(field, &info), &error);
    check(icc_function_get_report(field, &critical, NULL, &error), &error);
    s.logs = icc_function_logs(field);
    draw("another function, discretely harmonic: 1 at the maximum, 0 outside; minus its logarithm",
         &s, log_mark);
    printf("%zu maximum, %zu minima, %zu saddles; the least value is %.2g\n", critical.n_maxima,
           critical.n_minima, critical.n_saddles, exp(info.least_log));
    printf("it breaks the inequality of %zu tree edges; equations hold to %.1g\n", info.n_violated,
           info.residual);

    icc_function_free(field);
    icc_tree_free(tree);
    icc_grid_free(grid);
    icc_domain_free(domain);
    return EXIT_SUCCESS;
}
