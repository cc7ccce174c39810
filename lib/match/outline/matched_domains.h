/* The two domains of a match as they come about, ring by ring and line by line. */
#ifndef ICCP_MATCHED_DOMAINS_H
#define ICCP_MATCHED_DOMAINS_H

#include "match/outline/union_outline.h"

typedef struct iccp_matched_domains {
    size_t n; /* common vertices so far */
    size_t n_joined;
    uint32_t *origin[2]; /* vertices of the domains given; UINT32_MAX: added */
    double *points[2];   /* as the caller sees them */
    size_t n_features;
    icc_feature *feature[2];
    uint32_t *first; /* n_features + 1: where features begin; of the first, how many vertices the
                        outer ring has */
} iccp_matched_domains;

/* Room for all vertices of two domains with as many features, and n_landmarks. Frees nothing. */
icc_status iccp_matched_domains_create(iccp_matched_domains *matched, const icc_domain *source,
                                       const icc_domain *target, size_t n_landmarks,
                                       const iccp_memory *memory);

/* Accepts one that is all zero. */
void iccp_matched_domains_free(iccp_matched_domains *matched, const iccp_memory *memory);

/* Adds common vertices, from the source's first one on and in the source's sense; of a line from
 * its first end to the other. */
void iccp_matched_domains_add(iccp_matched_domains *matched, const iccp_outline *outline,
                              const iccp_union_outline *common);

/* Adds n vertices of both domains, which go together one by one. */
void iccp_matched_domains_add_vertices(iccp_matched_domains *matched,
                                       const icc_domain *const *domains, const uint32_t *first,
                                       size_t n);

/* All that was added so far is the outer ring. */
void iccp_matched_domains_end_outer(iccp_matched_domains *matched);

/* What was added since then, or since the last feature, is one of this kind. */
void iccp_matched_domains_end_feature(iccp_matched_domains *matched, int32_t kind);

/* One of the two domains. */
icc_status iccp_matched_domains_get(icc_domain **out, iccp_matched_domains *matched, size_t side,
                                    const iccp_env *env, icc_error *err);

#endif
