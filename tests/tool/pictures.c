/* Pictures for the tests of `libicc warp`, read and written with libpng alone.
 *
 *     pictures make FILE WIDTH HEIGHT CHANNELS DEPTH PATTERN   PATTERN: ramp, flat, stripes
 *     pictures palette FILE WIDTH HEIGHT       4 colours, 2 bits a pixel, one of them transparent
 *     pictures same FILE FILE                  fails unless size, kind and every sample agree
 *     pictures near FILE FILE DISTANCE         the same, but that samples may differ by so much
 *     pictures at FILE X Y                     prints the samples of a pixel
 *     pictures kind FILE                       prints WIDTH HEIGHT CHANNELS DEPTH
 */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct image {
    png_uint_32 width, height;
    int channels, depth;
    size_t row_bytes;
    png_byte *rows;
} image;

static void quit(const char *what)
{
    fprintf(stderr, "pictures: %s\n", what);
    exit(1);
}

static image load(const char *name)
{
    FILE *file = fopen(name, "rb");
    if (file == NULL)
        quit(name);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png)))
        quit(name);
    png_init_io(png, file);
    png_read_info(png, info);
    png_set_expand(png);
    png_read_update_info(png, info);
    image i = {.width = png_get_image_width(png, info),
               .height = png_get_image_height(png, info),
               .channels = png_get_channels(png, info),
               .depth = png_get_bit_depth(png, info),
               .row_bytes = png_get_rowbytes(png, info)};
    i.rows = calloc(i.height, i.row_bytes);
    for (png_uint_32 y = 0; y < i.height; y++)
        png_read_row(png, i.rows + y * i.row_bytes, NULL);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
    return i;
}

static void save(const char *name, const image *i, int colour_type)
{
    static const png_color colours[4] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {9, 9, 9}};
    static const png_byte alphas[4] = {255, 255, 255, 0};
    FILE *file = fopen(name, "wb");
    if (file == NULL)
        quit(name);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png)))
        quit(name);
    png_init_io(png, file);
    png_set_IHDR(png, info, i->width, i->height, i->depth, colour_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (colour_type == PNG_COLOR_TYPE_PALETTE) {
        png_set_PLTE(png, info, colours, 4);
        png_set_tRNS(png, info, alphas, 4, NULL);
    }
    png_write_info(png, info);
    for (png_uint_32 y = 0; y < i->height; y++)
        png_write_row(png, i->rows + y * i->row_bytes);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

/* Something that differs from sample to sample, linear in x and y, or in stripes of one pixel. */
static unsigned sample(const char *pattern, unsigned x, unsigned y, unsigned channel,
                       unsigned largest)
{
    if (strcmp(pattern, "flat") == 0)
        return largest / 3 + channel;
    if (strcmp(pattern, "stripes") == 0)
        return x % 2 == 0 ? largest : 0;
    return (largest / 64) * ((channel % 2 == 0 ? x : y) + channel) % (largest + 1);
}

static void make(char **argv)
{
    static const int colour_types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                       PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
    image i = {.width = (png_uint_32)atoi(argv[3]),
               .height = (png_uint_32)atoi(argv[4]),
               .channels = atoi(argv[5]),
               .depth = atoi(argv[6])};
    size_t bytes = (size_t)i.depth / 8;
    i.row_bytes = i.width * (size_t)i.channels * bytes;
    i.rows = calloc(i.height, i.row_bytes);
    for (size_t k = 0; k < i.height * i.row_bytes / bytes; k++) {
        size_t pixel = k / (size_t)i.channels;
        unsigned value = sample(argv[7], (unsigned)(pixel % i.width), (unsigned)(pixel / i.width),
                                (unsigned)(k % (size_t)i.channels), i.depth == 16 ? 65535 : 255);
        if (bytes == 2)
            i.rows[2 * k] = (png_byte)(value >> 8);
        i.rows[bytes * k + bytes - 1] = (png_byte)(value & 255);
    }
    save(argv[2], &i, colour_types[i.channels - 1]);
    free(i.rows);
}

static void palette(char **argv)
{
    image i = {.width = (png_uint_32)atoi(argv[3]),
               .height = (png_uint_32)atoi(argv[4]),
               .channels = 1,
               .depth = 2};
    i.row_bytes = (i.width + 3) / 4;
    i.rows = calloc(i.height, i.row_bytes);
    memset(i.rows, 0x1b, i.height * i.row_bytes);
    save(argv[2], &i, PNG_COLOR_TYPE_PALETTE);
    free(i.rows);
}

static int same(char **argv)
{
    image a = load(argv[2]), b = load(argv[3]);
    int differ = a.width != b.width || a.height != b.height || a.channels != b.channels ||
                 a.depth != b.depth || memcmp(a.rows, b.rows, a.height * a.row_bytes) != 0;
    free(a.rows);
    free(b.rows);
    return differ;
}

static int near(char **argv)
{
    image a = load(argv[2]), b = load(argv[3]);
    int differ = a.width != b.width || a.height != b.height || a.channels != b.channels ||
                 a.depth != 8 || b.depth != 8;
    for (size_t i = 0; !differ && i < a.height * a.row_bytes; i++)
        differ = abs(a.rows[i] - b.rows[i]) > atoi(argv[4]);
    free(a.rows);
    free(b.rows);
    return differ;
}

static void at(char **argv)
{
    image i = load(argv[2]);
    size_t bytes = (size_t)i.depth / 8, x = (size_t)atoi(argv[3]), y = (size_t)atoi(argv[4]);
    const png_byte *p = i.rows + y * i.row_bytes + x * (size_t)i.channels * bytes;
    for (int c = 0; c < i.channels; c++, p += bytes)
        printf("%s%d", c > 0 ? " " : "", bytes == 2 ? p[0] * 256 + p[1] : p[0]);
    puts("");
    free(i.rows);
}

static void kind(char **argv)
{
    image i = load(argv[2]);
    printf("%u %u %d %d\n", (unsigned)i.width, (unsigned)i.height, i.channels, i.depth);
    free(i.rows);
}

int main(int argc, char **argv)
{
    if (argc == 8 && strcmp(argv[1], "make") == 0)
        make(argv);
    else if (argc == 5 && strcmp(argv[1], "palette") == 0)
        palette(argv);
    else if (argc == 4 && strcmp(argv[1], "same") == 0)
        return same(argv);
    else if (argc == 5 && strcmp(argv[1], "near") == 0)
        return near(argv);
    else if (argc == 5 && strcmp(argv[1], "at") == 0)
        at(argv);
    else if (argc == 3 && strcmp(argv[1], "kind") == 0)
        kind(argv);
    else
        quit("usage: see the source");
    return 0;
}
