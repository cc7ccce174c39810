/* STL, as text or binary: 3D Systems, Stereolithography Interface Specification, 1989. Every
 * triangle has its own corners, and a normal, which follows from them. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "base/bytes.h"

#include <math.h>
#include <string.h>

/* Binary: a header of any bytes, the number of triangles, then for each a normal, three corners and
 * two more bytes. */
enum { N_HEAD = 80, N_TRIANGLE = 50, N_POINT = 12 };

/* The size decides, because the first bytes may be anything, even `solid`. */
static bool is_binary(const char *text, size_t n)
{
    return n > N_HEAD + 4 &&
           n == N_HEAD + 4 + N_TRIANGLE * (uint64_t)little_endian(text + N_HEAD, 4);
}

/* `solid NAME`, then facets, if there are any. */
static bool is_text(const char *text)
{
    text += strncmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    text += strspn(text, " \t\r\n");
    if (strncmp(text, "solid", 5) != 0 || strchr(" \t\r\n", text[5]) == NULL) /* or the end */
        return false;
    const char *p = text + strcspn(text, "\n");
    p += strspn(p, " \t\r\n");
    return strncmp(p, "facet", 5) == 0 || strncmp(p, "endsolid", 8) == 0;
}

bool mesh_is_stl(const char *text, size_t n)
{
    return is_binary(text, n) || is_text(text);
}

/* The place of the next triangle's normal. */
static void add_normal(mesh_file *m, const char *begin, const char *end)
{
    size_t i = m->n_triangles;
    m->normals = grow(m->normals, &m->room_normals, 2 * (i + 1), sizeof *m->normals);
    m->normals[2 * i] = (size_t)(begin - m->text);
    m->normals[2 * i + 1] = (size_t)(end - m->text);
}

/* Makes a triangle of the three last vertices. */
static void add_triangle(lines *r)
{
    uint32_t first = (uint32_t)r->mesh->n_vertices - 3;
    lines_begin_face(r);
    for (uint32_t k = 0; k < 3; k++)
        lines_corner(r, first + k);
}

/* -------------------------------------------------------------------- text */

static bool expect(lines *r, const char *word)
{
    char shown[32];
    return lines_word(r) &&
           (lines_take(r, word) ||
            spoilt(r->wrong, r->line, "'%s' where '%s' is expected", quoted(shown, r->at), word));
}

/* Reads three words. Some programs write `nan` for the normal of a flat triangle. */
static bool read_normal(lines *r)
{
    lines_skip_blanks(r);
    const char *begin = r->at, *end = begin;
    for (int k = 0; k < 3; k++) {
        lines_skip_blanks(r);
        if (r->at == r->end)
            return spoilt(r->wrong, r->line, "a normal has three numbers");
        r->at = end = r->at + strcspn(r->at, " \t\r\n");
    }
    add_normal(r->mesh, begin, end);
    return true;
}

static bool read_corner(lines *r)
{
    double height;
    return expect(r, "vertex") && lines_vertex(r) &&
           (r->mesh->dim == 3 || lines_number(r, &height));
}

static bool read_facet(lines *r)
{
    if (!expect(r, "facet") || !expect(r, "normal") || !read_normal(r) || !expect(r, "outer") ||
        !expect(r, "loop"))
        return false;
    for (int k = 0; k < 3; k++)
        if (!read_corner(r))
            return false;
    add_triangle(r);
    return expect(r, "endloop") && expect(r, "endfacet");
}

static bool read_solid(lines *r)
{
    if (!expect(r, "solid"))
        return false;
    r->at = r->end; /* its name */
    for (;;) {
        if (!lines_word(r))
            return false;
        if (lines_take(r, "endsolid"))
            break;
        if (!read_facet(r))
            return false;
    }
    r->at = r->end; /* its name again */
    return true;
}

/* Reads solids, one after the other. */
static bool read_text(lines *r)
{
    do {
        if (!read_solid(r))
            return false;
        while (lines_skip_blanks(r), r->at == r->end && lines_next(r))
            ;
    } while (r->at < r->end);
    return true;
}

/* ------------------------------------------------------------------ binary */

static bool read_point(mesh_file *m, const char *at, size_t triangle, problem *wrong)
{
    mesh_make_room(m);
    size_t i = m->n_vertices++;
    for (size_t k = 0; k < m->dim; k++) {
        double *value = m->points + m->dim * i + k;
        *value = (double)little_endian_float(at + 4 * k);
        if (!isfinite(*value))
            return spoilt(wrong, 0, "byte %zu: a corner of triangle %zu (from 0) is not finite",
                          (size_t)(at - m->text) + 4 * k, triangle);
    }
    m->spans[2 * i] = (size_t)(at - m->text);
    m->spans[2 * i + 1] = m->spans[2 * i] + 4 * m->dim;
    return true;
}

static bool read_binary(lines *r)
{
    mesh_file *m = r->mesh;
    m->form = MESH_LITTLE;
    m->floats = true;
    r->line = 0;
    const char *at = m->text + N_HEAD + 4, *end = m->text + m->n_text;
    for (size_t i = 0; at < end; at += N_TRIANGLE, i++) {
        add_normal(m, at, at + N_POINT);
        for (size_t k = 1; k <= 3; k++)
            if (!read_point(m, at + k * N_POINT, i, r->wrong))
                return false;
        add_triangle(r);
    }
    return true;
}

bool mesh_read_stl(lines *r)
{
    return is_binary(r->mesh->text, r->mesh->n_text) ? read_binary(r) : read_text(r);
}
