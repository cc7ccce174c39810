/* How triangles are stretched from one surface to another. */
#ifndef TESTS_FACE_STRETCH_H
#define TESTS_FACE_STRETCH_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

typedef struct face_stretch {
    double energy, area[2]; /* on either surface */
} face_stretch;

/* For qsort(): by energy. */
static inline int face_stretch_ascending(const void *a, const void *b)
{
    const double x = ((const face_stretch *)a)->energy, y = ((const face_stretch *)b)->energy;
    return (x > y) - (x < y);
}

/* The products of two sides of a face. */
static inline void face_sides(double product[3], const double *x, const uint32_t *v)
{
    product[0] = product[1] = product[2] = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double o = x[3 * v[0] + k], a = x[3 * v[1] + k] - o, b = x[3 * v[2] + k] - o;
        product[0] += a * a;
        product[1] += a * b;
        product[2] += b * b;
    }
}

static inline double face_area(const double product[3])
{
    return 0.5 * sqrt(fmax(product[0] * product[2] - product[1] * product[1], 0));
}

#endif
