/* Finds the vectors of legacy VTK, in the sections that follow the types of the cells. */
#include "mesh/mesh_vectors.h"
#include "mesh/vtk_numbers.h"

#include "base/bytes.h"
#include "base/number.h"

#include <math.h>
#include <string.h>

typedef struct data {
    lines r;
    mesh_file mesh; /* a copy for `r`, which owns nothing */
    mesh_vector_list *out;
    bool in_elements;
    uint32_t n; /* items of the arrays of this section */
} data;

/* An array that begins after this line. */
typedef struct array {
    const char *type;
    size_t n_type;
    double n_components, n_items;
    bool are_vectors, are_normals;
} array;

/* ------------------------------------------------------------------------- numbers */

static bool take_word(data *d, const char **word, size_t *n)
{
    if (!lines_word(&d->r))
        return false;
    *word = d->r.at;
    *n = strcspn(d->r.at, " \t\r\n");
    d->r.at += *n;
    return true;
}

static bool skip_word(data *d)
{
    const char *word;
    size_t n;
    return take_word(d, &word, &n);
}

/* A number as text, which may be infinite or NaN. */
static bool take_number(data *d, double *value)
{
    char shown[32];
    if (!lines_word(&d->r))
        return false;
    const char *word = d->r.at;
    number_kind kind = number_read(&d->r.at, value);
    if (kind == NUMBER_NOT_FINITE)
        *value = (double)NAN;
    return (kind != NUMBER_BAD && strchr(" \t\r\n", *d->r.at) != NULL) ||
           spoilt(d->r.wrong, d->r.line, "'%s' is not a number", quoted(shown, word));
}

static bool take_vector(data *d, size_t size, double value[3], size_t *begin, size_t *end)
{
    const char *text = d->r.mesh->text;
    if (d->r.mesh->form == MESH_TEXT) {
        if (!lines_word(&d->r))
            return false;
        *begin = (size_t)(d->r.at - text);
        bool good =
            take_number(d, &value[0]) && take_number(d, &value[1]) && take_number(d, &value[2]);
        *end = (size_t)(d->r.at - text);
        return good;
    }
    const char *bytes = vtk_bytes(&d->r, 3 * size);
    if (bytes == NULL)
        return false;
    for (size_t k = 0; k < 3; k++)
        value[k] =
            size == 4 ? (double)big_endian_float(bytes + 4 * k) : big_endian_double(bytes + 8 * k);
    *begin = (size_t)(bytes - text);
    *end = *begin + 3 * size;
    return true;
}

/* -------------------------------------------------------------------------- arrays */

static bool is_type(const array *a, const char *name)
{
    return a->n_type == strlen(name) && strncmp(a->type, name, a->n_type) == 0;
}

static bool read_vectors(data *d, const array *a, size_t size)
{
    mesh_vectors *v = vectors_begin(d->out, d->in_elements);
    v->are_normals = a->are_normals;
    v->width = size;
    for (uint32_t i = 0; i < d->n; i++) {
        double value[3];
        size_t begin, end;
        if (!take_vector(d, size, value, &begin, &end))
            return false;
        vectors_add(v, i, value, begin, end);
    }
    return true;
}

static bool skip_numbers(data *d, const array *a, size_t size)
{
    double n = a->n_components * a->n_items;
    if (n * (double)size > (double)d->r.mesh->n_text)
        return spoilt(d->r.wrong, 0, "the file ends early");
    if (d->r.mesh->form != MESH_TEXT)
        return vtk_bytes(&d->r, (size_t)n * size) != NULL;
    for (; n > 0; n--)
        if (!skip_word(d))
            return false;
    return true;
}

/* Reads an array whose numbers begin after this line. */
static bool read_array(data *d, const array *a)
{
    lines *r = &d->r;
    char shown[32];
    bool is_text = r->mesh->form == MESH_TEXT,
         is_real = is_type(a, "float") || is_type(a, "double");
    size_t size = is_text ? 1 : vtk_size(a->type, a->n_type);
    if (size == 0 || is_type(a, "string"))
        return spoilt(r->wrong, is_text ? r->line : 0, "an array of the type '%s' after the cells",
                      quoted(shown, a->type));
    vtk_begin(r);
    bool good = a->are_vectors && is_real && !(a->n_items < d->n || a->n_items > d->n)
                    ? read_vectors(d, a, size)
                    : skip_numbers(d, a, size);
    if (!is_text)
        r->end = r->at + strcspn(r->at, "\n");
    return good;
}

/* Reads `name type` after a word such as VECTORS. */
static bool read_named(data *d, unsigned n_components, bool are_vectors, bool are_normals)
{
    array a = {.n_components = n_components,
               .n_items = d->n,
               .are_vectors = are_vectors,
               .are_normals = are_normals};
    return skip_word(d) && take_word(d, &a.type, &a.n_type) && read_array(d, &a);
}

/* `name type [n]`, then a line with the name of a table of colours. */
static bool read_scalars(data *d)
{
    array a = {.n_components = 1, .n_items = d->n};
    uint32_t n = 1;
    if (!skip_word(d) || !take_word(d, &a.type, &a.n_type))
        return false;
    lines_skip_blanks(&d->r);
    if (d->r.at < d->r.end && !lines_count(&d->r, 4e9, &n))
        return false;
    a.n_components = n;
    if (!lines_word(&d->r))
        return false;
    if (lines_take(&d->r, "LOOKUP_TABLE") && !skip_word(d))
        return false;
    return read_array(d, &a);
}

/* `name n`: floats as text, or bytes. A table of colours has its own number of items. */
static bool read_colours(data *d, bool is_table)
{
    uint32_t n;
    array a = {.type = "char", .n_type = 4, .n_components = 4, .n_items = d->n};
    if (!skip_word(d) || !lines_count(&d->r, 4e9, &n))
        return false;
    if (is_table)
        a.n_items = n;
    else
        a.n_components = n;
    return read_array(d, &a);
}

static bool read_coordinates(data *d)
{
    uint32_t n;
    array a = {.n_items = d->n};
    if (!skip_word(d) || !lines_count(&d->r, 4e9, &n) || !take_word(d, &a.type, &a.n_type))
        return false;
    a.n_components = n;
    return read_array(d, &a);
}

/* Notes about an array end with an empty line. */
static bool skip_notes(data *d)
{
    while (lines_next(&d->r) && strspn(d->r.at, " \t\r") < (size_t)(d->r.end - d->r.at))
        ;
    return true;
}

/* `name n`, then n arrays, each with `name n_components n_items type`. */
static bool read_field(data *d)
{
    uint32_t n, n_components, n_items;
    if (!skip_word(d) || !lines_count(&d->r, 4e9, &n))
        return false;
    while (n > 0) {
        array a = {0};
        if (!lines_word(&d->r))
            return false;
        if (lines_take(&d->r, "METADATA")) {
            skip_notes(d);
            continue;
        }
        if (!skip_word(d) || !lines_count(&d->r, 4e9, &n_components) ||
            !lines_count(&d->r, 4e9, &n_items) || !take_word(d, &a.type, &a.n_type))
            return false;
        a.n_components = n_components;
        a.n_items = n_items;
        a.are_vectors = n_components == 3;
        if (!read_array(d, &a))
            return false;
        n--;
    }
    return true;
}

/* ------------------------------------------------------------------------ sections */

static bool begin_data(data *d, bool in_elements)
{
    size_t n = in_elements ? d->mesh.n_elements : d->mesh.n_vertices;
    d->in_elements = in_elements;
    if (!lines_count(&d->r, 4e9, &d->n))
        return false;
    return d->n == n || spoilt(d->r.wrong, d->mesh.form == MESH_TEXT ? d->r.line : 0,
                               "data of %u %s; there are %zu", (unsigned)d->n,
                               in_elements ? "cells" : "points", n);
}

static bool read_section(data *d)
{
    lines *r = &d->r;
    char shown[32];
    return lines_take(r, "POINT_DATA")            ? begin_data(d, false)
           : lines_take(r, "CELL_DATA")           ? begin_data(d, true)
           : lines_take(r, "VECTORS")             ? read_named(d, 3, true, false)
           : lines_take(r, "NORMALS")             ? read_named(d, 3, true, true)
           : lines_take(r, "TENSORS")             ? read_named(d, 9, false, false)
           : lines_take(r, "TENSORS6")            ? read_named(d, 6, false, false)
           : lines_take(r, "GLOBAL_IDS")          ? read_named(d, 1, false, false)
           : lines_take(r, "PEDIGREE_IDS")        ? read_named(d, 1, false, false)
           : lines_take(r, "EDGE_FLAGS")          ? read_named(d, 1, false, false)
           : lines_take(r, "SCALARS")             ? read_scalars(d)
           : lines_take(r, "COLOR_SCALARS")       ? read_colours(d, false)
           : lines_take(r, "LOOKUP_TABLE")        ? read_colours(d, true)
           : lines_take(r, "TEXTURE_COORDINATES") ? read_coordinates(d)
           : lines_take(r, "FIELD")               ? read_field(d)
           : lines_take(r, "METADATA")
               ? skip_notes(d)
               : spoilt(r->wrong, r->mesh->form == MESH_TEXT ? r->line : 0,
                        "'%s' where data of points or cells are expected", quoted(shown, r->at));
}

bool vtk_find_vectors(const mesh_file *m, mesh_vector_list *out, problem *wrong)
{
    data d = {.mesh = *m, .out = out};
    d.r = (lines){.mesh = &d.mesh, .at = m->text + m->types_end, .wrong = wrong};
    d.r.end = d.r.at + strcspn(d.r.at, "\n");
    d.r.line = m->form == MESH_TEXT ? line_of(m->text, d.r.at) : 0;
    for (lines_skip_blanks(&d.r); d.r.at < d.r.end || lines_next(&d.r); lines_skip_blanks(&d.r))
        if (d.r.at < d.r.end && !read_section(&d)) {
            wrong->line = m->form == MESH_TEXT ? wrong->line : 0;
            return false;
        }
    return true;
}
