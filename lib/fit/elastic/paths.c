/* A group goes along a similarity: its centroid goes straight, and it turns around the centroid.
 * What the similarity does not explain is added in equal parts, in the turning frame. A straight
 * way would shrink a wall that turns. */
#include "fit/elastic/paths.h"

#include "base/minmax.h"
#include "base/sets.h"
#include "fit/elastic/elastic_model.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

static bool moves(const iccp_paths *p, uint32_t v)
{
    return memcmp(p->from + 2 * (size_t)v, p->to + 2 * (size_t)v, 2 * sizeof(double)) != 0;
}

/* ---- groups ---- */

/* Joins neighbours, then numbers the groups in the order of their first vertices. */
static void find_groups(iccp_paths *p, const uint8_t *hold, size_t n_triangles,
                        const uint32_t *corners, uint32_t *parent)
{
    iccp_sets_begin(parent, p->n_points);
    for (size_t c = 0; c < 3 * n_triangles; ++c) {
        const uint32_t a = corners[c], b = corners[c % 3 == 2 ? c - 2 : c + 1];
        if (hold[a] == ICCP_HELD && hold[b] == ICCP_HELD && moves(p, a) && moves(p, b))
            (void)iccp_sets_join(parent, a, b);
    }
    for (uint32_t v = 0; v < p->n_points; ++v)
        p->group_of[v] = NONE;
    for (uint32_t v = 0; v < p->n_points; ++v) {
        if (hold[v] != ICCP_HELD)
            continue;
        const uint32_t root = iccp_sets_leader(parent, v);
        if (p->group_of[root] == NONE)
            p->group_of[root] = (uint32_t)p->n_groups++;
        p->group_of[v] = p->group_of[root];
    }
}

icc_status iccp_paths_create(iccp_paths *paths, size_t n_points, const uint8_t *hold,
                             size_t n_triangles, const uint32_t *corners, const double *targets,
                             const double *images, const iccp_env *env)
{
    iccp_paths *p = paths;
    const iccp_memory *memory = &env->memory;
    *p = (iccp_paths){.memory = *memory, .n_points = n_points, .to = targets};
    uint32_t *parent = iccp_alloc(memory, n_points, sizeof *parent);
    p->group_of = iccp_alloc(memory, n_points, sizeof *p->group_of);
    p->from = iccp_alloc(memory, n_points, 2 * sizeof *p->from);
    if (parent != NULL && p->group_of != NULL && p->from != NULL) {
        memcpy(p->from, images, 2 * n_points * sizeof *p->from);
        find_groups(p, hold, n_triangles, corners, parent);
        p->group = iccp_alloc_zero(memory, p->n_groups, sizeof *p->group);
    }
    iccp_free(memory, parent);
    if (p->group == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < n_points; ++v)
        if (p->group_of[v] != NONE)
            p->group[p->group_of[v]].moves = moves(p, v);
    iccp_paths_begin(p, images);
    return ICC_OK;
}

void iccp_paths_free(iccp_paths *paths)
{
    const iccp_memory memory = paths->memory;
    iccp_free(&memory, paths->group_of);
    iccp_free(&memory, paths->from);
    iccp_free(&memory, paths->group);
    *paths = (iccp_paths){.memory = memory};
}

/* ---- similarities ---- */

/* Adds up the centroids of all groups. */
static void find_centroids(iccp_paths *p)
{
    for (size_t g = 0; g < p->n_groups; ++g) {
        iccp_group *group = &p->group[g];
        *group = (iccp_group){.moves = group->moves, .is_off = group->is_off};
    }
    for (uint32_t v = 0; v < p->n_points; ++v) {
        if (p->group_of[v] == NONE)
            continue;
        iccp_group *group = &p->group[p->group_of[v]];
        ++group->n;
        for (size_t d = 0; d < 2; ++d) {
            group->from[d] += p->from[2 * (size_t)v + d];
            group->to[d] += p->to[2 * (size_t)v + d];
        }
    }
    for (size_t g = 0; g < p->n_groups; ++g)
        for (size_t d = 0; d < 2; ++d) {
            p->group[g].from[d] /= (double)p->group[g].n;
            p->group[g].to[d] /= (double)p->group[g].n;
        }
}

static void relative(const iccp_paths *p, uint32_t v, double a[2], double b[2])
{
    const iccp_group *group = &p->group[p->group_of[v]];
    for (size_t d = 0; d < 2; ++d) {
        a[d] = p->from[2 * (size_t)v + d] - group->from[d];
        b[d] = p->to[2 * (size_t)v + d] - group->to[d];
    }
}

/* The angle of the best similarity is that of the sum of conj(a) b. */
static void find_turns(iccp_paths *p)
{
    for (uint32_t v = 0; v < p->n_points; ++v) {
        double a[2], b[2];
        if (p->group_of[v] == NONE)
            continue;
        iccp_group *group = &p->group[p->group_of[v]];
        relative(p, v, a, b);
        group->sum[0] += a[0] * b[0] + a[1] * b[1];
        group->sum[1] += a[0] * b[1] - a[1] * b[0];
    }
    for (size_t g = 0; g < p->n_groups; ++g) {
        iccp_group *group = &p->group[g];
        group->turn = group->n > 1 ? iccp_atan2_turns(group->sum[1], group->sum[0]) : 0;
    }
}

void iccp_paths_begin(iccp_paths *paths, const double *images)
{
    memcpy(paths->from, images, 2 * paths->n_points * sizeof *paths->from);
    find_centroids(paths);
    find_turns(paths);
}

void iccp_paths_at(const iccp_paths *paths, uint32_t vertex, double t, double *place)
{
    const iccp_paths *p = paths;
    const iccp_group *group = &p->group[p->group_of[vertex]];
    const double *from = p->from + 2 * (size_t)vertex, *to = p->to + 2 * (size_t)vertex;
    double a[2], b[2], turn[2], whole[2];
    if (t >= 1 || !moves(p, vertex)) {
        memcpy(place, to, 2 * sizeof *place);
        return;
    }
    if (group->n == 1) {
        for (size_t d = 0; d < 2; ++d)
            place[d] = from[d] + t * (to[d] - from[d]);
        return;
    }
    relative(p, vertex, a, b);
    iccp_cis_turns(t * group->turn, turn);
    iccp_cis_turns(group->turn, whole);
    /* b, turned back */
    const double c[2] = {whole[0] * b[0] + whole[1] * b[1], whole[0] * b[1] - whole[1] * b[0]};
    const double x = a[0] + t * (c[0] - a[0]), y = a[1] + t * (c[1] - a[1]);
    place[0] = turn[0] * x - turn[1] * y + group->from[0] + t * (group->to[0] - group->from[0]);
    place[1] = turn[1] * x + turn[0] * y + group->from[1] + t * (group->to[1] - group->from[1]);
}

double iccp_paths_turn(const iccp_paths *paths)
{
    double most = 0;
    for (size_t g = 0; g < paths->n_groups; ++g)
        if (!paths->group[g].is_off)
            most = iccp_max(most, fabs(paths->group[g].turn));
    return most;
}
