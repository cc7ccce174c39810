#include "cmd/densify.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ROUNDS = 12, MAX_VERTICES = 1 << 24, N_CHECKS = 3 };

void polyline_add(polyline *line, const double point[3])
{
    line->points = grow(line->points, &line->room, 3 * (line->n + 1), sizeof *line->points);
    memcpy(line->points + 3 * line->n++, point, 3 * sizeof *point);
}

void polyline_free(polyline *line)
{
    free(line->points);
    free(line->images);
    *line = (polyline){0};
}

static int map_points(job *j, size_t n, double *points)
{
    icc_status ran = (j->args->inverse ? icc_map_apply_inverse : icc_map_apply)(
        j->map, n, points, points, NULL, NULL, &j->env);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
}

int polyline_map(polyline *line, job *j)
{
    free(line->images);
    line->images = need(line->n, 2 * sizeof *line->images);
    for (size_t i = 0; i < line->n; i++)
        memcpy(line->images + 2 * i, line->points + 3 * i, 2 * sizeof *line->images);
    return map_points(j, line->n, line->images);
}

static double distance_to_segment(const double a[2], const double b[2], const double p[2])
{
    double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    double t = square > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

/* A piece that has an image in part only is split as well, so that the gap begins where the line leaves
 * the cage. */
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

static void point_between(const double a[3], const double b[3], double t, double out[3])
{
    for (size_t k = 0; k < 3; k++)
        out[k] = (1 - t) * a[k] + t * b[k];
}

/* The images of the check points of every open piece. */
static int map_checks(const polyline *line, const unsigned char *open, job *j, double *checks)
{
    size_t n = 0;
    for (size_t i = 0; i + 1 < line->n; i++)
        for (size_t c = 0; open[i] && c < N_CHECKS; c++) {
            double p[3];
            point_between(line->points + 3 * i, line->points + 3 * (i + 1),
                          (double)(c + 1) / (N_CHECKS + 1), p);
            memcpy(checks + 2 * n++, p, 2 * sizeof *checks);
        }
    return map_points(j, n, checks);
}

/* One round: every open piece is closed, or split into two that are open. Returns how many. */
static size_t split(polyline *line, unsigned char **open, const double *checks, double tolerance)
{
    polyline next = {0};
    unsigned char *next_open = need(2 * line->n, 1);
    next.images = need(2 * line->n, 2 * sizeof *next.images);
    size_t n_split = 0;
    for (size_t i = 0; i < line->n; i++) {
        const double *a = line->images + 2 * i;
        memcpy(next.images + 2 * next.n, a, 2 * sizeof *a);
        polyline_add(&next, line->points + 3 * i);
        if (i + 1 == line->n || !(*open)[i])
            continue;
        const double *own = checks;
        checks += 2 * N_CHECKS;
        if (!must_split(a, a + 2, own, tolerance))
            continue;
        double middle[3];
        point_between(line->points + 3 * i, line->points + 3 * (i + 1), 0.5, middle);
        memcpy(next.images + 2 * next.n, own + N_CHECKS / 2 * 2, 2 * sizeof *own);
        next_open[next.n - 1] = next_open[next.n] = 1;
        polyline_add(&next, middle);
        n_split++;
    }
    polyline_free(line);
    free(*open);
    *line = next;
    *open = next_open;
    return n_split;
}

int polyline_densify(polyline *line, job *j, double tolerance)
{
    int result = polyline_map(line, j);
    size_t n_open = line->n > 0 ? line->n - 1 : 0;
    unsigned char *open = need(line->n, 1);
    memset(open, 1, n_open);
    for (size_t round = 0; round < MAX_ROUNDS && n_open > 0 && result == DONE; round++) {
        if (line->n + n_open > MAX_VERTICES)
            result = failed(j->args->operands[0], 0,
                            "--tolerance %g makes a line of more than %d positions", tolerance,
                            MAX_VERTICES);
        double *checks = need(n_open, 2 * N_CHECKS * sizeof *checks);
        if (result == DONE)
            result = map_checks(line, open, j, checks);
        if (result == DONE)
            n_open = 2 * split(line, &open, checks, tolerance);
        free(checks);
    }
    free(open);
    return result;
}
