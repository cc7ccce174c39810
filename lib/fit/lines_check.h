/* Told lines must not meet one another or points, except at common vertices. */
#ifndef ICCP_LINES_CHECK_H
#define ICCP_LINES_CHECK_H

#include "fit/told.h"

/* Checks the lines and exact points of one side, 1 (source) or 2 (target), in local coordinates.
 * Returns ICC_ERR_CERTIFICATE if any of them meet, and ICC_ERR_ARGUMENT if a segment has no length.
 * The message names all items. Exact. O(n log n) for n segments of similar length. */
icc_status iccp_lines_check(const iccp_told *told, const double *points, int side,
                            const iccp_env *env, icc_error *err);

#endif
