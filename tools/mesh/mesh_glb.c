/* The meshes of a binary glTF file, as one: the vertices as they stand in the file, the triangles of
 * one primitive behind another. Normals and what else a vertex has are carried along as they are. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "base/bytes.h"
#include "base/json_in.h"
#include "mesh/glb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIANGLES = 4, STRIP, FAN };

bool mesh_is_glb(const char *text, size_t n)
{
    return n >= 4 && memcmp(text, "glTF", 4) == 0;
}

static bool read_set(mesh_file *m, const char *text, const glb_positions *set, problem *wrong)
{
    for (size_t i = 0; i < set->items.n; i++) {
        size_t at = set->items.at + i * set->items.stride, k = m->n_vertices;
        mesh_make_room(m);
        m->n_vertices++;
        m->spans[2 * k] = at;
        m->spans[2 * k + 1] = at + 4 * m->dim;
        for (size_t d = 0; d < m->dim; d++) {
            double value = (double)little_endian_float(text + at + 4 * d);
            m->points[m->dim * k + d] = value;
            if (!isfinite(value))
                return spoilt(wrong, 0, "byte %zu: vertex %zu of accessors[%zu] is not finite", at,
                              i, set->accessor);
        }
    }
    return true;
}

static bool read_vertices(mesh_file *m, const glb *g, problem *wrong)
{
    for (size_t s = 0; s < g->n_sets; s++)
        if (!read_set(m, g->text, &g->sets[s], wrong))
            return false;
    return true;
}

/* The corners of a primitive: those of its positions one by one, or as its indices say. */
typedef struct corner_list {
    const glb *g;
    const glb_positions *set;
    glb_items indices; /* size 0: none */
    size_t accessor, n;
} corner_list;

static bool corner(lines *r, const corner_list *list, size_t i)
{
    const glb_items *indices = &list->indices;
    size_t at = indices->at + i * indices->stride;
    size_t vertex = indices->size == 0 ? i : little_endian(list->g->text + at, indices->size);
    if (vertex >= list->set->items.n)
        return spoilt(r->wrong, 0, "byte %zu: index %zu of accessors[%zu] is %zu; there are %zu",
                      at, i, list->accessor, vertex, list->set->items.n);
    lines_corner(r, (uint32_t)(list->set->first + vertex));
    return true;
}

static bool triangle(lines *r, const corner_list *list, size_t a, size_t b, size_t c)
{
    lines_begin_face(r);
    return corner(r, list, a) && corner(r, list, b) && corner(r, list, c);
}

/* The triangles of a primitive, by its mode. There cannot be more in all than the file has bytes
 * unless it names the same ones again and again. */
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

/* Points and lines have vertices, but no triangles. */
static bool read_primitive(lines *r, const glb *g, const cJSON *primitive)
{
    const cJSON *mode = json_get(primitive, "mode"), *indices = json_get(primitive, "indices");
    int kind = mode == NULL ? TRIANGLES : mode->valueint;
    corner_list list = {.g = g};
    glb_items positions;
    if (kind < TRIANGLES || kind > FAN)
        return true;
    if (!glb_find_items(g, json_get(json_get(primitive, "attributes"), "POSITION"), true,
                        &list.accessor, &positions, r->wrong))
        return false;
    list.set = &g->sets[g->set_of[list.accessor]];
    list.n = positions.n;
    if (indices != NULL) {
        if (!glb_find_items(g, indices, false, &list.accessor, &list.indices, r->wrong))
            return false;
        list.n = list.indices.n;
    }
    return read_corners(r, &list, kind);
}

static bool read_faces(lines *r, const glb *g)
{
    const cJSON *mesh, *primitive;
    cJSON_ArrayForEach(mesh, json_get(g->json, "meshes"))
    {
        cJSON_ArrayForEach(primitive, json_get(mesh, "primitives"))
        {
            if (!read_primitive(r, g, primitive))
                return false;
        }
    }
    return true;
}

/* ------------------------------------------------------------------- nodes */

static bool is_list(const cJSON *list, size_t n, const double *values)
{
    const cJSON *item;
    size_t i = 0;
    cJSON_ArrayForEach(item, list)
    {
        if (i == n || !cJSON_IsNumber(item) || item->valuedouble != values[i])
            return false;
        i++;
    }
    return list == NULL || i == n;
}

static bool is_moved(const cJSON *node)
{
    static const double one[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const double none[] = {0, 0, 0, 1}, scale[] = {1, 1, 1};
    return !is_list(json_get(node, "matrix"), 16, one) ||
           !is_list(json_get(node, "translation"), 3, none) ||
           !is_list(json_get(node, "rotation"), 4, none) ||
           !is_list(json_get(node, "scale"), 3, scale) ||
           json_get(json_get(node, "extensions"), "EXT_mesh_gpu_instancing") != NULL;
}

/* The node above each, or SIZE_MAX. */
static size_t *find_parents(size_t n, const cJSON *const *nodes)
{
    size_t *parents = need(n, sizeof *parents);
    const cJSON *child;
    for (size_t i = 0; i < n; i++)
        parents[i] = SIZE_MAX;
    for (size_t i = 0; i < n; i++)
        cJSON_ArrayForEach(child, json_get(nodes[i], "children"))
        {
            if (cJSON_IsNumber(child) && child->valuedouble >= 0 && child->valuedouble < (double)n)
                parents[(size_t)child->valuedouble] = i;
        }
    return parents;
}

/* Nodes above a mesh must leave it where it is: positions are taken, and written, as they stand. */
static bool check_nodes(const glb *g, problem *wrong)
{
    size_t n = (size_t)cJSON_GetArraySize(json_get(g->json, "nodes")), i = 0;
    const cJSON **nodes = need(n, sizeof(cJSON *)), *node;
    cJSON_ArrayForEach(node, json_get(g->json, "nodes")) nodes[i++] = node;
    size_t *parents = find_parents(n, nodes);
    bool *seen = need(n, sizeof *seen), good = true;
    for (i = 0; i < n; i++)
        for (size_t k = i; good && json_get(nodes[i], "mesh") && k < n && !seen[k];
             k = parents[k]) {
            const char *name = cJSON_GetStringValue(json_get(nodes[k], "name"));
            char shown[32];
            seen[k] = true;
            if (is_moved(nodes[k]))
                good = spoilt(wrong, 0,
                              "nodes[%zu] ('%s') moves, turns or scales its mesh; apply that to "
                              "the vertices first (Blender: Ctrl+A)",
                              k, quoted(shown, name != NULL ? name : ""));
        }
    free(nodes);
    free(parents);
    free(seen);
    return good;
}

bool mesh_read_glb(lines *r)
{
    mesh_file *m = r->mesh;
    glb g;
    m->form = MESH_LITTLE;
    m->floats = true;
    r->line = 0;
    bool good = glb_open(&g, m->text, m->n_text, r->wrong) && check_nodes(&g, r->wrong) &&
                read_vertices(m, &g, r->wrong) && read_faces(r, &g);
    glb_close(&g);
    return good;
}
