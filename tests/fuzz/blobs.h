/* What fuzzers of saved objects share. */
#ifndef FUZZ_BLOBS_H
#define FUZZ_BLOBS_H

#include "base/blob.h"

#include <stdlib.h>

enum { HEADER = 32, LARGEST = 1 << 16 };

/* assert() is off in release builds. */
static inline void require(int holds)
{
    if (!holds)
        abort();
}

/* Makes the header of bytes fit their content; they stay of version 2 if they were, and else are of
 * version 1. */
static inline void put_right(uint8_t *bytes, size_t size, const char *kind)
{
    iccp_blob w;
    size_t n;
    iccp_blob_begin(&w, bytes, size, kind, bytes[8] == 2 ? 2 : 1);
    w.at = size;
    iccp_blob_end(&w, &n);
}

#endif
