/* NumPy Enhancement Proposal 1, versions 1 to 3: a header that is a dictionary in Python's syntax,
 * then the numbers. */
#include "base/npy.h"

#include <stdint.h>
#include <string.h>

/* The reader's place, and the values of the header. */
typedef struct header {
    bool has_type, has_order, has_shape;
    const char *at, *end;
    problem *wrong;
    npy *out;
} header;

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static void skip_spaces(header *h)
{
    while (h->at < h->end && is_space(*h->at))
        h->at++;
}

static bool take(header *h, char c)
{
    skip_spaces(h);
    if (h->at == h->end || *h->at != c)
        return false;
    h->at++;
    return true;
}

static bool expect(header *h, char c)
{
    return take(h, c) || spoilt(h->wrong, 0, "the header of the .npy file lacks a '%c'", c);
}

/* Reads a word in quotes. */
static bool read_string(header *h, char out[NPY_WORD])
{
    size_t n = 0;
    skip_spaces(h);
    char quote = h->at < h->end ? *h->at : '\0';
    if (quote != '\'' && quote != '"')
        return spoilt(h->wrong, 0,
                      "the header of the .npy file has no name or type where one should be");
    for (h->at++; h->at < h->end && *h->at != quote; h->at++)
        if (n < NPY_WORD - 1)
            out[n++] = *h->at > 32 && *h->at < 127 ? *h->at : '?';
    out[n] = '\0';
    return expect(h, quote);
}

static bool read_type(header *h)
{
    skip_spaces(h);
    if (h->at < h->end && *h->at == '[')
        return spoilt(h->wrong, 0, "the array has fields; only one number per cell is read");
    return read_string(h, h->out->type);
}

static bool read_order(header *h)
{
    static const char *const words[] = {"False", "True"};
    skip_spaces(h);
    for (int i = 0; i < 2; i++) {
        size_t n = strlen(words[i]);
        if ((size_t)(h->end - h->at) >= n && memcmp(h->at, words[i], n) == 0) {
            h->at += n;
            h->out->is_fortran = i == 1;
            return true;
        }
    }
    return spoilt(h->wrong, 0, "fortran_order of the .npy file is neither True nor False");
}

static bool read_length(header *h, size_t *length)
{
    size_t n_digits = 0;
    skip_spaces(h);
    for (*length = 0; h->at < h->end && *h->at >= '0' && *h->at <= '9'; h->at++, n_digits++)
        *length = n_digits < 18 ? *length * 10 + (size_t)(*h->at - '0') : SIZE_MAX;
    return n_digits > 0 ||
           spoilt(h->wrong, 0, "the shape of the .npy file is not a list of numbers");
}

/* Reads a tuple in Python's syntax as numpy writes it: a number of cells for each axis, and a comma
 * even after a single one. */
static bool read_shape(header *h)
{
    npy *a = h->out;
    if (!expect(h, '('))
        return false;
    while (!take(h, ')')) {
        size_t length;
        if (!read_length(h, &length))
            return false;
        if (a->dim == NPY_MOST_AXES)
            return spoilt(h->wrong, 0, "the array has more than %d axes", NPY_MOST_AXES);
        if (length == 0)
            return spoilt(h->wrong, 0, "axis %zu of the array has no cells", a->dim);
        a->shape[a->dim++] = length;
        if (!take(h, ',') && (skip_spaces(h), h->at == h->end || *h->at != ')'))
            return spoilt(h->wrong, 0, "the shape of the .npy file is not a list of numbers");
    }
    return a->dim > 0 ||
           spoilt(h->wrong, 0, "the array has no axes; it needs 1 to %d", NPY_MOST_AXES);
}

static bool read_entry(header *h)
{
    char name[NPY_WORD];
    if (!read_string(h, name) || !expect(h, ':'))
        return false;
    bool *seen = strcmp(name, "descr") == 0           ? &h->has_type
                 : strcmp(name, "fortran_order") == 0 ? &h->has_order
                 : strcmp(name, "shape") == 0         ? &h->has_shape
                                                      : NULL;
    if (seen == NULL || *seen)
        return spoilt(h->wrong, 0, "the header of the .npy file has '%s' %s", name,
                      seen == NULL ? "in it, which is unknown" : "twice");
    *seen = true;
    return seen == &h->has_type    ? read_type(h)
           : seen == &h->has_order ? read_order(h)
                                   : read_shape(h);
}

/* Reads a dictionary as Python writes it. */
static bool read_header(header *h)
{
    if (!expect(h, '{'))
        return false;
    while (!take(h, '}')) {
        if (!read_entry(h))
            return false;
        if (take(h, ','))
            continue;
        return expect(h, '}');
    }
    return true;
}

/* Finds the header. The data begin at its end. */
static bool find_header(header *h, const char *text, size_t n)
{
    const unsigned char *bytes = (const unsigned char *)text;
    unsigned version = n >= 12 ? bytes[6] : 0;
    if (version < 1 || version > 3)
        return spoilt(h->wrong, 0, "this .npy file has version %u; libicc reads versions 1 to 3",
                      version);
    size_t start = version == 1 ? 10 : 12, length = bytes[8] + 256u * (size_t)bytes[9];
    if (version > 1)
        length += 65536u * (size_t)bytes[10] + 16777216u * (size_t)bytes[11];
    if (length > n - start)
        return spoilt(h->wrong, 0, "the .npy file ends within its header");
    h->at = text + start;
    h->end = h->at + length;
    return true;
}

bool npy_told(const char *bytes, size_t n)
{
    return n >= 6 && memcmp(bytes, "\x93NUMPY", 6) == 0;
}

bool npy_read(npy *out, const char *bytes, size_t n, problem *wrong)
{
    *out = (npy){0};
    header h = {.out = out, .wrong = wrong};
    if (!find_header(&h, bytes, n) || !read_header(&h))
        return false;
    if (!(h.has_type && h.has_order && h.has_shape))
        return spoilt(wrong, 0, "the header of the .npy file lacks descr, fortran_order or shape");
    out->data = h.end;
    out->n_bytes = n - (size_t)(h.end - bytes);
    return true;
}

size_t npy_cells(const npy *a, size_t size, problem *wrong)
{
    size_t n = 1;
    for (size_t k = 0; k < a->dim; k++)
        n = a->shape[k] <= a->n_bytes / n ? n * a->shape[k] : a->n_bytes + 1;
    if (n == a->n_bytes / size && a->n_bytes % size == 0)
        return n;
    spoilt(wrong, 0, "the .npy file has %zu bytes of data, which is not what its shape says",
           a->n_bytes);
    return 0;
}
