/* Coordinates from single bytes, of which fuzzers make polygons. Small integers make degenerate ones
 * likely, a nudge by one unit in the last place nearly degenerate ones. */
#ifndef FUZZ_COORDINATES_H
#define FUZZ_COORDINATES_H

#include <math.h>
#include <stdint.h>

static inline double small_integer(uint8_t byte)
{
    return (double)((int)(byte & 15) - 8);
}

static inline double nearly_integer(uint8_t byte)
{
    const double x = small_integer(byte) / 3;
    return byte & 64 ? nextafter(x, byte & 128 ? 10 : -10) : x;
}

/* Bit 1 of the mode chooses between them, bits 2 to 5 size and place. */
static inline double coordinate(int mode, uint8_t byte)
{
    static const double scales[4] = {1, 1e300, 1e-310, 0x1p-40};
    static const double offsets[4] = {0, 1e9, -0x1p50, 12345.678};
    const double x = mode & 2 ? nearly_integer(byte) : small_integer(byte);
    return x * scales[mode >> 2 & 3] + offsets[mode >> 4 & 3];
}

#endif
