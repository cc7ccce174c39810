/* Corners of triangles in one list. Triangle t has the corners 3 t, 3 t + 1 and 3 t + 2,
 * counter-clockwise. */
#ifndef ICCP_TRIANGLE_CORNERS_H
#define ICCP_TRIANGLE_CORNERS_H

#include <stdint.h>

/* The next corner of the triangle, counter-clockwise. */
static inline uint32_t iccp_after(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static inline uint32_t iccp_before(uint32_t corner)
{
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

#endif
