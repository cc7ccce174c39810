/* A chain of targets: docs/theory/solid-maps.md. The source's mesh is mapped to itself. Then its
 * images follow a motion (feature_motion.h) in which features are small where they go far. */
#include "map/solid/solid_chain.h"

#include "base/clock.h"
#include "base/minmax.h"
#include "fill/fill_domain.h"
#include "map/energy/singular.h"
#include "map/solid/feature_motion.h"
#include "map/solid/solid_follow.h"
#include "map/solid/solid_improve.h"
#include "math/elementary.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* The least size of features, and the shortest step as a share of a stage. */
static const double LEAST = 1.0 / 32;

/* The most steps of a chain. */
enum { MOST_STEPS = 30 };

/* Limit on the tetrahedra of a mesh that gets finer where the way is blocked, as a multiple of the
 * source's. */
static const double MOST_GROWTH = 4;

/* Most rounds of flips after a step. */
enum { CARE_ROUNDS = 3 };

typedef struct chain {
    const icc_domain *source, *target;
    icc_domain *body[2];  /* the outer surfaces alone, the source's filled */
    iccp_solid_map *bare; /* the map of the bodies */
    iccp_feature_motion motion;
    iccp_solid_map *map; /* the source's mesh to `at` */
    icc_domain *at;
    size_t n_steps;
} chain;

/* ---- the bodies without features ---- */

static icc_status make_body(icc_domain **body, const icc_domain *solid, bool fill,
                            const iccp_env *env)
{
    icc_domain *surface;
    icc_status status =
        iccp_domain_create(&surface, 3, solid->features->n_outer, solid->given,
                           solid->features->n_outer_facets, solid->facets, env, NULL);
    if (status == ICC_OK && fill) {
        status = iccp_domain_fill_for_map(body, surface, env, NULL);
        iccp_domain_release(surface);
    } else if (status == ICC_OK)
        *body = surface;
    return status;
}

/* Finds where the body of the source has a point of the target, and how it is turned there. */
static icc_status carry_back(const chain *c, const double *point, iccp_carrier *carrier)
{
    const iccp_frame *from = &c->body[0]->frame, *to = &c->body[1]->frame;
    double local[3], image[3], jacobian[9], cofactor[9];
    iccp_singular s;
    iccp_frame_in(to, 3, point, local);
    const icc_status status = iccp_solid_map_point(c->bare, true, local, image, jacobian);
    if (status != ICC_OK)
        return status;
    iccp_frame_out(from, 3, image, carrier->from);
    iccp_singular_find(3, jacobian, &s);
    for (int k = 0; k < 9; ++k)
        carrier->rotation[k] = s.v[0][k / 3] * s.u[0][k % 3] + s.v[1][k / 3] * s.u[1][k % 3] +
                               s.v[2][k / 3] * s.u[2][k % 3];
    iccp_cofactors(3, jacobian, cofactor);
    carrier->scale = to->out[0] * to->out[1] / (from->out[0] * from->out[1]) /
                     iccp_cbrt(iccp_vec_dot(3, jacobian, cofactor));
    return ICC_OK;
}

static icc_status plan(chain *c, const iccp_env *env)
{
    const size_t n = c->source->features->n;
    iccp_carrier *carriers = iccp_alloc(&env->memory, n, sizeof *carriers);
    icc_status status = carriers != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t f = 0; status == ICC_OK && f < n; ++f) {
        double centre[3];
        iccp_feature_centre(c->target, f, centre);
        status = carry_back(c, centre, &carriers[f]);
    }
    if (status == ICC_OK)
        status =
            iccp_feature_motion_create(&c->motion, c->source, c->target, carriers, &env->memory);
    iccp_free(&env->memory, carriers);
    return status;
}

/* ---- steps ---- */

static void arrive(chain *c, iccp_solid_map *map, icc_domain *at)
{
    iccp_solid_map_free(c->map);
    iccp_domain_release(c->at);
    c->map = map;
    c->at = at;
}

static bool may_grow(const chain *c)
{
    return (double)c->map->mesh->n_simplices < MOST_GROWTH * (double)c->source->mesh->n_simplices;
}

/* Keeps the mesh healthy: flips, then a few steps, as long as there is something to flip. With
 * `cuts` it also gets finer. */
static icc_status care(chain *c, bool cuts, const iccp_env *env)
{
    static const icc_improve_options FEW_STEPS = {.iterations = 4, .levels = -1, .tolerance = 1e-2};
    const iccp_env quiet = iccp_quiet(env);
    icc_status status = ICC_OK;
    size_t n_changes = 1;
    iccp_facet_tree_free(&c->map->before, &c->map->memory);
    iccp_facet_tree_free(&c->map->after, &c->map->memory);
    for (int k = 0; status == ICC_OK && n_changes > 0 && k < CARE_ROUNDS; ++k) {
        iccp_map_facts facts = {0};
        status = iccp_solid_refine(c->map, c->source, cuts && k == 0, &n_changes, &quiet);
        if (status == ICC_OK && n_changes > 0)
            status = iccp_solid_map_relax(c->map, c->source, &FEW_STEPS, &facts, &quiet);
    }
    return status;
}

/* Moves on to a time of a stage. *done is false if that is not possible in one step. */
static icc_status step(chain *c, iccp_motion_stage stage, double time, bool *done,
                       const iccp_env *env)
{
    static const char *const NAMES[ICCP_MOTION_STAGES] = {"shrink", "move",
                                                          "go along with the surface", "grow"};
    const iccp_env quiet = iccp_quiet(env);
    iccp_map_facts facts = {0};
    iccp_solid_map *map = NULL;
    icc_domain *at;
    size_t vertex;
    *done = false;
    icc_status status = iccp_feature_waypoint(&at, &c->motion, stage, time, &quiet);
    if (status != ICC_OK || at == NULL)
        return status;
    ++c->n_steps;
    status = iccp_solid_map_follow(&map, c->map, c->source, c->at, at, 0, &facts, &vertex, env);
    iccp_log(env, "features %s, %g of the way: %s", NAMES[stage], time,
             map != NULL ? "done" : "blocked");
    *done = map != NULL;
    if (*done)
        arrive(c, map, at);
    else
        iccp_domain_release(at);
    return status;
}

/* Goes through a stage. A step that fails is halved. */
static icc_status go(chain *c, iccp_motion_stage stage, bool *done, const iccp_env *env)
{
    double time = 0, length = 1;
    icc_status status = ICC_OK;
    for (size_t k = 0; status == ICC_OK && time < 1 && length >= LEAST && c->n_steps < MOST_STEPS;
         ++k) {
        const iccp_env part = iccp_round(env, k, 4);
        const double next = iccp_min(1, time + length);
        bool moved;
        status = step(c, stage, next, &moved, &part);
        time = moved ? next : time;
        if (status == ICC_OK)
            status = care(c, !moved && may_grow(c), &part);
        length = moved ? length : length / 2;
    }
    *done = time == 1;
    return status;
}

/* Begins with the map of the mesh to itself. */
static icc_status set_out(chain *c, const iccp_solid_map *start)
{
    iccp_solid_map *map;
    const icc_status status =
        iccp_solid_map_copy(&map, start, c->source, c->source, &start->memory);
    if (status != ICC_OK)
        return status;
    memcpy(map->images, map->mesh->points, 3 * map->mesh->n_points * sizeof *map->images);
    arrive(c, map, iccp_domain_retain(c->source));
    return ICC_OK;
}

/* Follows the motion with features of one size. */
static icc_status travel(chain *c, const iccp_solid_map *start, bool *done, const iccp_env *env)
{
    iccp_env part[ICCP_MOTION_STAGES];
    icc_status status = set_out(c, start);
    iccp_split(part, ICCP_MOTION_STAGES, (const double[]){1, 2, 1, 1}, env);
    *done = true;
    for (int stage = 0; status == ICC_OK && *done && stage < ICCP_MOTION_STAGES; ++stage)
        status = go(c, (iccp_motion_stage)stage, done, &part[stage]);
    return status;
}

/* ---- all of it ---- */

/* Makes features smaller until there seems to be room for their ways. Returns false if they cannot
 * become smaller. */
static bool shrink(chain *c)
{
    double room;
    do {
        c->motion.scale /= 2;
        room = iccp_feature_motion_bend(&c->motion, c->body[0]);
    } while (room <= 0 && c->motion.scale > LEAST);
    return c->motion.scale >= LEAST;
}

/* Makes features smaller until they arrive. Points cannot become smaller. */
static icc_status arrive_at_last(chain *c, const iccp_solid_map *start, bool *done,
                                 const iccp_env *env)
{
    const iccp_features *features = c->source->features;
    icc_status status = ICC_OK;
    size_t k = 0;
    *done = false;
    do {
        const iccp_env part = iccp_round(env, k++, 2);
        if (!shrink(c))
            break;
        iccp_log(env, "features move at %g of their size", c->motion.scale);
        status = travel(c, start, done, &part);
    } while (status == ICC_OK && !*done && features->n_points < features->n &&
             c->n_steps < MOST_STEPS);
    return status;
}

static icc_status map_bodies(chain *c, const iccp_env *env)
{
    const iccp_env quiet = iccp_quiet(env);
    iccp_map_facts facts = {0};
    icc_status status = make_body(&c->body[0], c->source, true, &quiet);
    if (status == ICC_OK)
        status = make_body(&c->body[1], c->target, false, &quiet);
    if (status == ICC_OK)
        status = iccp_solid_map_create(&c->bare, c->body[0], c->body[1], 0, &facts, env);
    return status;
}

static bool is_fatal(icc_status status)
{
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED;
}

static icc_status find(chain *c, const iccp_solid_map *start, bool *done, const iccp_env *env)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 3}, env);
    icc_status status = map_bodies(c, &part[0]);
    if (status == ICC_OK && c->bare != NULL)
        status = plan(c, env);
    if (status == ICC_OK && c->bare != NULL)
        status = arrive_at_last(c, start, done, &part[1]);
    if (status == ICC_OK && *done)
        status = iccp_solid_own(c->map);
    *done = *done && status == ICC_OK;
    return is_fatal(status) ? status : ICC_OK;
}

icc_status iccp_solid_chain(iccp_solid_map *map, iccp_direction way, iccp_map_facts *info,
                            const iccp_env *env)
{
    const double began = iccp_seconds();
    chain c = {.source = way.source, .target = way.target};
    bool done = false;
    if (way.source->features == NULL)
        return ICC_OK;
    const icc_status status = find(&c, map, &done, env);
    if (done) {
        iccp_solid_take(map, c.map->own, c.map->images);
        c.map->own = NULL;
        c.map->images = NULL;
        info->n_unrepaired = 0;
    }
    iccp_solid_map_free(c.map);
    iccp_domain_release(c.at);
    iccp_feature_motion_free(&c.motion);
    iccp_solid_map_free(c.bare);
    iccp_domain_release(c.body[0]);
    iccp_domain_release(c.body[1]);
    info->seconds_repair += iccp_seconds() - began;
    return status;
}
