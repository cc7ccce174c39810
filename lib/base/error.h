/* Filling the caller's icc_error. */
#ifndef ICCP_ERROR_H
#define ICCP_ERROR_H

#include "base/compiler.h"
#include "icc/base.h"

/* Describes a failure in the caller's struct (which may be NULL) and returns `status`, so that a
 * function can end with it. */
icc_status iccp_fail(icc_error *err, icc_status status, const char *format, ...) ICCP_PRINTF(3, 4);

/* The same where one item (`ICC_ITEM_*`) is at fault. */
icc_status iccp_fail_at(icc_error *err, icc_status status, int32_t item, int64_t index,
                        const char *format, ...) ICCP_PRINTF(5, 6);

/* Hands what one of the library's own structs says over to the caller's, which may be NULL. */
void iccp_error_copy(icc_error *err, const icc_error *own);

/* ICC_ERR_MEMORY with the usual text. */
icc_status iccp_fail_memory(icc_error *err);

/* Describes a failure that is returned from deep inside without a text: out of memory, cancelled.
 * Returns `status`, whatever it is. */
icc_status iccp_explain(icc_error *err, icc_status status);

/* Marks whose fault it is: 1 the source, 2 the target, 0 neither. Puts the side's name in front of
 * the message, so the message need not repeat it. The first caller that names a side decides.
 * Failures that iccp_explain() describes are no side's fault. Returns `status`. */
icc_status iccp_fail_side(icc_error *err, icc_status status, int32_t side);

#endif
