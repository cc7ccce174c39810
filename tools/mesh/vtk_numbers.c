/* Numbers of legacy VTK as text or bytes. */
#include "mesh/vtk_numbers.h"

#include "base/bytes.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_text(const lines *r)
{
    return r->mesh->form == MESH_TEXT;
}

/* VTK writes ids of points and cells (vtkIdType) as int, whatever they are in memory. */
size_t vtk_size(const char *word, size_t n)
{
    /* VTK writes its own numbers of points and cells as int, whatever they are in memory. */
    static const struct {
        const char *name;
        size_t size;
    } types[] = {{"char", 1},           {"unsigned_char", 1},
                 {"signed_char", 1},    {"short", 2},
                 {"unsigned_short", 2}, {"int", 4},
                 {"unsigned_int", 4},   {"long", 8},
                 {"unsigned_long", 8},  {"vtktypeint64", 8},
                 {"vtktypeuint64", 8},  {"vtkIdType", 4},
                 {"long_long", 8},      {"unsigned_long_long", 8},
                 {"vtktypeint32", 4},   {"vtktypeuint32", 4},
                 {"vtktypeint16", 2},   {"vtktypeuint16", 2},
                 {"vtktypeint8", 1},    {"vtktypeuint8", 1},
                 {"float", 4},          {"double", 8}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strlen(types[i].name) == n && strncmp(types[i].name, word, n) == 0)
            return types[i].size;
    return 0;
}

void vtk_begin(lines *r)
{
    if (is_text(r))
        return;
    r->at = r->end;
    if (*r->at == '\n')
        r->at = ++r->end;
}

/* The rest of a line follows them. */
const char *vtk_bytes(lines *r, size_t n)
{
    const char *bytes = r->at, *end = r->mesh->text + r->mesh->n_text;
    if ((size_t)(end - bytes) < n) {
        spoilt(r->wrong, 0, "the file ends early");
        return NULL;
    }
    r->at = r->end = bytes + n;
    return bytes;
}

/* The end of the line is searched after all numbers have been taken. */
bool vtk_count(lines *r, size_t size, double limit, uint32_t *count)
{
    if (is_text(r))
        return lines_next_count(r, limit, count);
    const char *bytes = vtk_bytes(r, size);
    if (bytes == NULL)
        return false;
    uint64_t value = big_endian(bytes, size);
    if (!((double)value < limit))
        return spoilt(r->wrong, 0, "byte %zu: %.17g where a whole number below %.17g is expected",
                      (size_t)(bytes - r->mesh->text), (double)value, limit);
    *count = (uint32_t)value;
    return true;
}

static bool read_text_vertex(lines *r)
{
    double value; /* in the plane a third coordinate is ignored */
    return lines_word(r) && lines_vertex(r) &&
           (r->mesh->dim == 3 || (lines_word(r) && lines_number(r, &value)));
}

bool vtk_vertex(lines *r, size_t size)
{
    mesh_file *m = r->mesh;
    if (is_text(r))
        return read_text_vertex(r);
    const char *bytes = vtk_bytes(r, 3 * size);
    if (bytes == NULL)
        return false;
    mesh_make_room(m);
    size_t i = m->n_vertices++;
    m->spans[2 * i] = (size_t)(bytes - m->text);
    m->spans[2 * i + 1] = m->spans[2 * i] + m->dim * size;
    for (size_t k = 0; k < m->dim; k++) {
        double value =
            size == 4 ? (double)big_endian_float(bytes + 4 * k) : big_endian_double(bytes + 8 * k);
        m->points[m->dim * i + k] = value;
        if (!isfinite(value))
            return spoilt(r->wrong, 0, "vertex %zu is not finite", i);
    }
    return true;
}

/* Skips an array: its name, the numbers in an item, the items, and their type, then the bytes. */
static bool skip_array(lines *r)
{
    uint32_t n_components, n_items;
    if (!lines_word(r))
        return false;
    r->at += strcspn(r->at, " \t\r\n"); /* its name */
    if (!lines_count(r, 4e9, &n_components) || !lines_count(r, 4e9, &n_items) || !lines_word(r))
        return false;
    size_t size = vtk_size(r->at, strcspn(r->at, " \t\r\n"));
    if (size == 0)
        return spoilt(r->wrong, 0, "a field before the mesh has no numbers");
    vtk_begin(r);
    if ((double)n_components * n_items * (double)size > (double)r->mesh->n_text)
        return spoilt(r->wrong, 0, "the file ends early");
    if (vtk_bytes(r, size * n_components * n_items) == NULL)
        return false;
    r->end = r->at + strcspn(r->at, "\n");
    return true;
}

bool vtk_skip_field(lines *r)
{
    uint32_t n;
    r->at += strspn(r->at, " \t");
    r->at += strcspn(r->at, " \t\r\n"); /* its name */
    if (!lines_count(r, 4e9, &n))
        return false;
    for (uint32_t i = 0; i < n; i++)
        if (!skip_array(r))
            return false;
    return true;
}
