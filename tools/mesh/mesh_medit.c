/* Medit's .mesh as text: sections with a name, the number of their items, and the items. Vertices
 * are counted from 1, and each item ends with a number that refers to something else. */
#include "mesh/mesh_lines.h"

#include <string.h>

static bool is_letter(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

static bool read_dimension(lines *r)
{
    uint32_t dim;
    if (!lines_next_count(r, 4, &dim))
        return false;
    return dim == 3 || dim == r->mesh->dim ||
           spoilt(r->wrong, r->line, "a mesh of dimension %u, but the cages have %zu",
                  (unsigned)dim, r->mesh->dim);
}

static bool read_vertices(lines *r)
{
    uint32_t n;
    if (!lines_next_count(r, 4e9, &n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        if (!lines_word(r) || !lines_vertex(r))
            return false;
        r->at = r->end; /* a third coordinate in the plane, and the reference */
    }
    return true;
}

/* Items with `n_corners` corners each. */
static bool read_items(lines *r, size_t n_corners)
{
    uint32_t n, corners[4];
    if (!lines_next_count(r, 4e9, &n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        lines_begin_face(r);
        for (size_t k = 0; k < n_corners; k++) {
            if (!lines_next_count(r, (double)r->mesh->n_vertices + 1, &corners[k]))
                return false;
            if (corners[k]-- == 0)
                return spoilt(r->wrong, r->line, "there is no vertex 0; they are counted from 1");
            if (n_corners == 3)
                lines_corner(r, corners[k]);
        }
        if (n_corners == 4)
            lines_tetrahedron(r, corners);
        r->at = r->end;
    }
    return true;
}

/* What each section may be given once. */
enum { DIMENSION, VERTICES, TRIANGLES, TETRAHEDRA, N_SECTIONS };

static bool read_section(lines *r, bool seen[N_SECTIONS])
{
    static const char *const names[N_SECTIONS] = {"Dimension", "Vertices", "Triangles",
                                                  "Tetrahedra"};
    int which = 0;
    while (which < N_SECTIONS && !lines_take(r, names[which]))
        which++;
    if (which == N_SECTIONS) { /* another section, or a number in one */
        r->at += strcspn(r->at, " \t\r\n");
        return true;
    }
    if (seen[which])
        return spoilt(r->wrong, r->line, "a second section %s; a mesh has one", names[which]);
    seen[which] = true;
    if (which >= TRIANGLES && !seen[VERTICES])
        return spoilt(r->wrong, r->line, "the section %s comes before Vertices", names[which]);
    return which == DIMENSION  ? read_dimension(r)
           : which == VERTICES ? read_vertices(r)
                               : read_items(r, which == TRIANGLES ? 3 : 4);
}

/* Moves to the next section; false at the end of the file. */
static bool find_section(lines *r)
{
    for (;;) {
        lines_skip_blanks(r);
        if (r->at < r->end && is_letter(*r->at))
            return true;
        if (r->at < r->end)
            r->at += strcspn(r->at, " \t\r\n#");
        else if (!lines_next(r))
            return false;
    }
}

bool mesh_read_medit(lines *r)
{
    bool seen[N_SECTIONS] = {false};
    while (find_section(r)) {
        if (lines_take(r, "End"))
            return true;
        if (!read_section(r, seen))
            return false;
    }
    return true;
}
