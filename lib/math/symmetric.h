/* A sparse symmetric matrix as its diagonal and, row by row, all its off-diagonal entries: each of
 * them is there twice, once in either row. */
#ifndef ICCP_SYMMETRIC_H
#define ICCP_SYMMETRIC_H

#include <stddef.h>
#include <stdint.h>

typedef struct iccp_symmetric {
    size_t n;
    const size_t *first;    /* n + 1: where the rows begin in the two arrays below */
    const uint32_t *column; /* of each entry off the diagonal */
    const double *value;
    const double *diagonal; /* n */
} iccp_symmetric;

#endif
