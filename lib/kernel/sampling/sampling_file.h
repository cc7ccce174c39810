/* Samplings as bytes; see docs/reference/formats.md. */
#ifndef ICCP_SAMPLING_FILE_H
#define ICCP_SAMPLING_FILE_H

#include "kernel/sampling/sampling.h"

/* See icc_sampling_save() and icc_sampling_load(). */
void iccp_sampling_save(const icc_sampling *sampling, size_t capacity, void *data, size_t *n_bytes);
icc_status iccp_sampling_load(icc_sampling **out, size_t n_bytes, const void *data,
                              const iccp_env *env, icc_error *err);

#endif
