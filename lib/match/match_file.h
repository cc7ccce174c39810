/* Matches as bytes: kind MTCH of docs/reference/formats.md. */
#ifndef ICCP_MATCH_FILE_H
#define ICCP_MATCH_FILE_H

#include "match/match.h"

/* See icc_match_save() and icc_match_load(). */
void iccp_match_save(const icc_match *match, size_t capacity, void *data, size_t *n_bytes);
icc_status iccp_match_load(icc_match **out, size_t n_bytes, const void *data, const iccp_env *env,
                           icc_error *err);

#endif
