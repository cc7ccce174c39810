/* An outline: a ring of a plane domain, walked counter-clockwise and measured by its share of arc
 * length. A line inside is an outline that is walked from end to end and back.
 *
 * Words of this folder
 * - share: a part of the outline's length, from its first vertex on, in [0, 1). Unwrapped shares go
 *   on.
 * - pairing: a monotone map from the shares of the source to those of the target; knots describe
 *   it.
 * - landmark: a pair of points that the caller knows to correspond. pin: a place where a pairing is
 *   held.
 * - sample: one of ICCP_MATCH_SAMPLES places at equal distances, for comparing shapes.
 * - descriptor: what an outline looks like from a sample, in several sizes (descriptor.h). Its
 *   weights decide which samples match.
 * - candidate: a pairing of samples that the elastic search refines.
 * - join: a vertex of the source and one of the target that become one vertex.
 *
 * Invariants
 * - Pairings are monotone, so both outlines get their common vertices in the same cyclic order.
 * - Landmarks are vertices of the result.
 *
 * Ways (ring_pairing.h calls them)
 * - By shape: elastic.h over all starts, then pins.h (corners) and vertices.h (single edges).
 * - With landmarks: iccp_elastic_between() and iccp_elastic_bend(). By arc length: arc.h.
 * - Vertices that correspond already: one_to_one.h. Always last: union_outline.h.
 * - Elastic search: elastic.h finds candidates, elastic_candidate.h refines them (widths.h judges),
 *   elastic_between.c goes from landmark to landmark, lattice_path.h finds the cheapest path.
 * - Landmarks on the outlines: landmarks.h. What vertices.h may pair: places.h.
 * - Which vertices become one: merge_vertices.c. The two domains so far: matched_domains.h.
 *
 * Begin with ring_pairing.c. */
#ifndef ICCP_OUTLINE_H
#define ICCP_OUTLINE_H

#include "domain/domain.h"

/* Places of an outline that are closer than this share of its length count as one. */
static const double iccp_one_place = 1e-9;

typedef struct iccp_outline {
    const icc_domain *domain; /* borrowed; NULL: there is none */
    size_t n;
    size_t end;   /* for a line: the place of its other end among the n vertices; else 0 */
    bool is_back; /* the domain lists it in the other direction */
    uint32_t
        *vertex; /* n: the domain's numbers of the vertices, or of the points, from the first on */
    double *points;  /* 2 (n + 1), local; the first point is repeated at the end */
    double *share;   /* n + 1: the length up to each vertex as a share of the whole: 0 .. 1 */
    double diameter; /* diagonal of the bounding box */
    double perimeter;
} iccp_outline;

/* Makes the outline of the outer ring. */
icc_status iccp_outline_create(iccp_outline *outline, const icc_domain *domain,
                               const iccp_memory *memory, icc_error *err);

/* Makes the outline of a hole or a line. A line is walked from its last vertex if `is_back`. */
icc_status iccp_outline_create_feature(iccp_outline *outline, const icc_domain *domain,
                                       size_t feature, bool is_back, const iccp_memory *memory);

/* Makes an outline of n points that belong to no domain: a ring, or a line from the first to the
 * last. */
icc_status iccp_outline_create_points(iccp_outline *outline, size_t n, const double *points,
                                      bool is_ring, const iccp_memory *memory);

/* Moves the outline to these vertices of the domain, and measures it. */
void iccp_outline_place(iccp_outline *outline, const double *vertices);

/* Accepts a struct of zeros. */
void iccp_outline_free(iccp_outline *outline, const iccp_memory *memory);

/* Returns a share of arc length without its whole turns, in [0, 1). */
double iccp_outline_wrap(double share);

/* Returns the edge at a share of arc length. *along is the place on it. */
size_t iccp_outline_edge(const iccp_outline *outline, double share, double *along);

/* The local point at a share. */
void iccp_outline_at(const iccp_outline *outline, double share, double *point);

#endif
