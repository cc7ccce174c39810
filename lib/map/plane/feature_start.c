/* Makes a start between domains with features (docs/theory/features.md). Both domains are cut open
 * along their walls, and along paths that join the components in each face to a tree. That leaves
 * two polygons for each face whose corners correspond, which are overlaid as cages are
 * (map/compatible/overlay.c). Then the cuts are closed again. Different cuts of the target give
 * maps of different isotopy classes: they pass features on different sides. */
#include "map/plane/feature_start.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "map/compatible/coarsen.h"
#include "map/compatible/flips.h"
#include "map/compatible/overlay_start.h"
#include "map/compatible/points_and_images.h"
#include "map/compatible/triangle_quality.h"
#include "map/isotopy/close_cuts.h"
#include "map/isotopy/ties.h"
#include "map/plane/straight_start.h"

#include <math.h>
#include <string.h>

/* TREES: trees that are tried at most. COST: steps that a tree costs for each triangle of its
 * overlay. CROSSING: steps that each crossing of a cut and an edge costs, if the tree leads to no
 * map: about 40 searches come by. */
enum { TREES = 30, COST = 1, CROSSING = 40 };

/* No other tree is tried after one with energy GOOD or less. One with energy FAIR is enough if its
 * cuts are at most NEARLY_STRAIGHT times as long as straight ones. One whose cuts are straight on
 * both sides, up to rounding, is always enough, because no tree has shorter cuts. */
static const double GOOD = 8, FAIR = 100, NEARLY_STRAIGHT = 1.2, STRAIGHT = 1 + 1e-12;

/* Trees whose overlay has so many times the triangles of another one are hardly ever better, and
 * then by a tenth at most. */
static const double TOO_MANY = 3;

/* Steps on both sides of a start that is GOOD. */
static const iccp_descent DESCENT = {0, 10, 1e-3, 0.02, true};

/* The overlays of all pairs of polygons. */
typedef struct overlaying {
    const iccp_cut_polygons *polygons; /* of both sides */
    iccp_overlay *overlays;
    const iccp_env *env; /* without progress */
} overlaying;

static icc_status overlay_some(void *argument, size_t begin, size_t end)
{
    const overlaying *all = argument;
    icc_status status = ICC_OK;
    for (size_t q = begin; status == ICC_OK && q < end; ++q) {
        const iccp_ngon source = iccp_cut_polygon_ngon(&all->polygons[0], q);
        const iccp_ngon target = iccp_cut_polygon_ngon(&all->polygons[1], q);
        status = iccp_overlay_create(&all->overlays[q], iccp_cut_polygon_size(all->polygons, q),
                                     &source, &target, all->env);
    }
    return status;
}

/* Overlays the polygons of each face and closes the cuts. */
static icc_status overlay_polygons(iccp_plmap *map, const iccp_cut_polygons polygons[2],
                                   const iccp_domain_pair *scene, const iccp_env *env)
{
    const size_t n = polygons[0].n_polygons;
    const iccp_env quiet = iccp_quiet(env);
    overlaying all = {polygons, iccp_alloc_zero(&env->memory, n, sizeof *all.overlays), &quiet};
    if (all.overlays == NULL)
        return ICC_ERR_MEMORY;
    for (size_t q = 0; q < n; ++q)
        all.overlays[q].memory = env->memory;
    if (n == 1)
        all.env = env;
    icc_status status =
        n == 1 ? overlay_some(&all, 0, 1) : iccp_for_chunks(env, "mesh", n, 1, overlay_some, &all);
    if (status == ICC_OK)
        status = iccp_close_cuts(map, all.overlays, &polygons[0], scene, env);
    for (size_t q = 0; q < n; ++q)
        iccp_overlay_free(&all.overlays[q]);
    iccp_free(&env->memory, all.overlays);
    return status;
}

/* Makes the map of one tree of cuts, without relaxing it. Returns ICC_ERR_CERTIFICATE if rounding
 * spoils it. */
static icc_status start_from(iccp_plmap *map, const iccp_domain_pair *scene, const iccp_cuts *cuts,
                             const iccp_env *env)
{
    iccp_cut_polygons polygons[2] = {{.memory = env->memory}, {.memory = env->memory}};
    icc_status status = ICC_OK;
    for (int side = 0; status == ICC_OK && side < 2; ++side)
        status = iccp_cut_polygons_create(&polygons[side], scene, side, cuts, env);
    if (status == ICC_OK && !iccp_cut_polygons_same(&polygons[0], &polygons[1]))
        status = ICC_ERR_CERTIFICATE;
    if (status == ICC_OK)
        status = overlay_polygons(map, polygons, scene, env);
    if (status == ICC_OK && !iccp_plmap_is_positive(map))
        status = ICC_ERR_CERTIFICATE;
    for (int side = 0; side < 2; ++side)
        iccp_cut_polygons_free(&polygons[side]);
    if (status != ICC_OK)
        iccp_plmap_free(map);
    return status;
}

/* Whether a failure is final: no memory, or cancelled. After others, another tree may succeed. */
static bool is_lost(icc_status status)
{
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED;
}

/* Merges vertices, so that no more triangles are left than a start needs. */
static icc_status thin_out(iccp_plmap *map, const iccp_env *env)
{
    size_t n_gone;
    const icc_status status = iccp_cut_chords(map);
    return status == ICC_OK ? iccp_coarsen(map, ICCP_RISE, &n_gone, env) : status;
}

/* Returns the energy, or HUGE_VAL if a triangle has no area in doubles, or no finite energy. */
static double energy_of(const iccp_plmap *map)
{
    const uint32_t *v = map->corners.vertex;
    for (size_t t = 0; t < map->corners.n_triangles; ++t)
        if (!iccp_quality_is_sound(map, v[3 * t], v[3 * t + 1], v[3 * t + 2]))
            return HUGE_VAL;
    return iccp_plmap_energy(map);
}

/* ---- the limit of trees that lead to no map ---- */

/* Stops the search for cuts as soon as their crossings cost too much. Cuts around tangled features
 * can have any number of crossings, far more than doubles could tell apart. */
typedef struct watch {
    const iccp_cutter *cutter;
    double most; /* crossings */
    const iccp_env *env;
    bool is_over;
} watch;

static double count_crossings(const iccp_cutter *c)
{
    return (double)(c->search[0].n_vertices + c->search[1].n_vertices - 2 * c->domains->n);
}

static int32_t look(void *user, const char *stage, double share)
{
    watch *w = user;
    w->is_over = count_crossings(w->cutter) > w->most;
    return w->is_over || iccp_progress(w->env, stage, share) != ICC_OK;
}

/* Finds the cuts of a tree. Returns ICC_ERR_RESOLUTION if they cross too many edges. */
static icc_status find_cuts(iccp_cuts *cuts, iccp_cutter *cutter, uint64_t tree,
                            const iccp_work *vain, const iccp_env *env)
{
    watch w = {cutter, vain->left / CROSSING, env, false};
    const iccp_env watched = {.memory = env->memory, .user = &w, .progress = look, .threads = 1};
    const icc_status status = iccp_cuts_create(cuts, cutter, tree, &watched);
    return w.is_over && status == ICC_ERR_CANCELLED ? ICC_ERR_RESOLUTION : status;
}

/* ---- choosing a tree ---- */

/* Tries one tree: makes the start and its energy. The energy is HUGE_VAL if there is no start, or
 * if its overlay is too large. *least: the fewest triangles of all overlays so far. */
static icc_status try_tree(iccp_plmap *map, double *energy, size_t *least, iccp_cuts *cuts,
                           const iccp_domain_pair *scene, iccp_cutter *cutter, uint64_t tree,
                           iccp_allowance *work, const iccp_env *env)
{
    icc_status status = find_cuts(cuts, cutter, tree, &work->vain, env);
    *energy = HUGE_VAL;
    if (status == ICC_OK)
        status = start_from(map, scene, cuts, env);
    if (status != ICC_OK) {
        iccp_work_charge(&work->vain, CROSSING * count_crossings(cutter));
        return status;
    }
    const size_t n = map->corners.n_triangles;
    if (!iccp_work_take(&work->search, COST * n))
        work->search.left = 0;
    *least = n < *least ? n : *least;
    if ((double)n > TOO_MANY * (double)*least)
        return ICC_OK;
    status = thin_out(map, env);
    if (status == ICC_OK)
        *energy = energy_of(map);
    return status;
}

static double detour_of(const iccp_cuts *cuts, int side)
{
    return cuts->straight[side] > 0 ? cuts->length[side] / cuts->straight[side] : 1;
}

/* Finds the best start of several trees. Ends when one is good enough, or no work is left. */
static icc_status choose(iccp_plmap *map, const iccp_domain_pair *scene, iccp_cutter *cutter,
                         iccp_allowance *work, iccp_feature_report *report, const iccp_env *env)
{
    double best = HUGE_VAL;
    size_t least = SIZE_MAX;
    bool is_good = false;
    icc_status status = ICC_OK;
    const uint64_t n_trees = scene->n_cuts > 0 ? TREES : 1;
    for (uint64_t tree = 0;
         tree < n_trees && !is_good && work->search.left > 0 && work->vain.left > 0; ++tree) {
        iccp_cuts cuts = {.memory = env->memory};
        iccp_plmap other = {.memory = env->memory};
        double energy;
        const iccp_env part = iccp_round(env, (size_t)tree, 2);
        status = try_tree(&other, &energy, &least, &cuts, scene, cutter, tree, work, &part);
        if (status == ICC_OK) {
            const double detour = iccp_max(detour_of(&cuts, 0), detour_of(&cuts, 1));
            ++report->n_trees;
            is_good = energy <= GOOD || (energy <= FAIR && detour <= NEARLY_STRAIGHT) ||
                      (energy < HUGE_VAL && detour <= STRAIGHT);
            if (energy < best) {
                const iccp_plmap worse = *map;
                const iccp_cuts others = report->cuts;
                *map = other;
                other = worse;
                report->cuts = cuts;
                cuts = others;
                best = energy;
            }
        }
        iccp_cuts_free(&cuts);
        iccp_plmap_free(&other);
        if (is_lost(status))
            return status;
    }
    return best < HUGE_VAL ? ICC_OK : ICC_ERR_RESOLUTION;
}

/* Finds the best start without ties: one without bends, which no tree of cuts surpasses, or else
 * that of a tree. */
static icc_status search(iccp_plmap *map, const iccp_domain_pair *scene, iccp_allowance *work,
                         iccp_feature_report *report, const iccp_env *env)
{
    iccp_cutter cutter = {.memory = env->memory};
    bool found;
    icc_status status = iccp_straight_start(map, &report->cuts, &found, scene, &work->overlay, env);
    if (status == ICC_OK && found) {
        report->n_trees = 1;
        return thin_out(map, env);
    }
    iccp_plmap_free(map);
    if (status == ICC_OK)
        status = iccp_cutter_create(&cutter, scene, env);
    if (status == ICC_OK)
        status = choose(map, scene, &cutter, work, report, env);
    iccp_cutter_free(&cutter);
    return status;
}

/* Makes the start that has the class of the caller's ties. */
static icc_status start_from_ties(iccp_plmap *map, const iccp_domain_pair *scene,
                                  const icc_map_options *options, iccp_feature_report *report,
                                  const iccp_env *env, icc_error *err)
{
    icc_status status =
        iccp_ties_read(&report->cuts, scene, options->n_ties, options->ties, env, err);
    if (status != ICC_OK)
        return status;
    status = start_from(map, scene, &report->cuts, env);
    report->n_trees = 1;
    if (status == ICC_OK)
        status = thin_out(map, env);
    return is_lost(status) || status == ICC_OK ? status : ICC_ERR_RESOLUTION;
}

/* Relaxes a start. A GOOD one needs only flips and a few steps on both sides. Another one is
 * relaxed as an overlay is, which merges vertices, too. */
static icc_status relax(iccp_plmap *map, iccp_work *work, const iccp_env *env)
{
    size_t n_flips;
    iccp_improvement ignored = {0};
    if (iccp_plmap_energy(map) > GOOD)
        return iccp_overlay_relax(map, work, env);
    const icc_status status = iccp_flip_edges(map, &n_flips, env);
    return status == ICC_OK ? iccp_improve_points_and_images(map, &DESCENT, work, &ignored, env)
                            : status;
}

icc_status iccp_feature_start(iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                              const icc_map_options *options, iccp_allowance *work,
                              iccp_feature_report *report, const iccp_env *env, icc_error *err)
{
    iccp_domain_pair *scene = &report->scene;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    *map = (iccp_plmap){.memory = env->memory};
    *report = (iccp_feature_report){.cuts.memory = env->memory};
    icc_status status = iccp_domain_pair_create(scene, source, target, env);
    if (status == ICC_OK && options->ties != NULL)
        status = start_from_ties(map, scene, options, report, &part[0], err);
    else if (status == ICC_OK)
        status = search(map, scene, work, report, &part[0]);
    if (status == ICC_ERR_RESOLUTION)
        status = iccp_fail(err, status,
                           "no map was found: the features are too close together, or too "
                           "entangled, for double precision");
    return status == ICC_OK ? relax(map, &work->overlay, &part[1]) : status;
}

void iccp_feature_report_free(iccp_feature_report *report)
{
    iccp_cuts_free(&report->cuts);
    iccp_domain_pair_free(&report->scene);
}

icc_status iccp_feature_start_from(iccp_plmap *map, const icc_domain *source,
                                   const icc_domain *target, const iccp_cuts *cuts,
                                   iccp_work *relaxing, const iccp_env *env)
{
    iccp_domain_pair scene;
    *map = (iccp_plmap){.memory = env->memory};
    icc_status status = iccp_domain_pair_create(&scene, source, target, env);
    if (status == ICC_OK)
        status = start_from(map, &scene, cuts, env);
    iccp_domain_pair_free(&scene);
    if (status == ICC_OK)
        status = thin_out(map, env);
    if (status != ICC_OK)
        return is_lost(status) ? status : ICC_ERR_RESOLUTION;
    return relax(map, relaxing, env);
}
