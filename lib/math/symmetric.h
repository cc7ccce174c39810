/* A sparse symmetric matrix: its diagonal and, row by row, all off-diagonal entries. Each of these
 * is stored twice, once in either row. */
#ifndef ICCP_SYMMETRIC_H
#define ICCP_SYMMETRIC_H

#include <stddef.h>
#include <stdint.h>

typedef struct iccp_symmetric {
    size_t n;
    const size_t *first;    /* n + 1: where the rows begin in the next two arrays */
    const uint32_t *column; /* of each entry off the diagonal */
    const double *value;
    const double *diagonal; /* n */
} iccp_symmetric;

#endif
