/* Wavefront OBJ: lines that begin with v and f. */
#include "mesh/mesh_lines.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

/* One corner of a face: v, v/vt, v//vn or v/vt/vn, from 1, or from -1 backwards. */
static bool read_corner(lines *r, uint32_t *vertex)
{
    double index;
    char shown[32];
    const char *word = r->at;
    double n = (double)r->mesh->n_vertices;
    if (number_read(&r->at, &index) != NUMBER_OK || strchr("/ \t\r\n", *r->at) == NULL ||
        floor(index) != index)
        return spoilt(r->wrong, r->line, "'%s' is not a corner of a face", quoted(shown, word));
    if (!(fabs(index) >= 1 && fabs(index) <= n))
        return spoilt(r->wrong, r->line, "the face has the vertex %.17g; there are %.0f so far%s",
                      index, n, fabs(index) < 1 ? ", counted from 1" : "");
    *vertex = (uint32_t)(index > 0 ? index - 1 : n + index);
    r->at += strcspn(r->at, " \t\r\n");
    return true;
}

static bool read_face(lines *r)
{
    uint32_t vertex = 0;
    lines_begin_face(r);
    for (lines_skip_blanks(r); r->at < r->end; lines_skip_blanks(r)) {
        if (!read_corner(r, &vertex))
            return false;
        lines_corner(r, vertex);
    }
    return lines_end_face(r);
}

bool mesh_read_obj(lines *r)
{
    do {
        bool vertex = lines_take(r, "v"), face = !vertex && lines_take(r, "f");
        if ((vertex && !lines_vertex(r)) || (face && !read_face(r)))
            return false;
    } while (lines_next(r));
    return true;
}
