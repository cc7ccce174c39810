/* Surfaces from the files that meshes come in, too. */
#include "base/allocate.h"
#include "cage/cage_readers.h"
#include "mesh/mesh_file.h"

#include <stdlib.h>

/* The spans are in the order of the text, so one pass finds all lines. Binary files have none. */
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

bool cage_read_surface(cage *out, const char *text, size_t n, problem *wrong)
{
    mesh_file m;
    bool good = mesh_read(&m, 3, text, n, wrong);
    if (good) {
        out->n = m.n_vertices;
        out->lines = vertex_lines(&m);
        out->points = m.points;
        out->n_facets = m.n_triangles;
        out->facets = m.triangles;
        out->facet_lines = m.triangle_lines;
        m.points = NULL;
        m.triangles = NULL;
        m.triangle_lines = NULL;
    }
    mesh_free(&m);
    return good;
}
