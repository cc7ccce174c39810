/* Triangles that carry far more energy than others are about to lock: what they hold between them
 * cannot move on, however much room there is round about. So edges are cut there, which gives a map
 * more freedom; edges flip where that lowers the energy; and near by, points and images move by
 * turns. Where it has become finer than it needs to be, the mesh is made coarse again. */
#include "map/tend.h"

#include "map/coarsen.h"
#include "map/descent.h"
#include "map/dirichlet.h"
#include "map/flips.h"

#include <stdlib.h>
#include <string.h>
static double P(const char *name, double d) { const char *s = getenv(name); return s ? atof(s) : d; }

/* Energy over area, of which an isometry has 4: what is more than this is tense. */
#define TENSE P("HIGH", 50)

static double tense;
#undef TENSE
#define TENSE tense
/* No edge is cut that is shorter than this share of the longest that there may be. */
#define SHORTEST P("SHORT", 0.05)

/* Points move as far as so many triangles away from tense ones. */
#define RINGS (int)P("RINGS", 3)

/* With more triangles than this, vertices merge where the energy near by rises by no more than a
 * share. */
#define MANY (size_t)P("MANY", 2000)
#define RISE P("RISE", 0.02)

#define ROUNDS (int)P("ROUNDS",1)

static double density_of(const iccp_simplicial_map *map, size_t triangle)
{
    const double *image[3];
    double element[ICCP_ELEMENT(2)];
    iccp_simplicial_images(2, map, triangle, image);
    iccp_simplicial_element(map, triangle, element);
    return iccp_dirichlet_energy2(element, image) / element[0];
}

/* The corner that faces the longest edge. */
static uint32_t longest_of(const iccp_plmap *map, uint32_t triangle, double *length2)
{
    const uint32_t *v = map->corners.vertex;
    uint32_t best = 3 * triangle;
    *length2 = -1;
    for (uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
        const double own = iccp_plmap_length2(map, v[iccp_after(c)], v[iccp_before(c)]);
        if (own > *length2) {
            *length2 = own;
            best = c;
        }
    }
    return best;
}

static icc_status cut_tense(iccp_plmap *map, double shortest, size_t *n_tense)
{
    const size_t n = map->corners.n_triangles;
    icc_status status = ICC_OK;
    *n_tense = 0;
    for (uint32_t t = 0; status == ICC_OK && t < n; ++t) {
        const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
        bool done;
        double length2;
        if (!(density_of(&simplicial, t) > TENSE))
            continue;
        const uint32_t corner = longest_of(map, t, &length2);
        *n_tense += length2 > shortest * shortest;
        if (length2 > shortest * shortest)
            status = iccp_plmap_cut(map, corner, &done);
    }
    return status;
}

/* Marks what is to stay: all that is fixed or far from tense triangles. */
static void mark_still(const iccp_plmap *map, uint8_t *still)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    const uint32_t *v = map->corners.vertex;
    const size_t n = map->corners.n_triangles;
    memset(still, 1 + RINGS, map->n_vertices);
    for (size_t t = 0; t < n; ++t)
        if (density_of(&simplicial, t) > 0.5 * TENSE)
            still[v[3 * t]] = still[v[3 * t + 1]] = still[v[3 * t + 2]] = 0;
    for (uint8_t ring = 0; ring < RINGS; ++ring)
        for (size_t c = 0; c < 3 * n; ++c)
            if (still[v[c]] == ring)
                for (size_t k = 0; k < 3; ++k) {
                    uint8_t *other = &still[v[c - c % 3 + k]];
                    *other = *other > ring + 1 ? (uint8_t)(ring + 1) : *other;
                }
    for (size_t i = 0; i < map->n_vertices; ++i)
        still[i] = map->fixed[i] != ICCP_FREE || still[i] > RINGS;
}

/* Both sides of what is not still, by turns. */
static icc_status relax(iccp_plmap *map, const uint8_t *still, iccp_work *work,
                        const iccp_env *env)
{
    icc_status status = ICC_OK;
    const iccp_descent RELAXATION = {0, (size_t)P("STEPS",1), 1e-2, 0, false};
    for (int side = 0; side < 2; ++side) {
        iccp_plmap_swap(map);
        iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
        iccp_improvement ignored = {0};
        simplicial.fixed = still;
        if (status == ICC_OK)
            status = iccp_improve_images(&simplicial, &RELAXATION, work, &ignored, env);
    }
    return status;
}

icc_status iccp_tend(iccp_plmap *map, double longest, iccp_work *work, bool *changed,
                     const iccp_env *env)
{
    tense = P("HIGH", 50); { double m = P("REL",0) * iccp_plmap_energy(map); if (m > tense) tense = m; }
    *changed = false;
    bool any = false;
    const iccp_simplicial_map now = iccp_plmap_simplicial(map);
    for (uint32_t t = 0; t < map->corners.n_triangles && !any; ++t)
    {   double l2; if (density_of(&now, t) > tense * P("TRIG", 1)) { (void)longest_of(map, t, &l2); any = l2 > SHORTEST*SHORTEST*longest*longest; } }
    if (!any) return ICC_OK;
    size_t n_tense = 1, n_flips, n_gone;
    icc_status status = ICC_OK;
    *changed = false;
    for (int round = 0; status == ICC_OK && n_tense > 0 && round < ROUNDS; ++round) {
        status = cut_tense(map, SHORTEST * longest, &n_tense);
        if (status != ICC_OK || n_tense == 0)
            break;
        *changed = true;
        map->plan = NULL;
        status = iccp_flip_edges(map, &n_flips, env);
        if (status == ICC_OK && map->corners.n_triangles > MANY)
            status = iccp_coarsen_within(map, RISE, longest, &n_gone, env);
        uint8_t *still = iccp_alloc(&env->memory, map->n_vertices, 1);
        if (still == NULL)
            return ICC_ERR_MEMORY;
        mark_still(map, still);
        if (status == ICC_OK)
            status = relax(map, still, work, env);
        iccp_free(&env->memory, still);
    }
    return status;
}
