/* Warps a picture: what lies inside one cage follows it into another.
 *
 *     warp_picture SOURCE.txt TARGET.txt IN.png OUT.png
 *
 * A cage is a text file with one vertex `x y` per line, in pixels, x to the right and y down.
 * Vertex i of the source goes to vertex i of the target. What lies outside the target becomes
 * transparent. */
#include <icc/icc.h>

#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static void stop(const char *what, const char *why)
{
    fprintf(stderr, "warp_picture: %s: %s\n", what, why);
    exit(EXIT_FAILURE);
}

static void *allocate(size_t n, size_t size)
{
    void *memory = calloc(n, size);
    if (memory == NULL)
        stop("memory", "there is not enough of it");
    return memory;
}

static double seconds(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static icc_domain *read_cage(const char *path)
{
    enum { MOST = 100000 };
    double *xy = allocate(MOST, 2 * sizeof *xy);
    FILE *file = fopen(path, "r");
    if (file == NULL)
        stop(path, "cannot be opened");
    size_t n = 0;
    while (n < MOST && fscanf(file, "%lf %lf", &xy[2 * n], &xy[2 * n + 1]) == 2)
        ++n;
    if (!feof(file))
        stop(path, "is not a list of points `x y`");
    fclose(file);

    icc_domain *domain;
    icc_error error = {.size = sizeof error};
    if (icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, &error) != ICC_OK)
        stop(path, error.message);
    free(xy);
    return domain;
}

/* Finds the source of every pixel: the image of its centre under the inverse map. Pixels outside
 * the target get NaN, and so do those that the method cannot map. */
static double *find_sources(const icc_map *map, size_t width, size_t height, const icc_env *env)
{
    const size_t n = width * height;
    double *points = allocate(n, 2 * sizeof *points);
    icc_status *status = allocate(n, sizeof *status);
    for (size_t i = 0; i < n; ++i) {
        points[2 * i] = (double)(i % width) + 0.5;
        points[2 * i + 1] = (double)(i / width) + 0.5;
    }
    const icc_status result = icc_map_apply_inverse(map, n, points, points, status, NULL, env);
    if (result != ICC_OK)
        stop("mapping the pixels", icc_status_name(result));

    size_t n_inside = 0, n_lost = 0;
    for (size_t i = 0; i < n; ++i) {
        n_inside += status[i] != ICC_ERR_OUTSIDE;
        n_lost += status[i] != ICC_OK && status[i] != ICC_ERR_OUTSIDE;
    }
    printf("  pixels inside the target  %8zu\n", n_inside);
    printf("  of these without a source %8zu\n", n_lost);
    free(status);
    return points;
}

/* The colour at (x, y), mixed from the four pixels whose centres are nearest. */
static void sample(const png_image *image, const png_byte *pixels, double x, double y,
                   png_byte colour[4])
{
    const double u = fmin(fmax(x - 0.5, 0), image->width - 1.0);
    const double v = fmin(fmax(y - 0.5, 0), image->height - 1.0);
    const size_t i = (size_t)u, j = (size_t)v;
    const size_t right = i + 1 < image->width, below = j + 1 < image->height;
    const png_byte *a = pixels + 4 * (i + image->width * j);
    const png_byte *b = a + 4 * image->width * below;
    const double du = u - (double)i, dv = v - (double)j;
    for (int c = 0; c < 4; ++c) {
        const double top = a[c] + du * (a[4 * right + (size_t)c] - a[c]);
        const double bottom = b[c] + du * (b[4 * right + (size_t)c] - b[c]);
        colour[c] = (png_byte)lround(top + dv * (bottom - top));
    }
}

static void print_time(const char *stage, double time)
{
    printf("  %-25s %8.2f ms\n", stage, 1e3 * time);
}

/* What making the map's two charts took, stage by stage. */
static void print_chart_times(const icc_map *map)
{
    icc_chart_info source = {.size = sizeof source}, target = {.size = sizeof target};
    if (icc_chart_get_info(icc_map_source_chart(map), &source) != ICC_OK ||
        icc_chart_get_info(icc_map_target_chart(map), &target) != ICC_OK)
        return;
    print_time("  grids and their maxima", source.seconds_grid + target.seconds_grid);
    print_time("  trees", source.seconds_tree + target.seconds_tree);
    print_time("  functions", source.seconds_field + target.seconds_field);
}

int main(int argc, char **argv)
{
    if (argc != 5)
        stop("usage", "warp_picture SOURCE.txt TARGET.txt IN.png OUT.png");

    const double start = seconds();
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, argv[3]))
        stop(argv[3], image.message);
    image.format = PNG_FORMAT_RGBA;
    const size_t n = (size_t)image.width * image.height;
    png_byte *before = allocate(n, 4), *after = allocate(n, 4);
    if (!png_image_finish_read(&image, NULL, before, 0, NULL))
        stop(argv[3], image.message);
    icc_domain *source = read_cage(argv[1]), *target = read_cage(argv[2]);

    const double have_input = seconds();
    icc_map *map;
    icc_error error = {.size = sizeof error};
    if (icc_map_create(&map, source, target, NULL, NULL, &error) != ICC_OK)
        stop("making the map", error.message);

    const double have_map = seconds();
    const icc_env two_threads = {.size = sizeof two_threads, .threads = 2};
    double *sources = find_sources(map, image.width, image.height, &two_threads);

    const double have_sources = seconds();
    for (size_t i = 0; i < n; ++i)
        if (!isnan(sources[2 * i]))
            sample(&image, before, sources[2 * i], sources[2 * i + 1], after + 4 * i);

    const double have_pixels = seconds();
    if (!png_image_write_to_file(&image, argv[4], 0, after, 0, NULL))
        stop(argv[4], image.message);
    print_time("read picture and cages", have_input - start);
    print_time("make the map", have_map - have_input);
    print_chart_times(map);
    print_time("map the pixels", have_sources - have_map);
    print_time("mix the colours", have_pixels - have_sources);
    print_time("write the picture", seconds() - have_pixels);
    printf("the result is %s\n", argv[4]);

    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    free(sources);
    free(before);
    free(after);
    return EXIT_SUCCESS;
}
