#include "mesh_file.h"

#include "memory.h"
#include "number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One line at a time. */
typedef struct lines {
    mesh_file *mesh;
    const char *at, *end; /* of the current line */
    size_t line;
    problem *wrong;
} lines;

static bool first_line(lines *r, mesh_file *mesh, problem *wrong)
{
    *r = (lines){.mesh = mesh, .at = mesh->text, .line = 1, .wrong = wrong};
    if (strncmp(r->at, "\xef\xbb\xbf", 3) == 0)
        r->at += 3;
    r->end = r->at + strcspn(r->at, "\n");
    return mesh->n_text > 0;
}

static bool next_line(lines *r)
{
    if (*r->end == '\0')
        return false;
    r->at = r->end + 1;
    r->end = r->at + strcspn(r->at, "\n");
    r->line++;
    return *r->at != '\0';
}

static void skip_blanks(lines *r)
{
    r->at += strspn(r->at, " \t\r");
    if (*r->at == '#')
        r->at = r->end;
}

static bool next_number(lines *r, double *value)
{
    skip_blanks(r);
    char shown[32];
    const char *word = r->at;
    if (r->at < r->end && number_read(&r->at, value) == NUMBER_OK &&
        strchr(" \t\r\n", *r->at) != NULL)
        return true;
    return spoilt(r->wrong, r->line, "'%s' is not a finite number", quoted(shown, word));
}

static bool add_vertex(lines *r)
{
    mesh_file *m = r->mesh;
    m->points = grow(m->points, &m->room_points, 2 * (m->n_vertices + 1), sizeof *m->points);
    m->spans = grow(m->spans, &m->room_spans, 2 * (m->n_vertices + 1), sizeof *m->spans);
    double *xy = m->points + 2 * m->n_vertices;
    skip_blanks(r);
    m->spans[2 * m->n_vertices] = (size_t)(r->at - m->text);
    if (!next_number(r, xy) || !next_number(r, xy + 1))
        return false;
    m->spans[2 * m->n_vertices++ + 1] = (size_t)(r->at - m->text);
    return true;
}

static void add_corner(mesh_file *m, uint32_t corners[3], size_t *n, uint32_t vertex)
{
    corners[*n < 3 ? *n : 2] = vertex;
    if (++*n < 3)
        return;
    m->triangles =
        grow(m->triangles, &m->room_triangles, 3 * (m->n_triangles + 1), sizeof *m->triangles);
    memcpy(m->triangles + 3 * m->n_triangles++, corners, 3 * sizeof *corners);
    corners[1] = vertex;
}

/* One corner of an OBJ face: v, v/vt, v//vn or v/vt/vn, from 1, or from -1 backwards. */
static bool obj_corner(lines *r, uint32_t *vertex)
{
    double index;
    char shown[32];
    const char *word = r->at;
    double n = (double)r->mesh->n_vertices;
    if (number_read(&r->at, &index) != NUMBER_OK || strchr("/ \t\r\n", *r->at) == NULL ||
        floor(index) != index)
        return spoilt(r->wrong, r->line, "'%s' is not a corner of a face", quoted(shown, word));
    if (!(fabs(index) >= 1 && fabs(index) <= n))
        return spoilt(r->wrong, r->line, "the face has the vertex %.17g; there are %.0f so far",
                      index, n);
    *vertex = (uint32_t)(index > 0 ? index - 1 : n + index);
    r->at += strcspn(r->at, " \t\r\n");
    return true;
}

static bool obj_face(lines *r)
{
    uint32_t corners[3], vertex = 0;
    size_t n = 0;
    for (skip_blanks(r); r->at < r->end; skip_blanks(r)) {
        if (!obj_corner(r, &vertex))
            return false;
        add_corner(r->mesh, corners, &n, vertex);
    }
    return n >= 3 || spoilt(r->wrong, r->line, "the face has %zu corners", n);
}

static bool read_obj(lines *r)
{
    do {
        skip_blanks(r);
        bool vertex = r->at[0] == 'v' && strchr(" \t", r->at[1]) != NULL;
        bool face = r->at[0] == 'f' && strchr(" \t", r->at[1]) != NULL;
        r->at += vertex || face;
        if ((vertex && !add_vertex(r)) || (face && !obj_face(r)))
            return false;
    } while (next_line(r));
    return true;
}

/* Moves to the next line of an OFF file that says something. */
static bool off_line(lines *r)
{
    for (skip_blanks(r); r->at >= r->end; skip_blanks(r))
        if (!next_line(r))
            return spoilt(r->wrong, r->line, "the file ends early");
    return true;
}

static bool off_count(lines *r, double limit, uint32_t *count)
{
    double value;
    if (!next_number(r, &value))
        return false;
    if (!(value >= 0 && value < limit && floor(value) == value))
        return spoilt(r->wrong, r->line, "%.17g where a whole number below %.17g is expected",
                      value, limit);
    *count = (uint32_t)value;
    return true;
}

static bool off_face(lines *r)
{
    uint32_t corners[3], vertex = 0, n_corners = 0;
    size_t n = 0;
    if (!off_line(r) || !off_count(r, 1e6, &n_corners))
        return false;
    for (uint32_t i = 0; i < n_corners; i++) {
        if (!off_count(r, (double)r->mesh->n_vertices, &vertex))
            return false;
        add_corner(r->mesh, corners, &n, vertex);
    }
    r->at = r->end; /* colours */
    return n >= 3 || spoilt(r->wrong, r->line, "the face has %zu corners", n);
}

static bool read_off(lines *r)
{
    uint32_t n_vertices, n_faces;
    r->at += 3;
    if (!off_line(r) || !off_count(r, 4e9, &n_vertices) || !off_count(r, 4e9, &n_faces))
        return false;
    r->at = r->end; /* the number of edges, which nobody needs */
    for (uint32_t i = 0; i < n_vertices; i++) {
        if (!off_line(r) || !add_vertex(r))
            return false;
        r->at = r->end; /* z */
    }
    for (uint32_t i = 0; i < n_faces; i++)
        if (!off_face(r))
            return false;
    return true;
}

bool mesh_read(mesh_file *out, const char *text, size_t n, problem *wrong)
{
    *out = (mesh_file){.text = text, .n_text = n};
    lines r;
    if (!first_line(&r, out, wrong) || strlen(text) != n)
        return spoilt(wrong, 0,
                      n == 0 ? "the file is empty"
                             : "this is not a text file; OBJ and OFF are read");
    bool off = strncmp(r.at, "OFF", 3) == 0 && strchr(" \t\r\n#", r.at[3]) != NULL;
    if (!(off ? read_off(&r) : read_obj(&r)))
        return false;
    if (out->n_vertices == 0)
        return spoilt(wrong, 0, "there are no vertices; the file must be OBJ or OFF");
    return true;
}

void mesh_free(mesh_file *m)
{
    free(m->points);
    free(m->spans);
    free(m->triangles);
    *m = (mesh_file){0};
}

void mesh_write(const mesh_file *m, const double *points, FILE *stream)
{
    size_t done = 0;
    for (size_t i = 0; i < m->n_vertices; i++) {
        fwrite(m->text + done, 1, m->spans[2 * i] - done, stream);
        for (size_t k = 0; k < 2; k++) {
            double value = points[2 * i + k];
            if (k == 1)
                fputc(' ', stream);
            if (isnan(value))
                fputs("nan", stream);
            else
                fprintf(stream, "%.17g", value);
        }
        done = m->spans[2 * i + 1];
    }
    fwrite(m->text + done, 1, m->n_text - done, stream);
}
