/* Any bytes at all must give a picture or a reason, and what is written of a picture must read back
 * as the same. Each input is tried as it is, and with the checksums of its chunks put right, behind
 * which most of the reader lies. */
#include "plot/picture.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Larger ones only take time. */
enum { MOST_PIXELS = 1 << 18 };

/* assert() is off in release builds. */
static void require(bool fact)
{
    if (!fact)
        abort();
}

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

static bool is_large(const char *bytes, size_t n)
{
    return n >= 24 && (uint64_t)big_endian(bytes + 16) * big_endian(bytes + 20) > MOST_PIXELS;
}

static void require_written(const picture *p)
{
    problem wrong;
    size_t n;
    unsigned char *bytes = picture_encode(p, p->keep, &n, &wrong);
    require(bytes != NULL);
    char *exact = malloc(n + 1);
    if (exact == NULL)
        exit(0);
    memcpy(exact, bytes, n);
    exact[n] = '\0';
    picture back;
    require(picture_decode(&back, exact, n, &wrong));
    require(back.width == p->width && back.height == p->height && back.channels == p->channels &&
            back.depth == p->depth);
    require(memcmp(back.samples, p->samples,
                   p->width * p->height * p->channels * sizeof *p->samples) == 0);
    picture_free(&back);
    free(exact);
    free(bytes);
}

static void try_picture(const char *bytes, size_t n)
{
    picture p;
    problem wrong = {.text = ""};
    if (!picture_decode(&p, bytes, n, &wrong)) {
        require(p.samples == NULL && wrong.text[0] != '\0');
        require(strlen(wrong.text) < sizeof wrong.text);
        return;
    }
    require(p.width > 0 && p.height > 0 && p.channels >= 1 && p.channels <= 4);
    require(p.depth == 8 || p.depth == 16);
    for (size_t i = 0; i < p.width * p.height * p.channels; i++)
        require(p.samples[i] >> p.depth == 0);
    require_written(&p);
    picture_free(&p);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *bytes = malloc(size + 1);
    if (bytes == NULL)
        return 0;
    memcpy(bytes, data, size);
    bytes[size] = '\0';
    if (!is_large(bytes, size)) {
        try_picture(bytes, size);
        put_checksums(bytes, size);
        try_picture(bytes, size);
    }
    free(bytes);
    return 0;
}
