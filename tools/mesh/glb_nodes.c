/* Khronos Group, glTF 2.0 Specification, 2021: section 3.5.3 (transformations). */
#include "mesh/glb_nodes.h"

#include "base/allocate.h"
#include "base/json_in.h"
#include "mesh/affine_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *glb_node_name(char out[32], const glb_node *node)
{
    const char *name = json_string_of(json_get(node->json, "name"));
    return quoted(out, name != NULL ? name : "");
}

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
static bool read_matrix(glb_node *x, size_t index, problem *wrong)
{
    double m[16] = {0};
    if (!take_numbers(x->json, index, "matrix", 16, m, wrong))
        return false;
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        return spoilt(wrong, 0, "nodes[%zu].matrix has a last row that is not 0 0 0 1", index);
    for (size_t i = 0; i < 12; i++)
        x->own[i] = m[i % 4 * 4 + i / 4];
    return true;
}

/* Reads a transformation in parts: first a scale, then a quaternion, then a translation. */
static bool read_parts(glb_node *x, size_t index, problem *wrong)
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
            x->own[4 * row + column] = turn[3 * row + column] * scale[column];
        x->own[4 * row + 3] = move[row];
    }
    return true;
}

static bool find_parents(glb_nodes *s, problem *wrong)
{
    for (size_t i = 0; i < s->n; i++) {
        const json_item *child = json_first(json_get(s->list[i].json, "children"));
        for (; child != NULL; child = json_next(child)) {
            uint32_t index;
            if (!json_index(child, "children", "glTF node", s->n, &index, wrong))
                return false;
            if (s->list[index].parent != SIZE_MAX)
                return spoilt(wrong, 0, "nodes[%u] is a child twice", (unsigned)index);
            s->list[index].parent = i;
        }
    }
    return true;
}

/* Orders the nodes from the roots down. Nodes of a cycle hang on no root. */
static bool find_order(glb_nodes *s, problem *wrong)
{
    size_t n = 0, unplaced = 0;
    bool *placed = need(s->n, sizeof *placed);
    for (size_t i = 0; i < s->n; i++)
        if (s->list[i].parent == SIZE_MAX)
            s->order[n++] = i;
    for (size_t k = 0; k < n; k++) {
        const json_item *child = json_first(json_get(s->list[s->order[k]].json, "children"));
        placed[s->order[k]] = true;
        for (; child != NULL; child = json_next(child))
            s->order[n++] = (size_t)child->number;
    }
    while (unplaced < s->n && placed[unplaced])
        unplaced++;
    free(placed);
    return n == s->n || spoilt(wrong, 0, "nodes[%zu] is among its own children", unplaced);
}

bool glb_nodes_read(glb_nodes *out, const glb *g, problem *wrong)
{
    const json_item *item = json_first(json_get(g->json, "nodes"));
    *out = (glb_nodes){.n = json_size(json_get(g->json, "nodes"))};
    out->list = need(out->n, sizeof *out->list);
    out->order = need(out->n, sizeof *out->order);
    for (size_t i = 0; item != NULL; item = json_next(item), i++) {
        glb_node *x = &out->list[i];
        *x = (glb_node){.json = item, .parent = SIZE_MAX};
        if (!(json_get(item, "matrix") != NULL ? read_matrix : read_parts)(x, i, wrong))
            return false;
    }
    if (!find_parents(out, wrong) || !find_order(out, wrong))
        return false;
    for (size_t k = 0; k < out->n; k++) {
        glb_node *x = &out->list[out->order[k]];
        if (x->parent == SIZE_MAX)
            memcpy(x->matrix, x->own, sizeof x->own);
        else
            affine_compose(x->matrix, out->list[x->parent].matrix, x->own);
    }
    return true;
}

void glb_nodes_free(glb_nodes *nodes)
{
    free(nodes->list);
    free(nodes->order);
    *nodes = (glb_nodes){0};
}
