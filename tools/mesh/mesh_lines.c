/* Words, numbers and elements of text meshes. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "base/number.h"
#include "mesh/element_kinds.h"

#include <math.h>
#include <string.h>

bool lines_next(lines *r)
{
    if (*r->end == '\0')
        return false;
    r->at = r->end + 1;
    r->end = r->at + strcspn(r->at, "\n");
    r->line++;
    return *r->at != '\0';
}

void lines_skip_blanks(lines *r)
{
    r->at += strspn(r->at, " \t\r");
    if (*r->at == '#')
        r->at = r->end;
}

bool lines_take(lines *r, const char *word)
{
    size_t n = strlen(word);
    lines_skip_blanks(r);
    if (strncmp(r->at, word, n) != 0 || strchr(" \t\r\n#", r->at[n]) == NULL)
        return false;
    r->at += n;
    return true;
}

bool lines_word(lines *r)
{
    for (lines_skip_blanks(r); r->at >= r->end; lines_skip_blanks(r))
        if (!lines_next(r))
            return spoilt(r->wrong, r->line, "the file ends early");
    return true;
}

bool lines_number(lines *r, double *value)
{
    lines_skip_blanks(r);
    char shown[32];
    const char *word = r->at;
    if (r->at < r->end && number_read(&r->at, value) == NUMBER_OK &&
        strchr(" \t\r\n", *r->at) != NULL)
        return true;
    return spoilt(r->wrong, r->line, "'%s' is not a finite number", quoted(shown, word));
}

bool lines_count(lines *r, double limit, uint32_t *count)
{
    double value;
    if (!lines_number(r, &value))
        return false;
    if (!(value >= 0 && value < limit && floor(value) == value))
        return spoilt(r->wrong, r->line, "%.17g where a whole number below %.17g is expected",
                      value, limit);
    *count = (uint32_t)value;
    return true;
}

bool lines_next_count(lines *r, double limit, uint32_t *count)
{
    return lines_word(r) && lines_count(r, limit, count);
}

void mesh_make_room(mesh_file *m)
{
    size_t n = m->n_vertices + 1;
    m->points = grow(m->points, &m->room_points, m->dim * n, sizeof *m->points);
    m->spans = grow(m->spans, &m->room_spans, 2 * m->n_spans * n, sizeof *m->spans);
}

bool lines_vertex(lines *r)
{
    mesh_file *m = r->mesh;
    size_t i = m->n_vertices;
    mesh_make_room(m);
    lines_skip_blanks(r);
    m->spans[2 * i] = (size_t)(r->at - m->text);
    for (size_t k = 0; k < m->dim; k++)
        if ((r->wraps && !lines_word(r)) || !lines_number(r, m->points + m->dim * i + k))
            return false;
    m->spans[2 * i + 1] = (size_t)(r->at - m->text);
    m->n_vertices++;
    return true;
}

/* Adds a node to the last element. */
static void add_node(mesh_file *m, uint32_t node)
{
    size_t n = m->node_starts[m->n_elements];
    m->nodes = grow(m->nodes, &m->room_nodes, n + 1, sizeof *m->nodes);
    m->nodes[n] = node;
    m->node_starts[m->n_elements]++;
}

/* Adds an element without nodes. */
static void add_element(mesh_file *m, int kind)
{
    size_t i = m->n_elements++;
    m->kinds = grow(m->kinds, &m->room_kinds, i + 1, sizeof *m->kinds);
    m->node_starts = grow(m->node_starts, &m->room_node_starts, i + 2, sizeof *m->node_starts);
    m->kinds[i] = (unsigned char)kind;
    m->node_starts[0] = 0;
    m->node_starts[i + 1] = m->node_starts[i];
}

/* Adds the next triangle of a face's fan. */
static void add_triangle(lines *r)
{
    mesh_file *m = r->mesh;
    m->triangles =
        grow(m->triangles, &m->room_triangles, 3 * (m->n_triangles + 1), sizeof *m->triangles);
    m->triangle_lines = grow(m->triangle_lines, &m->room_triangle_lines, m->n_triangles + 1,
                             sizeof *m->triangle_lines);
    memcpy(m->triangles + 3 * m->n_triangles, r->corners, sizeof r->corners);
    m->triangle_lines[m->n_triangles++] = r->line;
}

void lines_begin_face(lines *r)
{
    r->n_corners = 0;
}

/* Adds a corner to a fan. */
static void fan(lines *r, uint32_t vertex)
{
    r->corners[r->n_corners < 2 ? r->n_corners : 2] = vertex;
    if (++r->n_corners < 3)
        return;
    r->mesh->n_faces += r->n_corners == 3;
    add_triangle(r);
    r->corners[1] = vertex;
}

void lines_corner(lines *r, uint32_t vertex)
{
    mesh_file *m = r->mesh;
    uint32_t second = r->corners[1];
    fan(r, vertex);
    if (r->n_corners == 3) {
        add_element(m, ELEMENT_TRIANGLE);
        add_node(m, r->corners[0]);
        add_node(m, second);
    }
    if (r->n_corners < 3)
        return;
    m->kinds[m->n_elements - 1] = r->n_corners == 3   ? ELEMENT_TRIANGLE
                                  : r->n_corners == 4 ? ELEMENT_QUADRILATERAL
                                                      : ELEMENT_POLYGON;
    add_node(m, vertex);
}

bool lines_end_face(lines *r)
{
    return r->n_corners >= 3 || spoilt(r->wrong, r->line, "the face has %zu corners", r->n_corners);
}

static void add_tetrahedron(mesh_file *m, const uint32_t corners[4])
{
    m->tetrahedra =
        grow(m->tetrahedra, &m->room_tetrahedra, 4 * (m->n_tetrahedra + 1), sizeof *m->tetrahedra);
    memcpy(m->tetrahedra + 4 * m->n_tetrahedra++, corners, 4 * sizeof *corners);
}

bool lines_element(lines *r, int kind, size_t n, const uint32_t *nodes)
{
    mesh_file *m = r->mesh;
    const element_kind *k = element_kind_find(kind);
    bool polygon = k->shape == SHAPE_POLYGON && n >= 3;
    bool flat = (k->dim == 2 && k->degree == 1 && k->n_nodes > 0) || polygon;
    if (k->n_nodes > 0 && n != k->n_nodes)
        return false;
    add_element(m, kind);
    for (size_t i = 0; i < n; i++)
        add_node(m, nodes[i]);
    lines_begin_face(r);
    for (size_t i = 0; i < n && flat; i++)
        fan(r, nodes[k->order != NULL ? k->order[i] : i]);
    if (kind == ELEMENT_TETRAHEDRON)
        add_tetrahedron(m, nodes);
    return true;
}

void mesh_set_region(mesh_file *m, size_t i, double region)
{
    if (!(region >= INT32_MIN && region <= INT32_MAX) || floor(region) < region)
        return;
    m->regions = grow(m->regions, &m->room_regions, i + 1, sizeof *m->regions);
    while (m->n_regions <= i)
        m->regions[m->n_regions++] = 0;
    m->regions[i] = (int32_t)region;
}

const char *mesh_region_name(size_t k)
{
    static const char *const names[] = {"region", "medit:ref", "gmsh:physical", "gmsh:geometrical",
                                        "CellEntityIds"};
    return k < sizeof names / sizeof *names ? names[k] : NULL;
}
