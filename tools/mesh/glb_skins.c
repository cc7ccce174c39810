/* Reads the skins of a glTF scene and finds out if they stand as they were bound.
 *
 * Khronos Group, glTF 2.0 Specification, 2021: section 3.7.3 (skins). */
#include "base/allocate.h"
#include "base/bytes.h"
#include "base/json_in.h"
#include "mesh/affine_map.h"
#include "mesh/glb_nodes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Matrices are one if they move no corner of the mesh's box apart by more than this part of its
 * diagonal. Products of floats agree to about 1e-6, and poses differ by more than 1e-2. */
static const double SAME_PLACE = 1e-5;

const glb_skin *glb_skin_of(const glb_skin *skins, const glb_node *node)
{
    const json_item *skin = json_get(node->json, "skin");
    return skin != NULL && json_get(node->json, "mesh") != NULL ? skins + (size_t)skin->number
                                                                : NULL;
}

/* -------------------------------------------------------------------- read */

static bool read_joints(glb_skin *out, const json_item *json, size_t index, size_t n_nodes,
                        problem *wrong)
{
    char where[48];
    snprintf(where, sizeof where, "skins[%zu].joints", index);
    const json_item *joints = json_get(json, "joints");
    if (!json_list(joints, where, &out->n, wrong))
        return false;
    out->joints = need(out->n, sizeof *out->joints);
    size_t k = 0;
    for (const json_item *joint = json_first(joints); joint != NULL; joint = json_next(joint))
        if (!json_index(joint, where, "glTF node", n_nodes, &out->joints[k++], wrong))
            return false;
    return out->n > 0 || spoilt(wrong, 0, "skins[%zu] has no joints", index);
}

static bool read_skin(glb_skin *out, const glb *g, const json_item *json, size_t index,
                      size_t n_nodes, problem *wrong)
{
    char where[48];
    const json_item *inverses = json_get(json, "inverseBindMatrices");
    affine_identity(out->bind);
    if (!read_joints(out, json, index, n_nodes, wrong))
        return false;
    if (inverses == NULL)
        return true;
    snprintf(where, sizeof where, "skins[%zu].inverseBindMatrices", index);
    if (!glb_find_items(g, inverses, where, GLB_MATRIX, &out->accessor, &out->inverses, wrong))
        return false;
    return out->inverses.n >= out->n ||
           spoilt(wrong, 0, "skins[%zu] has %zu joints, but %zu inverse bind matrices", index,
                  out->n, out->inverses.n);
}

static bool check_users(const glb_nodes *nodes, size_t n_skins, problem *wrong)
{
    for (size_t i = 0; i < nodes->n; i++) {
        char where[48];
        uint32_t index;
        const json_item *skin = json_get(nodes->list[i].json, "skin");
        snprintf(where, sizeof where, "nodes[%zu].skin", i);
        if (skin != NULL && !json_index(skin, where, "glTF skin", n_skins, &index, wrong))
            return false;
    }
    return true;
}

/* -------------------------------------------------------------------- bind */

/* Adds the positions that a node draws to a box: its lower corner, and its upper one. */
static void widen(double box[6], const glb *g, const glb_node *node)
{
    const json_item *mesh = json_get(node->json, "mesh");
    bool good =
        json_is(mesh, JSON_NUMBER) && mesh->number >= 0 && mesh->number < (double)g->n_meshes;
    size_t which = good ? (size_t)mesh->number : g->n_meshes;
    for (size_t i = g->starts[which]; good && i < g->starts[which + 1]; i++) {
        const glb_items *items = &g->sets[glb_set_of(g, g->primitives[i])].items;
        for (size_t k = 0; k < 3 * items->n; k++) {
            size_t at = items->at + k / 3 * items->stride + 4 * (k % 3);
            double x = (double)little_endian_float(g->text + at);
            box[k % 3] = fmin(box[k % 3], x);
            box[3 + k % 3] = fmax(box[3 + k % 3], x);
        }
    }
}

static bool is_one_place(const double box[6], const double a[12], const double b[12])
{
    double lower[3], upper[3], p[3], q[3];
    affine_apply(lower, a, box);
    affine_apply(upper, a, box + 3);
    for (size_t k = 0; k < 3; k++)
        upper[k] -= lower[k];
    for (size_t i = 0; i < 8; i++) {
        const double corner[3] = {box[i & 1 ? 3 : 0], box[i & 2 ? 4 : 1], box[i & 4 ? 5 : 2]};
        affine_apply(p, a, corner);
        affine_apply(q, b, corner);
        for (size_t k = 0; k < 3; k++)
            p[k] -= q[k];
        if (!(affine_length(p) <= SAME_PLACE * affine_length(upper)))
            return false;
    }
    return true;
}

/* The matrix by which joint k moves vertices to the scene. False if it is not affine. */
static bool find_product(const glb_skin *skin, const glb *g, const glb_nodes *nodes, size_t k,
                         double out[12])
{
    double inverse[12];
    const char *at = g->text + skin->inverses.at + k * skin->inverses.stride;
    affine_identity(inverse);
    for (size_t i = 0; skin->inverses.size > 0 && i < 16; i++) {
        double value = (double)little_endian_float(at + 4 * i);
        if (i % 4 == 3 ? value != (i == 15) : !isfinite(value))
            return false;
        if (i % 4 < 3)
            inverse[i % 4 * 4 + i / 4] = value;
    }
    affine_compose(out, nodes->list[skin->joints[k]].matrix, inverse);
    return true;
}

/* Finds the matrix of all joints. NULL, or why there is none, or why joints cannot be moved. */
static const char *find_bind(glb_skin *skin, const glb *g, const glb_nodes *nodes,
                             const double box[6])
{
    double first[12], other[12], identity[12];
    const char *stays = skin->inverses.size == 0 ? "it has no inverse bind matrices" : NULL;
    affine_identity(identity);
    for (size_t k = 0; k < skin->n; k++) {
        const glb_node *joint = &nodes->list[skin->joints[k]];
        if (!find_product(skin, g, nodes, k, k == 0 ? first : other))
            return "its inverse bind matrices are not affine";
        if (k > 0 && !is_one_place(box, first, other))
            return stays != NULL ? stays
                                 : "it does not stand as it was bound; save it in its rest pose";
        if (!affine_invert(other, joint->matrix))
            return "a joint has no inverse";
        if (json_get(joint->json, "mesh") != NULL)
            stays = "one of its joints draws a mesh";
    }
    memcpy(skin->bind, is_one_place(box, identity, first) ? identity : first, sizeof first);
    return stays;
}

bool glb_skins_read(glb_skin **out, size_t *n, const glb *g, const glb_nodes *nodes, problem *wrong)
{
    const json_item *json = json_get(g->json, "skins");
    size_t i = 0;
    bool good = json_list(json, "skins", n, wrong);
    glb_skin *skins = *out = need(*n, sizeof *skins);
    for (const json_item *x = json_first(json); good && x != NULL; x = json_next(x), i++)
        good = read_skin(&skins[i], g, x, i, nodes->n, wrong);
    if (!good || !check_users(nodes, *n, wrong))
        return false;
    for (i = 0; i < *n; i++) {
        double box[6] = {HUGE_VAL, HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (size_t k = 0; k < nodes->n; k++)
            if (glb_skin_of(skins, &nodes->list[k]) == &skins[i])
                widen(box, g, &nodes->list[k]);
        if (box[0] <= box[3])
            skins[i].stays = find_bind(&skins[i], g, nodes, box);
        else
            skins[i].stays = "no mesh has it";
    }
    return true;
}

void glb_skins_free(glb_skin *skins, size_t n)
{
    for (size_t i = 0; skins != NULL && i < n; i++)
        free(skins[i].joints);
    free(skins);
}
