/* The caller's constraints in one list of items. */
#ifndef ICCP_TOLD_H
#define ICCP_TOLD_H

#include "base/env.h"
#include "icc/fit.h"

#include <stdint.h>

/* An item is a point of a constraint or a vertex of one. Coordinates are the caller's. */
typedef struct iccp_told {
    iccp_memory memory;
    size_t n;
    int32_t *kind;     /* ICC_CONSTRAINT_* */
    uint8_t *joined;   /* 1: a line leads here from the item before */
    uint32_t *vertex;  /* of vertices and sliding: its number; UINT32_MAX: of points, until the mesh
                          is known */
    double *source;    /* 2 n: of points and lines */
    double *target;    /* 2 n: NaN for sliding vertices whose line goes through the vertex */
    double *direction; /* 2 n: of sliding vertices; NaN: that of the boundary */
    double *tolerance; /* n: 0: exact */
} iccp_told;

/* Copies the constraints, which have been checked except for their numbers. Returns
 * ICC_ERR_ARGUMENT if a number is not finite, a tolerance is negative or a direction is 0. On
 * failure nothing stays allocated. */
icc_status iccp_told_create(iccp_told *told, size_t n, const icc_constraint *constraints,
                            const iccp_env *env, icc_error *err);

/* Copies what is told, with other targets; those of vertices that slide along the boundary through
 * their own place are not read. */
icc_status iccp_told_aim(iccp_told *told, const iccp_told *other, const double *targets,
                         const iccp_env *env, icc_error *err);
void iccp_told_free(iccp_told *told);

#endif
