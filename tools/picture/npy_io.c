/* Pictures as arrays in NumPy's .npy files: rows, columns and perhaps channels. */
#include "picture/picture_file.h"

#include "base/allocate.h"
#include "base/npy.h"

#include <stdint.h>
#include <string.h>

static const struct {
    const char *name; /* after the byte order */
    unsigned depth;
} types[] = {{"u1", 8}, {"u2", 16}, {"f4", 32}, {"f8", 64}};

/* The bits of a number of this type, or 0 for other types. */
static unsigned depth_of(const char *type)
{
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (*type != '\0' && strchr(i == 0 ? "|<>" : "<>", *type) != NULL &&
            strcmp(type + 1, types[i].name) == 0)
            return types[i].depth;
    return 0;
}

/* Limit along an axis: a row of eight bytes for each pixel must fit on every machine. */
static const size_t most_pixels = INT32_MAX / 8;

/* True if the array has the layout of a picture. */
static bool fits(const npy *a, problem *wrong)
{
    if (depth_of(a->type) == 0)
        return spoilt(wrong, 0,
                      "the array is of type '%s'; a picture has uint8, uint16, float32 or float64",
                      a->type);
    if (a->is_fortran)
        return spoilt(wrong, 0,
                      "the array is in Fortran's order; save numpy.ascontiguousarray(array)");
    if (a->dim != 2 && a->dim != 3)
        return spoilt(wrong, 0,
                      "the array has %zu %s; a picture has rows, columns and perhaps "
                      "channels",
                      a->dim, a->dim == 1 ? "axis" : "axes");
    if (a->dim == 3 && a->shape[2] > PICTURE_MOST_CHANNELS)
        return spoilt(wrong, 0,
                      "the array has %zu channels, in its last axis; there may be 1 to %d",
                      a->shape[2], PICTURE_MOST_CHANNELS);
    return (a->shape[0] <= most_pixels && a->shape[1] <= most_pixels) ||
           spoilt(wrong, 0, "the picture of %zu x %zu is too large", a->shape[1], a->shape[0]);
}

/* Reads a number of `size` bytes as its bits. */
static uint64_t take_bits(const unsigned char *bytes, size_t size, bool is_big)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits = bits << 8 | bytes[is_big ? i : size - 1 - i];
    return bits;
}

static double as_float(uint64_t bits, size_t size)
{
    uint32_t low = (uint32_t)bits;
    float single;
    double value;
    memcpy(&single, &low, sizeof single);
    memcpy(&value, &bits, sizeof value);
    return size == 4 ? (double)single : value;
}

static uint64_t bits_of(double value, size_t size)
{
    float single = (float)value;
    uint32_t low;
    uint64_t bits;
    memcpy(&low, &single, sizeof low);
    memcpy(&bits, &value, sizeof bits);
    return size == 4 ? low : bits;
}

bool npy_decode(picture *out, const char *bytes, size_t n, problem *wrong)
{
    npy a;
    if (!npy_read(&a, bytes, n, wrong) || !fits(&a, wrong))
        return false;
    size_t size = depth_of(a.type) / 8, n_numbers = npy_cells(&a, size, wrong);
    if (n_numbers == 0)
        return false;
    *out = picture_make(a.shape[1], a.shape[0], a.dim == 3 ? (unsigned)a.shape[2] : 1,
                        (unsigned)size * 8);
    out->notes.has_axis = a.dim == 3;
    const unsigned char *from = (const unsigned char *)a.data;
    for (size_t i = 0; i < n_numbers; i++) {
        uint64_t bits = take_bits(from + i * size, size, *a.type == '>');
        if (out->values != NULL)
            out->values[i] = as_float(bits, size);
        else
            out->samples[i] = (uint16_t)bits;
    }
    return true;
}

/* Writes the header before the numbers, which begin at a multiple of 64 bytes. Returns its
 * length. */
static size_t put_header(unsigned char header[192], const picture *p, bool has_axis)
{
    char type[4] = "<u1", channels[16] = "";
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (types[i].depth == p->depth)
            memcpy(type + 1, types[i].name, 2);
    type[0] = p->depth == 8 ? '|' : '<';
    if (has_axis)
        snprintf(channels, sizeof channels, ", %u", p->channels);
    memset(header, ' ', 192);
    memcpy(header, "\x93NUMPY\1\0", 8);
    int n = snprintf((char *)header + 10, 182,
                     "{'descr': '%s', 'fortran_order': False, 'shape': (%zu, %zu%s), }", type,
                     p->height, p->width, channels);
    size_t end = (10 + (size_t)n + 1 + 63) / 64 * 64;
    header[10 + n] = ' ';
    header[end - 1] = '\n';
    header[8] = (unsigned char)((end - 10) & 255);
    header[9] = (unsigned char)((end - 10) >> 8);
    return end;
}

unsigned char *npy_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong)
{
    (void)wrong;
    unsigned char header[192];
    bool has_axis = p->channels > 1 || (style->notes != NULL && style->notes->has_axis);
    size_t n_header = put_header(header, p, has_axis), size = p->depth / 8,
           n_numbers = p->width * p->height * p->channels;
    *n = n_header + n_numbers * size;
    unsigned char *bytes = need(*n, 1), *to = bytes + n_header;
    memcpy(bytes, header, n_header);
    for (size_t i = 0; i < n_numbers; i++) {
        uint64_t bits = p->values != NULL ? bits_of(p->values[i], size) : p->samples[i];
        for (size_t b = 0; b < size; b++)
            *to++ = (unsigned char)(bits >> 8 * b);
    }
    return bytes;
}
