/* Reads and writes size-first structs. */
#include "base/options.h"

#include "base/error.h"

#include <string.h>

static icc_status check_size(size_t size, const char *name, icc_error *err)
{
    if (size < sizeof(size_t) || size > 1u << 16)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%s.size is not set (it is %zu)", name, size);
    return ICC_OK;
}

icc_status iccp_read_struct(void *full, size_t full_size, const void *given, const char *name,
                            icc_error *err)
{
    memset(full, 0, full_size);
    if (given == NULL)
        return ICC_OK;
    size_t size;
    memcpy(&size, given, sizeof size);
    icc_status status = check_size(size, name, err);
    if (status != ICC_OK)
        return status;
    const unsigned char *bytes = given;
    for (size_t i = full_size; i < size; ++i)
        if (bytes[i] != 0)
            return iccp_fail(err, ICC_ERR_VERSION,
                             "%s has a member that this version of the library does not know",
                             name);
    memcpy(full, given, size < full_size ? size : full_size);
    return ICC_OK;
}

icc_status iccp_write_struct(void *given, const void *full, size_t full_size, const char *name,
                             icc_error *err)
{
    size_t size;
    memcpy(&size, given, sizeof size);
    icc_status status = check_size(size, name, err);
    if (status != ICC_OK)
        return status;
    unsigned char *bytes = given;
    const size_t known = size < full_size ? size : full_size;
    memcpy(bytes + sizeof size, (const unsigned char *)full + sizeof size, known - sizeof size);
    memset(bytes + known, 0, size - known);
    return ICC_OK;
}
