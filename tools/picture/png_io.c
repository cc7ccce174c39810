/* PNG through libpng. Notes in the file about colours (gAMA, cHRM, sRGB, iCCP) and about the size
 * of pixels (pHYs) become the picture's notes. */
#include "picture/picture_file.h"

#include "base/allocate.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    png_structp png;
    png_infop info;
    const png_byte *bytes; /* the bytes left to read */
    size_t n;
    char message[160];
} reader;

/* Limit on the bytes of a colour profile, because a few bytes of a file can announce 2^32. */
enum { MOST_NOTES = 1 << 24 };

typedef struct writer {
    png_structp png;
    png_infop info;
    unsigned char *bytes;
    size_t n, room;
    char message[160];
} writer;

/* Both structs end in the same way: a message of 160 bytes, which libpng gets as its error
 * pointer. */
static void stop(png_structp png, png_const_charp message)
{
    snprintf(png_get_error_ptr(png), 160, "%s", message);
    longjmp(png_jmpbuf(png), 1);
}

static void ignore(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void take_bytes(png_structp png, png_bytep to, size_t n)
{
    reader *r = png_get_io_ptr(png);
    if (n > r->n)
        png_error(png, "the file ends early");
    memcpy(to, r->bytes, n);
    r->bytes += n;
    r->n -= n;
}

static void give_bytes(png_structp png, png_bytep from, size_t n)
{
    writer *w = png_get_io_ptr(png);
    w->bytes = grow(w->bytes, &w->room, w->n + n, 1);
    memcpy(w->bytes + w->n, from, n);
    w->n += n;
}

static void no_flush(png_structp png)
{
    (void)png;
}

/* Converts a row of libpng, most significant byte first, to samples. */
static void unpack(picture *p, const png_byte *row, size_t y)
{
    size_t n = p->width * p->channels;
    uint16_t *to = p->samples + y * n;
    for (size_t i = 0; i < n; i++)
        to[i] = p->depth == 8 ? row[i] : (uint16_t)(row[2 * i] << 8 | row[2 * i + 1]);
}

static void pack(const picture *p, png_byte *row, size_t y)
{
    size_t n = p->width * p->channels;
    const uint16_t *from = p->samples + y * n;
    for (size_t i = 0; i < n; i++) {
        if (p->depth == 16)
            *row++ = (png_byte)(from[i] >> 8);
        *row++ = (png_byte)(from[i] & 255);
    }
}

static void read_notes(const reader *r, picture_notes *notes)
{
    int32_t *v = notes->primaries;
    png_uint_32 x, y, length;
    png_charp name;
    png_bytep profile;
    int unit;
    notes->has_gamma = png_get_gAMA_fixed(r->png, r->info, &notes->gamma) != 0;
    notes->has_primaries = png_get_cHRM_fixed(r->png, r->info, v, v + 1, v + 2, v + 3, v + 4, v + 5,
                                              v + 6, v + 7) != 0;
    notes->has_intent = png_get_sRGB(r->png, r->info, &notes->intent) != 0;
    if (png_get_iCCP(r->png, r->info, &name, &unit, &profile, &length)) {
        snprintf(notes->profile_name, sizeof notes->profile_name, "%s", name);
        notes->profile = need(length, 1);
        notes->n_profile = length;
        memcpy(notes->profile, profile, length);
    }
    if (png_get_pHYs(r->png, r->info, &x, &y, &unit)) {
        notes->density[0] = x;
        notes->density[1] = y;
        notes->per_metre = unit == PNG_RESOLUTION_METER;
    }
}

/* All calls from which libpng may jump. The caller frees `rows`. */
static bool decode(reader *r, picture *out, png_byte **rows)
{
    if (setjmp(png_jmpbuf(r->png)))
        return false;
    png_set_read_fn(r->png, r, take_bytes);
    png_set_chunk_malloc_max(r->png, MOST_NOTES);
    png_read_info(r->png, r->info);
    /* A byte of deflated data gives at most 1032 bytes, so a picture that announces more is
     * refused. */
    uint64_t row_size = png_get_rowbytes(r->png, r->info);
    if (row_size * png_get_image_height(r->png, r->info) / 1032 > r->n)
        png_error(r->png, "the file ends early");
    png_set_expand(r->png);
    png_set_interlace_handling(r->png);
    png_read_update_info(r->png, r->info);
    size_t row_bytes = png_get_rowbytes(r->png, r->info);
    *out = picture_make(png_get_image_width(r->png, r->info), png_get_image_height(r->png, r->info),
                        png_get_channels(r->png, r->info), png_get_bit_depth(r->png, r->info));
    *rows = need(out->height, row_bytes + sizeof(png_bytep));
    png_bytep *starts = (png_bytep *)(void *)*rows;
    for (size_t y = 0; y < out->height; y++)
        starts[y] = *rows + out->height * sizeof(png_bytep) + y * row_bytes;
    png_read_image(r->png, starts);
    png_read_end(r->png, r->info);
    for (size_t y = 0; y < out->height; y++)
        unpack(out, starts[y], y);
    read_notes(r, &out->notes);
    return true;
}

/* True if every chunk ends within the file. libpng allocates the announced size of a chunk before
 * it reads it. */
static bool is_whole(const unsigned char *bytes, size_t n)
{
    size_t at = 8;
    while (n - at >= 8) {
        const unsigned char *p = bytes + at;
        size_t length = (size_t)p[0] << 24 | (size_t)p[1] << 16 | (size_t)p[2] << 8 | p[3];
        if (n - at < 12 || length > n - at - 12)
            return false;
        if (memcmp(p + 4, "IEND", 4) == 0)
            return true;
        at += length + 12;
    }
    return false;
}

bool png_decode(picture *out, const char *bytes, size_t n, problem *wrong)
{
    if (n < 8 || png_sig_cmp((png_const_bytep)bytes, 0, 8) != 0)
        return spoilt(wrong, 0, "the PNG picture is damaged: its first bytes are wrong");
    if (!is_whole((const unsigned char *)bytes, n))
        return spoilt(wrong, 0, "the PNG picture is damaged: the file ends early");
    reader r = {.bytes = (const png_byte *)bytes, .n = n};
    r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, r.message, stop, ignore);
    r.info = r.png != NULL ? png_create_info_struct(r.png) : NULL;
    png_byte *rows = NULL;
    bool good = r.info != NULL && decode(&r, out, &rows);
    free(rows);
    png_destroy_read_struct(&r.png, &r.info, NULL);
    if (good)
        return true;
    picture_free(out);
    return spoilt(wrong, 0, "the PNG picture is damaged: %.120s", r.message);
}

static void write_notes(writer *w, const picture_notes *notes)
{
    const int32_t *v = notes->primaries;
    if (notes->has_gamma)
        png_set_gAMA_fixed(w->png, w->info, notes->gamma);
    if (notes->has_primaries)
        png_set_cHRM_fixed(w->png, w->info, v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]);
    if (notes->has_intent)
        png_set_sRGB(w->png, w->info, notes->intent);
    if (notes->profile != NULL)
        png_set_iCCP(w->png, w->info, notes->profile_name, PNG_COMPRESSION_TYPE_BASE,
                     notes->profile, (png_uint_32)notes->n_profile);
    if (notes->density[0] > 0 && notes->density[1] > 0)
        png_set_pHYs(w->png, w->info, notes->density[0], notes->density[1],
                     notes->per_metre ? PNG_RESOLUTION_METER : PNG_RESOLUTION_UNKNOWN);
}

/* All calls of libpng that may fail. It leaves them by longjmp, so nothing is allocated here and
 * `row` comes from the caller. */
static bool encode(writer *w, const picture *p, const picture_notes *notes, png_byte *row)
{
    static const int colour_types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                       PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
    if (setjmp(png_jmpbuf(w->png)))
        return false;
    png_set_write_fn(w->png, w, give_bytes, no_flush);
    png_set_benign_errors(w->png, 1); /* an unusual colour profile was read, so it may be written */
    png_set_IHDR(w->png, w->info, (png_uint_32)p->width, (png_uint_32)p->height, (int)p->depth,
                 colour_types[p->channels - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (notes != NULL)
        write_notes(w, notes);
    png_write_info(w->png, w->info);
    for (size_t y = 0; y < p->height; y++) {
        pack(p, row, y);
        png_write_row(w->png, row);
    }
    png_write_end(w->png, w->info);
    return true;
}

unsigned char *png_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong)
{
    writer w = {0};
    w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, w.message, stop, ignore);
    w.info = w.png != NULL ? png_create_info_struct(w.png) : NULL;
    png_byte *row = need(p->width, 2 * (size_t)p->channels);
    bool good = w.info != NULL && encode(&w, p, style->notes, row);
    free(row);
    png_destroy_write_struct(&w.png, &w.info);
    *n = w.n;
    if (good)
        return w.bytes;
    free(w.bytes);
    spoilt(wrong, 0, "the PNG picture cannot be written: %.120s", w.message);
    return NULL;
}
