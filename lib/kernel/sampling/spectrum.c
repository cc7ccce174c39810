/* Finds the kernel width from the spectrum of the samples: thesis, sections 3.2 and 6.2.1, figure
 * 6.10.
 *
 * The spectrum of blue noise is an impulse at the origin, a region with almost nothing, and then a
 * rise to a ring. A kernel whose own spectrum stays within that region cannot distinguish the
 * samples from a continuum. For a grid of spacing T, the thesis puts the nearest impulses, at 2 pi
 * / T, at six standard deviations of the Gaussian's spectrum (3.28). Here the rise takes their
 * place. */
#include "kernel/sampling/spectrum.h"

#include "base/memory.h"
#include "base/threads.h"
#include "math/elementary.h"

#include <math.h>
#include <stdbool.h>

enum { N_DIRECTIONS = 96 };

/* Largest wave number, in 2 pi / spacing. A hexagonal lattice has its ring at 1.15. */
static const double HIGHEST = 1.5;
/* The ring of evenly spread points lies above this wave number. */
static const double LOWEST = 0.7;
/* The power of random points is 1, and half of it marks the rise. */
static const double RISE = 0.5;
static const double DEVIATIONS = 6;
/* Fewer points hide the rise in the shape's own spectrum. More points let peaks fall between the
 * sampled directions. */
enum { FEWEST = 200, MOST = 1500 };

static const double TWO_PI = 6.28318530717958648;
/* The golden angle, (3 - sqrt 5) / 2 turns. */
static const double GOLDEN = 0.38196601125010515;

/* Directions cover half a circle, or half a sphere by a spiral of equal areas. */
static void direction(size_t dim, size_t i, double *u)
{
    const double share = ((double)i + 0.5) / N_DIRECTIONS;
    if (dim == 2) {
        iccp_cis_turns(0.5 * share, u);
        return;
    }
    const double flat = sqrt(1 - share * share);
    iccp_cis_turns(GOLDEN * (double)i, u);
    u[0] *= flat;
    u[1] *= flat;
    u[2] = share;
}

typedef struct transform {
    size_t dim, n;
    const double *points;
    double step;
    double power[N_DIRECTIONS][ICCP_SPECTRUM_BINS];
} transform;

/* Each point's phase turns by the same angle from bin to bin. */
static void transform_along(const transform *t, const double *u, double *power)
{
    double re[ICCP_SPECTRUM_BINS] = {0}, im[ICCP_SPECTRUM_BINS] = {0};
    for (size_t i = 0; i < t->n; ++i) {
        double along = 0;
        for (size_t k = 0; k < t->dim; ++k)
            along += u[k] * (t->points[t->dim * i + k] - t->points[k]);
        double z[2];
        iccp_cis_turns(t->step * along, z);
        double x = z[0], y = z[1];
        for (size_t b = 0; b < ICCP_SPECTRUM_BINS; ++b) {
            const double turned = x * z[0] - y * z[1];
            re[b] += x;
            im[b] += y;
            y = x * z[1] + y * z[0];
            x = turned;
        }
    }
    for (size_t b = 0; b < ICCP_SPECTRUM_BINS; ++b)
        power[b] = (re[b] * re[b] + im[b] * im[b]) / (double)t->n;
}

static icc_status transform_chunk(void *argument, size_t begin, size_t end)
{
    transform *t = argument;
    for (size_t i = begin; i < end; ++i) {
        double u[3];
        direction(t->dim, i, u);
        transform_along(t, u, t->power[i]);
    }
    return ICC_OK;
}

icc_status iccp_spectrum(size_t dim, size_t n, const double *points, double step,
                         double power[ICCP_SPECTRUM_BINS], const iccp_env *env)
{
    transform *t = iccp_alloc(&env->memory, 1, sizeof *t);
    if (t == NULL)
        return ICC_ERR_MEMORY;
    t->dim = dim;
    t->n = n;
    t->points = points;
    t->step = step;
    const icc_status status = iccp_for_chunks(env, "check", N_DIRECTIONS, 1, transform_chunk, t);
    for (size_t b = 0; status == ICC_OK && b < ICCP_SPECTRUM_BINS; ++b) {
        power[b] = 0;
        for (size_t i = 0; i < N_DIRECTIONS; ++i)
            power[b] += t->power[i][b] / N_DIRECTIONS;
    }
    iccp_free(&env->memory, t);
    return status;
}

static double smooth(const double *power, size_t b)
{
    return (power[b - 1] + power[b] + power[b + 1]) / 3;
}

/* Returns the wave number of the rise, in 2 pi over the spacing. Searches downward from the ring,
 * because far below it the shape itself shows where it is narrow. Returns 1, as for a grid, if
 * there is no ring. */
static double find_rise(const double *power)
{
    const double bin = HIGHEST / ICCP_SPECTRUM_BINS;
    const size_t lowest = (size_t)(LOWEST / bin);
    size_t ring = lowest;
    for (size_t b = lowest; b + 1 < ICCP_SPECTRUM_BINS; ++b)
        ring = smooth(power, b) > smooth(power, ring) ? b : ring;
    size_t b = ring;
    while (b > lowest && smooth(power, b - 1) >= RISE)
        --b;
    if (b == lowest || smooth(power, ring) < RISE)
        return 1;
    const double above = smooth(power, b), below = smooth(power, b - 1);
    return bin * ((double)(b + 1) - (above - RISE) / (above - below));
}

/* Copies the points in a box around the middle one of the list, at most MOST of them. The box gives
 * a piece of the shape that is as wide as it is high. The beginning of the list would be a
 * strip. */
static size_t cut_out(size_t dim, size_t n, const double *points, double spacing, double *piece)
{
    const double half = 0.5 * spacing * iccp_pow((double)MOST, 1 / (double)dim);
    const double *centre = points + dim * (n / 2);
    size_t n_piece = 0;
    for (size_t i = 0; i < n && n_piece < MOST; ++i) {
        bool inside = true;
        for (size_t k = 0; k < dim; ++k)
            inside &= fabs(points[dim * i + k] - centre[k]) <= half;
        for (size_t k = 0; inside && k < dim; ++k)
            piece[dim * n_piece + k] = points[dim * i + k];
        n_piece += inside;
    }
    return n_piece;
}

icc_status iccp_spectrum_sigma(size_t dim, size_t n, const double *points, double spacing,
                               double *sigma, const iccp_env *env)
{
    double power[ICCP_SPECTRUM_BINS], rise = 1;
    double *piece = iccp_alloc(&env->memory, MOST, dim * sizeof *piece);
    if (piece == NULL)
        return ICC_ERR_MEMORY;
    const size_t n_piece = n > 0 ? cut_out(dim, n, points, spacing, piece) : 0;
    icc_status status = ICC_OK;
    if (n_piece >= FEWEST)
        status = iccp_spectrum(dim, n_piece, piece, HIGHEST / (spacing * ICCP_SPECTRUM_BINS), power,
                               env);
    if (n_piece >= FEWEST && status == ICC_OK)
        rise = find_rise(power);
    iccp_free(&env->memory, piece);
    *sigma = DEVIATIONS / TWO_PI * spacing / rise;
    return status;
}
