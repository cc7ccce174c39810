/* Pairs of domains with features that correspond. */
#ifndef TESTS_FEATURE_PAIRS_H
#define TESTS_FEATURE_PAIRS_H

#include "icc/icc.h"

#include "random.h"

#include <check.h>
#include <math.h>
#include <string.h>

enum { PLAN_FEATURES = 8, PLAN_VERTICES = 96 };

/* Vertices of the outer ring and of the features in their order. */
typedef struct plan {
    size_t n_outer, n_features, n_vertices;
    struct {
        int32_t kind;
        size_t n;
    } feature[PLAN_FEATURES];
    double xy[2 * PLAN_VERTICES];
} plan;

static inline void plan_vertex(plan *p, double x, double y)
{
    ck_assert_uint_lt(p->n_vertices, PLAN_VERTICES);
    p->xy[2 * p->n_vertices] = x;
    p->xy[2 * p->n_vertices++ + 1] = y;
}

static inline plan plan_square(double side)
{
    plan p = {.n_outer = 4};
    plan_vertex(&p, 0, 0);
    plan_vertex(&p, side, 0);
    plan_vertex(&p, side, side);
    plan_vertex(&p, 0, side);
    return p;
}

static inline void plan_feature(plan *p, int32_t kind, size_t n, const double *xy)
{
    ck_assert_uint_lt(p->n_features, PLAN_FEATURES);
    p->feature[p->n_features].kind = kind;
    p->feature[p->n_features++].n = n;
    for (size_t k = 0; k < n; ++k)
        plan_vertex(p, xy[2 * k], xy[2 * k + 1]);
}

static inline void plan_point(plan *p, double x, double y)
{
    plan_feature(p, ICC_FEATURE_POINT, 1, (const double[]){x, y});
}

/* A regular polygon, counter-clockwise, or clockwise for n < 0. */
static inline void plan_hole(plan *p, int n, double x, double y, double radius, double turn)
{
    const size_t count = (size_t)(n < 0 ? -n : n);
    double xy[2 * PLAN_VERTICES];
    for (size_t k = 0; k < count; ++k) {
        const double a = turn + 6.283185307179586 * (double)k / n;
        xy[2 * k] = x + radius * cos(a);
        xy[2 * k + 1] = y + radius * sin(a);
    }
    plan_feature(p, ICC_FEATURE_HOLE, count, xy);
}

/* Every vertex to scale * it + (x, y). */
static inline plan plan_moved(const plan *p, double scale, double x, double y)
{
    plan moved = *p;
    for (size_t v = 0; v < p->n_vertices; ++v) {
        moved.xy[2 * v] = scale * p->xy[2 * v] + x;
        moved.xy[2 * v + 1] = scale * p->xy[2 * v + 1] + y;
    }
    return moved;
}

/* All rings the other way round, or lines from their end: the vertices of each in reverse. */
static inline plan plan_reversed(const plan *p)
{
    plan reversed = *p;
    size_t first = 0;
    for (size_t f = 0; f <= p->n_features; ++f) {
        const size_t n = f == 0 ? p->n_outer : p->feature[f - 1].n;
        for (size_t k = 0; k < n; ++k)
            memcpy(reversed.xy + 2 * (first + k), p->xy + 2 * (first + n - 1 - k),
                   2 * sizeof *p->xy);
        first += n;
    }
    return reversed;
}

static inline icc_status plan_try(icc_domain **out, const plan *p, const icc_env *env,
                                  icc_error *err)
{
    icc_feature features[PLAN_FEATURES];
    const double *next = p->xy + 2 * p->n_outer;
    for (size_t f = 0; f < p->n_features; ++f) {
        features[f] = (icc_feature){.size = sizeof(icc_feature),
                                    .kind = p->feature[f].kind,
                                    .n_vertices = p->feature[f].n,
                                    .vertices = next};
        next += 2 * p->feature[f].n;
    }
    return icc_domain_create_features(out, p->n_outer, p->xy, p->n_features, features, env, err);
}

static inline icc_domain *plan_domain(const plan *p)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(plan_try(&domain, p, NULL, &err) == ICC_OK, "%s", err.message);
    return domain;
}

/* ---- pairs ---- */

enum { N_PLANS = 6 };

/* One of each kind, listed in another order than the one in which facets come. */
static inline void plans_mixed(plan *source, plan *target)
{
    *source = *target = plan_square(8);
    plan_point(source, 2, 6);
    plan_point(target, 3, 6.5);
    plan_feature(source, ICC_FEATURE_LINE, 3, (const double[]){5, 1, 6.5, 2, 6, 4});
    plan_feature(target, ICC_FEATURE_LINE, 3, (const double[]){5, 1.5, 7, 1.5, 6, 3});
    plan_hole(source, 5, 2.5, 2.5, 1, 0.1);
    plan_hole(target, 5, 2.5, 2, 0.8, 0.5);
    plan_feature(source, ICC_FEATURE_LINE, 2, (const double[]){4, 6, 6, 7});
    plan_feature(target, ICC_FEATURE_LINE, 2, (const double[]){5, 7, 6, 5.5});
    plan_point(source, 7, 5);
    plan_point(target, 7, 6);
}

/* Several pairs, easy ones. */
static inline void plans_number(int k, plan *source, plan *target)
{
    *source = *target = plan_square(4);
    switch (k) {
    case 0: /* two points swapped */
        plan_point(source, 1, 2);
        plan_point(target, 3, 2);
        plan_point(source, 3, 2);
        plan_point(target, 1, 2);
        break;
    case 1:
        plans_mixed(source, target);
        break;
    case 2: /* the same the other way round, and elsewhere */
        plans_mixed(source, target);
        *source = plan_reversed(source);
        *target = plan_reversed(target);
        *target = plan_moved(target, 0x1p-7, 1000, -2000);
        break;
    case 3: /* a hole alone, turned */
        plan_hole(source, 6, 2, 2, 1, 0);
        plan_hole(target, 6, 2, 2, 1, 2);
        break;
    case 4: /* two holes, which are listed clockwise */
        plan_hole(source, -4, 1, 1, 0.5, 0);
        plan_hole(target, -4, 1, 3, 0.7, 0);
        plan_hole(source, -3, 3, 3, 0.5, 0);
        plan_hole(target, -3, 3, 2, 0.5, 1);
        break;
    default: /* a bone turned half round */
        plan_feature(source, ICC_FEATURE_LINE, 2, (const double[]){1, 2, 3, 2});
        plan_feature(target, ICC_FEATURE_LINE, 2, (const double[]){3, 2, 1, 2});
        break;
    }
}

#endif
