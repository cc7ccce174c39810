/* Checks features. One plane sweep over all rings, lines and points finds a defect if there is one,
 * and tells how they contain one another (geometry/sweep.h). Only if there is a defect, rings are
 * checked one by one. So the messages are those for a single polygon. */
#include "domain/features_check.h"

#include "base/error.h"
#include "geometry/polygon_check.h"
#include "geometry/segment.h"
#include "geometry/sweep.h"
#include "math/predicates.h"

#include <stdio.h>
#include <string.h>

/* Chain 0 is the outer ring. Chain f + 1 is feature f. */
typedef struct check {
    const icc_domain *domain;
    iccp_chains chains;
    iccp_chain *item;
    double *points;
    iccp_chain_place *places;
    const iccp_env *env;
    icc_error *err;
} check;

const char *iccp_feature_name(int32_t kind)
{
    return kind == ICC_FEATURE_HOLE ? "a hole" : kind == ICC_FEATURE_LINE ? "a line" : "a point";
}

icc_status iccp_features_blame(icc_error *err, const icc_error *own, size_t feature, int32_t kind)
{
    return iccp_fail_at(err, own->status, ICC_ITEM_FEATURE, (int64_t)feature,
                        "feature %zu (%s): %s", feature, iccp_feature_name(kind), own->message);
}

/* ---------------------------------------------------------------- messages */

static const iccp_feature *feature_of(const check *c, uint32_t chain)
{
    return &c->domain->features->item[chain - 1];
}

static const double *point(const check *c, uint32_t k)
{
    return c->points + 2 * (size_t)k;
}

/* Returns the number of a point or edge in its own chain. */
static unsigned long number(const check *c, uint32_t chain, uint32_t k)
{
    return (unsigned long)(k - c->item[chain].first);
}

enum { NAME_SIZE = 64 };

/* Writes a text such as "feature 3 (a line)". */
static const char *name_chain(const check *c, uint32_t chain, char *text)
{
    if (chain == 0)
        return "the outer ring";
    (void)snprintf(text, NAME_SIZE, "feature %lu (%s)", (unsigned long)chain - 1,
                   iccp_feature_name(feature_of(c, chain)->kind));
    return text;
}

/* Writes "feature 3 (a line), vertex 2," and what is wrong with it. */
static icc_status fail_vertex(const check *c, icc_status status, uint32_t chain, uint32_t v,
                              const char *what, const char *where)
{
    char name[NAME_SIZE];
    return iccp_fail_at(c->err, status, ICC_ITEM_FEATURE, (int64_t)chain - 1,
                        "%s, vertex %lu, %s %s", name_chain(c, chain, name), number(c, chain, v),
                        what, where);
}

static void meeting_point(const check *c, uint32_t e, uint32_t f, double *at)
{
    iccp_segments_point(point(c, e), point(c, e + 1), point(c, f), point(c, f + 1), at);
    iccp_frame_out(&c->domain->frame, 2, at, at);
}

/* ---------------------------------------------------------------- defects */

/* Names the first ring that is not simple by itself. Returns ICC_OK if all are simple. */
static icc_status check_rings(const check *c)
{
    for (uint32_t chain = 0; chain < c->chains.n; ++chain) {
        const iccp_chain *ring = &c->item[chain];
        if (!ring->closed)
            continue;
        icc_error own = {.size = sizeof own};
        const icc_status status = iccp_polygon_check_points(ring->n, point(c, ring->first), NULL,
                                                            &c->domain->frame, c->env, &own);
        if (status == ICC_ERR_BOUNDARY && chain > 0)
            return iccp_features_blame(c->err, &own, chain - 1, ICC_FEATURE_HOLE);
        if (status != ICC_OK) {
            iccp_error_copy(c->err, &own);
            return status;
        }
    }
    return ICC_OK;
}

/* Reports a line that meets itself. */
static icc_status fail_line(const check *c, uint32_t chain, const iccp_defect *defect)
{
    const unsigned long a = number(c, chain, defect->a), b = number(c, chain, defect->b);
    const int64_t feature = (int64_t)chain - 1;
    char name[NAME_SIZE];
    double at[2];
    (void)name_chain(c, chain, name);
    if (defect->kind == ICC_DEFECT_REPEATED)
        return iccp_fail_at(c->err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, feature,
                            "%s: vertex %lu repeats vertex %lu", name, b, a);
    if (defect->kind == ICC_DEFECT_SPIKE)
        return iccp_fail_at(c->err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, feature,
                            "%s, vertex %lu: here it runs back over itself", name, a);
    meeting_point(c, defect->a, defect->b, at);
    return iccp_fail_at(c->err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, feature,
                        "%s: edges %lu and %lu %s near (%.9g, %.9g)", name, a, b,
                        defect->kind == ICC_DEFECT_CROSSING ? "cross" : "touch", at[0], at[1]);
}

/* Finds exactly where a point lies relative to the outer ring. */
static int32_t place_in_ring(const check *c, const double *p)
{
    bool odd = false;
    for (uint32_t k = 0; k < c->item[0].n; ++k) {
        const double *a = point(c, k), *b = point(c, k + 1);
        if (iccp_segment_has(a, b, p))
            return ICC_BOUNDARY;
        if ((a[1] > p[1]) != (b[1] > p[1]))
            odd ^= (iccp_orient2d(a, b, p) > 0) == (b[1] > a[1]);
    }
    return odd ? ICC_INSIDE : ICC_OUTSIDE;
}

/* Reports a feature that meets the outer ring. Names an end of its edge that does not lie inside
 * or, if both do, the edges. */
static icc_status fail_outer(const check *c, uint32_t chain, uint32_t ring_edge, uint32_t edge,
                             int32_t kind)
{
    const iccp_chain *own = &c->item[chain];
    const uint32_t next = edge + 1 == own->first + own->n ? own->first : edge + 1;
    const uint32_t ends[2] = {edge, next};
    char name[NAME_SIZE];
    double at[2];
    for (int i = 0; i < 2; ++i) {
        const int32_t where = place_in_ring(c, point(c, ends[i]));
        if (where != ICC_INSIDE)
            return fail_vertex(c, ICC_ERR_OUTSIDE, chain, ends[i],
                               where == ICC_BOUNDARY ? "lies on" : "lies outside",
                               "the outer ring");
    }
    meeting_point(c, ring_edge, edge, at);
    return iccp_fail_at(c->err, ICC_ERR_OUTSIDE, ICC_ITEM_FEATURE, (int64_t)chain - 1,
                        "%s, edge %lu, %s the outer ring, edge %lu, near (%.9g, %.9g)",
                        name_chain(c, chain, name), number(c, chain, edge),
                        kind == ICC_DEFECT_CROSSING ? "crosses" : "touches",
                        number(c, 0, ring_edge), at[0], at[1]);
}

/* Reports two features that meet: a point or edge of one, and one of the other, which comes
 * later. */
static icc_status fail_two(const check *c, const iccp_defect *defect, uint32_t first,
                           uint32_t second)
{
    const bool same = defect->kind == ICC_DEFECT_REPEATED;
    const bool first_is_point = same || feature_of(c, first)->kind == ICC_FEATURE_POINT;
    const bool second_is_point = same || feature_of(c, second)->kind == ICC_FEATURE_POINT;
    char names[2][NAME_SIZE];
    double at[2];
    if (first_is_point || second_is_point)
        iccp_frame_out(&c->domain->frame, 2, point(c, second_is_point ? defect->b : defect->a), at);
    else
        meeting_point(c, defect->a, defect->b, at);
    return iccp_fail_at(c->err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)second - 1,
                        "%s, %s %lu, and %s, %s %lu, %s (%.9g, %.9g)",
                        name_chain(c, second, names[1]), second_is_point ? "vertex" : "edge",
                        number(c, second, defect->b), name_chain(c, first, names[0]),
                        first_is_point ? "vertex" : "edge", number(c, first, defect->a),
                        same                                  ? "coincide at"
                        : defect->kind == ICC_DEFECT_CROSSING ? "cross near"
                                                              : "touch near",
                        at[0], at[1]);
}

static icc_status fail_defect(const check *c, const iccp_defect *defect)
{
    const icc_status status = check_rings(c);
    if (status != ICC_OK)
        return status;
    const uint32_t first = iccp_chain_of(&c->chains, defect->a),
                   second = iccp_chain_of(&c->chains, defect->b);
    if (first == second)
        return fail_line(c, first, defect);
    if (first > 0)
        return fail_two(c, defect, first, second);
    if (defect->kind == ICC_DEFECT_REPEATED)
        return fail_vertex(c, ICC_ERR_OUTSIDE, second, defect->b, "lies on", "the outer ring");
    return fail_outer(c, second, defect->a, defect->b, defect->kind);
}

/* Checks that all features lie in the outer ring and in no hole, if they do not meet. */
static icc_status check_places(const check *c)
{
    char name[NAME_SIZE];
    for (uint32_t chain = 1; chain < c->chains.n; ++chain) {
        const uint32_t around = c->places[chain].around;
        if (around == ICCP_NO_CHAIN)
            return fail_vertex(c, ICC_ERR_OUTSIDE, chain, c->item[chain].first, "lies outside",
                               "the outer ring");
        if (around != 0)
            return fail_vertex(c, ICC_ERR_OUTSIDE, chain, c->item[chain].first, "lies in",
                               name_chain(c, around, name));
    }
    return ICC_OK;
}

/* ------------------------------------------------------------------ chains */

static void add_chain(check *c, uint32_t chain, size_t first, size_t n, bool closed)
{
    const uint32_t at = (uint32_t)c->chains.n_points;
    const double *from = c->domain->vertices + 2 * first;
    c->item[chain] = (iccp_chain){at, (uint32_t)n, closed};
    memcpy(c->points + 2 * (size_t)at, from, 2 * n * sizeof *from);
    if (closed)
        memcpy(c->points + 2 * (at + n), from, 2 * sizeof *from);
    c->chains.n_points += n + closed;
}

static void add_chains(check *c)
{
    const iccp_features *features = c->domain->features;
    add_chain(c, 0, 0, features->n_outer, true);
    for (uint32_t f = 0; f < features->n; ++f)
        add_chain(c, f + 1, features->item[f].first, features->item[f].n,
                  features->item[f].kind == ICC_FEATURE_HOLE);
}

static icc_status run(check *c)
{
    iccp_defect defect = {0};
    add_chains(c);
    icc_status status = iccp_sweep_chains(&defect, c->places, &c->chains, c->env);
    if (status != ICC_OK)
        return iccp_explain(c->err, status);
    return defect.kind != 0 ? fail_defect(c, &defect) : check_places(c);
}

icc_status iccp_features_check(icc_domain *domain, const iccp_env *env, icc_error *err)
{
    iccp_features *features = domain->features;
    const size_t n = features->n + 1;
    const iccp_memory *memory = &domain->memory;
    check c = {.domain = domain, .env = env, .err = err};
    c.points = iccp_alloc(memory, domain->n_vertices + n, 2 * sizeof *c.points);
    c.item = iccp_alloc(memory, n, sizeof *c.item);
    c.places = iccp_alloc(memory, n, sizeof *c.places);
    c.chains = (iccp_chains){.points = c.points, .n = n, .item = c.item};
    icc_status status =
        c.points != NULL && c.item != NULL && c.places != NULL ? run(&c) : iccp_fail_memory(err);
    if (status == ICC_OK) {
        domain->orientation = c.places[0].orientation;
        for (size_t f = 0; f < features->n; ++f)
            features->item[f].orientation = c.places[f + 1].orientation;
    }
    iccp_free(memory, c.points);
    iccp_free(memory, c.item);
    iccp_free(memory, c.places);
    return status;
}
