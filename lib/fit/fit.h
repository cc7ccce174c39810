/* The object icc_fit: a map that is made from what is told of it.
 *
 * Words of this folder
 * - told: what the caller's constraints say. item: a point or vertex of a constraint (told.h).
 * - model: what carries the rest along. spline/ bends the least, elastic/ distorts the least.
 * - aim: to give told items other targets.
 * - repair: to make a folded model one-to-one (map/nearest).
 * - shape: a mesh that an elastic fit moves (elastic_fit.h).
 *
 * Ways
 * - Control points alone: spline_fit.c. The spline of a frame around them, repaired if it folds.
 * - A figure or a mesh: elastic_fit.c. It never folds, so there is nothing to repair.
 * - Both end with a mesh and images in the caller's coordinates, of which map/given_mesh.h makes
 *   and certifies an ordinary map.
 *
 * Invariants
 * - A fit does not change. Elastic fits that were made by moving one another share their shape, and
 *   splines their factorised system.
 * - Exact items that are not reported as off have their targets bit for bit.
 *
 * Begin with fit.c. */
#ifndef ICCP_FIT_H
#define ICCP_FIT_H

#include "domain/domain.h"
#include "fit/told.h"
#include "map/map.h"

struct iccp_elastic_shape;
struct iccp_spline_base;

struct icc_fit {
    iccp_memory memory;
    icc_map *map;
    iccp_told told;
    icc_fit_info info;
    icc_fit_options options; /* values only: its pointers are not used after the fit is made */
    double box[4];           /* of the spline; options.box points here, or is NULL */
    double *residuals;       /* 2 told.n */
    double *left_out;        /* 2 told.n */
    struct iccp_spline_base *base;    /* of a spline: what it shares with moved ones */
    struct iccp_elastic_shape *shape; /* of an elastic fit */
    double *images;                   /* of an elastic fit: local, where a moved one begins */
    uint8_t *off;  /* of an elastic fit: of each vertex, 1 if the last move of a drag left it off */
    bool is_moved; /* made by icc_fit_move() */
};

/* See icc_fit_create(). The caller has checked the structs, but no coordinate, vertex or cell. */
icc_status iccp_fit_create(icc_fit **out, const icc_domain *domain, const icc_mesh *mesh, size_t n,
                           const icc_constraint *constraints, const icc_fit_options *options,
                           const iccp_env *env, icc_error *err);

/* See icc_fit_move(). */
icc_status iccp_fit_move(icc_fit **out, const icc_fit *fit, const double *targets,
                         const iccp_env *env, icc_error *err);

/* Accepts NULL. */
void iccp_fit_release(icc_fit *fit);

#endif
