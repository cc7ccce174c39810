/* The formats are those of https://www.ljll.fr/frey/publications/RT-0253.pdf (Medit),
 * https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format-version-2 and
 * https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html. Cells stay in their order,
 * which version 4 of Gmsh's format would not allow. */
#include "mesh/numbered_mesh.h"

#include "mesh/element_kinds.h"

#include <stdbool.h>
#include <string.h>

enum { GMSH_TRIANGLE = 2, GMSH_TETRAHEDRON = 4 };

static unsigned long region_of(const numbered_mesh *m, size_t cell)
{
    return m->regions[cell] + 1UL;
}

static int kind_of(const numbered_mesh *m)
{
    return m->dim == 2 ? ELEMENT_TRIANGLE : ELEMENT_TETRAHEDRON;
}

/* Writes a line with the coordinates of each point. `flat`: in the plane without a third one. */
static void write_points(const numbered_mesh *m, bool numbered, bool flat, const char *end,
                         FILE *out)
{
    for (size_t i = 0; i < m->n_points; i++) {
        const double *x = m->points + m->dim * i;
        if (numbered)
            fprintf(out, "%zu ", i + 1);
        fprintf(out, "%.17g %.17g", x[0], x[1]);
        if (m->dim == 3)
            fprintf(out, " %.17g", x[2]);
        fprintf(out, "%s%s\n", m->dim == 2 && !flat ? " 0" : "", end);
    }
}

/* Writes n points of a cell, which count from `from`. */
static void write_corners(const uint32_t *corners, size_t n, unsigned long from, FILE *out)
{
    for (size_t k = 0; k < n; k++)
        fprintf(out, k > 0 ? " %lu" : "%lu", corners[k] + from);
}

static void write_medit(const numbered_mesh *m, FILE *out)
{
    fprintf(out, "MeshVersionFormatted 2\nDimension %zu\nVertices\n%zu\n", m->dim, m->n_points);
    write_points(m, false, true, " 0", out);
    if (m->n_faces > 0)
        fprintf(out, "Triangles\n%zu\n", m->n_faces);
    for (size_t i = 0; i < m->n_faces; i++) {
        write_corners(m->faces + 3 * i, 3, 1, out);
        fputs(" 0\n", out);
    }
    fprintf(out, "%s\n%zu\n", m->dim == 2 ? "Triangles" : "Tetrahedra", m->n_cells);
    for (size_t i = 0; i < m->n_cells; i++) {
        write_corners(m->cells + (m->dim + 1) * i, m->dim + 1, 1, out);
        fprintf(out, " %lu\n", region_of(m, i));
    }
    fputs("End\n", out);
}

static void write_gmsh(const numbered_mesh *m, FILE *out)
{
    fprintf(out, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%zu\n", m->n_points);
    write_points(m, true, false, "", out);
    fprintf(out, "$EndNodes\n$Elements\n%zu\n", m->n_cells);
    for (size_t i = 0; i < m->n_cells; i++) {
        fprintf(out, "%zu %d 2 %lu %lu ", i + 1, m->dim == 2 ? GMSH_TRIANGLE : GMSH_TETRAHEDRON,
                region_of(m, i), region_of(m, i));
        write_corners(m->cells + (m->dim + 1) * i, m->dim + 1, 1, out);
        fputc('\n', out);
    }
    fputs("$EndElements\n", out);
}

static void write_vtk(const numbered_mesh *m, FILE *out)
{
    const size_t n = m->dim + 1;
    fprintf(out, "# vtk DataFile Version 3.0\nlibicc\nASCII\nDATASET UNSTRUCTURED_GRID\n");
    fprintf(out, "POINTS %zu double\n", m->n_points);
    write_points(m, false, false, "", out);
    fprintf(out, "CELLS %zu %zu\n", m->n_cells, (n + 1) * m->n_cells);
    for (size_t i = 0; i < m->n_cells; i++) {
        fprintf(out, "%zu ", n);
        write_corners(m->cells + n * i, n, 0, out);
        fputc('\n', out);
    }
    fprintf(out, "CELL_TYPES %zu\n", m->n_cells);
    for (size_t i = 0; i < m->n_cells; i++)
        fprintf(out, "%d\n", kind_of(m));
    fprintf(out, "CELL_DATA %zu\nSCALARS region int 1\nLOOKUP_TABLE default\n", m->n_cells);
    for (size_t i = 0; i < m->n_cells; i++)
        fprintf(out, "%lu\n", region_of(m, i));
}

/* Writes the four arrays of the cells. */
static void write_vtu_cells(const numbered_mesh *m, FILE *out)
{
    const size_t n = m->dim + 1;
    fputs("<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n", out);
    for (size_t i = 0; i < m->n_cells; i++) {
        write_corners(m->cells + n * i, n, 0, out);
        fputc('\n', out);
    }
    fputs("</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n", out);
    for (size_t i = 0; i < m->n_cells; i++)
        fprintf(out, "%zu\n", n * (i + 1));
    fputs("</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n", out);
    for (size_t i = 0; i < m->n_cells; i++)
        fprintf(out, "%d\n", kind_of(m));
    fputs("</DataArray>\n</Cells>\n<CellData Scalars=\"region\">\n"
          "<DataArray type=\"Int32\" Name=\"region\" format=\"ascii\">\n",
          out);
    for (size_t i = 0; i < m->n_cells; i++)
        fprintf(out, "%lu\n", region_of(m, i));
    fputs("</DataArray>\n</CellData>\n", out);
}

static void write_vtu(const numbered_mesh *m, FILE *out)
{
    fprintf(out,
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
            "<UnstructuredGrid>\n<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n<Points>\n"
            "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
            m->n_points, m->n_cells);
    write_points(m, false, false, "", out);
    fputs("</DataArray>\n</Points>\n", out);
    write_vtu_cells(m, out);
    fputs("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", out);
}

void numbered_mesh_write(const numbered_mesh *m, const char *format, FILE *out)
{
    static const struct {
        const char *format;
        void (*write)(const numbered_mesh *m, FILE *out);
    } writers[] = {{"Gmsh", write_gmsh}, {"VTK", write_vtk}, {"VTU", write_vtu}};
    for (size_t k = 0; k < sizeof writers / sizeof *writers; k++)
        if (format != NULL && strcmp(format, writers[k].format) == 0) {
            writers[k].write(m, out);
            return;
        }
    write_medit(m, out);
}
