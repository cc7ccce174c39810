/* Deforms a triangulation of sparse points, as the thesis does for its figures (chapter 6): the
 * corners are mapped, and the determinant of every triangle's matrix (equation 2.2) tells whether
 * it has kept its orientation, collapsed, or turned over. */
#include <icc/stages.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N_BOUNDARY = 16, N_INSIDE = 9, N = N_BOUNDARY + N_INSIDE };
enum { N_TRIANGLES = 2 * N - N_BOUNDARY - 2 };

/* A bar of length 4 and width 2, and points in it. */
static const double BAR[N][2] = {
    {0, 0},     {1, 0},     {2, 0},     {3, 0},     {4, 0},     {4, 0.5},   {4, 1},
    {4, 1.5},   {4, 2},     {3, 2},     {2, 2},     {1, 2},     {0, 2},     {0, 1.5},
    {0, 1},     {0, 0.5},   {0.7, 0.6}, {0.6, 1.4}, {1.2, 1.1}, {1.7, 0.5}, {1.9, 1.5},
    {2.4, 1.0}, {2.9, 0.5}, {3.1, 1.5}, {3.5, 1.0},
};

static void check(icc_status status, const icc_error *error)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "sparse_points: %s\n", error->message);
    exit(EXIT_FAILURE);
}

/* Bends the bar to an arc of 120 degrees. */
static void bend(const double *p, double *image)
{
    const double angle = (p[0] - 2) * 3.14159265358979323846 / 6;
    image[0] = (3 - p[1]) * sin(angle);
    image[1] = -(3 - p[1]) * cos(angle);
}

/* det [b - a | c - a] */
static double determinant(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

int main(void)
{
    double cage[N_BOUNDARY][2], images[N][2];
    for (int i = 0; i < N_BOUNDARY; ++i)
        bend(BAR[i], cage[i]);

    icc_error error = {.size = sizeof error};
    uint32_t triangles[N_TRIANGLES][3];
    icc_domain *source, *target;
    icc_map *map;
    size_t n_failed;
    check(icc_triangulate(N_BOUNDARY, N, BAR[0], triangles[0], NULL, &error), &error);
    check(icc_domain_create(&source, 2, N_BOUNDARY, BAR[0], 0, NULL, NULL, &error), &error);
    check(icc_domain_create(&target, 2, N_BOUNDARY, cage[0], 0, NULL, NULL, &error), &error);
    check(icc_map_create(&map, source, target, NULL, NULL, &error), &error);
    check(icc_map_apply(map, N, BAR[0], images[0], NULL, &n_failed, NULL), &error);

    size_t n_collapsed = 0, n_inverted = 0;
    printf("triangle   corners       det M\n");
    for (int i = 0; i < N_TRIANGLES; ++i) {
        const uint32_t *t = triangles[i];
        const double det = determinant(images[t[0]], images[t[1]], images[t[2]]) /
                           determinant(BAR[t[0]], BAR[t[1]], BAR[t[2]]);
        /* Rounding leaves about 1e-16; the points are of size 1. */
        const char *verdict = det > 1e-12 ? "" : det < -1e-12 ? "  inverted" : "  collapsed";
        n_inverted += det < -1e-12;
        n_collapsed += fabs(det) <= 1e-12;
        printf("%5d   %3u %3u %3u  %9.5f%s\n", i, (unsigned)t[0], (unsigned)t[1], (unsigned)t[2],
               det, verdict);
    }
    printf("%d triangles, %zu collapsed, %zu inverted; %zu points without an image\n", N_TRIANGLES,
           n_collapsed, n_inverted, n_failed);

    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    return EXIT_SUCCESS;
}
