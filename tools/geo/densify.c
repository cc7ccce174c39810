/* Splits pieces of a line in rounds, and maps the check points of all open pieces at once. */
#include "geo/densify.h"

#include "base/allocate.h"

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

static double distance_to_segment(const double a[2], const double b[2], const double p[2])
{
    double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    double t = square > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

/* A piece with a partial image is split as well, so that the gap begins where the map's does. */
static bool must_split(const double a[2], const double b[2], const double checks[2 * N_CHECKS],
                       double tolerance)
{
    size_t n_missing = (isnan(a[0]) ? 1U : 0U) + (isnan(b[0]) ? 1U : 0U);
    for (size_t c = 0; c < N_CHECKS; c++)
        n_missing += isnan(checks[2 * c]) ? 1 : 0;
    if (n_missing > 0)
        return n_missing < N_CHECKS + 2;
    for (size_t c = 0; c < N_CHECKS; c++)
        if (distance_to_segment(a, b, checks + 2 * c) > tolerance)
            return true;
    return false;
}

static void point_between(const vertex *a, const vertex *b, double t, double out[2])
{
    for (size_t k = 0; k < 2; k++)
        out[k] = (1 - t) * a->point[k] + t * b->point[k];
}

/* Computes the images of the check points of every open piece. */
static icc_status map_checks(const polyline *line, const carrier *c, size_t n_open, double *checks)
{
    size_t n = 0;
    double *points = need(n_open * N_CHECKS, 2 * sizeof *points);
    icc_status *status = need(n_open * N_CHECKS, sizeof *status);
    for (size_t i = 0; i + 1 < line->n; i++)
        for (size_t k = 0; line->vertices[i].open && k < N_CHECKS; k++)
            point_between(&line->vertices[i], &line->vertices[i + 1],
                          (double)(k + 1) / (N_CHECKS + 1), points + 2 * n++);
    icc_status ran = carrier_map(c, n, points, checks, status, NULL);
    free(points);
    free(status);
    return ran;
}

/* The vertex half-way between two vertices. They are at most one position apart unless one is a
 * corner of the cage. */
static vertex middle_of(const vertex *a, const vertex *b, const double image[2])
{
    vertex v = {.image = {image[0], image[1]}, .open = true};
    double at = (double)a->from + a->along, to = (double)b->from + b->along;
    point_between(a, b, 0.5, v.point);
    at = fabs(to - at) <= 1 ? at / 2 + to / 2 : at;
    v.from = (size_t)at;
    v.along = at - (double)v.from;
    return v;
}

/* Does one round: closes every open piece, or splits it into two open pieces. Returns the number of
 * open pieces. */
static size_t split(polyline *line, const double *checks, double tolerance)
{
    polyline next = {0};
    size_t n_open = 0;
    for (size_t i = 0; i < line->n; i++) {
        vertex v = line->vertices[i];
        const double *own = checks;
        bool checked = v.open && i + 1 < line->n;
        checks += checked ? 2 * N_CHECKS : 0;
        v.open = checked && must_split(v.image, line->vertices[i + 1].image, own, tolerance);
        polyline_add(&next, &v);
        if (!v.open)
            continue;
        vertex middle = middle_of(&v, &line->vertices[i + 1], own + N_CHECKS / 2 * 2);
        polyline_add(&next, &middle);
        n_open += 2;
    }
    polyline_free(line);
    *line = next;
    return n_open;
}

int polyline_densify(polyline *line, const carrier *c, double tolerance, problem *wrong)
{
    size_t n_open = 0;
    for (size_t i = 0; i + 1 < line->n; i++)
        n_open += line->vertices[i].open;
    for (size_t round = 0; round < MAX_ROUNDS && n_open > 0; round++) {
        if (line->n + n_open > MAX_VERTICES) {
            spoilt(wrong, 0, "--tolerance %g makes a line of more than %d positions", tolerance,
                   MAX_VERTICES);
            return FAILED;
        }
        double *checks = need(n_open, 2 * N_CHECKS * sizeof *checks);
        icc_status ran = map_checks(line, c, n_open, checks);
        if (ran == ICC_OK)
            n_open = split(line, checks, tolerance);
        free(checks);
        if (ran != ICC_OK) {
            spoilt(wrong, 0, "%s", icc_status_name(ran));
            return FAILED;
        }
    }
    return DONE;
}
