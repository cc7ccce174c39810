/* The two domains of a match while they are built, ring by ring and line by line. */
#ifndef ICCP_MATCHED_DOMAINS_H
#define ICCP_MATCHED_DOMAINS_H

#include "match/outline/union_outline.h"

typedef struct iccp_matched_domains {
    size_t n; /* common vertices added until now */
    size_t n_joined;
    uint32_t *origin[2]; /* vertices of the given domains; UINT32_MAX if added */
    double *points[2];   /* in the caller's coordinates */
    size_t n_features;
    icc_feature *feature[2];
    uint32_t *first; /* n_features + 1: where each feature begins; the first entry is the number
                        of vertices of the outer ring */
} iccp_matched_domains;

/* Makes room for all vertices of two domains with equally many features, and for n_landmarks. The
 * caller frees it even after an error. */
icc_status iccp_matched_domains_create(iccp_matched_domains *matched, const icc_domain *source,
                                       const icc_domain *target, size_t n_landmarks,
                                       const iccp_memory *memory);

/* Accepts a struct of zeros. */
void iccp_matched_domains_free(iccp_matched_domains *matched, const iccp_memory *memory);

/* Adds common vertices, from the source's first vertex on and in the source's direction. A line
 * goes from its first end to the other. */
void iccp_matched_domains_add(iccp_matched_domains *matched, const iccp_outline *outline,
                              const iccp_union_outline *common);

/* Closes a line: repeats the first vertex of the feature being added. `last`: the source's vertex
 * there. */
void iccp_matched_domains_close(iccp_matched_domains *matched, uint32_t last);

/* Adds n vertices of both domains that correspond one by one. */
void iccp_matched_domains_add_vertices(iccp_matched_domains *matched,
                                       const icc_domain *const *domains, const uint32_t *first,
                                       size_t n);

/* Ends the outer ring, which consists of everything added before. */
void iccp_matched_domains_end_outer(iccp_matched_domains *matched);

/* Ends a feature of this kind. It consists of everything added since the outer ring or the last
 * feature. */
void iccp_matched_domains_end_feature(iccp_matched_domains *matched, int32_t kind);

/* Makes one of the two domains. */
icc_status iccp_matched_domains_get(icc_domain **out, iccp_matched_domains *matched, size_t side,
                                    const iccp_env *env, icc_error *err);

#endif
