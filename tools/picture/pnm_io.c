/* Netpbm's formats, by its manual pages pbm(5), pgm(5), ppm(5) and pam(5): numbers in a header,
 * then samples in binary, most significant byte first, or as text. They are common in pipes. */
#include "picture/picture_file.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

/* The reader's place, and the values of the header. */
typedef struct reader {
    const char *at, *end;
    size_t width, height, channels, largest;
    bool is_text, is_bits; /* samples are numbers, or one bit each, where 1 is black */
} reader;

static bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Skips white space and comments, which end with their line. */
static void skip(reader *r)
{
    while (r->at < r->end && (is_blank(*r->at) || *r->at == '#')) {
        bool is_comment = *r->at == '#';
        r->at++;
        while (is_comment && r->at < r->end && *r->at != '\n' && *r->at != '\r')
            r->at++;
    }
}

/* Reads the next number, at most `most`. Returns `most` + 1 if there is none or it is greater. */
static size_t take_number(reader *r, size_t most)
{
    skip(r);
    size_t value = 0;
    const char *first = r->at;
    for (; r->at < r->end && *r->at >= '0' && *r->at <= '9' && value <= most; r->at++)
        value = 10 * value + (size_t)(*r->at - '0');
    return r->at == first || value > most ? most + 1 : value;
}

static bool starts(const reader *r, const char *word)
{
    size_t n = strlen(word);
    return (size_t)(r->end - r->at) > n && memcmp(r->at, word, n) == 0 && is_blank(r->at[n]);
}

/* Limit along an axis: a row of eight bytes for each pixel must fit on every machine. */
static const size_t most_pixels = INT32_MAX / 8;

/* Reads PAM's header, which has a word before each number. The number of samples in a tuple tells
 * the kind of tuple. */
static bool read_words(reader *r)
{
    const struct {
        const char *word;
        size_t *value, most;
    } numbers[] = {{"WIDTH", &r->width, most_pixels},
                   {"HEIGHT", &r->height, most_pixels},
                   {"DEPTH", &r->channels, 4},
                   {"MAXVAL", &r->largest, 65535}};
    for (skip(r); !starts(r, "ENDHDR"); skip(r)) {
        if (r->at == r->end)
            return false;
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
            if (starts(r, numbers[i].word)) {
                r->at += strlen(numbers[i].word);
                *numbers[i].value = take_number(r, numbers[i].most);
                if (*numbers[i].value > numbers[i].most)
                    return false;
            }
        while (r->at < r->end && *r->at != '\n')
            r->at++;
    }
    r->at += strlen("ENDHDR");
    return true;
}

/* Reads the header, up to the blank that separates it from the samples. */
static bool read_header(reader *r)
{
    char kind = r->at[1];
    r->at += 2;
    r->is_text = kind <= '3';
    r->is_bits = kind == '1' || kind == '4';
    if (kind == '7') {
        if (!read_words(r))
            return false;
    } else {
        r->channels = kind == '3' || kind == '6' ? 3 : 1;
        r->width = take_number(r, most_pixels);
        r->height = take_number(r, most_pixels);
        r->largest = r->is_bits ? 1 : take_number(r, 65535);
    }
    if (r->width - 1 >= most_pixels || r->height - 1 >= most_pixels || r->channels == 0 ||
        r->largest - 1 >= 65535 || r->at == r->end || !is_blank(*r->at))
        return false;
    r->at++;
    return true;
}

/* Bytes of a row in binary. As text, a sample takes at least one byte, and another one to separate
 * it from the next, unless it is a bit. */
static size_t row_bytes(const reader *r)
{
    if (r->is_text)
        return r->width * r->channels * (r->is_bits ? 1 : 2);
    return r->is_bits ? (r->width + 7) / 8 : r->width * r->channels * (r->largest > 255 ? 2 : 1);
}

/* Reads the next sample of a row that begins at `row`. Returns more than r->largest if there is
 * none. */
static size_t take_sample(reader *r, const char *row, size_t i)
{
    const unsigned char *bytes = (const unsigned char *)row;
    if (r->is_text && r->is_bits) {
        skip(r);
        if (r->at == r->end || (*r->at != '0' && *r->at != '1'))
            return 2;
        return *r->at++ == '0';
    }
    if (r->is_text)
        return take_number(r, r->largest);
    if (r->is_bits)
        return (bytes[i / 8] >> (7 - i % 8) & 1) == 0;
    return r->largest > 255 ? (size_t)bytes[2 * i] << 8 | bytes[2 * i + 1] : bytes[i];
}

static bool read_samples(reader *r, picture *p)
{
    size_t n = p->width * p->channels, full = ((size_t)1 << p->depth) - 1, bytes = row_bytes(r);
    for (size_t y = 0; y < p->height; y++) {
        const char *row = r->at;
        for (size_t i = 0; i < n; i++) {
            size_t sample = take_sample(r, row, i);
            if (sample > r->largest)
                return false;
            p->samples[y * n + i] = (uint16_t)((sample * full + r->largest / 2) / r->largest);
        }
        r->at += r->is_text ? 0 : bytes;
    }
    return true;
}

bool pnm_decode(picture *out, const char *bytes, size_t n, problem *wrong)
{
    reader r = {.at = bytes, .end = bytes + n};
    if (!read_header(&r))
        return spoilt(wrong, 0,
                      "the header of the PNM picture is damaged, or has too large numbers");
    /* The last number of a text may have no blank after it. */
    if (r.height > ((size_t)(r.end - r.at) + r.is_text) / row_bytes(&r))
        return spoilt(wrong, 0, "the PNM picture of %zu x %zu is damaged: the file ends early",
                      r.width, r.height);
    *out = picture_make(r.width, r.height, (unsigned)r.channels, r.largest > 255 ? 16 : 8);
    if (!read_samples(&r, out)) {
        picture_free(out);
        return spoilt(wrong, 0, "the PNM picture is damaged: a sample is missing or too large");
    }
    skip(&r);
    if (r.at == r.end)
        return true;
    picture_free(out);
    return spoilt(wrong, 0, "more follows after the PNM picture; a file may hold only one");
}

/* Writes PGM or PPM by the number of channels, or PAM. Grey may be written as PPM on request. */
unsigned char *pnm_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong)
{
    (void)wrong;
    static const char *const tuples[] = {"GRAYSCALE", "GRAYSCALE_ALPHA", "RGB", "RGB_ALPHA"};
    unsigned largest = (1u << p->depth) - 1,
             repeats = style->format == PICTURE_PPM && p->channels == 1 ? 3 : 1;
    char header[160];
    if (style->format == PICTURE_PAM)
        snprintf(header, sizeof header,
                 "P7\nWIDTH %zu\nHEIGHT %zu\nDEPTH %u\nMAXVAL %u\nTUPLTYPE %s\nENDHDR\n", p->width,
                 p->height, p->channels, largest, tuples[p->channels - 1]);
    else
        snprintf(header, sizeof header, "P%c\n%zu %zu\n%u\n",
                 p->channels * repeats == 3 ? '6' : '5', p->width, p->height, largest);
    size_t n_samples = p->width * p->height * p->channels, n_header = strlen(header);
    *n = n_header + n_samples * repeats * (p->depth / 8);
    unsigned char *bytes = need(*n, 1), *to = bytes + n_header;
    memcpy(bytes, header, n_header);
    for (size_t i = 0; i < n_samples; i++)
        for (unsigned k = 0; k < repeats; k++) {
            if (p->depth == 16)
                *to++ = (unsigned char)(p->samples[i] >> 8);
            *to++ = (unsigned char)(p->samples[i] & 255);
        }
    return bytes;
}
