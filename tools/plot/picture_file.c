/* Chooses the format of a picture's file. */
#include "plot/picture_file.h"

#include "base/file.h"
#include "base/foreign.h"
#include "base/npy.h"
#include "job/output_name.h"

#include <stdlib.h>
#include <string.h>

typedef unsigned char *encoder(const picture *p, const picture_style *style, size_t *n,
                               problem *wrong);

static const struct {
    const char *name;
    encoder *encode;
    bool has_colours, has_alpha;
} formats[] = {
    [PICTURE_PNG] = {"PNG", png_encode, true, true},
    [PICTURE_JPEG] = {"JPEG", jpeg_encode, true, false},
    [PICTURE_NPY] = {"NumPy", npy_encode, true, true},
    [PICTURE_PGM] = {"PGM", pnm_encode, false, false},
    [PICTURE_PPM] = {"PPM", pnm_encode, true, false},
    [PICTURE_PNM] = {"PNM", pnm_encode, true, false},
    [PICTURE_PAM] = {"PAM", pnm_encode, true, true},
};

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

picture_format picture_told(const char *bytes, size_t n)
{
    static const picture_format portable[] = {PICTURE_PGM, PICTURE_PGM, PICTURE_PPM, PICTURE_PGM,
                                              PICTURE_PGM, PICTURE_PPM, PICTURE_PAM};
    if (n >= 4 && memcmp(bytes, "\x89PNG", 4) == 0)
        return PICTURE_PNG;
    if (n >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0)
        return PICTURE_JPEG;
    if (npy_told(bytes, n))
        return PICTURE_NPY;
    if (n >= 3 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
        (is_blank(bytes[2]) || bytes[2] == '#'))
        return portable[bytes[1] - '1'];
    return PICTURE_NONE;
}

bool picture_decode(picture *out, const char *bytes, size_t n, problem *wrong)
{
    *out = (picture){0};
    picture_format format = picture_told(bytes, n);
    if (format == PICTURE_NONE)
        return !foreign_told(bytes, n, wrong) &&
               spoilt(wrong, 0,
                      "this is not a PNG, JPEG, PNM or .npy picture; convert it to PNG first");
    if (!(format == PICTURE_PNG    ? png_decode(out, bytes, n, wrong)
          : format == PICTURE_JPEG ? jpeg_decode(out, bytes, n, wrong)
          : format == PICTURE_NPY  ? npy_decode(out, bytes, n, wrong)
                                   : pnm_decode(out, bytes, n, wrong)))
        return false;
    out->format = format;
    return true;
}

unsigned char *picture_encode(const picture *p, const picture_style *style, size_t *n,
                              problem *wrong)
{
    return formats[style->format].encode(p, style, n, wrong);
}

int picture_take(picture *out, const char *name, const char *bytes, size_t n)
{
    problem wrong;
    return picture_decode(out, bytes, n, &wrong) ? DONE : failed(name, 0, "%s", wrong.text);
}

int picture_read(picture *out, const char *name)
{
    size_t n;
    char *bytes = file_read(name, &n);
    int result = bytes != NULL ? picture_take(out, name, bytes, n) : FAILED;
    free(bytes);
    return result;
}

/* The format of a name's extension. */
static picture_format named(const char *name)
{
    const char *found = output_format(name);
    for (size_t i = PICTURE_PNG; found != NULL && i < sizeof formats / sizeof *formats; i++)
        if (strcmp(found, formats[i].name) == 0)
            return (picture_format)i;
    return PICTURE_NONE;
}

/* If the name has no format, Netpbm's is the simplest that can hold the picture. */
static picture_format like(const picture *p, picture_format format)
{
    if (format < PICTURE_PGM)
        return format;
    return picture_has_alpha(p) ? PICTURE_PAM : format == PICTURE_PAM ? format : PICTURE_PNM;
}

/* Chooses how to write `p`: in the format of the name, or else in that of `from`, with the notes of
 * `from`. */
static int choose(picture_style *style, const picture *p, const picture *from, const args *a,
                  const char *name)
{
    int32_t quality = a->quality;
    picture_format format = named(name);
    if (format == PICTURE_NONE)
        format = like(p, from->format);
    *style = (picture_style){.format = format, .notes = &from->notes, .quality = quality};
    if (quality > 0 && format != PICTURE_JPEG)
        return misused(a->command, "--quality is for JPEG, and '%.200s' will be %s", name,
                       formats[format].name);
    if (!picture_is_plain(p) && format != PICTURE_NPY)
        return failed(name, 0, "the picture has %s, which %s cannot hold; .npy can",
                      p->values != NULL ? "floats" : "more than four channels",
                      formats[format].name);
    if (picture_has_alpha(p) && !formats[format].has_alpha)
        return failed(name, 0,
                      "the picture has an alpha, which %s cannot hold; PNG, PAM and .npy can",
                      formats[format].name);
    if (p->channels >= 3 && !formats[format].has_colours)
        return failed(name, 0, "the picture has colours, which %s cannot hold; PPM can",
                      formats[format].name);
    return DONE;
}

int picture_begin(picture *to, picture_style *style, picture *from, const args *a, const char *name)
{
    bool clears = a->has_background || a->outside == OUTSIDE_NULL;
    if (a->has_background && !picture_is_plain(from))
        return misused(a->command, "--background is a colour, and the picture is an array of %s",
                       from->values != NULL ? "floats" : "more than four channels");
    if (clears && from->values == NULL && !picture_is_plain(from))
        return misused(a->command, "an array of whole numbers with more than four channels has no "
                                   "value for pixels without an image");
    *to = picture_canvas(from, clears ? a->background : NULL);
    return choose(style, to, from, a, name);
}

int picture_save(const picture *p, const picture_style *style, const char *name)
{
    problem wrong;
    size_t n;
    unsigned char *bytes = picture_encode(p, style, &n, &wrong);
    if (bytes == NULL)
        return failed(name, 0, "%s", wrong.text);
    outfile file;
    int result = outfile_open(&file, name) ? DONE : FAILED;
    if (result == DONE) {
        fwrite(bytes, 1, n, file.stream);
        result = outfile_close(&file) ? DONE : FAILED;
    }
    free(bytes);
    return result;
}
