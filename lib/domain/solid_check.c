/* Checks the surfaces, lines and points of a solid with features.
 *
 * First each surface is checked by itself, in its own numbers. Then one search finds triangles that
 * meet (geometry/triangles.h), and wires.h finds lines and points that meet anything. Then nothing
 * meets, so rays tell exactly which surface lies in which (closed_surfaces.h). */
#include "domain/solid_check.h"

#include "base/error.h"
#include "base/minmax.h"
#include "domain/closed_surfaces.h"
#include "domain/features_check.h"
#include "domain/simplicial.h"
#include "domain/wires.h"
#include "geometry/triangles.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct check {
    icc_domain *domain;
    const iccp_env *env;
    icc_error *err;
    iccp_facet_tree tree; /* over all triangles */
    uint32_t *across;     /* of all triangles: domain/complex.h */
    uint32_t *own;        /* the facets of one feature in its own numbers */
    iccp_surfaces surfaces;
    /* By surface: its feature, or NONE for pieces of the outer surface; number of the region inside
     * it, or ICCP_NO_REGION */
    uint32_t *owner, *inside;
} check;

/* Completes a message that is in the numbers of a feature, or of the outer surface (NONE). */
static icc_status blame(const iccp_features *features, uint32_t feature, const icc_error *own,
                        icc_error *err)
{
    if (feature != NONE && own->status != ICC_ERR_MEMORY && own->status != ICC_ERR_CANCELLED)
        return iccp_features_blame(err, own, features, feature);
    iccp_error_copy(err, own);
    return own->status;
}

static bool is_surface(const iccp_features *features, uint32_t f)
{
    return f == NONE || iccp_feature_is_ring(features->item[f].kind);
}

/* ------------------------------------------------------------------ numbers */

static icc_status check_used(const iccp_complex *c, bool *used, icc_error *err)
{
    memset(used, 0, c->n_vertices * sizeof *used);
    for (size_t i = 0; i < 3 * c->n_facets; ++i)
        used[c->facets[i]] = true;
    for (size_t v = 0; v < c->n_vertices; ++v)
        if (!used[v])
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)v,
                                "vertex %zu belongs to no face: leave it out", v);
    return ICC_OK;
}

static icc_status check_surface_numbers(const iccp_complex *c, bool *used, icc_error *err)
{
    if (c->n_facets < 4)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "a closed surface has at least 4 faces, not %zu",
                         c->n_facets);
    const icc_status status = iccp_complex_check_indices(c, err);
    return status == ICC_OK ? check_used(c, used, err) : status;
}

icc_status iccp_solid_features_numbers(const iccp_features *features, const iccp_outer *outer,
                                       const icc_feature *given, const iccp_env *env,
                                       icc_error *err)
{
    size_t most = outer->n_vertices;
    icc_error own = {.size = sizeof own};
    for (size_t f = 0; f < features->n; ++f)
        most = given[f].n_vertices > most ? given[f].n_vertices : most;
    bool *used = iccp_alloc(&env->memory, most, sizeof *used);
    if (used == NULL)
        return iccp_fail_memory(err);
    const iccp_complex whole = {3, outer->n_vertices, outer->n_facets, outer->facets, NULL};
    icc_status status = check_surface_numbers(&whole, used, err);
    for (uint32_t f = 0; f < features->n && status == ICC_OK; ++f)
        if (is_surface(features, f)) {
            const iccp_complex c = {3, given[f].n_vertices, given[f].n_facets, given[f].facets,
                                    NULL};
            status = check_surface_numbers(&c, used, &own);
            if (status != ICC_OK)
                (void)blame(features, f, &own, err);
        }
    iccp_free(&env->memory, used);
    return status;
}

/* -------------------------------------------------------------- coordinates */

static icc_status fail_number(const check *c, uint32_t v, const char *what)
{
    const iccp_features *features = c->domain->features;
    const uint32_t feature = iccp_feature_of_vertex(features, v);
    icc_error own = {.size = sizeof own};
    const unsigned long number = iccp_feature_vertex(features, feature, v);
    (void)iccp_fail_at(&own, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)number, "vertex %lu %s",
                       number, what);
    return blame(features, feature, &own, c->err);
}

/* Uses the frame of all vertices. So a feature outside is also exact, until it is refused. */
static icc_status localise(const check *c)
{
    icc_domain *d = c->domain;
    for (uint32_t v = 0; v < d->n_vertices; ++v)
        for (size_t k = 0; k < 3; ++k)
            if (!isfinite(d->given[3 * (size_t)v + k]))
                return fail_number(c, v, "is not finite");
    iccp_frame_fit(&d->frame, 3, d->n_vertices, d->given);
    for (uint32_t v = 0; v < d->n_vertices; ++v) {
        const double *x = d->given + 3 * (size_t)v;
        if (!iccp_frame_holds(&d->frame, 3, x))
            return fail_number(
                c, v, "has a coordinate that is not 0, but less than 2^-200 of the largest one");
        iccp_frame_in(&d->frame, 3, x, d->vertices + 3 * (size_t)v);
    }
    return ICC_OK;
}

/* ------------------------------------------------------- one surface by itself */

/* Joins the facets of a surface in its own numbers, and checks that they form one closed surface
 * without flat facets. The outer surface may have several pieces. */
static icc_status check_closed(const check *c, uint32_t f, icc_error *err)
{
    const icc_domain *d = c->domain;
    const iccp_feature *item = f != NONE ? &d->features->item[f] : NULL;
    const size_t first = item != NULL ? item->first : 0;
    const size_t first_facet = item != NULL ? item->first_facet : 0;
    iccp_complex own = {3, item != NULL ? item->n : d->features->n_outer,
                        item != NULL ? item->n_facets : d->features->n_outer_facets, c->own,
                        c->across + 3 * first_facet};
    const iccp_facet_tree part = {.dim = 3,
                                  .n_corners = 3,
                                  .n = own.n_facets,
                                  .vertices = d->vertices + 3 * first,
                                  .facets = c->own};
    for (size_t i = 0; i < 3 * own.n_facets; ++i)
        c->own[i] = d->facets[3 * first_facet + i] - (uint32_t)first;
    icc_status status = iccp_complex_join(&own, c->env, err);
    if (status == ICC_OK)
        status = f == NONE ? iccp_complex_check_vertices(&own, c->env, err)
                           : iccp_complex_check_connected(&own, c->env, err);
    if (status == ICC_OK)
        status = iccp_simplicial_check_flat(&part, err);
    for (size_t i = 0; i < 3 * own.n_facets && status == ICC_OK; ++i)
        own.across[i] += (uint32_t)first_facet;
    return status;
}

static icc_status check_each(const check *c)
{
    const iccp_features *features = c->domain->features;
    icc_status status = ICC_OK;
    for (uint32_t k = 0; k <= features->n && status == ICC_OK; ++k) {
        const uint32_t f = k - 1; /* NONE first */
        icc_error own = {.size = sizeof own};
        if (!is_surface(features, f))
            continue;
        status = check_closed(c, f, &own);
        if (status != ICC_OK)
            (void)blame(features, f, &own, c->err);
    }
    return status;
}

/* ------------------------------------------------------------------- meeting */

/* A triangle, a segment or a point, as in a message. */
typedef struct named {
    uint32_t feature;
    unsigned long number;
    const char *noun;
    char text[ICCP_FEATURE_TEXT];
    const char *name;
    double box[6];
} named;

static void name_corners(const check *c, named *n, uint32_t feature, size_t n_corners,
                         const uint32_t *corners)
{
    const iccp_facet_tree one = {
        .dim = 3, .n_corners = n_corners, .vertices = c->domain->vertices, .facets = corners};
    n->feature = feature;
    n->name = iccp_feature_text(c->domain->features, feature, n->text);
    iccp_facet_box_of(&one, 3, n_corners, 0, n->box);
}

static void name_facet(const check *c, named *n, uint32_t facet)
{
    const iccp_features *features = c->domain->features;
    uint32_t feature = NONE;
    for (uint32_t f = 0; f < features->n; ++f)
        if (facet - features->item[f].first_facet < features->item[f].n_facets)
            feature = f;
    name_corners(c, n, feature, 3, c->domain->facets + 3 * (size_t)facet);
    n->number = iccp_feature_facet(features, feature, facet);
    n->noun = "face";
}

static void name_wire(const check *c, named *n, const uint32_t ends[2])
{
    const iccp_features *features = c->domain->features;
    const uint32_t feature = iccp_feature_of_vertex(features, ends[0]);
    name_corners(c, n, feature, 2, ends);
    n->number = iccp_feature_vertex(features, feature, ends[0]);
    n->noun = features->item[feature].kind == ICC_FEATURE_POINT ? "vertex" : "edge";
}

/* Reports two things that meet. The outer surface is never at fault for a feature. */
static icc_status fail_meeting(const check *c, const named *a, const named *b)
{
    const named *n[2] = {a, b};
    double at[3];
    if (a->feature + 1 < b->feature + 1) { /* NONE first */
        n[0] = b;
        n[1] = a;
    }
    for (int k = 0; k < 3; ++k)
        at[k] = 0.5 * (iccp_max(a->box[k], b->box[k]) + iccp_min(a->box[3 + k], b->box[3 + k]));
    iccp_frame_out(&c->domain->frame, 3, at, at);
    const bool is_outer = n[1]->feature == NONE;
    return iccp_fail_at(
        c->err, is_outer ? ICC_ERR_OUTSIDE : ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, n[0]->feature,
        "%s, %s %lu, meets %s, %s %lu, near (%.9g, %.9g, %.9g): move it away", n[0]->name,
        n[0]->noun, n[0]->number, n[1]->name, n[1]->noun, n[1]->number, at[0], at[1], at[2]);
}

/* Reports a feature, or the outer surface, that meets itself. */
static icc_status fail_itself(const check *c, const named *a, const named *b)
{
    const char *what = is_surface(c->domain->features, a->feature) ? "surface" : "line";
    icc_error own = {.size = sizeof own};
    double at[3];
    for (int k = 0; k < 3; ++k)
        at[k] = 0.5 * (iccp_max(a->box[k], b->box[k]) + iccp_min(a->box[3 + k], b->box[3 + k]));
    iccp_frame_out(&c->domain->frame, 3, at, at);
    (void)iccp_fail_at(&own, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)a->number,
                       "the %s meets itself: %ss %lu and %lu meet near (%.9g, %.9g, %.9g)", what,
                       a->noun, a->number, b->number, at[0], at[1], at[2]);
    return blame(c->domain->features, a->feature, &own, c->err);
}

static icc_status fail_pair(const check *c, const named *a, const named *b)
{
    return a->feature == b->feature ? fail_itself(c, a, b) : fail_meeting(c, a, b);
}

static icc_status check_triangles(const check *c)
{
    uint32_t pair[2];
    named names[2];
    const icc_status status = iccp_triangles_find(&c->tree, c->domain->n_vertices, pair, c->env);
    if (status != ICC_OK)
        return iccp_explain(c->err, status);
    if (pair[0] == pair[1])
        return ICC_OK;
    name_facet(c, &names[0], pair[0]);
    name_facet(c, &names[1], pair[1]);
    return fail_pair(c, &names[0], &names[1]);
}

static icc_status check_repeated(const check *c)
{
    const iccp_features *features = c->domain->features;
    for (uint32_t f = 0; f < features->n; ++f) {
        const double *x = c->domain->vertices + 3 * (size_t)features->item[f].first;
        if (features->item[f].kind != ICC_FEATURE_LINE)
            continue;
        for (uint32_t i = 1; i < features->item[f].n; ++i)
            if (x[3 * i] == x[3 * i - 3] && x[3 * i + 1] == x[3 * i - 2] &&
                x[3 * i + 2] == x[3 * i - 1])
                return fail_number(c, features->item[f].first + i, "repeats the vertex before it");
    }
    return ICC_OK;
}

static icc_status check_wires(const check *c)
{
    iccp_contact contact;
    named names[2];
    icc_status status = check_repeated(c);
    if (status != ICC_OK)
        return status;
    status = iccp_wires_find(&contact, c->domain, &c->tree, c->env);
    if (status != ICC_OK)
        return iccp_explain(c->err, status);
    if (contact.wire[0] == NONE)
        return ICC_OK;
    name_wire(c, &names[0], contact.wire);
    if (contact.facet != NONE)
        name_facet(c, &names[1], contact.facet);
    else
        name_wire(c, &names[1], contact.other);
    return fail_pair(c, &names[0], &names[1]);
}

/* ------------------------------------------------------------------- nesting */

/* Reports a vertex of a feature that lies outside the outer surface, or in a surface without a
 * domain inside. */
static icc_status fail_place(const check *c, uint32_t feature, uint32_t v, uint32_t surface)
{
    const iccp_features *features = c->domain->features;
    char names[2][ICCP_FEATURE_TEXT];
    const char *name = iccp_feature_text(features, feature, names[0]);
    const unsigned long number = iccp_feature_vertex(features, feature, v);
    if (surface == NONE)
        return iccp_fail_at(c->err, ICC_ERR_OUTSIDE, ICC_ITEM_FEATURE, feature,
                            "%s, vertex %lu, lies outside the outer surface: move it inside", name,
                            number);
    if (c->owner[surface] == NONE)
        return iccp_fail_at(c->err, ICC_ERR_OUTSIDE, ICC_ITEM_FEATURE, feature,
                            "%s, vertex %lu, lies in the void of the outer surface with face %lu: "
                            "move it out, since voids are empty",
                            name, number, (unsigned long)c->surfaces.item[surface].first_facet);
    return iccp_fail_at(c->err, ICC_ERR_OUTSIDE, ICC_ITEM_FEATURE, feature,
                        "%s, vertex %lu, lies in %s: move it out, or make the void a region", name,
                        number, iccp_feature_text(features, c->owner[surface], names[1]));
}

/* Notes the feature and the region within each surface. `outer` is the outermost one. */
static void describe_surfaces(check *c, uint32_t outer)
{
    const iccp_features *features = c->domain->features;
    uint32_t n_regions = 0;
    for (size_t k = 0; k < c->surfaces.n; ++k)
        c->owner[k] = c->inside[k] = NONE;
    c->inside[outer] = 0;
    for (uint32_t f = 0; f < features->n; ++f)
        if (is_surface(features, f)) {
            const uint32_t k = c->surfaces.of_facet[features->item[f].first_facet];
            c->owner[k] = f;
            if (features->item[f].kind == ICC_FEATURE_REGION)
                c->inside[k] = ++n_regions;
        }
}

/* Returns the outermost piece of the outer surface, which has its lowest vertex. */
static uint32_t find_outer(const check *c)
{
    const uint32_t n = (uint32_t)c->domain->features->n_outer;
    uint32_t lowest = 0, k = 0;
    for (uint32_t v = 1; v < n; ++v)
        if (iccp_surface_is_lower(&c->tree, v, lowest))
            lowest = v;
    while (c->surfaces.item[k].lowest != lowest)
        ++k;
    return k;
}

/* Checks a piece of the outer surface, which must be the outermost one or a void. */
static icc_status check_piece(const check *c, uint32_t outer, uint32_t k)
{
    uint32_t around = c->surfaces.item[k].around;
    if (around == NONE && k == outer)
        return ICC_OK;
    if (around != NONE && c->owner[around] != NONE) {
        const uint32_t feature = c->owner[around];
        if (k == outer)
            return fail_place(c, feature, c->surfaces.item[around].lowest, NONE);
        if (c->inside[around] == ICCP_NO_REGION)
            return iccp_fail_at(c->err, ICC_ERR_OUTSIDE, ICC_ITEM_FEATURE, feature,
                                "feature %lu (a void) goes around the void of the outer surface "
                                "with face %lu: leave that one out",
                                (unsigned long)feature,
                                (unsigned long)c->surfaces.item[k].first_facet);
        around = outer; /* a void in a region */
    }
    return iccp_surfaces_check_void(&c->surfaces, outer, k, around, c->err);
}

/* Checks that each surface lies in the domain. */
static icc_status check_nesting(const check *c, uint32_t outer)
{
    icc_status status = ICC_OK;
    for (uint32_t k = 0; k < c->surfaces.n && status == ICC_OK; ++k) {
        const iccp_surface *s = &c->surfaces.item[k];
        if (c->owner[k] == NONE)
            status = check_piece(c, outer, k);
        else if (s->around == NONE || c->inside[s->around] == ICCP_NO_REGION)
            status = fail_place(c, c->owner[k], s->lowest, s->around);
    }
    return status;
}

/* Finds the regions in which lines and points lie. One vertex tells, since they meet nothing. */
static icc_status place_wires(check *c)
{
    icc_domain *d = c->domain;
    for (uint32_t f = 0; f < d->features->n; ++f) {
        iccp_feature *item = &d->features->item[f];
        if (is_surface(d->features, f))
            continue;
        const uint32_t k = iccp_surfaces_around(&c->surfaces, &c->tree,
                                                d->vertices + 3 * (size_t)item->first, NONE);
        if (k == NONE || c->inside[k] == ICCP_NO_REGION)
            return fail_place(c, f, item->first, k);
        item->around = c->inside[k];
    }
    return ICC_OK;
}

/* Writes what is known of the surfaces to the domain and its features. */
static void fill_in(check *c, uint32_t outer)
{
    icc_domain *d = c->domain;
    d->orientation = c->surfaces.item[outer].orientation;
    for (uint32_t k = 0; k < c->surfaces.n; ++k) {
        const iccp_surface *s = &c->surfaces.item[k];
        const size_t genus = iccp_surface_genus(s);
        const bool bounds = k == outer || c->inside[k] == ICCP_NO_REGION;
        d->genus += bounds ? genus : 0;
        d->n_voids += bounds && k != outer;
        if (c->owner[k] != NONE) {
            iccp_feature *item = &d->features->item[c->owner[k]];
            item->orientation = s->orientation;
            item->genus = (uint32_t)genus;
            item->around = c->inside[s->around];
        }
    }
    for (size_t f = 0; f < d->features->n_places; ++f) {
        const uint32_t k = c->surfaces.of_facet[f], around = c->surfaces.item[k].around;
        const size_t front = c->surfaces.item[k].orientation < 0;
        d->features->sides[2 * f + front] = around == NONE ? ICCP_NO_REGION : c->inside[around];
        d->features->sides[2 * f + 1 - front] = c->inside[k];
    }
}

static icc_status check_places(check *c)
{
    const iccp_complex whole = {3, c->domain->n_vertices, c->domain->features->n_places,
                                c->domain->facets, c->across};
    const iccp_memory *memory = &c->env->memory;
    icc_status status =
        iccp_explain(c->err, iccp_surfaces_create(&c->surfaces, &whole, &c->tree, c->env));
    if (status != ICC_OK)
        return status;
    c->owner = iccp_alloc(memory, c->surfaces.n, sizeof *c->owner);
    c->inside = iccp_alloc(memory, c->surfaces.n, sizeof *c->inside);
    if (c->owner == NULL || c->inside == NULL)
        status = iccp_fail_memory(c->err);
    if (status == ICC_OK) {
        const uint32_t outer = find_outer(c);
        describe_surfaces(c, outer);
        status = check_nesting(c, outer);
        if (status == ICC_OK)
            status = place_wires(c);
        if (status == ICC_OK)
            fill_in(c, outer);
    }
    iccp_free(memory, c->owner);
    iccp_free(memory, c->inside);
    iccp_surfaces_free(&c->surfaces, memory);
    return status;
}

/* ----------------------------------------------------------------------- all */

static icc_status check_all(check *c)
{
    const icc_domain *d = c->domain;
    icc_status status = localise(c);
    if (status == ICC_OK)
        status = check_each(c);
    if (status != ICC_OK)
        return status;
    iccp_facet_tree_create(&c->tree, 3, d->vertices, d->features->n_places, d->facets,
                           &c->env->memory);
    if (c->tree.boxes == NULL)
        return iccp_fail_memory(c->err);
    status = check_triangles(c);
    if (status == ICC_OK)
        status = check_wires(c);
    return status == ICC_OK ? check_places(c) : status;
}

icc_status iccp_solid_features_check(icc_domain *domain, const iccp_env *env, icc_error *err)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = domain->features->n_places;
    check c = {.domain = domain, .env = env, .err = err};
    c.across = iccp_alloc(memory, n, 3 * sizeof *c.across);
    c.own = iccp_alloc(memory, n, 3 * sizeof *c.own);
    const icc_status status =
        c.across != NULL && c.own != NULL ? check_all(&c) : iccp_fail_memory(err);
    iccp_facet_tree_free(&c.tree, memory);
    iccp_free(memory, c.across);
    iccp_free(memory, c.own);
    return status;
}
