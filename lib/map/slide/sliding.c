/* Lets the chains of a map's features slide.
 *
 * Each round proposes a slide from the best map, and makes a map between the domains with its
 * knots. The first round makes chains correspond by their lengths, which is a good guess where
 * their vertices are spaced differently. Later rounds follow Newton's steps. If the new map is no
 * better, the next round goes half as far. The energy of the finished map decides, so the result is
 * never worse than the map without sliding. */
#include "map/slide/sliding.h"

#include "base/clock.h"
#include "base/error.h"
#include "map/plane/plane_kind.h"
#include "map/slide/added_vertices.h"
#include "map/slide/slide_step.h"

#include <math.h>
#include <string.h>

/* The most rounds. On letters with bars whose outlines slide, the last of them still gain a
 * little. */
enum { ROUNDS = 12 };

/* A round that gains no more than this share of the energy above an isometry's (4) is in vain. */
static const double LEAST_GAIN = 1e-3;

typedef struct sliding {
    icc_map *map;      /* the best so far */
    iccp_slide *slide; /* its slide */
    uint8_t *is_held;  /* by given vertex: 1 at the ends of ties */
    const icc_map_options *options;
    iccp_map_maker maker;
} sliding;

/* Whether an attempt failed for good. Any other failure only means that its map is not there. */
static bool is_lost(icc_status status)
{
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED;
}

/* Makes a map between the domains with the knots of a slide. Ties get the numbers of these
 * domains. */
static icc_status make(icc_map **out, const sliding *s, const iccp_slide *slide,
                       const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    icc_domain *domain[2] = {NULL, NULL};
    iccp_added_vertices added = {.memory = *memory};
    icc_map_options options = *s->options;
    icc_tie *ties = iccp_alloc(memory, options.n_ties, sizeof *ties);
    icc_status status =
        ties != NULL ? iccp_added_vertices_create(&added, slide, memory) : ICC_ERR_MEMORY;
    for (size_t i = 0; status == ICC_OK && options.ties != NULL && i < options.n_ties; ++i) {
        ties[i] = options.ties[i];
        for (int end = 0; end < 2; ++end)
            ties[i].vertex[end] = added.vertex[ties[i].vertex[end]];
    }
    options.ties = options.ties != NULL ? ties : NULL;
    const iccp_env quiet = iccp_quiet(env);
    for (int side = 0; status == ICC_OK && side < 2; ++side)
        status = iccp_domain_with_knots(&domain[side], slide, side, &quiet, NULL);
    if (status == ICC_OK)
        status = s->maker(out, domain[0], domain[1], &options, env, NULL);
    iccp_domain_release(domain[0]);
    iccp_domain_release(domain[1]);
    iccp_added_vertices_free(&added);
    iccp_free(memory, ties);
    return status;
}

typedef enum outcome { NOTHING_SLIDES, IN_VAIN, GAIN } outcome;

/* Makes the map of a proposal. If it is better than the best so far, it replaces that. */
static icc_status attempt(sliding *s, const iccp_slide_request *request, outcome *result,
                          const iccp_env *env)
{
    const double before = s->map->info.energy;
    iccp_slide *slide = NULL;
    icc_map *map = NULL;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 6}, env);
    icc_status status =
        iccp_slide_propose(&slide, s->slide, &iccp_plane_of(s->map)->pl, request, &part[0]);
    *result = slide != NULL ? IN_VAIN : NOTHING_SLIDES;
    if (status == ICC_OK && slide != NULL)
        status = make(&map, s, slide, &part[1]);
    if (slide != NULL)
        iccp_log(env, "sliding: energy %g, so far %g", map != NULL ? map->info.energy : HUGE_VAL,
                 before);
    if (map != NULL && map->info.energy < before - LEAST_GAIN * (before - 4)) {
        icc_map *const worse = s->map;
        iccp_slide *const old = s->slide;
        *result = GAIN;
        s->map = map;
        s->slide = slide;
        map = worse;
        slide = old;
    }
    iccp_map_release(map);
    iccp_slide_free(slide);
    return is_lost(status) ? status : ICC_OK;
}

/* Takes rounds until a whole step and then half a step are in vain. */
static icc_status take_rounds(sliding *s, const iccp_env *env)
{
    iccp_slide_request request = {.way = ICCP_SLIDE_EVENLY,
                                  .share = 1,
                                  .moves_rim = s->options->slide == ICC_SLIDE_ALL,
                                  .is_held = s->is_held};
    icc_status status = ICC_OK;
    outcome result = IN_VAIN;
    for (size_t k = 0; status == ICC_OK && k < ROUNDS && result != NOTHING_SLIDES; ++k) {
        const iccp_env part = iccp_round(env, k, 4);
        status = attempt(s, &request, &result, &part);
        if (request.way == ICCP_SLIDE_DOWN && result == IN_VAIN && request.share < 1)
            break;
        request.share = request.way == ICCP_SLIDE_DOWN && result == IN_VAIN ? 0.5 : 1;
        request.way = ICCP_SLIDE_DOWN;
    }
    return status;
}

/* Holds the ends of ties, and the circles around points, which do not turn. */
static icc_status hold(sliding *s, const icc_domain *source, const iccp_memory *memory)
{
    s->is_held = iccp_alloc_zero(memory, source->n_vertices, 1);
    if (s->is_held == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; s->options->ties != NULL && i < s->options->n_ties; ++i)
        for (int end = 0; end < 2; ++end)
            s->is_held[s->options->ties[i].vertex[end]] = 1;
    for (size_t f = 0; f < source->features->n; ++f) {
        const iccp_feature *feature = &source->features->item[f];
        if (feature->rim_of != UINT32_MAX)
            memset(s->is_held + feature->first, 1, feature->n);
    }
    return ICC_OK;
}

icc_status iccp_map_create_sliding(icc_map **out, const icc_domain *source,
                                   const icc_domain *target, const icc_map_options *options,
                                   iccp_map_maker maker, const iccp_env *env, icc_error *err)
{
    const double begin = iccp_seconds();
    sliding s = {.options = options, .maker = maker};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    icc_status status = maker(&s.map, source, target, options, &part[0], err);
    if (status == ICC_OK)
        status = iccp_slide_create(&s.slide, source, target, &env->memory);
    if (status == ICC_OK)
        status = hold(&s, source, &env->memory);
    if (status == ICC_OK)
        status = take_rounds(&s, &part[1]);
    iccp_free(&env->memory, s.is_held);
    if (status != ICC_OK) {
        iccp_map_release(s.map);
        iccp_slide_free(s.slide);
        return iccp_explain(err, status);
    }
    if (iccp_slide_count(s.slide) > 0)
        iccp_map_set_slide(s.map, s.slide);
    else
        iccp_slide_free(s.slide);
    s.map->info.seconds = iccp_seconds() - begin;
    *out = s.map;
    return ICC_OK;
}

void iccp_map_set_slide(icc_map *map, iccp_slide *slide)
{
    map->slide = slide;
    map->info.n_slid = iccp_slide_count(slide);
}

icc_status iccp_map_keep_slide(icc_map *next, const icc_map *map, const icc_domain *target)
{
    iccp_slide *slide;
    if (map->slide == NULL)
        return ICC_OK;
    const icc_status status = iccp_slide_copy(
        &slide, map->slide, target != NULL ? target : map->slide->given[1], &next->memory);
    if (status == ICC_OK)
        iccp_map_set_slide(next, slide);
    return status;
}

icc_status iccp_slide_given_tie(const iccp_slide *slide, icc_tie_info *info)
{
    const uint32_t none = UINT32_MAX, end[2] = {info->vertex[0], info->vertex[1]};
    iccp_added_vertices added;
    const icc_status status = iccp_added_vertices_create(&added, slide, &slide->memory);
    if (status != ICC_OK)
        return status;
    info->vertex[0] = info->vertex[1] = none;
    for (uint32_t v = 0; v < slide->given[0]->n_vertices; ++v) {
        const uint32_t knot = added.knot[added.vertex[v]];
        for (int k = 0; k < 2; ++k)
            if (added.vertex[v] == end[k] && (knot == none || iccp_knot_stays(&slide->knot[knot])))
                info->vertex[k] = v;
    }
    iccp_added_vertices_free(&added);
    return info->vertex[0] != none && info->vertex[1] != none ? ICC_OK : ICC_ERR_UNSUPPORTED;
}
