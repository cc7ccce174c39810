/* Reads the data of an SVG path: subpaths of M L H V C S Q T A Z, absolute or relative. Each is a
 * contour, that is an outline or a hole in one. Subpaths at a single place draw nothing and are
 * ignored.
 *
 * Each curve becomes edges at equal steps of its parameter, and each arc at equal steps of its
 * angle. Without a tolerance there are CURVE_EDGES and ARC_EDGES, whatever the size. So the same
 * path with moved points gives the same number of vertices, and they correspond. With a tolerance
 * they correspond if each of two paths is read with the other's counts as its least. */
#include "cage/cage_readers.h"

#include "base/allocate.h"
#include "base/number.h"
#include "cage/cage_features.h"
#include "cage/contours.h"
#include "cage/svg_arc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CURVE_EDGES = 16, MOST_EDGES = 1024 };

typedef struct pen {
    cage *out;
    const char *at, *end;
    size_t line;
    size_t first;              /* vertex of the subpath */
    size_t n_contours, room;   /* subpaths that draw something */
    size_t *contours;          /* their first vertices */
    bool closed;               /* nothing has been drawn since Z */
    double x, y;               /* where the pen is */
    double start_x, start_y;   /* of the subpath */
    double handle_x, handle_y; /* the last control point of a curve, or else the pen */
    const flattening *flat;
    problem *wrong;
} pen;

static void skip_separators(pen *p)
{
    while (p->at < p->end && strchr(" \t\r\n,", *p->at) != NULL) {
        p->line += *p->at == '\n';
        p->at++;
    }
}

/* Reads a digit, which the next number may follow without a space. */
static bool read_flag(pen *p, double *value)
{
    char shown[32];
    if (p->at >= p->end || (*p->at != '0' && *p->at != '1'))
        return spoilt(p->wrong, p->line, "'%s' in the path where 0 or 1 is expected",
                      quoted(shown, p->at));
    *value = *p->at++ - '0';
    return true;
}

static bool read_numbers(pen *p, char command, size_t n, double *values)
{
    for (size_t i = 0; i < n; i++) {
        skip_separators(p);
        char shown[32];
        const char *word = p->at;
        if (command == 'A' && (i == 3 || i == 4)) {
            if (!read_flag(p, &values[i]))
                return false;
        } else if (p->at >= p->end || number_read(&p->at, &values[i]) != NUMBER_OK)
            return spoilt(p->wrong, p->line, "'%s' in the path where a finite number is expected",
                          quoted(shown, word));
    }
    return true;
}

static void line_to(pen *p, double x, double y)
{
    cage_add(p->out, x, y, p->line);
    p->x = p->handle_x = x;
    p->y = p->handle_y = y;
}

/* A power of two. */
static bool choose_edges(pen *p, double needed, int fixed, int *n)
{
    cage *c = p->out;
    const flattening *f = p->flat;
    bool counts = f->length > 0 && c->n_curves < f->n_least && f->least[c->n_curves] > needed;
    needed = !(f->length > 0) ? fixed : counts ? f->least[c->n_curves] : needed;
    if (!(needed <= MOST_EDGES))
        return spoilt(p->wrong, p->line, "--flatten makes more than %d edges of a curve",
                      MOST_EDGES);
    for (*n = 1; *n < needed;)
        *n *= 2;
    c->curve_edges = grow(c->curve_edges, &c->room_curves, c->n_curves + 1, sizeof(uint32_t));
    c->curve_edges[c->n_curves++] = (uint32_t)*n;
    return true;
}

/* The distance of an edge from the curve is at most an eighth of the second derivative times the
 * squared step. The derivative is greatest at an end. */
static double edges_of_cubic(const pen *p, const double *abcdxy)
{
    double first = hypot(p->x - 2 * abcdxy[0] + abcdxy[2], p->y - 2 * abcdxy[1] + abcdxy[3]);
    double last =
        hypot(abcdxy[0] - 2 * abcdxy[2] + abcdxy[4], abcdxy[1] - 2 * abcdxy[3] + abcdxy[5]);
    return sqrt(6 * fmax(first, last) / (8 * p->flat->length));
}

/* Draws a cubic from the pen over (a, b), (c, d) to (x, y). */
static bool curve_to(pen *p, const double *abcdxy)
{
    double x0 = p->x, y0 = p->y;
    int n;
    if (!choose_edges(p, edges_of_cubic(p, abcdxy), CURVE_EDGES, &n))
        return false;
    for (int i = 1; i < n; i++) {
        double t = (double)i / n, s = 1 - t;
        double w[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        cage_add(p->out, w[0] * x0 + w[1] * abcdxy[0] + w[2] * abcdxy[2] + w[3] * abcdxy[4],
                 w[0] * y0 + w[1] * abcdxy[1] + w[2] * abcdxy[3] + w[3] * abcdxy[5], p->line);
    }
    line_to(p, abcdxy[4], abcdxy[5]);
    p->handle_x = abcdxy[2];
    p->handle_y = abcdxy[3];
    return true;
}

/* Draws a quadratic over (a, b), raised to a cubic. */
static bool quadratic_to(pen *p, double a, double b, double x, double y)
{
    bool good = curve_to(p, (double[]){p->x + (a - p->x) * 2 / 3, p->y + (b - p->y) * 2 / 3,
                                       x + (a - x) * 2 / 3, y + (b - y) * 2 / 3, x, y});
    p->handle_x = a;
    p->handle_y = b;
    return good;
}

static bool arc_to(pen *p, const double *v)
{
    const double from[2] = {p->x, p->y};
    const arc a = {{v[0], v[1]}, v[2], v[3] > 0, v[4] > 0, {v[5], v[6]}};
    double inner[2 * (MOST_EDGES + 1)];
    int n;
    if (!choose_edges(p, arc_edges(from, &a, p->flat->length, MOST_EDGES), ARC_EDGES, &n))
        return false;
    n = arc_inner(inner, n, from, &a);
    for (int i = 0; i < n; i++)
        cage_add(p->out, inner[2 * i], inner[2 * i + 1], p->line);
    line_to(p, v[5], v[6]);
    return true;
}

static size_t numbers_of(char command)
{
    switch (command) {
    case 'M':
    case 'L':
    case 'T':
        return 2;
    case 'H':
    case 'V':
        return 1;
    case 'A':
        return 7;
    case 'C':
        return 6;
    case 'S':
    case 'Q':
        return 4;
    default:
        return 0;
    }
}

/* Draws one step. `previous` decides if the mirrored handle counts for S and T. */
static bool draw(pen *p, char command, char previous, const double *v)
{
    bool after_cubic = previous == 'C' || previous == 'S';
    bool after_quadratic = previous == 'Q' || previous == 'T';
    double mx = 2 * p->x - p->handle_x, my = 2 * p->y - p->handle_y;
    switch (command) {
    case 'M':
        p->start_x = v[0];
        p->start_y = v[1];
        line_to(p, v[0], v[1]);
        break;
    case 'L':
        line_to(p, v[0], v[1]);
        break;
    case 'H':
        line_to(p, v[0], p->y);
        break;
    case 'V':
        line_to(p, p->x, v[0]);
        break;
    case 'A':
        return arc_to(p, v);
    case 'C':
        return curve_to(p, v);
    case 'S':
        return curve_to(p, (double[]){after_cubic ? mx : p->x, after_cubic ? my : p->y, v[0], v[1],
                                      v[2], v[3]});
    case 'Q':
        return quadratic_to(p, v[0], v[1], v[2], v[3]);
    default:
        return quadratic_to(p, after_quadratic ? mx : p->x, after_quadratic ? my : p->y, v[0],
                            v[1]);
    }
    return true;
}

/* Coordinates of lower-case commands are relative to the pen. */
static void make_absolute(const pen *p, char command, size_t n, double *v)
{
    if (command == 'A') { /* only its end point */
        v[5] += p->x;
        v[6] += p->y;
        return;
    }
    for (size_t i = 0; i < n; i++)
        v[i] += command == 'V' || (command != 'H' && i % 2 == 1) ? p->y : p->x;
}

/* Counts the vertices of the subpath without a last one that repeats the first. Returns 0 if the
 * subpath draws nothing. */
static size_t count_drawn(const pen *p)
{
    const cage *c = p->out;
    const double *begin = c->points + 2 * p->first;
    size_t n = c->n - p->first, same = 0, last = n;
    for (size_t i = 0; i < n; i++)
        same += begin[2 * i] == begin[0] && begin[2 * i + 1] == begin[1];
    if (n > 1)
        last -= begin[2 * n - 2] == begin[0] && begin[2 * n - 1] == begin[1];
    return same == n ? 0 : last;
}

/* The next subpath begins after the vertices that the cage has then. Relative commands continue
 * from the start of this subpath. */
static void end_subpath(pen *p)
{
    size_t n = count_drawn(p);
    if (n > 0) {
        p->contours = grow(p->contours, &p->room, p->n_contours + 1, sizeof *p->contours);
        p->contours[p->n_contours++] = p->first;
    }
    p->first = p->out->n = p->first + n;
    p->closed = true;
    p->x = p->handle_x = p->start_x;
    p->y = p->handle_y = p->start_y;
}

/* Reads one command with all groups of numbers that follow it. */
static bool read_command(pen *p, char letter, char *previous)
{
    char command = (char)(letter & ~0x20);
    size_t n = numbers_of(command);
    if (n == 0)
        return spoilt(p->wrong, p->line, "'%c' is not a command of a path",
                      letter > 32 && letter < 127 ? letter : '?');
    if (command != 'M' && p->closed)
        return spoilt(p->wrong, p->line,
                      *previous == '\0'
                          ? "the path does not begin with M"
                          : "the path continues after Z without M; a hole begins with M");
    if (command == 'M' && !p->closed)
        end_subpath(p);
    p->closed = false;
    bool relative = letter >= 'a';
    do {
        double v[7];
        if (!read_numbers(p, command, n, v))
            return false;
        if (relative)
            make_absolute(p, command, n, v);
        if (!draw(p, command, *previous, v))
            return false;
        *previous = command;
        command = command == 'M' ? 'L' : command;
        skip_separators(p);
    } while (p->at < p->end && strchr("+-.0123456789", *p->at) != NULL);
    return true;
}

static bool read_commands(pen *p)
{
    char previous = '\0';
    for (skip_separators(p); p->at < p->end; skip_separators(p)) {
        char letter = *p->at++;
        bool ends = letter == 'Z' || letter == 'z';
        if (ends && previous == '\0')
            return spoilt(p->wrong, p->line, "the path does not begin with M");
        if (ends && !p->closed)
            end_subpath(p);
        else if (!ends && !read_command(p, letter, &previous))
            return false;
    }
    if (!p->closed)
        end_subpath(p);
    return true;
}

/* If there are several contours, each must have three vertices. A single one is checked as a
 * cage. */
static bool check_contours(const pen *p)
{
    for (size_t k = 0; p->n_contours > 1 && k < p->n_contours; k++) {
        size_t end = k + 1 < p->n_contours ? p->contours[k + 1] : p->out->n;
        if (end - p->contours[k] < 3)
            return spoilt(p->wrong, p->out->lines[p->contours[k]],
                          "contour %zu of the path has 2 vertices; a contour has at least 3",
                          k + 1);
    }
    return p->n_contours > 0 || spoilt(p->wrong, p->line, "the path draws nothing");
}

bool cage_read_path(cage *out, const char *data, const char *end, size_t line,
                    const flattening *flat, problem *wrong)
{
    pen p = {.out = out,
             .at = data,
             .end = end,
             .line = line,
             .closed = true,
             .flat = flat,
             .wrong = wrong};
    bool good = read_commands(&p) && check_contours(&p);
    if (good)
        cage_take_contours(out, p.n_contours, p.contours);
    if (good && out->n_more > 0)
        cage_join_outlines(out);
    free(p.contours);
    return good;
}
