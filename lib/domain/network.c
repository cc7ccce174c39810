/* Makes the network of a domain with features. Vertices are sorted to find nodes, facets are sorted
 * by their nodes to find sides, and half-sides are sorted around each node. One sweep
 * (geometry/graph_sweep.h) then finds defects, counts the rings around each side, and tells what
 * is below each piece. Faces follow from that (network_faces.h). O(n log n). */
#include "domain/network.h"

#include "base/sort.h"
#include "domain/network_faces.h"
#include "geometry/point_order.h"
#include "geometry/segment.h"
#include "math/predicates.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct build {
    icc_domain *domain;
    iccp_network *net;
    uint32_t *nodes; /* by x, then y; at first all vertices */
    uint32_t *work;
    int32_t *gain, *left;
    uint32_t *below;
    iccp_defect found;
} build;

static bool is_ring(const iccp_features *features, uint32_t feature)
{
    return feature == NONE || iccp_feature_is_ring(features->item[feature].kind);
}

static bool is_region(const iccp_features *features, uint32_t feature)
{
    return feature != NONE && features->item[feature].kind == ICC_FEATURE_REGION;
}

static const double *point(const build *b, uint32_t v)
{
    return b->domain->vertices + 2 * (size_t)v;
}

/* ---- nodes ---- */

/* Returns true if two vertices in the same place belong to one ring, which then is not simple. */
static bool pinch(const build *b, uint32_t u, uint32_t v)
{
    const iccp_features *features = b->domain->features;
    const uint32_t feature = iccp_feature_of_vertex(features, u);
    return feature == iccp_feature_of_vertex(features, v) && is_ring(features, feature);
}

/* Finds the node of each vertex. Equal vertices come in the order of their numbers, so those of one
 * ring are neighbours. */
static void find_nodes(build *b)
{
    const size_t n = b->domain->n_vertices;
    size_t n_nodes = 0;
    uint32_t last = NONE;
    for (uint32_t v = 0; v < n; ++v)
        b->nodes[v] = v;
    iccp_order_points(b->nodes, b->work, n, b->domain->vertices);
    for (size_t i = 0; i < n; ++i) {
        const uint32_t v = b->nodes[i];
        if (i > 0 && iccp_point_equal(point(b, last), point(b, v))) {
            b->net->node[v] = b->net->node[last];
            if (b->found.kind == 0 && pinch(b, last, v))
                b->found = (iccp_defect){ICC_DEFECT_REPEATED, last, v};
        } else {
            b->net->node[v] = b->nodes[n_nodes++] = v;
        }
        last = v;
    }
    b->net->n_nodes = n_nodes;
}

/* ---- sides ---- */

typedef struct facet_nodes {
    const uint32_t *node, *facets;
} facet_nodes;

static uint64_t key_of(const facet_nodes *f, uint32_t facet)
{
    const uint32_t a = f->node[f->facets[2 * (size_t)facet]];
    const uint32_t b = f->node[f->facets[2 * (size_t)facet + 1]];
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static bool key_is_less(const void *context, uint32_t a, uint32_t b)
{
    return key_of(context, a) < key_of(context, b);
}

/* Checks facets a < b that join the same nodes and follow each other among all that do. */
static void check_same(build *b, uint32_t first, uint32_t last, uint32_t facet)
{
    const icc_domain *d = b->domain;
    const uint32_t own = iccp_feature_of_facet(d, facet);
    const uint32_t first_feature = iccp_feature_of_facet(d, first);
    const bool rings = is_ring(d->features, own) && !is_region(d->features, own) &&
                       is_ring(d->features, first_feature) &&
                       !is_region(d->features, first_feature);
    if (own == iccp_feature_of_facet(d, last))
        b->found = (iccp_defect){ICC_DEFECT_TOUCH, last, facet};
    else if (rings)
        b->found = (iccp_defect){ICC_DEFECT_TOUCH, first, facet};
}

/* Finds the side of each facet. Facets with the same nodes come in the order of their numbers: the
 * outer ring, holes, other features. */
static void find_sides(build *b, uint32_t *order, uint32_t *work)
{
    const icc_domain *d = b->domain;
    const facet_nodes f = {b->net->node, d->facets};
    const size_t n = d->features->n_places;
    uint32_t last = NONE;
    for (uint32_t i = 0; i < n; ++i)
        order[i] = i;
    iccp_sort_indices(order, work, n, &f, key_is_less);
    for (size_t i = 0; i < n; ++i) {
        const uint32_t facet = order[i];
        const bool is_point = d->facets[2 * (size_t)facet] == d->facets[2 * (size_t)facet + 1];
        const uint64_t key = key_of(&f, facet);
        if (!is_point && b->found.kind == 0 && key >> 32 == (key & UINT32_MAX))
            b->found = (iccp_defect){ICC_DEFECT_REPEATED, d->facets[2 * (size_t)facet],
                                     d->facets[2 * (size_t)facet + 1]};
        if (last != NONE && key_of(&f, last) == key) {
            b->net->side[facet] = b->net->side[last];
            if (!is_point && b->found.kind == 0)
                check_same(b, b->net->side[last], last, facet);
        } else {
            b->net->side[facet] = facet;
            b->net->n_sides += !is_point;
        }
        last = facet;
    }
}

/* ---- half-sides ---- */

/* Lists the half-sides that leave each node. Counting backwards, first[v] ends at the beginning. */
static void list_leaving(build *b)
{
    const icc_domain *d = b->domain;
    iccp_network *net = b->net;
    const uint32_t n = 2 * (uint32_t)d->features->n_places;
    memset(net->first, 0, (d->n_vertices + 1) * sizeof *net->first);
    for (uint32_t h = 0; h < n; ++h)
        net->first[iccp_network_origin(net, d, h)] += iccp_network_is_side(net, d, h / 2);
    for (size_t v = 1; v <= d->n_vertices; ++v)
        net->first[v] += net->first[v - 1];
    for (uint32_t h = n; h-- > 0;)
        if (iccp_network_is_side(net, d, h / 2))
            net->leaving[--net->first[iccp_network_origin(net, d, h)]] = h;
}

/* Finds the place of each node, and with it of each vertex. Sides win against points, then small
 * numbers win. */
static void find_places(build *b)
{
    const icc_domain *d = b->domain;
    iccp_network *net = b->net;
    const uint32_t n = 2 * (uint32_t)d->features->n_places;
    for (uint32_t h = n; h-- > 0;)
        if (h % 2 == 0 && !iccp_network_is_side(net, d, h / 2))
            net->place[iccp_network_origin(net, d, h)] = h;
    for (uint32_t h = n; h-- > 0;)
        if (iccp_network_is_side(net, d, h / 2))
            net->place[iccp_network_origin(net, d, h)] = h;
    for (uint32_t v = 0; v < d->n_vertices; ++v)
        net->place[v] = net->place[net->node[v]];
}

static void order_leaving(build *b, iccp_graph_defect *found, const iccp_graph *graph)
{
    iccp_network *net = b->net;
    for (size_t i = 0; i < net->n_nodes; ++i) {
        const uint32_t v = b->nodes[i];
        if (!iccp_graph_order_node(found, graph, v, net->leaving + net->first[v], b->work))
            return;
        net->n_junctions += iccp_network_degree(net, v) > 2;
    }
    for (uint32_t i = 0; i < 2 * net->n_sides; ++i)
        net->slot[net->leaving[i]] = i;
}

/* ---- rings ---- */

static int32_t turn_of_ring(const double *points, size_t n)
{
    size_t v = 0;
    for (size_t k = 1; k < n; ++k)
        if (iccp_point_less(points + 2 * k, points + 2 * v))
            v = k;
    return iccp_orient2d(points + 2 * (v > 0 ? v - 1 : n - 1), points + 2 * v,
                         points + 2 * (v + 1 < n ? v + 1 : 0));
}

/* Adds up what a ring that turns to the left contributes to the number of rings on the left of each
 * of its sides, less those on the right. */
static void add_ring(build *b, uint32_t first_facet, uint32_t n, int32_t weight)
{
    const icc_domain *d = b->domain;
    for (uint32_t f = first_facet; f < first_facet + n; ++f) {
        const uint32_t side = b->net->side[f];
        const bool same =
            b->net->node[d->facets[2 * (size_t)f]] == b->net->node[d->facets[2 * (size_t)side]];
        b->gain[side] += same ? weight : -weight;
    }
}

static void add_rings(build *b)
{
    icc_domain *d = b->domain;
    const uint32_t n_outer = (uint32_t)d->features->n_outer;
    memset(b->gain, 0, d->features->n_places * sizeof *b->gain);
    d->orientation = n_outer > 0 ? turn_of_ring(d->vertices, n_outer) : 1;
    if (n_outer > 0)
        add_ring(b, 0, n_outer, d->orientation);
    for (size_t f = 0; f < d->features->n; ++f) {
        iccp_feature *feature = &d->features->item[f];
        if (!iccp_feature_is_ring(feature->kind))
            continue;
        feature->orientation = turn_of_ring(point(b, feature->first), feature->n);
        add_ring(b, feature->first_facet, feature->n_facets,
                 feature->kind == ICC_FEATURE_HOLE ? -feature->orientation : feature->orientation);
    }
}

/* ---- all together ---- */

static void count_rim(iccp_network *net, size_t n_places)
{
    for (uint32_t f = 0; f < n_places; ++f)
        net->n_rim += iccp_network_is_rim(net, f);
}

/* Reports a defect in the numbers of facets. */
static void report(build *b, const iccp_graph_defect *found)
{
    const uint32_t other = found->b_is_node ? b->net->place[found->b] / 2 : found->b;
    b->found = found->a < other ? (iccp_defect){found->kind, found->a, other}
                                : (iccp_defect){found->kind, other, found->a};
}

static icc_status sweep(build *b, const iccp_env *env)
{
    const icc_domain *d = b->domain;
    iccp_network *net = b->net;
    const iccp_graph graph = {d->vertices, d->facets,  d->features->n_places, net->n_nodes,
                              b->nodes,    net->first, net->leaving,          b->gain};
    iccp_graph_defect found = {0};
    icc_status status = ICC_OK;
    list_leaving(b);
    find_places(b);
    order_leaving(b, &found, &graph);
    if (found.kind == 0) {
        add_rings(b);
        status = iccp_graph_sweep(&found, &graph, b->left, b->below, env);
    }
    if (status == ICC_OK && found.kind != 0) {
        report(b, &found);
        return ICC_OK;
    }
    if (status == ICC_OK)
        status = iccp_network_find_faces(net, d, &graph, b->left, b->below, env);
    if (status == ICC_OK)
        count_rim(net, d->features->n_places);
    return status;
}

static icc_status run(build *b, const iccp_env *env)
{
    find_nodes(b);
    if (b->found.kind == 0)
        find_sides(b, b->net->leaving, b->net->slot);
    return b->found.kind == 0 ? sweep(b, env) : ICC_OK;
}

static iccp_network *allocate(size_t n, size_t n_places, const iccp_memory *memory)
{
    iccp_network *net = iccp_alloc_zero(memory, 1, sizeof *net);
    if (net == NULL)
        return NULL;
    net->node = iccp_alloc(memory, n, sizeof *net->node);
    net->side = iccp_alloc(memory, n_places, sizeof *net->side);
    net->first = iccp_alloc(memory, n + 1, sizeof *net->first);
    net->leaving = iccp_alloc(memory, n_places, 2 * sizeof *net->leaving);
    net->slot = iccp_alloc(memory, n_places, 2 * sizeof *net->slot);
    net->piece = iccp_alloc(memory, n, sizeof *net->piece);
    net->face = iccp_alloc(memory, n_places, 2 * sizeof *net->face);
    net->around = iccp_alloc(memory, n_places, 2 * sizeof *net->around);
    net->place = iccp_alloc(memory, n, sizeof *net->place);
    if (net->node != NULL && net->side != NULL && net->first != NULL && net->leaving != NULL &&
        net->slot != NULL && net->piece != NULL && net->face != NULL && net->around != NULL &&
        net->place != NULL)
        return net;
    iccp_network_free(net, memory);
    return NULL;
}

void iccp_network_free(iccp_network *net, const iccp_memory *memory)
{
    if (net == NULL)
        return;
    iccp_free(memory, net->node);
    iccp_free(memory, net->side);
    iccp_free(memory, net->first);
    iccp_free(memory, net->leaving);
    iccp_free(memory, net->slot);
    iccp_free(memory, net->piece);
    iccp_free(memory, net->face);
    iccp_free(memory, net->around);
    iccp_free(memory, net->place);
    iccp_free(memory, net);
}

icc_status iccp_network_create(iccp_network **out, iccp_defect *found, icc_domain *domain,
                               const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = domain->n_vertices, n_places = domain->features->n_places;
    build b = {.domain = domain, .net = allocate(n, n_places, memory)};
    b.nodes = iccp_alloc(memory, n, sizeof *b.nodes);
    b.work = iccp_alloc(memory, n, sizeof *b.work);
    b.below = iccp_alloc(memory, n, sizeof *b.below);
    b.gain = iccp_alloc(memory, n_places, sizeof *b.gain);
    b.left = iccp_alloc(memory, n_places, sizeof *b.left);
    icc_status status = ICC_ERR_MEMORY;
    if (b.net != NULL && b.nodes != NULL && b.work != NULL && b.below != NULL && b.gain != NULL &&
        b.left != NULL)
        status = run(&b, env);
    iccp_free(memory, b.nodes);
    iccp_free(memory, b.work);
    iccp_free(memory, b.below);
    iccp_free(memory, b.gain);
    iccp_free(memory, b.left);
    *found = b.found;
    if (status != ICC_OK || b.found.kind != 0) {
        iccp_network_free(b.net, memory);
        b.net = NULL;
    }
    *out = b.net;
    return status;
}

/* ---- questions ---- */

/* Turns around the end of h to the right, from its left side on. */
uint32_t iccp_network_next_on_rim(const iccp_network *net, const icc_domain *domain, uint32_t h)
{
    do
        h = iccp_network_next(net, domain, h) ^ 1;
    while (net->face[h] != ICCP_NO_FACE);
    return h ^ 1;
}

bool iccp_network_side(const iccp_network *net, const icc_domain *domain, uint32_t node_a,
                       uint32_t node_b, uint32_t *side)
{
    if (iccp_network_degree(net, node_a) > iccp_network_degree(net, node_b)) {
        const uint32_t swap = node_a;
        node_a = node_b;
        node_b = swap;
    }
    for (uint32_t i = net->first[node_a]; i < net->first[node_a + 1]; ++i) {
        const uint32_t h = net->leaving[i];
        if (iccp_network_origin(net, domain, h ^ 1) == node_b) {
            *side = h / 2;
            return true;
        }
    }
    return false;
}
