/* Finds the partners of parts by solving an assignment problem. A part is compared by its place in
 * the bounding box of the whole, by the root of its share of the whole's area, and by its number of
 * holes, which counts twice. So the dot of an i goes with the dot. */
#include "match/part_partners.h"

#include "base/error.h"
#include "match/assignment.h"

#include <math.h>

#define NONE ICCP_NO_FEATURE

static const char *const kind_name[ICCP_N_KINDS] = {
    [ICC_FEATURE_HOLE] = "holes",
    [ICC_FEATURE_LINE] = "lines inside",
    [ICC_FEATURE_POINT] = "points inside",
    [ICC_FEATURE_REGION] = "regions inside others",
    [ICCP_KIND_RIM] = "points with a radius",
    [ICCP_KIND_CLOSED] = "closed lines inside",
};

icc_status iccp_parts_count(const iccp_domain_parts *source, const iccp_domain_parts *target,
                            icc_error *err)
{
    const iccp_domain_parts *const sides[2] = {source, target};
    size_t n[2][ICCP_N_KINDS] = {{0}, {0}};
    if (source->n != target->n)
        return iccp_fail(err, ICC_ERR_BOUNDARY, "the source has %zu part%s, the target %zu",
                         source->n, source->n == 1 ? "" : "s", target->n);
    for (int e = 0; e < 2; ++e)
        for (size_t k = 0; k < sides[e]->n; ++k)
            for (int kind = 0; kind < ICCP_N_KINDS; ++kind)
                n[e][kind] += sides[e]->part[k].count[kind];
    for (int kind = 0; kind < ICCP_N_KINDS; ++kind)
        if (n[0][kind] != n[1][kind] && kind_name[kind] != NULL)
            return iccp_fail(err, ICC_ERR_BOUNDARY, "the source has %zu %s, the target %zu",
                             n[0][kind], kind_name[kind], n[1][kind]);
    return ICC_OK;
}

/* For icc_error::index. */
static int64_t index_of(const iccp_domain_part *part)
{
    return part->ring != NONE ? (int64_t)part->ring : -1;
}

/* Checks that partners have equally many features of each kind. */
static icc_status check_counts(const uint32_t *partner, const iccp_domain_parts *parts,
                               icc_error *err)
{
    for (size_t k = 0; k < parts[0].n; ++k)
        for (int kind = 0; kind < ICCP_N_KINDS; ++kind) {
            const iccp_domain_part *const a = &parts[0].part[k];
            const iccp_domain_part *const b = &parts[1].part[partner[k]];
            if (a->count[kind] != b->count[kind])
                return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FEATURE, index_of(a),
                                    "part %zu has %zu %s, but its partner in the target, part %lu, "
                                    "has %zu",
                                    k, a->count[kind], kind_name[kind], (unsigned long)partner[k],
                                    b->count[kind]);
        }
    return ICC_OK;
}

/* Describes part `number` of a domain in which all parts have this area. */
static iccp_spot spot_of(const iccp_domain_parts *parts, uint32_t number, const icc_domain *domain,
                         double area)
{
    const iccp_domain_part *const part = &parts->part[number];
    iccp_spot out = {.number = number, .count = 2 * (double)part->count[ICC_FEATURE_HOLE]};
    for (int e = 0; e < 2; ++e)
        out.at[e] = (part->centre[e] - domain->lower[e]) / (domain->upper[e] - domain->lower[e]);
    out.size = sqrt(part->area / area);
    return out;
}

/* Lists the parts of one side that have no partner yet. Returns their number. */
static size_t list(iccp_spot *spots, const iccp_domain_parts *parts, const icc_domain *domain,
                   const bool *is_paired)
{
    double area = 0;
    size_t n = 0;
    for (size_t k = 0; k < parts->n; ++k)
        area += parts->part[k].area;
    for (uint32_t k = 0; k < parts->n; ++k)
        if (!is_paired[k])
            spots[n++] = spot_of(parts, k, domain, area);
    return n;
}

static icc_status check_exchange(const iccp_spot *a, const iccp_spot *b, size_t n, double sure,
                                 const iccp_domain_parts *source, icc_error *err)
{
    size_t i, k;
    if (!iccp_can_exchange(&i, &k, a, b, n, iccp_place_noise * iccp_place_noise, sure))
        return ICC_OK;
    iccp_fail_at(err, ICC_ERR_AMBIGUOUS, ICC_ITEM_FEATURE, index_of(&source->part[a[i].number]),
                 "part %lu and part %lu could go to one another's places almost as well: give a "
                 "landmark, a point of one of them and its partner's",
                 (unsigned long)a[i].number, (unsigned long)a[k].number);
    return iccp_fail_side(err, ICC_ERR_AMBIGUOUS, 1);
}

icc_status iccp_parts_partner(uint32_t *partner, const icc_domain *const *domains,
                              const iccp_domain_parts *parts, double sure, const iccp_env *env,
                              icc_error *err)
{
    const size_t n = parts[0].n;
    size_t n_free = 0;
    iccp_spot *const spots = iccp_alloc(&env->memory, n, 2 * sizeof *spots);
    bool *const is_paired = iccp_alloc_zero(&env->memory, n, 2 * sizeof *is_paired);
    icc_status status = spots != NULL && is_paired != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        if (partner[k] != NONE)
            is_paired[k] = is_paired[n + partner[k]] = true;
    if (status == ICC_OK && n > 1) {
        n_free = list(spots, &parts[0], domains[0], is_paired);
        (void)list(spots + n, &parts[1], domains[1], is_paired + n);
        status = iccp_assign(spots, spots + n, n_free, env);
    } else if (status == ICC_OK)
        partner[0] = 0;
    status = iccp_explain(err, status);
    if (status == ICC_OK)
        status = check_exchange(spots, spots + n, n_free, sure, &parts[0], err);
    for (size_t k = 0; k < n_free && status == ICC_OK; ++k)
        partner[spots[k].number] = spots[n + k].number;
    if (status == ICC_OK)
        status = check_counts(partner, parts, err);
    iccp_free(&env->memory, spots);
    iccp_free(&env->memory, is_paired);
    return status;
}
