/* How much the result depends on the choice of the maximum, and on how the source lies on the grid
 * (thesis, figures 6.5 and 6.6). Maps the same points in different ways and prints how far their
 * images move, in percent of the target's size. */
#include <icc/icc.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 60, ACROSS = 100, MOST = ACROSS * ACROSS };

static const double PI = 3.14159265358979323846;

static void check(icc_status status, const icc_error *error)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "maximum_and_rotation: %s\n", error->message);
    exit(EXIT_FAILURE);
}

/* A shape with three legs, pointing to 90, 210 and 330 degrees, and the same with its legs bent. */
static icc_domain *make_tripus(double bend, double rotation)
{
    double xy[N][2];
    for (int i = 0; i < N; ++i) {
        const double angle = 2 * PI * i / N;
        const double radius = 1 - 0.5 * sin(3 * angle);
        const double turned = angle + rotation + bend * radius;
        xy[i][0] = radius * cos(turned);
        xy[i][1] = radius * sin(turned);
    }
    icc_domain *domain;
    icc_error error = {.size = sizeof error};
    check(icc_domain_create(&domain, 2, N, xy[0], 0, NULL, NULL, &error), &error);
    return domain;
}

/* Points inside the source, evenly spread. */
static size_t spread_points(const icc_domain *domain, double points[MOST][2])
{
    static double all[MOST][2];
    static int32_t where[MOST];
    icc_domain_info info = {.size = sizeof info};
    icc_error error = {.size = sizeof error};
    check(icc_domain_get_info(domain, &info), &error);
    for (size_t i = 0; i < MOST; ++i) {
        const double u = ((double)(i % ACROSS) + 0.5) / ACROSS;
        const double v = ((double)(i / ACROSS) + 0.5) / ACROSS;
        all[i][0] = info.lower[0] + u * (info.upper[0] - info.lower[0]);
        all[i][1] = info.lower[1] + v * (info.upper[1] - info.lower[1]);
    }
    check(icc_domain_locate(domain, MOST, all[0], where, NULL, NULL, NULL), &error);
    size_t n = 0;
    for (size_t i = 0; i < MOST; ++i)
        if (where[i] == ICC_INSIDE) {
            points[n][0] = all[i][0];
            points[n++][1] = all[i][1];
        }
    return n;
}

/* The images of the points when source, points and the source's maximum are turned together. A NULL
 * maximum leaves the choice to the library. */
static void map_points(size_t n, double points[MOST][2], double rotation, const double *maximum,
                       double images[MOST][2])
{
    const double c = cos(rotation), s = sin(rotation);
    for (size_t i = 0; i < n; ++i) {
        images[i][0] = c * points[i][0] - s * points[i][1];
        images[i][1] = s * points[i][0] + c * points[i][1];
    }
    icc_domain *source = make_tripus(0, rotation), *target = make_tripus(0.5, 0);
    const icc_chart_options chart = {
        .size = sizeof chart, .method = ICC_METHOD_GRADIENT, .maximum = maximum};
    const icc_map_options options = {
        .size = sizeof options, .chart = &chart, .target_maximum = maximum};
    icc_map *map;
    icc_error error = {.size = sizeof error};
    check(icc_map_create(&map, source, target, &options, NULL, &error), &error);
    check(icc_map_apply(map, n, images[0], images[0], NULL, NULL, NULL), &error);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Compares two sets of images; points that one of them lacks are counted. */
static void compare(const char *what, size_t n, double a[MOST][2], double b[MOST][2])
{
    static double moved[MOST];
    const double size = 3;
    size_t n_both = 0;
    double sum = 0;
    for (size_t i = 0; i < n; ++i) {
        const double distance = hypot(a[i][0] - b[i][0], a[i][1] - b[i][1]);
        if (isnan(distance))
            continue;
        moved[n_both++] = distance;
        sum += distance;
    }
    if (n_both == 0)
        return;
    qsort(moved, n_both, sizeof *moved, ascending);
    printf("%-28s %7.2f %7.2f %7.2f %7.2f %8zu\n", what, 100 / size * sum / (double)n_both,
           100 / size * moved[n_both / 2], 100 / size * moved[n_both * 95 / 100],
           100 / size * moved[n_both - 1], n - n_both);
}

int main(void)
{
    static double points[MOST][2], images[MOST][2], others[MOST][2];
    icc_domain *domain = make_tripus(0, 0);
    const size_t n = spread_points(domain, points);
    icc_domain_free(domain);

    printf("%zu points          moved by (%%): mean  median     95%%     max   failed\n", n);
    map_points(n, points, 0, NULL, images);
    const double right[2] = {0.25, 0};
    map_points(n, points, 0, right, others);
    compare("the maximum to the right", n, images, others);
    const int degrees[] = {5, 45, 90};
    for (size_t k = 0; k < sizeof degrees / sizeof *degrees; ++k) {
        char what[40];
        snprintf(what, sizeof what, "the source turned by %d deg", degrees[k]);
        map_points(n, points, degrees[k] * PI / 180, NULL, others);
        compare(what, n, images, others);
    }
    return EXIT_SUCCESS;
}
