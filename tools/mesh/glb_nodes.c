/* Finds how the nodes of a glTF scene place its meshes.
 *
 * Khronos Group, glTF 2.0 Specification, 2021: section 3.5.3 (transformations), 3.7.3 (skins: joints
 * move a skinned mesh, and its node does not). */
#include "mesh/glb.h"

#include "base/allocate.h"
#include "base/json_in.h"
#include "mesh/affine_map.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct node {
    const json_item *json;
    size_t parent;      /* or SIZE_MAX */
    size_t below;       /* during the search for parents: the node that asked */
    double matrix[12];  /* its own matrix; once `placed`, composed with those of all nodes above
                           it */
    bool placed, asked; /* asked: on the way up */
} node;

typedef struct scene {
    size_t n, n_meshes;
    node *nodes;
    size_t *users;          /* of each mesh: the first node that draws it, or SIZE_MAX */
    double (*matrices)[12]; /* of each mesh that is drawn */
} scene;

static const char *name_of(char out[32], const node *x)
{
    const char *name = json_string_of(json_get(x->json, "name"));
    return quoted(out, name != NULL ? name : "");
}

/* ---------------------------------------------------------------- matrices */

/* Reads a list of n numbers of a node. Without the list `values` stay as they are. */
static bool take_numbers(const json_item *json, size_t index, const char *name, size_t n,
                         double *values, problem *wrong)
{
    const json_item *list = json_get(json, name);
    char where[40];
    snprintf(where, sizeof where, "nodes[%zu].%s", index, name);
    return list == NULL || json_reals(list, where, n, values, wrong);
}

/* Reads a matrix, which is stored by columns. Its last row must be 0 0 0 1. */
static bool read_matrix(node *x, size_t index, problem *wrong)
{
    double m[16] = {0};
    if (!take_numbers(x->json, index, "matrix", 16, m, wrong))
        return false;
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        return spoilt(wrong, 0, "nodes[%zu].matrix has a last row that is not 0 0 0 1", index);
    for (size_t i = 0; i < 12; i++)
        x->matrix[i] = m[i % 4 * 4 + i / 4];
    return true;
}

/* Reads a transformation in parts: first a scale, then a quaternion, then a translation. */
static bool read_parts(node *x, size_t index, problem *wrong)
{
    double move[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    if (!take_numbers(x->json, index, "translation", 3, move, wrong) ||
        !take_numbers(x->json, index, "rotation", 4, q, wrong) ||
        !take_numbers(x->json, index, "scale", 3, scale, wrong))
        return false;
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0 && isfinite(length)))
        return spoilt(wrong, 0, "nodes[%zu].rotation is not a rotation", index);
    double i = q[0] / length, j = q[1] / length, k = q[2] / length, r = q[3] / length;
    const double turn[9] = {
        1 - 2 * (j * j + k * k), 2 * (i * j - k * r),     2 * (i * k + j * r),
        2 * (i * j + k * r),     1 - 2 * (i * i + k * k), 2 * (j * k - i * r),
        2 * (i * k - j * r),     2 * (j * k + i * r),     1 - 2 * (i * i + j * j)};
    for (size_t row = 0; row < 3; row++) {
        for (size_t column = 0; column < 3; column++)
            x->matrix[4 * row + column] = turn[3 * row + column] * scale[column];
        x->matrix[4 * row + 3] = move[row];
    }
    return true;
}

/* ------------------------------------------------------------------- scene */

static bool read_nodes(scene *s, const json_item *json, problem *wrong)
{
    size_t i = 0;
    s->n = json_size(json);
    s->nodes = need(s->n, sizeof *s->nodes);
    for (const json_item *item = json_first(json); item != NULL; item = json_next(item)) {
        node *x = &s->nodes[i];
        *x = (node){.json = item, .parent = SIZE_MAX};
        if (!(json_get(item, "matrix") != NULL ? read_matrix : read_parts)(x, i++, wrong))
            return false;
    }
    for (i = 0; i < s->n; i++) {
        const json_item *child = json_first(json_get(s->nodes[i].json, "children"));
        for (; child != NULL; child = json_next(child)) {
            uint32_t index;
            if (!json_index(child, "children", "glTF node", s->n, &index, wrong))
                return false;
            if (s->nodes[index].parent != SIZE_MAX)
                return spoilt(wrong, 0, "nodes[%u] is a child twice", (unsigned)index);
            s->nodes[index].parent = i;
        }
    }
    return true;
}

/* Composes the matrix of a node with those above it: goes up to a placed node, and down again. */
static bool place(scene *s, size_t index, problem *wrong)
{
    size_t at = index, below = SIZE_MAX;
    node *n = s->nodes;
    while (!n[at].placed && n[at].parent != SIZE_MAX) {
        if (n[at].asked)
            return spoilt(wrong, 0, "nodes[%zu] is among its own children", at);
        n[at].asked = true;
        n[at].below = below;
        below = at;
        at = n[at].parent;
    }
    n[at].placed = true;
    for (; below != SIZE_MAX; at = below, below = n[below].below) {
        double own[12];
        memcpy(own, n[below].matrix, sizeof own);
        affine_compose(n[below].matrix, n[at].matrix, own);
        n[below].placed = true;
    }
    return true;
}

/* Finds how a node places its mesh. It does not move a mesh that has joints. */
static bool place_mesh(scene *s, size_t index, double out[12], problem *wrong)
{
    const node *x = &s->nodes[index];
    double back[12];
    char shown[32];
    if (!place(s, index, wrong))
        return false;
    if (json_get(json_get(x->json, "extensions"), "EXT_mesh_gpu_instancing") != NULL)
        return spoilt(wrong, 0,
                      "nodes[%zu] ('%s') stands for many copies of its mesh; make them nodes with "
                      "meshes of their own",
                      index, name_of(shown, x));
    memcpy(out, x->matrix, sizeof x->matrix);
    if (json_get(x->json, "skin") != NULL)
        affine_identity(out);
    return affine_invert(back, out) ||
           spoilt(wrong, 0,
                  "nodes[%zu] ('%s') flattens its mesh, so there is no way back from the scene to "
                  "the file; give it, and what is above it, a scale without zeros",
                  index, name_of(shown, x));
}

/* ------------------------------------------------------------------ meshes */

static bool is_same(const double a[12], const double b[12])
{
    for (size_t k = 0; k < 12; k++)
        if (a[k] != b[k])
            return false;
    return true;
}

/* Places all meshes. Several nodes that draw one mesh must place it alike. */
static bool place_meshes(scene *s, problem *wrong)
{
    for (size_t i = 0; i < s->n; i++) {
        const json_item *mesh = json_get(s->nodes[i].json, "mesh");
        uint32_t which;
        double matrix[12];
        char a[32], b[32];
        if (mesh == NULL)
            continue;
        if (!json_index(mesh, "mesh", "glTF mesh", s->n_meshes, &which, wrong) ||
            !place_mesh(s, i, matrix, wrong))
            return false;
        size_t first = s->users[which];
        if (first != SIZE_MAX && !is_same(s->matrices[which], matrix))
            return spoilt(wrong, 0,
                          "nodes[%zu] ('%s') and nodes[%zu] ('%s') place meshes[%u] differently; "
                          "give each a mesh of its own (Blender: Object > Relations > Make Single "
                          "User)",
                          first, name_of(a, &s->nodes[first]), i, name_of(b, &s->nodes[i]),
                          (unsigned)which);
        s->users[which] = first == SIZE_MAX ? i : first;
        memcpy(s->matrices[which], matrix, sizeof matrix);
    }
    return true;
}

/* Places the positions of each mesh that is drawn. Two meshes may share positions. */
static bool place_sets(const glb *g, const scene *s, double (*out)[12], problem *wrong)
{
    size_t *seen = need(g->n_sets, sizeof *seen); /* a mesh's number, from 1 */
    bool good = true;
    for (size_t i = 0; i < g->n_primitives && good; i++) {
        size_t mesh = g->primitives[i].mesh;
        const json_item *attributes = json_get(g->primitives[i].json, "attributes");
        size_t set = g->set_of[(size_t)json_get(attributes, "POSITION")->number];
        if (s->users[mesh] == SIZE_MAX)
            continue;
        if (seen[set] > 0 && !is_same(out[set], s->matrices[mesh]))
            good =
                spoilt(wrong, 0,
                       "meshes[%zu] and meshes[%zu] have the same positions, but nodes place them "
                       "differently; give each its own",
                       seen[set] - 1, mesh);
        memcpy(out[set], s->matrices[mesh], sizeof *out);
        seen[set] = mesh + 1;
    }
    free(seen);
    return good;
}

double (*glb_find_places(const glb *g, problem *wrong))[12]
{
    double(*out)[12] = need(g->n_sets, sizeof *out);
    scene s = {.n_meshes = g->n_meshes,
               .users = need(g->n_meshes, sizeof *s.users),
               .matrices = need(g->n_meshes, sizeof *s.matrices)};
    for (size_t i = 0; i < g->n_meshes; i++)
        s.users[i] = SIZE_MAX;
    for (size_t i = 0; i < g->n_sets; i++)
        affine_identity(out[i]);
    bool good = read_nodes(&s, json_get(g->json, "nodes"), wrong) && place_meshes(&s, wrong) &&
                place_sets(g, &s, out, wrong);
    free(s.nodes);
    free(s.users);
    free(s.matrices);
    if (!good)
        free(out);
    return good ? out : NULL;
}

bool glb_has_skins(const glb *g)
{
    const json_item *x = json_first(json_get(g->json, "nodes"));
    for (; x != NULL; x = json_next(x))
        if (json_get(x, "skin") != NULL && json_get(x, "mesh") != NULL)
            return true;
    return false;
}

bool glb_has_animations(const glb *g)
{
    const json_item *animation = json_first(json_get(g->json, "animations"));
    for (; animation != NULL; animation = json_next(animation)) {
        const json_item *channel = json_first(json_get(animation, "channels"));
        for (; channel != NULL; channel = json_next(channel)) {
            const char *path = json_string_of(json_get(json_get(channel, "target"), "path"));
            if (path != NULL && strcmp(path, "weights") != 0)
                return true;
        }
    }
    return false;
}
