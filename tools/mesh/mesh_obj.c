/* Wavefront OBJ: lines that begin with v, vn, f, l, o and g. */
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

/* Reads a corner of a face or line: v, v/vt, v//vn or v/vt/vn, counted from 1, or from -1
 * backwards. */
static bool read_corner(lines *r, const char *what, uint32_t *vertex)
{
    double index;
    char shown[32];
    const char *word = r->at;
    double n = (double)r->mesh->n_vertices;
    if (number_read(&r->at, &index) != NUMBER_OK || strchr("/ \t\r\n", *r->at) == NULL ||
        floor(index) != index)
        return spoilt(r->wrong, r->line, "'%s' is not a corner of a %s", quoted(shown, word), what);
    if (!(fabs(index) >= 1 && fabs(index) <= n))
        return spoilt(r->wrong, r->line, "the %s has the vertex %.17g; there are %.0f so far%s",
                      what, index, n, fabs(index) < 1 ? ", counted from 1" : "");
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
        if (!read_corner(r, "face", &vertex))
            return false;
        lines_corner(r, vertex);
    }
    return lines_end_face(r);
}

static void add_line_node(mesh_file *m, uint32_t vertex)
{
    size_t n = m->line_starts[m->n_lines];
    m->line_nodes = grow(m->line_nodes, &m->room_line_nodes, n + 1, sizeof *m->line_nodes);
    m->line_nodes[n] = vertex;
    m->line_starts[m->n_lines]++;
}

/* True if the line before ends at a vertex and belongs to the same part. */
static bool continues(const mesh_file *m, uint32_t vertex)
{
    bool has_line = m->n_lines > (m->n_parts > 0 ? m->parts[m->n_parts - 1].first_line : 0);
    return has_line && m->line_nodes[m->line_starts[m->n_lines] - 1] == vertex;
}

static bool read_line(lines *r)
{
    mesh_file *m = r->mesh;
    uint32_t vertex = 0;
    size_t n = 0;
    for (lines_skip_blanks(r); r->at < r->end; lines_skip_blanks(r), n++) {
        if (!read_corner(r, "line", &vertex))
            return false;
        if (n == 0 && continues(m, vertex))
            continue;
        if (n == 0) {
            m->line_starts =
                grow(m->line_starts, &m->room_line_starts, m->n_lines + 2, sizeof *m->line_starts);
            m->line_starts[0] = 0;
            m->line_starts[m->n_lines + 1] = m->line_starts[m->n_lines];
            m->n_lines++;
        }
        add_line_node(m, vertex);
    }
    return n >= 2 ||
           spoilt(r->wrong, r->line, "the line has %zu %s", n, n == 1 ? "vertex" : "vertices");
}

/* Begins a part. Its name is the rest of the line. */
static void begin_part(lines *r, bool is_group)
{
    mesh_file *m = r->mesh;
    const char *end = r->end;
    lines_skip_blanks(r);
    while (end > r->at && strchr(" \t\r", end[-1]) != NULL)
        end--;
    m->parts = grow(m->parts, &m->room_parts, m->n_parts + 1, sizeof *m->parts);
    m->parts[m->n_parts++] = (mesh_part){.name = r->at,
                                         .n_name = (size_t)(end - r->at),
                                         .is_group = is_group,
                                         .first_triangle = m->n_triangles,
                                         .first_line = m->n_lines};
}

bool mesh_read_obj(lines *r)
{
    r->mesh->vertex_normals.n_spans = 1;
    do {
        if (lines_take(r, "v")) {
            if (!lines_vertex(r))
                return false;
        } else if (lines_take(r, "f")) {
            if (!read_face(r))
                return false;
        } else if (lines_take(r, "l")) {
            if (!read_line(r))
                return false;
        } else if (lines_take(r, "vn")) {
            read_normal(r);
        } else if (lines_take(r, "o")) {
            begin_part(r, false);
        } else if (lines_take(r, "g")) {
            begin_part(r, true);
        }
    } while (lines_next(r));
    return true;
}
