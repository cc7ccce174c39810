/* Points spread evenly over a domain. */
#ifndef SAMPLE_H
#define SAMPLE_H

#include <icc/icc.h>

/* Fills in up to n points strictly inside. Returns their number, or 0 if the call failed. It is
 * below n only if the shape fills hardly any of its bounding box. The points are always the
 * same. */
size_t sample_inside(const icc_domain *domain, size_t n, double *points, const icc_env *env);

#endif
