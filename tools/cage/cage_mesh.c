/* Takes the boundary of a mesh as a cage: of tetrahedra in space, or of triangles and larger faces in
 * the plane. A mesh of faces alone in space is a surface itself: cage_surface.c. */
#include "base/allocate.h"
#include "base/orientation.h"
#include "cage/cage_features.h"
#include "cage/cage_readers.h"
#include "mesh/element_kinds.h"
#include "mesh/mesh_boundary.h"
#include "mesh/mesh_file.h"

#include <stdlib.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

static size_t count_simplices(const mesh_file *m)
{
    return m->dim == 2 ? m->n_triangles : m->n_tetrahedra;
}

static const uint32_t *simplices_of(const mesh_file *m)
{
    return m->dim == 2 ? m->triangles : m->tetrahedra;
}

static size_t line_of_vertex(const mesh_file *m, uint32_t v)
{
    return m->form == MESH_TEXT ? line_of(m->text, m->text + m->spans[2 * m->n_spans * v]) : 0;
}

/* Adds a vertex of the mesh to the cage, and keeps its number. */
static void take_vertex(cage *c, const mesh_file *m, uint32_t v)
{
    c->mesh_vertices =
        grow(c->mesh_vertices, &c->room_mesh, c->n_mesh + 1, sizeof *c->mesh_vertices);
    c->mesh_vertices[c->n_mesh++] = v;
    cage_add_point(c, m->points + m->dim * v, 0);
}

/* Finds the lines of all vertices in one pass over the text. */
static void find_lines(cage *c, const mesh_file *m)
{
    size_t *lines = need(m->n_vertices, sizeof *lines), line = 1, at = 0, k = 0;
    for (size_t v = 0; v < m->n_vertices && m->form == MESH_TEXT; v++) {
        for (; at < m->spans[2 * m->n_spans * v]; at++)
            line += m->text[at] == '\n';
        lines[v] = line;
    }
    for (size_t i = 0; i < c->n; i++)
        c->lines[i] = lines[c->mesh_vertices[k++]];
    for (size_t f = 0; f < c->n_features; k += c->features[f++].n)
        c->features[f].line = lines[c->mesh_vertices[k]];
    free(lines);
}

static void keep_simplices(cage *c, const mesh_file *m)
{
    size_t size = count_simplices(m) * (m->dim + 1) * sizeof *c->simplices;
    c->n_mesh_vertices = m->n_vertices;
    c->n_simplices = count_simplices(m);
    c->simplices = need(c->n_simplices, (m->dim + 1) * sizeof *c->simplices);
    memcpy(c->simplices, simplices_of(m), size);
}

static int simplex_sign(const mesh_file *m, size_t i)
{
    const uint32_t *at = simplices_of(m) + (m->dim + 1) * i;
    const double *x = m->points;
    return m->dim == 2 ? orientation(x + 2 * at[0], x + 2 * at[1], x + 2 * at[2])
                       : orientation_3d(x + 3 * at[0], x + 3 * at[1], x + 3 * at[2], x + 3 * at[3]);
}

/* ------------------------------------------------------------------------- space */

/* Takes a face as seen from outside, the smallest vertex first. */
static void take_face(uint32_t *out, const uint32_t *facet, const uint32_t *place, bool turned)
{
    size_t least = 0;
    for (size_t k = 1; k < 3; k++)
        if (facet[k] < facet[least])
            least = k;
    for (size_t k = 0; k < 3; k++)
        out[k] = place[facet[(least + (turned ? 3 - k : k)) % 3]];
}

/* Faces have the library's order: sorted by their vertices. So two meshes with the same boundary
 * correspond, however they list their elements. */
static void take_facets(cage *c, const mesh_file *m, const mesh_boundary *b)
{
    bool *on = mesh_boundary_vertices(b, m->n_vertices);
    uint32_t *place = need(m->n_vertices, sizeof *place);
    for (uint32_t v = 0; v < m->n_vertices; v++)
        if (on[v]) {
            place[v] = (uint32_t)c->n;
            take_vertex(c, m, v);
        }
    c->n_facets = b->n;
    c->facets = need(b->n, 3 * sizeof *c->facets);
    c->facet_lines = need(b->n, sizeof *c->facet_lines);
    for (size_t i = 0; i < b->n; i++) {
        bool turned = simplex_sign(m, b->elements[i]) < 0;
        take_face(c->facets + 3 * i, b->facets + 3 * i, place, turned);
    }
    free(place);
    free(on);
}

/* ------------------------------------------------------------------------- plane */

/* Links the vertices along the boundary, with the mesh on the left. Others get NONE. */
static bool link_edges(const mesh_file *m, const mesh_boundary *b, uint32_t *next, problem *wrong)
{
    for (size_t v = 0; v < m->n_vertices; v++)
        next[v] = NONE;
    for (size_t i = 0; i < b->n; i++) {
        bool turned = simplex_sign(m, b->elements[i]) < 0;
        uint32_t from = b->facets[2 * i + turned], to = b->facets[2 * i + !turned];
        if (next[from] != NONE)
            return spoilt(
                wrong, line_of_vertex(m, from),
                "the boundary of the mesh passes vertex %u (from 0) twice; an outline and "
                "its holes must not touch",
                (unsigned)from);
        next[from] = to;
    }
    return true;
}

/* True if a is left of b, or straight below it, or at the same place. */
static bool is_before(const double *a, const double *b)
{
    return a[0] < b[0] || (!(a[0] > b[0]) && a[1] <= b[1]);
}

/* The orientation of a ring: the turn at the lowest of its leftmost vertices. */
static int ring_sign(const mesh_file *m, const uint32_t *next, uint32_t first)
{
    const double *x = m->points;
    uint32_t least = first, before = first, v = first;
    do {
        uint32_t w = next[v];
        if (is_before(x + 2 * w, x + 2 * least)) {
            least = w;
            before = v;
        }
        v = w;
    } while (v != first);
    return orientation(x + 2 * before, x + 2 * least, x + 2 * next[least]);
}

/* Checks that every ring closes, and marks the first vertex of each. */
static bool find_rings(const mesh_file *m, const uint32_t *next, bool *first, problem *wrong)
{
    bool *seen = need(m->n_vertices, sizeof *seen), good = true;
    for (uint32_t v = 0; v < m->n_vertices && good; v++) {
        if (next[v] == NONE || seen[v])
            continue;
        uint32_t w = v;
        while (w != NONE && !seen[w]) {
            seen[w] = true;
            w = next[w];
        }
        first[v] = true;
        if (next[v] == v)
            good = spoilt(wrong, line_of_vertex(m, v), "a face has vertex %u (from 0) twice",
                          (unsigned)v);
        else
            good = w == v || spoilt(wrong, line_of_vertex(m, v),
                                    "the boundary of the mesh is not closed at vertex %u (from 0): "
                                    "triangles overlap there",
                                    (unsigned)v);
    }
    free(seen);
    return good;
}

static void take_ring(cage *c, const mesh_file *m, const uint32_t *next, uint32_t first)
{
    uint32_t v = first;
    do {
        take_vertex(c, m, v);
        v = next[v];
    } while (v != first);
}

/* Takes the outline, which turns to the left, then the holes. */
static bool take_rings(cage *c, const mesh_file *m, const uint32_t *next, const bool *first,
                       problem *wrong)
{
    size_t n_outlines = 0, n_holes = 0;
    for (int holes = 0; holes < 2; holes++)
        for (uint32_t v = 0; v < m->n_vertices; v++) {
            if (!first[v] || (ring_sign(m, next, v) <= 0) != (holes == 1))
                continue;
            size_t begin = c->n;
            take_ring(c, m, next, v);
            n_outlines += holes == 0;
            if (holes == 1)
                cage_add_feature(c, ICC_FEATURE_HOLE, (int64_t)++n_holes, begin);
        }
    return n_outlines == 1 || spoilt(wrong, 0, "the mesh has %zu parts; a cage is one", n_outlines);
}

static bool take_outline(cage *c, const mesh_file *m, const mesh_boundary *b, problem *wrong)
{
    uint32_t *next = need(m->n_vertices, sizeof *next);
    bool *first = need(m->n_vertices, sizeof *first);
    bool good = link_edges(m, b, next, wrong) && find_rings(m, next, first, wrong) &&
                take_rings(c, m, next, first, wrong);
    free(first);
    free(next);
    return good;
}

/* ---------------------------------------------------------------------- reading */

static bool take_boundary(cage *c, const mesh_file *m, problem *wrong)
{
    mesh_boundary b;
    mesh_boundary_find(&b, m->dim, count_simplices(m), simplices_of(m));
    bool good =
        b.n_shared == 0 || spoilt(wrong, 0,
                                  m->dim == 2 ? "%zu edges belong to more than two triangles"
                                              : "%zu faces belong to more than two tetrahedra",
                                  b.n_shared);
    if (good && m->dim == 3)
        take_facets(c, m, &b);
    else if (good)
        good = take_outline(c, m, &b, wrong);
    mesh_boundary_free(&b);
    return good;
}

/* True if the mesh has the same elements as the mesh of `like`. Then their boundaries correspond,
 * wherever the vertices are. */
static bool is_like(const mesh_file *m, const cage *like)
{
    return like != NULL && like->n_simplices > 0 && like->dim == m->dim &&
           like->n_mesh_vertices == m->n_vertices && like->n_simplices == count_simplices(m) &&
           memcmp(like->simplices, simplices_of(m),
                  like->n_simplices * (m->dim + 1) * sizeof *like->simplices) == 0;
}

static void take_like(cage *c, const mesh_file *m, const cage *like)
{
    size_t k = 0;
    while (k < like->n)
        take_vertex(c, m, like->mesh_vertices[k++]);
    for (size_t f = 0; f < like->n_features; f++) {
        size_t begin = c->n;
        for (size_t i = 0; i < like->features[f].n; i++)
            take_vertex(c, m, like->mesh_vertices[k++]);
        cage_add_feature(c, like->features[f].kind, like->features[f].number, begin);
    }
    if (like->n_facets == 0)
        return;
    c->n_facets = like->n_facets;
    c->facets = need(like->n_facets, like->dim * sizeof *c->facets);
    c->facet_lines = need(like->n_facets, sizeof *c->facet_lines);
    memcpy(c->facets, like->facets, like->n_facets * like->dim * sizeof *c->facets);
}

/* Refuses elements whose boundary cannot be a cage. */
static bool check_kinds(const mesh_file *m, problem *wrong)
{
    for (size_t i = 0; i < m->n_elements; i++) {
        const element_kind *k = element_kind_find(m->kinds[i]);
        bool known = m->dim == 3 ? k->dim < 3 || k->type == ELEMENT_TETRAHEDRON
                                 : k->dim != 2 || k->shape == SHAPE_POLYGON ||
                                       (k->degree == 1 && k->shape != SHAPE_OTHER);
        if (!known)
            return spoilt(
                wrong, 0, "the mesh has %s; a cage is the boundary of %s, or a surface of its own",
                k->many, m->dim == 3 ? "tetrahedra" : "triangles and polygons in the plane");
    }
    return true;
}

bool cage_take_mesh(cage *out, const struct mesh_file *m, const cage *like, problem *wrong)
{
    out->dim = m->dim;
    if (!check_kinds(m, wrong))
        return false;
    if (is_like(m, like))
        take_like(out, m, like);
    else if (!take_boundary(out, m, wrong))
        return false;
    keep_simplices(out, m);
    find_lines(out, m);
    return true;
}
