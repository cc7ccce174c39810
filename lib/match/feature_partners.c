/* Finds the partners of features by solving an assignment problem for each kind. */
#include "match/feature_partners.h"

#include "base/error.h"
#include "domain/features.h"
#include "domain/features_check.h"
#include "match/assignment.h"
#include "math/elementary.h"

#include <math.h>

#define NONE ICCP_NO_FEATURE

/* A feature's centre by length, and its mean distance from there. */
static iccp_spot spot_of(const iccp_feature *f, uint32_t number, const double *vertices)
{
    iccp_spot out = {.number = number};
    const double *const p = vertices + 2 * (size_t)f->first;
    double length = 0, square = 0;
    for (uint32_t k = 0; k < f->n_facets && f->n > 1; ++k) {
        const double *const a = p + 2 * k, *const b = p + 2 * ((k + 1) % f->n);
        const double d = iccp_hypot(b[0] - a[0], b[1] - a[1]);
        length += d;
        for (int e = 0; e < 2; ++e) {
            out.at[e] += d * (a[e] + b[e]) / 2;
            square += d * (a[e] * a[e] + a[e] * b[e] + b[e] * b[e]) / 3;
        }
    }
    for (int e = 0; e < 2; ++e)
        out.at[e] = length > 0 ? out.at[e] / length : p[e];
    square = length > 0 ? square / length - out.at[0] * out.at[0] - out.at[1] * out.at[1] : 0;
    out.size = sqrt(square > 0 ? square : 0);
    return out;
}

/* Checks that no two of n pairs could exchange partners. */
static icc_status check(const iccp_spot *a, const iccp_spot *b, size_t n, const iccp_feature *all,
                        double least, double sure, icc_error *err)
{
    size_t i, k;
    if (!iccp_can_exchange(&i, &k, a, b, n, least, sure))
        return ICC_OK;
    iccp_fail_at(err, ICC_ERR_AMBIGUOUS, ICC_ITEM_FEATURE, (int64_t)a[i].number,
                 "feature %lu (%s) and feature %lu could go to one another's places almost as "
                 "well: give a landmark, a point of one of them and its partner's",
                 (unsigned long)a[i].number, iccp_feature_name(2, all[a[i].number].kind),
                 (unsigned long)a[k].number);
    return iccp_fail_side(err, ICC_ERR_AMBIGUOUS, 1);
}

typedef struct pairs {
    const icc_domain *domain[2];
    const iccp_domain_parts *parts; /* of both */
    const double *vertices[2];      /* the source's are moved */
    uint32_t *partner[2];           /* by feature of each side */
    iccp_spot *spots[2];
} pairs;

static void set_partners(pairs *p, uint32_t f, uint32_t g)
{
    p->partner[0][f] = g;
    p->partner[1][g] = f;
}

/* A circle and its point have the same partners. Copies them from one to the other, in either
 * direction. */
static void set_rim_partners(pairs *p, bool is_known_by_point)
{
    const iccp_feature *const a = p->domain[0]->features->item;
    const iccp_feature *const b = p->domain[1]->features->item;
    const size_t n = p->domain[0]->features->n, n_target = p->domain[1]->features->n;
    for (uint32_t f = 0; f < n; ++f) {
        if (a[f].rim_of == NONE)
            continue;
        if (p->partner[0][f] != NONE)
            set_partners(p, a[f].rim_of, b[p->partner[0][f]].rim_of);
        for (uint32_t g = 0; g < n_target && is_known_by_point; ++g)
            if (b[g].rim_of != NONE && p->partner[0][a[f].rim_of] == b[g].rim_of)
                set_partners(p, f, g);
    }
}

/* Pairs the features of one kind in two parts that have no partner yet. */
static icc_status pair_kind(pairs *p, int32_t kind, const uint32_t part[2], double sure,
                            const iccp_env *env, icc_error *err)
{
    size_t n[2] = {0, 0};
    for (int e = 0; e < 2; ++e) {
        const iccp_features *const all = p->domain[e]->features;
        for (uint32_t f = 0; f < all->n; ++f)
            if (p->parts[e].kind[f] == kind && p->parts[e].of[f] == part[e] &&
                p->partner[e][f] == NONE)
                p->spots[e][n[e]++] = spot_of(&all->item[f], f, p->vertices[e]);
    }
    icc_status status = iccp_explain(err, iccp_assign(p->spots[0], p->spots[1], n[0], env));
    const icc_domain *const target = p->domain[1];
    const double least = iccp_place_noise * iccp_hypot(target->upper[0] - target->lower[0],
                                                       target->upper[1] - target->lower[1]);
    if (status == ICC_OK)
        status = check(p->spots[0], p->spots[1], n[0], p->domain[0]->features->item, least * least,
                       sure, err);
    for (size_t k = 0; k < n[0] && status == ICC_OK; ++k)
        set_partners(p, p->spots[0][k].number, p->spots[1][k].number);
    return status;
}

static icc_status pair_part(pairs *p, const uint32_t part[2], double sure, const iccp_env *env,
                            icc_error *err)
{
    static const int32_t order[] = {ICC_FEATURE_HOLE, ICC_FEATURE_REGION, ICCP_KIND_CLOSED,
                                    ICC_FEATURE_LINE, ICCP_KIND_RIM,      ICC_FEATURE_POINT};
    icc_status status = ICC_OK;
    for (size_t k = 0; k < sizeof order / sizeof *order && status == ICC_OK; ++k) {
        if (p->parts[0].part[part[0]].count[order[k]] == 0)
            continue;
        status = pair_kind(p, order[k], part, sure, env, err);
        if (status == ICC_OK && order[k] == ICCP_KIND_RIM)
            set_rim_partners(p, false);
    }
    return status;
}

icc_status iccp_features_partner(uint32_t *partner, const icc_domain *source,
                                 const icc_domain *target, const iccp_domain_parts *parts,
                                 const uint32_t *part_partner, const double *moved, double sure,
                                 const iccp_env *env, icc_error *err)
{
    const size_t n = source->features->n;
    const size_t n_target = target->features != NULL ? target->features->n : 0;
    if (n_target == 0) /* the source then has nothing but an outline */
        return ICC_OK;
    pairs p = {.domain = {source, target}, .parts = parts, .vertices = {moved, target->vertices}};
    p.partner[0] = partner;
    p.partner[1] = iccp_alloc(&env->memory, n_target, sizeof *partner);
    p.spots[0] = iccp_alloc(&env->memory, n + n_target, sizeof *p.spots[0]);
    icc_status status = p.partner[1] != NULL && p.spots[0] != NULL ? ICC_OK : iccp_fail_memory(err);
    if (status == ICC_OK) {
        p.spots[1] = p.spots[0] + n;
        for (uint32_t f = 0; f < n_target; ++f)
            p.partner[1][f] = NONE;
        for (uint32_t f = 0; f < n; ++f)
            if (partner[f] != NONE)
                set_partners(&p, f, partner[f]);
        set_rim_partners(&p, true);
    }
    for (uint32_t k = 0; k < parts[0].n && status == ICC_OK; ++k)
        status = pair_part(&p, (const uint32_t[]){k, part_partner[k]}, sure, env, err);
    iccp_free(&env->memory, p.partner[1]);
    iccp_free(&env->memory, p.spots[0]);
    return status;
}
