#include "mesh/mesh_file.h"

#include "base/foreign.h"
#include "mesh/mesh_lines.h"

#include <stdlib.h>
#include <string.h>

typedef struct format {
    const char *name, *begin; /* what its files begin with */
    bool word;                /* which is a word */
    bool (*read)(lines *r);
} format;

/* OBJ has no mark of its own. */
static const format formats[] = {{"VTK", "# vtk DataFile", false, mesh_read_vtk},
                                 {"PLY", "ply", true, mesh_read_ply},
                                 {"Medit", "MeshVersion", false, mesh_read_medit},
                                 {"OFF", "OFF", true, mesh_read_off},
                                 {"OBJ", "", false, mesh_read_obj}};

/* The format of the file, and in `r` where it begins, behind comments. */
static const format *find_format(lines *r)
{
    if (strncmp(r->at, "\xef\xbb\xbf", 3) == 0)
        r->at += 3;
    r->end = r->at + strcspn(r->at, "\n");
    if (strncmp(r->at, formats[0].begin, strlen(formats[0].begin)) == 0)
        return &formats[0];
    while (lines_skip_blanks(r), r->at == r->end && lines_next(r))
        ;
    for (const format *f = formats + 1;; f++) {
        size_t n = strlen(f->begin);
        if (strncmp(r->at, f->begin, n) == 0 && (!f->word || strchr(" \t\r\n#", r->at[n]) != NULL))
            return f;
    }
}

const char *mesh_format(const char *text)
{
    lines r = {.at = text};
    return find_format(&r)->name;
}

/* PLY may be binary; the others are text from end to end. */
static bool read_bytes(lines *r)
{
    mesh_file *m = r->mesh;
    const format *f = find_format(r);
    m->format = f->name;
    if (f->read != mesh_read_ply && strlen(m->text) != m->n_text)
        return spoilt(r->wrong, 0,
                      "this is not a text file; OBJ, OFF, Medit and VTK are read as text");
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
        return spoilt(
            wrong, 0,
            "there are no vertices; the file must be OBJ, OFF, PLY, Medit (.mesh) or VTK");
    return true;
}

void mesh_free(mesh_file *m)
{
    free(m->points);
    free(m->spans);
    free(m->triangles);
    free(m->triangle_lines);
    free(m->tetrahedra);
    *m = (mesh_file){0};
}

/* As text, or eight bytes. */
static void write_number(const mesh_file *m, double number, FILE *stream)
{
    unsigned char bytes[8];
    uint64_t bits;
    if (m->form == MESH_TEXT) {
        fprintf(stream, "%.17g", number);
        return;
    }
    memcpy(&bits, &number, 8);
    for (size_t i = 0; i < 8; i++)
        bytes[m->form == MESH_LITTLE ? i : 7 - i] = (unsigned char)(bits >> 8 * i);
    fwrite(bytes, 1, 8, stream);
}

/* The text goes out as it came in, but for the types and the spans. */
void mesh_write(const mesh_file *m, const double *points, FILE *stream)
{
    size_t done = 0;
    for (size_t i = 0; i < m->n_types; i++) {
        fwrite(m->text + done, 1, m->types[i][0] - done, stream);
        fputs("double", stream);
        done = m->types[i][1];
    }
    for (size_t i = 0; i < m->n_vertices * m->n_spans; i++) {
        const double *point = points + m->dim * (i / m->n_spans);
        fwrite(m->text + done, 1, m->spans[2 * i] - done, stream);
        for (size_t k = 0; m->n_spans == 1 && k < m->dim; k++) {
            fputs(k > 0 ? " " : "", stream);
            write_number(m, point[k], stream);
        }
        if (m->n_spans > 1)
            write_number(m, point[m->order[i % m->n_spans]], stream);
        done = m->spans[2 * i + 1];
    }
    fwrite(m->text + done, 1, m->n_text - done, stream);
}
