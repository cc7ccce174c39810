/* Pairs the outlines of all parts of two domains. */
#ifndef ICCP_PART_PAIRING_H
#define ICCP_PART_PAIRING_H

#include "match/feature_landmarks.h"
#include "match/outline/union_outline.h"

/* A part of the source and its partner. */
typedef struct iccp_part_pair {
    uint32_t partner;
    iccp_outline outline[2];
    iccp_union_outline common;
    iccp_elastic_report report;
    bool is_placed; /* the whole decided how the part lies */
} iccp_part_pair;

typedef struct iccp_paired_parts {
    const icc_domain *domain[2]; /* borrowed */
    const iccp_domain_parts *parts;
    iccp_part_pair *pair; /* of each part of the source */
    double *moved;        /* the source's vertices; those of placed parts are placed */
} iccp_paired_parts;

/* Pairs the parts and then their outlines. The affine map of the whole places each part whose shape
 * is ambiguous, such as a round dot, and each part that then fits clearly better. A single part
 * whose shape is ambiguous is refused.
 * ICC_ERR_AMBIGUOUS, ICC_ERR_ARGUMENT, ICC_ERR_BOUNDARY. The caller frees the result even after an
 * error. */
icc_status iccp_pair_parts(iccp_paired_parts *out, const icc_domain *const *domains,
                           const iccp_domain_parts *parts, const iccp_sorted_landmarks *landmarks,
                           const icc_match_options *options, const iccp_env *env, icc_error *err);

/* Accepts a struct of zeros. */
void iccp_paired_parts_free(iccp_paired_parts *paired, const iccp_memory *memory);

#endif
