/* Size-first structs: read what the caller has, refuse what this library does not know. */
#ifndef ICCP_OPTIONS_H
#define ICCP_OPTIONS_H

#include "icc/base.h"

/* Copies the caller's struct (NULL: all zero) into `full`, of `full_size` bytes. A shorter struct
 * comes from an older header: what it lacks is zero. A longer one from a newer header: what lies
 * beyond must be zero, else ICC_ERR_VERSION. `name` goes into the message. */
icc_status iccp_read_struct(void *full, size_t full_size, const void *given, const char *name,
                            icc_error *err);

/* The other direction, for structs that the library fills: as much as the caller has room for;
 * room beyond is zeroed. `full` starts with its size_t size, which is left as the caller set it. */
icc_status iccp_write_struct(void *given, const void *full, size_t full_size, const char *name,
                             icc_error *err);

#endif
