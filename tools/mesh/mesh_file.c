#include "mesh/mesh_file.h"

#include "mesh/mesh_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool read_any(lines *r)
{
    if (strncmp(r->at, "# vtk DataFile", 14) == 0)
        return mesh_read_vtk(r);
    while (lines_skip_blanks(r), r->at == r->end && lines_next(r))
        ;
    if (strncmp(r->at, "MeshVersion", 11) == 0)
        return mesh_read_medit(r);
    if (strncmp(r->at, "OFF", 3) == 0 && strchr(" \t\r\n#", r->at[3]) != NULL)
        return mesh_read_off(r);
    return mesh_read_obj(r);
}

bool mesh_read(mesh_file *out, size_t dim, const char *text, size_t n, problem *wrong)
{
    *out = (mesh_file){.text = text, .n_text = n, .dim = dim};
    lines r = {.mesh = out, .at = text, .line = 1, .wrong = wrong};
    if (n == 0 || strlen(text) != n)
        return spoilt(wrong, 0,
                      n == 0 ? "the file is empty"
                             : "this is not a text file; OBJ, OFF, Medit and VTK are read as text");
    if (strncmp(r.at, "\xef\xbb\xbf", 3) == 0)
        r.at += 3;
    r.end = r.at + strcspn(r.at, "\n");
    if (!read_any(&r))
        return false;
    if (out->n_vertices == 0)
        return spoilt(wrong, 0,
                      "there are no vertices; the file must be OBJ, OFF, Medit (.mesh) or VTK");
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

static void write_point(const double *point, size_t dim, FILE *stream)
{
    for (size_t k = 0; k < dim; k++) {
        if (k > 0)
            fputc(' ', stream);
        if (isnan(point[k]))
            fputs("nan", stream);
        else
            fprintf(stream, "%.17g", point[k]);
    }
}

void mesh_write(const mesh_file *m, const double *points, FILE *stream)
{
    size_t done = m->type[1];
    if (done > 0) {
        fwrite(m->text, 1, m->type[0], stream);
        fputs("double", stream);
    }
    for (size_t i = 0; i < m->n_vertices; i++) {
        fwrite(m->text + done, 1, m->spans[2 * i] - done, stream);
        write_point(points + m->dim * i, m->dim, stream);
        done = m->spans[2 * i + 1];
    }
    fwrite(m->text + done, 1, m->n_text - done, stream);
}
