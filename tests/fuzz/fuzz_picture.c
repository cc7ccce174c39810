/* Any bytes at all must give a picture or a reason, and what is written of a picture must read back
 * as the same, from JPEG as one of the same size. Each input is tried as it is, and as a PNG with
 * the checksums of its chunks put right, behind which most of the reader lies. */
#include "fuzz.h"
#include "picture/picture_file.h"

#include <math.h>
#include <zlib.h>

/* Larger ones only take time. */
enum { MOST_PIXELS = 1 << 18 };

static uint32_t big_endian(const char *p)
{
    uint32_t value = 0;
    for (int i = 0; i < 4; i++)
        value = value << 8 | (unsigned char)p[i];
    return value;
}

static void put_checksums(char *bytes, size_t n)
{
    size_t at = 8;
    while (at + 12 <= n) {
        size_t length = big_endian(bytes + at);
        if (length > n - at - 12)
            return;
        uint32_t sum = (uint32_t)crc32(0, (const Bytef *)bytes + at + 4, (uInt)length + 4);
        for (size_t i = 0; i < 4; i++)
            bytes[at + 8 + length + i] = (char)(sum >> (24 - 8 * i));
        at += length + 12;
    }
}

/* Whether a PNG is large, or a JPEG, as one of its segments for a frame says. Others hold all their
 * pixels. */
static bool is_large(const char *bytes, size_t n)
{
    picture_format format = picture_told(bytes, n);
    if (format == PICTURE_PNG)
        return n >= 24 && (uint64_t)big_endian(bytes + 16) * big_endian(bytes + 20) > MOST_PIXELS;
    for (size_t i = 2; i + 9 <= n && format == PICTURE_JPEG; i++) {
        uint32_t size = big_endian(bytes + i + 5);
        if ((unsigned char)bytes[i] == 0xff && ((unsigned char)bytes[i + 1] >> 4) == 0xc &&
            (uint64_t)(size >> 16) * (size & 0xffff) > MOST_PIXELS)
            return true;
    }
    return false;
}

static void require_written(const picture *p, picture_format format)
{
    problem wrong;
    size_t n, n_numbers = p->width * p->height * p->channels;
    unsigned char *bytes =
        picture_encode(p, &(picture_style){.format = format, .notes = &p->notes}, &n, &wrong);
    require(bytes != NULL);
    char *exact = malloc(n + 1);
    if (exact == NULL)
        exit(0);
    memcpy(exact, bytes, n);
    exact[n] = '\0';
    picture back;
    require(picture_decode(&back, exact, n, &wrong));
    require(back.width == p->width && back.height == p->height && back.channels == p->channels);
    require(format == PICTURE_JPEG || back.depth == p->depth);
    for (size_t i = 0; i < n_numbers && format != PICTURE_JPEG; i++)
        require(p->values == NULL ? back.samples[i] == p->samples[i]
                                  : back.values[i] == p->values[i] ||
                                        (isnan(back.values[i]) && isnan(p->values[i])));
    picture_free(&back);
    free(exact);
    free(bytes);
}

static void try_picture(const char *bytes, size_t n)
{
    picture p;
    problem wrong = {.text = ""};
    if (!picture_decode(&p, bytes, n, &wrong)) {
        require(p.samples == NULL && p.values == NULL && wrong.text[0] != '\0');
        require(strlen(wrong.text) < sizeof wrong.text);
        return;
    }
    require(p.width > 0 && p.height > 0 && p.channels >= 1);
    require(p.channels <= (p.format == PICTURE_NPY ? PICTURE_MOST_CHANNELS : 4));
    require((p.values != NULL) == (p.depth == 32 || p.depth == 64));
    require((p.samples != NULL) == (p.depth == 8 || p.depth == 16));
    for (size_t i = 0; i < p.width * p.height * p.channels && p.samples != NULL; i++)
        require(p.samples[i] >> p.depth == 0);
    require_written(&p, PICTURE_NPY);
    if (!picture_is_plain(&p)) {
        picture_free(&p);
        return;
    }
    require_written(&p, PICTURE_PNG);
    require_written(&p, PICTURE_PAM);
    if (p.channels % 2 == 1 && p.width <= UINT16_MAX - 36 && p.height <= UINT16_MAX - 36)
        require_written(&p, PICTURE_JPEG);
    picture_free(&p);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *bytes = text_of(data, size);
    if (bytes == NULL)
        return 0;
    if (!is_large(bytes, size)) {
        try_picture(bytes, size);
        put_checksums(bytes, size);
        try_picture(bytes, size);
    }
    free(bytes);
    return 0;
}
