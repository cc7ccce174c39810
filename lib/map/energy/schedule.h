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

/* Work that is left and spent. */
typedef struct iccp_allowance {
    iccp_work search;  /* trying trees of cuts, or moving the fixed vertices to another target */
    iccp_work overlay; /* making an overlay and relaxing it */
    iccp_work improvement; /* of what is one-to-one */
    double relaxing;       /* the overlay's share for steps */
    double all;            /* the most that the parts may take together */
} iccp_allowance;

/* For a map between domains of n_facets that is made without limits of the caller's. */
iccp_allowance iccp_allow(size_t n_facets);

double iccp_spent(const iccp_allowance *work);

/* Before a part begins: no more than is left of all. */
iccp_work *iccp_bound(iccp_work *part, const iccp_allowance *work);

/* How: the rest of a schedule is up to options. */
extern const iccp_schedule iccp_schedule_plain, iccp_schedule_relaxed, iccp_schedule_both_sides;

/* With what is 0 in the options filled in; `how` gives the rest. At most `most` simplices. */
iccp_schedule iccp_schedule_of(const icc_improve_options *options, const iccp_schedule *how,
                               double most);

/* The work that improvement may take, which is limited where the caller has set no limit. */
iccp_work iccp_schedule_work(const icc_improve_options *options, size_t n_facets);

/* The most simplices of a map that has so many. */
double iccp_schedule_most(const iccp_work *work, size_t n_simplices);

#endif
