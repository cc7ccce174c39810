/* Finds the steepest face around a face. Based on: L. Huynh, Bijective Deformations in R^n via
 * Integral Curve Coordinates, thesis, 2013, section 5.1 (Table 5.1), for faces of any dimension.
 *
 * A face that contains the given one has additional corners: below its lowest, above its highest,
 * or between two consecutive ones. Along the block of axes between two corners, f rises by g per
 * axis. That is the speed of these coordinates along the gradient. So the barycentric coordinate of
 * the corner between two blocks moves at the difference of their speeds.
 *
 * The gradient points into the face if the barycentric coordinates of all new corners grow. That is
 * so if two conditions hold. Away from the given face, and between two of its corners from the
 * lower to the upper one, each block must be less steep than the one before. Outside, all blocks
 * must rise. The square of the slope is the sum of (rise)^2 / (axes) over the blocks. So each gap
 * between two corners is a problem of its own, while the parts below and above only share the
 * axes. */
#include "gradient/trace/walkn_star.h"

#include "base/minmax.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

enum { SETS = 1 << ICC_MAX_DIM };

/* In units of f. It is far above the square root of the smallest normal double. So rises that
 * matter beside one of this size have normal squares. */
static const double TINY_RISE = 1e-100;

/* Consecutive blocks of axes. */
typedef struct chain {
    double slope2; /* sum of the blocks' squared slopes */
    int n;
    uint8_t set[ICC_MAX_DIM]; /* the set of axes used after each block */
} chain;

/* The vertices that can be reached from a corner along sets of some axes, all up or all down. A set
 * is a number with a bit for each entry of axis[]. */
typedef struct fan {
    int n;
    int8_t axis[ICC_MAX_DIM];
    bool rising;          /* true: every block has to rise */
    const double *f;      /* by set; NaN where there is no value */
    double unit;          /* unit of rises when they are squared */
    chain steepest[SETS]; /* the steepest chain that ends at each set; slope2 < 0: none */
} fan;

/* A face and its surroundings. */
typedef struct hinge {
    const icc_grid *grid;
    int n;                            /* number of corners */
    uint32_t corner[ICC_MAX_DIM + 1]; /* grid vertices, lowest first */
    fan between[ICC_MAX_DIM];         /* from each corner to the next */
    fan up, down;                     /* from the highest corner, and from the lowest */
    /* By axis: coordinates of the face along the axes of `up` and `down` */
    uint32_t at[ICC_MAX_DIM];
    const chain *way_up, *way_down;
} hinge;

static unsigned full(const fan *way)
{
    return (1u << way->n) - 1;
}

static int count_axes(unsigned set)
{
    int n = 0;
    for (; set > 0; set &= set - 1)
        ++n;
    return n;
}

void iccp_slope_values(const iccp_slope *slope, size_t n, const uint32_t *vertices, double *values)
{
    if (slope->level)
        for (size_t i = 0; i < n; ++i)
            values[i] = (double)vertices[i];
    else
        iccp_function_local(slope->function, n, vertices, values);
    for (size_t i = 0; i < n && slope->direction < 0; ++i)
        values[i] = -values[i];
}

/* ---- chains ---- */

/* Returns true if f rises less per axis from `b` to `c` than from `a` to `b`. Exact. */
static bool gentler(const fan *way, unsigned a, unsigned b, unsigned c)
{
    const double *f = way->f;
    return iccp_cross_sign(f[c], f[b], count_axes(b ^ a), 0, f[b], f[a], count_axes(c ^ b), 0) < 0;
}

/* Extends a chain to all longer ones. The recursion is no deeper than the number of axes. */
static void extend_chain(fan *way, const chain *c)
{
    const unsigned at = c->n > 0 ? c->set[c->n - 1] : 0;
    const unsigned before = c->n > 1 ? c->set[c->n - 2] : 0;
    const unsigned rest = full(way) & ~at;
    if (c->slope2 > way->steepest[at].slope2)
        way->steepest[at] = *c;
    for (unsigned block = rest; block > 0; block = (block - 1) & rest) {
        const unsigned next = at | block;
        const double rise = (way->f[next] - way->f[at]) * way->unit;
        if (isnan(rise) || (way->rising && !(rise > 0)) ||
            (c->n > 0 && !gentler(way, before, at, next)))
            continue;
        chain longer = *c;
        longer.set[longer.n++] = (uint8_t)next;
        longer.slope2 += rise * rise / count_axes(block);
        extend_chain(way, &longer);
    }
}

static void find_chains(fan *way, double unit)
{
    for (unsigned set = 0; set <= full(way); ++set)
        way->steepest[set].slope2 = -1;
    way->unit = unit;
    extend_chain(way, &(chain){.n = 0});
}

/* Returns a unit for rises up to the highest of n values from `base`. No chain goes below
 * `base`. */
static double unit_for(size_t n, const double *f, double base)
{
    double most = 0;
    for (size_t i = 0; i < n; ++i)
        if (f[i] - base > most)
            most = f[i] - base;
    return most < TINY_RISE && most > 0 ? 1 / most : 1;
}

/* ---- the star of a face ---- */

/* Splits the axes of the place's simplex by the corners of the face. Axes between two corners form
 * a fan. The remaining axes lead up from the last corner or down from the first. at[] has the
 * face's coordinates along these. */
static void take_apart(hinge *h, const iccp_place *place, const icc_grid *grid)
{
    h->grid = grid;
    h->n = 0;
    h->up.n = 0;
    for (int i = 0; i < grid->dim; ++i) {
        if (place->face >> i & 1) {
            h->corner[h->n] = place->simplex.corner[i];
            h->between[h->n++].n = 0;
        }
        const int8_t axis = place->simplex.axis[i];
        const bool outer = h->n == 0 || place->face >> (i + 1) == 0;
        fan *to = outer ? &h->up : &h->between[h->n - 1];
        to->axis[to->n++] = axis;
        h->at[axis] = place->low[axis] + (h->n == 0);
    }
    if (place->face >> grid->dim & 1)
        h->corner[h->n++] = place->simplex.corner[grid->dim];
    h->down.n = h->up.n;
    memcpy(h->down.axis, h->up.axis, sizeof h->up.axis);
}

/* Lists the vertices of a fan. Vertices outside the grid are replaced by the corner. Returns the
 * sets that lead to the others, one bit for each. */
static uint64_t list_vertices(const hinge *h, const fan *way, bool down, uint32_t corner,
                              uint32_t *vertices)
{
    uint64_t there = 1;
    vertices[0] = corner;
    for (unsigned set = 1; set <= full(way); ++set) {
        const unsigned rest = set & (set - 1);
        const int8_t axis = way->axis[count_axes((set ^ rest) - 1)];
        const uint32_t stride = (uint32_t)h->grid->stride[axis];
        const bool fits = down ? h->at[axis] > 0 : h->at[axis] + 1 < h->grid->shape[axis];
        vertices[set] = corner;
        if (!fits || !(there >> rest & 1))
            continue;
        there |= (uint64_t)1 << set;
        vertices[set] = down ? vertices[rest] - stride : vertices[rest] + stride;
    }
    return there;
}

/* Reads the values of n vertices, the first of which is a corner. Around a level face, only
 * vertices at the same height count. */
static void load_values(const iccp_slope *slope, size_t n, const uint32_t *vertices, double *f)
{
    const iccp_slope plain = {slope->function, slope->direction, false};
    iccp_slope_values(&plain, n, vertices, f);
    const double base = f[0];
    for (size_t i = 0; i < n && slope->level; ++i)
        f[i] = f[i] >= base && f[i] <= base ? slope->direction * (double)vertices[i] : NAN;
}

static void hide_missing(size_t n, uint64_t there, double *f)
{
    for (size_t i = 0; i < n; ++i)
        if (!(there >> i & 1))
            f[i] = NAN;
}

/* Finds the steepest pair of chains above and below the face that do not share an axis. */
static void find_outer_chains(hinge *h, const iccp_slope *slope)
{
    const size_t n = (size_t)1 << h->up.n;
    uint32_t vertices[2 * SETS];
    double f[2 * SETS], best = -1;
    const uint64_t above = list_vertices(h, &h->up, false, h->corner[h->n - 1], vertices);
    const uint64_t below = list_vertices(h, &h->down, true, h->corner[0], vertices + n);
    load_values(slope, 2 * n, vertices, f);
    hide_missing(n, above, f);
    hide_missing(n, below, f + n);
    const double unit = iccp_max(unit_for(n, f, f[0]), unit_for(n, f + n, f[n]));
    h->up.f = f;
    h->down.f = f + n;
    h->up.rising = h->down.rising = true;
    find_chains(&h->up, unit);
    find_chains(&h->down, unit);
    for (unsigned up = 0; up < n; ++up)
        for (unsigned down = 0; down < n; ++down) {
            const double a = h->up.steepest[up].slope2, b = h->down.steepest[down].slope2;
            if ((up & down) == 0 && a >= 0 && b >= 0 && a + b > best) {
                best = a + b;
                h->way_up = &h->up.steepest[up];
                h->way_down = &h->down.steepest[down];
            }
        }
}

/* Finds the steepest chain from a corner of the face to the next. */
static void find_inner_chain(hinge *h, int i, const iccp_slope *slope)
{
    fan *way = &h->between[i];
    if (way->n == 1) {
        way->steepest[1] = (chain){.n = 1, .set = {1}};
        return;
    }
    const size_t n = (size_t)1 << way->n;
    uint32_t vertices[SETS];
    double f[SETS];
    (void)list_vertices(h, way, false, h->corner[i], vertices);
    load_values(slope, n, vertices, f);
    way->f = f;
    way->rising = false;
    find_chains(way, unit_for(n, f, iccp_min(f[0], f[n - 1])));
}

/* Returns true if f rises on the face, or into one that contains it. */
static bool finds_a_rise(const hinge *h, const iccp_slope *slope)
{
    double f[ICC_MAX_DIM + 1];
    if (h->way_up->n > 0 || h->way_down->n > 0)
        return true;
    iccp_slope_values(slope, (size_t)h->n, h->corner, f);
    for (int i = 0; i + 1 < h->n; ++i)
        if (h->between[i].steepest[full(&h->between[i])].n > 1 || f[i] > f[i + 1] ||
            f[i] < f[i + 1])
            return true;
    return false;
}

/* ---- the simplex ---- */

/* A simplex, assembled from its lowest corner to its highest. */
typedef struct assembly {
    iccp_place *place;
    int n; /* number of axes so far */
    unsigned corners;
} assembly;

/* Adds the axes of the last block of a chain, or of block k. */
static void add_block(assembly *a, const fan *way, const chain *c, int k)
{
    const unsigned block = c->set[k] & ~(k > 0 ? (unsigned)c->set[k - 1] : 0);
    for (int i = 0; i < way->n; ++i)
        if (block >> i & 1)
            a->place->simplex.axis[a->n++] = way->axis[i];
}

static void add_corner(assembly *a, bool of_face)
{
    a->corners |= 1u << a->n;
    if (of_face)
        a->place->face |= 1u << a->n;
}

static void add_chain(assembly *a, const fan *way, const chain *c, bool between)
{
    for (int k = 0; k < c->n; ++k) {
        add_block(a, way, c, k);
        add_corner(a, between && k + 1 == c->n);
    }
}

/* Adds the axes that neither chain needs. The cell lies above the face if the grid continues
 * there. */
static void add_others(assembly *a, const hinge *h, bool below)
{
    const unsigned up = h->way_up->n > 0 ? h->way_up->set[h->way_up->n - 1] : 0;
    const unsigned down = h->way_down->n > 0 ? h->way_down->set[h->way_down->n - 1] : 0;
    for (int i = 0; i < h->up.n; ++i) {
        const int8_t axis = h->up.axis[i];
        const bool fits_above = h->at[axis] + 1 < h->grid->shape[axis];
        if (!((up | down) >> i & 1) && fits_above != below)
            a->place->simplex.axis[a->n++] = axis;
    }
}

/* Puts the axes of the new simplex in order. Unused axes that lie below, because there is no room
 * above, come first. The chain down follows from its far end, then the chains between the corners
 * of the face, the chain up, and the remaining axes. The point stays where it is: y is 1 on axes
 * below the face, 0 on those above, and unchanged between. */
static void assemble(assembly *a, const hinge *h)
{
    iccp_place *place = a->place;
    double y[ICC_MAX_DIM];
    for (int k = 0; k < h->grid->dim; ++k)
        y[place->simplex.axis[k]] = place->y[k + 1];
    a->n = 0;
    a->corners = place->face = 0;
    add_others(a, h, true);
    for (int k = h->way_down->n; k-- > 0;) {
        add_corner(a, false);
        add_block(a, &h->down, h->way_down, k);
    }
    const int below = a->n;
    add_corner(a, true);
    for (int i = 0; i + 1 < h->n; ++i)
        add_chain(a, &h->between[i], &h->between[i].steepest[full(&h->between[i])], true);
    const int inner = a->n;
    add_chain(a, &h->up, h->way_up, false);
    add_others(a, h, false);
    uint32_t corner = h->corner[0];
    for (int k = 0; k < below; ++k)
        corner -= (uint32_t)h->grid->stride[place->simplex.axis[k]];
    for (int k = 0; k < h->grid->dim; ++k) {
        const int8_t axis = place->simplex.axis[k];
        const bool outer = k < below || k >= inner;
        place->simplex.corner[k] = corner;
        corner += (uint32_t)h->grid->stride[axis];
        place->y[k + 1] = !outer ? y[axis] : k < below ? 1 : 0;
        if (outer)
            place->low[axis] = h->at[axis] - (k < below);
    }
    place->simplex.corner[h->grid->dim] = corner;
}

icc_status iccp_place_find_steepest(iccp_place *place, iccp_slope *slope, unsigned *corners)
{
    const icc_grid *grid = slope->function->tree->grid;
    hinge h;
    assembly a = {.place = place};
    take_apart(&h, place, grid);
    bool rises = false;
    for (int level = 0; level < 2 && !rises; ++level) {
        slope->level = level > 0;
        find_outer_chains(&h, slope);
        for (int i = 0; i + 1 < h.n; ++i)
            find_inner_chain(&h, i, slope);
        rises = finds_a_rise(&h, slope);
    }
    if (!rises)
        return ICC_ERR_TRACE;
    assemble(&a, &h);
    *corners = a.corners;
    return ICC_OK;
}
