/* Compares the networks of two domains. With the same order around each node they have the same
 * walks. A face consists of one walk around it and of the outer walks of the pieces inside. So the
 * faces are the same if each half-side has the same walk around the face on its left. */
#include "domain/network_same.h"

#include "base/error.h"
#include "domain/features_check.h"

static const uint32_t NONE = UINT32_MAX;

typedef struct pair {
    const icc_domain *domain[2]; /* source, target */
    const iccp_network *net[2];
    icc_error *err;
} pair;

static uint32_t feature_of_half(const pair *p, uint32_t h)
{
    return iccp_feature_of_facet(p->domain[0], h / 2);
}

static const char *name_feature(const pair *p, uint32_t feature, char *text)
{
    return iccp_feature_text(p->domain[0]->features, feature, text);
}

static unsigned long edge_number(const pair *p, uint32_t feature, uint32_t h)
{
    return iccp_feature_facet(p->domain[0]->features, feature, h / 2);
}

/* The item and the index of a failure at a feature, or at the outer ring. */
static int32_t item_of(uint32_t feature)
{
    return feature != NONE ? ICC_ITEM_FEATURE : ICC_ITEM_NONE;
}

static int64_t index_of(uint32_t feature)
{
    return feature != NONE ? (int64_t)feature : -1;
}

/* ---- nodes ---- */

/* Reports a vertex that coincides with another one on one side only. */
static icc_status fail_node(const pair *p, uint32_t v)
{
    static const char *const side[2] = {"source", "target"};
    const uint32_t with[2] = {p->net[0]->node[v], p->net[1]->node[v]};
    const int here = with[0] != v ? 0 : 1;
    const iccp_features *features = p->domain[0]->features;
    const uint32_t own = iccp_feature_of_vertex(features, v);
    const uint32_t other = iccp_feature_of_vertex(features, with[here]);
    char names[2][ICCP_FEATURE_TEXT];
    return iccp_fail_at(p->err, ICC_ERR_TOPOLOGY, item_of(own), index_of(own),
                        "%s, vertex %lu, meets %s, vertex %lu, in the %s, but not in the %s",
                        name_feature(p, own, names[0]), iccp_feature_vertex(features, own, v),
                        name_feature(p, other, names[1]),
                        iccp_feature_vertex(features, other, with[here]), side[here],
                        side[1 - here]);
}

/* ---- the order around nodes ---- */

/* Compares the orders around a node. The second list may begin elsewhere. */
static bool same_order(const uint32_t *a, const uint32_t *b, uint32_t n)
{
    uint32_t turn = 0;
    while (turn < n && b[turn] != a[0])
        ++turn;
    for (uint32_t i = 0; i < n; ++i)
        if (a[i] != b[turn + i < n ? turn + i : turn + i - n])
            return false;
    return true;
}

/* Finds two half-sides that change places: those that differ where as few as possible do, if
 * possible of two features. */
static void find_swap(const pair *p, const uint32_t *a, const uint32_t *b, uint32_t n,
                      uint32_t swap[2])
{
    uint32_t fewest = 2 * n + 2;
    for (uint32_t turn = 0; turn < n; ++turn) {
        uint32_t found[2] = {a[0], a[0]}, count = 0;
        for (uint32_t i = 0; i < n; ++i)
            if (a[i] != b[(turn + i) % n] && count++ < 2)
                found[count - 1] = a[i];
        const uint32_t same = feature_of_half(p, found[0]) == feature_of_half(p, found[1]);
        if (2 * count + same >= fewest)
            continue;
        fewest = 2 * count + same;
        swap[0] = found[0];
        swap[1] = found[1];
    }
}

static icc_status fail_order(const pair *p, uint32_t v, const uint32_t *a, const uint32_t *b,
                             uint32_t n)
{
    uint32_t swap[2] = {a[0], a[1]}, feature[2];
    double at[2];
    char names[2][ICCP_FEATURE_TEXT];
    find_swap(p, a, b, n, swap);
    const bool in_order = feature_of_half(p, swap[0]) <= feature_of_half(p, swap[1]);
    for (int i = 0; i < 2; ++i)
        feature[i] = feature_of_half(p, swap[in_order ? i : 1 - i]);
    const uint32_t named = feature[0];
    iccp_domain_given(p->domain[0], v, at);
    if (feature[0] == feature[1])
        return iccp_fail_at(p->err, ICC_ERR_TOPOLOGY, item_of(named), index_of(named),
                            "at (%.9g, %.9g), where %lu sides meet, edges %lu and %lu of %s change "
                            "places in the target",
                            at[0], at[1], (unsigned long)n, edge_number(p, feature[0], swap[0]),
                            edge_number(p, feature[0], swap[1]),
                            name_feature(p, feature[0], names[0]));
    return iccp_fail_at(p->err, ICC_ERR_TOPOLOGY, item_of(named), index_of(named),
                        "at (%.9g, %.9g), where %lu sides meet, %s and %s change places in the "
                        "target",
                        at[0], at[1], (unsigned long)n, name_feature(p, feature[0], names[0]),
                        name_feature(p, feature[1], names[1]));
}

static icc_status check_order(const pair *p)
{
    for (uint32_t v = 0; v < p->domain[0]->n_vertices; ++v) {
        const uint32_t first = p->net[0]->first[v], n = p->net[0]->first[v + 1] - first;
        const uint32_t *a = p->net[0]->leaving + first, *b = p->net[1]->leaving + first;
        if (n > 2 && !same_order(a, b, n))
            return fail_order(p, v, a, b, n);
    }
    return ICC_OK;
}

/* ---- faces ---- */

/* Finds a side between the faces that are within two walks. Returns its half-side with the first
 * face on its left, or NONE. */
static uint32_t find_border(const pair *p, uint32_t first, uint32_t second)
{
    const uint32_t *around = p->net[0]->around;
    const uint32_t n = 2 * (uint32_t)p->domain[0]->features->n_places;
    for (uint32_t h = 0; h < n; ++h)
        if (iccp_network_is_side(p->net[0], p->domain[0], h / 2) && around[h] == first &&
            around[h ^ 1] == second)
            return h;
    return NONE;
}

/* Reports a piece that lies in another face. h is on its outer walk. */
static icc_status fail_face(const pair *p, uint32_t h)
{
    const uint32_t own = feature_of_half(p, h);
    const uint32_t around[2] = {p->net[0]->around[h], p->net[1]->around[h]};
    const uint32_t border = find_border(p, around[0], around[1]);
    const uint32_t other = border != NONE ? feature_of_half(p, border) : NONE;
    const bool is_left = border % 2 == 0;
    char names[2][ICCP_FEATURE_TEXT];
    const char *name = name_feature(p, own, names[0]);
    if (border != NONE)
        return iccp_fail_at(
            p->err, ICC_ERR_TOPOLOGY, item_of(own), index_of(own),
            "%s is on the %s of %s, edge %lu, in the source, but on the %s in the target", name,
            is_left ? "left" : "right", name_feature(p, other, names[1]),
            edge_number(p, other, border), is_left ? "right" : "left");
    if (around[0] == ICCP_NO_WALK || around[1] == ICCP_NO_WALK)
        return iccp_fail_at(p->err, ICC_ERR_TOPOLOGY, item_of(own), index_of(own),
                            "%s lies in another face in the target", name);
    char within[2][ICCP_FEATURE_TEXT];
    return iccp_fail_at(p->err, ICC_ERR_TOPOLOGY, item_of(own), index_of(own),
                        "%s lies in a face along %s in the source, but along %s in the target",
                        name, name_feature(p, feature_of_half(p, around[0]), within[0]),
                        name_feature(p, feature_of_half(p, around[1]), within[1]));
}

/* Reports a piece whose outer walk is another one in the target. h is on one of the two walks. */
static icc_status fail_inside_out(const pair *p, uint32_t h)
{
    const uint32_t own = feature_of_half(p, h);
    char name[ICCP_FEATURE_TEXT];
    return iccp_fail_at(p->err, ICC_ERR_TOPOLOGY, item_of(own), index_of(own),
                        "%s is turned inside out in the target", name_feature(p, own, name));
}

/* The first half-side with another walk around it tells its own walk. In one of the domains that
 * walk may go around a face, and in the other around the outside of its piece. */
static icc_status check_faces(const pair *p)
{
    const uint32_t *a = p->net[0]->around, *b = p->net[1]->around;
    const uint32_t n = 2 * (uint32_t)p->domain[0]->features->n_places;
    for (uint32_t h = 0; h < n; ++h)
        if (a[h] != b[h] && (a[h] == h || b[h] == h))
            return fail_inside_out(p, h);
    for (uint32_t h = 0; h < n; ++h)
        if (a[h] != b[h])
            return fail_face(p, h);
    return ICC_OK;
}

icc_status iccp_network_same(const icc_domain *source, const icc_domain *target, icc_error *err)
{
    const pair p = {{source, target}, {source->features->network, target->features->network}, err};
    for (uint32_t v = 0; v < source->n_vertices; ++v)
        if (p.net[0]->node[v] != p.net[1]->node[v])
            return fail_node(&p, v);
    const icc_status status = check_order(&p);
    return status == ICC_OK ? check_faces(&p) : status;
}
