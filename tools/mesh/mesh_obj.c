/* Wavefront OBJ: lines that begin with v, vn and f. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "base/number.h"

#include <math.h>
#include <string.h>

/* Reads the three numbers of a normal. A bad normal is no error, because no other data depend on
 * it. */
static void read_normal(lines *r)
{
    mesh_file *m = r->mesh;
    mesh_normals *of = &m->vertex_normals;
    of->values = grow(of->values, &of->room_values, 3 * (of->n + 1), sizeof *of->values);
    of->spans = grow(of->spans, &of->room_spans, 2 * (of->n + 1), sizeof *of->spans);
    lines_skip_blanks(r);
    of->spans[2 * of->n] = (size_t)(r->at - m->text);
    double *value = of->values + 3 * of->n;
    for (size_t k = 0; k < 3; k++) {
        lines_skip_blanks(r);
        if (r->at >= r->end || number_read(&r->at, &value[k]) != NUMBER_OK ||
            strchr(" \t\r\n", *r->at) == NULL) {
            value[0] = HUGE_VAL;
            break;
        }
    }
    of->spans[2 * of->n + 1] = (size_t)(r->at - m->text);
    of->n++;
}

/* Records the normal of a corner, after its second slash. Only at the end of the file it is known
 * if a normal with a positive number exists. */
static void note_normal(lines *r, uint32_t vertex)
{
    mesh_normals *of = &r->mesh->vertex_normals;
    const char *p = r->at + (*r->at == '/');
    double index, n = (double)of->n;
    p += strcspn(p, "/ \t\r\n");
    if (*p++ != '/' || number_read(&p, &index) != NUMBER_OK || floor(index) != index ||
        !(index >= 1 || (index <= -1 && n + index >= 0)) || !(index < UINT32_MAX))
        return;
    of->uses = grow(of->uses, &of->room_uses, 2 * (of->n_uses + 1), sizeof *of->uses);
    of->uses[2 * of->n_uses] = (uint32_t)(index > 0 ? index - 1 : n + index);
    of->uses[2 * of->n_uses++ + 1] = vertex;
}

/* Reads a corner of a face: v, v/vt, v//vn or v/vt/vn, counted from 1, or from -1 backwards. */
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
    note_normal(r, *vertex);
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
    r->mesh->vertex_normals.n_spans = 1;
    do {
        bool vertex = lines_take(r, "v"), face = !vertex && lines_take(r, "f");
        if ((vertex && !lines_vertex(r)) || (face && !read_face(r)))
            return false;
        if (!vertex && !face && lines_take(r, "vn"))
            read_normal(r);
    } while (lines_next(r));
    return true;
}
