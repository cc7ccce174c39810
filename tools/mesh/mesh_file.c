/* Chooses the reader of a mesh, and writes its text with other coordinates. */
#include "mesh/mesh_file.h"

#include "base/allocate.h"
#include "base/bytes.h"
#include "base/foreign.h"
#include "mesh/element_kinds.h"
#include "mesh/mesh_lines.h"
#include "mesh/vtu.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct format {
    const char *name, *begin; /* the beginning of its files */
    bool word;                /* which must be a whole word */
    bool binary;              /* it may be binary */
    bool (*read)(lines *r);
} format;

/* OBJ has no mark at its beginning. */
static const format formats[] = {{"VTK", "# vtk DataFile", false, true, mesh_read_vtk},
                                 {"PLY", "ply", true, true, mesh_read_ply},
                                 {"Medit", "MeshVersion", false, false, mesh_read_medit},
                                 {"Gmsh", "$MeshFormat", true, true, mesh_read_gmsh},
                                 {"OFF", "OFF", true, false, mesh_read_off},
                                 {"OBJ", "", false, false, mesh_read_obj}};
static const format stl = {"STL", NULL, false, true, mesh_read_stl};
static const format gltf = {"glTF", NULL, false, true, mesh_read_glb};
static const format in_xml = {"VTU", NULL, false, true, mesh_read_vtu};

/* Finds the format of a file of n bytes. `r` is then at its beginning, after comments. */
static const format *find_format(lines *r, size_t n)
{
    const format *whole = mesh_is_glb(r->at, n)   ? &gltf
                          : mesh_is_stl(r->at, n) ? &stl
                          : vtu_told(r->at)       ? &in_xml
                                                  : NULL;
    if (strncmp(r->at, "\xef\xbb\xbf", 3) == 0)
        r->at += 3;
    r->end = r->at + strcspn(r->at, "\n");
    if (whole != NULL)
        return whole;
    if (strncmp(r->at, formats[0].begin, strlen(formats[0].begin)) == 0)
        return &formats[0];
    while (lines_skip_blanks(r), r->at == r->end && lines_next(r))
        ;
    for (const format *f = formats + 1;; f++) {
        size_t n_begin = strlen(f->begin);
        if (strncmp(r->at, f->begin, n_begin) == 0 &&
            (!f->word || strchr(" \t\r\n#", r->at[n_begin]) != NULL))
            return f;
    }
}

const char *lines_format(lines *r, size_t n)
{
    return find_format(r, n)->name;
}

const char *mesh_format(const char *text, size_t n)
{
    lines r = {.at = text};
    return lines_format(&r, n);
}

bool mesh_told(const char *text, size_t n)
{
    lines r = {.at = text};
    return find_format(&r, n)->read != mesh_read_obj;
}

static bool read_bytes(lines *r)
{
    mesh_file *m = r->mesh;
    const format *f = find_format(r, m->n_text);
    m->format = f->name;
    if (!f->binary && strlen(m->text) != m->n_text)
        return spoilt(r->wrong, 0, "this is not a text file; OBJ, OFF and Medit are read as text");
    return f->read(r);
}

bool mesh_read(mesh_file *out, size_t dim, const char *text, size_t n, problem *wrong)
{
    *out = (mesh_file){.text = text, .n_text = n, .dim = dim, .n_spans = 1, .order = {0, 1, 2}};
    lines r = {.mesh = out, .at = text, .line = 1, .wrong = wrong};
    if (n == 0)
        return spoilt(wrong, 0, "the file is empty");
    if (foreign_told(text, n, wrong) || !read_bytes(&r))
        return false;
    if (out->n_vertices == 0)
        return spoilt(wrong, 0,
                      "there are no vertices; the file must be OBJ, OFF, PLY, STL, glTF, "
                      "Medit (.mesh), Gmsh (.msh), VTK or VTU");
    return true;
}

void mesh_free(mesh_file *m)
{
    free(m->points);
    free(m->spans);
    free(m->normals);
    free(m->own);
    free(m->vertex_normals.values);
    free(m->vertex_normals.spans);
    free(m->vertex_normals.uses);
    free(m->places);
    if (m->vtu != NULL)
        vtu_free(m->vtu);
    free(m->vtu);
    free(m->triangles);
    free(m->triangle_lines);
    free(m->tetrahedra);
    free(m->kinds);
    free(m->node_starts);
    free(m->nodes);
    free(m->regions);
    free(m->parts);
    free(m->line_starts);
    free(m->line_nodes);
    *m = (mesh_file){0};
}

int32_t *mesh_tetrahedron_regions(const mesh_file *m)
{
    if (m->n_regions == 0)
        return NULL;
    int32_t *regions = need(m->n_tetrahedra, sizeof *regions);
    size_t n = 0;
    for (size_t i = 0; i < m->n_elements; i++)
        if (m->kinds[i] == ELEMENT_TETRAHEDRON)
            regions[n++] = i < m->n_regions ? m->regions[i] : 0;
    return regions;
}

bool mesh_round(const mesh_file *m, double *points, size_t *beyond)
{
    if (mesh_is_glb(m->text, m->n_text))
        return glb_round(m, points, beyond);
    for (size_t i = 0; m->floats && i < m->n_vertices * m->dim; i++) {
        *beyond = i / m->dim;
        if (isfinite(points[i]) && fabs(points[i]) > (double)FLT_MAX)
            return false;
        points[i] = (double)(float)points[i];
    }
    return true;
}

/* Writes a number as text, or as the bytes of a float or a double. */
static void write_number(const mesh_file *m, double number, FILE *stream)
{
    unsigned char bytes[8];
    uint64_t bits = 0;
    size_t n = m->floats ? 4 : 8;
    if (m->form == MESH_TEXT) {
        fprintf(stream, "%.17g", number);
        return;
    }
    if (m->floats) {
        float rounded = (float)number;
        uint32_t half;
        memcpy(&half, &rounded, 4);
        bits = half;
    } else {
        memcpy(&bits, &number, 8);
    }
    for (size_t i = 0; i < n; i++)
        bytes[m->form == MESH_LITTLE ? i : n - 1 - i] = (unsigned char)(bits >> 8 * i);
    fwrite(bytes, 1, n, stream);
}

static void write_numbers(const mesh_file *m, size_t n, const double *numbers, FILE *stream)
{
    for (size_t k = 0; k < n; k++) {
        fputs(k > 0 && m->form == MESH_TEXT ? " " : "", stream);
        write_number(m, numbers[k], stream);
    }
}

/* The unit normal of a triangle, or 0 for a flat one. Edges are scaled first, so that their
 * products stay within range. */
static void write_normal(const mesh_file *m, const double *points, size_t triangle, FILE *stream)
{
    const uint32_t *corners = m->triangles + 3 * triangle;
    double edges[2][3], size = 0;
    for (size_t k = 0; k < 6; k++) {
        double *d = &edges[k / 3][k % 3];
        *d = points[3 * corners[k / 3 + 1] + k % 3] - points[3 * corners[0] + k % 3];
        size = fmax(size, fabs(*d));
    }
    for (size_t k = 0; k < 6 && size > 0; k++)
        edges[k / 3][k % 3] /= size;
    const double *u = edges[0], *v = edges[1];
    double normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                        u[0] * v[1] - u[1] * v[0]};
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (size_t k = 0; k < 3; k++)
        normal[k] = length > 0 ? normal[k] / length : 0;
    write_numbers(m, 3, normal, stream);
}

/* Writes the file from `done` to the end. */
static void write_rest(const mesh_file *m, const double *points, size_t done, FILE *stream)
{
    for (size_t i = 0; i < m->n_vertices * m->n_spans; i++) {
        const double *point = points + m->dim * (i / m->n_spans);
        if (m->normals != NULL && m->dim == 3 && i % 3 == 0) {
            const size_t *span = m->normals + 2 * (i / 3);
            fwrite(m->text + done, 1, span[0] - done, stream);
            write_normal(m, points, i / 3, stream);
            done = span[1];
        }
        fwrite(m->text + done, 1, m->spans[2 * i] - done, stream);
        if (m->n_spans == 1)
            write_numbers(m, m->dim, point, stream);
        else
            write_number(m, point[m->order[i % m->n_spans]], stream);
        done = m->spans[2 * i + 1];
        if (m->has_rest) {
            write_number(m, (double)big_endian_float(m->text + done), stream);
            done += 4;
        }
    }
    fwrite(m->text + done, 1, m->n_text - done, stream);
}

/* The file is written as it was read, except the types and the spans. */
void mesh_write(const mesh_file *m, const double *points, const char *name, FILE *stream)
{
    size_t done = 0;
    if (mesh_is_glb(m->text, m->n_text)) {
        glb_write(m, points, glb_is_json(name), stream);
        return;
    }
    if (m->vtu != NULL) {
        vtu_write(m, points, stream);
        return;
    }
    for (size_t i = 0; i < m->n_types; i++) {
        fwrite(m->text + done, 1, m->types[i][0] - done, stream);
        fputs("double", stream);
        done = m->types[i][1];
    }
    write_rest(m, points, done, stream);
}
