/* Pairs of vertices of two surfaces, beside few landmarks. */
#ifndef ICCP_LANDMARK_GUESSES_H
#define ICCP_LANDMARK_GUESSES_H

#include "match/surface/half_edges.h"

/* vertices[side][k] of landmarks k < n are given, all different on either side; those of helpers, n
 * <= k < n_all, are found, different from these and one another: vertices of the first surface that
 * are far from one another, and of the second where they would go without landmarks if the drawing
 * on the sphere is turned so that landmarks come near their partners. Every surface has n_all
 * vertices at least. ICC_ERR_RESOLUTION and others of iccp_sphere_draw(). */
icc_status iccp_landmark_guesses_find(uint32_t *const vertices[2], size_t n, size_t n_all,
                                      const iccp_half_edges *const m[2], const double *const x[2],
                                      const iccp_env *env, icc_error *err);

#endif
