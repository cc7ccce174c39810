/* VTU, VTK's XML format for unstructured grids, in all its forms: vtu.h. The pieces of a file are
 * read one after the other. Only the arrays of points change. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "mesh/mesh_vectors.h"
#include "mesh/vtu.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---------------------------------------------------------------------- points */

/* The points of a piece with other coordinates. */
static double *moved_points(const mesh_file *m, const vtu_array *a, size_t first,
                            const double *points)
{
    double *out = need(a->n, sizeof *out);
    for (size_t i = 0; i < a->n; i++)
        out[i] = i % 3 < m->dim ? points[m->dim * (first + i / 3) + i % 3] : a->values[i];
    return out;
}

static bool add_points(lines *r, const vtu_array *a)
{
    mesh_file *m = r->mesh;
    for (size_t i = 0; i < a->n / 3; i++) {
        mesh_make_room(m);
        for (size_t k = 0; k < m->dim; k++) {
            m->points[m->dim * m->n_vertices + k] = a->values[3 * i + k];
            if (!isfinite(a->values[3 * i + k]))
                return spoilt(r->wrong, 0, "vertex %zu is not finite", m->n_vertices);
        }
        m->n_vertices++;
    }
    return true;
}

static bool read_points(lines *r, size_t piece)
{
    vtu *v = r->mesh->vtu;
    vtu_array *a = vtu_find(v, piece, VTU_POINTS, NULL);
    uint64_t n = 3 * (uint64_t)v->pieces[piece].n_points;
    if (a == NULL)
        return n == 0 || spoilt(r->wrong, 0, "piece %zu has no array of points", piece);
    for (const vtu_array *b = a + 1; b < v->arrays + v->n_arrays && b->piece == piece; b++)
        if (b->section == VTU_POINTS)
            return spoilt(r->wrong, 0, "piece %zu has several arrays of points", piece);
    if (a->n_components != 3)
        return spoilt(r->wrong, 0, "the points have %u components; a mesh has 3",
                      (unsigned)a->n_components);
    if (v->n_word == 4 && !v->is_zipped && !a->is_text && n > UINT32_MAX / 8)
        return spoilt(r->wrong, 0,
                      "too many points for sizes of 4 bytes; save it with "
                      "header_type UInt64");
    return vtu_read(v, a, n, r->wrong) && vtu_is_apart(v, a, r->wrong) && add_points(r, a);
}

/* ----------------------------------------------------------------------- cells */

static bool read_cell_array(lines *r, size_t piece, const char *name, size_t n, vtu_array **out)
{
    vtu *v = r->mesh->vtu;
    *out = vtu_find(v, piece, VTU_CELLS, name);
    if (*out == NULL)
        return spoilt(r->wrong, 0, "piece %zu has no array '%s' of its cells", piece, name);
    return vtu_read(v, *out, n, r->wrong);
}

/* Number i of an array if it is a whole number from `least` to `most`. */
static bool take(lines *r, const vtu_array *a, size_t i, double least, double most, size_t *out)
{
    double value = a->values[i];
    char name[32];
    if (!(value >= least && value <= most && floor(value) >= value))
        return spoilt(r->wrong, 0, "number %zu of the array '%s' is %.17g; it lies in %.17g..%.17g",
                      i, vtu_name(r->mesh->vtu, a, name), value, least, most);
    *out = (size_t)value;
    return true;
}

typedef struct cells {
    vtu_array *ends, *nodes, *types;
    size_t first, n_points; /* of the piece's vertices */
} cells;

static bool add_cell(lines *r, const cells *c, size_t i, size_t begin, size_t end)
{
    size_t type = 0, node = 0, n = end - begin;
    if (!take(r, c->types, i, 0, 255, &type))
        return false;
    uint32_t *nodes = need(n, sizeof *nodes);
    bool good = true;
    for (size_t k = 0; k < n && good; k++) {
        good = c->n_points > 0 ? take(r, c->nodes, begin + k, 0, (double)c->n_points - 1, &node)
                               : spoilt(r->wrong, 0, "cell %zu has nodes, but there are none", i);
        nodes[k] = good ? (uint32_t)(c->first + node) : 0;
    }
    good = good && (lines_element(r, (int)type, n, nodes) ||
                    spoilt(r->wrong, 0, "cell %zu has %zu corners, but type %zu", i, n, type));
    free(nodes);
    return good;
}

static bool add_cells(lines *r, const cells *c)
{
    for (size_t i = 0, begin = 0, end = 0; i < c->ends->n; i++, begin = end)
        if (!take(r, c->ends, i, (double)begin, (double)c->nodes->n, &end) ||
            !add_cell(r, c, i, begin, end))
            return false;
    return true;
}

static void forget(vtu_array *a)
{
    if (a == NULL)
        return;
    free(a->values);
    a->values = NULL;
}

/* Reads the regions of a piece's cells from the first array of cell data with such a name. */
static bool read_regions(lines *r, size_t piece, size_t first, size_t n)
{
    vtu *v = r->mesh->vtu;
    vtu_array *a = NULL;
    for (size_t k = 0; mesh_region_name(k) != NULL && a == NULL; k++)
        a = vtu_find(v, piece, VTU_CELL_DATA, mesh_region_name(k));
    if (a == NULL || a->n_components > 1 || a->kind == '?')
        return true;
    bool good = vtu_read(v, a, n, r->wrong);
    for (size_t i = 0; i < n && good; i++)
        mesh_set_region(r->mesh, first + i, a->values[i]);
    forget(a);
    return good;
}

/* The offsets of cells are the ends of their lists of nodes. The last one is the number of nodes. */
static bool read_cells(lines *r, size_t piece, size_t first)
{
    const vtu_piece *p = &r->mesh->vtu->pieces[piece];
    cells c = {.first = first, .n_points = p->n_points};
    size_t n_nodes = 0, first_element = r->mesh->n_elements;
    if (p->n_cells == 0)
        return true;
    bool good = read_cell_array(r, piece, "offsets", p->n_cells, &c.ends) &&
                take(r, c.ends, p->n_cells - 1, 0, 4e9, &n_nodes) &&
                read_cell_array(r, piece, "connectivity", n_nodes, &c.nodes) &&
                read_cell_array(r, piece, "types", p->n_cells, &c.types) && add_cells(r, &c) &&
                read_regions(r, piece, first_element, p->n_cells);
    forget(c.ends);
    forget(c.nodes);
    forget(c.types);
    return good;
}

/* ------------------------------------------------------------------------- all */

bool mesh_read_vtu(lines *r)
{
    mesh_file *m = r->mesh;
    m->form = MESH_LITTLE;
    m->n_spans = 0;
    m->vtu = need(1, sizeof *m->vtu);
    if (!vtu_scan(m->vtu, m->text, m->n_text, r->wrong))
        return false;
    for (size_t i = 0; i < m->vtu->n_pieces; i++) {
        size_t first = m->n_vertices;
        if (!read_points(r, i) || !read_cells(r, i, first))
            return false;
    }
    return true;
}

/* The arrays of three floating-point numbers at points and in cells. */
static bool is_of_vectors(const vtu_array *a)
{
    return (a->section == VTU_POINT_DATA || a->section == VTU_CELL_DATA) && a->n_components == 3 &&
           a->kind == 'f';
}

static bool take_vectors(vtu *v, vtu_array *a, size_t first, size_t n, mesh_vector_list *out,
                         problem *wrong)
{
    if (!vtu_read(v, a, 3 * (uint64_t)n, wrong) || !vtu_is_apart(v, a, wrong))
        return false;
    mesh_vectors *of = vectors_begin(out, a->section == VTU_CELL_DATA);
    of->are_normals = a->is_normal;
    of->array = a;
    free(a->changed);
    a->changed = need(a->n, sizeof *a->changed);
    if (a->n > 0)
        memcpy(a->changed, a->values, a->n * sizeof *a->values);
    for (size_t i = 0; i < n; i++)
        vectors_add(of, (uint32_t)(first + i), a->values + 3 * i, 0, 0);
    return true;
}

bool vtu_find_vectors(const mesh_file *m, mesh_vector_list *out, problem *wrong)
{
    vtu *v = m->vtu;
    size_t first_point = 0, first_cell = 0, piece = 0;
    for (size_t i = 0; i < v->n_arrays; i++) {
        vtu_array *a = &v->arrays[i];
        for (; piece < a->piece; piece++) {
            first_point += v->pieces[piece].n_points;
            first_cell += v->pieces[piece].n_cells;
        }
        const vtu_piece *p = &v->pieces[piece];
        bool in_cells = a->section == VTU_CELL_DATA;
        if (is_of_vectors(a) && !take_vectors(v, a, in_cells ? first_cell : first_point,
                                              in_cells ? p->n_cells : p->n_points, out, wrong))
            return false;
    }
    return true;
}

void vtu_write(const mesh_file *m, const double *points, FILE *stream)
{
    const vtu *v = m->vtu;
    edits e = {0};
    size_t first = 0;
    for (size_t i = 0; i < v->n_arrays; i++) {
        const vtu_array *a = &v->arrays[i];
        if (a->changed != NULL)
            vtu_put(&e, v, a, a->changed, false);
        if (a->section != VTU_POINTS || a->n == 0)
            continue;
        double *moved = moved_points(m, a, first, points);
        vtu_put(&e, v, a, moved, true);
        first += a->n / 3;
        free(moved);
    }
    vtu_put_offsets(&e, v);
    edits_write(&e, m->text, m->n_text, stream);
    edits_free(&e);
}
