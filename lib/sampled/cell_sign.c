/* Judges a cell by its Bernstein coefficients, which are subdivided until the sign is known. Plain
 * arithmetic with bounds comes first, exact coefficients second. */
#include "sampled/cell_sign.h"

#include "base/minmax.h"

#include <float.h>
#include <math.h>

/* Limits of subdivision: bisections in a row, eight for each axis, and parts in all. Larger limits
 * only help for cells whose determinant is nearly 0 somewhere. */
enum { DEEPEST = 24, MOST_PARTS = 1024 };

/* The middle of two bounds, rounded down (way -1) or up (1). */
static double middle(double a, double b, double way)
{
    const double m = 0.5 * a + 0.5 * b;
    return m + way * DBL_EPSILON * (fabs(a) + fabs(b));
}

/* De Casteljau's algorithm for degree 2 at the middle of an axis. Keeps the first half. */
static void bisect(double *first, double *second, size_t axis, double way)
{
    const size_t stride = axis == 0 ? 1 : axis == 1 ? 3 : 9;
    for (size_t i = 0; i < ICCP_CELL_MOST; ++i) {
        if (i / stride % 3 != 0)
            continue;
        double *b = first + i, *c = second + i;
        const double left = middle(b[0], b[stride], way);
        const double right = middle(b[stride], b[2 * stride], way);
        const double centre = middle(left, right, way);
        c[2 * stride] = b[2 * stride];
        c[stride] = right;
        c[0] = b[2 * stride] = centre;
        b[stride] = left;
    }
}

/* If no coefficient is negative and those at corners are positive, the determinant is positive,
 * because each face of a part has a corner. */
static int32_t judge(const iccp_cell *cell, const iccp_cell_bounds *part, bool *is_stuck)
{
    bool positive = true;
    *is_stuck = false;
    for (size_t c = 0; c < cell->n_corners; ++c) {
        const size_t i = iccp_cell_corner(cell, c);
        if (part->upper[i] <= 0)
            return ICC_CELL_FOLDED;
        *is_stuck = *is_stuck || !(part->lower[i] > 0);
    }
    for (size_t i = 0; i < cell->n; ++i)
        positive = positive && part->lower[i] >= 0;
    return positive && !*is_stuck ? 0 : ICC_CELL_UNDECIDED;
}

/* Goes through the parts depth first. A part with a corner that rounding leaves open stays open. */
static int32_t subdivide(const iccp_cell *cell, const iccp_cell_bounds *whole)
{
    iccp_cell_bounds parts[DEEPEST + 2];
    size_t depths[DEEPEST + 2] = {0}, n_open = 1;
    int32_t result = 0;
    parts[0] = *whole;
    for (size_t n_parts = 0; n_open > 0; ++n_parts) {
        iccp_cell_bounds *part = parts + n_open - 1;
        const size_t depth = depths[n_open - 1];
        bool is_stuck;
        const int32_t sign = judge(cell, part, &is_stuck);
        if (sign == ICC_CELL_FOLDED)
            return sign;
        if (sign == 0 || is_stuck || depth == DEEPEST || cell->degree == 1) {
            result = sign == 0 ? result : sign;
            --n_open;
            continue;
        }
        if (n_parts == MOST_PARTS)
            return ICC_CELL_UNDECIDED;
        bisect(part->lower, part[1].lower, depth % 3, -1);
        bisect(part->upper, part[1].upper, depth % 3, 1);
        depths[n_open - 1] = depths[n_open] = depth + 1;
        ++n_open;
    }
    return result;
}

int32_t iccp_cell_sign(const iccp_cell *cell, double *least, iccp_cell_work **work,
                       const iccp_memory *memory, bool *failed)
{
    iccp_cell_bounds bounds;
    int32_t sign = ICC_CELL_UNDECIDED;
    if (!iccp_cell_bound(&bounds, cell))
        return sign;
    for (size_t c = 0; c < cell->n_corners; ++c) {
        const size_t i = iccp_cell_corner(cell, c);
        *least = iccp_min(*least, 0.5 * bounds.lower[i] + 0.5 * bounds.upper[i]);
    }
    sign = subdivide(cell, &bounds);
    if (sign != ICC_CELL_UNDECIDED)
        return sign;
    if (*work == NULL)
        *work = iccp_cell_work_create(memory);
    *failed = *work == NULL;
    return !*failed && iccp_cell_bound_exactly(&bounds, cell, *work) ? subdivide(cell, &bounds)
                                                                     : sign;
}
