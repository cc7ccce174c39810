/* Numbers as one of 64 bits that is the same wherever the numbers are: whatever the order of a
 * machine's bytes, the width of its size_t and the bits of its NaN. */
#ifndef TESTS_GOLDEN_DIGEST_H
#define TESTS_GOLDEN_DIGEST_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* FNV-1a: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, The FNV non-cryptographic hash algorithm,
 * IETF draft, 2012. */
typedef struct digest {
    uint64_t state;
} digest;

static inline digest digest_of_nothing(void)
{
    return (digest){0xcbf29ce484222325u};
}

static inline void digest_bytes(digest *d, size_t n, const void *bytes)
{
    const unsigned char *b = bytes;
    for (size_t i = 0; i < n; ++i)
        d->state = (d->state ^ b[i]) * 0x100000001b3u;
}

static inline void digest_u64(digest *d, uint64_t number)
{
    unsigned char bytes[8];
    for (int k = 0; k < 8; ++k)
        bytes[k] = (unsigned char)(number >> 8 * k);
    digest_bytes(d, sizeof bytes, bytes);
}

static inline void digest_size(digest *d, size_t n)
{
    digest_u64(d, n);
}

static inline void digest_i32(digest *d, size_t n, const int32_t *numbers)
{
    for (size_t i = 0; i < n; ++i)
        digest_u64(d, (uint64_t)(int64_t)numbers[i]);
}

static inline void digest_u32(digest *d, size_t n, const uint32_t *numbers)
{
    for (size_t i = 0; i < n; ++i)
        digest_u64(d, numbers[i]);
}

static inline void digest_f64(digest *d, size_t n, const double *numbers)
{
    for (size_t i = 0; i < n; ++i) {
        uint64_t bits = 0x7ff8000000000000u;
        if (numbers[i] == numbers[i])
            memcpy(&bits, &numbers[i], sizeof bits);
        digest_u64(d, bits);
    }
}

#endif
