/* From the start of a mesh map to a fair and certified one, within what it may cost. */
#ifndef ICCP_FIT_H
#define ICCP_FIT_H

#include "map/energy/work.h"
#include "map/plane/mesh_map.h"

/* Work that is left and spent. */
typedef struct iccp_allowance {
    iccp_work search;      /* trying trees of cuts, or carrying the images to another target */
    iccp_work overlay;     /* making an overlay and relaxing it */
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
extern const iccp_schedule iccp_fit_plain, iccp_fit_relaxed, iccp_fit_both_sides;

/* With what is 0 in the options filled in; `how` gives the rest. At most `most` simplices. */
iccp_schedule iccp_fit_schedule(const icc_improve_options *options, const iccp_schedule *how,
                                double most);

/* The work that improvement may take, which is limited where the caller has set no limit. */
iccp_work iccp_fit_work(const icc_improve_options *options, size_t n_facets);

/* The most simplices of a map that has so many. */
double iccp_fit_most(const iccp_work *work, size_t n_simplices);

/* Improves as far as asked; when cancelled, says so in `cancelled` and keeps what there is. */
icc_status iccp_fit_improve(iccp_plmap *pl, const icc_improve_options *options,
                            const iccp_schedule *how, iccp_work *work, bool *cancelled,
                            iccp_improvement *improvement, const iccp_env *env);

/* Improves and certifies what is in map->pl, which is one-to-one. */
icc_status iccp_fit_complete(iccp_mesh_map *map, const icc_improve_options *options,
                             const iccp_schedule *how, iccp_work *work, icc_map_info *info,
                             const iccp_env *env);

/* Passes the plan on to a map whose mesh has not changed. */
void iccp_fit_keep_plan(iccp_mesh_map *map, iccp_newton_plan *plan);

#endif
