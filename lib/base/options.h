/* Size-first structs: reads as much as the caller has, and refuses what this library does not
 * know. */
#ifndef ICCP_OPTIONS_H
#define ICCP_OPTIONS_H

#include "icc/base.h"

/* Copies the caller's struct (NULL: all zero) into `full`, of `full_size` bytes. A shorter struct
 * comes from an older header, so its missing members become zero. A longer one comes from a newer
 * header: the extra bytes must be zero, else the result is ICC_ERR_VERSION. `name` goes into the
 * message. */
icc_status iccp_read_struct(void *full, size_t full_size, const void *given, const char *name,
                            icc_error *err);

/* Copies `full` into the caller's struct, as far as it has room, and zeroes any room beyond. `full`
 * begins with a size_t size, which keeps the value that the caller set. */
icc_status iccp_write_struct(void *given, const void *full, size_t full_size, const char *name,
                             icc_error *err);

#endif
