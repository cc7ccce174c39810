/* Carries points by one map or several. A map takes each facet of the cage linearly to its image.
 * So a point on the cage gets its image from the facet alone, and no rounding can put it outside
 * again. */
#include "geo/carrier.h"

#include "base/allocate.h"
#include "geo/rim.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void carrier_start(carrier *out, bool inverse, const icc_env *env)
{
    *out = (carrier){.env = env, .inverse = inverse, .matched = true};
    for (size_t k = 0; k < ICC_MAX_DIM; k++) {
        out->lower[k] = HUGE_VAL;
        out->upper[k] = -HUGE_VAL;
    }
}

/* Reverses y of points of one side if the maps' domains have it reversed. */
static void flip_y(const carrier *c, size_t side, size_t n, double *points)
{
    for (size_t i = 0; c->flipped[side] && i < n; i++)
        points[2 * i + 1] = 0 - points[2 * i + 1];
}

/* Adds the vertices of one side after those present, and its first n_facets facets. */
static icc_status add_boundary(carrier *c, size_t side, const icc_domain *domain,
                               const icc_domain_info *info, size_t n_facets)
{
    size_t dim = c->dim, n = info->n_vertices;
    c->vertices[side] =
        grow(c->vertices[side], &c->room_vertices[side], dim * (c->n_vertices + n), sizeof(double));
    c->facets[side] = grow(c->facets[side], &c->room_facets[side],
                           dim * (c->n_facets + info->n_facets), sizeof(uint32_t));
    uint32_t *facets = c->facets[side] + dim * c->n_facets;
    icc_status status =
        icc_domain_get_boundary(domain, c->vertices[side] + dim * c->n_vertices, facets);
    flip_y(c, side, n, c->vertices[side] + dim * c->n_vertices);
    for (size_t i = 0; i < dim * n_facets; i++)
        facets[i] += (uint32_t)c->n_vertices;
    return status;
}

/* An outer ring or region has the inside on its left if it is counter-clockwise, and a hole if it is
 * clockwise. */
static void add_directions(carrier *c, const icc_domain *from, const icc_domain_info *domain,
                           size_t n_facets)
{
    c->reversed = grow(c->reversed, &c->room_reversed, c->n_facets + n_facets, sizeof *c->reversed);
    for (size_t i = 0; i < n_facets; i++)
        c->reversed[c->n_facets + i] = (domain->orientation < 0) != c->flipped[0];
    for (size_t k = 0; k < domain->n_features; k++) {
        icc_feature_info hole = {.size = sizeof hole};
        icc_domain_get_feature(from, k, &hole);
        bool is_hole = hole.kind == ICC_FEATURE_HOLE;
        if (!is_hole && hole.kind != ICC_FEATURE_REGION)
            continue;
        for (size_t i = 0; i < hole.n_vertices; i++)
            c->reversed[c->n_facets + hole.first_facet + i] =
                (hole.orientation > 0) == (is_hole != c->flipped[0]);
    }
}

static bool has_regions(const icc_domain *domain, const icc_domain_info *info)
{
    bool found = false;
    for (size_t k = 0; k < info->n_features && !found; k++) {
        icc_feature_info feature = {.size = sizeof feature};
        icc_domain_get_feature(domain, k, &feature);
        found = feature.kind == ICC_FEATURE_REGION;
    }
    return found;
}

/* Keeps only those of the facets just added that have the domain on one side, each once. */
static icc_status keep_rim(carrier *c, carried *m)
{
    rim r;
    size_t first = c->n_facets;
    const uint32_t *added = c->facets[0] + 2 * first;
    icc_status status = rim_find(&r, m->from, m->n_facets, c->vertices[0], added, c->env);
    for (size_t i = 0; i < r.n && status == ICC_OK; i++) {
        size_t from = first + r.facets[i], to = first + i;
        for (size_t side = 0; side < 2; side++)
            memmove(c->facets[side] + 2 * to, c->facets[side] + 2 * from, 2 * sizeof(uint32_t));
        c->reversed[to] = c->reversed[from];
    }
    m->place = r.place;
    r.place = NULL;
    c->n_facets += r.n;
    rim_free(&r);
    return status;
}

static void widen_box(carrier *c, const icc_domain_info *info)
{
    for (size_t k = 0; k < c->dim; k++) {
        bool is_flipped = c->flipped[0] && k == 1;
        c->lower[k] = fmin(c->lower[k], is_flipped ? -info->upper[k] : info->lower[k]);
        c->upper[k] = fmax(c->upper[k], is_flipped ? -info->lower[k] : info->upper[k]);
        c->size = fmax(c->size, c->upper[k] - c->lower[k]);
        c->largest = fmax(c->largest, fmax(fabs(info->lower[k]), fabs(info->upper[k])));
    }
}

icc_status carrier_add(carrier *c, const icc_map *map, const icc_domain *from, const icc_domain *to)
{
    icc_domain_info info[2] = {{.size = sizeof *info}, {.size = sizeof *info}};
    icc_status status = icc_domain_get_info(from, &info[0]);
    if (status == ICC_OK)
        status = icc_domain_get_info(to, &info[1]);
    if (status != ICC_OK)
        return status;
    size_t n_facets = info[0].n_facets;
    c->dim = (size_t)info[0].dim;
    status = add_boundary(c, 0, from, &info[0], n_facets);
    if (status == ICC_OK)
        status = add_boundary(c, 1, to, &info[1], n_facets);
    if (status != ICC_OK)
        return status;
    if (c->dim == 2)
        add_directions(c, from, &info[0], n_facets);
    widen_box(c, &info[0]);
    c->matched = c->matched && info[0].n_facets == info[1].n_facets;
    c->maps = grow(c->maps, &c->room_maps, c->n_maps + 1, sizeof *c->maps);
    carried *m = &c->maps[c->n_maps++];
    *m = (carried){map, from, (uint32_t)c->n_facets, (uint32_t)n_facets, NULL};
    if (c->dim == 2 && c->matched && has_regions(from, &info[0]))
        status = keep_rim(c, m);
    else
        c->n_facets += n_facets;
    c->n_vertices += info[0].n_vertices;
    return status;
}

/* If sides do not correspond facet by facet, there is no image to snap to. */
void carrier_set_snap(carrier *c, double snap)
{
    double least = fmax(1e-9 * c->size, 4 * DBL_EPSILON * c->largest);
    c->snap = !c->matched ? 0 : snap >= 0 ? snap : least;
}

void carrier_free(carrier *c)
{
    for (size_t side = 0; side < 2; side++) {
        free(c->vertices[side]);
        free(c->facets[side]);
    }
    for (size_t m = 0; m < c->n_maps; m++)
        free(c->maps[m].place);
    free(c->maps);
    free(c->reversed);
    *c = (carrier){0};
}

void carrier_facet_point(const carrier *c, size_t side, uint32_t facet, const double *shares,
                         double *point)
{
    const uint32_t *corners = c->facets[side] + c->dim * facet;
    for (size_t k = 0; k < c->dim; k++) {
        point[k] = 0;
        for (size_t i = 0; i < c->dim; i++)
            point[k] += shares[i] * c->vertices[side][c->dim * corners[i] + k];
    }
}

/* Takes a facet of a map's domain, and its shares, to the carrier's facet in the same place. False if
 * it has none. */
static bool find_own(const carried *m, uint32_t *facet, double *shares)
{
    uint32_t place = m->place != NULL ? m->place[*facet] : 2 * *facet;
    if (place == NOT_ON_RIM)
        return false;
    if (place % 2 == 1) {
        double share = shares[0];
        shares[0] = shares[1];
        shares[1] = share;
    }
    *facet = m->first_facet + place / 2;
    return true;
}

icc_status carrier_nearest(const carrier *c, const double *point, uint32_t *facet, double *shares,
                           double *distance)
{
    icc_status status = ICC_OK;
    double own[ICC_MAX_DIM];
    memcpy(own, point, c->dim * sizeof *own);
    flip_y(c, 0, 1, own);
    *distance = HUGE_VAL;
    *facet = 0;
    for (size_t m = 0; m < c->n_maps && status == ICC_OK; m++) {
        int32_t where;
        uint32_t at;
        double bary[ICC_MAX_DIM], nearest[ICC_MAX_DIM], square = 0;
        status = icc_domain_locate(c->maps[m].from, 1, own, &where, &at, bary, c->env);
        if (status != ICC_OK || at >= c->maps[m].n_facets || !find_own(&c->maps[m], &at, bary))
            continue;
        carrier_facet_point(c, 0, at, bary, nearest);
        for (size_t k = 0; k < c->dim; k++)
            square += (point[k] - nearest[k]) * (point[k] - nearest[k]);
        if (!(sqrt(square) < *distance))
            continue;
        *distance = sqrt(square);
        *facet = at;
        memcpy(shares, bary, c->dim * sizeof *bary);
    }
    return status;
}

icc_status carrier_is_outside(const carrier *c, const double *point, bool *out)
{
    icc_status status = ICC_OK;
    double own[ICC_MAX_DIM];
    memcpy(own, point, c->dim * sizeof *own);
    flip_y(c, 0, 1, own);
    *out = true;
    for (size_t m = 0; m < c->n_maps && *out && status == ICC_OK; m++) {
        int32_t where = ICC_OUTSIDE;
        status = icc_domain_locate(c->maps[m].from, 1, own, &where, NULL, NULL, c->env);
        *out = where == ICC_OUTSIDE;
    }
    return status;
}

/* True if a point is close enough to the cage's box to be snapped. Most points outside are not. */
static bool may_snap(const carrier *c, const double *point)
{
    for (size_t k = 0; k < c->dim; k++)
        if (!(point[k] >= c->lower[k] - 2 * c->snap && point[k] <= c->upper[k] + 2 * c->snap))
            return false;
    return c->snap > 0;
}

/* Maps the points that earlier maps left outside. Gathers them, and puts the images where they
 * belong. */
static icc_status map_rest(const carrier *c, const icc_map *map, size_t n, const double *points,
                           double *images, icc_status *status, size_t *n_failed)
{
    size_t dim = c->dim, n_rest = 0, ignored;
    double *rest = need(*n_failed, dim * sizeof *rest);
    icc_status *own = need(*n_failed, sizeof *own);
    for (size_t i = 0; i < n; i++)
        if (status[i] == ICC_ERR_OUTSIDE)
            memcpy(rest + dim * n_rest++, points + dim * i, dim * sizeof *rest);
    icc_status ran = (c->inverse ? icc_map_apply_inverse : icc_map_apply)(map, n_rest, rest, rest,
                                                                          own, &ignored, c->env);
    for (size_t i = 0, k = 0; i < n && ran == ICC_OK; i++)
        if (status[i] == ICC_ERR_OUTSIDE) {
            memcpy(images + dim * i, rest + dim * k, dim * sizeof *rest);
            *n_failed -= own[k] == ICC_OK;
            status[i] = own[k++];
        }
    free(rest);
    free(own);
    return ran;
}

/* Maps the points that lie inside. The others fail. */
static icc_status map_inside(const carrier *c, size_t n, const double *points, double *images,
                             icc_status *status, size_t *n_failed)
{
    double *own = c->flipped[0] && n > 0 ? need(n, c->dim * sizeof *own) : NULL;
    if (own != NULL) {
        memcpy(own, points, n * c->dim * sizeof *own);
        flip_y(c, 0, n, own);
        points = own;
    }
    icc_status ran = (c->inverse ? icc_map_apply_inverse : icc_map_apply)(
        c->maps[0].map, n, points, images, status, n_failed, c->env);
    for (size_t m = 1; ran == ICC_OK && *n_failed > 0 && m < c->n_maps; m++)
        ran = map_rest(c, c->maps[m].map, n, points, images, status, n_failed);
    flip_y(c, 1, n, images);
    free(own);
    return ran;
}

icc_status carrier_map(const carrier *c, size_t n, const double *points, double *images,
                       icc_status *status, bool *snapped)
{
    size_t n_failed;
    if (snapped != NULL)
        memset(snapped, 0, n * sizeof *snapped);
    icc_status ran = map_inside(c, n, points, images, status, &n_failed);
    for (size_t i = 0; i < n && n_failed > 0 && ran == ICC_OK; i++) {
        const double *point = points + c->dim * i;
        uint32_t facet;
        double shares[ICC_MAX_DIM], distance;
        if (status[i] != ICC_ERR_OUTSIDE || !may_snap(c, point))
            continue;
        ran = carrier_nearest(c, point, &facet, shares, &distance);
        if (ran != ICC_OK || !(distance <= c->snap))
            continue;
        carrier_facet_point(c, 1, facet, shares, images + c->dim * i);
        status[i] = ICC_OK;
        if (snapped != NULL)
            snapped[i] = true;
    }
    return ran;
}
