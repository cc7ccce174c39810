/* Reads the meshes of a binary glTF file as one mesh: the vertices in the order of the file, and
 * the triangles of one primitive after another. Vertices are read where nodes place them in the
 * scene. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "base/bytes.h"
#include "base/json_in.h"
#include "mesh/affine_map.h"
#include "mesh/glb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIANGLES = 4, STRIP, FAN };

bool mesh_is_glb(const char *text, size_t n)
{
    return n >= 4 && memcmp(text, "glTF", 4) == 0;
}

/* Reads positions, which a node may move in space. */
static bool read_set(mesh_file *m, const char *text, const glb_positions *set,
                     const mesh_place *place, problem *wrong)
{
    for (size_t i = 0; i < set->items.n; i++) {
        size_t at = set->items.at + i * set->items.stride;
        mesh_make_room(m);
        double values[3], *point = m->points + m->dim * m->n_vertices++;
        for (size_t d = 0; d < m->dim; d++)
            values[d] = (double)little_endian_float(text + at + 4 * d);
        memcpy(point, values, m->dim * sizeof *point);
        if (place != NULL)
            affine_apply(point, place->out, values);
        for (size_t d = 0; d < m->dim; d++)
            if (!isfinite(point[d]))
                return spoilt(wrong, 0, "vertex %zu of accessors[%zu] is not finite", i,
                              set->accessor);
    }
    return true;
}

/* Adds the place of a set that its node moves. NULL: no node moves it. */
static const mesh_place *find_place(mesh_file *m, const glb *g, size_t s, const double matrix[12])
{
    if (affine_is_identity(matrix))
        return NULL;
    mesh_place *place = &m->places[m->n_places++];
    *place = (mesh_place){.first = g->sets[s].first, .n = g->sets[s].items.n};
    memcpy(place->out, matrix, sizeof place->out);
    affine_invert(place->in, matrix);
    return place;
}

static bool read_vertices(mesh_file *m, const glb *g, problem *wrong)
{
    double(*matrices)[12] = glb_find_places(g, wrong);
    bool good = matrices != NULL;
    m->places = need(g->n_sets, sizeof *m->places);
    for (size_t s = 0; good && s < g->n_sets; s++) {
        const mesh_place *place = find_place(m, g, s, matrices[s]);
        if (place != NULL && m->dim < 3)
            good = spoilt(wrong, 0,
                          "a node moves, turns or scales the mesh of accessors[%zu]; in the plane "
                          "apply that to the vertices first (Blender: Ctrl+A)",
                          g->sets[s].accessor);
        good = good && read_set(m, g->text, &g->sets[s], place, wrong);
    }
    free(matrices);
    return good;
}

/* The corners of a primitive: its positions one by one, or in the order of its indices. */
typedef struct corner_list {
    const glb *g;
    const glb_positions *set;
    glb_items indices; /* size 0: there are none */
    size_t accessor, n;
    bool mirrored; /* by its node */
} corner_list;

static bool corner(lines *r, const corner_list *list, size_t i)
{
    const glb_items *indices = &list->indices;
    size_t at = indices->at + i * indices->stride;
    size_t vertex = indices->size == 0 ? i : little_endian(list->g->text + at, indices->size);
    if (vertex >= list->set->items.n)
        return spoilt(r->wrong, 0, "index %zu of accessors[%zu] is %zu; there are %zu", i,
                      list->accessor, vertex, list->set->items.n);
    lines_corner(r, (uint32_t)(list->set->first + vertex));
    return true;
}

static bool triangle(lines *r, const corner_list *list, size_t a, size_t b, size_t c)
{
    lines_begin_face(r);
    return corner(r, list, a) && corner(r, list, list->mirrored ? c : b) &&
           corner(r, list, list->mirrored ? b : c);
}

/* Reads the triangles of a primitive by its mode. There cannot be more triangles than the file has
 * bytes, unless it repeats them again and again. */
static bool read_corners(lines *r, const corner_list *list, int mode)
{
    size_t n = list->n, n_triangles = mode == TRIANGLES ? n / 3 : n - 2;
    if (mode == TRIANGLES ? n % 3 != 0 : n < 3)
        return spoilt(r->wrong, 0, "a primitive of triangles has %zu corners", n);
    if (n_triangles > r->mesh->n_text - r->mesh->n_triangles)
        return spoilt(r->wrong, 0, "the primitives have more triangles than the file has bytes");
    bool good = true;
    for (size_t i = 0; i < n_triangles && good; i++)
        good = mode == TRIANGLES ? triangle(r, list, 3 * i, 3 * i + 1, 3 * i + 2)
               : mode == STRIP   ? triangle(r, list, i, i + 1 + i % 2, i + 2 - i % 2)
                                 : triangle(r, list, i + 1, i + 2, 0);
    return good;
}

static int by_first(const void *a, const void *b)
{
    const mesh_place *p = a, *q = b;
    return (p->first > q->first) - (p->first < q->first);
}

const mesh_place *glb_place(const mesh_file *m, size_t first)
{
    const mesh_place key = {.first = first};
    return m->n_places == 0 ? NULL
                            : bsearch(&key, m->places, m->n_places, sizeof *m->places, by_first);
}

static bool is_mirrored(const mesh_file *m, const glb_positions *set)
{
    const mesh_place *place = glb_place(m, set->first);
    return place != NULL && affine_determinant(place->out) < 0;
}

/* Primitives of points and lines have vertices, but no triangles. */
static bool read_primitive(lines *r, const glb *g, const json_item *primitive)
{
    const json_item *mode = json_get(primitive, "mode"), *indices = json_get(primitive, "indices");
    double kind = mode == NULL ? TRIANGLES : mode->number;
    corner_list list = {.g = g};
    glb_items positions;
    if (kind < TRIANGLES || kind > FAN)
        return true;
    if (!glb_find_items(g, json_get(json_get(primitive, "attributes"), "POSITION"), "POSITION",
                        GLB_THREE, &list.accessor, &positions, r->wrong))
        return false;
    list.set = &g->sets[g->set_of[list.accessor]];
    list.n = positions.n;
    list.mirrored = is_mirrored(r->mesh, list.set);
    if (indices != NULL) {
        if (!glb_find_items(g, indices, "indices", GLB_INDICES, &list.accessor, &list.indices,
                            r->wrong))
            return false;
        list.n = list.indices.n;
    }
    return read_corners(r, &list, (int)kind);
}

static bool read_faces(lines *r, const glb *g)
{
    for (size_t i = 0; i < g->n_primitives; i++)
        if (!read_primitive(r, g, g->primitives[i]))
            return false;
    return true;
}

/* Goes on with the scene in which each mesh has one place. */
static bool split(mesh_file *m, glb *g, problem *wrong)
{
    char *text;
    size_t n;
    if (!glb_split(g, &text, &n, &m->n_copies, wrong))
        return false;
    if (text == NULL)
        return true;
    m->text = m->own = text;
    m->n_text = n;
    glb_close(g);
    return glb_open(g, m->text, m->n_text, wrong);
}

bool mesh_read_glb(lines *r)
{
    mesh_file *m = r->mesh;
    glb g;
    m->form = MESH_LITTLE;
    m->floats = true;
    m->n_spans = 0;
    r->line = 0;
    bool good = glb_open(&g, m->text, m->n_text, r->wrong) && split(m, &g, r->wrong) &&
                glb_is_apart(&g, m->n_text, 0, NULL, r->wrong) && read_vertices(m, &g, r->wrong) &&
                read_faces(r, &g);
    glb_close(&g);
    return good;
}
