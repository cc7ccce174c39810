/* The natural spline of a frame: of all maps of a box that take control points to their targets,
 * the one that bends the least inside the box.
 *
 * Words of this folder. Begin with this file.
 * - frame: the box that the map covers: all points, and a margin around them.
 * - trend: the affine map that fits the targets best (distinct_points.h). What it leaves bends.
 * - told: vertices whose values are given, exactly or with a weight (spline_system.h).
 * - left out: how far a target is from where the other points would take its point.
 * - share, smoothing: a point's weight is its share, divided by the smoothing.
 * - wall: an edge that the mesh must have, a part of a told line (told_lines.h).
 *
 * Ways: distinct_points.h merges points, frame_choice.h chooses margin and smoothing, frame_mesh.h
 * makes the mesh, bending.h the matrix, spline_system.h solves and leaves out, jump_refinement.h
 * refines the result.
 *
 * Invariants: a map of affine truths is affine to rounding. Results do not depend on the number of
 * threads. Nothing here keeps triangles positive: map/nearest/ does that. */
#ifndef ICCP_SPLINE_H
#define ICCP_SPLINE_H

#include "fit/spline/distinct_points.h"
#include "fit/spline/spline_system.h"
#include "fit/spline/told_lines.h"
#include "map/compatible/plmap.h"

#include <stdatomic.h>

/* What splines of the same points share, whatever the targets: the frame, its mesh and the
 * factorised system. It does not change after it is made. */
typedef struct iccp_spline_base {
    iccp_memory memory;
    atomic_size_t references;
    double margin; /* as used */
    /* As used; 0: all points are exact. The spline minimises s E + sum_i (t / t_i)^2 |off_i|^2 with
     * the smoothing s. E is the integral of the squared second derivatives, in a metric in which
     * lengths are those of the affine fit and the box's longest side is about 1. t_i are the
     * tolerances, and 1 / t^2 is the mean of 1 / t_i^2 */
    double smoothing;
    double metric[4];     /* see iccp_bending_mesh: that of the targets for which it was made */
    iccp_box_mesh solved; /* the mesh of the system. Its vertices are the map's first */
    iccp_told_lines lines;
    iccp_spline_system system; /* without told vertices if nothing can bend */
} iccp_spline_base;

/* Returns `base`. */
iccp_spline_base *iccp_spline_base_retain(iccp_spline_base *base);

/* Accepts NULL. */
void iccp_spline_base_release(iccp_spline_base *base);

/* What to fit. All coordinates are local: the largest is about 1. */
typedef struct iccp_spline_task {
    size_t n;                       /* at least 1 */
    const double *points, *targets; /* 2 n each */
    const double *tolerances;       /* n: how far a point may be off; 0: exact. NULL: all exact */
    size_t n_segments;
    const uint32_t *segments;    /* 2 n_segments points: they go along linearly. Their ends are
                                       exact */
    const double *lower, *upper; /* the box to cover at least; NULL: the points' bounding box */
    double margin;    /* how far the frame reaches, in longest sides of the box; 0: chosen */
    double smoothing; /* as in icc_fit_options; see iccp_spline_base::smoothing */
    /* of a spline of the same points, segments, tolerances and box: then nothing is chosen or
     * factorised anew. NULL: none */
    iccp_spline_base *base;
} iccp_spline_task;

typedef struct iccp_spline {
    iccp_memory memory;
    size_t n; /* points as given */
    /* The different points, and then the vertices inside segments. They are the map's first
     * vertices, so point i is vertex control.number[i] */
    iccp_distinct_points control;
    size_t n_given; /* the different points alone */
    /* Images are local in the target. They may fold.
     * Exact points are ICCP_ON_POINT and the boundary is ICCP_ALONG. Facets and places along them
     * are 0: the caller sets them. */
    iccp_plmap map;
    double *left_out; /* 2 n: where the other points would take each point, minus its target. NaN
                          if they do not determine it, or if the point is on a segment */
    double left_out_residual, affine_residual; /* root mean square; NaN if not known */
    iccp_trend trend;                          /* the affine fit */
    iccp_spline_base *base;                    /* one reference of it is the spline's */
    double *told;                              /* 2 control.n: targets less the affine fit */
    double *left_out_own;                      /* 2 control.n: working memory */
} iccp_spline;

/* Makes the spline, chooses margin and smoothing where they are not given, and leaves out each
 * point. With fewer than three different points the map is a similarity.
 *
 * Returns ICC_ERR_ARGUMENT if points coincide with different targets, if the targets mirror the
 * points, or if the targets lie on one line. Returns ICC_ERR_BOUNDARY or ICC_ERR_OUTSIDE if
 * segments meet one another, or points except at their ends. Other failures: ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED. On failure nothing stays allocated. Deterministic. O(n^1.3). */
icc_status iccp_spline_create(iccp_spline *spline, const iccp_spline_task *task,
                              const iccp_env *env, icc_error *err);
void iccp_spline_free(iccp_spline *spline);

#endif
