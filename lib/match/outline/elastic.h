/* Elastic matching of two outlines: pairs the shares of one outline's length with those of the
 * other. */
#ifndef ICCP_ELASTIC_H
#define ICCP_ELASTIC_H

#include "match/outline/outline.h"

/* Samples of each outline, whatever its vertices. 1024 do not lower the error. */
enum { ICCP_MATCH_SAMPLES = 512 };

/* A pairing of two outlines: shares of arc length, both growing by at most one turn. */
typedef struct iccp_pairing_knots {
    size_t n;
    double *knot; /* pairs */
} iccp_pairing_knots;

/* How good a pairing is. */
typedef struct iccp_elastic_report {
    double cost, second; /* cost of the best pairing, and of the best one elsewhere; HUGE_VAL if
                            there is none */
    double sure;
    double turn;     /* rotation of the target, in turns, counter-clockwise */
    double mirrored; /* how many times better the mirror image fits, compared as for `sure`; or 0 */
} iccp_elastic_report;

/* Returns how many times better `cost` is than `other`. Costs near 0 count as equal. */
double iccp_elastic_better(double cost, double other);

/* Searches all starts. `knots` has room for 2 N + 1 pairs. */
icc_status iccp_elastic_search(iccp_pairing_knots *knots, iccp_elastic_report *report,
                               const iccp_outline *source, const iccp_outline *target, bool is_free,
                               const iccp_env *env);

/* Searches close to a pairing by arc length. That pairing begins with the source's first vertex and
 * a share of the target. The source must already lie where the target should. Reports the cost.
 * `knots` has room for 2 N + 1 pairs. */
icc_status iccp_elastic_near(iccp_pairing_knots *knots, iccp_elastic_report *report,
                             const iccp_outline *source, const iccp_outline *target, double start,
                             const iccp_memory *memory);

/* Searches close to a pairing with n landmarks. If the target is bent, the result is taken and may
 * miss landmarks by a little. `knots` has room for 2 N + 1 pairs. */
icc_status iccp_elastic_bend(iccp_pairing_knots *knots, const iccp_outline *source,
                             const iccp_outline *target, size_t n, const double *landmarks,
                             const iccp_memory *memory);

/* Searches between landmarks: n pairs of shares, both growing by less than one turn. Every landmark
 * becomes a knot. `knots` has room for 4 N + 9 n pairs. */
icc_status iccp_elastic_between(iccp_pairing_knots *knots, iccp_elastic_report *report,
                                const iccp_outline *source, const iccp_outline *target, size_t n,
                                const double *landmarks, const iccp_env *env);

/* Searches between two pairs of shares that are held, `from` and `width` further on. Both outlines
 * get n samples there, 4 <= n <= N. Appends at most 2 n knots. The first is at `from`, and none is
 * at the other end. */
icc_status iccp_elastic_open(iccp_pairing_knots *knots, const iccp_outline *source,
                             const iccp_outline *target, const double *from, const double *width,
                             size_t n, const iccp_memory *memory);

#endif
