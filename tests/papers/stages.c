/* A program that uses a library of the papers alone (ICC_PAPERS_ONLY): each stage on an L, then a chart, and what is left out.
 * usage: stages */
#include <icc/icc.h>

#include <math.h>
#include <stdio.h>

static icc_error error = {.size = sizeof error};

#define NEED(condition)                                                                            \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            printf("line %d: not true: %s; %s\n", __LINE__, #condition, error.message);            \
            return 1;                                                                              \
        }                                                                                          \
    } while (0)

static int by_stages(const icc_domain *domain)
{
    const double point[2] = {0.3, 1.5};
    icc_grid *grid;
    icc_tree *tree;
    icc_function *function;
    icc_curves *curves;
    icc_curves_info info = {.size = sizeof info};
    uint32_t root;
    NEED(icc_grid_create(&grid, domain, 20, NULL, &error) == ICC_OK);
    NEED(icc_grid_find_maximum(grid, &root, NULL, NULL, &error) == ICC_OK);
    NEED(icc_tree_create(&tree, grid, root, NULL, NULL, &error) == ICC_OK);
    NEED(icc_function_create(&function, tree, NULL, NULL, &error) == ICC_OK);
    NEED(icc_curves_create(&curves, function, 1, point, ICC_WAY_DOWN, NULL, &error) == ICC_OK);
    NEED(icc_curves_get_info(curves, &info) == ICC_OK && info.n_vertices >= 2);
    icc_curves_free(curves);
    icc_function_free(function);
    icc_tree_free(tree);
    icc_grid_free(grid);
    return 0;
}

/* Takes a point to its coordinates and back, in the chart and in one that is loaded from its bytes. */
static int by_chart(const icc_domain *domain)
{
    static char bytes[1 << 16];
    const icc_chart_options options = {
        .size = sizeof options, .method = ICC_METHOD_GRADIENT, .cells = 20};
    const double point[2] = {0.3, 1.5};
    icc_chart *charts[2];
    size_t n_bytes;
    NEED(icc_chart_create(&charts[0], domain, &options, NULL, &error) == ICC_OK);
    NEED(icc_chart_save(charts[0], sizeof bytes, bytes, &n_bytes) == ICC_OK &&
         n_bytes <= sizeof bytes);
    NEED(icc_chart_load(&charts[1], n_bytes, bytes, NULL, &error) == ICC_OK);
    for (int k = 0; k < 2; ++k) {
        double bary[2], t, back[2];
        uint32_t facet;
        NEED(icc_chart_encode(charts[k], 1, point, &facet, bary, &t, NULL, NULL, NULL) == ICC_OK);
        NEED(icc_chart_decode(charts[k], 1, &facet, bary, &t, back, NULL, NULL, NULL) == ICC_OK);
        NEED(fabs(back[0] - point[0]) < 1e-9 && fabs(back[1] - point[1]) < 1e-9);
    }
    icc_chart_free(charts[0]);
    icc_chart_free(charts[1]);
    return 0;
}

int main(void)
{
    static const double corners[] = {0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2};
    icc_domain *domain;
    icc_chart *chart;
    NEED(icc_domain_create(&domain, 2, 6, corners, 0, NULL, NULL, &error) == ICC_OK);
    if (by_stages(domain) != 0 || by_chart(domain) != 0)
        return 1;
    /* No other method is there, and the default is another. */
    NEED(icc_chart_create(&chart, domain, NULL, NULL, &error) == ICC_ERR_UNSUPPORTED &&
         chart == NULL);
    icc_domain_free(domain);
    printf("libicc %s, the papers alone\n", icc_version());
    return 0;
}
