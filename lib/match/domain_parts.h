/* The parts of a plane domain: an outline with what lies inside it. An island in a lake is a part
 * of its own. */
#ifndef ICCP_DOMAIN_PARTS_H
#define ICCP_DOMAIN_PARTS_H

#include "domain/features.h"

/* Instead of a feature: the outer ring; or nothing yet. */
#define ICCP_NO_FEATURE UINT32_MAX

/* Further kinds of features: circles around points with a radius, which decide the partners of
 * their points; lines that end where they begin; outlines of parts. */
enum { ICCP_KIND_RIM = ICC_FEATURE_REGION + 1, ICCP_KIND_CLOSED, ICCP_KIND_OUTLINE, ICCP_N_KINDS };

typedef struct iccp_domain_part {
    uint32_t ring; /* the region that is its outline; or ICCP_NO_FEATURE: the outer ring */
    /* The area and the centre of the part, without its holes, local. 0 for a domain
     * without features */
    double area, centre[2];
    size_t count[ICCP_N_KINDS]; /* features inside, by kind */
} iccp_domain_part;

typedef struct iccp_domain_parts {
    size_t n;
    iccp_domain_part *part; /* begins with that of the outer ring; then in the order of regions */
    uint32_t *of;           /* of each feature: the part whose outline it is, or in which it lies */
    int32_t *kind;          /* of each feature */
} iccp_domain_parts;

/* ICC_ERR_UNSUPPORTED if features meet one another or the outer ring. */
icc_status iccp_domain_parts_check(const icc_domain *domain, icc_error *err);

/* Finds the parts of a domain of the plane whose features do not meet. O(n) time. The caller frees
 * them even after an error. */
icc_status iccp_domain_parts_create(iccp_domain_parts *parts, const icc_domain *domain,
                                    const iccp_memory *memory);

/* The part of a feature, or of the outer ring (ICCP_NO_FEATURE). */
static inline uint32_t iccp_part_of(const iccp_domain_parts *parts, uint32_t feature)
{
    return feature == ICCP_NO_FEATURE ? 0 : parts->of[feature];
}

/* Accepts a struct of zeros. */
void iccp_domain_parts_free(iccp_domain_parts *parts, const iccp_memory *memory);

#endif
