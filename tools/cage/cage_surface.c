/* Reads surfaces from the file formats of meshes. */
#include "base/allocate.h"
#include "cage/cage_readers.h"
#include "mesh/element_kinds.h"
#include "mesh/mesh_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* True if all faces lie in one plane z = constant, so they enclose nothing. */
static bool is_flat(const mesh_file *m)
{
    for (size_t i = 0; i < m->n_vertices; i++)
        if (m->points[3 * i + 2] < m->points[2] || m->points[3 * i + 2] > m->points[2])
            return false;
    return m->n_triangles > 0;
}

static bool has_bodies(const mesh_file *m)
{
    for (size_t i = 0; i < m->n_elements; i++)
        if (element_kind_find(m->kinds[i])->dim == 3)
            return true;
    return false;
}

/* True if a mesh could not be read in space because its vertices have two coordinates only. */
static bool lacks_height(const mesh_file *m, const problem *wrong)
{
    return (m->n_vertices == 0 && strncmp(wrong->text, "'' is not a finite", 18) == 0) ||
           strstr(wrong->text, "have no property z") != NULL ||
           strncmp(wrong->text, "a mesh of dimension 2", 21) == 0;
}

/* Reads a mesh in the plane if its faces are flat, unless it is the target of a cage in space. */
static bool read_mesh(mesh_file *m, const cage_choice *choice, size_t dim, const char *text,
                      size_t n, size_t *n_heights, problem *wrong)
{
    problem other;
    bool good = mesh_read(m, 3, text, n, wrong), flat = good && !has_bodies(m) && is_flat(m);
    if (choice->role == CAGE_TARGET && dim == 3)
        return good;
    if (good ? !flat : !lacks_height(m, wrong))
        return good;
    *n_heights = flat && fabs(m->points[2]) > 0 ? m->n_vertices : 0;
    mesh_free(m);
    return mesh_read(m, 2, text, n, &other) ||
           (good && spoilt(wrong, other.line, "%s", other.text));
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

bool cage_read_surface(cage *out, const cage_choice *choice, size_t dim, const char *text, size_t n,
                       problem *wrong)
{
    mesh_file m;
    size_t n_heights = 0;
    bool good = read_mesh(&m, choice, dim, text, n, &n_heights, wrong);
    if (good && (m.dim == 2 || has_bodies(&m)))
        good = cage_take_mesh(out, &m, choice->like, wrong);
    else if (good)
        take_surface(out, &m);
    out->n_heights = n_heights;
    mesh_free(&m);
    return good && (out->dim == 2 || out->n_facets > 0 ||
                    spoilt(wrong, 0, "there are no faces; a cage in space is a closed surface"));
}
