/* Khronos Group, glTF 2.0 Specification, 2021: sections 3.7.3 (skins) and 3.11 (animations).
 *
 * A joint moves in the scene and does not turn, so only its translation changes. Other nodes that
 * hang on joints stay in the scene, so their translations change, too. An inverse bind matrix is
 * the inverse of the joint's new matrix, times the matrix that places the mesh. Animations add to
 * a translation what the joint's own translation has gained. */
#include "mesh/glb_joints.h"

#include "base/allocate.h"
#include "base/bytes.h"
#include "mesh/affine_map.h"
#include "mesh/glb_nodes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Key frames of a translation. */
typedef struct track {
    size_t node, accessor;
    glb_items items;
    bool cubic; /* each key frame has a tangent before its value and one behind it */
} track;

typedef struct rig {
    const glb *g;
    glb_nodes nodes;
    size_t n_skins;
    glb_skin *skins;
    bool *used;         /* of each skin: a mesh has it */
    bool *moves;        /* of each node: a joint that moves */
    bool *changes;      /* of each node: it moves, or its parent does */
    size_t *owner;      /* of each accessor that changes: what it belongs to, from 1 */
    bool *others;       /* of each accessor: animations use it for something that stays */
    double (*to)[12];   /* of each node: its new matrix */
    double (*steps)[3]; /* what its translation gains */
    size_t n_tracks, room;
    track *tracks;
    problem *wrong;
} rig;

static bool rig_open(rig *r, const glb *g, problem *wrong)
{
    *r = (rig){.g = g, .wrong = wrong};
    bool good = glb_nodes_read(&r->nodes, g, wrong) &&
                glb_skins_read(&r->skins, &r->n_skins, g, &r->nodes, wrong);
    const size_t n = r->nodes.n;
    r->used = need(r->n_skins, sizeof *r->used);
    r->moves = need(n, sizeof *r->moves);
    r->changes = need(n, sizeof *r->changes);
    r->owner = need(g->n_accessors, sizeof *r->owner);
    r->others = need(g->n_accessors, sizeof *r->others);
    r->to = need(n, sizeof *r->to);
    r->steps = need(n, sizeof *r->steps);
    for (size_t i = 0; good && i < n; i++) {
        const glb_skin *skin = glb_skin_of(r->skins, &r->nodes.list[i]);
        if (skin != NULL)
            r->used[skin - r->skins] = true;
    }
    return good;
}

static void rig_close(rig *r)
{
    glb_nodes_free(&r->nodes);
    glb_skins_free(r->skins, r->n_skins);
    free(r->used);
    free(r->moves);
    free(r->changes);
    free(r->owner);
    free(r->others);
    free(r->to);
    free(r->steps);
    free(r->tracks);
}

/* Notes why a skin stays, unless another one has been noted. */
static void stay(mesh_carried *out, size_t skin, const char *why)
{
    if (out->skins)
        return;
    out->skins = true;
    out->skin = skin;
    out->why = why;
}

/* A joint of several skins moves if all of them can. */
static void choose_joints(rig *r, mesh_carried *out)
{
    for (int pass = 0; pass < 2; pass++)
        for (size_t s = 0; s < r->n_skins; s++) {
            const glb_skin *skin = &r->skins[s];
            if (!r->used[s] || (skin->stays == NULL) != (pass == 0))
                continue;
            for (size_t k = 0; k < skin->n; k++)
                r->moves[skin->joints[k]] = pass == 0;
            if (pass == 1)
                stay(out, s, skin->stays);
        }
    for (size_t i = 0; i < r->nodes.n; i++) {
        size_t parent = r->nodes.list[i].parent;
        r->changes[i] = r->moves[i] || (parent != SIZE_MAX && r->moves[parent]);
    }
}

static void stay_all(rig *r, mesh_carried *out, const char *why)
{
    for (size_t s = r->n_skins; s-- > 0;)
        if (r->used[s] && r->skins[s].stays == NULL) {
            r->skins[s].stays = why;
            stay(out, s, why);
        }
    out->animations = json_size(json_get(r->g->json, "animations")) > 0;
    r->n_tracks = 0;
    memset(r->moves, 0, r->nodes.n * sizeof *r->moves);
    memset(r->changes, 0, r->nodes.n * sizeof *r->changes);
}

/* --------------------------------------------------------------- animations */

static const json_item *item_of(const json_item *list, const json_item *index)
{
    const json_item *x = json_first(list);
    double n = json_is(index, JSON_NUMBER) ? index->number : -1;
    for (; x != NULL && n > 0; n--)
        x = json_next(x);
    return n < 0 ? NULL : x;
}

static size_t number_in(const json_item *index, size_t limit)
{
    bool good = json_is(index, JSON_NUMBER) && index->number >= 0 && index->number < (double)limit;
    return good ? (size_t)index->number : SIZE_MAX;
}

/* Notes a channel of an animation. False if it moves a node whose translation changes, but its key
 * frames cannot be read. */
static bool add_channel(rig *r, const json_item *samplers, const json_item *channel,
                        mesh_carried *out)
{
    const json_item *target = json_get(channel, "target");
    const json_item *sampler = item_of(samplers, json_get(channel, "sampler"));
    const char *path = json_string_of(json_get(target, "path"));
    const char *way = json_string_of(json_get(sampler, "interpolation"));
    const json_item *output = json_get(sampler, "output");
    size_t node = number_in(json_get(target, "node"), r->nodes.n);
    size_t input = number_in(json_get(sampler, "input"), r->g->n_accessors);
    size_t values = number_in(output, r->g->n_accessors);
    if (input != SIZE_MAX)
        r->others[input] = true;
    if (path != NULL && strcmp(path, "weights") != 0 && (node == SIZE_MAX || !r->moves[node]))
        out->animations = true;
    bool moves =
        path != NULL && strcmp(path, "translation") == 0 && node != SIZE_MAX && r->changes[node];
    if (!moves && values != SIZE_MAX)
        r->others[values] = true;
    if (!moves)
        return true;
    track t = {.node = node, .cubic = way != NULL && strcmp(way, "CUBICSPLINE") == 0};
    problem none;
    if (!glb_find_items(r->g, output, "key frames", GLB_THREE, &t.accessor, &t.items, &none) ||
        (r->owner[t.accessor] != 0 && r->owner[t.accessor] != node + 1))
        return false;
    if (r->owner[t.accessor] == 0) {
        r->tracks = grow(r->tracks, &r->room, r->n_tracks + 1, sizeof t);
        r->tracks[r->n_tracks++] = t;
    }
    r->owner[t.accessor] = node + 1;
    return true;
}

static bool find_tracks(rig *r, mesh_carried *out)
{
    bool good = true;
    const json_item *animation = json_first(json_get(r->g->json, "animations"));
    for (; animation != NULL; animation = json_next(animation)) {
        const json_item *channel = json_first(json_get(animation, "channels"));
        for (; channel != NULL; channel = json_next(channel))
            good = add_channel(r, json_get(animation, "samplers"), channel, out) && good;
    }
    for (size_t i = 0; good && i < r->n_tracks; i++)
        good = !r->others[r->tracks[i].accessor];
    return good;
}

/* ----------------------------------------------------------------- accessors */

static bool is_same_skin(const glb_skin *a, const glb_skin *b)
{
    return a->n == b->n && memcmp(a->joints, b->joints, a->n * sizeof *a->joints) == 0 &&
           memcmp(a->bind, b->bind, sizeof a->bind) == 0;
}

/* True if the inverse bind matrices of each skin are its own, or those of an equal skin. */
static bool own_matrices(rig *r)
{
    for (size_t s = 0; s < r->n_skins; s++) {
        const glb_skin *skin = &r->skins[s];
        if (skin->inverses.size == 0)
            continue;
        size_t *owner = &r->owner[skin->accessor], first = *owner - r->nodes.n - 1;
        bool equal = *owner > r->nodes.n && is_same_skin(skin, &r->skins[first]) &&
                     (skin->stays == NULL) == (r->skins[first].stays == NULL);
        if (*owner != 0 && !equal)
            return false;
        if (*owner == 0)
            *owner = r->nodes.n + 1 + s;
    }
    return true;
}

/* True if no bytes that change belong to anything else. */
static bool is_apart(rig *r, size_t n_text, size_t n, const glb_vectors *vectors)
{
    size_t n_all = n;
    problem none;
    glb_vectors *all = need(n + r->n_tracks + r->n_skins, sizeof *all);
    if (n > 0)
        memcpy(all, vectors, n * sizeof *all);
    for (size_t i = 0; i < r->n_tracks; i++)
        all[n_all++] =
            (glb_vectors){.accessor = r->tracks[i].accessor, .items = r->tracks[i].items};
    for (size_t s = 0; s < r->n_skins; s++)
        if (r->skins[s].inverses.size > 0 && r->owner[r->skins[s].accessor] == r->nodes.n + 1 + s)
            all[n_all++] =
                (glb_vectors){.accessor = r->skins[s].accessor, .items = r->skins[s].inverses};
    bool good = glb_is_apart(r->g, n_text, n_all, all, &none);
    free(all);
    return good;
}

/* -------------------------------------------------------------------- move */

/* The images of the joints, in r->to. */
static bool map_joints(rig *r, size_t dim, const mesh_mover *mover, mesh_carried *out)
{
    size_t n = 0, k = 0, n_failed = 0;
    double *points = need(r->nodes.n, dim * sizeof *points);
    double *images = need(r->nodes.n, dim * sizeof *images);
    for (size_t i = 0; i < r->nodes.n; i++) {
        memcpy(r->to[i], r->nodes.list[i].matrix, sizeof *r->to);
        for (size_t d = 0; r->moves[i] && d < dim; d++)
            points[dim * n + d] = r->to[i][4 * d + 3];
        n += r->moves[i];
    }
    bool good = n == 0 || mover->map(mover->data, n, points, images, &n_failed);
    for (size_t i = 0; good && i < r->nodes.n; i++) {
        for (size_t d = 0; r->moves[i] && d < dim; d++)
            r->to[i][4 * d + 3] = images[dim * k + d];
        k += r->moves[i];
    }
    out->n_joints = n;
    out->n_out = n_failed;
    free(points);
    free(images);
    return good;
}

static bool is_moved(const rig *r, size_t i)
{
    return memcmp(r->to[i], r->nodes.list[i].matrix, sizeof *r->to) != 0;
}

/* Writes a node's translation to the JSON. */
static void put_translation(edits *e, const glb_node *node, const double move[3])
{
    const json_item *matrix = json_get(node->json, "matrix"),
                    *list = json_get(node->json, "translation");
    const json_item *entry = json_first(matrix);
    for (size_t k = 0; matrix != NULL && k < 15; k++, entry = json_next(entry))
        if (k >= 12) {
            edits_replace(e, entry->begin, entry->end);
            edits_put_number(e, move[k - 12]);
        }
    if (matrix != NULL)
        return;
    size_t end = node->json->end - 1;
    edits_replace(e, list != NULL ? list->begin : end, list != NULL ? list->end : end);
    edits_put_text(e, list != NULL        ? ""
                      : node->json->n > 0 ? ",\"translation\":"
                                          : "\"translation\":");
    for (size_t k = 0; k < 3; k++) {
        edits_put_text(e, k == 0 ? "[" : ",");
        edits_put_number(e, move[k]);
    }
    edits_put_text(e, "]");
}

/* Gives a node the translation that puts it at its place, rounded to floats. */
static bool place_node(rig *r, size_t i, edits *e)
{
    const glb_node *x = &r->nodes.list[i];
    const double *above = x->parent != SIZE_MAX ? r->to[x->parent] : NULL;
    double back[12], move[3], place[3] = {r->to[i][3], r->to[i][7], r->to[i][11]};
    memcpy(move, place, sizeof move);
    if (above != NULL && affine_invert(back, above))
        affine_apply(move, back, place);
    for (size_t k = 0; k < 3; k++) {
        if (!(fabs(move[k]) <= (double)FLT_MAX))
            return spoilt(r->wrong, 0, "nodes[%zu].translation becomes too large for glTF", i);
        move[k] = (double)(float)move[k];
        r->steps[i][k] = move[k] - x->own[4 * k + 3];
    }
    put_translation(e, x, move);
    if (above != NULL)
        affine_apply(place, above, move);
    for (size_t k = 0; k < 3; k++)
        r->to[i][4 * k + 3] = above != NULL ? place[k] : move[k];
    return true;
}

/* Moves all nodes from the roots down. */
static bool place_nodes(rig *r, edits *e)
{
    for (size_t k = 0; k < r->nodes.n; k++) {
        size_t i = r->nodes.order[k], parent = r->nodes.list[i].parent;
        bool above = parent != SIZE_MAX && is_moved(r, parent);
        if (r->changes[i] && (above || is_moved(r, i))) {
            if (!place_node(r, i, e))
                return false;
        } else if (above) {
            affine_compose(r->to[i], r->to[parent], r->nodes.list[i].own);
        }
    }
    return true;
}

/* True if each node whose translation changes can be placed below its parent. */
static bool is_placeable(const rig *r)
{
    bool good = true;
    double back[12];
    for (size_t i = 0; good && i < r->nodes.n; i++) {
        size_t parent = r->nodes.list[i].parent;
        good = !r->changes[i] || parent == SIZE_MAX ||
               affine_invert(back, r->nodes.list[parent].matrix);
    }
    return good;
}

/* ------------------------------------------------------------------- write */

static bool put_float(rig *r, char *at, double value, size_t accessor)
{
    if (!(fabs(value) <= (double)FLT_MAX))
        return spoilt(r->wrong, 0, "an item of accessors[%zu] becomes too large for glTF",
                      accessor);
    put_little_endian_float(at, (float)value);
    return true;
}

static void update_bounds(const rig *r, size_t accessor, const glb_items *items, const char *text,
                          edits *e)
{
    const json_item *json = r->g->accessors[accessor];
    if (json_get(json, "min") != NULL)
        glb_set_bounds(e, json, text, items);
}

static bool write_matrices(rig *r, const glb_skin *skin, char *text)
{
    for (size_t k = 0; k < skin->n; k++) {
        size_t joint = skin->joints[k];
        double back[12], inverse[12];
        char *at = text + skin->inverses.at + k * skin->inverses.stride;
        if (!is_moved(r, joint))
            continue;
        if (!affine_invert(back, r->to[joint]))
            return spoilt(r->wrong, 0, "nodes[%zu] moves too far for glTF", joint);
        affine_compose(inverse, back, skin->bind);
        for (size_t i = 0; i < 12; i++)
            if (!put_float(r, at + 4 * (i % 4 * 4 + i / 4), inverse[i], skin->accessor))
                return false;
    }
    return true;
}

static bool write_track(rig *r, const track *t, char *text)
{
    const double *step = r->steps[t->node];
    for (size_t i = 0; i < t->items.n; i++) {
        char *at = text + t->items.at + i * t->items.stride;
        for (size_t k = 0; k < 3 && (!t->cubic || i % 3 == 1); k++)
            if ((step[k] < 0 || step[k] > 0) &&
                !put_float(r, at + 4 * k, (double)little_endian_float(at + 4 * k) + step[k],
                           t->accessor))
                return false;
    }
    return true;
}

static bool write_all(rig *r, char *text, edits *e)
{
    for (size_t s = 0; s < r->n_skins; s++) {
        const glb_skin *skin = &r->skins[s];
        if (!r->used[s] || skin->stays != NULL)
            continue;
        if (!write_matrices(r, skin, text))
            return false;
        update_bounds(r, skin->accessor, &skin->inverses, text, e);
    }
    for (size_t i = 0; i < r->n_tracks; i++) {
        if (!write_track(r, &r->tracks[i], text))
            return false;
        update_bounds(r, r->tracks[i].accessor, &r->tracks[i].items, text, e);
    }
    return true;
}

bool glb_carry_joints(const glb *g, size_t dim, char *text, size_t n_text, size_t n,
                      const glb_vectors *vectors, edits *e, const mesh_mover *mover,
                      mesh_carried *out, problem *wrong)
{
    rig r;
    bool good = rig_open(&r, g, wrong);
    for (size_t s = 0; good && mover == NULL && s < r.n_skins; s++)
        if (r.used[s])
            stay(out, s, NULL);
    if (good && mover != NULL)
        choose_joints(&r, out);
    if (good && !find_tracks(&r, out))
        stay_all(&r, out, "key frames of a joint are shared or compressed");
    if (good && mover != NULL) {
        if (!is_placeable(&r))
            stay_all(&r, out, "a joint has no inverse");
        else if (!own_matrices(&r) || !is_apart(&r, n_text, n, vectors))
            stay_all(&r, out, "its numbers are shared with something else");
        good = map_joints(&r, dim, mover, out) && place_nodes(&r, e) && write_all(&r, text, e);
    }
    rig_close(&r);
    return good;
}
