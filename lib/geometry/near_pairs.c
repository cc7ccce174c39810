/* Finds the pairs of pieces of two kinds that may meet.
 *
 * Each kind matters only where the other kind is, so both are cut to the region of space that they
 * share. Then a plane divides this region, and pieces on both sides are cut there. So long pieces
 * become short, and their boxes no longer reach into regions that they do not touch. Planes are
 * perpendicular to the axes, or to the directions along which pieces differ most in relation to
 * their own extent: R. A. Fisher, The Use of Multiple Measurements in Taxonomic Problems, 1936. */
#include "geometry/near_pairs.h"

#include "base/budget.h"
#include "math/jacobi.h"
#include "math/vec.h"

#include <string.h>

enum {
    FEW = 4,        /* pairs per piece that are compared directly */
    SAMPLES = 3,    /* pieces of each kind whose ends are tried for the plane */
    MAX_CUTS = 500, /* each cut adds an error below 2^-50 of the size */
    N_DIRECTIONS = 6
};

/* Pieces extend beyond planes by this share of the size, which exceeds the errors of all cuts. */
static const double SLACK = 1e-12;

/* A plane is used if it leaves at most the share WORTH of the pairs. If it leaves at most ENOUGH,
 * no better one is sought. */
static const double WORTH = 0.8, ENOUGH = 0.6;

/* Multiplications that the budget is charged for each piece of a list. */
static const double LOOK = 500;

static const double THIN = 1e-15;

/* The pieces of `all` from `first` on. */
typedef struct list {
    iccp_near_pairs *all;
    size_t first, n;
    size_t n_first; /* pieces of the first kind; those of the second kind follow */
} list;

typedef struct plane {
    double u[3], at;
    double n_pairs; /* number of pairs left on both sides */
} plane;

iccp_piece *iccp_near_pairs_add(iccp_near_pairs *pairs)
{
    if (pairs->n == pairs->capacity) {
        const size_t capacity = 2 * pairs->capacity + 64;
        if (!iccp_enlarge(&pairs->env->memory, &pairs->pieces, pairs->n, capacity,
                          sizeof *pairs->pieces)) {
            pairs->status = ICC_ERR_MEMORY;
            return NULL;
        }
        pairs->capacity = capacity;
    }
    iccp_piece *piece = &pairs->pieces[pairs->n++];
    piece->n = piece->n_cuts = 0;
    return piece;
}

void iccp_near_pairs_free(iccp_near_pairs *pairs)
{
    iccp_free(&pairs->env->memory, pairs->pieces);
    iccp_free(&pairs->env->memory, pairs->spans);
}

/* Cuts a convex polygon: I. E. Sutherland, G. W. Hodgman, Reentrant Polygon Clipping, 1974. */
bool iccp_piece_cut(iccp_piece *piece, const double *u, double beyond)
{
    double corner[2 * ICCP_PIECE_CORNERS][3], off[ICCP_PIECE_CORNERS];
    uint32_t n = 0, n_out = 0;
    for (uint32_t i = 0; i < piece->n; ++i) {
        off[i] = iccp_vec_dot(3, u, piece->corner[i]) - beyond;
        n_out += off[i] > 0;
    }
    if (n_out == 0 || n_out == piece->n || piece->n_cuts == MAX_CUTS)
        return n_out < piece->n;
    for (uint32_t i = 0; i < piece->n; ++i) {
        const uint32_t j = i + 1 < piece->n ? i + 1 : 0;
        if (!(off[i] > 0))
            memcpy(corner[n++], piece->corner[i], sizeof *corner);
        if ((off[i] > 0) == (off[j] > 0) || (j == 0 && piece->n == 2))
            continue;
        for (size_t k = 0; k < 3; ++k)
            corner[n][k] = piece->corner[i][k] +
                           off[i] / (off[i] - off[j]) * (piece->corner[j][k] - piece->corner[i][k]);
        ++n;
    }
    if (n <= ICCP_PIECE_CORNERS) {
        memcpy(piece->corner, corner, n * sizeof *corner);
        piece->n = n;
        ++piece->n_cuts;
    }
    return true;
}

static iccp_piece *piece_at(const list *l, size_t i)
{
    return &l->all->pieces[l->first + i];
}

/* Finds where each piece begins and ends along a direction. */
static void measure(const list *l, const double *u)
{
    for (size_t i = 0; i < l->n; ++i) {
        const iccp_piece *piece = piece_at(l, i);
        double *span = l->all->spans + 2 * i;
        span[0] = span[1] = iccp_vec_dot(3, u, piece->corner[0]);
        for (uint32_t k = 1; k < piece->n; ++k) {
            const double x = iccp_vec_dot(3, u, piece->corner[k]);
            span[0] = x < span[0] ? x : span[0];
            span[1] = x > span[1] ? x : span[1];
        }
    }
}

static double count_pairs(const list *l)
{
    return (double)l->n_first * (double)(l->n - l->n_first);
}

/* Counts the pairs on either side of a plane. Pieces within `slack` of it are on both sides. */
static double count_divided(const list *l, double at, double slack)
{
    double below[2] = {0, 0}, above[2] = {0, 0};
    for (size_t i = 0; i < l->n; ++i) {
        const double *span = l->all->spans + 2 * i;
        below[i < l->n_first] += span[0] <= at + slack;
        above[i < l->n_first] += span[1] >= at - slack;
    }
    return below[0] * below[1] + above[0] * above[1];
}

/* ------------------------------------------------------------- directions */

/* Adds the scatter of the corners within each piece, where each piece has the same weight, and the
 * scatter of the middles of pieces. */
static void add_moments(const list *l, double *within, double *between)
{
    double mean[3] = {0};
    for (int round = 0; round < 2; ++round)
        for (size_t i = 0; i < l->n; ++i) {
            const iccp_piece *piece = piece_at(l, i);
            double middle[3] = {0};
            for (uint32_t c = 0; c < piece->n; ++c)
                for (size_t k = 0; k < 3; ++k)
                    middle[k] += piece->corner[c][k] / piece->n;
            for (size_t k = 0; round == 0 && k < 3; ++k)
                mean[k] += middle[k] / (double)l->n;
            double own[9] = {0};
            for (size_t k = 0; round == 1 && k < 9; ++k) {
                between[k] += (middle[k / 3] - mean[k / 3]) * (middle[k % 3] - mean[k % 3]);
                for (uint32_t c = 0; c < piece->n; ++c)
                    own[k] += (piece->corner[c][k / 3] - middle[k / 3]) *
                              (piece->corner[c][k % 3] - middle[k % 3]);
            }
            const double size = own[0] + own[4] + own[8];
            for (size_t k = 0; size > 0 && k < 9; ++k)
                within[k] += own[k] / size;
        }
}

/* out = f m f^T. */
static void transform(const double f[9], const double m[9], double out[9])
{
    for (size_t i = 0; i < 9; ++i) {
        out[i] = 0;
        for (size_t k = 0; k < 9; ++k)
            out[i] += f[i / 3 * 3 + k / 3] * m[k] * f[i % 3 * 3 + k % 3];
    }
}

/* A separate function, because the library's function is long when it is inlined twice. */
static void diagonalise(double a[9], double v[9])
{
    iccp_jacobi_diagonalise(3, 30, 0, a, v);
}

/* Lists the axes and the directions of Fisher's discriminants. */
static void list_directions(const list *l, double u[N_DIRECTIONS][3])
{
    double within[9] = {0}, between[9] = {0}, axes[9], whitened[9], turn[9];
    add_moments(l, within, between);
    const double least = THIN * (within[0] + within[4] + within[8]) + 1e-300;
    diagonalise(within, axes);
    for (size_t i = 0; i < 9; ++i)
        axes[i] /= sqrt((within[i / 3 * 4] > 0 ? within[i / 3 * 4] : 0) + least);
    transform(axes, between, whitened);
    diagonalise(whitened, turn);
    memset(u, 0, N_DIRECTIONS * sizeof *u);
    for (size_t i = 0; i < 3; ++i) {
        u[i][i] = 1;
        for (size_t k = 0; k < 9; ++k)
            u[3 + i][k % 3] += turn[3 * i + k / 3] * axes[k];
        const double length = iccp_vec_norm(3, u[3 + i]);
        for (size_t k = 0; k < 3; ++k)
            u[3 + i][k] /= length;
    }
}

/* ------------------------------------------------------------------- cuts */

/* Cuts pieces `begin` to `end` to their parts from `low` to `high` along u. */
static void keep_between(list *l, size_t begin, size_t end, const double *u, double low,
                         double high)
{
    const double down[3] = {-u[0], -u[1], -u[2]}, slack = 2 * SLACK * l->all->size;
    size_t kept = begin, n_first = l->n_first;
    for (size_t i = begin; i < l->n; ++i) {
        iccp_piece *piece = piece_at(l, i);
        if (i < end &&
            !(iccp_piece_cut(piece, u, high + slack) && iccp_piece_cut(piece, down, slack - low))) {
            n_first -= i < l->n_first;
            continue;
        }
        if (kept != i)
            *piece_at(l, kept) = *piece;
        ++kept;
    }
    *l = (list){l->all, l->first, kept, n_first};
    l->all->n = l->first + kept;
}

static void find_ends(const list *l, size_t begin, size_t end, double ends[2])
{
    ends[0] = HUGE_VAL;
    ends[1] = -HUGE_VAL;
    for (size_t i = begin; i < end; ++i) {
        const double *span = l->all->spans + 2 * i;
        ends[0] = span[0] < ends[0] ? span[0] : ends[0];
        ends[1] = span[1] > ends[1] ? span[1] : ends[1];
    }
}

/* Cuts each kind to the range of the other one along u. */
static void narrow(list *l, const double *u)
{
    double first[2], second[2];
    measure(l, u);
    find_ends(l, 0, l->n_first, first);
    find_ends(l, l->n_first, l->n, second);
    keep_between(l, l->n_first, l->n, u, first[0], first[1]);
    keep_between(l, 0, l->n_first, u, second[0], second[1]);
}

/* Tries planes just before and just behind some pieces of each kind. */
static void try_direction(const list *l, const double *u, plane *best)
{
    const double slack = SLACK * l->all->size;
    measure(l, u);
    for (size_t k = 0; k < 4 * SAMPLES; ++k) {
        const bool second = k >= 2 * SAMPLES;
        const size_t from = second ? l->n_first : 0, n = (second ? l->n : l->n_first) - from;
        const double *span =
            l->all->spans + 2 * (from + n * (k / 2 % SAMPLES * 2 + 1) / (2 * SAMPLES));
        const double at = k % 2 == 0 ? span[0] - 2 * slack : span[1] + 2 * slack;
        const double n_pairs = count_divided(l, at, slack);
        if (n_pairs < best->n_pairs)
            *best = (plane){{u[0], u[1], u[2]}, at, n_pairs};
    }
}

/* ------------------------------------------------------------------ pairs */

/* Appends copies of pieces a to b, of the first kind, and c to d, of the second. */
static list copy(const list *l, size_t a, size_t b, size_t c, size_t d)
{
    iccp_near_pairs *all = l->all;
    const list copies = {all, all->n, b - a + d - c, b - a};
    for (size_t i = 0; i < copies.n && iccp_near_pairs_add(all) != NULL; ++i)
        all->pieces[all->n - 1] = *piece_at(l, i < b - a ? a + i : c + i - (b - a));
    return copies;
}

static void drop(list *l, size_t begin, size_t end)
{
    memmove(piece_at(l, begin), piece_at(l, end), (l->n - end) * sizeof(iccp_piece));
    l->n -= end - begin;
    l->n_first -= end <= l->n_first ? end - begin : 0;
    l->all->n = l->first + l->n;
}

static void compare_at_once(const list *l)
{
    iccp_near_pairs *all = l->all;
    for (size_t i = 0; i < l->n_first; ++i)
        for (size_t j = l->n_first; j < l->n && !all->met; ++j)
            all->met = all->meet(all->context, piece_at(l, i)->item, piece_at(l, j)->item);
}

static bool may_go_on(const list *l)
{
    iccp_near_pairs *all = l->all;
    all->n_free -= (double)l->n;
    if (all->status == ICC_OK && all->n_free < 0)
        all->status = iccp_budget_work(all->env, LOOK * (double)l->n);
    if (all->status == ICC_OK && l->n > 256)
        all->status = iccp_progress(all->env, "check", all->share);
    return all->status == ICC_OK && !all->met;
}

/* Finds the first half of the larger kind. */
static void halve(const list *l, size_t *begin, size_t *middle)
{
    const bool second = 2 * l->n_first < l->n;
    *begin = second ? l->n_first : 0;
    *middle = *begin + (second ? l->n - l->n_first : l->n_first) / 2;
}

/* Compares the first kind with the second. If a plane saves pairs, it compares them on each side of
 * the plane. Otherwise it compares each half of the larger kind, because halves do not reach as
 * far. */
static void compare(list *l)
{
    double u[N_DIRECTIONS][3];
    while (l->n_first > 0 && l->n_first < l->n && may_go_on(l)) {
        if (count_pairs(l) <= FEW * (double)l->n) {
            compare_at_once(l);
            return;
        }
        plane cut = {.n_pairs = HUGE_VAL};
        list_directions(l, u);
        for (size_t k = 0; k < N_DIRECTIONS && l->n_first > 0 && l->n_first < l->n; ++k)
            narrow(l, u[k]);
        if (l->n_first == 0 || l->n_first == l->n)
            return;
        const double n_pairs = count_pairs(l);
        for (size_t k = 0; k < N_DIRECTIONS && cut.n_pairs > ENOUGH * n_pairs; ++k)
            try_direction(l, u[k], &cut);
        size_t begin, middle;
        halve(l, &begin, &middle);
        const bool is_worth = cut.n_pairs < WORTH * n_pairs;
        list part = is_worth    ? copy(l, 0, l->n_first, l->n_first, l->n)
                    : begin > 0 ? copy(l, 0, l->n_first, begin, middle)
                                : copy(l, 0, middle, l->n_first, l->n);
        if (l->all->status != ICC_OK)
            return;
        if (is_worth)
            keep_between(&part, 0, part.n, cut.u, -HUGE_VAL, cut.at - SLACK * l->all->size);
        compare(&part);
        l->all->n = l->first + l->n;
        if (is_worth)
            keep_between(l, 0, l->n, cut.u, cut.at + SLACK * l->all->size, HUGE_VAL);
        else
            drop(l, begin, middle);
    }
}

static bool have_spans(iccp_near_pairs *pairs, size_t n)
{
    if (n > pairs->n_spans && pairs->status == ICC_OK) {
        iccp_free(&pairs->env->memory, pairs->spans);
        pairs->spans = iccp_alloc(&pairs->env->memory, n, 2 * sizeof *pairs->spans);
        pairs->n_spans = pairs->spans != NULL ? n : 0;
        pairs->status = pairs->spans != NULL ? ICC_OK : ICC_ERR_MEMORY;
    }
    return pairs->status == ICC_OK;
}

void iccp_near_pairs_between(iccp_near_pairs *pairs, size_t begin, size_t middle, size_t end)
{
    const list all = {pairs, 0, pairs->n, middle};
    if (!have_spans(pairs, end - begin))
        return;
    list between = copy(&all, begin, middle, middle, end);
    compare(&between);
    pairs->n = all.n;
}

void iccp_near_pairs_within(iccp_near_pairs *pairs, size_t begin, size_t end)
{
    size_t middle = begin + (end - begin) / 2;
    const uint32_t group = end > begin ? pairs->pieces[middle].group : 0;
    while (middle > begin && pairs->pieces[middle - 1].group == group)
        --middle;
    if (middle == begin)
        while (middle < end && pairs->pieces[middle].group == group)
            ++middle;
    if (middle == end)
        return;
    iccp_near_pairs_within(pairs, begin, middle);
    iccp_near_pairs_within(pairs, middle, end);
    iccp_near_pairs_between(pairs, begin, middle, end);
}
