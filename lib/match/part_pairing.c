/* Pairs outlines part by part. Shapes decide first. An affine map is then fitted to the outlines
 * that shapes have paired, and to the centres of the other parts. This map of the whole places each
 * part, whose outline is then paired with the nearest places of its partner's outline. Parts that
 * shapes leave open, such as the round dot of an i, are always paired in this way. The others are
 * paired so if the result is clearly better. */
#include "match/part_pairing.h"

#include "base/error.h"
#include "base/threads.h"
#include "match/mean_value.h"
#include "match/outline/landmarks.h"
#include "match/outline/ring_pairing.h"
#include "match/part_partners.h"
#include "match/plane_affine.h"
#include "math/elementary.h"

#include <string.h>

#define NONE ICCP_NO_FEATURE

typedef struct pairing {
    iccp_paired_parts *out;
    const iccp_sorted_landmarks *landmarks;
    const icc_match_options *options;
    iccp_plane_affine whole;
    iccp_env env;     /* of one part */
    icc_error *error; /* of each part */
} pairing;

static icc_status reserve(pairing *p, const iccp_memory *memory, icc_error *err)
{
    iccp_paired_parts *const out = p->out;
    const size_t n = out->parts[0].n, n_vertices = out->domain[0]->n_vertices;
    out->pair = iccp_alloc_zero(memory, n, sizeof *out->pair);
    out->moved = iccp_alloc(memory, n_vertices, 2 * sizeof *out->moved);
    p->error = iccp_alloc_zero(memory, n, sizeof *p->error);
    if (out->pair == NULL || out->moved == NULL || p->error == NULL)
        return iccp_fail_memory(err);
    for (size_t k = 0; k < n; ++k)
        p->error[k].size = sizeof *p->error;
    memcpy(out->moved, out->domain[0]->vertices, 2 * n_vertices * sizeof *out->moved);
    return ICC_OK;
}

/* ---- partners ---- */

/* The landmarks say which parts belong together, or else the assignment. */
static icc_status find_partners(pairing *p, const iccp_env *env, icc_error *err)
{
    iccp_paired_parts *const out = p->out;
    const iccp_domain_parts *const parts = out->parts;
    uint32_t *const partner = iccp_alloc(&env->memory, parts[0].n, sizeof *partner);
    if (partner == NULL)
        return iccp_fail_memory(err);
    for (size_t k = 0; k < parts[0].n; ++k)
        partner[k] = NONE;
    for (size_t k = 0; k < p->landmarks->n; ++k) {
        const uint32_t *const feature = p->landmarks->item[k].feature;
        partner[iccp_part_of(&parts[0], feature[0])] = iccp_part_of(&parts[1], feature[1]);
    }
    const icc_status status =
        iccp_parts_partner(partner, out->domain, parts, iccp_least_sure(p->options), env, err);
    for (size_t k = 0; k < parts[0].n; ++k)
        out->pair[k].partner = partner[k];
    iccp_free(&env->memory, partner);
    return status;
}

/* ---- by shape ---- */

static icc_status create_outline(iccp_outline *outline, const icc_domain *domain, uint32_t ring,
                                 const iccp_memory *memory, icc_error *err)
{
    return ring == NONE ? iccp_outline_create(outline, domain, memory, err)
                        : iccp_explain(err, iccp_outline_create_feature(outline, domain, ring,
                                                                        false, memory));
}

/* Pairs a part through its landmarks. number, given, shares: room for all landmarks. */
static icc_status pair_through(const pairing *p, size_t part, size_t *number, double *given,
                               double *shares, const iccp_env *env, icc_error *err)
{
    const iccp_paired_parts *const out = p->out;
    iccp_part_pair *const pair = &out->pair[part];
    icc_error own = {.size = sizeof own};
    const size_t n = iccp_landmarks_on(p->landmarks, out->parts[0].part[part].ring, number, given);
    icc_status status = iccp_landmarks_place(shares, n, given, number, &pair->outline[0],
                                             &pair->outline[1], &env->memory, err);
    if (status != ICC_OK)
        return status;
    status = iccp_pair_rings(&pair->common, &pair->report, &pair->outline[0], &pair->outline[1], n,
                             shares, p->options, env, &own);
    pair->is_placed = status == ICC_ERR_AMBIGUOUS && out->parts[0].n > 1;
    if (pair->is_placed)
        return ICC_OK;
    if (status != ICC_OK)
        iccp_error_copy(err, &own);
    return status;
}

static icc_status pair_by_shape(const pairing *p, size_t part, const iccp_env *env, icc_error *err)
{
    const iccp_paired_parts *const out = p->out;
    const iccp_memory *const memory = &env->memory;
    const size_t n = p->landmarks->n;
    iccp_part_pair *const pair = &out->pair[part];
    const uint32_t ring[2] = {out->parts[0].part[part].ring,
                              out->parts[1].part[pair->partner].ring};
    icc_status status = ICC_OK;
    for (int e = 0; e < 2 && status == ICC_OK; ++e)
        status = create_outline(&pair->outline[e], out->domain[e], ring[e], memory, err);
    if (status != ICC_OK)
        return status;
    size_t *const number = iccp_alloc(memory, n, sizeof *number);
    double *const given = iccp_alloc(memory, n, 6 * sizeof *given);
    status = number != NULL && given != NULL
                 ? pair_through(p, part, number, given, given + 4 * n, env, err)
                 : iccp_fail_memory(err);
    iccp_free(memory, number);
    iccp_free(memory, given);
    return status;
}

static icc_status pair_some(void *argument, size_t begin, size_t end)
{
    const pairing *const p = argument;
    icc_status status = ICC_OK;
    for (size_t k = begin; k < end && status == ICC_OK; ++k)
        status = pair_by_shape(p, k, &p->env, &p->error[k]);
    return status;
}

/* ---- as the whole lies ---- */

/* Adds a part: its outline if shapes have decided, else its centre. */
static void add_part(iccp_plane_affine_sums *sums, const iccp_paired_parts *all, size_t part)
{
    const iccp_part_pair *const pair = &all->pair[part];
    const double length = pair->outline[0].perimeter;
    if (pair->is_placed) {
        iccp_plane_affine_add(sums, length, all->parts[0].part[part].centre,
                              all->parts[1].part[pair->partner].centre);
        return;
    }
    iccp_mean_value at;
    iccp_mean_value_sample(&at, &pair->common, &pair->outline[0], &pair->outline[1]);
    for (size_t k = 0; k < ICCP_MATCH_SAMPLES; ++k)
        iccp_plane_affine_add(sums, length / ICCP_MATCH_SAMPLES, at.from + 2 * k, at.to + 2 * k);
}

/* Fits the affine map of the whole. */
static void fit_whole(iccp_plane_affine *whole, const iccp_paired_parts *all)
{
    iccp_plane_affine_sums sums = {0};
    double size[2];
    for (int e = 0; e < 2; ++e) {
        const icc_domain *const d = all->domain[e];
        size[e] = iccp_hypot(d->upper[0] - d->lower[0], d->upper[1] - d->lower[1]);
    }
    for (size_t k = 0; k < all->parts[0].n; ++k)
        add_part(&sums, all, k);
    (void)iccp_plane_affine_fit(whole, &sums, size);
}

/* Bends points as the whole is bent, about a centre. */
static void place(double *points, size_t n, const iccp_plane_affine *whole, const double centre[2])
{
    iccp_plane_affine here = *whole;
    memcpy(here.from, centre, sizeof here.from);
    memcpy(here.to, centre, sizeof here.to);
    for (size_t k = 0; k < n; ++k) {
        const double p[2] = {points[2 * k], points[2 * k + 1]};
        iccp_plane_affine_move(&here, p, points + 2 * k);
    }
}

/* Places n vertices of the source about the centre of their part. If there is no map, puts them
 * back. */
static void place_some_vertices(iccp_paired_parts *all, size_t first, size_t n,
                                const iccp_plane_affine *whole, const double centre[2])
{
    if (whole != NULL)
        place(all->moved + 2 * first, n, whole, centre);
    else
        memcpy(all->moved + 2 * first, all->domain[0]->vertices + 2 * first,
               2 * n * sizeof *all->moved);
}

/* Places the vertices of a part, of its outline and of features inside. Without a map, puts them
 * back. */
static void place_vertices(iccp_paired_parts *all, uint32_t part, const iccp_plane_affine *whole)
{
    const iccp_features *const features = all->domain[0]->features;
    const iccp_domain_part *const p = &all->parts[0].part[part];
    if (p->ring == NONE)
        place_some_vertices(all, 0, features->n_outer, whole, p->centre);
    for (size_t f = 0; f < features->n; ++f)
        if (all->parts[0].of[f] == part)
            place_some_vertices(all, features->item[f].first, features->item[f].n, whole,
                                p->centre);
}

static bool has_landmarks(const pairing *p, uint32_t ring)
{
    bool found = false;
    for (size_t k = 0; k < p->landmarks->n && !found; ++k)
        found = p->landmarks->item[k].feature[0] == ring;
    return found;
}

/* Places a part as the whole lies. If shape has decided how it lies, takes the better of both. */
static icc_status place_part(const pairing *p, size_t part, icc_error *err)
{
    iccp_part_pair *const pair = &p->out->pair[part];
    iccp_union_outline common = {0};
    iccp_elastic_report report;
    place_vertices(p->out, (uint32_t)part, &p->whole);
    iccp_outline_place(&pair->outline[0], p->out->moved);
    const icc_status status = iccp_pair_moved(&common, &report, &pair->outline[0],
                                              &pair->outline[1], 0, NULL, p->options, &p->env, err);
    if (status == ICC_OK && !pair->is_placed &&
        iccp_elastic_better(report.cost, pair->report.cost) < iccp_clearly_better) {
        iccp_union_outline_free(&common, &p->env.memory);
        place_vertices(p->out, (uint32_t)part, NULL);
        iccp_outline_place(&pair->outline[0], p->out->moved);
        return status;
    }
    const double *const m = p->whole.matrix;
    iccp_union_outline_free(&pair->common, &p->env.memory);
    pair->common = common;
    pair->report = report;
    pair->report.turn = iccp_atan2_turns(m[2] - m[1], m[0] + m[3]);
    pair->is_placed = true;
    return status;
}

/* Places the parts begin .. end - 1. Where landmarks or arc length have decided, that stays. */
static icc_status place_some(void *argument, size_t begin, size_t end)
{
    const pairing *const p = argument;
    icc_status status = ICC_OK;
    for (size_t k = begin; k < end && status == ICC_OK; ++k) {
        const bool is_open = p->out->pair[k].is_placed;
        if (is_open || (p->options->between != ICC_BETWEEN_ARC &&
                        !has_landmarks(p, p->out->parts[0].part[k].ring)))
            status = place_part(p, k, &p->error[k]);
    }
    return status;
}

/* ---- all ---- */

/* Runs a task for all parts: several on all threads, each on one thread. */
static icc_status for_parts(pairing *p, iccp_chunk task, const iccp_env *env, icc_error *err)
{
    const size_t n = p->out->parts[0].n;
    p->env = iccp_quiet(env);
    p->env.threads = 1;
    p->env.parallel_for = NULL;
    p->env.team = NULL;
    const icc_status status = iccp_for_chunks(env, "match", n, 1, task, p);
    for (size_t k = 0; k < n && status != ICC_OK && status != ICC_ERR_CANCELLED; ++k)
        if (p->error[k].message[0] != 0) {
            iccp_error_copy(err, &p->error[k]);
            return status;
        }
    return iccp_explain(err, status);
}

/* Pairs several parts by shape, and then as the whole lies. */
static icc_status pair_several(pairing *p, const iccp_env *env, icc_error *err)
{
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){10, 1}, env);
    icc_status status = for_parts(p, pair_some, &parts[0], err);
    if (status != ICC_OK)
        return status;
    fit_whole(&p->whole, p->out);
    return for_parts(p, place_some, &parts[1], err);
}

icc_status iccp_pair_parts(iccp_paired_parts *out, const icc_domain *const *domains,
                           const iccp_domain_parts *parts, const iccp_sorted_landmarks *landmarks,
                           const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    *out = (iccp_paired_parts){.domain = {domains[0], domains[1]}, .parts = parts};
    pairing p = {.out = out, .landmarks = landmarks, .options = options};
    const iccp_env quiet = iccp_quiet(env);
    icc_status status = reserve(&p, &env->memory, err);
    if (status == ICC_OK)
        status = find_partners(&p, &quiet, err);
    if (status == ICC_OK)
        status = parts[0].n > 1 ? pair_several(&p, env, err) : pair_by_shape(&p, 0, env, err);
    iccp_free(&env->memory, p.error);
    return status;
}

void iccp_paired_parts_free(iccp_paired_parts *paired, const iccp_memory *memory)
{
    for (size_t k = 0; paired->pair != NULL && k < paired->parts[0].n; ++k) {
        iccp_union_outline_free(&paired->pair[k].common, memory);
        iccp_outline_free(&paired->pair[k].outline[0], memory);
        iccp_outline_free(&paired->pair[k].outline[1], memory);
    }
    iccp_free(memory, paired->pair);
    iccp_free(memory, paired->moved);
}
