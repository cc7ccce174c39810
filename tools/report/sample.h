/* Points spread evenly over a domain. */
#ifndef SAMPLE_H
#define SAMPLE_H

#include <icc/icc.h>

/* Fills in up to n points strictly inside; returns how many there are (fewer only if the shape
 * fills hardly any of its bounding box), or 0 if the call failed. Always the same points. */
size_t sample_inside(const icc_domain *domain, size_t n, double *points, const icc_env *env);

#endif
