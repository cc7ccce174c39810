/* Improves a map in levels: docs/theory/solid-maps.md. A refinement is made on a copy of the mesh.
 * The copy replaces the mesh once it is certified. */
#include "map/solid/solid_improve.h"

#include "map/solid/solid_cuts.h"
#include "map/solid/solid_flips.h"

#include <string.h>

/* A refinement that gains less than this does not count. Little can be gained in space, because the
 * boundary is close everywhere. */
static const double LEAST_GAIN = 2e-3;

typedef struct improved {
    iccp_solid_map *map;
    const icc_domain *source;
} improved;

static size_t count(const void *map)
{
    const improved *m = map;
    return m->map->mesh->n_simplices;
}

static double energy_of(const void *map, const iccp_env *env)
{
    const improved *m = map;
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(m->map);
    return iccp_simplicial_energy_at_once(&simplicial, env);
}

static icc_status descend(void *map, const iccp_descent *descent, bool moves_points,
                          iccp_newton *newton, iccp_work *work, iccp_improvement *improvement,
                          const iccp_env *env)
{
    const improved *m = map;
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(m->map);
    (void)moves_points;
    return iccp_improve_images(&simplicial, descent, newton, work, improvement, env);
}

icc_status iccp_solid_copy(iccp_solid_map *copy, const iccp_solid_map *map)
{
    const size_t n = 3 * map->mesh->n_points;
    copy->images = iccp_alloc(&copy->memory, n, sizeof *copy->images);
    if (copy->images == NULL || iccp_simplices_copy(&copy->own, map->mesh, &copy->memory) != ICC_OK)
        return ICC_ERR_MEMORY;
    memcpy(copy->images, map->images, n * sizeof *copy->images);
    copy->mesh = copy->own;
    return ICC_OK;
}

/* Flips before the cuts, which would make these flips impossible, and again after them. */
static icc_status change(iccp_solid_map *map, const icc_domain *source, bool cuts,
                         size_t *n_changes, const iccp_env *env)
{
    iccp_solid_edit edit;
    size_t n[4] = {0};
    icc_status status = iccp_solid_edit_create(&edit, map, source);
    if (status == ICC_OK)
        status = iccp_solid_flip(&edit, &n[0], env);
    if (status == ICC_OK && cuts)
        status = iccp_solid_halve_chords(&edit, &n[1]);
    if (status == ICC_OK && cuts)
        status = iccp_solid_halve_worst(&edit, &n[2]);
    if (status == ICC_OK && cuts)
        status = iccp_solid_flip(&edit, &n[3], env);
    *n_changes = n[0] + n[1] + n[2] + n[3];
    iccp_solid_edit_free(&edit);
    return status;
}

static icc_status certify(iccp_solid_map *map, const icc_domain *source, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    return iccp_simplicial_count_at_once(&simplicial, env) > 0 ? ICC_ERR_CERTIFICATE
                                                               : iccp_solid_check(map, source, env);
}

static void exchange(iccp_solid_map *a, iccp_solid_map *b)
{
    const iccp_solid_map other = *a;
    *a = *b;
    *b = other;
}

icc_status iccp_solid_refine(iccp_solid_map *map, const icc_domain *source, bool cuts,
                             size_t *n_changes, const iccp_env *env)
{
    iccp_solid_map next = {.memory = map->memory, .stretch = map->stretch};
    const iccp_simplicial_map now = iccp_solid_simplicial(map);
    icc_status status = iccp_solid_copy(&next, map);
    if (status == ICC_OK)
        status = change(&next, source, cuts, n_changes, env);
    if (status == ICC_OK && *n_changes > 0) {
        status = certify(&next, source, env);
        const iccp_simplicial_map then = iccp_solid_simplicial(&next);
        if (status == ICC_OK && iccp_simplicial_energy_at_once(&then, env) <=
                                    (1 + 1e-12) * iccp_simplicial_energy_at_once(&now, env))
            exchange(map, &next);
        else
            *n_changes = 0;
    }
    iccp_simplices_free(next.own);
    iccp_free(&next.memory, next.images);
    return status == ICC_ERR_CERTIFICATE ? ICC_OK : status;
}

static icc_status refine(void *map, size_t *n_changes, const iccp_env *env)
{
    const improved *m = map;
    return iccp_solid_refine(m->map, m->source, true, n_changes, env);
}

icc_status iccp_solid_improve(iccp_solid_map *map, const icc_domain *source,
                              const iccp_schedule *schedule, iccp_work *work,
                              iccp_improvement *improvement, const iccp_env *env)
{
    static const iccp_profile SPACE = {.least_gain = LEAST_GAIN,
                                       .count = count,
                                       .energy = energy_of,
                                       .descend = descend,
                                       .refine = refine};
    improved m = {map, source};
    return iccp_improve_by(&SPACE, &m, schedule, work, improvement, env);
}
