/* Reads and writes the values of a sampled field.
 *
 * Words of this folder. Begin with this file.
 * - field: values on a regular grid, read multilinearly between the samples (icc_field).
 * - sample: one of these places with its value. step: the way from a sample to the next one.
 * - cell: what lies between neighbouring samples. Its corners are named by bits, one per axis.
 * - edge: the difference of the images of two neighbouring samples.
 * - term: a double. An edge is a sum of at most three terms in each component, exactly.
 * - box: the whole grid. Its boundary are the samples with a first or last index (box.h).
 *
 * Ways: sampled_certify.h judges all cells of a field, cell_sign.h one of them by the bounds of
 * cell.h and the exact numbers of cell_exact.h. map_sample.h fills in a field from a map.
 *
 * Invariants: the origin of the grid cancels in all edges, so no proof depends on its rounding. In
 * 2-D a third edge (0, 0, 1) makes all determinants those of 3-D. */
#ifndef ICCP_SAMPLES_H
#define ICCP_SAMPLES_H

#include "icc/icc.h"

#include <string.h>

/* Index of the sample at i. */
static inline size_t iccp_sample_at(const icc_field *field, const size_t *i)
{
    size_t at = 0;
    for (size_t k = (size_t)field->dim; k-- > 0;)
        at = at * field->shape[k] + i[k];
    return at;
}

/* Splits an index into one along each axis, where axis k has shape[k] - less of them. */
static inline void iccp_sample_split(const icc_field *field, size_t at, size_t less, size_t *i)
{
    for (size_t k = 0; k < (size_t)field->dim; ++k) {
        i[k] = at % (field->shape[k] - less);
        at /= field->shape[k] - less;
    }
}

static inline size_t iccp_sample_count(const icc_field *field, size_t less)
{
    size_t n = 1;
    for (size_t k = 0; k < (size_t)field->dim; ++k)
        n *= field->shape[k] - less;
    return n;
}

static inline void iccp_sample_read(const icc_field *field, size_t at, double *value)
{
    const size_t dim = (size_t)field->dim, bytes = (size_t)field->bytes;
    const char *from = (const char *)field->values + dim * bytes * at;
    for (size_t k = 0; k < dim; ++k, from += bytes)
        if (bytes == sizeof(float)) {
            float narrow;
            memcpy(&narrow, from, sizeof narrow);
            value[k] = (double)narrow;
        } else {
            memcpy(value + k, from, sizeof *value);
        }
}

static inline void iccp_sample_write(const icc_field *field, size_t at, const double *value)
{
    const size_t dim = (size_t)field->dim, bytes = (size_t)field->bytes;
    char *to = (char *)field->values + dim * bytes * at;
    for (size_t k = 0; k < dim; ++k, to += bytes)
        if (bytes == sizeof(float)) {
            const float narrow = (float)value[k];
            memcpy(to, &narrow, sizeof narrow);
        } else {
            memcpy(to, value + k, sizeof *value);
        }
}

#endif
