/* Fills in the caller's icc_error. */
#include "base/error.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* Returns how many bytes of the caller's struct may be written. A size of 0 stands for the members
 * of version 0.1, which every caller has. */
static size_t room_of(const icc_error *err)
{
    const size_t first = offsetof(icc_error, message) + sizeof err->message;
    const size_t size = err->size == 0 ? first : err->size;
    return size < sizeof *err ? size : sizeof *err;
}

/* Copies as much of `full` as the caller has room for, because a caller compiled with an older
 * header has a shorter struct. */
static void hand_over(icc_error *err, icc_error *full)
{
    const size_t size = room_of(err);
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

/* Puts the side's name in front of the message. If there is no room, the end of the message is cut
 * off. */
static void name_side(icc_error *err, int32_t side)
{
    enum { N_NAME = 8 };
    const size_t begin = offsetof(icc_error, message);
    const size_t room = room_of(err) > begin ? room_of(err) - begin : 0;
    if (room <= N_NAME)
        return;
    memmove(err->message + N_NAME, err->message, room - N_NAME);
    memcpy(err->message, side == 1 ? "source: " : "target: ", N_NAME);
    err->message[room - 1] = '\0';
}

icc_status iccp_fail_side(icc_error *err, icc_status status, int32_t side)
{
    const bool is_told =
        status != ICC_OK && status != ICC_ERR_MEMORY && status != ICC_ERR_CANCELLED;
    if (err == NULL || side == 0 || !is_told ||
        room_of(err) < offsetof(icc_error, side) + sizeof err->side || err->side != 0)
        return status;
    err->side = side;
    name_side(err, side);
    return status;
}
