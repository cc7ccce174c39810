/* Sets how far maps are improved: from the caller's options, or by limits of work. */
#include "map/energy/schedule.h"

#include "base/minmax.h"

/* Defaults of icc_improve_options. */
static const double TOLERANCE = 1e-4;
enum { ITERATIONS = 60, LEVELS = 16 };

/* If the caller sets no limits, refinements stop at MOST_GROWTH times the triangles of the start,
 * which counts as having at least SMALL. */
static const double MOST_GROWTH = 4, SMALL = 8000;

/* If the caller sets no limits: the work of improvement, in steps times triangles, and the part of
 * it that is added for each facet. Relaxing an overlay may take the share RELAXING_SHARE of it. */
static const double WORK = 3e5, WORK_PER_FACET = 300, RELAXING_SHARE = 0.5;

/* The work that all parts may take together, including making an overlay, and its part for each
 * facet. It is low enough for the time that icc_map_create() names. */
static const double ALL_WORK = 1.6e6, ALL_PER_FACET = 225;

iccp_allowance iccp_allow(size_t n_facets)
{
    const double work = WORK + WORK_PER_FACET * (double)n_facets;
    const double all = ALL_WORK + ALL_PER_FACET * (double)n_facets;
    return (iccp_allowance){.search.left = work,
                            .vain.left = all,
                            .overlay.left = HUGE_VAL,
                            .improvement.left = work,
                            .relaxing = RELAXING_SHARE * work,
                            .all = all};
}

double iccp_spent(const iccp_allowance *work)
{
    return work->search.spent + work->overlay.spent + work->improvement.spent;
}

iccp_work *iccp_bound(iccp_work *part, const iccp_allowance *work)
{
    part->left = iccp_min(part->left, iccp_max(0, work->all - iccp_spent(work)));
    return part;
}

const iccp_schedule iccp_schedule_plain = {0}, iccp_schedule_relaxed = {.is_relaxed = true},
                    iccp_schedule_moving_points = {.moves_points = true, .is_relaxed = true};

iccp_schedule iccp_schedule_of(const icc_improve_options *options, const iccp_schedule *how,
                               double most)
{
    return (iccp_schedule){.iterations =
                               options->iterations > 0 ? (size_t)options->iterations : ITERATIONS,
                           .tolerance = options->tolerance > 0 ? options->tolerance : TOLERANCE,
                           .levels = options->levels < 0    ? 0
                                     : options->levels == 0 ? LEVELS
                                                            : (size_t)options->levels,
                           .most = most,
                           .moves_points = how->moves_points,
                           .is_relaxed = how->is_relaxed};
}

iccp_work iccp_schedule_work(const icc_improve_options *options, size_t n_facets)
{
    const bool is_free = options->iterations > 0 || options->levels != 0 || options->tolerance > 0;
    return is_free ? iccp_work_unlimited() : iccp_allow(n_facets).improvement;
}

double iccp_schedule_most(const iccp_work *work, size_t n_simplices)
{
    return work->left < HUGE_VAL ? MOST_GROWTH * iccp_max(SMALL, (double)n_simplices) : HUGE_VAL;
}
