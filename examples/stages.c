/* The papers' steps on your outline: grid, maximum, tree, function and its curves down to the
 * boundary, drawn as an SVG.
 * usage: stages [CELLS] < OUTLINE > OUT.svg       OUTLINE has a line "x y" for each vertex */
#include <icc/icc.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static icc_error err = {.size = sizeof err};

static void check(icc_status status)
{
    if (status != ICC_OK)
        fprintf(stderr, "stages: %s\n", err.message), exit(EXIT_FAILURE);
}

enum { MOST = 10000, CURVES = 250 };

int main(int argc, char **argv)
{
    double outline[MOST][2], starts[CURVES][2];
    size_t n = 0, first[CURVES + 1];
    while (n < MOST && scanf("%lf %lf", &outline[n][0], &outline[n][1]) == 2)
        ++n;

    icc_domain *domain;
    icc_grid *grid;
    icc_tree *tree;
    icc_function *f;
    icc_curves *curves;
    uint32_t maximum;
    icc_function_options options = ICC_INIT(icc_function_options);
    options.function = ICC_FUNCTION_HARMONIC;
    check(icc_domain_create(&domain, 2, n, outline[0], 0, NULL, NULL, &err));
    check(icc_grid_create(&grid, domain, argc > 1 ? atoi(argv[1]) : 50, NULL, &err));
    check(icc_grid_find_maximum(grid, &maximum, NULL, NULL, &err));
    check(icc_tree_create(&tree, grid, maximum, NULL, NULL, &err));
    check(icc_function_create(&f, tree, &options, NULL, &err));

    icc_grid_info g = ICC_INIT(icc_grid_info);
    icc_grid_get_info(grid, &g);
    double(*at)[2] = malloc(g.n_vertices * sizeof *at), h = g.spacing;
    icc_grid_get_points(grid, g.n_vertices, NULL, at[0]);
    printf(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='%g %g %g %g'>"
        "<g transform='scale(1,-1)' fill='none' stroke-width='%g' shape-rendering='crispEdges'>\n",
        at[0][0], -at[g.n_vertices - 1][1], h * (double)g.shape[0], h * (double)g.shape[1], h / 6);
    for (size_t v = 0, k = 0; v < g.n_vertices; ++v)
        if (icc_grid_inside(grid)[v]) {
            memcpy(starts[k++ * CURVES / g.n_inside], at[v], sizeof at[v]);
            printf("<rect x='%g' y='%g' width='%g' height='%g' fill='hsl(%g,60%%,60%%)'/>\n",
                   at[v][0] - h / 2, at[v][1] - h / 2, h, h, 240 - 240 * icc_function_values(f)[v]);
        }

    check(icc_curves_create(&curves, f, CURVES, starts[0], ICC_WAY_DOWN, NULL, &err));
    icc_curves_info c = ICC_INIT(icc_curves_info);
    icc_curves_get_info(curves, &c);
    double(*bends)[2] = malloc(c.n_vertices * sizeof *bends);
    icc_curves_get_vertices(curves, first, bends[0]);
    for (size_t k = 0; k < CURVES; ++k) {
        printf("<polyline stroke='black' shape-rendering='auto' points='");
        for (size_t i = first[k]; i < first[k + 1]; ++i)
            printf("%g,%g ", bends[i][0], bends[i][1]);
        printf("'/>\n");
    }
    printf("</g></svg>\n");
}
