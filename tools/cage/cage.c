/* Functions that the readers of cages share. */
#include "cage/cage.h"

#include "base/allocate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void cage_add_point(cage *c, const double *at, size_t line)
{
    c->points = grow(c->points, &c->room_points, c->dim * (c->n + 1), sizeof *c->points);
    c->lines = grow(c->lines, &c->room_lines, c->n + 1, sizeof *c->lines);
    memcpy(c->points + c->dim * c->n, at, c->dim * sizeof *at);
    c->lines[c->n++] = line;
}

void cage_add(cage *c, double x, double y, size_t line)
{
    cage_add_point(c, (const double[2]){x, y}, line);
}

static void add_triangle(cage *c, const uint32_t corners[3], size_t line)
{
    c->facets = grow(c->facets, &c->room_facets, 3 * (c->n_facets + 1), sizeof *c->facets);
    c->facet_lines =
        grow(c->facet_lines, &c->room_facet_lines, c->n_facets + 1, sizeof *c->facet_lines);
    memcpy(c->facets + 3 * c->n_facets, corners, 3 * sizeof *corners);
    c->facet_lines[c->n_facets++] = line;
}

void cage_add_corner(cage *c, size_t k, uint32_t vertex, size_t line)
{
    c->fan[k < 2 ? k : 2] = vertex;
    if (k < 2)
        return;
    add_triangle(c, c->fan, line);
    c->fan[1] = vertex;
}

void points_flip_y(size_t n, double *points)
{
    for (size_t i = 0; i < n; i++)
        points[2 * i + 1] = 0 - points[2 * i + 1];
}

void cage_flip_y(cage *c)
{
    c->flipped = !c->flipped;
    points_flip_y(c->n, c->points);
    for (size_t i = 0; i < c->n_features; i++)
        points_flip_y(c->features[i].n, c->features[i].points);
    for (size_t i = 0; i < c->n_ties; i++)
        points_flip_y(c->ties[i].n, c->ties[i].points);
    for (size_t i = 0; i < c->n_more; i++)
        cage_flip_y(&c->more[i]);
}

double cage_given_y(const cage *c, const double *point)
{
    return c->flipped ? 0 - point[1] : point[1];
}

void cage_free(cage *c)
{
    free(c->points);
    free(c->lines);
    free(c->facets);
    free(c->facet_lines);
    free(c->cells);
    for (size_t i = 0; i < c->n_features; i++) {
        free(c->features[i].points);
        free(c->features[i].label);
        free(c->features[i].facets);
    }
    for (size_t i = 0; i < c->n_ties; i++)
        free(c->ties[i].points);
    for (size_t i = 0; i < c->n_more; i++)
        cage_free(&c->more[i]);
    free(c->more);
    free(c->features);
    free(c->ties);
    free(c->curve_edges);
    free(c->simplices);
    free(c->mesh_vertices);
    *c = (cage){0};
}

const char *choice_text(char out[64], const char *named)
{
    char key[32], value[32];
    size_t n = strcspn(named, "=");
    bool paired = named[n] == '=';
    quoted(value, named + (paired ? n + 1 : 0));
    if (paired)
        snprintf(out, 64, "%.*s \"%s\"", (int)(n < 24 ? n : 24), quoted(key, named), value);
    else
        snprintf(out, 64, "the id \"%s\"", value);
    return out;
}

const char *cage_role_name(cage_role role)
{
    return role == CAGE_SOURCE ? "source" : "target";
}
