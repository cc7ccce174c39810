/* What it costs to make a domain of a polygon, nearly all of which is the check that it does not
 * meet itself, beside GEOSisValid() where GEOS is installed: nanoseconds a vertex, the least of
 * some runs by turns. GEOS answers in doubles, ours is exact. The last rings are not simple. Then
 * the same of a square with many holes, and of one in which two of them cross.
 * usage: bench_simple [LARGEST] */

#include "bench.h"

#ifdef BENCH_WITH_GEOS
#include <geos_c.h>
#endif

static const double TURN = 6.28318530717958647692;

enum {
    SLOW_GEOS = 10000, /* vertices of a comb: GEOS takes quadratic time */
    OUTER = 4,         /* vertices of a square with holes, which come first */
    HOLE = 16          /* and of each hole */
};

static double uniform(void)
{
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) * 0x1p-53;
}

/* ------------------------------------------------------------------- rings */

typedef void (*maker)(size_t n, double *xy);

static void polar(double *xy, double radius, double angle)
{
    xy[0] = radius * cos(angle);
    xy[1] = radius * sin(angle);
}

static void make_smooth(size_t n, double *xy)
{
    for (size_t i = 0; i < n; ++i) {
        const double angle = TURN * (double)i / (double)n;
        polar(xy + 2 * i, 1 + 0.5 * sin(7 * angle) + 0.2 * sin(31 * angle), angle);
    }
}

/* The same with a rough edge. */
static void make_coast(size_t n, double *xy)
{
    for (size_t i = 0; i < n; ++i) {
        const double angle = TURN * (double)i / (double)n, rough = 20 * uniform() / (double)n;
        polar(xy + 2 * i, 1 + 0.5 * sin(7 * angle) + 0.2 * sin(31 * angle) + rough, angle);
    }
}

/* Sixty turns there and back. */
static void make_spiral(size_t n, double *xy)
{
    const size_t half = n / 2;
    for (size_t i = 0; i < half; ++i) {
        const double angle = 60 * TURN * (double)i / (double)half;
        polar(xy + 2 * i, 1 + angle, angle);
        polar(xy + 2 * (2 * half - 1 - i), 3 + angle, angle);
    }
    for (size_t i = 2 * half; i < n; ++i)
        polar(xy + 2 * i, 2 - 0.1 * (double)(i - 2 * half), 0);
}

/* Stairs up, and a straight way back. */
static void make_stairs(size_t n, double *xy)
{
    for (size_t i = 0; i + 1 < n; ++i) {
        xy[2 * i] = (double)((i + 1) / 2);
        xy[2 * i + 1] = (double)(i / 2);
    }
    xy[2 * n - 2] = -1;
    xy[2 * n - 1] = (double)n;
}

/* Long thin teeth along a diagonal: all their boxes overlap. */
static void make_comb(size_t n, double *xy)
{
    const double width = 1.0 / (double)n;
    for (size_t i = 0; i + 2 < n; ++i) {
        const double u = i % 2 == 0 ? 0 : 1, v = width * (double)i;
        xy[2 * i] = u - v;
        xy[2 * i + 1] = u + v;
    }
    xy[2 * n - 4] = -1.01;
    xy[2 * n - 3] = 0.99;
    xy[2 * n - 2] = xy[2 * n - 1] = -0.01;
}

/* The first quarter crosses the last one. */
static void make_crossed(size_t n, double *xy)
{
    make_coast(n, xy);
    for (size_t i = 0; i < 2; ++i) {
        const double swap = xy[n / 4 * 2 + i];
        xy[n / 4 * 2 + i] = xy[n / 4 * 6 + i];
        xy[n / 4 * 6 + i] = swap;
    }
}

/* A vertex near the end lies on an edge near the beginning. */
static void make_touching(size_t n, double *xy)
{
    make_smooth(n, xy);
    for (size_t i = 0; i < 2; ++i)
        xy[2 * (n - n / 8) + i] = xy[2 * (n / 8) + i];
}

/* In a square, as many holes as n vertices make, in an order that is none. */
static void make_holes(size_t n, double *xy)
{
    static const double square[2 * OUTER] = {0, 0, 1, 0, 1, 1, 0, 1};
    const size_t n_holes = (n - OUTER) / HOLE, side = (size_t)ceil(sqrt((double)n_holes));
    memcpy(xy, square, sizeof square);
    for (size_t h = 0; h < n_holes; ++h) {
        const size_t cell = h * 7919 % n_holes; /* a prime: each once */
        const double x = ((double)(cell % side) + 0.5) / (double)side;
        const double y = ((double)(cell / side) + 0.5) / (double)side;
        for (size_t i = 0; i < HOLE; ++i) {
            double *at = xy + 2 * (OUTER + HOLE * h + i);
            polar(at, (0.3 + 0.1 * uniform()) / (double)side, TURN * (double)i / HOLE);
            at[0] += x;
            at[1] += y;
        }
    }
}

/* A hole in the middle reaches into the next one. */
static void make_crossed_holes(size_t n, double *xy)
{
    make_holes(n, xy);
    double *hole = xy + 2 * (OUTER + (n - OUTER) / HOLE / 2 * HOLE);
    hole[0] += 2 * (hole[0] - hole[HOLE]);
}

/* ----------------------------------------------------------------- timing */

static int has_holes(maker make)
{
    return make == make_holes || make == make_crossed_holes;
}

static double time_ours(size_t n, const double *xy, int *valid)
{
    icc_domain *domain;
    const double start = bench_processor_seconds();
    *valid = icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, NULL) == ICC_OK;
    icc_domain_free(domain);
    return bench_processor_seconds() - start;
}

static double time_ours_holes(size_t n, const double *xy, int *valid)
{
    icc_domain *domain;
    const double start = bench_processor_seconds();
    const size_t n_holes = (n - OUTER) / HOLE;
    icc_feature *holes = bench_alloc(n_holes, sizeof *holes);
    for (size_t h = 0; h < n_holes; ++h)
        holes[h] = (icc_feature){
            sizeof *holes, ICC_FEATURE_HOLE, HOLE, xy + 2 * (OUTER + HOLE * h), 0, 0, NULL};
    *valid = icc_domain_create_features(&domain, OUTER, xy, n_holes, holes, NULL, NULL) == ICC_OK;
    icc_domain_free(domain);
    free(holes);
    return bench_processor_seconds() - start;
}

#ifdef BENCH_WITH_GEOS
static GEOSGeometry *geos_ring(GEOSContextHandle_t geos, size_t n, const double *xy)
{
    GEOSCoordSequence *s = GEOSCoordSeq_create_r(geos, (unsigned)n + 1, 2);
    for (size_t i = 0; i <= n; ++i)
        (void)GEOSCoordSeq_setXY_r(geos, s, (unsigned)i, xy[2 * (i % n)], xy[2 * (i % n) + 1]);
    return GEOSGeom_createLinearRing_r(geos, s);
}

static double time_geos(GEOSContextHandle_t geos, maker make, size_t n, const double *xy,
                        int *valid)
{
    const double start = bench_processor_seconds();
    const size_t n_outer = has_holes(make) ? OUTER : n, n_holes = (n - n_outer) / HOLE;
    GEOSGeometry **holes = bench_alloc(n_holes + 1, sizeof(GEOSGeometry *));
    for (size_t h = 0; h < n_holes; ++h)
        holes[h] = geos_ring(geos, HOLE, xy + 2 * (n_outer + HOLE * h));
    GEOSGeometry *ring = geos_ring(geos, n_outer, xy);
    GEOSGeometry *polygon = GEOSGeom_createPolygon_r(geos, ring, holes, (unsigned)n_holes);
    *valid = GEOSisValid_r(geos, polygon) == 1;
    GEOSGeom_destroy_r(geos, polygon);
    free(holes);
    return bench_processor_seconds() - start;
}
#endif

static void measure(const char *name, maker make, size_t n)
{
    double *xy = bench_alloc(2 * n, sizeof *xy), ours = HUGE_VAL;
    int valid = 0;
    make(n, xy);
#ifdef BENCH_WITH_GEOS
    GEOSContextHandle_t geos = GEOS_init_r();
    const int runs_geos = make != make_comb || n <= SLOW_GEOS;
    double theirs = HUGE_VAL;
    int valid_geos = 0;
#endif
    for (int run = 0; run < (n > 100000 ? 5 : 9); ++run) {
        ours =
            fmin(ours, has_holes(make) ? time_ours_holes(n, xy, &valid) : time_ours(n, xy, &valid));
#ifdef BENCH_WITH_GEOS
        if (runs_geos)
            theirs = fmin(theirs, time_geos(geos, make, n, xy, &valid_geos));
#endif
    }
    (void)printf("%-14s %8zu %-10s %9.1f", name, n, valid ? "simple" : "not simple",
                 1e9 * ours / (double)n);
#ifdef BENCH_WITH_GEOS
    if (runs_geos)
        (void)printf(" %9.1f %7.3f%s", 1e9 * theirs / (double)n, ours / theirs,
                     valid == valid_geos ? "" : "  (GEOS says otherwise)");
    GEOS_finish_r(geos);
#endif
    (void)printf("\n");
    (void)fflush(stdout);
    free(xy);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        maker make;
    } rings[] = {
        {"smooth", make_smooth},     {"coast", make_coast}, {"spiral", make_spiral},
        {"stairs", make_stairs},     {"comb", make_comb},   {"crossed", make_crossed},
        {"touching", make_touching}, {"holes", make_holes}, {"crossed holes", make_crossed_holes}};
    const size_t largest = argc > 1 ? (size_t)strtoull(argv[1], NULL, 10) : 1000000;
    (void)printf("%-14s %8s %-10s %9s %9s %7s\n", "", "n", "", "ours ns", "GEOS ns", "ratio");
    for (size_t n = 1000; n <= largest; n *= 10)
        for (size_t k = 0; k < sizeof rings / sizeof rings[0]; ++k)
            measure(rings[k].name, rings[k].make, n);
    return 0;
}
