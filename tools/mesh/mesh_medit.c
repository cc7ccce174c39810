/* Medit's .mesh as text: sections with a name, the number of their items, and the items. Vertices
 * count from 1, and each item ends with a reference number, which is the region of an element. */
#include "mesh/element_kinds.h"
#include "mesh/mesh_lines.h"

#include <stdlib.h>
#include <string.h>

static bool is_letter(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

static bool read_dimension(lines *r)
{
    uint32_t dim;
    if (!lines_next_count(r, 4, &dim))
        return false;
    return dim == 3 || dim == r->mesh->dim ||
           spoilt(r->wrong, r->line, "a mesh of dimension %u, but the cages have %zu",
                  (unsigned)dim, r->mesh->dim);
}

static bool read_vertices(lines *r)
{
    uint32_t n;
    if (!lines_next_count(r, 4e9, &n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        if (!lines_word(r) || !lines_vertex(r))
            return false;
        r->at = r->end; /* a third coordinate in the plane, and the reference */
    }
    return true;
}

/* A section of elements. `kind` is VTK's number for them, with the same order of nodes; only the
 * last two nodes of quadratic tetrahedra may be exchanged. If VTK's order is different, it is a
 * kind about which nothing is proved. */
typedef struct section {
    const char *name;
    int kind;
    size_t n_nodes;
} section;

static const section sections[] = {{"Dimension", 0, 0},
                                   {"Vertices", 0, 0},
                                   {"Triangles", ELEMENT_TRIANGLE, 3},
                                   {"Tetrahedra", ELEMENT_TETRAHEDRON, 4},
                                   {"Quadrilaterals", ELEMENT_QUADRILATERAL, 4},
                                   {"Hexahedra", ELEMENT_HEXAHEDRON, 8},
                                   {"Prisms", ELEMENT_WEDGE, 6},
                                   {"Pyramids", ELEMENT_PYRAMID, 5},
                                   {"TrianglesP2", ELEMENT_TRIANGLE_2, 6},
                                   {"QuadrilateralsQ2", ELEMENT_QUADRILATERAL_9, 9},
                                   {"TetrahedraP2", ELEMENT_TETRAHEDRON_2, 10},
                                   {"HexahedraQ2", ELEMENT_LAGRANGE_HEXAHEDRON, 27},
                                   {"PrismsP2", ELEMENT_LAGRANGE_WEDGE, 18},
                                   {"PyramidsP2", ELEMENT_LAGRANGE_PYRAMID, 14}};
enum { DIMENSION, VERTICES, ELEMENTS, N_SECTIONS = sizeof sections / sizeof *sections };

/* The squared distance of a node from the middle between two others. */
static double off_middle(const mesh_file *m, uint32_t node, uint32_t a, uint32_t b)
{
    double sum = 0;
    for (size_t k = 0; k < m->dim; k++) {
        const double *x = m->points + k;
        double d = x[m->dim * node] - 0.5 * x[m->dim * a] - 0.5 * x[m->dim * b];
        sum += d * d;
    }
    return sum;
}

/* Nodes 8 and 9 belong to the edges (1, 3) and (2, 3), or in exchanged order, as Gmsh writes them.
 * The closer assignment is taken. */
static void settle_tetrahedron(const mesh_file *m, uint32_t nodes[10])
{
    if (off_middle(m, nodes[9], nodes[1], nodes[3]) + off_middle(m, nodes[8], nodes[2], nodes[3]) <
        off_middle(m, nodes[8], nodes[1], nodes[3]) + off_middle(m, nodes[9], nodes[2], nodes[3])) {
        uint32_t eighth = nodes[8];
        nodes[8] = nodes[9];
        nodes[9] = eighth;
    }
}

/* Reads the reference of the last element, if there is one in this line. */
static void read_reference(lines *r)
{
    char *end;
    lines_skip_blanks(r);
    if (r->at == r->end)
        return;
    double region = strtod(r->at, &end);
    if (end > r->at && end <= r->end)
        mesh_set_region(r->mesh, r->mesh->n_elements - 1, region);
}

static bool read_elements(lines *r, const section *s)
{
    uint32_t n, nodes[ELEMENT_MOST_NODES];
    if (!lines_next_count(r, 4e9, &n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        for (size_t k = 0; k < s->n_nodes; k++) {
            if (!lines_next_count(r, (double)r->mesh->n_vertices + 1, &nodes[k]))
                return false;
            if (nodes[k]-- == 0)
                return spoilt(r->wrong, r->line, "there is no vertex 0; they are counted from 1");
        }
        if (s->kind == ELEMENT_TETRAHEDRON_2)
            settle_tetrahedron(r->mesh, nodes);
        lines_element(r, s->kind, s->n_nodes, nodes);
        read_reference(r);
        r->at = r->end;
    }
    return true;
}

/* Each section may be given once. */
static bool read_section(lines *r, bool seen[N_SECTIONS])
{
    size_t which = 0;
    while (which < N_SECTIONS && !lines_take(r, sections[which].name))
        which++;
    if (which == N_SECTIONS) { /* another section, or a number inside one */
        r->at += strcspn(r->at, " \t\r\n");
        return true;
    }
    if (seen[which])
        return spoilt(r->wrong, r->line, "a second section %s; a mesh has one",
                      sections[which].name);
    seen[which] = true;
    if (which >= ELEMENTS && !seen[VERTICES])
        return spoilt(r->wrong, r->line, "the section %s comes before Vertices",
                      sections[which].name);
    return which == DIMENSION  ? read_dimension(r)
           : which == VERTICES ? read_vertices(r)
                               : read_elements(r, &sections[which]);
}

/* Moves to the next section. False at the end of the file. */
static bool find_section(lines *r)
{
    for (;;) {
        lines_skip_blanks(r);
        if (r->at < r->end && is_letter(*r->at))
            return true;
        if (r->at < r->end)
            r->at += strcspn(r->at, " \t\r\n#");
        else if (!lines_next(r))
            return false;
    }
}

bool mesh_read_medit(lines *r)
{
    bool seen[N_SECTIONS] = {false};
    while (find_section(r)) {
        if (lines_take(r, "End"))
            return true;
        if (!read_section(r, seen))
            return false;
    }
    return true;
}
