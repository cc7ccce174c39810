/* How far a map in the plane or in space is improved, and what that may cost. */
#ifndef ICCP_SCHEDULE_H
#define ICCP_SCHEDULE_H

#include "icc/icc.h"
#include "map/energy/work.h"

/* How far a map is improved. */
typedef struct iccp_schedule {
    size_t iterations; /* on each mesh at most */
    double tolerance;  /* on the last mesh, until a step gains no more than this share */
    size_t levels;     /* refinements at most, */
    double most;       /* to no more triangles than this */
    bool both_sides;   /* the points of inner vertices move, too */
    bool is_relaxed;   /* they have: the energy has come down, and what is left is refined */
} iccp_schedule;

/* The work of making a map, part by part: how much is left and how much is spent. */
typedef struct iccp_allowance {
    iccp_work search;  /* trying trees of cuts, or moving the fixed vertices to another target */
    iccp_work overlay; /* making an overlay and relaxing it */
    iccp_work improvement; /* from a start that is one-to-one */
    double relaxing;       /* the overlay's share for steps */
    double all;            /* the most that the parts may take together */
} iccp_allowance;

/* The allowance for a map between domains of n_facets if the caller sets no limits. */
iccp_allowance iccp_allow(size_t n_facets);

double iccp_spent(const iccp_allowance *work);

/* Limits a part to what is left of all. Call it before the part begins. */
iccp_work *iccp_bound(iccp_work *part, const iccp_allowance *work);

/* Schedules whose other members come from options: the images alone, from any start; from a start
 * on which both sides have moved; and with points that move, too. */
extern const iccp_schedule iccp_schedule_plain, iccp_schedule_relaxed, iccp_schedule_both_sides;

/* The schedule that the options ask for, with defaults for members that are 0. `how` gives
 * both_sides and is_relaxed. The mesh gets at most `most` simplices. */
iccp_schedule iccp_schedule_of(const icc_improve_options *options, const iccp_schedule *how,
                               double most);

/* The work that improvement may take: unlimited if the options set limits of their own. */
iccp_work iccp_schedule_work(const icc_improve_options *options, size_t n_facets);

/* The most simplices that a map of n_simplices may get: unlimited if its work is. */
double iccp_schedule_most(const iccp_work *work, size_t n_simplices);

#endif
