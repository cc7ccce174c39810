/* Integral curves of a function through given points, without a chart. */
#ifndef ICCP_INTEGRAL_CURVES_H
#define ICCP_INTEGRAL_CURVES_H

#include "gradient/function/function.h"

struct icc_curves {
    iccp_memory memory;
    int32_t dim, way;
    size_t n;         /* curves */
    size_t *first;    /* n + 1: where each curve begins among the vertices */
    double *vertices; /* dim coordinates of the caller's for each vertex */
    int32_t *end;     /* ICC_END_* */
    double *length;   /* in the caller's coordinates */
    double *alone;    /* arc length until other curves joined */
    uint32_t *facet;  /* ICCP_NONE where the curve does not end on the boundary */
    double *bary;     /* dim numbers for each curve */
};

/* See icc_curves_create(). The points are finite. */
icc_status iccp_curves_create(icc_curves **out, const icc_function *function, size_t n,
                              const double *points, int32_t way, const iccp_env *env);
void iccp_curves_release(icc_curves *curves);

#endif
