/* Two maps are isotopic when the images of a tree of paths that joins all components are, path by
 * path; and a path can be moved to another when both cross the same edges once neither crosses one
 * in vain (map/isotopy/word.h). */
#include "map/isotopy/isotopy.h"

#include "base/sets.h"
#include "base/sort.h"
#include "map/isotopy/strands.h"
#include "map/isotopy/word_motion.h"

#include <string.h>

/* ---- the tree ---- */

typedef struct joint {
    double length;
    uint32_t ends[2];
} joint;

/* Shorter ones first, then those of smaller vertices. */
static int compare(const void *x, const void *y)
{
    const joint *a = x, *b = y;
    if (a->length < b->length || a->length > b->length)
        return a->length < b->length ? -1 : 1;
    for (int k = 0; k < 2; ++k)
        if (a->ends[k] != b->ends[k])
            return a->ends[k] < b->ends[k] ? -1 : 1;
    return 0;
}

/* Edges between components, once each. */
static size_t list_joints(joint *joints, const iccp_scene *scene)
{
    const iccp_corners *mesh = &scene->mesh[0];
    size_t n = 0;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->vertex[iccp_after(c)], b = mesh->vertex[iccp_before(c)];
        if (a < b && scene->component[a] != scene->component[b])
            joints[n++] = (joint){iccp_distance_between(scene->domain[0]->vertices, a, b), {a, b}};
    }
    return n;
}

/* J. B. Kruskal, On the shortest spanning subtree of a graph, 1956. Straight, without bends; what
 * is not the source's is not there. */
static icc_status find_tree(iccp_cuts *tree, const iccp_scene *scene, const iccp_env *env)
{
    const size_t n = scene->n_components;
    joint *joints =
        iccp_alloc(&env->memory, 3 * scene->mesh[0].n_triangles / 2 + 1, sizeof *joints);
    uint32_t *leader = iccp_alloc(&env->memory, n, sizeof *leader);
    size_t n_found = 0;
    icc_status status = iccp_cuts_begin(tree, n - 1, &env->memory);
    if (joints == NULL || leader == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        const size_t n_joints = list_joints(joints, scene);
        iccp_sort(joints, n_joints, sizeof *joints, compare);
        iccp_sets_begin(leader, n);
        for (size_t k = 0; k < n_joints && n_found + 1 < n; ++k) {
            const uint32_t *ends = joints[k].ends;
            if (iccp_sets_join(leader, scene->component[ends[0]], scene->component[ends[1]]))
                memcpy(tree->ends + 2 * n_found++, ends, 2 * sizeof *ends);
        }
        status = n_found + 1 == n ? ICC_OK : ICC_ERR_TOPOLOGY;
    }
    iccp_free(&env->memory, joints);
    iccp_free(&env->memory, leader);
    return status;
}

/* ---- an isotopy class ---- */

static double detour_of(const iccp_isotopy *isotopy)
{
    double length = 0, straight = 0;
    for (size_t i = 0; i < isotopy->n; ++i) {
        const iccp_polyline *line = &isotopy->line[i];
        length += iccp_polyline_length(line);
        straight += iccp_distance_between(line->points, 0, (uint32_t)line->n - 1);
    }
    return straight > 0 ? length / straight : 1;
}

icc_tie_info iccp_isotopy_tie(const iccp_isotopy *isotopy, size_t tie, const icc_domain *source,
                              const icc_domain *target, double *bends)
{
    const iccp_polyline *line = &isotopy->line[tie];
    const uint32_t *ends = isotopy->words.word[tie].ends;
    const double *scale[2] = {source->frame.out, target->frame.out};
    icc_tie_info info = {.vertex = {ends[0], ends[1]}, .n_target = line->n - 2};
    info.length[0] =
        iccp_distance_between(source->vertices, ends[0], ends[1]) * scale[0][0] * scale[0][1];
    info.length[1] = iccp_polyline_length(line) * scale[1][0] * scale[1][1];
    for (size_t k = 0; bends != NULL && k < info.n_target; ++k)
        iccp_frame_out(&target->frame, 2, line->points + 2 * (k + 1), bends + 2 * k);
    return info;
}

static icc_status describe(iccp_isotopy *isotopy, const iccp_plmap *map, const iccp_scene *scene,
                           const iccp_env *env)
{
    const icc_domain *source = scene->domain[0], *target = scene->domain[1];
    iccp_cuts tree;
    iccp_net net = {0};
    icc_status status = find_tree(&tree, scene, env);
    if (status == ICC_OK)
        status = iccp_net_create(&net, &scene->mesh[1], scene->n, target->vertices, &scene->walls,
                                 &env->memory);
    if (status == ICC_OK)
        status = iccp_words_of_images(&isotopy->words, &tree, map, source, &net, env);
    if (status == ICC_OK) {
        isotopy->line = iccp_alloc_zero(&env->memory, tree.n, sizeof *isotopy->line);
        status = isotopy->line != NULL ? ICC_OK : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK) {
        isotopy->n = tree.n;
        status = iccp_strands_draw(isotopy->line, &isotopy->words, scene, 1, &net, env);
    }
    if (status == ICC_OK)
        isotopy->detour = detour_of(isotopy);
    iccp_net_free(&net, &env->memory);
    iccp_cuts_free(&tree);
    return status;
}

/* Rounding does not make an error of what is only told. */
static icc_status forgive(icc_status status)
{
    return status == ICC_ERR_TOPOLOGY || status == ICC_ERR_RESOLUTION ? ICC_OK : status;
}

icc_status iccp_isotopy_create(iccp_isotopy **out, const iccp_plmap *map, const icc_domain *source,
                               const icc_domain *target, const iccp_env *env)
{
    iccp_scene scene;
    iccp_isotopy *isotopy = *out = iccp_alloc_zero(&env->memory, 1, sizeof *isotopy);
    if (isotopy == NULL)
        return ICC_ERR_MEMORY;
    isotopy->memory = isotopy->words.memory = env->memory;
    icc_status status = iccp_scene_create(&scene, source, target, env);
    if (status == ICC_OK) {
        status = describe(isotopy, map, &scene, env);
        iccp_scene_free(&scene);
    }
    if (status != ICC_OK) {
        iccp_isotopy_free(isotopy);
        *out = NULL;
    }
    return forgive(status);
}

void iccp_isotopy_free(iccp_isotopy *isotopy)
{
    if (isotopy == NULL)
        return;
    const iccp_memory memory = isotopy->memory;
    for (size_t i = 0; i < isotopy->n; ++i)
        iccp_polyline_free(&isotopy->line[i], &memory);
    iccp_free(&memory, isotopy->line);
    iccp_words_free(&isotopy->words);
    iccp_free(&memory, isotopy);
}

/* ---- comparing ---- */

bool iccp_isotopy_same(const iccp_isotopy *a, const iccp_isotopy *b)
{
    return a != NULL && b != NULL && iccp_words_same(&a->words, &b->words);
}

icc_status iccp_isotopy_has_cuts(bool *kept, const iccp_plmap *map, const iccp_scene *scene,
                                 const iccp_cuts *cuts, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    iccp_net net = {0};
    iccp_words wanted = {.memory = *memory}, found = {.memory = *memory};
    *kept = false;
    icc_status status = iccp_net_create(&net, &scene->mesh[1], scene->n, scene->domain[1]->vertices,
                                        &scene->walls, memory);
    if (status == ICC_OK)
        status = iccp_words_of_cuts(&wanted, cuts, &net, env);
    if (status == ICC_OK)
        status = iccp_words_of_images(&found, cuts, map, scene->domain[0], &net, env);
    *kept = status == ICC_OK && iccp_words_same(&wanted, &found);
    iccp_words_free(&wanted);
    iccp_words_free(&found);
    iccp_net_free(&net, memory);
    return forgive(status);
}

static icc_status copy_words(iccp_words *to, const iccp_words *from, const iccp_env *env)
{
    icc_status status = iccp_words_begin(to, from->n, &env->memory);
    for (size_t i = 0; status == ICC_OK && i < from->n; ++i) {
        const iccp_word *word = &from->word[i];
        memcpy(to->word[i].ends, word->ends, sizeof word->ends);
        for (size_t k = 0; status == ICC_OK && k < word->n; ++k)
            status = iccp_word_add(&to->word[i], word->sides[2 * k], word->sides[2 * k + 1], env);
    }
    if (status != ICC_OK)
        iccp_words_free(to);
    return status;
}

/* The old target's bare triangulation, with its vertices in the new one's coordinates. */
static icc_status begin_move(iccp_moving_net *moving, const iccp_scene *old,
                             const icc_domain *target, const iccp_memory *memory)
{
    const icc_domain *old_target = old->domain[1];
    iccp_net net;
    icc_status status =
        iccp_net_create(&net, &old->mesh[1], old->n, old_target->vertices, &old->walls, memory);
    if (status == ICC_OK)
        status = iccp_moving_net_create(moving, &net, old->n, old_target->vertices, memory);
    iccp_net_free(&net, memory);
    if (status == ICC_OK)
        iccp_frame_change(&old_target->frame, &target->frame, 2, old->n, moving->points);
    return status;
}

/* Words of the old target become those of the new one, by the moving net. */
static icc_status move_words(iccp_words *moved, iccp_moving_net *moving, bool *arrived,
                             const iccp_words *before, const iccp_scene *old,
                             const icc_domain *target, const iccp_env *env)
{
    *arrived = false;
    icc_status status = copy_words(moved, before, env);
    if (status == ICC_OK)
        status = begin_move(moving, old, target, &env->memory);
    return status == ICC_OK ? iccp_words_move(moved, moving, target->vertices, arrived, env)
                            : status;
}

/* Straight lines in the source, and in the target what words say. */
static icc_status draw_cuts(iccp_cuts *cuts, const iccp_words *words, const iccp_scene *old,
                            const iccp_moving_net *moving, const icc_domain *target,
                            const iccp_env *env)
{
    iccp_scene scene = *old;
    const double *points[2] = {scene.domain[0]->vertices, target->vertices};
    iccp_polyline line[2] = {{0}, {0}}, *drawn;
    scene.domain[1] = target;
    scene.mesh[1] = moving->mesh;
    drawn = iccp_alloc_zero(&env->memory, words->n, sizeof *drawn);
    if (drawn == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = iccp_strands_draw(drawn, words, &scene, 1, &moving->net, env);
    if (status == ICC_OK)
        status = iccp_cuts_begin(cuts, words->n, &env->memory);
    for (size_t i = 0; status == ICC_OK && i < words->n; ++i) {
        const uint32_t *ends = words->word[i].ends;
        line[0].n = 0;
        for (int k = 0; status == ICC_OK && k < 2; ++k)
            status = iccp_polyline_add(&line[0], points[0] + 2 * (size_t)ends[k], &env->memory);
        line[1] = drawn[i];
        if (status == ICC_OK)
            status = iccp_cuts_add(cuts, i, ends, line);
        drawn[i] = line[1];
    }
    iccp_polyline_free(&line[0], &env->memory);
    for (size_t i = 0; i < words->n; ++i)
        iccp_polyline_free(&drawn[i], &env->memory);
    iccp_free(&env->memory, drawn);
    return status;
}

icc_status iccp_isotopy_move(iccp_cuts *cuts, bool *arrived, const iccp_isotopy *isotopy,
                             const icc_domain *source, const icc_domain *old_target,
                             const icc_domain *target, const iccp_env *env)
{
    iccp_scene old;
    iccp_words moved = {.memory = env->memory};
    iccp_moving_net moving = {.memory = env->memory};
    *cuts = (iccp_cuts){.memory = env->memory};
    *arrived = false;
    if (isotopy == NULL)
        return ICC_OK;
    icc_status status = iccp_scene_create(&old, source, old_target, env);
    if (status != ICC_OK)
        return forgive(status);
    status = move_words(&moved, &moving, arrived, &isotopy->words, &old, target, env);
    if (status == ICC_OK && *arrived)
        status = draw_cuts(cuts, &moved, &old, &moving, target, env);
    *arrived = *arrived && status == ICC_OK;
    iccp_words_free(&moved);
    iccp_moving_net_free(&moving);
    iccp_scene_free(&old);
    return forgive(status);
}

static icc_status compare_moved(bool *kept, const iccp_words *before, iccp_words *moved,
                                iccp_moving_net *moving, const iccp_scene *old,
                                const iccp_plmap *map, const icc_domain *target,
                                const iccp_env *env)
{
    iccp_words found = {.memory = env->memory};
    iccp_cuts tree;
    bool arrived;
    icc_status status = move_words(moved, moving, &arrived, before, old, target, env);
    if (status != ICC_OK || !arrived)
        return status;
    status = find_tree(&tree, old, env);
    if (status == ICC_OK)
        status = iccp_words_of_images(&found, &tree, map, old->domain[0], &moving->net, env);
    *kept = status == ICC_OK && iccp_words_same(moved, &found);
    iccp_words_free(&found);
    iccp_cuts_free(&tree);
    return status;
}

icc_status iccp_isotopy_follows(bool *kept, const iccp_isotopy *isotopy,
                                const icc_domain *old_target, const iccp_plmap *map,
                                const icc_domain *source, const icc_domain *target,
                                const iccp_env *env)
{
    iccp_scene old;
    iccp_words moved = {.memory = env->memory};
    iccp_moving_net moving = {.memory = env->memory};
    *kept = false;
    if (isotopy == NULL)
        return ICC_OK;
    icc_status status = iccp_scene_create(&old, source, old_target, env);
    if (status != ICC_OK)
        return forgive(status);
    status = compare_moved(kept, &isotopy->words, &moved, &moving, &old, map, target, env);
    iccp_words_free(&moved);
    iccp_moving_net_free(&moving);
    iccp_scene_free(&old);
    return forgive(status);
}
