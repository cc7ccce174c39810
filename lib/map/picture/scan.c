/* Finds the pixels of a triangle by scan conversion with half-open intervals: Foley, van Dam,
 * Feiner and Hughes, Computer Graphics, section 3.6. Two triangles that share an edge compute its
 * crossing with a row from the same numbers, always from its lower end. So there is neither a gap
 * nor an overlap between them. The order of the corners decides which edge is the left one, and
 * rounded crossings do not.
 *
 * Positions in the source are interpolated along the edges and then along the row. So they stay
 * between the corners even in the thinnest triangle. */
#include "map/picture/scan.h"

#include "base/compiler.h"
#include "math/elementary.h"

#include <math.h>

/* Largest distance between two samples, in pixels of the source. A bilinear sample reads two
 * pixels, so even 1.25 would miss none. The value was found with a zone plate whose rings are too
 * fine for the target. A spacing of 1.25 leaves 54 % of their contrast, and 1.1 leaves 32 %, as
 * much as a mean over whole pixels. */
static const double STEP = 1.1;

/* Relative; well above the rounding of a place among samples. */
static const double UNSURE = 1e-12;

static iccp_edge make_edge(const iccp_place *a, const iccp_place *b)
{
    const double height = b->y - a->y;
    return (iccp_edge){
        *a, {(b->x - a->x) / height, height, (b->u - a->u) / height, (b->v - a->v) / height}};
}

int32_t iccp_samples_for(double distance)
{
    const double n = ceil(distance / STEP);
    return !(n > 1) ? 1 : n < ICCP_MOST_SAMPLES ? (int32_t)n : ICCP_MOST_SAMPLES;
}

/* Chooses the number of samples from the distance in the source between neighbouring columns and
 * rows. */
static void choose_samples(iccp_scan *scan, const iccp_place *const p[3])
{
    const double ax = p[1]->x - p[0]->x, ay = p[1]->y - p[0]->y;
    const double bx = p[2]->x - p[0]->x, by = p[2]->y - p[0]->y;
    const double au = p[1]->u - p[0]->u, av = p[1]->v - p[0]->v;
    const double bu = p[2]->u - p[0]->u, bv = p[2]->v - p[0]->v;
    const double area = ax * by - ay * bx;
    scan->columns = iccp_samples_for(iccp_hypot(au * by - bu * ay, av * by - bv * ay) / fabs(area));
    scan->rows = iccp_samples_for(iccp_hypot(bu * ax - au * bx, bv * ax - av * bx) / fabs(area));
}

void iccp_scan_create(iccp_scan *scan, const iccp_place *const places[3])
{
    const iccp_place *p[3] = {places[0], places[1], places[2]};
    static const int pairs[3][2] = {{0, 1}, {1, 2}, {0, 1}};
    bool even = true;
    for (int k = 0; k < 3; ++k) {
        const int i = pairs[k][0], j = pairs[k][1];
        if (p[j]->y < p[i]->y) {
            const iccp_place *other = p[i];
            p[i] = p[j];
            p[j] = other;
            even = !even;
        }
    }
    scan->whole = make_edge(p[0], p[2]);
    scan->first = make_edge(p[0], p[1]);
    scan->second = make_edge(p[1], p[2]);
    scan->top = p[2]->y;
    scan->whole_left = even;
    choose_samples(scan, places);
}

/* Returns the first k with (k + 1/2) / n >= x, clamped to [0, end]. */
static ICCP_INLINE int64_t first_sample(double x, int32_t n, int64_t end)
{
    const double place = x * n;
    if (!(x > 0))
        return 0;
    if (!(place < (double)end))
        return end;
    /* Rounding almost never matters. If it might, the definition decides. */
    int64_t k = (int64_t)(place + 0.5);
    if (0.5 - fabs(place - (double)k) > UNSURE * place)
        return k;
    while (k > 0 && ((double)k - 0.5) / n >= x)
        --k;
    while (k < end && ((double)k + 0.5) / n < x)
        ++k;
    return k;
}

static ICCP_INLINE iccp_place crossing(const iccp_edge *e, double y)
{
    const double t = y - e->start.y;
    return (iccp_place){e->start.x + t * e->slope.x, y, e->start.u + t * e->slope.u,
                        e->start.v + t * e->slope.v};
}

/* Finds the run of samples at one height. Returns false if there is none. */
static ICCP_INLINE bool scan_row(const iccp_scan *scan, double y, int32_t n, int32_t width,
                                 size_t *begin, iccp_line *line)
{
    if (!(scan->whole.start.y <= y && y < scan->top))
        return false;
    const iccp_place whole = crossing(&scan->whole, y);
    const iccp_place broken = crossing(y < scan->second.start.y ? &scan->first : &scan->second, y);
    const iccp_place *left = scan->whole_left ? &whole : &broken;
    const iccp_place *right = scan->whole_left ? &broken : &whole;
    const int64_t all = (int64_t)width * n;
    const int64_t first = first_sample(left->x, n, all);
    const int64_t end = first_sample(right->x, n, all);
    if (first >= end)
        return false;
    const double rate = 1 / (right->x - left->x);
    const double du = (right->u - left->u) * rate, dv = (right->v - left->v) * rate;
    const double ahead = ((double)first + 0.5) / n - left->x;
    *begin = (size_t)first;
    *line = (iccp_line){left->u + ahead * du, left->v + ahead * dv, du / n, dv / n,
                        (size_t)(end - first)};
    return true;
}

static ICCP_INLINE size_t scan_rows(const iccp_scan *scan, int32_t begin, int32_t end,
                                    int32_t columns, int32_t rows, int32_t width, iccp_run *runs)
{
    size_t n = 0;
    for (int32_t row = begin; row < end && row < scan->top; ++row)
        for (int32_t k = 0; k < rows && scan->whole.start.y < (double)row + 1; ++k) {
            const double y = ((double)row * rows + k + 0.5) / rows;
            runs[n].row = row;
            n += scan_row(scan, y, columns, width, &runs[n].begin, &runs[n].line);
        }
    return n;
}

/* One sample in a pixel needs no divisions by the numbers of samples. */
size_t iccp_scan_rows(const iccp_scan *scan, int32_t begin, int32_t end, int32_t columns,
                      int32_t rows, int32_t width, iccp_run *runs)
{
    return columns == 1 && rows == 1 ? scan_rows(scan, begin, end, 1, 1, width, runs)
                                     : scan_rows(scan, begin, end, columns, rows, width, runs);
}
