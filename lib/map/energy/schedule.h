/* How far a map in the plane or in space is improved, and what that may cost. */
#ifndef ICCP_SCHEDULE_H
#define ICCP_SCHEDULE_H

#include "icc/icc.h"
#include "map/energy/work.h"

/* How far a map is improved. */
typedef struct iccp_schedule {
    size_t iterations; /* the most steps on one mesh */
    double tolerance;  /* steps on the last mesh end when one gains no more than this share */
    size_t levels;     /* the most refinements */
    double most;       /* the most triangles that a refinement may reach */
    bool moves_points; /* the points of inner vertices move, too */
    bool is_relaxed;   /* they have moved before, so refining begins at once and one slow step
                          ends the steps on a mesh */
} iccp_schedule;

/* The work of making a map, part by part: how much is left and how much is spent. */
typedef struct iccp_allowance {
    iccp_work search;  /* trying trees of cuts, or moving the fixed vertices to another target */
    iccp_work vain;    /* trees of cuts that lead to no map: as much as the whole, of which they are
                          no part */
    iccp_work overlay; /* making an overlay and relaxing it */
    iccp_work improvement; /* improving a map that is one-to-one already */
    double relaxing;       /* the most work of steps on an overlay */
    double all;            /* the most that the parts may take together */
} iccp_allowance;

/* Returns the allowance for a map between domains of n_facets if the caller sets no limits. */
iccp_allowance iccp_allow(size_t n_facets);

double iccp_spent(const iccp_allowance *work);

/* Limits a part to the work that is left of the whole. Call it before the part begins. */
iccp_work *iccp_bound(iccp_work *part, const iccp_allowance *work);

/* Values of moves_points and is_relaxed for iccp_schedule_of(). `plain` moves images alone, from
 * any start. `relaxed` does so from a start where points and images have moved. `moving_points`
 * moves points, too, from such a start. */
extern const iccp_schedule iccp_schedule_plain, iccp_schedule_relaxed, iccp_schedule_moving_points;

/* Returns the schedule that the options ask for, with defaults for members that are 0. `how` gives
 * moves_points and is_relaxed. The mesh gets at most `most` simplices. */
iccp_schedule iccp_schedule_of(const icc_improve_options *options, const iccp_schedule *how,
                               double most);

/* Returns the work that improvement may take. It is unlimited if the options set limits. */
iccp_work iccp_schedule_work(const icc_improve_options *options, size_t n_facets);

/* Returns the most simplices that a map of n_simplices may get. They are unlimited if the work
 * is. */
double iccp_schedule_most(const iccp_work *work, size_t n_simplices);

#endif
