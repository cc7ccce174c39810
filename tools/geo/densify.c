/* Splits pieces of lines in rounds, and maps the check points of all open pieces at once. Or cuts
 * them at the map's edges, which takes one round. */
#include "geo/densify.h"

#include "base/allocate.h"
#include "base/extremes.h"
#include "geo/crossing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ROUNDS = 12, MAX_VERTICES = 1 << 24, N_CHECKS = 3 };

void polyline_add(polyline *line, const vertex *v)
{
    line->vertices = grow(line->vertices, &line->room, line->n + 1, sizeof *line->vertices);
    line->vertices[line->n++] = *v;
}

void polyline_free(polyline *line)
{
    free(line->vertices);
    *line = (polyline){0};
}

/* The way from the nearest point of a segment to p. */
static void way_from_segment(const double a[2], const double b[2], const double p[2], double way[2])
{
    double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    double t = square > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square : 0;
    t = lesser(greater(t, 0), 1);
    way[0] = p[0] - a[0] - t * dx;
    way[1] = p[1] - a[1] - t * dy;
}

static double distance_to_segment(const double a[2], const double b[2], const double p[2])
{
    double way[2];
    way_from_segment(a, b, p, way);
    return hypot(way[0], way[1]);
}

/* True if hypot() of a way is above a limit. Squares tell, unless they are very close to each other,
 * or small enough to underflow. */
static bool is_longer(const double way[2], double limit)
{
    const double slack = 1e-12, tiny = 1e-280;
    double square = way[0] * way[0] + way[1] * way[1], most = limit * limit;
    if (square < most * (1 - slack) && most > tiny)
        return false;
    if (square > most * (1 + slack) && square > tiny && limit >= 0)
        return true;
    return hypot(way[0], way[1]) > limit;
}

/* A piece with a partial image is split as well, so that the gap begins where the map's does. The
 * answer is the same for the piece in the other direction. */
static bool must_split(const double a[2], const double b[2], const double checks[2 * N_CHECKS],
                       double tolerance)
{
    bool swapped = point_before(b, a);
    const double *from = swapped ? b : a, *to = swapped ? a : b;
    size_t n_missing = (isnan(a[0]) ? 1U : 0U) + (isnan(b[0]) ? 1U : 0U);
    for (size_t c = 0; c < N_CHECKS; c++)
        n_missing += isnan(checks[2 * c]) ? 1 : 0;
    if (n_missing > 0)
        return n_missing < N_CHECKS + 2;
    for (size_t c = 0; c < N_CHECKS; c++) {
        double way[2];
        way_from_segment(from, to, checks + 2 * c, way);
        if (is_longer(way, tolerance))
            return true;
    }
    return false;
}

static void point_between(const vertex *a, const vertex *b, double t, double out[2])
{
    for (size_t k = 0; k < 2; k++)
        out[k] = (1 - t) * a->point[k] + t * b->point[k];
}

/* Computes the images of the check points of every open piece. */
static icc_status map_checks(size_t n_lines, polyline *const *lines, const carrier *c,
                             size_t n_open, double *checks)
{
    size_t n = 0;
    double *points = need(n_open * N_CHECKS, 2 * sizeof *points);
    icc_status *status = need(n_open * N_CHECKS, sizeof *status);
    for (size_t l = 0; l < n_lines; l++) {
        const vertex *v = lines[l]->vertices;
        for (size_t i = 0; i + 1 < lines[l]->n; i++)
            for (size_t k = 0; v[i].open && k < N_CHECKS; k++)
                point_between(&v[i], &v[i + 1], (double)(k + 1) / (N_CHECKS + 1), points + 2 * n++);
    }
    icc_status ran = carrier_map(c, n, points, checks, status, NULL);
    free(points);
    free(status);
    return ran;
}

/* The vertex at a share of the way between two vertices. They are at most one position apart unless
 * one is a corner of the cage. */
static vertex vertex_between(const vertex *a, const vertex *b, double t, const double image[2])
{
    vertex v = {.image = {image[0], image[1]}, .open = true};
    double at = (double)a->from + a->along, to = (double)b->from + b->along;
    point_between(a, b, t, v.point);
    at = fabs(to - at) <= 1 ? (1 - t) * at + t * to : at;
    v.from = (size_t)at;
    /* Rounding may reach the next position. */
    v.from -= v.from > a->from && v.from == b->from && !(b->along > 0);
    v.along = at - (double)v.from;
    return v;
}

/* Closes all open pieces if all are straight enough. */
static bool close_straight(polyline *line, const double *checks, double tolerance)
{
    for (size_t i = 0; i + 1 < line->n; i++) {
        const vertex *v = &line->vertices[i];
        if (v->open && must_split(v->image, v[1].image, checks, tolerance))
            return false;
        checks += v->open ? 2 * N_CHECKS : 0;
    }
    for (size_t i = 0; i < line->n; i++)
        line->vertices[i].open = false;
    return true;
}

/* Does one round for a line: closes every open piece, or splits it into two open pieces. */
static void split(polyline *line, const double *checks, double tolerance)
{
    polyline next = {0};
    if (close_straight(line, checks, tolerance))
        return;
    for (size_t i = 0; i < line->n; i++) {
        vertex v = line->vertices[i];
        const double *own = checks;
        bool checked = v.open && i + 1 < line->n;
        checks += checked ? 2 * N_CHECKS : 0;
        v.open = checked && must_split(v.image, line->vertices[i + 1].image, own, tolerance);
        polyline_add(&next, &v);
        if (!v.open)
            continue;
        vertex middle = vertex_between(&v, &line->vertices[i + 1], 0.5, own + N_CHECKS / 2 * 2);
        polyline_add(&next, &middle);
    }
    polyline_free(line);
    *line = next;
}

static size_t count_open(const polyline *line)
{
    size_t n = 0;
    for (size_t i = 0; i + 1 < line->n; i++)
        n += line->vertices[i].open;
    return n;
}

/* Counts the open pieces of all lines. False if a line gets too long. */
static bool count_all(size_t n, polyline *const *lines, size_t *n_open)
{
    *n_open = 0;
    for (size_t l = 0; l < n; l++) {
        size_t own = count_open(lines[l]);
        *n_open += own;
        if (own > 0 && lines[l]->n + own > MAX_VERTICES)
            return false;
    }
    return true;
}

/* Does one round for all lines. */
static icc_status split_all(size_t n, polyline *const *lines, const carrier *c, size_t n_open,
                            double tolerance)
{
    double *checks = need(n_open, 2 * N_CHECKS * sizeof *checks);
    const double *own = checks;
    icc_status ran = map_checks(n, lines, c, n_open, checks);
    for (size_t l = 0; l < n && ran == ICC_OK; l++) {
        size_t own_open = count_open(lines[l]);
        split(lines[l], own, tolerance);
        own += 2 * N_CHECKS * own_open;
    }
    free(checks);
    return ran;
}

int polylines_densify(size_t n, polyline *const *lines, const carrier *c, double tolerance,
                      problem *wrong)
{
    for (size_t round = 0; round < MAX_ROUNDS; round++) {
        size_t n_open;
        if (!count_all(n, lines, &n_open)) {
            spoilt(wrong, 0, "--tolerance %g makes a line of more than %d positions", tolerance,
                   MAX_VERTICES);
            return FAILED;
        }
        if (n_open == 0)
            return DONE;
        icc_status ran = split_all(n, lines, c, n_open, tolerance);
        if (ran != ICC_OK) {
            spoilt(wrong, 0, "%s", icc_status_name(ran));
            return FAILED;
        }
    }
    return DONE;
}

/* A part of a piece whose inner cuts may be left out: between cuts `first` and `last`, where 0 and
 * n + 1 are the ends. */
typedef struct span {
    size_t first, last;
} span;

/* The image of cut i of 1 .. n, or of an end of the piece. */
static const double *cut_image(const map_edges *e, const double ends[4], size_t i)
{
    return i == 0 ? ends : i > e->n_cuts ? ends + 2 : e->cuts[i - 1].image;
}

/* The inner cut of a part whose image is farthest from the straight line, or 0 if all are within
 * the tolerance. */
static size_t farthest_cut(const map_edges *e, const double ends[4], span part, double tolerance)
{
    size_t best = 0;
    double most = tolerance;
    for (size_t i = part.first + 1; i < part.last; i++) {
        double off = distance_to_segment(cut_image(e, ends, part.first),
                                         cut_image(e, ends, part.last), cut_image(e, ends, i));
        best = off > most ? i : best;
        most = greater(off, most);
    }
    return best;
}

/* Leaves out cuts, by the method of Ramer, Douglas and Peucker. `ends` are the images of the ends
 * in the order of the cuts. */
static void thin_cuts(map_edges *e, const double ends[4], double tolerance)
{
    size_t n_parts = 0, n = 0;
    bool *kept = need(e->n_cuts + 2, sizeof *kept);
    span *parts = need(e->n_cuts + 2, sizeof *parts);
    parts[n_parts++] = (span){0, e->n_cuts + 1};
    while (n_parts > 0) {
        span part = parts[--n_parts];
        size_t cut = farthest_cut(e, ends, part, tolerance);
        if (cut == 0)
            continue;
        kept[cut] = true;
        parts[n_parts++] = (span){part.first, cut};
        parts[n_parts++] = (span){cut, part.last};
    }
    for (size_t i = 0; i < e->n_cuts; i++)
        if (kept[i + 1])
            e->cuts[n++] = e->cuts[i];
    e->n_cuts = n;
    free(kept);
    free(parts);
}

/* Adds the cuts between two vertices. */
static void add_cuts(polyline *line, map_edges *e, const vertex *a, const vertex *b,
                     double tolerance)
{
    bool swapped = point_before(b->point, a->point);
    const vertex *from = swapped ? b : a, *to = swapped ? a : b;
    map_edges_cut(e, from->point, to->point);
    if (tolerance > 0)
        thin_cuts(e, (double[4]){from->image[0], from->image[1], to->image[0], to->image[1]},
                  tolerance);
    for (size_t i = 0; i < e->n_cuts; i++) {
        const edge_cut *cut = &e->cuts[swapped ? e->n_cuts - 1 - i : i];
        vertex v = vertex_between(a, b, swapped ? 1 - cut->share : cut->share, cut->image);
        v.open = false;
        polyline_add(line, &v);
    }
}

void polyline_cut(polyline *line, map_edges *edges, double tolerance)
{
    polyline cut = {0};
    for (size_t i = 0; i < line->n; i++) {
        vertex v = line->vertices[i];
        bool open = v.open && i + 1 < line->n;
        v.open = false;
        polyline_add(&cut, &v);
        if (open)
            add_cuts(&cut, edges, &v, &line->vertices[i + 1], tolerance);
    }
    polyline_free(line);
    *line = cut;
}
