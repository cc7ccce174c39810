/* Nodes are shared. A node within `near` of a corner of the cage is at that corner. A vertex within
 * `near` of an edge is a node of the edge. So crossings are well apart from touching places, and
 * exact signs decide them. */
#include "geo/noding.h"

#include "base/allocate.h"
#include "base/extremes.h"
#include "base/orientation.h"
#include "geo/crossing.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

void noding_start(noding *out, const carrier *cage)
{
    double largest = 0;
    for (size_t k = 0; k < 2; k++)
        largest = greater(largest, greater(fabs(cage->lower[k]), fabs(cage->upper[k])));
    *out = (noding){.cage = cage};
    /* About a hundred roundings of the cage's coordinates. Crossings are computed to a few
     * roundings. */
    cage_grid_make(&out->grid, cage, greater(1e-13 * cage->size, 128 * DBL_EPSILON * largest));
}

void noding_free(noding *x)
{
    cage_grid_free(&x->grid);
    free(x->nodes);
    x->nodes = NULL;
}

/* Finds the nearest point of a segment, as a share of it. Returns the distance. */
static double nearest_on(const double a[2], const double b[2], const double p[2], double *share)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    double t = square > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square : 0;
    *share = lesser(greater(t, 0), 1);
    return hypot(p[0] - a[0] - *share * dx, p[1] - a[1] - *share * dy);
}

/* Puts a node on an edge of the cage, or at its corner if that is close. */
static void put_on(const noding *x, geo_node *node, uint32_t facet, double share)
{
    node->place = GEO_ON_CAGE;
    node->facet = facet;
    node->share = share;
    for (size_t end = 0; end < 2; end++) {
        const double *corner = cage_end(x->cage, facet, end);
        if (point_distance(corner, node->at) <= x->grid.near) {
            node->share = (double)end;
            node->at[0] = corner[0];
            node->at[1] = corner[1];
        }
    }
}

/* Puts a snapped vertex at its nearest place on the cage. */
static void put_at_nearest(noding *x, geo_node *node)
{
    uint32_t facet;
    double shares[2], off;
    icc_status ran = carrier_nearest(x->cage, node->at, &facet, shares, &off);
    if (ran != ICC_OK) {
        x->status = ran;
        return;
    }
    carrier_facet_point(x->cage, 0, facet, shares, node->at);
    put_on(x, node, facet, shares[1]);
}

/* Adds a vertex. It is on the cage if it has been snapped or is close. */
static void add_vertex(noding *x, const double at[2], size_t from, icc_status status, bool snapped)
{
    x->nodes = grow(x->nodes, &x->room, x->n + 1, sizeof *x->nodes);
    geo_node *node = &x->nodes[x->n++];
    *node = (geo_node){.at = {at[0], at[1]},
                       .place = status == ICC_ERR_OUTSIDE ? GEO_OUTSIDE : GEO_INSIDE,
                       .vertex = true,
                       .from = from};
    if (snapped) {
        put_at_nearest(x, node);
        return;
    }
    double best = x->grid.near, best_share = 0;
    uint32_t facet = GEO_NOWHERE;
    cage_grid_ask(&x->grid, at, at);
    for (size_t i = 0; i < x->grid.n_found; i++) {
        double share;
        uint32_t edge = x->grid.found[i];
        double off = nearest_on(cage_end(x->cage, edge, 0), cage_end(x->cage, edge, 1), at, &share);
        if (off <= best) {
            best = off;
            best_share = share;
            facet = edge;
        }
    }
    if (facet != GEO_NOWHERE)
        put_on(x, node, facet, best_share);
}

static bool is_at(const geo_node *node, const double at[2])
{
    return !(node->at[0] < at[0] || node->at[0] > at[0] || node->at[1] < at[1] ||
             node->at[1] > at[1]);
}

/* Adds a copy of a node to the piece from `a` to `b`, in its order along the piece. */
static void insert(noding *x, size_t first, const geo_node *a, const geo_node *b, geo_node node)
{
    if (is_at(a, node.at) || is_at(b, node.at))
        return;
    double off, way = point_distance(a->at, b->at);
    off = point_distance(a->at, node.at);
    node.place = GEO_ON_CAGE;
    node.from = a->from;
    node.along = way > 0 && off < way ? off / way : way > 0 ? 1 : 0;
    x->nodes = grow(x->nodes, &x->room, x->n + 1, sizeof *x->nodes);
    size_t i = x->n++;
    for (; i > first && x->nodes[i - 1].along > node.along; i--)
        x->nodes[i] = x->nodes[i - 1];
    x->nodes[i] = node;
}

/* Finds where a piece crosses an edge of the cage, as a share of the edge. False if it does not. */
static bool crosses(const noding *x, const double a[2], const double b[2], uint32_t edge,
                    double *share)
{
    const double *c = cage_end(x->cage, edge, 0), *d = cage_end(x->cage, edge, 1);
    double at;
    if (nearest_on(a, b, c, &at) <= x->grid.near || nearest_on(a, b, d, &at) <= x->grid.near ||
        nearest_on(c, d, a, &at) <= x->grid.near || nearest_on(c, d, b, &at) <= x->grid.near)
        return false;
    if (orientation(a, b, c) * orientation(a, b, d) >= 0 ||
        orientation(c, d, a) * orientation(c, d, b) >= 0)
        return false;
    *share = crossing_share(a, b, c, d);
    return true;
}

/* Adds the places where the piece between two vertices meets the cage. They are the same for the
 * piece from b to a. */
static void add_meetings(noding *x, geo_node a, geo_node b)
{
    size_t first = x->n;
    bool swapped = point_before(b.at, a.at);
    const double *from = swapped ? b.at : a.at, *to = swapped ? a.at : b.at;
    cage_grid_ask(&x->grid, a.at, b.at);
    for (size_t i = 0; i < x->grid.n_found; i++) {
        uint32_t edge = x->grid.found[i];
        const double *c = cage_end(x->cage, edge, 0), *d = cage_end(x->cage, edge, 1);
        double share;
        if (nearest_on(from, to, c, &share) <= x->grid.near)
            insert(x, first, &a, &b, (geo_node){.at = {c[0], c[1]}, .facet = edge, .share = 0});
        else if (crosses(x, from, to, edge, &share))
            insert(x, first, &a, &b,
                   (geo_node){.at = {c[0] + share * (d[0] - c[0]), c[1] + share * (d[1] - c[1])},
                              .facet = edge,
                              .share = share});
    }
}

bool noding_is_outside(noding *x, const double point[2], double slack)
{
    bool out;
    uint32_t facet;
    double shares[2], off;
    icc_status ran = carrier_is_outside(x->cage, point, &out);
    out = ran == ICC_OK && out;
    if (out && slack > 0) {
        ran = carrier_nearest(x->cage, point, &facet, shares, &off);
        out = ran == ICC_OK && !(off <= slack);
    }
    x->status = ran != ICC_OK ? ran : x->status;
    return out;
}

uint32_t noding_common_edge(noding *x, const double a[2], const double b[2], double *share_a,
                            double *share_b)
{
    cage_grid_ask(&x->grid, a, a);
    for (size_t i = 0; i < x->grid.n_found; i++) {
        uint32_t edge = x->grid.found[i];
        const double *c = cage_end(x->cage, edge, 0), *d = cage_end(x->cage, edge, 1);
        if (nearest_on(c, d, a, share_a) <= x->grid.near &&
            nearest_on(c, d, b, share_b) <= x->grid.near)
            return edge;
    }
    return GEO_NOWHERE;
}

/* A piece lies where its ends lie. A piece from cage to cage is tested in three places. */
static bool is_in(noding *x, const geo_node *a, const geo_node *b)
{
    if (a->place != GEO_ON_CAGE || b->place != GEO_ON_CAGE)
        return (a->place != GEO_ON_CAGE ? a : b)->place == GEO_INSIDE;
    for (int k = 1; k < 4; k++) {
        double t = k / 4.0, p[2];
        for (size_t axis = 0; axis < 2; axis++)
            p[axis] = (1 - t) * a->at[axis] + t * b->at[axis];
        if (noding_is_outside(x, p, greater(x->cage->snap, x->grid.near)))
            return false;
    }
    return true;
}

bool noding_path(noding *x, const geo_shape *shape, size_t path, const icc_status *status,
                 const bool *snapped)
{
    const geo_path *p = &shape->paths[path];
    size_t last = 0;
    x->n = 0;
    for (size_t i = p->first; i < p->first + p->n && x->status == ICC_OK; i++) {
        size_t own = x->n;
        add_vertex(x, shape->points + 2 * i, i, status[i], snapped[i]);
        if (i == p->first)
            continue;
        /* The places where the piece meets the cage come before the vertex that was added to find
         * them. */
        geo_node vertex = x->nodes[own];
        x->n = own;
        add_meetings(x, x->nodes[last], vertex);
        x->nodes = grow(x->nodes, &x->room, x->n + 1, sizeof *x->nodes);
        last = x->n;
        x->nodes[x->n++] = vertex;
    }
    bool whole = true;
    for (size_t i = 0; i < x->n; i++) {
        x->nodes[i].in = i + 1 < x->n && is_in(x, &x->nodes[i], &x->nodes[i + 1]);
        whole = whole && x->nodes[i].place != GEO_OUTSIDE && (x->nodes[i].in || i + 1 == x->n);
    }
    return whole;
}

bool noding_is_free(noding *x, const geo_shape *shape, size_t path, const icc_status *status,
                    const bool *snapped)
{
    const geo_path *p = &shape->paths[path];
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t i = p->first; i < p->first + p->n; i++) {
        if (status[i] != ICC_OK || snapped[i])
            return false;
        for (size_t k = 0; k < 2; k++) {
            double at = shape->points[2 * i + k];
            lower[k] = at < lower[k] ? at : lower[k];
            upper[k] = at > upper[k] ? at : upper[k];
        }
    }
    return p->n > 0 && cage_grid_is_far(&x->grid, lower, upper);
}
