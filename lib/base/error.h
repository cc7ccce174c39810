/* Fills in the caller's icc_error. */
#ifndef ICCP_ERROR_H
#define ICCP_ERROR_H

#include "base/compiler.h"
#include "icc/base.h"

/* Describes a failure in the caller's struct, which may be NULL. Returns `status`, so that a
 * function can end with it. */
icc_status iccp_fail(icc_error *err, icc_status status, const char *format, ...) ICCP_PRINTF(3, 4);

/* Like iccp_fail(), for a failure at one item (`ICC_ITEM_*`). */
icc_status iccp_fail_at(icc_error *err, icc_status status, int32_t item, int64_t index,
                        const char *format, ...) ICCP_PRINTF(5, 6);

/* Copies the library's own struct to the caller's, which may be NULL. */
void iccp_error_copy(icc_error *err, const icc_error *own);

/* Returns ICC_ERR_MEMORY with the usual message. */
icc_status iccp_fail_memory(icc_error *err);

/* Adds a message to a failure from deep inside that has none: out of memory or cancelled. Returns
 * `status`, whatever it is. */
icc_status iccp_explain(icc_error *err, icc_status status);

/* Marks the side at fault: 1 the source, 2 the target, 0 neither. Puts the side's name in front of
 * the message, so the message need not repeat it. The first call that names a side decides.
 * Failures that iccp_explain() describes belong to no side. Returns `status`. */
icc_status iccp_fail_side(icc_error *err, icc_status status, int32_t side);

#endif
