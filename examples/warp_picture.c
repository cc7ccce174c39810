/* Warps a picture: what lies inside one cage follows it into another.
 *
 *     warp_picture SOURCE.txt TARGET.txt IN.png OUT.png
 *
 * A cage is a text file with one vertex `x y` per line, in pixels, x to the right and y down.
 * Vertex i of the source goes to vertex i of the target. What lies outside the target becomes
 * transparent. */
#include <icc/icc.h>

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

/* Draws the warped picture. Pixels outside the target are left as they are. */
static void warp(const icc_map *map, const png_image *image, png_byte *before, png_byte *after)
{
    const icc_env two_threads = {.size = sizeof two_threads, .threads = 2};
    icc_error error = {.size = sizeof error};
    const icc_picture from = {.size = sizeof from,
                              .width = (int32_t)image->width,
                              .height = (int32_t)image->height,
                              .channels = 4,
                              .bytes = 1,
                              .alpha = 1,
                              .stride = 4 * (size_t)image->width,
                              .pixels = before};
    icc_picture to = from;
    to.pixels = after;
    if (icc_map_warp(map, &from, &to, NULL, &two_threads, &error) != ICC_OK)
        stop("warping", error.message);
}

static void print_time(const char *stage, double time)
{
    printf("  %-25s %8.2f ms\n", stage, 1e3 * time);
}

/* What the map is, and what making it took. */
static void describe(const icc_map *map)
{
    icc_map_info info = ICC_INIT(icc_map_info);
    icc_map_report report = ICC_INIT(icc_map_report);
    if (icc_map_get_info(map, &info) != ICC_OK || icc_map_get_report(map, &report) != ICC_OK)
        return;
    print_time("  of that, repairing it", report.seconds_repair);
    print_time("  making it fair", report.seconds_improve);
    print_time("  certifying it", report.seconds_certify);
    printf("  the map has %zu triangles and is %s\n", info.n_simplices,
           info.certified ? "certified to be one-to-one" : "not certified");
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
    warp(map, &image, before, after);

    const double have_pixels = seconds();
    if (!png_image_write_to_file(&image, argv[4], 0, after, 0, NULL))
        stop(argv[4], image.message);
    print_time("read picture and cages", have_input - start);
    print_time("make the map", have_map - have_input);
    describe(map);
    print_time("warp the pixels", have_pixels - have_map);
    print_time("write the picture", seconds() - have_pixels);
    printf("the result is %s\n", argv[4]);

    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    free(before);
    free(after);
    return EXIT_SUCCESS;
}
