/* Moves the fixed vertices of a plane map to another target by continuation. Where the way is
 * blocked, improve_moving.h changes the mesh. */
#include "map/compatible/move_targets.h"

#include "map/energy/continuation.h"

/* The way counts as blocked if a part goes less than this share of it. */
static const double BLOCKED = 0.35;

typedef struct tended {
    iccp_plmap *map;
    const iccp_mesh_limits *limits;
} tended;

void iccp_target_place(const iccp_plmap *map, const icc_domain *target, size_t vertex,
                       double place[2])
{
    const double bary[2] = {1 - map->along[vertex], map->along[vertex]};
    iccp_domain_facet_point(target, map->facet[vertex], bary, place);
}

static iccp_simplicial_map see(const void *map)
{
    const tended *t = map;
    return iccp_plmap_simplicial(t->map);
}

static void place(const void *map, const icc_domain *target, size_t point, double *place)
{
    const tended *t = map;
    iccp_target_place(t->map, target, point, place);
}

static icc_status mend(void *map, iccp_work *work, const iccp_env *env)
{
    const tended *t = map;
    return iccp_improve_moving(t->map, t->limits, 0, work, env);
}

icc_status iccp_move_targets(iccp_plmap *map, const icc_domain *target,
                             const iccp_mesh_limits *limits, size_t patience, iccp_work *work,
                             bool *reached, double *room, const iccp_env *env)
{
    static const iccp_continuation PLANE = {see, place, BLOCKED, mend};
    tended t = {map, limits};
    return iccp_continue(&PLANE, &t, target, patience, work, reached, room, env);
}
