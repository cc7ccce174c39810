#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A caller compiled against an older header has a shorter struct: fill a copy, then hand over as
 * much of it as the caller has room for. */
static void hand_over(icc_error *err, icc_error *full)
{
    size_t size = err->size;
    if (size > sizeof *full)
        size = sizeof *full;
    if (size <= sizeof err->size)
        return;
    full->size = err->size;
    memcpy(err, full, size);
    if (size > offsetof(icc_error, message))
        ((char *)err)[size - 1] = '\0';
}

static void describe(icc_error *err, icc_status status, int32_t item, int64_t index,
                     const char *format, va_list args)
{
    icc_error full = {.status = status, .index = index, .item = item};
    (void)vsnprintf(full.message, sizeof full.message, format, args);
    hand_over(err, &full);
}

icc_status iccp_fail(icc_error *err, icc_status status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (err != NULL)
        describe(err, status, ICC_ITEM_NONE, -1, format, args);
    va_end(args);
    return status;
}

icc_status iccp_fail_at(icc_error *err, icc_status status, int32_t item, int64_t index,
                        const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (err != NULL)
        describe(err, status, item, index, format, args);
    va_end(args);
    return status;
}

void iccp_error_copy(icc_error *err, const icc_error *own)
{
    icc_error full = *own;
    if (err != NULL)
        hand_over(err, &full);
}

icc_status iccp_fail_memory(icc_error *err)
{
    return iccp_fail(err, ICC_ERR_MEMORY, "out of memory");
}

icc_status iccp_explain(icc_error *err, icc_status status)
{
    if (status == ICC_ERR_MEMORY)
        return iccp_fail_memory(err);
    if (status == ICC_ERR_CANCELLED)
        return iccp_fail(err, status, "cancelled by the progress callback");
    return status;
}

icc_status iccp_fail_side(icc_error *err, icc_status status, int32_t side)
{
    if (err != NULL && err->size >= offsetof(icc_error, side) + sizeof err->side)
        err->side = side;
    return status;
}
