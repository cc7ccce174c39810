/* Elastic matching of two outlines: which share of the one's length goes to which of the other's.
 */
#ifndef ICCP_ELASTIC_H
#define ICCP_ELASTIC_H

#include "match/outline/outline.h"

/* Samples of each outline, whatever its vertices: 1024 do not lower the error. */
enum { ICCP_MATCH_SAMPLES = 512 };

/* A pairing of two outlines: shares of arc length, both growing by at most one turn. */
typedef struct iccp_pairing_knots {
    size_t n;
    double *knot; /* pairs */
} iccp_pairing_knots;

/* How good a pairing is. */
typedef struct iccp_elastic_report {
    double cost, second; /* of the best, and of the best one elsewhere; HUGE_VAL: none */
    double sure;
    double turn;     /* the target is turned by so many turns, counter-clockwise */
    double mirrored; /* how many times better the mirror image fits, as `sure` compares; or 0 */
} iccp_elastic_report;

/* Searches all starts. `knots` has room for 2 N + 1 pairs. */
icc_status iccp_elastic_search(iccp_pairing_knots *knots, iccp_elastic_report *report,
                               const iccp_outline *source, const iccp_outline *target, bool is_free,
                               const iccp_env *env);

/* Near the pairing by arc length that begins with the source's first vertex and a share of the
 * target's. The source lies as the target should. `knots` has room for 2 N + 1 pairs. */
icc_status iccp_elastic_near(iccp_pairing_knots *knots, const iccp_outline *source,
                             const iccp_outline *target, double start, const iccp_memory *memory);

/* Near a pairing with n landmarks, which is taken where the target is bent and may then be off
 * these a little. `knots` has room for 2 N + 1 pairs. */
icc_status iccp_elastic_bend(iccp_pairing_knots *knots, const iccp_outline *source,
                             const iccp_outline *target, size_t n, const double *landmarks,
                             const iccp_memory *memory);

/* Between landmarks: n pairs of shares, both growing by less than one turn. Knots at all of them.
 * `knots` has room for 4 N + 9 n pairs. */
icc_status iccp_elastic_between(iccp_pairing_knots *knots, iccp_elastic_report *report,
                                const iccp_outline *source, const iccp_outline *target, size_t n,
                                const double *landmarks, const iccp_env *env);

#endif
