/* Solids with voids, inner surfaces, lines and points inside. */
#include "domain/solid_domain.h"

#include "base/error.h"
#include "domain/domain_make.h"
#include "domain/scan_surface.h"
#include "domain/simplicial.h"
#include "domain/solid_check.h"
#include "domain/tree_cross.h"
#include "domain/tree_locate.h"

#include <math.h>
#include <string.h>

static void clear(icc_domain *domain)
{
    if (domain->features != NULL) {
        iccp_free(&domain->memory, domain->features->item);
        iccp_free(&domain->memory, domain->features->sides);
    }
    iccp_free(&domain->memory, domain->features);
    iccp_facet_tree_free(&domain->tree, &domain->memory);
}

static const iccp_domain_ops OPS = {iccp_tree_own, iccp_tree_locate, iccp_tree_cross,
                                    iccp_scan_surface, clear};

/* ---- numbers ---- */

/* Numbers the facets of features of a kind. Returns the next free number. */
static uint32_t number_facets(iccp_features *features, int32_t kind, uint32_t next)
{
    for (size_t f = 0; f < features->n; ++f)
        if (features->item[f].kind == kind) {
            features->item[f].first_facet = next;
            next += features->item[f].n_facets;
        }
    return next;
}

/* Assigns the numbers of vertices and facets. */
static icc_status lay_out(icc_domain *d, const iccp_outer *outer, size_t n,
                          const icc_feature *given, icc_error *err)
{
    iccp_features *features = d->features = iccp_alloc_zero(&d->memory, 1, sizeof *features);
    if (features == NULL)
        return iccp_fail_memory(err);
    features->n = n;
    features->n_outer = outer->n_vertices;
    features->n_outer_facets = outer->n_facets;
    features->in_space = true;
    features->item = iccp_alloc_zero(&d->memory, n, sizeof *features->item);
    if (features->item == NULL)
        return iccp_fail_memory(err);
    d->n_vertices = outer->n_vertices;
    for (size_t f = 0; f < n; ++f) {
        iccp_feature *item = &features->item[f];
        item->kind = given[f].kind;
        item->first = (uint32_t)d->n_vertices;
        item->n = (uint32_t)given[f].n_vertices;
        item->n_facets = (uint32_t)given[f].n_facets;
        item->rim_of = UINT32_MAX;
        d->n_vertices += given[f].n_vertices;
        features->n_holes += item->kind == ICC_FEATURE_HOLE;
        features->n_lines += item->kind == ICC_FEATURE_LINE;
        features->n_points += item->kind == ICC_FEATURE_POINT;
        features->n_regions += item->kind == ICC_FEATURE_REGION;
    }
    d->n_facets = number_facets(features, ICC_FEATURE_HOLE, (uint32_t)outer->n_facets);
    features->n_places = number_facets(features, ICC_FEATURE_REGION, (uint32_t)d->n_facets);
    return ICC_OK;
}

static icc_status make_room(icc_domain *d)
{
    d->given = iccp_alloc(&d->memory, d->n_vertices, 3 * sizeof *d->given);
    d->vertices = iccp_alloc(&d->memory, d->n_vertices, 3 * sizeof *d->vertices);
    d->facets = iccp_alloc(&d->memory, d->features->n_places, 3 * sizeof *d->facets);
    d->features->sides =
        iccp_alloc(&d->memory, d->features->n_places, 2 * sizeof *d->features->sides);
    return d->given != NULL && d->vertices != NULL && d->facets != NULL &&
                   d->features->sides != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static void copy_given(icc_domain *d, const iccp_outer *outer, const icc_feature *given)
{
    memcpy(d->given, outer->vertices, 3 * outer->n_vertices * sizeof *d->given);
    memcpy(d->facets, outer->facets, 3 * outer->n_facets * sizeof *d->facets);
    for (size_t f = 0; f < d->features->n; ++f) {
        const iccp_feature *item = &d->features->item[f];
        uint32_t *to = d->facets + 3 * (size_t)item->first_facet;
        memcpy(d->given + 3 * (size_t)item->first, given[f].vertices,
               3 * (size_t)item->n * sizeof *d->given);
        for (size_t i = 0; i < 3 * (size_t)item->n_facets; ++i)
            to[i] = item->first + given[f].facets[i];
    }
}

/* ---- what follows from the checked boundary ---- */

/* Returns the volume within a surface, in local units. */
static double volume(const icc_domain *d, size_t first_facet, size_t n_facets)
{
    const iccp_facet_tree part = {.dim = 3,
                                  .n_corners = 3,
                                  .n = n_facets,
                                  .vertices = d->vertices,
                                  .facets = d->facets + 3 * first_facet};
    int32_t orientation;
    double measure;
    (void)iccp_simplicial_measure(&part, &orientation, &measure, NULL);
    return measure;
}

static void measure(icc_domain *d)
{
    const iccp_features *features = d->features;
    d->measure = volume(d, 0, features->n_outer_facets);
    for (size_t f = 0; f < features->n; ++f)
        if (features->item[f].kind == ICC_FEATURE_HOLE)
            d->measure -= volume(d, features->item[f].first_facet, features->item[f].n_facets);
    d->measure = d->measure > 0 ? d->measure : 0; /* negative only by rounding */
}

/* Makes the tree over the boundary. */
static icc_status make_tree(icc_domain *d)
{
    iccp_facet_tree_create(&d->tree, 3, d->vertices, d->n_facets, d->facets, &d->memory);
    return d->tree.boxes != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_domain_create_solid(icc_domain **out, const iccp_outer *outer, size_t n_features,
                                    const icc_feature *features, const iccp_env *env,
                                    icc_error *err)
{
    *out = NULL;
    icc_domain *d = iccp_domain_new(3, &OPS, &env->memory);
    if (d == NULL)
        return iccp_fail_memory(err);
    icc_status status = lay_out(d, outer, n_features, features, err);
    if (status == ICC_OK)
        status = iccp_solid_features_numbers(d->features, outer, features, env, err);
    if (status == ICC_OK)
        status = iccp_explain(err, make_room(d));
    if (status == ICC_OK) {
        copy_given(d, outer, features);
        status = iccp_solid_features_check(d, env, err);
    }
    if (status == ICC_OK) {
        iccp_domain_measure_box(d);
        measure(d);
        status = iccp_explain(err, make_tree(d));
    }
    if (status != ICC_OK) {
        iccp_domain_release(d);
        return status;
    }
    *out = d;
    return ICC_OK;
}

/* ---- copies ---- */

static icc_status copy_features(icc_domain *d, const icc_domain *from)
{
    iccp_features *features = d->features = iccp_alloc(&d->memory, 1, sizeof *features);
    if (features == NULL)
        return ICC_ERR_MEMORY;
    *features = *from->features;
    features->sides = NULL;
    features->item = iccp_alloc(&d->memory, features->n, sizeof *features->item);
    if (features->item == NULL || make_room(d) != ICC_OK)
        return ICC_ERR_MEMORY;
    memcpy(features->item, from->features->item, features->n * sizeof *features->item);
    memcpy(features->sides, from->features->sides,
           2 * features->n_places * sizeof *features->sides);
    memcpy(d->given, from->given, 3 * d->n_vertices * sizeof *d->given);
    memcpy(d->vertices, from->vertices, 3 * d->n_vertices * sizeof *d->vertices);
    memcpy(d->facets, from->facets, 3 * features->n_places * sizeof *d->facets);
    return make_tree(d);
}

icc_status iccp_solid_domain_copy(icc_domain **out, const icc_domain *solid,
                                  const iccp_memory *memory)
{
    *out = NULL;
    icc_domain *d = iccp_domain_new(3, &OPS, memory);
    if (d == NULL)
        return ICC_ERR_MEMORY;
    d->orientation = solid->orientation;
    d->n_vertices = solid->n_vertices;
    d->n_facets = solid->n_facets;
    d->frame = solid->frame;
    d->measure = solid->measure;
    d->genus = solid->genus;
    d->n_voids = solid->n_voids;
    const icc_status status = copy_features(d, solid);
    if (status != ICC_OK) {
        iccp_domain_release(d);
        return status;
    }
    iccp_domain_measure_box(d);
    *out = d;
    return ICC_OK;
}
