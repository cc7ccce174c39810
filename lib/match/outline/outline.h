/* A ring of a domain of the plane, walked counter-clockwise, by its share of arc length; or a line
 * inside, which is walked from end to end and back. */
#ifndef ICCP_OUTLINE_H
#define ICCP_OUTLINE_H

#include "domain/domain.h"

typedef struct iccp_outline {
    const icc_domain *domain; /* borrowed */
    size_t n;
    size_t end;       /* of a line: the place of its other end among the n; else 0 */
    bool is_back;     /* the domain lists it the other way round */
    uint32_t *vertex; /* n: the domain's numbers of the vertices, the first one first */
    double *points;   /* 2 (n + 1), local; the first once more at the end */
    double *share;    /* n + 1: the length up to a vertex, of that of the whole: 0 .. 1 */
    double diameter;  /* diagonal of the bounding box */
    double perimeter;
} iccp_outline;

/* Of the outer ring. */
icc_status iccp_outline_create(iccp_outline *outline, const icc_domain *domain,
                               const iccp_memory *memory, icc_error *err);

/* Of a hole, or of a line, which is walked from its last vertex if `is_back`. */
icc_status iccp_outline_create_feature(iccp_outline *outline, const icc_domain *domain,
                                       size_t feature, bool is_back, const iccp_memory *memory);

/* Puts the points to where these vertices of the domain are, and measures. */
void iccp_outline_place(iccp_outline *outline, const double *vertices);

/* Accepts one that is all zero. */
void iccp_outline_free(iccp_outline *outline, const iccp_memory *memory);

/* The part of a share of arc length beyond whole turns, in [0, 1). */
double iccp_outline_wrap(double share);

/* The edge with a share of arc length, and how far along it. */
size_t iccp_outline_edge(const iccp_outline *outline, double share, double *along);

/* The local point there. */
void iccp_outline_at(const iccp_outline *outline, double share, double *point);

#endif
