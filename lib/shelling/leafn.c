/* Follows leaves through an ordered mesh. Source: M. Campen, C. Silva, D. Zorin, Bijective Maps
 * from Simplicial Foliations, ACM Transactions on Graphics 35, 2016.
 *
 * A leaf leaves a simplex by the side whose barycentric coordinate vanishes first. Corners are
 * sorted, so the other coordinates keep their order in the next simplex. */
#include "shelling/leafn.h"

#include "math/vec.h"

#include <math.h>
#include <string.h>

enum { CORNERS = ICCP_LEAFN_CORNERS, MAX = ICC_MAX_DIM };

/* The direction in which a leaf is followed, as a factor of the rates. */
static const double UP = 1, DOWN = -1;

/* The functions below are written for n = dim + 1 corners. If the compiler knows n, it unrolls
 * the loops. */

static ICCP_INLINE const iccp_leafn_word *record_of(const iccp_leaves *leaves, size_t n,
                                                    uint32_t simplex)
{
    return leaves->records + iccp_leafn_stride(n) * simplex;
}

static ICCP_INLINE bool in_star(const iccp_leafn_word *record, size_t n)
{
    return !(record[n].number > 0);
}

static ICCP_INLINE uint32_t across(const iccp_leafn_word *record, size_t n, size_t side)
{
    return record[n + 2 + side / 2].side[side % 2];
}

/* The bits of x as an integer. Numbers that are not negative keep their order, and all negative
 * ones come after them. */
static ICCP_INLINE uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Finds the side by which the leaf leaves, and the parameter there in units of the rates.
 * Returns n if there is none, which happens in the star on the way up. The side cannot be
 * predicted, so the code has no branches. A side that is entered has a negative reach, possibly
 * -0, because coordinates are never -0. */
static ICCP_INLINE size_t find_exit(const iccp_leafn_word *record, size_t n, double way,
                                    const double *bary, double *share)
{
    double reach[CORNERS];
    uint64_t least = UINT64_MAX;
    for (size_t i = 0; i < n; ++i) {
        reach[i] = -bary[i] / (way * record[i].number);
        least = bits_of(reach[i]) < least ? bits_of(reach[i]) : least;
    }
    size_t exit = 0;
    bool before = true;
    for (size_t i = 0; i + 1 < n; ++i) {
        before = before & (bits_of(reach[i]) != least);
        exit += before;
    }
    memcpy(share, &least, sizeof least);
    return least >> 63 == 0 ? exit : n;
}

static ICCP_INLINE void advance(const iccp_leafn_word *record, size_t n, double way, double share,
                                double *bary)
{
    for (size_t i = 0; i < n; ++i) {
        const double next = bary[i] + share * (way * record[i].number);
        bary[i] = 0.5 * (next + fabs(next)); /* 0 if rounding made it negative */
    }
}

/* Moves the coordinates of one side's corners to the simplex across, and puts a 0 at its corner
 * `to`. */
static ICCP_INLINE void carry(size_t n, size_t from, size_t to, double *bary)
{
    double shared[CORNERS] = {0};
    for (size_t i = 0; i + 1 < n; ++i)
        shared[i] = bary[i + (i >= from)];
    for (size_t i = 0; i + 1 < n; ++i)
        bary[i + (i >= to)] = shared[i];
    bary[to] = 0;
}

static void carry_jet(size_t n, size_t from, size_t to, iccp_leafn_jet *jet)
{
    double rows[CORNERS][MAX];
    memcpy(rows, jet->bary, sizeof rows);
    for (size_t i = 0, k = 0; i < n; ++i) {
        k += k == from;
        if (i == to)
            memset(jet->bary[i], 0, sizeof rows[0]);
        else
            memcpy(jet->bary[i], rows[k++], sizeof rows[0]);
    }
}

/* Carries derivatives over a step. The parameter of the exit changes with the coordinate that
 * vanishes there. */
static void advance_jet(const iccp_leafn_word *record, size_t n, double way, size_t exit,
                        iccp_leafn_jet *jet)
{
    for (size_t p = 0; p < jet->n; ++p) {
        const double slope = -jet->bary[exit][p] / (way * record[exit].number);
        for (size_t i = 0; i < n; ++i)
            jet->bary[i][p] += slope * (way * record[i].number);
        jet->length[p] += slope * record[n].number;
    }
}

/* ---- in the star ---- */

static size_t corner_of_centre(const iccp_leaves *leaves, uint32_t simplex)
{
    const size_t n = leaves->dim + 1;
    size_t corner = 0;
    while (leaves->corners[n * simplex + corner] != leaves->centre)
        ++corner;
    return corner;
}

/* Writes the offset from the centre to a place in the star, and returns its length. */
static double from_centre(const iccp_leaves *leaves, const iccp_leafn_place *place, double *offset)
{
    iccp_leafn_offset(leaves, place, corner_of_centre(leaves, place->simplex), offset);
    return iccp_vec_norm(leaves->dim, offset);
}

/* Derivatives of the distance from the centre by the parameters of a jet. */
static void distance_jet(const iccp_leaves *leaves, const iccp_leafn_place *place,
                         const iccp_leafn_jet *jet, double *slope)
{
    double offset[MAX], movement[MAX][MAX];
    const double distance = from_centre(leaves, place, offset);
    iccp_leafn_movement(leaves, place, jet, movement);
    for (size_t p = 0; p < jet->n; ++p) {
        slope[p] = 0;
        for (size_t k = 0; k < leaves->dim && distance > 0; ++k)
            slope[p] += offset[k] / distance * movement[k][p];
    }
}

/* Moves a place in the star, other than the centre, to the side that faces the centre. */
static double fall_through_star(const iccp_leaves *leaves, iccp_leafn_place *place, size_t corner,
                                iccp_leafn_jet *jet)
{
    const size_t n = leaves->dim + 1;
    double offset[MAX], slope[MAX];
    const double distance = from_centre(leaves, place, offset);
    const double own = place->bary[corner];
    const double others = iccp_leafn_sum(place->bary, n) - own;
    if (jet != NULL) {
        distance_jet(leaves, place, jet, slope);
        for (size_t p = 0; p < jet->n; ++p) {
            const double d_own = jet->bary[corner][p];
            double d_others = 0;
            for (size_t i = 0; i < n; ++i)
                d_others += i != corner ? jet->bary[i][p] : 0;
            jet->length[p] += slope[p] * own / others +
                              distance * (d_own * others - own * d_others) / (others * others);
            for (size_t i = 0; i < n; ++i)
                jet->bary[i][p] = (jet->bary[i][p] - place->bary[i] * d_others / others) / others;
            jet->bary[corner][p] = 0;
        }
    }
    for (size_t i = 0; i < n; ++i)
        place->bary[i] /= others;
    place->bary[corner] = 0;
    return distance * own / others;
}

/* ---- walks ---- */

/* Leaves the simplex through a side. If that is on the boundary, writes the facet and returns
 * false. */
static ICCP_INLINE bool cross(const iccp_leafn_word *record, size_t n, size_t exit,
                              iccp_leafn_place *place, iccp_leafn_jet *jet, uint32_t *facet)
{
    const uint32_t next = across(record, n, exit);
    if ((next & ICCP_ON_BOUNDARY) != 0) {
        *facet = next & ~ICCP_ON_BOUNDARY;
        return false;
    }
    place->simplex = next / (uint32_t)n;
    carry(n, exit, next % (uint32_t)n, place->bary);
    if (jet != NULL)
        carry_jet(n, exit, next % (uint32_t)n, jet);
    return true;
}

static ICCP_INLINE void prefetch(const iccp_leaves *leaves, const iccp_leafn_word *record, size_t n)
{
    for (size_t i = 0; i < n; ++i)
        ICCP_PREFETCH(
            record_of(leaves, n, (across(record, n, i) & ~ICCP_ON_BOUNDARY) / (uint32_t)n));
}

/* Passes through one simplex outside the star. Returns false where the walk ends. */
static ICCP_INLINE bool step(const iccp_leaves *leaves, size_t n, double way,
                             iccp_leafn_place *place, double *length, iccp_leafn_jet *jet,
                             uint32_t *facet)
{
    const iccp_leafn_word *record = record_of(leaves, n, place->simplex);
    double share;
    prefetch(leaves, record, n);
    const size_t exit = find_exit(record, n, way, place->bary, &share);
    if (exit == n)
        return false;
    if (jet != NULL)
        advance_jet(record, n, way, exit, jet);
    advance(record, n, way, share, place->bary);
    place->bary[exit] = 0;
    *length += share * record[n].number;
    return cross(record, n, exit, place, jet, facet);
}

static ICCP_INLINE double rise(const iccp_leaves *leaves, size_t n, iccp_leafn_place *place)
{
    double length = 0, offset[MAX];
    uint32_t facet;
    while (step(leaves, n, UP, place, &length, NULL, &facet)) {
    }
    return length + from_centre(leaves, place, offset);
}

double iccp_leafn_rise(const iccp_leaves *leaves, iccp_leafn_place *place)
{
    switch (leaves->dim) {
    case 2:
        return rise(leaves, 3, place);
    case 3:
        return rise(leaves, 4, place);
    default:
        return rise(leaves, leaves->dim + 1, place);
    }
}

/* Leaves the star if the place lies in it. Returns false if the walk ends there. */
static bool leave_star(const iccp_leaves *leaves, iccp_leafn_place *place, double *length,
                       iccp_leafn_jet *jet, uint32_t *facet)
{
    const size_t n = leaves->dim + 1;
    const iccp_leafn_word *record = record_of(leaves, n, place->simplex);
    if (!in_star(record, n))
        return true;
    const size_t corner = corner_of_centre(leaves, place->simplex);
    *length += fall_through_star(leaves, place, corner, jet);
    return cross(record, n, corner, place, jet, facet);
}

static ICCP_INLINE double fall(const iccp_leaves *leaves, size_t n, iccp_leafn_place *place,
                               uint32_t *facet)
{
    double length = 0;
    bool more = leave_star(leaves, place, &length, NULL, facet);
    while (more)
        more = step(leaves, n, DOWN, place, &length, NULL, facet);
    return length;
}

double iccp_leafn_fall(const iccp_leaves *leaves, iccp_leafn_place *place, uint32_t *facet)
{
    switch (leaves->dim) {
    case 2:
        return fall(leaves, 3, place, facet);
    case 3:
        return fall(leaves, 4, place, facet);
    default:
        return fall(leaves, leaves->dim + 1, place, facet);
    }
}

double iccp_leafn_rise_jet(const iccp_leaves *leaves, iccp_leafn_place *place, iccp_leafn_jet *jet,
                           uint32_t stop, iccp_leafn_jet *stopped)
{
    double length = 0, offset[MAX], slope[MAX];
    uint32_t facet;
    do {
        if (place->simplex == stop)
            *stopped = *jet;
    } while (step(leaves, leaves->dim + 1, UP, place, &length, jet, &facet));
    distance_jet(leaves, place, jet, slope);
    for (size_t p = 0; p < jet->n; ++p)
        jet->length[p] += slope[p];
    return length + from_centre(leaves, place, offset);
}

double iccp_leafn_fall_jet(const iccp_leaves *leaves, iccp_leafn_place *place, uint32_t *facet,
                           iccp_leafn_jet *jet)
{
    double length = 0;
    bool more = leave_star(leaves, place, &length, jet, facet);
    while (more)
        more = step(leaves, leaves->dim + 1, DOWN, place, &length, jet, facet);
    return length;
}

/* ---- notes: barycentric coordinates, simplex and length ---- */

static ICCP_INLINE icc_status note(iccp_path *path, size_t n, const iccp_leafn_place *place,
                                   double length)
{
    double *row = iccp_path_extend(path);
    if (row == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < n; ++i)
        row[i] = place->bary[i];
    row[n] = place->simplex;
    row[n + 1] = length;
    return ICC_OK;
}

static ICCP_INLINE icc_status note_rise(const iccp_leaves *leaves, size_t n,
                                        const iccp_leafn_place *start, iccp_path *path)
{
    iccp_leafn_place place = *start;
    double length = 0, offset[MAX];
    uint32_t facet;
    iccp_path_start(path, n + 1);
    icc_status status = note(path, n, &place, 0);
    while (status == ICC_OK && step(leaves, n, UP, &place, &length, NULL, &facet))
        status = note(path, n, &place, length);
    if (status != ICC_OK)
        return status;
    length += from_centre(leaves, &place, offset);
    memset(place.bary, 0, sizeof place.bary);
    place.bary[corner_of_centre(leaves, place.simplex)] = 1;
    return note(path, n, &place, length);
}

icc_status iccp_leafn_note_rise(const iccp_leaves *leaves, const iccp_leafn_place *place,
                                iccp_path *path)
{
    switch (leaves->dim) {
    case 2:
        return note_rise(leaves, 3, place, path);
    case 3:
        return note_rise(leaves, 4, place, path);
    default:
        return note_rise(leaves, leaves->dim + 1, place, path);
    }
}

icc_status iccp_leafn_note_fall(const iccp_leaves *leaves, const iccp_leafn_place *start,
                                iccp_path *path)
{
    const size_t n = leaves->dim + 1;
    iccp_leafn_place place = *start;
    double length = 0;
    uint32_t facet;
    iccp_path_start(path, n + 1);
    icc_status status = note(path, n, &place, 0);
    bool more = leave_star(leaves, &place, &length, NULL, &facet);
    while (status == ICC_OK && more) {
        status = note(path, n, &place, length);
        more = step(leaves, n, DOWN, &place, &length, NULL, &facet);
    }
    return status == ICC_OK ? note(path, n, &place, length) : status;
}

void iccp_leafn_noted(const iccp_path *path, size_t k, iccp_leafn_place *place)
{
    const double *row = iccp_path_at(path, k);
    const size_t n = path->dim - 1;
    memcpy(place->bary, row, n * sizeof *row);
    place->simplex = (uint32_t)row[n];
}

void iccp_leafn_ahead(const iccp_leaves *leaves, double length, double piece,
                      iccp_leafn_place *place)
{
    const size_t n = leaves->dim + 1;
    const iccp_leafn_word *record = record_of(leaves, n, place->simplex);
    if (!in_star(record, n)) {
        advance(record, n, UP, length / record[n].number, place->bary);
        return;
    }
    const size_t corner = corner_of_centre(leaves, place->simplex);
    const double sum = iccp_leafn_sum(place->bary, n), share = piece > 0 ? length / piece : 1;
    for (size_t i = 0; i < n; ++i)
        place->bary[i] *= 1 - share;
    place->bary[corner] += share * sum;
}

/* A move by `length` along the leaf adds the rates times length over speed. The derivatives of
 * the lengths move the place along the leaf, too. */
void iccp_leafn_ahead_jet(const iccp_leaves *leaves, const iccp_leafn_place *place, double length,
                          double piece, const double *d_length, const double *d_piece,
                          iccp_leafn_jet *jet)
{
    const size_t n = leaves->dim + 1;
    const iccp_leafn_word *record = record_of(leaves, n, place->simplex);
    const bool star = in_star(record, n);
    const size_t corner = star ? corner_of_centre(leaves, place->simplex) : n;
    const double sum = iccp_leafn_sum(place->bary, n), share = length / piece;
    for (size_t p = 0; p < jet->n; ++p)
        for (size_t i = 0; i < n; ++i)
            if (star) {
                const double way = (i == corner ? sum : 0) - place->bary[i];
                jet->bary[i][p] = (1 - share) * jet->bary[i][p] +
                                  (d_length[p] - share * d_piece[p]) / piece * way;
            } else {
                jet->bary[i][p] += d_length[p] / record[n].number * record[i].number;
            }
}
