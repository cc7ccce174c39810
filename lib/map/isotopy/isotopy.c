/* Finds the isotopy class of a map, compares classes, and moves them with a target.
 *
 * Two maps are isotopic exactly if each path of a tree that joins all components has isotopic
 * images under both. Two paths are isotopic exactly if their reduced sequences of crossed edges are
 * equal (map/isotopy/crossing_sequence.h). */
#include "map/isotopy/isotopy.h"

#include "map/isotopy/draw_crossings.h"
#include "map/isotopy/edge_tree.h"
#include "map/isotopy/sequence_motion.h"

#include <string.h>

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
    const uint32_t *ends = isotopy->sequences.sequence[tie].ends;
    const double *scale[2] = {source->frame.out, target->frame.out};
    icc_tie_info info = {.vertex = {ends[0], ends[1]}, .n_target = line->n - 2};
    info.length[0] =
        iccp_distance_between(source->vertices, ends[0], ends[1]) * scale[0][0] * scale[0][1];
    info.length[1] = iccp_polyline_length(line) * scale[1][0] * scale[1][1];
    for (size_t k = 0; bends != NULL && k < info.n_target; ++k)
        iccp_frame_out(&target->frame, 2, line->points + 2 * (k + 1), bends + 2 * k);
    return info;
}

static icc_status describe(iccp_isotopy *isotopy, const iccp_plmap *map,
                           const iccp_domain_pair *domains, const iccp_env *env)
{
    const icc_domain *source = domains->domain[0], *target = domains->domain[1];
    iccp_cuts tree;
    iccp_triangulation triangulation = {0};
    icc_status status = iccp_edge_tree(&tree, domains, &domains->mesh[0], env);
    if (status == ICC_OK)
        status = iccp_triangulation_create(&triangulation, &domains->mesh[1], domains->n,
                                           target->vertices, &domains->walls, &env->memory);
    if (status == ICC_OK)
        status =
            iccp_sequences_of_images(&isotopy->sequences, &tree, map, source, &triangulation, env);
    if (status == ICC_OK) {
        isotopy->line = iccp_alloc_zero(&env->memory, tree.n, sizeof *isotopy->line);
        status = isotopy->line != NULL ? ICC_OK : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK) {
        isotopy->n = tree.n;
        status = iccp_draw_crossings(isotopy->line, &isotopy->sequences, domains, 1, &triangulation,
                                     env);
    }
    if (status == ICC_OK)
        isotopy->detour = detour_of(isotopy);
    iccp_triangulation_free(&triangulation, &env->memory);
    iccp_cuts_free(&tree);
    return status;
}

/* Turns an error caused by rounding into success, because the class is only reported and the map is
 * valid without it. */
static icc_status forgive(icc_status status)
{
    return status == ICC_ERR_TOPOLOGY || status == ICC_ERR_RESOLUTION ? ICC_OK : status;
}

icc_status iccp_isotopy_create(iccp_isotopy **out, const iccp_plmap *map, const icc_domain *source,
                               const icc_domain *target, const iccp_env *env)
{
    iccp_domain_pair domains;
    iccp_isotopy *isotopy = *out = iccp_alloc_zero(&env->memory, 1, sizeof *isotopy);
    if (isotopy == NULL)
        return ICC_ERR_MEMORY;
    isotopy->memory = isotopy->sequences.memory = env->memory;
    isotopy->detour = 1;
    if (iccp_network_of(source)->n_pieces == 1) /* nothing to join: there is one class */
        return ICC_OK;
    icc_status status = iccp_domain_pair_create(&domains, source, target, env);
    if (status == ICC_OK) {
        status = describe(isotopy, map, &domains, env);
        iccp_domain_pair_free(&domains);
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
    iccp_sequences_free(&isotopy->sequences);
    iccp_free(&memory, isotopy);
}

/* ---- comparing ---- */

bool iccp_isotopy_same(const iccp_isotopy *a, const iccp_isotopy *b)
{
    return a != NULL && b != NULL && iccp_sequences_same(&a->sequences, &b->sequences);
}

icc_status iccp_isotopy_has_cuts(bool *kept, const iccp_plmap *map, const iccp_domain_pair *domains,
                                 const iccp_cuts *cuts, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    iccp_triangulation triangulation = {0};
    iccp_sequences wanted = {.memory = *memory}, found = {.memory = *memory};
    *kept = false;
    icc_status status =
        iccp_triangulation_create(&triangulation, &domains->mesh[1], domains->n,
                                  domains->domain[1]->vertices, &domains->walls, memory);
    if (status == ICC_OK)
        status = iccp_sequences_of_cuts(&wanted, cuts, &triangulation, env);
    if (status == ICC_OK)
        status =
            iccp_sequences_of_images(&found, cuts, map, domains->domain[0], &triangulation, env);
    *kept = status == ICC_OK && iccp_sequences_same(&wanted, &found);
    iccp_sequences_free(&wanted);
    iccp_sequences_free(&found);
    iccp_triangulation_free(&triangulation, memory);
    return forgive(status);
}

static icc_status copy_sequences(iccp_sequences *to, const iccp_sequences *from,
                                 const iccp_env *env)
{
    icc_status status = iccp_sequences_begin(to, from->n, &env->memory);
    for (size_t i = 0; status == ICC_OK && i < from->n; ++i) {
        const iccp_sequence *sequence = &from->sequence[i];
        memcpy(to->sequence[i].ends, sequence->ends, sizeof sequence->ends);
        for (size_t k = 0; status == ICC_OK && k < sequence->n; ++k)
            status = iccp_sequence_add(&to->sequence[i], sequence->sides[2 * k],
                                       sequence->sides[2 * k + 1], env);
    }
    if (status != ICC_OK)
        iccp_sequences_free(to);
    return status;
}

/* Makes the old target's bare triangulation, with its vertices in the new target's coordinates. */
static icc_status begin_move(iccp_moving_triangulation *moving, const iccp_domain_pair *old,
                             const icc_domain *target, const iccp_memory *memory)
{
    const icc_domain *old_target = old->domain[1];
    iccp_triangulation triangulation;
    icc_status status = iccp_triangulation_create(&triangulation, &old->mesh[1], old->n,
                                                  old_target->vertices, &old->walls, memory);
    if (status == ICC_OK)
        status = iccp_moving_triangulation_create(moving, &triangulation, old->n,
                                                  old_target->vertices, memory);
    iccp_triangulation_free(&triangulation, memory);
    if (status == ICC_OK)
        iccp_frame_change(&old_target->frame, &target->frame, 2, old->n, moving->points);
    return status;
}

/* Carries sequences of the old target over to the new one. */
static icc_status move_sequences(iccp_sequences *moved, iccp_moving_triangulation *moving,
                                 bool *arrived, const iccp_sequences *before,
                                 const iccp_domain_pair *old, const icc_domain *target,
                                 const iccp_env *env)
{
    *arrived = false;
    icc_status status = copy_sequences(moved, before, env);
    if (status == ICC_OK)
        status = begin_move(moving, old, target, &env->memory);
    return status == ICC_OK ? iccp_sequences_move(moved, moving, target->vertices, arrived, env)
                            : status;
}

/* Draws the cuts as straight lines in the source and as the sequences say in the target. */
static icc_status draw_cuts(iccp_cuts *cuts, const iccp_sequences *sequences,
                            const iccp_domain_pair *old, const iccp_moving_triangulation *moving,
                            const icc_domain *target, const iccp_env *env)
{
    iccp_domain_pair domains = *old;
    const double *points[2] = {domains.domain[0]->vertices, target->vertices};
    iccp_polyline line[2] = {{0}, {0}}, *drawn;
    domains.domain[1] = target;
    domains.mesh[1] = moving->mesh;
    drawn = iccp_alloc_zero(&env->memory, sequences->n, sizeof *drawn);
    if (drawn == NULL)
        return ICC_ERR_MEMORY;
    icc_status status =
        iccp_draw_crossings(drawn, sequences, &domains, 1, &moving->triangulation, env);
    if (status == ICC_OK)
        status = iccp_cuts_begin(cuts, sequences->n, &env->memory);
    for (size_t i = 0; status == ICC_OK && i < sequences->n; ++i) {
        const uint32_t *ends = sequences->sequence[i].ends;
        line[0].n = 0;
        for (int k = 0; status == ICC_OK && k < 2; ++k)
            status = iccp_polyline_add(&line[0], points[0] + 2 * (size_t)ends[k], &env->memory);
        line[1] = drawn[i];
        if (status == ICC_OK)
            status = iccp_cuts_add(cuts, i, ends, line);
        drawn[i] = line[1];
    }
    iccp_polyline_free(&line[0], &env->memory);
    for (size_t i = 0; i < sequences->n; ++i)
        iccp_polyline_free(&drawn[i], &env->memory);
    iccp_free(&env->memory, drawn);
    return status;
}

icc_status iccp_isotopy_move(iccp_cuts *cuts, bool *arrived, const iccp_isotopy *isotopy,
                             const icc_domain *source, const icc_domain *old_target,
                             const icc_domain *target, const iccp_env *env)
{
    iccp_domain_pair old;
    iccp_sequences moved = {.memory = env->memory};
    iccp_moving_triangulation moving = {.memory = env->memory};
    *cuts = (iccp_cuts){.memory = env->memory};
    *arrived = false;
    if (isotopy == NULL)
        return ICC_OK;
    if (isotopy->n == 0) { /* all maps are of one class */
        *arrived = true;
        return iccp_cuts_begin(cuts, 0, &env->memory);
    }
    icc_status status = iccp_domain_pair_create(&old, source, old_target, env);
    if (status != ICC_OK)
        return forgive(status);
    status = move_sequences(&moved, &moving, arrived, &isotopy->sequences, &old, target, env);
    if (status == ICC_OK && *arrived)
        status = draw_cuts(cuts, &moved, &old, &moving, target, env);
    *arrived = *arrived && status == ICC_OK;
    iccp_sequences_free(&moved);
    iccp_moving_triangulation_free(&moving);
    iccp_domain_pair_free(&old);
    return forgive(status);
}

static icc_status compare_moved(bool *kept, const iccp_sequences *before, iccp_sequences *moved,
                                iccp_moving_triangulation *moving, const iccp_domain_pair *old,
                                const iccp_plmap *map, const icc_domain *target,
                                const iccp_env *env)
{
    iccp_sequences found = {.memory = env->memory};
    iccp_cuts tree;
    bool arrived;
    icc_status status = move_sequences(moved, moving, &arrived, before, old, target, env);
    if (status != ICC_OK || !arrived)
        return status;
    status = iccp_edge_tree(&tree, old, &old->mesh[0], env);
    if (status == ICC_OK)
        status = iccp_sequences_of_images(&found, &tree, map, old->domain[0],
                                          &moving->triangulation, env);
    *kept = status == ICC_OK && iccp_sequences_same(moved, &found);
    iccp_sequences_free(&found);
    iccp_cuts_free(&tree);
    return status;
}

icc_status iccp_isotopy_is_kept(bool *kept, const iccp_isotopy *isotopy,
                                const icc_domain *old_target, const iccp_plmap *map,
                                const icc_domain *source, const icc_domain *target,
                                const iccp_env *env)
{
    iccp_domain_pair old;
    iccp_sequences moved = {.memory = env->memory};
    iccp_moving_triangulation moving = {.memory = env->memory};
    *kept = isotopy != NULL && isotopy->n == 0;
    if (isotopy == NULL || isotopy->n == 0)
        return ICC_OK;
    icc_status status = iccp_domain_pair_create(&old, source, old_target, env);
    if (status != ICC_OK)
        return forgive(status);
    status = compare_moved(kept, &isotopy->sequences, &moved, &moving, &old, map, target, env);
    iccp_sequences_free(&moved);
    iccp_moving_triangulation_free(&moving);
    iccp_domain_pair_free(&old);
    return forgive(status);
}
