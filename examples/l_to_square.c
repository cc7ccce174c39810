/* An L becomes a square (thesis, figures 6.1 and 6.2).
 *
 *     l_to_square OUT.svg
 *
 * Draws a checkerboard in the L (left) and where the map takes it in the square (right), with
 * integral lines from the boundary to the maximum. Above on the default grid, below on one twice
 * as fine. */
#include <icc/icc.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 8, SIDE = 300, GAP = 20 };

/* Vertex i of one goes to vertex i of the other: the L's inner corner becomes the square's. */
static const double L[N][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}};
static const double SQUARE[N][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

static void check(icc_status status, const icc_error *error)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "l_to_square: %s\n", error->message);
    exit(EXIT_FAILURE);
}

/* The checkerboard's colour at a point of the L. */
static int is_dark(const double *p)
{
    return ((int)floor(8 * p[0]) + (int)floor(8 * p[1])) % 2 == 0;
}

/* Paints one row of pixels as runs of one colour. `sources` says what to look up for each pixel. A run reaches a bit
 * under its neighbours to the right and above, or the paper would shine through at other scales. */
static void draw_row(FILE *svg, int row, const double *sources)
{
    for (int i = 0, end; i < SIDE; i = end) {
        for (end = i + 1; end < SIDE && !isnan(sources[2 * i]) && !isnan(sources[2 * end]) &&
                          is_dark(sources + 2 * end) == is_dark(sources + 2 * i);)
            ++end;
        if (!isnan(sources[2 * i]))
            fprintf(svg, "<path class='%s' d='M%d %d.5h%d.4'/>\n",
                    is_dark(sources + 2 * i) ? "dark" : "light", i, SIDE - 1 - row, end - i);
    }
}

/* Every pixel of the panel: its centre in the L itself, or carried back to it from the square. */
static void draw_checkerboard(FILE *svg, const icc_map *map, int in_square)
{
    static double points[2 * SIDE], sources[2 * SIDE];
    static icc_status status[SIDE];
    for (int row = 0; row < SIDE; ++row) {
        for (int i = 0; i < SIDE; ++i) {
            points[2 * i] = 2 * (i + 0.5) / SIDE;
            points[2 * i + 1] = 2 * (row + 0.5) / SIDE;
        }
        const icc_status result =
            in_square ? icc_map_apply_inverse(map, SIDE, points, sources, status, NULL, NULL)
                      : icc_map_apply(map, SIDE, points, sources, status, NULL, NULL);
        if (result != ICC_OK)
            exit(EXIT_FAILURE);
        for (int i = 0; i < 2 * SIDE && !in_square; ++i)
            sources[i] = status[i / 2] == ICC_OK ? points[i] : NAN;
        draw_row(svg, row, sources);
    }
}

/* Integral lines through points spread along the boundary. */
static void draw_lines(FILE *svg, const icc_chart *chart, const double (*corner)[2])
{
    enum { PER_EDGE = 5, MOST = 4000 };
    static double curve[MOST][2];
    icc_error error = {.size = sizeof error};
    for (int i = 0; i < N * PER_EDGE; ++i) {
        const double *a = corner[i / PER_EDGE], *b = corner[(i / PER_EDGE + 1) % N];
        const double share = (i % PER_EDGE + 0.5) / PER_EDGE;
        const double start[2] = {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
        size_t n = 0;
        check(icc_chart_trace(chart, start, MOST, curve[0], &n, NULL, &error), &error);
        fprintf(svg, "<polyline points='");
        for (size_t k = 0; k < n && k < MOST; ++k)
            fprintf(svg, "%.1f,%.1f ", SIDE / 2.0 * curve[k][0], SIDE - SIDE / 2.0 * curve[k][1]);
        fprintf(svg, "'/>\n");
    }
}

static void draw_panel(FILE *svg, const icc_map *map, int column, int row)
{
    fprintf(svg, "<g transform='translate(%d %d)'>\n", GAP + column * (SIDE + GAP),
            GAP + row * (SIDE + GAP));
    draw_checkerboard(svg, map, column == 1);
    draw_lines(svg, column == 0 ? icc_map_source_chart(map) : icc_map_target_chart(map),
               column == 0 ? L : SQUARE);
    fprintf(svg, "</g>\n");
}

int main(int argc, char **argv)
{
    FILE *svg = argc == 2 ? fopen(argv[1], "w") : NULL;
    if (svg == NULL) {
        fprintf(stderr, "usage: l_to_square OUT.svg\n");
        return EXIT_FAILURE;
    }
    icc_domain *source, *target;
    icc_error error = {.size = sizeof error};
    check(icc_domain_create(&source, 2, N, L[0], 0, NULL, NULL, &error), &error);
    check(icc_domain_create(&target, 2, N, SQUARE[0], 0, NULL, NULL, &error), &error);

    fprintf(svg, "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d'>\n",
            2 * SIDE + 3 * GAP, 2 * SIDE + 3 * GAP);
    fprintf(svg, "<style>.dark{stroke:#4a78b5}.light{stroke:#f4d58d}"
                 ".dark,.light{stroke-width:1.6}"
                 "polyline{fill:none;stroke:#b03a2e;stroke-width:.7}</style>\n");
    for (int row = 0; row < 2; ++row) {
        const icc_chart_options chart = {
            .size = sizeof chart, .method = ICC_METHOD_GRADIENT, .cells = row == 0 ? 50 : 100};
        const icc_map_options options = {.size = sizeof options, .chart = &chart};
        icc_map *map;
        icc_map_report report = ICC_INIT(icc_map_report);
        check(icc_map_create(&map, source, target, &options, NULL, &error), &error);
        check(icc_map_get_report(map, &report), &error);
        printf("  making the map with %3d cells %8.2f ms\n", chart.cells, 1e3 * report.seconds);
        draw_panel(svg, map, 0, row);
        draw_panel(svg, map, 1, row);
        icc_map_free(map);
    }
    fprintf(svg, "</svg>\n");
    icc_domain_free(source);
    icc_domain_free(target);
    if (fclose(svg) != 0) {
        perror(argv[1]);
        return EXIT_FAILURE;
    }
    printf("the result is %s\n", argv[1]);
    return EXIT_SUCCESS;
}
