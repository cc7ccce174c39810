/* Chooses the format of a picture's file. */
#include "picture/picture_file.h"

#include "base/file.h"
#include "base/foreign.h"
#include "base/npy.h"

#include <stdlib.h>
#include <string.h>

typedef unsigned char *encoder(const picture *p, const picture_style *style, size_t *n,
                               problem *wrong);

static const struct {
    picture_kind kind;
    encoder *encode;
} formats[] = {
    [PICTURE_PNG] = {{"PNG", true, true}, png_encode},
    [PICTURE_JPEG] = {{"JPEG", true, false}, jpeg_encode},
    [PICTURE_NPY] = {{"NumPy", true, true}, npy_encode},
    [PICTURE_PGM] = {{"PGM", false, false}, pnm_encode},
    [PICTURE_PPM] = {{"PPM", true, false}, pnm_encode},
    [PICTURE_PNM] = {{"PNM", true, false}, pnm_encode},
    [PICTURE_PAM] = {{"PAM", true, true}, pnm_encode},
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

const picture_kind *picture_kind_of(picture_format format)
{
    return &formats[format].kind;
}

picture_format picture_kind_named(const char *name)
{
    for (size_t i = PICTURE_PNG; name != NULL && i < sizeof formats / sizeof *formats; i++)
        if (strcmp(name, formats[i].kind.name) == 0)
            return (picture_format)i;
    return PICTURE_NONE;
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
