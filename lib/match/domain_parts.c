/* Finds the parts of a domain from the faces of its network. Faces that a side inside the domain
 * joins belong to one part. The outline of a part is the ring that has the part inside and nothing
 * outside. */
#include "match/domain_parts.h"

#include "base/error.h"
#include "base/sets.h"
#include "domain/network.h"

#define NONE ICCP_NO_FEATURE

/* Returns true if a ring has the domain inside and not outside. */
static bool is_outline(const icc_domain *domain, size_t first_facet, int32_t orientation)
{
    const uint32_t *const face = domain->features->network->face + 2 * first_facet;
    return face[orientation < 0] != ICCP_NO_FACE && face[orientation > 0] == ICCP_NO_FACE;
}

static bool is_closed(const icc_domain *domain, const iccp_feature *f)
{
    const uint32_t *const node = domain->features->network->node;
    return f->kind == ICC_FEATURE_LINE && node[f->first + f->n - 1] == node[f->first];
}

/* ---- what cannot be matched ---- */

/* Returns true if a vertex is the only one at its place, but for the ends of a closed line. */
static bool is_apart(const icc_domain *domain, uint32_t vertex)
{
    const iccp_features *const all = domain->features;
    const uint32_t node = all->network->node[vertex];
    const uint32_t feature = iccp_feature_of_vertex(all, vertex);
    return node == vertex ||
           (feature != NONE && is_closed(domain, &all->item[feature]) &&
            node == all->item[feature].first && vertex == node + all->item[feature].n - 1);
}

/* Reports that a vertex coincides with an earlier one. */
static icc_status fail_meeting(const icc_domain *domain, uint32_t vertex, icc_error *err)
{
    static const char *const why = "features that meet cannot be matched";
    const iccp_features *const all = domain->features;
    const uint32_t f = iccp_feature_of_vertex(all, vertex);
    const uint32_t g = iccp_feature_of_vertex(all, all->network->node[vertex]);
    double at[2];
    iccp_domain_given(domain, vertex, at);
    if (g == NONE)
        return iccp_fail_at(err, ICC_ERR_UNSUPPORTED, ICC_ITEM_FEATURE, (int64_t)f,
                            "feature %lu meets the outer ring at (%.9g, %.9g); %s",
                            (unsigned long)f, at[0], at[1], why);
    return iccp_fail_at(err, ICC_ERR_UNSUPPORTED, ICC_ITEM_FEATURE, (int64_t)f,
                        "feature %lu meets feature %lu at (%.9g, %.9g); %s", (unsigned long)f,
                        (unsigned long)g, at[0], at[1], why);
}

icc_status iccp_domain_parts_check(const icc_domain *domain, icc_error *err)
{
    const iccp_features *const all = domain->features;
    if (all != NULL && all->n_outer > 0 && !is_outline(domain, 0, domain->orientation))
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "the outer ring lies inside a region; such domains cannot be matched");
    for (uint32_t v = 0; all != NULL && v < domain->n_vertices; ++v)
        if (!is_apart(domain, v))
            return fail_meeting(domain, v, err);
    return ICC_OK;
}

/* ---- areas ---- */

/* Adds `sign` times the area inside a ring, and its first moments. */
static void add_area(iccp_domain_part *part, const double *ring, size_t n, double sign)
{
    double twice = 0, moment[2] = {0, 0};
    for (size_t k = 1; k + 1 < n; ++k) {
        const double *const a = ring + 2 * k, *const b = a + 2;
        const double cross =
            (a[0] - ring[0]) * (b[1] - ring[1]) - (a[1] - ring[1]) * (b[0] - ring[0]);
        twice += cross;
        for (size_t e = 0; e < 2; ++e)
            moment[e] += cross * (a[e] + ring[e] + b[e]) / 3;
    }
    sign = twice < 0 ? -sign : sign;
    part->area += sign * twice / 2;
    for (size_t e = 0; e < 2; ++e)
        part->centre[e] += sign * moment[e] / 2;
}

static void find_areas(iccp_domain_parts *parts, const icc_domain *domain)
{
    const iccp_features *const all = domain->features;
    if (all->n_outer > 0)
        add_area(&parts->part[0], domain->vertices, all->n_outer, 1);
    for (size_t f = 0; f < all->n; ++f)
        if (parts->kind[f] == ICCP_KIND_OUTLINE || parts->kind[f] == ICC_FEATURE_HOLE)
            add_area(&parts->part[parts->of[f]], domain->vertices + 2 * (size_t)all->item[f].first,
                     all->item[f].n, parts->kind[f] == ICCP_KIND_OUTLINE ? 1 : -1);
    for (size_t k = 0; k < parts->n; ++k)
        for (int e = 0; e < 2; ++e)
            parts->part[k].centre[e] /= parts->part[k].area;
}

/* ---- parts ---- */

/* Joins the faces on both sides of each side inside the domain. */
static void join_faces(uint32_t *set, const icc_domain *domain)
{
    const iccp_network *const network = domain->features->network;
    iccp_sets_begin(set, network->n_faces);
    for (uint32_t f = 0; f < domain->features->n_places; ++f) {
        const uint32_t *const face = network->face + 2 * (size_t)f;
        if (network->side[f] == f && face[0] != ICCP_NO_FACE && face[1] != ICCP_NO_FACE)
            (void)iccp_sets_join(set, face[0], face[1]);
    }
}

/* Adds the part with this outline. part_of: the part of each set of faces. */
static void add_part(iccp_domain_parts *parts, uint32_t *part_of, uint32_t set, uint32_t ring)
{
    part_of[set] = (uint32_t)parts->n;
    parts->part[parts->n++] = (iccp_domain_part){.ring = ring};
}

/* The set of the faces beside a facet. */
static uint32_t set_at(const icc_domain *domain, uint32_t *set, size_t facet)
{
    const uint32_t *const face = domain->features->network->face + 2 * facet;
    return iccp_sets_leader(set, face[0] != ICCP_NO_FACE ? face[0] : face[1]);
}

static icc_status find_parts(iccp_domain_parts *parts, const icc_domain *domain,
                             const iccp_memory *memory)
{
    const iccp_features *const all = domain->features;
    const size_t n_faces = all->network->n_faces;
    uint32_t *const set = iccp_alloc(memory, n_faces, 2 * sizeof *set);
    if (set == NULL)
        return ICC_ERR_MEMORY;
    uint32_t *const part_of = set + n_faces;
    join_faces(set, domain);
    if (all->n_outer > 0)
        add_part(parts, part_of, set_at(domain, set, 0), NONE);
    for (uint32_t f = 0; f < all->n; ++f) {
        const iccp_feature *const item = &all->item[f];
        if (item->kind != ICC_FEATURE_REGION ||
            !is_outline(domain, item->first_facet, item->orientation))
            continue;
        add_part(parts, part_of, set_at(domain, set, item->first_facet), f);
        parts->kind[f] = ICCP_KIND_OUTLINE;
    }
    for (size_t f = 0; f < all->n; ++f) {
        parts->of[f] = part_of[set_at(domain, set, all->item[f].first_facet)];
        ++parts->part[parts->of[f]].count[parts->kind[f]];
    }
    iccp_free(memory, set);
    return ICC_OK;
}

icc_status iccp_domain_parts_create(iccp_domain_parts *parts, const icc_domain *domain,
                                    const iccp_memory *memory)
{
    const iccp_features *const all = domain->features;
    const size_t n = all != NULL ? all->n : 0;
    *parts = (iccp_domain_parts){0};
    parts->part = iccp_alloc(memory, n + 1, sizeof *parts->part);
    parts->of = iccp_alloc(memory, n, sizeof *parts->of);
    parts->kind = iccp_alloc(memory, n, sizeof *parts->kind);
    if (parts->part == NULL || parts->of == NULL || parts->kind == NULL)
        return ICC_ERR_MEMORY;
    if (all == NULL) {
        parts->part[parts->n++] = (iccp_domain_part){.ring = NONE};
        return ICC_OK;
    }
    for (size_t f = 0; f < n; ++f)
        parts->kind[f] = all->item[f].rim_of != NONE        ? ICCP_KIND_RIM
                         : is_closed(domain, &all->item[f]) ? ICCP_KIND_CLOSED
                                                            : all->item[f].kind;
    const icc_status status = find_parts(parts, domain, memory);
    if (status == ICC_OK)
        find_areas(parts, domain);
    return status;
}

void iccp_domain_parts_free(iccp_domain_parts *parts, const iccp_memory *memory)
{
    iccp_free(memory, parts->part);
    iccp_free(memory, parts->of);
    iccp_free(memory, parts->kind);
}
