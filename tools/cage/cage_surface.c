/* Reads surfaces from the file formats of meshes. */
#include "base/allocate.h"
#include "cage/cage_parts.h"
#include "cage/cage_readers.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_flat.h"

#include <stdlib.h>

/* One pass finds all lines, because the spans are in the order of the text. Binary files have no
 * lines. */
static size_t *vertex_lines(const mesh_file *m)
{
    size_t *lines = need(m->n_vertices, sizeof *lines), line = 1, at = 0;
    for (size_t i = 0; i < m->n_vertices && m->form == MESH_TEXT; i++) {
        for (; at < m->spans[2 * m->n_spans * i]; at++)
            line += m->text[at] == '\n';
        lines[i] = line;
    }
    return lines;
}

/* Reads a mesh in the plane if its faces are flat, unless it is the target of a cage in space. */
static bool read_mesh(mesh_file *m, const cage_choice *choice, size_t dim, const char *text,
                      size_t n, size_t *n_heights, problem *wrong)
{
    return choice->role == CAGE_TARGET && dim == 3
               ? mesh_read(m, 3, text, n, wrong)
               : mesh_read_in_own_space(m, text, n, n_heights, wrong);
}

static void take_surface(cage *out, mesh_file *m)
{
    out->dim = 3;
    out->n = m->n_vertices;
    out->lines = vertex_lines(m);
    out->points = m->points;
    out->n_facets = m->n_triangles;
    out->facets = m->triangles;
    out->facet_lines = m->triangle_lines;
    m->points = NULL;
    m->triangles = NULL;
    m->triangle_lines = NULL;
}

/* Takes a surface, or the surfaces and lines of a solid apart. */
static bool take_parts(cage *out, mesh_file *m, problem *wrong)
{
    bool is_divided = false;
    size_t *lines = vertex_lines(m);
    bool good = cage_take_parts(out, m, lines, &is_divided, wrong);
    free(lines);
    if (good && !is_divided)
        take_surface(out, m);
    return good;
}

bool cage_read_surface(cage *out, const cage_choice *choice, size_t dim, const char *text, size_t n,
                       problem *wrong)
{
    mesh_file m;
    size_t n_heights = 0;
    bool good = read_mesh(&m, choice, dim, text, n, &n_heights, wrong);
    if (good && (m.dim == 2 || mesh_has_bodies(&m)))
        good = cage_take_mesh(out, &m, choice->like, wrong);
    else if (good)
        good = take_parts(out, &m, wrong);
    out->n_heights = n_heights;
    mesh_free(&m);
    return good && (out->dim == 2 || out->n_facets > 0 ||
                    spoilt(wrong, 0, "there are no faces; a cage in space is a closed surface"));
}
