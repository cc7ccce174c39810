/* The elastic model: a triangle mesh that keeps its shape as well as it can while some of its
 * vertices go where they are told.
 *
 * Words of this folder. Begin with this file.
 * - held: a vertex with a target. Sliding: a vertex that stays on a line. Loose: any other one.
 * - group: held vertices that are connected by edges and move, such as a wall (paths.h).
 * - spring: pulls a held vertex to its place. One Newton step on stiff springs is Euler's
 *   predictor: everything comes along.
 * - settled: held, and exactly at its place. Then it no longer moves.
 * - range: the distance below which parts of the outline push each other away (contact.h).
 *
 * The energy is the sum of w |J|^2 (1 + 1/det^2) over the triangles, with the bending energy times
 * the squared reach (reach.h) and the barriers of contact.
 * It is lowered by Newton's method (elastic_step.h). Held vertices go along a path, in parts as
 * long as nothing flips (elastic_solve.c).
 *
 * Invariants: after each step every triangle is exactly positive. With contact the outlines are
 * exactly simple, too. Results do not depend on the number of threads.
 *
 * All coordinates are local: the largest is about 1. */
#ifndef ICCP_ELASTIC_MODEL_H
#define ICCP_ELASTIC_MODEL_H

#include "base/env.h"

#include <stdbool.h>
#include <stdint.h>

/* How free a vertex is. */
enum { ICCP_LOOSE = 0, ICCP_HELD = 1, ICCP_SLIDING = 2 };

/* All arrays are copied. */
typedef struct iccp_elastic_input {
    size_t n_points, n_triangles;
    const double *points;    /* 2 n_points */
    const uint32_t *corners; /* 3 n_triangles, exactly positive; the outlines are simple */
    /* The last ones of these are no part of the mesh. They only count in the energy, and stay
     * positive: the other halves of quadrilaterals */
    size_t n_more;
    const uint8_t *hold;     /* n_points: ICCP_LOOSE, ICCP_HELD or ICCP_SLIDING */
    const double *direction; /* 2 n_points: of sliding vertices, of any length; NULL: none slides */
    double stiffness;        /* triangles are stiffer by their area to the power of minus this */
    const double *cell_factor; /* a further factor for each triangle, or NULL */
    double
        reach; /* a length: how far a vertex carries its surroundings along; 0: as the mesh does */
    bool contact; /* free parts of the outlines push each other away */
} iccp_elastic_input;

/* A mesh that is prepared for any number of targets. It never changes, so several threads may share
 * it. */
typedef struct iccp_elastic iccp_elastic;

/* Returns ICC_ERR_BOUNDARY if boundary edges do not form rings. */
icc_status iccp_elastic_create(iccp_elastic **out, const iccp_elastic_input *input,
                               const iccp_env *env);
void iccp_elastic_free(iccp_elastic *elastic);

typedef struct iccp_elastic_report {
    size_t n_off;        /* vertices that are not at their targets or on their lines */
    double most_off;     /* the largest distance of one from there */
    size_t n_iterations; /* Newton steps */
    double energy;       /* mean of |J|^2 (1 + 1/det^2) with the weights; 4: nothing is distorted */
} iccp_elastic_report;

/* Moves held vertices to their targets, and sliding ones onto their lines through their targets.
 * targets: 2 n_points; those of loose vertices are not read. images: 2 n_points, at first a start
 * with positive triangles, and simple outlines if there is contact. The points themselves are one.
 * At the end held vertices have their targets exactly, unless they are off: then the way was
 * blocked, because the shape would have folded or overlapped.
 *
 * Returns ICC_ERR_CERTIFICATE if the outlines of the result are not simple, which can happen only
 * without contact. On failure `images` are as they were. */
icc_status iccp_elastic_solve(const iccp_elastic *elastic, const double *targets, double *images,
                              iccp_elastic_report *report, const iccp_env *env, icc_error *err);

/* Like iccp_elastic_solve(), for one frame of a drag. Less is tried for vertices that are off, so
 * that every frame is quick. `off` has n_points marks, 0 before the first frame. They tell which
 * vertices were off in the frame before, and become those that are off now. */
icc_status iccp_elastic_drag(const iccp_elastic *elastic, const double *targets, double *images,
                             uint8_t *off, iccp_elastic_report *report, const iccp_env *env,
                             icc_error *err);

#endif
