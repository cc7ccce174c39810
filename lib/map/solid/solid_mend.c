/* V. Garanzha et al., Foldover-free maps in 50 lines of code, 2021, with two changes. First, each
 * tetrahedron is compared with one of the size that images have nearby. Otherwise a limb that
 * starts or ends tiny would have to change its volume a thousandfold, and epsilon would fall too
 * late for small tetrahedra. Second, points are added where images are stuck, because some would
 * have to see more of the boundary than any single place sees: docs/theory/solid-maps.md. */
#include "map/solid/solid_mend.h"

#include "base/minmax.h"
#include "geometry/simplices.h"
#include "map/energy/mesh_repair.h"
#include "map/energy/untangle.h"
#include "map/solid/solid_cuts.h"
#include "math/elementary.h"
#include "math/vec.h"

#include <string.h>

/* ROUNDS: rounds of adding points. They end earlier if more than one tetrahedron in FEW is
 * inverted, or if the number of tetrahedra has grown by MOST_GROWTH. */
enum { ROUNDS = 8, FEW = 20, MOST_GROWTH = 2 };

/* Limit on Newton steps, counted on the first mesh. */
static const double MOST_STEPS = 240;

/* How often sizes are averaged over neighbours. */
enum { MEANS = 3 };

/* A squared length below this share of others counts as 0. */
static const double NOTHING = 1e-30;

/* For each point, a sum over its tetrahedra and their number. */
typedef struct sums {
    double *of, *n;
} sums;

static void add_lengths(const iccp_simplicial_map *map, const sums *sum)
{
    const double stretch2 = map->stretch * map->stretch;
    memset(sum->of, 0, map->n_points * sizeof *sum->of);
    memset(sum->n, 0, map->n_points * sizeof *sum->n);
    for (size_t c = 0; c < 4 * map->n_simplices; ++c)
        for (size_t i = 1; i < 4; ++i) {
            const size_t v = map->corners[c], w = map->corners[c - c % 4 + (c + i) % 4];
            sum->of[v] += iccp_vec_distance2(3, map->images + 3 * v, map->images + 3 * w);
            sum->n[v] += stretch2 * iccp_vec_distance2(3, map->points + 3 * v, map->points + 3 * w);
        }
}

/* Averages logarithms, so that growing and shrinking weigh the same. */
static void smooth(const iccp_simplicial_map *map, double *growth, const sums *sum)
{
    memset(sum->of, 0, map->n_points * sizeof *sum->of);
    memset(sum->n, 0, map->n_points * sizeof *sum->n);
    for (size_t s = 0; s < map->n_simplices; ++s) {
        const uint32_t *v = map->corners + 4 * s;
        const double mean = 0.25 * (growth[v[0]] + growth[v[1]] + growth[v[2]] + growth[v[3]]);
        for (size_t k = 0; k < 4; ++k) {
            sum->of[v[k]] += mean;
            sum->n[v[k]] += 1;
        }
    }
    for (size_t v = 0; v < map->n_points; ++v)
        growth[v] = sum->n[v] > 0 ? sum->of[v] / sum->n[v] : 0;
}

/* Finds how much longer edges are after the map than before it, around each point. */
static icc_status find_growth(const iccp_simplicial_map *map, double *growth,
                              const iccp_memory *memory)
{
    const sums sum = {iccp_alloc(memory, map->n_points, sizeof *sum.of),
                      iccp_alloc(memory, map->n_points, sizeof *sum.n)};
    const icc_status status = sum.of != NULL && sum.n != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        add_lengths(map, &sum);
        for (size_t v = 0; v < map->n_points; ++v)
            growth[v] = sum.n[v] > 0
                            ? 0.5 * iccp_ln(iccp_max(sum.of[v], NOTHING * sum.n[v]) / sum.n[v])
                            : 0;
        for (int k = 0; k < MEANS; ++k)
            smooth(map, growth, &sum);
        for (size_t v = 0; v < map->n_points; ++v)
            growth[v] = iccp_exp(growth[v]);
    }
    iccp_free(memory, sum.of);
    iccp_free(memory, sum.n);
    return status;
}

static icc_status untangle(iccp_solid_map *map, size_t *n_left, iccp_work *work,
                           const iccp_env *env)
{
    iccp_simplicial_map simplicial = iccp_solid_simplicial(map);
    double *growth = iccp_alloc(&env->memory, simplicial.n_points, sizeof *growth);
    icc_status status =
        growth != NULL ? find_growth(&simplicial, growth, &env->memory) : ICC_ERR_MEMORY;
    simplicial.growth = growth;
    if (status == ICC_OK)
        status = iccp_untangle(&simplicial, work, n_left, env);
    iccp_free(&env->memory, growth);
    if (status == ICC_OK) {
        iccp_mesh_round(map->mesh, map->images);
        *n_left = iccp_simplicial_count_inverted(&simplicial);
    }
    return status;
}

static icc_status add_points(iccp_solid_map *map, size_t *n_cut)
{
    iccp_solid_edit edit;
    icc_status status = iccp_solid_edit_create(&edit, map);
    if (status == ICC_OK)
        status = iccp_solid_halve_inverted(&edit, n_cut);
    iccp_solid_edit_free(&edit);
    return status;
}

icc_status iccp_solid_mend(iccp_solid_map *map, const icc_domain *source, size_t *n_left,
                           const iccp_env *env)
{
    const size_t most = MOST_GROWTH * map->mesh->n_simplices;
    iccp_work work = {.left = MOST_STEPS * (double)map->mesh->n_simplices};
    icc_status status = ICC_OK;
    for (size_t k = 0; status == ICC_OK; ++k) {
        const iccp_env part = iccp_round(env, k, 1);
        size_t n_cut = 0;
        status = untangle(map, n_left, &work, &part);
        if (status != ICC_OK || *n_left == 0 || k == ROUNDS ||
            *n_left > map->mesh->n_simplices / FEW || map->mesh->n_simplices > most)
            break;
        iccp_log(env, "%zu tetrahedra cannot be repaired: points are added", *n_left);
        status = add_points(map, &n_cut);
        if (n_cut == 0)
            break;
    }
    return status == ICC_OK ? iccp_solid_check(map, source, env) : status;
}
