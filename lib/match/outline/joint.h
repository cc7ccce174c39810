/* The two domains of a match as they come about, ring by ring and line by line. */
#ifndef ICCP_JOINT_H
#define ICCP_JOINT_H

#include "match/outline/common.h"

typedef struct iccp_joint {
    size_t n; /* common vertices so far */
    size_t n_joined;
    uint32_t *origin[2]; /* vertices of the domains given; UINT32_MAX: added */
    double *points[2];   /* as the caller sees them */
    size_t n_features;
    icc_feature *feature[2];
    uint32_t *first; /* n_features + 1: where features begin; of the first, how many vertices the
                        outer ring has */
} iccp_joint;

/* Room for all vertices of two domains with as many features, and n_landmarks. Frees nothing. */
icc_status iccp_joint_create(iccp_joint *joint, const icc_domain *source, const icc_domain *target,
                             size_t n_landmarks, const iccp_memory *memory);

/* Accepts one that is all zero. */
void iccp_joint_free(iccp_joint *joint, const iccp_memory *memory);

/* Adds common vertices, from the source's first one on and in the source's sense; of a line from
 * its first end to the other. */
void iccp_joint_add(iccp_joint *joint, const iccp_outline *outline, const iccp_common *common);

/* Adds n vertices of both domains, which go together one by one. */
void iccp_joint_add_vertices(iccp_joint *joint, const icc_domain *const *domains,
                             const uint32_t *first, size_t n);

/* All that was added so far is the outer ring. */
void iccp_joint_end_outer(iccp_joint *joint);

/* What was added since then, or since the last feature, is one of this kind. */
void iccp_joint_end_feature(iccp_joint *joint, int32_t kind);

/* One of the two domains. */
icc_status iccp_joint_domain(icc_domain **out, iccp_joint *joint, size_t side, const iccp_env *env,
                             icc_error *err);

#endif
