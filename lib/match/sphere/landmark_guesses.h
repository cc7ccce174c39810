/* Guesses pairs of corresponding vertices of two surfaces that have few landmarks. */
#ifndef ICCP_LANDMARK_GUESSES_H
#define ICCP_LANDMARK_GUESSES_H

#include "match/surface/half_edges.h"

/* vertices[side][k] are given for the landmarks k < n, all different on each side. The guesses n <=
 * k < n_all are found, all different again. On the first surface they are vertices far from one
 * another. Then the drawing is turned so that landmarks come near their partners. The partner of a
 * guess is the nearest vertex in the other drawing. Each surface has at least n_all vertices.
 * ICC_ERR_RESOLUTION and the other errors of iccp_sphere_draw(). */
icc_status iccp_landmark_guesses_find(uint32_t *const vertices[2], size_t n, size_t n_all,
                                      const iccp_half_edges *const m[2], const double *const x[2],
                                      const iccp_env *env, icc_error *err);

#endif
