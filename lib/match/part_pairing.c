/* Pairs outlines part by part. Shapes decide first. The parts that they decide, and the centres of
 * the others, then tell how the whole is turned: by the rotation with the least sum of squares (J.
 * Gower, Generalized Procrustes analysis, 1975). Parts that shapes leave open, such as the round
 * dots of an i, are turned by it and paired where they are nearest. */
#include "match/part_pairing.h"

#include "base/error.h"
#include "match/mean_value.h"
#include "match/outline/descriptor.h"
#include "match/outline/landmarks.h"
#include "match/outline/ring_pairing.h"
#include "match/part_partners.h"

#include <string.h>

#define NONE ICCP_NO_FEATURE

typedef struct pairing {
    iccp_paired_parts *out;
    const iccp_sorted_landmarks *landmarks;
    size_t *number; /* of one outline's landmarks */
    double *given, *shares;
    const icc_match_options *options;
} pairing;

static icc_status reserve(pairing *p, const iccp_memory *memory, icc_error *err)
{
    iccp_paired_parts *const out = p->out;
    const size_t n = p->landmarks->n, n_vertices = out->domain[0]->n_vertices;
    out->pair = iccp_alloc_zero(memory, out->parts[0].n, sizeof *out->pair);
    out->moved = iccp_alloc(memory, n_vertices, 2 * sizeof *out->moved);
    p->number = iccp_alloc(memory, n, sizeof *p->number);
    p->given = iccp_alloc(memory, n, 4 * sizeof *p->given);
    p->shares = iccp_alloc(memory, n, 2 * sizeof *p->shares);
    if (out->pair == NULL || out->moved == NULL || p->number == NULL || p->given == NULL ||
        p->shares == NULL)
        return iccp_fail_memory(err);
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

static icc_status pair_by_shape(pairing *p, size_t part, const iccp_env *env, icc_error *err)
{
    const iccp_paired_parts *const out = p->out;
    const iccp_memory *const memory = &env->memory;
    iccp_part_pair *const pair = &out->pair[part];
    const uint32_t ring[2] = {out->parts[0].part[part].ring,
                              out->parts[1].part[pair->partner].ring};
    icc_error own = {.size = sizeof own};
    icc_status status = ICC_OK;
    for (int e = 0; e < 2 && status == ICC_OK; ++e)
        status = create_outline(&pair->outline[e], out->domain[e], ring[e], memory, err);
    if (status != ICC_OK)
        return status;
    const size_t n = iccp_landmarks_on(p->landmarks, ring[0], p->number, p->given);
    status = iccp_landmarks_place(p->shares, n, p->given, p->number, &pair->outline[0],
                                  &pair->outline[1], memory, err);
    if (status != ICC_OK)
        return status;
    status = iccp_pair_rings(&pair->common, &pair->report, &pair->outline[0], &pair->outline[1], n,
                             p->shares, p->options, env, &own);
    pair->is_placed = status == ICC_ERR_AMBIGUOUS && out->parts[0].n > 1;
    if (pair->is_placed)
        return ICC_OK;
    if (status != ICC_OK)
        iccp_error_copy(err, &own);
    return status;
}

/* ---- as the whole lies ---- */

/* Sums over pairs of points with weights: weights, coordinates of both sides, and products. */
typedef struct turning {
    double weight, at[2][2], cosine, sine;
} turning;

static void add_points(turning *t, double weight, const double *a, const double *b)
{
    t->weight += weight;
    for (int k = 0; k < 2; ++k) {
        t->at[0][k] += weight * a[k];
        t->at[1][k] += weight * b[k];
    }
    t->cosine += weight * (a[0] * b[0] + a[1] * b[1]);
    t->sine += weight * (a[0] * b[1] - a[1] * b[0]);
}

/* Adds a part: its outline if shapes have decided, else its centre. */
static void add_part(turning *t, const iccp_paired_parts *all, size_t part)
{
    const iccp_part_pair *const pair = &all->pair[part];
    const double length = pair->outline[0].perimeter;
    if (pair->is_placed) {
        add_points(t, length, all->parts[0].part[part].centre,
                   all->parts[1].part[pair->partner].centre);
        return;
    }
    iccp_mean_value at;
    iccp_mean_value_sample(&at, &pair->common, &pair->outline[0], &pair->outline[1]);
    for (size_t k = 0; k < ICCP_MATCH_SAMPLES; ++k)
        add_points(t, length / ICCP_MATCH_SAMPLES, at.from + 2 * k, at.to + 2 * k);
}

/* The rotation of the whole: cosine and sine. */
static void rotation_of(double rotation[2], const iccp_paired_parts *all)
{
    turning t = {0};
    for (size_t k = 0; k < all->parts[0].n; ++k)
        add_part(&t, all, k);
    const double *const a = t.at[0], *const b = t.at[1];
    rotation[0] = t.cosine - (a[0] * b[0] + a[1] * b[1]) / t.weight;
    rotation[1] = t.sine - (a[0] * b[1] - a[1] * b[0]) / t.weight;
    iccp_unit(rotation);
}

static void turn(double *points, size_t n, const double rotation[2], const double centre[2])
{
    for (size_t k = 0; k < n; ++k) {
        const double x = points[2 * k] - centre[0], y = points[2 * k + 1] - centre[1];
        points[2 * k] = centre[0] + rotation[0] * x - rotation[1] * y;
        points[2 * k + 1] = centre[1] + rotation[1] * x + rotation[0] * y;
    }
}

/* Turns the vertices of a part: its outline and what lies inside. */
static void turn_part(iccp_paired_parts *all, uint32_t part, const double rotation[2])
{
    const iccp_features *const features = all->domain[0]->features;
    const iccp_domain_part *const p = &all->parts[0].part[part];
    if (p->ring == NONE)
        turn(all->moved, features->n_outer, rotation, p->centre);
    for (size_t f = 0; f < features->n; ++f)
        if (all->parts[0].of[f] == part)
            turn(all->moved + 2 * (size_t)features->item[f].first, features->item[f].n, rotation,
                 p->centre);
}

static icc_status place_parts(pairing *p, const iccp_env *env, icc_error *err)
{
    iccp_paired_parts *const all = p->out;
    double rotation[2];
    icc_status status = ICC_OK;
    rotation_of(rotation, all);
    for (uint32_t k = 0; k < all->parts[0].n && status == ICC_OK; ++k) {
        iccp_part_pair *const pair = &all->pair[k];
        if (!pair->is_placed)
            continue;
        turn_part(all, k, rotation);
        iccp_outline_place(&pair->outline[0], all->moved);
        status = iccp_pair_moved(&pair->common, &pair->outline[0], &pair->outline[1], 0, NULL,
                                 p->options, env, err);
    }
    return status;
}

/* ---- all ---- */

icc_status iccp_pair_parts(iccp_paired_parts *out, const icc_domain *const *domains,
                           const iccp_domain_parts *parts, const iccp_sorted_landmarks *landmarks,
                           const icc_match_options *options, const iccp_env *env, icc_error *err)
{
    *out = (iccp_paired_parts){.domain = {domains[0], domains[1]}, .parts = parts};
    pairing p = {.out = out, .landmarks = landmarks, .options = options};
    const iccp_env quiet = iccp_quiet(env);
    const size_t n = parts[0].n;
    icc_status status = reserve(&p, &env->memory, err);
    if (status == ICC_OK)
        status = find_partners(&p, &quiet, err);
    for (size_t k = 0; k < n && status == ICC_OK; ++k) {
        const iccp_env part =
            iccp_part(env, NULL, (double)k / (double)n, (double)(k + 1) / (double)n);
        status = pair_by_shape(&p, k, &part, err);
    }
    if (status == ICC_OK && n > 1)
        status = place_parts(&p, &quiet, err);
    iccp_free(&env->memory, p.number);
    iccp_free(&env->memory, p.given);
    iccp_free(&env->memory, p.shares);
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
