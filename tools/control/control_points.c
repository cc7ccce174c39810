/* Lists of control points. */
#include "control/control_points.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void control_add(control_points *c, const double from[2], const double to[2], size_t line)
{
    size_t n = c->n + 1;
    c->from = grow(c->from, &c->room_from, 2 * n, sizeof *c->from);
    c->to = grow(c->to, &c->room_to, 2 * n, sizeof *c->to);
    c->tolerances = grow(c->tolerances, &c->room_tolerances, n, sizeof *c->tolerances);
    c->lines = grow(c->lines, &c->room_lines, n, sizeof *c->lines);
    c->names = grow(c->names, &c->room_names, n, sizeof *c->names);
    c->turns = grow(c->turns, &c->room_turns, n, sizeof *c->turns);
    memcpy(c->from + 2 * c->n, from, 2 * sizeof *from);
    memcpy(c->to + 2 * c->n, to, 2 * sizeof *to);
    c->tolerances[c->n] = 0;
    c->lines[c->n] = line;
    c->names[c->n] = NULL;
    c->turns[c->n] = NAN;
    c->n = n;
}

void control_name(control_points *c, const char *name, size_t n)
{
    if (n == 0)
        return;
    char *copy = need(n + 1, 1);
    for (size_t i = 0; i < n; i++)
        copy[i] = (unsigned char)name[i] < ' ' || name[i] == 127 ? '?' : name[i];
    free(c->names[c->n - 1]);
    c->names[c->n - 1] = copy;
    c->has_names = true;
}

void control_tolerance(control_points *c, double tolerance)
{
    c->tolerances[c->n - 1] = tolerance;
    c->has_tolerances = c->has_tolerances || tolerance > 0;
}

void control_turn(control_points *c, double degrees)
{
    c->turns[c->n - 1] = degrees;
    c->has_turns = true;
}

void control_free(control_points *c)
{
    for (size_t i = 0; i < c->n; i++)
        free(c->names[i]);
    free(c->from);
    free(c->to);
    free(c->tolerances);
    free(c->lines);
    free(c->names);
    free(c->turns);
    free(c->bones);
    free(c->crs);
    *c = (control_points){0};
}

size_t line_finder_at(line_finder *f, const char *place)
{
    for (; f->at < place; f->at++)
        f->line += *f->at == '\n';
    return f->line;
}
