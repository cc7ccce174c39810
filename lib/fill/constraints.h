/* The surfaces and lines to be filled: facets, edges, and the points that were put on them. */
#ifndef ICCP_CONSTRAINTS_H
#define ICCP_CONSTRAINTS_H

#include "domain/domain.h"
#include "fill/tets.h"

/* An edge of the surface from a to b, a < b. The points on it are linked from `first` to b. */
typedef struct iccp_segment {
    uint32_t a, b, first;
    uint32_t facet; /* one of its two facets; of a line: the feature */
} iccp_segment;

typedef struct iccp_constraints {
    iccp_memory memory;
    size_t n_facets, n_segments;
    size_t n_boundary;      /* the first facets; the others have the domain on both sides */
    const uint32_t *facets; /* 3 vertices each */
    uint32_t *side;         /* 3 per facet: the segment opposite each corner */
    iccp_segment *segment;
    iccp_pairs edges;   /* all edges that ever were pieces of segments */
    iccp_segment *line; /* the segments of lines */
    size_t n_lines;
    iccp_on_line *on_line; /* points that were put on lines, in the order of these segments */
    size_t n_on_lines;
} iccp_constraints;

/* Takes the surfaces and lines of a domain. The facets stay the domain's. */
icc_status iccp_constraints_create(iccp_constraints *s, const icc_domain *domain,
                                   const iccp_env *env, icc_error *err);
void iccp_constraints_free(iccp_constraints *s);

/* Returns the next point after p towards b on the segment. p lies on the segment. */
uint32_t iccp_segment_next(const iccp_tets *m, const iccp_segment *segment, uint32_t p);

/* Returns the position of one of its points along a segment, as a share. */
double iccp_segment_share(const iccp_tets *m, const iccp_segment *segment, uint32_t p);

/* Returns true if a point is a corner of the facet, or was put on it or on one of its edges. */
bool iccp_is_on_facet(const iccp_tets *m, const uint32_t corners[3], uint32_t p);

/* Adds a point on the surface. Returns ICCP_NO_TET if there is no memory. */
uint32_t iccp_tets_add_dyadic(iccp_tets *m, const iccp_dyadic *point);
void iccp_tets_drop_dyadic(iccp_tets *m);

/* Returns ICC_ERR_RESOLUTION with a message that names a facet. */
icc_status iccp_fail_facet(icc_error *err, uint32_t facet, const char *what);

#endif
