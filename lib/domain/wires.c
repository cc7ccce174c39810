/* Finds lines and points of a solid that meet something. A wire is a segment of a line, or a point,
 * which is a segment with equal ends. In the tree of wires each is a triangle (a, b, b). */
#include "domain/wires.h"

#include "geometry/segment.h"
#include "geometry/triangles.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct search {
    const icc_domain *domain;
    const iccp_facet_tree *facets;
    iccp_facet_tree wires;
    uint32_t *corners; /* 3 for each wire */
} search;

static const double *point(const search *s, uint32_t v)
{
    return s->domain->vertices + 3 * (size_t)v;
}

static size_t count_wires(const iccp_features *features)
{
    size_t n = 0;
    for (size_t f = 0; f < features->n; ++f)
        if (!iccp_feature_is_ring(features->item[f].kind))
            n += features->item[f].kind == ICC_FEATURE_LINE ? features->item[f].n - 1 : 1;
    return n;
}

static void list_wires(const iccp_features *features, uint32_t *to)
{
    for (size_t f = 0; f < features->n; ++f) {
        const iccp_feature *item = &features->item[f];
        const bool is_line = item->kind == ICC_FEATURE_LINE;
        if (iccp_feature_is_ring(item->kind))
            continue;
        for (uint32_t i = 0; i < (is_line ? item->n - 1 : 1); ++i, to += 3) {
            to[0] = item->first + i;
            to[1] = to[2] = item->first + i + is_line;
        }
    }
}

/* Starts a query for boxes near a wire. */
static void start(iccp_facet_query *query, const search *s, const iccp_facet_tree *tree,
                  uint32_t wire)
{
    double box[6];
    iccp_facet_box(&s->wires, wire, box);
    iccp_facet_query_start(query, tree, box);
    query->from = point(s, s->corners[3 * (size_t)wire]);
    query->to = point(s, s->corners[3 * (size_t)wire + 1]);
}

/* Returns the first facet that a wire meets, or NONE. */
static uint32_t find_facet(const search *s, uint32_t wire)
{
    iccp_facet_query query;
    uint32_t facet, first = NONE;
    start(&query, s, s->facets, wire);
    while (iccp_facet_query_next(&query, &facet)) {
        const double *corners[3];
        iccp_facet_corners(s->facets, facet, corners);
        if (facet < first && iccp_triangle_meets(corners, query.from, query.to))
            first = facet;
    }
    return first;
}

/* Returns true if two wires meet, apart from the common end of neighbours on a line. */
static bool wires_meet(const search *s, uint32_t wire, uint32_t other)
{
    const uint32_t *a = s->corners + 3 * (size_t)wire, *b = s->corners + 3 * (size_t)other;
    const double *p[2] = {point(s, a[0]), point(s, a[1])};
    const double *q[2] = {point(s, b[0]), point(s, b[1])};
    if (a[1] != b[0])
        return iccp_segments_meet_in_space(p[0], p[1], q[0], q[1]);
    return iccp_segments_meet_in_space(p[0], p[0], q[0], q[1]) ||
           iccp_segments_meet_in_space(p[0], p[1], q[1], q[1]);
}

/* Returns the first later wire that a wire meets, or NONE. */
static uint32_t find_wire(const search *s, uint32_t wire)
{
    iccp_facet_query query;
    uint32_t other, first = NONE;
    start(&query, s, &s->wires, wire);
    while (iccp_facet_query_next(&query, &other))
        if (other > wire && other < first && wires_meet(s, wire, other))
            first = other;
    return first;
}

static icc_status find(iccp_contact *contact, const search *s, const iccp_env *env)
{
    for (uint32_t w = 0; w < s->wires.n; ++w) {
        if (w % ICCP_VERTICES_PER_REPORT == 0 &&
            iccp_progress(env, "check", (double)w / (double)s->wires.n) != ICC_OK)
            return ICC_ERR_CANCELLED;
        const uint32_t facet = find_facet(s, w), other = facet == NONE ? find_wire(s, w) : NONE;
        if (facet == NONE && other == NONE)
            continue;
        memcpy(contact->wire, s->corners + 3 * (size_t)w, sizeof contact->wire);
        contact->facet = facet;
        if (other != NONE)
            memcpy(contact->other, s->corners + 3 * (size_t)other, sizeof contact->other);
        break;
    }
    return ICC_OK;
}

icc_status iccp_wires_find(iccp_contact *contact, const icc_domain *domain,
                           const iccp_facet_tree *facets, const iccp_env *env)
{
    const size_t n = count_wires(domain->features);
    search s = {.domain = domain, .facets = facets};
    icc_status status = ICC_ERR_MEMORY;
    *contact = (iccp_contact){{NONE, NONE}, NONE, {NONE, NONE}};
    if (n == 0)
        return ICC_OK;
    s.corners = iccp_alloc(&env->memory, n, 3 * sizeof *s.corners);
    if (s.corners != NULL) {
        list_wires(domain->features, s.corners);
        iccp_facet_tree_create(&s.wires, 3, domain->vertices, n, s.corners, &env->memory);
        if (s.wires.boxes != NULL)
            status = find(contact, &s, env);
        iccp_facet_tree_free(&s.wires, &env->memory);
    }
    iccp_free(&env->memory, s.corners);
    return status;
}
