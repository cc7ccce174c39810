/* Checks features. The network of the domain (network.h) finds a defect if there is one, and tells
 * which sides lie in the domain. Only if there is a defect, rings are checked one by one. So the
 * messages are those for a single polygon. */
#include "domain/features_check.h"

#include "base/error.h"
#include "domain/network.h"
#include "geometry/polygon_check.h"
#include "geometry/segment.h"
#include "math/predicates.h"

#include <stdio.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct check {
    const icc_domain *domain;
    const iccp_env *env;
    icc_error *err;
} check;

const char *iccp_feature_name(int32_t dim, int32_t kind)
{
    return kind == ICC_FEATURE_HOLE    ? (dim == 2 ? "a hole" : "a void")
           : kind == ICC_FEATURE_LINE  ? "a line"
           : kind == ICC_FEATURE_POINT ? "a point"
                                       : "a region";
}

const char *iccp_feature_text(const iccp_features *features, uint32_t feature, char *text)
{
    if (feature == NONE)
        return features->in_space ? "the outer surface" : "the outer ring";
    (void)snprintf(text, ICCP_FEATURE_TEXT, "feature %lu (%s)", (unsigned long)feature,
                   iccp_feature_name(features->in_space ? 3 : 2, features->item[feature].kind));
    return text;
}

unsigned long iccp_feature_vertex(const iccp_features *features, uint32_t feature, uint32_t vertex)
{
    return (unsigned long)(feature != NONE ? vertex - features->item[feature].first : vertex);
}

unsigned long iccp_feature_facet(const iccp_features *features, uint32_t feature, uint32_t facet)
{
    return (unsigned long)(feature != NONE ? facet - features->item[feature].first_facet : facet);
}

icc_status iccp_features_blame(icc_error *err, const icc_error *own, const iccp_features *features,
                               uint32_t feature)
{
    char name[ICCP_FEATURE_TEXT];
    return iccp_fail_at(err, own->status, ICC_ITEM_FEATURE, (int64_t)feature, "%s: %s",
                        iccp_feature_text(features, feature, name), own->message);
}

/* ---------------------------------------------------------------- messages */

/* A feature, or NONE for the outer ring. */
static const iccp_feature *feature_of(const check *c, uint32_t feature)
{
    return feature != NONE ? &c->domain->features->item[feature] : NULL;
}

static const double *point(const check *c, uint32_t v)
{
    return c->domain->vertices + 2 * (size_t)v;
}

/* An end of a facet: 0 or 1. */
static const double *corner(const check *c, uint32_t facet, int end)
{
    return point(c, c->domain->facets[2 * (size_t)facet + (size_t)end]);
}

static bool is_point(const check *c, uint32_t feature)
{
    return feature != NONE && feature_of(c, feature)->kind == ICC_FEATURE_POINT;
}

/* Writes "feature 3 (a line), vertex 2," and what is wrong with it. */
static icc_status fail_vertex(const check *c, uint32_t feature, uint32_t v, const char *what,
                              const char *where)
{
    char name[ICCP_FEATURE_TEXT];
    return iccp_fail_at(c->err, ICC_ERR_OUTSIDE, ICC_ITEM_FEATURE, (int64_t)feature,
                        "%s, vertex %lu, %s %s",
                        iccp_feature_text(c->domain->features, feature, name),
                        iccp_feature_vertex(c->domain->features, feature, v), what, where);
}

static void meeting_point(const check *c, uint32_t e, uint32_t f, double *at)
{
    iccp_segments_point(corner(c, e, 0), corner(c, e, 1), corner(c, f, 0), corner(c, f, 1), at);
    iccp_frame_out(&c->domain->frame, 2, at, at);
}

/* ---------------------------------------------------------------- defects */

static icc_status check_ring(const check *c, uint32_t feature, size_t first, size_t n)
{
    icc_error own = {.size = sizeof own};
    const icc_status status = iccp_polygon_check_points(n, point(c, (uint32_t)first), NULL,
                                                        &c->domain->frame, c->env, &own);
    if (status == ICC_ERR_BOUNDARY && feature != NONE)
        return iccp_features_blame(c->err, &own, c->domain->features, feature);
    if (status != ICC_OK)
        iccp_error_copy(c->err, &own);
    return status;
}

/* Names the first ring that is not simple by itself. Returns ICC_OK if all are simple. */
static icc_status check_rings(const check *c)
{
    const iccp_features *features = c->domain->features;
    icc_status status = ICC_OK;
    if (features->n_outer > 0)
        status = check_ring(c, NONE, 0, features->n_outer);
    for (uint32_t f = 0; f < features->n && status == ICC_OK; ++f)
        if (iccp_feature_is_ring(features->item[f].kind))
            status = check_ring(c, f, features->item[f].first, features->item[f].n);
    return status;
}

/* Reports a line that repeats a vertex at once. */
static icc_status fail_repeated(const check *c, uint32_t feature, const iccp_defect *defect)
{
    char name[ICCP_FEATURE_TEXT];
    return iccp_fail_at(c->err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)feature,
                        "%s: vertex %lu repeats vertex %lu",
                        iccp_feature_text(c->domain->features, feature, name),
                        iccp_feature_vertex(c->domain->features, feature, defect->b),
                        iccp_feature_vertex(c->domain->features, feature, defect->a));
}

/* Reports a line that meets itself. */
static icc_status fail_line(const check *c, uint32_t feature, const iccp_defect *defect)
{
    const uint32_t *facets = c->domain->facets;
    char name[ICCP_FEATURE_TEXT];
    double at[2];
    (void)iccp_feature_text(c->domain->features, feature, name);
    if (facets[2 * (size_t)defect->a + 1] == facets[2 * (size_t)defect->b])
        return iccp_fail_at(
            c->err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)feature,
            "%s, vertex %lu: here it runs back over itself", name,
            iccp_feature_vertex(c->domain->features, feature, facets[2 * (size_t)defect->b]));
    meeting_point(c, defect->a, defect->b, at);
    return iccp_fail_at(c->err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)feature,
                        "%s: edges %lu and %lu %s near (%.9g, %.9g)", name,
                        iccp_feature_facet(c->domain->features, feature, defect->a),
                        iccp_feature_facet(c->domain->features, feature, defect->b),
                        defect->kind == ICC_DEFECT_CROSSING ? "cross" : "touch", at[0], at[1]);
}

/* Finds exactly where a point lies relative to a ring that begins with a facet. ICC_BOUNDARY is
 * only for places inside an edge; a vertex of the ring is 0. */
static int32_t place_in_ring(const check *c, uint32_t first_facet, size_t n, const double *p)
{
    bool odd = false;
    for (uint32_t f = first_facet; f < first_facet + n; ++f) {
        const double *a = corner(c, f, 0), *b = corner(c, f, 1);
        if (iccp_point_equal(a, p) || iccp_point_equal(b, p))
            return 0;
        if (iccp_segment_has(a, b, p))
            return ICC_BOUNDARY;
        if ((a[1] > p[1]) != (b[1] > p[1]))
            odd ^= (iccp_orient2d(a, b, p) > 0) == (b[1] > a[1]);
    }
    return odd ? ICC_INSIDE : ICC_OUTSIDE;
}

/* Reports a feature that meets the outer ring. Names an end of its edge that lies outside or on an
 * edge. If there is none, names the edges. */
static icc_status fail_outer(const check *c, uint32_t feature, const iccp_defect *defect)
{
    char name[ICCP_FEATURE_TEXT];
    double at[2];
    for (int end = 0; end < 2; ++end) {
        const uint32_t v = c->domain->facets[2 * (size_t)defect->b + (size_t)end];
        const int32_t where = place_in_ring(c, 0, c->domain->features->n_outer, point(c, v));
        if (where == ICC_BOUNDARY || where == ICC_OUTSIDE)
            return fail_vertex(c, feature, v, where == ICC_BOUNDARY ? "lies on" : "lies outside",
                               "the outer ring");
    }
    meeting_point(c, defect->a, defect->b, at);
    return iccp_fail_at(c->err, ICC_ERR_OUTSIDE, ICC_ITEM_FEATURE, (int64_t)feature,
                        "%s, edge %lu, %s the outer ring, edge %lu, near (%.9g, %.9g)",
                        iccp_feature_text(c->domain->features, feature, name),
                        iccp_feature_facet(c->domain->features, feature, defect->b),
                        defect->kind == ICC_DEFECT_CROSSING ? "crosses" : "touches",
                        iccp_feature_facet(c->domain->features, NONE, defect->a), at[0], at[1]);
}

/* Reports two features that meet: a point or edge of one, and one of the other. */
static icc_status fail_two(const check *c, const iccp_defect *defect, uint32_t first,
                           uint32_t second)
{
    uint32_t facet[2] = {defect->a, defect->b}, feature[2] = {first, second};
    char names[2][ICCP_FEATURE_TEXT];
    double at[2];
    if (first > second) {
        facet[0] = defect->b;
        facet[1] = defect->a;
        feature[0] = second;
        feature[1] = first;
    }
    meeting_point(c, facet[0], facet[1], at);
    return iccp_fail_at(c->err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, (int64_t)feature[1],
                        "%s, %s %lu, and %s, %s %lu, %s near (%.9g, %.9g)",
                        iccp_feature_text(c->domain->features, feature[1], names[1]),
                        is_point(c, feature[1]) ? "vertex" : "edge",
                        iccp_feature_facet(c->domain->features, feature[1], facet[1]),
                        iccp_feature_text(c->domain->features, feature[0], names[0]),
                        is_point(c, feature[0]) ? "vertex" : "edge",
                        iccp_feature_facet(c->domain->features, feature[0], facet[0]),
                        defect->kind == ICC_DEFECT_CROSSING ? "cross" : "touch", at[0], at[1]);
}

static icc_status fail_defect(const check *c, const iccp_defect *defect)
{
    const icc_status status = check_rings(c);
    if (status != ICC_OK)
        return status;
    if (defect->kind == ICC_DEFECT_REPEATED)
        return fail_repeated(c, iccp_feature_of_vertex(c->domain->features, defect->a), defect);
    const uint32_t first = iccp_feature_of_facet(c->domain, defect->a),
                   second = iccp_feature_of_facet(c->domain, defect->b);
    if (first == second)
        return fail_line(c, first, defect);
    return first == NONE ? fail_outer(c, second, defect) : fail_two(c, defect, first, second);
}

/* ---------------------------------------------------------------- outside */

/* Returns the last hole that has a point strictly inside, or NONE. */
static uint32_t hole_around(const check *c, const double *p)
{
    const iccp_features *features = c->domain->features;
    uint32_t hole = NONE;
    for (uint32_t f = 0; f < features->n; ++f) {
        const iccp_feature *item = &features->item[f];
        if (item->kind == ICC_FEATURE_HOLE &&
            place_in_ring(c, item->first_facet, item->n_facets, p) == ICC_INSIDE)
            hole = f;
    }
    return hole;
}

/* Reports a facet that lies nowhere in the domain. Names an end that tells, if there is one. */
static icc_status fail_outside(const check *c, uint32_t facet)
{
    const iccp_features *features = c->domain->features;
    const uint32_t feature = iccp_feature_of_facet(c->domain, facet);
    char names[2][ICCP_FEATURE_TEXT];
    for (int end = 0; end < 2; ++end) {
        const uint32_t v = c->domain->facets[2 * (size_t)facet + (size_t)end];
        const uint32_t hole = hole_around(c, point(c, v));
        if (hole != NONE)
            return fail_vertex(c, feature, v, "lies in",
                               iccp_feature_text(c->domain->features, hole, names[1]));
        if (place_in_ring(c, 0, features->n_outer, point(c, v)) == ICC_OUTSIDE)
            return fail_vertex(c, feature, v, "lies outside",
                               features->n_outer > 0 ? "the outer ring" : "all regions");
    }
    double middle[2];
    for (int k = 0; k < 2; ++k)
        middle[k] = 0.5 * (corner(c, facet, 0)[k] + corner(c, facet, 1)[k]);
    const uint32_t hole = hole_around(c, middle);
    return iccp_fail_at(
        c->err, ICC_ERR_OUTSIDE, ICC_ITEM_FEATURE, (int64_t)feature, "%s, edge %lu, lies %s %s",
        iccp_feature_text(c->domain->features, feature, names[0]),
        iccp_feature_facet(c->domain->features, feature, facet), hole != NONE ? "in" : "outside",
        hole != NONE            ? iccp_feature_text(c->domain->features, hole, names[1])
        : features->n_outer > 0 ? "the outer ring"
                                : "all regions");
}

/* Checks that each side, and each node without sides, lies in the domain or on its rim. Features
 * come before the outer ring, which is not at fault. */
static icc_status check_places(const check *c, const iccp_network *net)
{
    const iccp_features *features = c->domain->features;
    for (uint32_t f = (uint32_t)features->n_outer; f < features->n_places; ++f) {
        const uint32_t side = net->side[f], node = net->node[c->domain->facets[2 * (size_t)f]];
        const bool on_node =
            is_point(c, iccp_feature_of_facet(c->domain, f)) && iccp_network_degree(net, node) > 0;
        if (!on_node && net->face[2 * (size_t)side] == ICCP_NO_FACE &&
            net->face[2 * (size_t)side + 1] == ICCP_NO_FACE)
            return fail_outside(c, f);
    }
    return ICC_OK;
}

icc_status iccp_features_check(icc_domain *domain, const iccp_env *env, icc_error *err)
{
    const check c = {.domain = domain, .env = env, .err = err};
    iccp_defect found = {0};
    const icc_status status = iccp_network_create(&domain->features->network, &found, domain, env);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    return found.kind != 0 ? fail_defect(&c, &found) : check_places(&c, domain->features->network);
}
