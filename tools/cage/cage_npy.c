/* Masks from NumPy's .npy files: NumPy Enhancement Proposal 1, versions 1 to 3. Axis k of the array
 * is coordinate k. */
#include "cage/cage_readers.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

/* What the header says. */
typedef struct header {
    size_t size; /* bytes of a cell */
    bool fortran;
    bool has_type, has_order, has_shape;
    const char *at, *end;
    problem *wrong;
    cage *out;
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

/* A word in quotes. */
static bool read_string(header *h, char out[24])
{
    size_t n = 0;
    skip_spaces(h);
    char quote = h->at < h->end ? *h->at : '\0';
    if (quote != '\'' && quote != '"')
        return spoilt(h->wrong, 0,
                      "the header of the .npy file has no name or type where one should be");
    for (h->at++; h->at < h->end && *h->at != quote; h->at++)
        if (n < 23)
            out[n++] = *h->at > 32 && *h->at < 127 ? *h->at : '?';
    out[n] = '\0';
    return expect(h, quote);
}

/* Whole numbers and truth values, whatever their size and order of bytes. */
static bool read_type(header *h)
{
    static const char *const sizes = "1248";
    char type[24];
    skip_spaces(h);
    if (h->at < h->end && *h->at == '[')
        return spoilt(h->wrong, 0, "the array has fields; a mask has one number per cell");
    if (!read_string(h, type))
        return false;
    const char *p = type + (*type != '\0' && strchr("|<>=", *type) != NULL);
    bool known = *p != '\0' && strchr("bui", *p) != NULL && p[1] != '\0' &&
                 strchr(sizes, p[1]) != NULL && p[2] == '\0' && (*p != 'b' || p[1] == '1');
    if (!known)
        return spoilt(h->wrong, 0,
                      "the cells are of type '%s'; a mask has whole numbers or truth values: save "
                      "(array > 0)",
                      type);
    h->size = (size_t)(p[1] - '0');
    return true;
}

static bool read_order(header *h)
{
    static const char *const words[] = {"False", "True"};
    skip_spaces(h);
    for (int i = 0; i < 2; i++) {
        size_t n = strlen(words[i]);
        if ((size_t)(h->end - h->at) >= n && memcmp(h->at, words[i], n) == 0) {
            h->at += n;
            h->fortran = i == 1;
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
    return n_digits > 0 || spoilt(h->wrong, 0, "the shape of the .npy file is no list of numbers");
}

/* The tuple of Python's syntax, as numpy writes it: a number of cells for each axis, and a comma
 * even after the only one. */
static bool read_shape(header *h)
{
    cage *c = h->out;
    c->dim = 0;
    if (!expect(h, '('))
        return false;
    while (!take(h, ')')) {
        size_t length;
        if (!read_length(h, &length))
            return false;
        if (c->dim == ICC_MAX_DIM)
            return spoilt(h->wrong, 0, "the array has more than %d axes", ICC_MAX_DIM);
        if (length == 0)
            return spoilt(h->wrong, 0, "axis %zu of the array has no cells", c->dim);
        c->shape[c->dim++] = length;
        if (!take(h, ',') && (skip_spaces(h), h->at == h->end || *h->at != ')'))
            return spoilt(h->wrong, 0, "the shape of the .npy file is no list of numbers");
    }
    return c->dim > 0 ||
           spoilt(h->wrong, 0, "the array has no axes; a mask has 1 to %d", ICC_MAX_DIM);
}

static bool read_entry(header *h)
{
    char name[24];
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

/* A dictionary as Python writes it. */
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

/* The header's place in the file; the data begin at its end. */
static bool find_header(header *h, const char *text, size_t n)
{
    const unsigned char *bytes = (const unsigned char *)text;
    unsigned version = n >= 12 ? bytes[6] : 0;
    if (version < 1 || version > 3)
        return spoilt(h->wrong, 0, "a .npy file of version %u; 1 to 3 are read", version);
    size_t start = version == 1 ? 10 : 12, length = bytes[8] + 256u * (size_t)bytes[9];
    if (version > 1)
        length += 65536u * (size_t)bytes[10] + 16777216u * (size_t)bytes[11];
    if (length > n - start)
        return spoilt(h->wrong, 0, "the .npy file ends within its header");
    h->at = text + start;
    h->end = h->at + length;
    return true;
}

/* The number of cells, or 0 if the data are not as long as the shape says. */
static size_t count_cells(const header *h, size_t n_bytes)
{
    size_t n = 1;
    for (size_t k = 0; k < h->out->dim; k++) {
        if (h->out->shape[k] > n_bytes / n)
            return 0;
        n *= h->out->shape[k];
    }
    return n_bytes / h->size == n && n_bytes % h->size == 0 ? n : 0;
}

/* The cells are visited in the order of the file; `at` are the indices of the current one. */
static void take_cells(const header *h, size_t n, const char *data)
{
    cage *c = h->out;
    size_t at[ICC_MAX_DIM] = {0}, dim = c->dim;
    c->cells = need(n, 1);
    for (size_t i = 0; i < n; i++) {
        size_t index = 0;
        for (size_t k = dim; k-- > 0;)
            index = index * c->shape[k] + at[k];
        for (size_t b = 0; b < h->size; b++)
            c->cells[index] |= data[i * h->size + b] != 0;
        for (size_t k = 0; k < dim; k++) {
            size_t axis = h->fortran ? k : dim - 1 - k;
            if (++at[axis] < c->shape[axis])
                break;
            at[axis] = 0;
        }
    }
}

bool cage_read_npy(cage *out, const char *text, size_t n, problem *wrong)
{
    header h = {.out = out, .wrong = wrong};
    if (!find_header(&h, text, n) || !read_header(&h))
        return false;
    if (!(h.has_type && h.has_order && h.has_shape))
        return spoilt(wrong, 0, "the header of the .npy file lacks descr, fortran_order or shape");
    size_t n_cells = count_cells(&h, n - (size_t)(h.end - text));
    if (n_cells == 0)
        return spoilt(wrong, 0,
                      "the .npy file has %zu bytes of data, which is not what its shape says",
                      n - (size_t)(h.end - text));
    take_cells(&h, n_cells, h.end);
    return true;
}
