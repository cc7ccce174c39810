/* Builds the two domains of a match, ring by ring and line by line. */
#include "match/outline/matched_domains.h"

#include "base/error.h"
#include "domain/features.h"

#include <string.h>

#define NONE UINT32_MAX

icc_status iccp_matched_domains_create(iccp_matched_domains *matched, const icc_domain *source,
                                       const icc_domain *target, size_t n_landmarks,
                                       const iccp_memory *memory)
{
    const size_t n = source->n_vertices + target->n_vertices + n_landmarks;
    const size_t n_features = source->features != NULL ? source->features->n : 0;
    bool has_all = true;
    for (int e = 0; e < 2; ++e) {
        matched->origin[e] = iccp_alloc(memory, n, sizeof *matched->origin[e]);
        matched->points[e] = iccp_alloc(memory, n, 2 * sizeof *matched->points[e]);
        matched->feature[e] = iccp_alloc_zero(memory, n_features, sizeof *matched->feature[e]);
        has_all = has_all && matched->origin[e] != NULL && matched->points[e] != NULL &&
                  matched->feature[e] != NULL;
    }
    matched->first = iccp_alloc(memory, n_features + 1, sizeof *matched->first);
    return has_all && matched->first != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

void iccp_matched_domains_free(iccp_matched_domains *matched, const iccp_memory *memory)
{
    for (int e = 0; e < 2; ++e) {
        iccp_free(memory, matched->origin[e]);
        iccp_free(memory, matched->points[e]);
        iccp_free(memory, matched->feature[e]);
    }
    iccp_free(memory, matched->first);
}

/* A vertex as the caller gave it, or a point of an edge. */
static void point_of(double *point, const iccp_outline *outline, uint32_t vertex, double share)
{
    if (vertex != NONE) {
        iccp_domain_given(outline->domain, outline->vertex[vertex], point);
        return;
    }
    double along, p[2], q[2];
    const size_t k = iccp_outline_edge(outline, share, &along);
    iccp_domain_given(outline->domain, outline->vertex[k], p);
    iccp_domain_given(outline->domain, outline->vertex[(k + 1) % outline->n], q);
    for (int e = 0; e < 2; ++e)
        point[e] = p[e] + along * (q[e] - p[e]);
}

void iccp_matched_domains_add(iccp_matched_domains *matched, const iccp_outline *outline,
                              const iccp_union_outline *common)
{
    size_t first = 0;
    for (size_t k = 0; k < common->n; ++k)
        if (common->vertex[2 * k] == 0)
            first = k;
    for (size_t k = 0; k < common->n; ++k) {
        const size_t on = !outline[0].is_back || k == 0 ? k : common->n - k;
        const size_t at = (first + on) % common->n, to = matched->n++;
        const uint32_t *const vertex = common->vertex + 2 * at;
        for (size_t e = 0; e < 2; ++e) {
            matched->origin[e][to] = vertex[e] == NONE ? NONE : outline[e].vertex[vertex[e]];
            point_of(matched->points[e] + 2 * to, &outline[e], vertex[e],
                     common->share[2 * at + e]);
        }
        matched->n_joined += vertex[0] != NONE && vertex[1] != NONE;
        if (outline[0].end > 0 && vertex[0] == outline[0].end)
            break;
    }
}

void iccp_matched_domains_add_vertices(iccp_matched_domains *matched,
                                       const icc_domain *const *domains, const uint32_t *first,
                                       size_t n)
{
    for (size_t k = 0; k < n; ++k) {
        const size_t to = matched->n++;
        for (size_t e = 0; e < 2; ++e) {
            matched->origin[e][to] = first[e] + (uint32_t)k;
            iccp_domain_given(domains[e], matched->origin[e][to], matched->points[e] + 2 * to);
        }
    }
    matched->n_joined += n;
}

void iccp_matched_domains_close(iccp_matched_domains *matched, uint32_t last)
{
    const size_t first = matched->first[matched->n_features], to = matched->n++;
    matched->origin[0][to] = last;
    matched->origin[1][to] = matched->origin[1][first];
    for (int e = 0; e < 2; ++e)
        memcpy(matched->points[e] + 2 * to, matched->points[e] + 2 * first, 2 * sizeof(double));
}

void iccp_matched_domains_end_outer(iccp_matched_domains *matched)
{
    matched->first[0] = (uint32_t)matched->n;
}

void iccp_matched_domains_end_feature(iccp_matched_domains *matched, int32_t kind)
{
    const size_t f = matched->n_features++, first = matched->first[f];
    for (int e = 0; e < 2; ++e)
        matched->feature[e][f] = (icc_feature){.kind = kind,
                                               .n_vertices = matched->n - first,
                                               .vertices = matched->points[e] + 2 * first};
    matched->first[f + 1] = (uint32_t)matched->n;
}

icc_status iccp_matched_domains_get(icc_domain **out, iccp_matched_domains *matched, size_t side,
                                    const iccp_env *env, icc_error *err)
{
    const icc_status status =
        iccp_domain_create_features(out, matched->first[0], matched->points[side],
                                    matched->n_features, matched->feature[side], env, err);
    return status == ICC_OK ? status : iccp_fail_side(err, status, (int32_t)side + 1);
}
