/* Points whose coordinates are dyadic combinations of doubles, and their exact orientation. */
#ifndef ICCP_FIXED_H
#define ICCP_FIXED_H

#include <stdint.h>

/* Coordinates are multiples of 2^-300 below 2^18, as two's complement with the lowest limb
 * first. */
enum { ICCP_FIXED_LIMBS = 10, ICCP_FIXED_SHARE_BITS = 48 };

typedef struct iccp_fixed {
    uint32_t limb[3][ICCP_FIXED_LIMBS];
} iccp_fixed;

/* p += share x. The coordinates of x are 0 or have magnitudes in [2^-200, 2^10]. The share is a
 * multiple of 2^-48 in [0, 1]. */
void iccp_fixed_add(iccp_fixed *p, const double *x, double share);

/* Like iccp_orient3d(), for points whose differences are below 2^18. */
int iccp_fixed_orient3d(const iccp_fixed *a, const iccp_fixed *b, const iccp_fixed *c,
                        const iccp_fixed *d);

#endif
