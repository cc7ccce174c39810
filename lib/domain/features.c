/* Domains with holes, lines and points inside a polygon. */
#include "domain/features.h"

#include "base/error.h"
#include "domain/domain_make.h"
#include "domain/features_check.h"
#include "domain/network.h"
#include "domain/polygon_domain.h"
#include "domain/scan_polygon.h"
#include "domain/tree_cross.h"
#include "domain/tree_locate.h"
#include "geometry/polygon_check.h"

#include <string.h>

static void clear(icc_domain *domain)
{
    if (domain->features != NULL) {
        iccp_network_free(domain->features->network, &domain->memory);
        iccp_free(&domain->memory, domain->features->item);
    }
    iccp_free(&domain->memory, domain->features);
    iccp_facet_tree_free(&domain->tree, &domain->memory);
}

static const iccp_domain_ops OPS = {iccp_tree_own, iccp_tree_locate, iccp_tree_cross,
                                    iccp_scan_polygon, clear};

static size_t count_facets(const icc_feature *feature)
{
    return feature->kind == ICC_FEATURE_LINE ? feature->n_vertices - 1 : feature->n_vertices;
}

/* The order of facets: holes and regions are rings. */
static int rank_of(int32_t kind)
{
    return kind == ICC_FEATURE_HOLE ? 0 : kind == ICC_FEATURE_REGION ? 1 : 2;
}

/* Numbers the facets of features of a rank. Returns the next free number. */
static uint32_t number_facets(iccp_features *features, const icc_feature *given, int rank,
                              uint32_t next)
{
    for (size_t f = 0; f < features->n; ++f) {
        iccp_feature *feature = &features->item[f];
        if (rank_of(feature->kind) != rank)
            continue;
        feature->first_facet = next;
        feature->n_facets = (uint32_t)count_facets(&given[f]);
        next += feature->n_facets;
    }
    return next;
}

/* Assigns the numbers of vertices and facets. */
static icc_status lay_out(icc_domain *d, size_t n_outer, size_t n, const icc_feature *given,
                          icc_error *err)
{
    iccp_features *features = d->features = iccp_alloc_zero(&d->memory, 1, sizeof *features);
    if (features == NULL)
        return iccp_fail_memory(err);
    features->n = n;
    features->n_outer = features->n_outer_facets = n_outer;
    features->item = iccp_alloc_zero(&d->memory, n, sizeof *features->item);
    if (features->item == NULL)
        return iccp_fail_memory(err);
    d->n_vertices = n_outer;
    for (size_t f = 0; f < n; ++f) {
        features->item[f].kind = given[f].kind;
        features->item[f].first = (uint32_t)d->n_vertices;
        features->item[f].n = (uint32_t)given[f].n_vertices;
        features->item[f].rim_of = UINT32_MAX;
        d->n_vertices += given[f].n_vertices;
        features->n_holes += given[f].kind == ICC_FEATURE_HOLE;
        features->n_lines += given[f].kind == ICC_FEATURE_LINE;
        features->n_points += given[f].kind == ICC_FEATURE_POINT;
        features->n_regions += given[f].kind == ICC_FEATURE_REGION;
    }
    d->n_facets = number_facets(features, given, 0, (uint32_t)n_outer);
    d->n_facets = number_facets(features, given, 1, (uint32_t)d->n_facets);
    features->n_places = number_facets(features, given, 2, (uint32_t)d->n_facets);
    return ICC_OK;
}

/* Writes edges from each of n_facets vertices to the next, and from the last of n back to the
 * first. A point has one edge, to itself. */
static void fill_facets(uint32_t *facets, uint32_t first, uint32_t n, uint32_t n_facets)
{
    for (uint32_t k = 0; k < n_facets; ++k) {
        facets[2 * k] = first + k;
        facets[2 * k + 1] = first + (k + 1) % n;
    }
}

static icc_status copy_boundary(icc_domain *d, const double *outer, const icc_feature *given,
                                icc_error *err)
{
    const iccp_features *features = d->features;
    const size_t n = d->n_vertices, n_outer = features->n_outer;
    d->given = iccp_alloc(&d->memory, n, 2 * sizeof *d->given);
    d->vertices = iccp_alloc(&d->memory, n + 1, 2 * sizeof *d->vertices);
    d->facets = iccp_alloc(&d->memory, features->n_places, 2 * sizeof *d->facets);
    if (d->given == NULL || d->vertices == NULL || d->facets == NULL)
        return iccp_fail_memory(err);
    if (n_outer > 0)
        memcpy(d->given, outer, 2 * n_outer * sizeof *outer);
    fill_facets(d->facets, 0, (uint32_t)n_outer, (uint32_t)n_outer);
    for (size_t f = 0; f < features->n; ++f) {
        const iccp_feature *feature = &features->item[f];
        memcpy(d->given + 2 * (size_t)feature->first, given[f].vertices,
               2 * (size_t)feature->n * sizeof *d->given);
        fill_facets(d->facets + 2 * (size_t)feature->first_facet, feature->first, feature->n,
                    feature->n_facets);
    }
    return ICC_OK;
}

/* ---- local coordinates ---- */

/* Uses the frame of all vertices. So a feature outside the outer ring is also exact, until it is
 * refused. */
static icc_status localise(icc_domain *d, icc_error *err)
{
    const iccp_features *features = d->features;
    icc_error own = {.size = sizeof own};
    icc_status status = iccp_polygon_check_finite(features->n_outer, d->given, err);
    if (status != ICC_OK)
        return status;
    for (size_t f = 0; f < features->n; ++f) {
        const iccp_feature *feature = &features->item[f];
        if (iccp_polygon_check_finite(feature->n, d->given + 2 * (size_t)feature->first, &own) !=
            ICC_OK)
            return iccp_features_blame(err, &own, features, (uint32_t)f);
    }
    iccp_frame_fit(&d->frame, 2, d->n_vertices, d->given);
    status = iccp_polygon_bring_in(&d->frame, d->vertices, features->n_outer, d->given, err);
    if (status != ICC_OK)
        return status;
    for (size_t f = 0; f < features->n; ++f) {
        const iccp_feature *feature = &features->item[f];
        const size_t first = 2 * (size_t)feature->first;
        if (iccp_polygon_bring_in(&d->frame, d->vertices + first, feature->n, d->given + first,
                                  &own) != ICC_OK)
            return iccp_features_blame(err, &own, features, (uint32_t)f);
    }
    memcpy(d->vertices + 2 * d->n_vertices, d->vertices, 2 * sizeof *d->vertices);
    return ICC_OK;
}

static double ring_area(const icc_domain *d, size_t first, size_t n)
{
    const iccp_polygon ring = {.n = n, .points = d->vertices + 2 * first};
    return iccp_polygon_area(&ring);
}

/* Adds up the areas in the rings of the rim; those around holes turn right. `ring` has room for all
 * facets of the boundary, and `seen` is 0 for each half-side. */
static double rim_area(const icc_domain *d, double *ring, uint8_t *seen)
{
    const iccp_network *net = d->features->network;
    double area = 0;
    for (uint32_t first = 0; first < 2 * d->n_facets; ++first) {
        if (!iccp_network_is_rim(net, first / 2) || net->face[first] == ICCP_NO_FACE || seen[first])
            continue;
        size_t n = 0;
        double twice = 0; /* only its sign counts */
        for (uint32_t h = first; !seen[h]; h = iccp_network_next_on_rim(net, d, h)) {
            const double *a = d->vertices + 2 * (size_t)d->facets[h];
            const double *b = d->vertices + 2 * (size_t)d->facets[h ^ 1];
            seen[h] = 1;
            memcpy(ring + 2 * n++, a, 2 * sizeof *a);
            twice += a[0] * b[1] - b[0] * a[1];
        }
        const iccp_polygon polygon = {.n = n, .points = ring};
        area += twice < 0 ? -iccp_polygon_area(&polygon) : iccp_polygon_area(&polygon);
    }
    return area;
}

static icc_status measure(icc_domain *d, const iccp_env *env)
{
    const iccp_features *features = d->features;
    icc_status status = ICC_OK;
    if (features->n_regions > 0) {
        double *ring = iccp_alloc(&env->memory, d->n_facets, 2 * sizeof *ring);
        uint8_t *seen = iccp_alloc_zero(&env->memory, 2 * d->n_facets, sizeof *seen);
        status = ring != NULL && seen != NULL ? ICC_OK : ICC_ERR_MEMORY;
        if (status == ICC_OK)
            d->measure = rim_area(d, ring, seen);
        iccp_free(&env->memory, ring);
        iccp_free(&env->memory, seen);
    } else {
        d->measure = ring_area(d, 0, features->n_outer);
        for (size_t f = 0; f < features->n; ++f)
            if (features->item[f].kind == ICC_FEATURE_HOLE)
                d->measure -= ring_area(d, features->item[f].first, features->item[f].n);
    }
    d->measure = d->measure > 0 ? d->measure : 0; /* negative only by rounding */
    return status;
}

/* Makes the tree over the rim. */
static icc_status make_tree(icc_domain *d, const iccp_env *env)
{
    const iccp_network *net = d->features->network;
    uint32_t *rim = iccp_alloc(&env->memory, net->n_rim, sizeof *rim);
    size_t n = 0;
    if (rim == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t f = 0; f < d->n_facets; ++f)
        if (iccp_network_is_rim(net, f))
            rim[n++] = f;
    iccp_facet_tree_create_some(&d->tree, 2, d->vertices, n, rim, d->facets, &d->memory);
    iccp_free(&env->memory, rim);
    return d->tree.boxes != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

static icc_status complete(icc_domain *d, const iccp_env *env, icc_error *err)
{
    icc_status status = localise(d, err);
    if (status == ICC_OK)
        status = iccp_features_check(d, env, err);
    if (status != ICC_OK)
        return status;
    iccp_domain_measure_box(d);
    status = measure(d, env);
    if (status == ICC_OK)
        status = make_tree(d, env);
    return iccp_explain(err, status);
}

static icc_status create(icc_domain **out, size_t n_outer, const double *outer, size_t n_features,
                         const icc_feature *features, const iccp_env *env, icc_error *err)
{
    bool has_regions = false;
    for (size_t f = 0; f < n_features; ++f)
        has_regions |= features[f].kind == ICC_FEATURE_REGION;
    icc_status status = ICC_OK;
    if (n_outer == 0 && !has_regions)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "there must be an outer ring or a region");
    if (n_outer > 0)
        status = iccp_polygon_check_counts(n_outer, 0, NULL, err);
    if (status != ICC_OK)
        return status;
    icc_domain *domain = iccp_domain_new(2, &OPS, &env->memory);
    if (domain == NULL)
        return iccp_fail_memory(err);
    status = lay_out(domain, n_outer, n_features, features, err);
    if (status == ICC_OK)
        status = copy_boundary(domain, outer, features, err);
    if (status == ICC_OK)
        status = complete(domain, env, err);
    if (status != ICC_OK) {
        iccp_domain_release(domain);
        return status;
    }
    *out = domain;
    return ICC_OK;
}

/* ---- points with a radius ---- */

/* A regular polygon without one of its edges, because lines do not close. */
static void place_rim(double rim[2 * ICCP_RIM], const icc_feature *point)
{
    static const double cosine[ICCP_RIM] = {
        1,  0.92387953251128674,  0.70710678118654752,  0.38268343236508977,
        0,  -0.38268343236508977, -0.70710678118654752, -0.92387953251128674,
        -1, -0.92387953251128674, -0.70710678118654752, -0.38268343236508977,
        0,  0.38268343236508977,  0.70710678118654752,  0.92387953251128674};
    for (int k = 0; k < ICCP_RIM; ++k) {
        rim[2 * k] = point->vertices[0] + point->radius * cosine[k];
        rim[2 * k + 1] = point->vertices[1] + point->radius * cosine[(k + 12) % ICCP_RIM];
    }
}

icc_status iccp_domain_create_features(icc_domain **out, size_t n_outer, const double *outer,
                                       size_t n_features, const icc_feature *features,
                                       const iccp_env *env, icc_error *err)
{
    size_t n_rims = 0, n = n_features;
    if (n_features == 0)
        return iccp_polygon_domain_create(out, n_outer, outer, 0, NULL, env, err);
    *out = NULL;
    for (size_t f = 0; f < n_features; ++f)
        n_rims += features[f].radius > 0;
    if (n_rims == 0)
        return create(out, n_outer, outer, n_features, features, env, err);
    icc_feature *all = iccp_alloc(&env->memory, n_features + n_rims, sizeof *all);
    double *rims = iccp_alloc(&env->memory, n_rims, 2 * ICCP_RIM * sizeof *rims);
    icc_status status = all != NULL && rims != NULL ? ICC_OK : iccp_fail_memory(err);
    if (status == ICC_OK) {
        memcpy(all, features, n_features * sizeof *all);
        for (size_t f = 0; f < n_features; ++f)
            if (features[f].radius > 0) {
                double *rim = rims + 2 * ICCP_RIM * (n - n_features);
                place_rim(rim, &features[f]);
                all[n++] = (icc_feature){
                    .kind = ICC_FEATURE_LINE, .n_vertices = ICCP_RIM, .vertices = rim};
            }
        status = create(out, n_outer, outer, n, all, env, err);
    }
    n = n_features;
    for (size_t f = 0; f < n_features && status == ICC_OK; ++f)
        if (features[f].radius > 0)
            (*out)->features->item[n++].rim_of = (uint32_t)f;
    iccp_free(&env->memory, all);
    iccp_free(&env->memory, rims);
    return status;
}
