/* Insertion order for incremental triangulation. Based on: N. Amenta, S. Choi, G. Rote, Incremental
 * Constructions con BRIO, Symposium on Computational Geometry 2003. The random rounds bound the
 * expected work for all inputs. The curve keeps consecutive points of a round, and the memory that
 * they touch, close to each other. Cells of the curve with a cluster of points get a curve of their
 * own. */
#include "mesh/insertion_order.h"

#include "base/sort.h"

#include <stdbool.h>

/* A key consists, from the top, of 4 bits for the round, 32 bits for the place on the curve, and 28
 * bits for the index. */
enum { ROUND_SHIFT = 60, CURVE_SHIFT = 28, CURVE_BITS = 16, LAST_ROUND = 15 };

/* Returns the place on the Hilbert curve of a cell of the 2^16 x 2^16 square. The four orientations
 * of the curve are states. A cell's quadrant gives a digit and the orientation within the
 * quadrant. */
static uint64_t hilbert(uint32_t x, uint32_t y)
{
    static const uint8_t digit[16] = {0, 1, 3, 2, 0, 3, 1, 2, 2, 3, 1, 0, 2, 1, 3, 0};
    static const uint8_t inner[16] = {4, 0, 12, 0, 0, 8, 4, 4, 8, 4, 8, 12, 12, 12, 0, 8};
    uint32_t place = 0, state = 0;
    for (uint32_t bit = CURVE_BITS; bit-- > 0;) {
        const uint32_t quadrant = state | (x >> bit & 1) << 1 | (y >> bit & 1);
        place = place << 2 | digit[quadrant];
        state = inner[quadrant];
    }
    return place;
}

/* Returns the place of a cell of the 2^10 x 2^10 x 2^10 cube on the curve of G. M. Morton, through
 * its octants and theirs. The curve jumps now and then, but is simple. */
static uint64_t morton(uint32_t x, uint32_t y, uint32_t z)
{
    uint64_t place = 0;
    for (uint32_t bit = 10; bit-- > 0;)
        place = place << 3 | (x >> bit & 1) << 2 | (y >> bit & 1) << 1 | (z >> bit & 1);
    return place;
}

/* Puts three of four points into the last round, three of four of the others into the previous one,
 * and so on. The finaliser of MurmurHash3 scatters the bits of the index. */
static uint64_t pick_round(uint32_t index)
{
    uint32_t bits = index;
    bits = (bits ^ bits >> 16) * 0x85ebca6bu;
    bits = (bits ^ bits >> 13) * 0xc2b2ae35u;
    bits ^= bits >> 16;
    uint64_t round = LAST_ROUND;
    for (; (bits & 3) == 0 && round > 0; bits >>= 2)
        --round;
    return round;
}

/* The cells of one axis: where they begin, and their number per unit. */
typedef struct axis {
    double origin, scale;
    uint32_t last;
} axis;

static size_t index_of(uint64_t key)
{
    return (size_t)(key & (((uint64_t)1 << CURVE_SHIFT) - 1));
}

/* `dim` is the distance between the coordinates of consecutive points. */
static axis measure(const uint64_t *keys, size_t n, size_t dim, const double *coordinates)
{
    const double last = dim == 2 ? 65535.0 : 1023.0;
    double low = coordinates[dim * index_of(keys[0])], high = low;
    for (size_t i = 1; i < n; ++i) {
        const double x = coordinates[dim * index_of(keys[i])];
        low = x < low ? x : low;
        high = x > high ? x : high;
    }
    return (axis){low, high > low ? last / (high - low) : 0.0, (uint32_t)last};
}

static uint32_t cell(const axis *a, double x)
{
    const double place = (x - a->origin) * a->scale;
    return place < a->last ? (uint32_t)place : a->last;
}

/* Places the points of some keys on a curve through their bounding box, and sorts them. */
static void sort_along_curve(uint64_t *keys, uint64_t *scratch, size_t n, size_t dim,
                             const double *points)
{
    const uint64_t curve = (uint64_t)UINT32_MAX << CURVE_SHIFT;
    const axis x = measure(keys, n, dim, points), y = measure(keys, n, dim, points + 1);
    const axis z = dim == 3 ? measure(keys, n, dim, points + 2) : y;
    for (size_t i = 0; i < n; ++i) {
        const double *p = points + dim * index_of(keys[i]);
        const uint64_t place = dim == 2 ? hilbert(cell(&x, p[0]), cell(&y, p[1]))
                                        : morton(cell(&x, p[0]), cell(&y, p[1]), cell(&z, p[2]));
        keys[i] = (keys[i] & ~curve) | place << CURVE_SHIFT;
    }
    iccp_sort_keys(keys, scratch, n, CURVE_SHIFT);
}

/* Sorts again the points that share a cell, if there are many. Returns false if no cell had
 * many. */
static bool refine(uint64_t *keys, uint64_t *scratch, size_t n, size_t dim, const double *points)
{
    enum { MUCH = 64 }; /* walking across a few tens of triangles costs less than sorting again */
    bool refined = false;
    for (size_t begin = 0, end; begin < n; begin = end) {
        end = begin + 1;
        while (end < n && keys[begin] >> CURVE_SHIFT == keys[end] >> CURVE_SHIFT)
            ++end;
        if (end - begin < MUCH)
            continue;
        sort_along_curve(keys + begin, scratch, end - begin, dim, points);
        refined = true;
    }
    return refined;
}

icc_status iccp_insertion_order(uint32_t *order, size_t n, size_t dim, const double *points,
                                const iccp_memory *memory)
{
    /* Each level is finer by 2^16 in the plane and by 2^10 in space. The local coordinates span
     * less than 2^450. */
    const int most_levels = dim == 2 ? 28 : 45;
    uint64_t *keys = iccp_alloc(memory, n, 2 * sizeof *keys);
    if (keys == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < n; ++i)
        keys[i] = pick_round((uint32_t)i) << ROUND_SHIFT | i;
    sort_along_curve(keys, keys + n, n, dim, points);
    for (int level = 1; level < most_levels && refine(keys, keys + n, n, dim, points); ++level)
        continue;
    for (size_t i = 0; i < n; ++i)
        order[i] = (uint32_t)index_of(keys[i]);
    iccp_free(memory, keys);
    return ICC_OK;
}
