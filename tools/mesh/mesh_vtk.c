/* Legacy VTK: an unstructured grid, with the cells of version 2 (each begins with the number of its
 * corners) or 5 (OFFSETS and CONNECTIVITY). Its lines are text. The numbers between them may be
 * bytes, in the order of points, cells and types. Everything after the types is copied. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "mesh/element_kinds.h"
#include "mesh/vtk_numbers.h"

#include <stdlib.h>
#include <string.h>

/* The corners of all cells: cell i has corners[starts[i] .. starts[i + 1]). */
typedef struct cells {
    uint32_t n, n_corners;
    uint32_t *starts, *corners;
    bool typed;   /* their types have been read */
    bool in_data; /* the section is CELL_DATA */
} cells;

static bool starts_with(lines *r, const char *word)
{
    char shown[32];
    if (!lines_word(r))
        return false;
    return lines_take(r, word) ||
           spoilt(r->wrong, r->line, "'%s' where %s is expected", quoted(shown, r->at), word);
}

/* Two lines that are ignored, then ASCII or BINARY and the kind of data. */
static bool read_head(lines *r)
{
    char shown[32];
    for (int i = 0; i < 2; i++)
        if (!lines_next(r))
            return spoilt(r->wrong, r->line, "the file ends early");
    if (!lines_word(r))
        return false;
    if (lines_take(r, "BINARY"))
        r->mesh->form = MESH_BIG;
    else if (!starts_with(r, "ASCII"))
        return false;
    else if (strlen(r->mesh->text) != r->mesh->n_text)
        return spoilt(r->wrong, 0, "this is not a text file, though it says ASCII");
    if (!starts_with(r, "DATASET") || !lines_word(r))
        return false;
    return lines_take(r, "UNSTRUCTURED_GRID") ||
           spoilt(r->wrong, r->line, "this is a '%s'; libicc reads an UNSTRUCTURED_GRID",
                  quoted(shown, r->at));
}

/* Continues in the line that begins after bytes. */
static void go_on(lines *r)
{
    if (r->mesh->form == MESH_BIG)
        r->end = r->at + strcspn(r->at, "\n");
}

static bool read_points(lines *r)
{
    uint32_t n;
    mesh_file *m = r->mesh;
    if (m->n_types > 0)
        return spoilt(r->wrong, r->line, "a second section POINTS; a mesh has one");
    if (!lines_next_count(r, 4e9, &n) || !lines_word(r))
        return false;
    size_t n_word = strcspn(r->at, " \t\r\n"), size = vtk_size(r->at, n_word);
    m->types[0][0] = (size_t)(r->at - m->text);
    r->at += n_word;
    m->types[0][1] = (size_t)(r->at - m->text);
    m->n_types = 1;
    if (m->form == MESH_BIG) {
        const char *word = r->at - n_word;
        if (!(n_word == 5 && strncmp(word, "float", 5) == 0) &&
            !(n_word == 6 && strncmp(word, "double", 6) == 0))
            return spoilt(r->wrong, r->line, "the points must be of type float or double");
        m->has_rest = m->dim == 2 && size == 4;
        vtk_begin(r);
    }
    for (uint32_t i = 0; i < n; i++)
        if (!vtk_vertex(r, size))
            return false;
    go_on(r);
    return true;
}

/* Reads `n` numbers below `limit` after a word and the name of a type. */
static bool read_array(lines *r, const char *word, uint32_t n, double limit, uint32_t *out)
{
    if (!starts_with(r, word) || !lines_word(r))
        return false;
    size_t size = vtk_size(r->at, strcspn(r->at, " \t\r\n"));
    if (size == 0 && r->mesh->form == MESH_BIG)
        return spoilt(r->wrong, r->line, "%s of an unknown type", word);
    r->at = r->end;
    vtk_begin(r);
    for (uint32_t i = 0; i < n; i++)
        if (!vtk_count(r, size, limit, &out[i]))
            return false;
    go_on(r);
    return true;
}

static bool read_old_cells(lines *r, cells *c)
{
    uint32_t used = 0, k = 0;
    for (uint32_t i = 0; i < c->n; i++) {
        if (!vtk_count(r, 4, (double)(c->n_corners - used) + 1, &k))
            return false;
        for (; k > 0; k--)
            if (!vtk_count(r, 4, (double)r->mesh->n_vertices, &c->corners[used++]))
                return false;
        c->starts[i + 1] = used;
    }
    go_on(r);
    return true;
}

/* Reads cells of version 5, n + 1 offsets into a list of corners, or those of older files, each
 * with its number of corners before it. */
static bool read_cells(lines *r, cells *c)
{
    uint32_t n, size;
    if (c->starts != NULL)
        return spoilt(r->wrong, r->line, "a second section CELLS; a mesh has one");
    if (r->mesh->n_types == 0)
        return spoilt(r->wrong, r->line, "the section CELLS comes before POINTS");
    if (!lines_next_count(r, 4e9, &n) || !lines_next_count(r, 4e9, &size))
        return false;
    vtk_begin(r);
    if (r->mesh->form == MESH_TEXT && !lines_word(r))
        return false;
    if ((double)n + size > (double)r->mesh->n_text)
        return spoilt(r->wrong, r->line, "the file has no room for so many cells");
    *c = (cells){.n = n, .n_corners = size};
    c->starts = need((size_t)n + 1, sizeof *c->starts);
    c->corners = need(size, sizeof *c->corners);
    if (strncmp(r->at, "OFFSETS", 7) != 0)
        return read_old_cells(r, c);
    go_on(r);
    c->n = n > 0 ? n - 1 : 0;
    if (!read_array(r, "OFFSETS", n, (double)size + 1, c->starts) ||
        !read_array(r, "CONNECTIVITY", size, (double)r->mesh->n_vertices, c->corners))
        return false;
    for (uint32_t i = 0; i < c->n; i++)
        if (c->starts[i + 1] < c->starts[i])
            return spoilt(r->wrong, r->line, "offset %u is less than the one before",
                          (unsigned)i + 1);
    return true;
}

/* Reads the types, which follow the cells. */
static bool read_types(lines *r, cells *c)
{
    uint32_t n, type = 0;
    if (c->typed || c->starts == NULL)
        return spoilt(r->wrong, r->line,
                      c->typed ? "a second section CELL_TYPES; a mesh has one"
                               : "the section CELL_TYPES comes before CELLS");
    c->typed = true;
    if (!lines_next_count(r, 4e9, &n))
        return false;
    if (n != c->n)
        return spoilt(r->wrong, r->line, "%u types for %u cells", (unsigned)n, (unsigned)c->n);
    vtk_begin(r);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t n_corners = c->starts[i + 1] - c->starts[i];
        if (!vtk_count(r, 4, 256, &type))
            return false;
        if (!lines_element(r, (int)type, n_corners, c->corners + c->starts[i]))
            return spoilt(r->wrong, r->line, "cell %u has %u corners, but type %u", (unsigned)i,
                          (unsigned)n_corners, (unsigned)type);
    }
    r->mesh->types_end = (size_t)(r->at - r->mesh->text);
    return true;
}

static bool is_letter(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/* True if this line announces an array of data: four words, that is a name, two numbers and a type.
 * Such an array may have the name of a section. */
static bool is_array(const lines *r)
{
    size_t n = 0;
    char third = ' ', fourth = ' ';
    for (const char *p = r->at + strspn(r->at, " \t\r"); p < r->end; p += strspn(p, " \t\r")) {
        n++;
        third = n == 3 ? *p : third;
        fourth = n == 4 ? *p : fourth;
        p += strcspn(p, " \t\r\n");
    }
    return n == 4 && third >= '0' && third <= '9' && is_letter(fourth);
}

static bool begins_section(lines *r, const char *name)
{
    lines_skip_blanks(r);
    return !is_array(r) && lines_take(r, name);
}

/* True if a name of cell data with regions comes next, and moves after it. */
static bool take_region_name(lines *r)
{
    lines_skip_blanks(r);
    for (size_t k = 0; mesh_region_name(k) != NULL; k++)
        if (lines_take(r, mesh_region_name(k)))
            return true;
    return false;
}

static bool read_region_values(lines *r, const cells *c)
{
    r->at = r->end;
    for (uint32_t i = 0; i < c->n; i++) {
        double value;
        if (!lines_word(r) || !lines_number(r, &value))
            return false;
        mesh_set_region(r->mesh, i, value);
    }
    return true;
}

/* Reads cell data with regions as text: `SCALARS name type` and a lookup table, or an array of a
 * field, `name 1 cells type`. Other data is skipped. */
static bool read_cell_data(lines *r, const cells *c)
{
    uint32_t n;
    if (!is_array(r) && lines_take(r, "SCALARS")) {
        if (!take_region_name(r))
            return true;
        r->at = r->end;
        return starts_with(r, "LOOKUP_TABLE") && read_region_values(r, c);
    }
    if (!is_array(r) || !take_region_name(r))
        return true;
    if (!lines_count(r, 4e9, &n))
        return false;
    if (n != 1)
        return true;
    return lines_count(r, 4e9, &n) && (n != c->n || read_region_values(r, c));
}

/* Copies other sections (METADATA, CELL_DATA, POINT_DATA). Bytes after the types are not read. */
static bool read_sections(lines *r, cells *c)
{
    bool binary = r->mesh->form == MESH_BIG;
    for (lines_skip_blanks(r); r->at < r->end || lines_next(r); lines_skip_blanks(r)) {
        const char *line = r->at;
        bool good = true;
        if (binary && c->typed)
            return true;
        if (begins_section(r, "POINTS"))
            good = read_points(r);
        else if (begins_section(r, "CELLS"))
            good = read_cells(r, c);
        else if (begins_section(r, "CELL_TYPES"))
            good = read_types(r, c);
        else if (begins_section(r, "DATASET"))
            good = spoilt(r->wrong, r->line, "a second DATASET; a mesh has one");
        else if (binary && lines_take(r, "FIELD"))
            good = vtk_skip_field(r);
        else if (begins_section(r, "CELL_DATA"))
            c->in_data = c->typed;
        else if (begins_section(r, "POINT_DATA"))
            c->in_data = false;
        else if (c->in_data)
            good = read_cell_data(r, c);
        if (r->at == line || c->in_data)
            r->at = r->end;
        if (!good)
            return false;
    }
    return c->typed || spoilt(r->wrong, r->line, "the file ends early");
}

bool mesh_read_vtk(lines *r)
{
    cells c = {0};
    r->wraps = true;
    bool good = read_head(r) && read_sections(r, &c);
    if (r->mesh->form == MESH_BIG && !good)
        r->wrong->line = 0;
    free(c.starts);
    free(c.corners);
    return good;
}
