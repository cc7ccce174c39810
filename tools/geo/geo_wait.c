/* Geometries that wait until the lines of many are refined together, which costs less than one by
 * one. */
#include "geo/geo_carriage.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

/* Exchanges the current geometry and one that waits. */
static void exchange(carriage *c, waiting *w)
{
    waiting own = {
        .read = c->read, .lines = c->lines, .n_lines = c->n_lines, .room_lines = c->room_lines};
    c->read = w->read;
    c->lines = w->lines;
    c->n_lines = w->n_lines;
    c->room_lines = w->room_lines;
    w->read = own.read;
    w->lines = own.lines;
    w->n_lines = own.n_lines;
    w->room_lines = own.room_lines;
}

/* Refines the lines of all geometries that wait. */
static bool refine_waiting(carriage *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n_waiting; i++)
        n += c->waits[i].n_lines;
    polyline **lines = need(n, sizeof *lines);
    n = 0;
    for (size_t i = 0; i < c->n_waiting; i++)
        for (size_t l = 0; l < c->waits[i].n_lines; l++) {
            lines[n] = &c->waits[i].lines[l];
            geo_close_on_cage(c, lines[n++]);
        }
    bool good = polylines_densify(n, lines, c->cage, c->options->tolerance, c->wrong) == DONE;
    free(lines);
    return good;
}

bool geo_flush(carriage *c)
{
    uint32_t current = c->object;
    bool good = refine_waiting(c);
    for (size_t i = 0; i < c->n_waiting && good; i++) {
        waiting *w = &c->waits[i];
        bool writes = true;
        exchange(c, w);
        c->object = w->object;
        for (size_t l = 0; l < c->n_lines && c->options->policy != GEO_KEEP; l++)
            writes = writes && !geo_has_gap(&c->lines[l]);
        good = (writes || geo_take_shape(c)) && geo_end(c, w->n_without, w->whole, writes);
        exchange(c, w);
    }
    c->n_waiting = c->n_vertices = 0;
    c->object = current;
    return good;
}

bool geo_wait(carriage *c, size_t n_without, bool whole)
{
    enum { ENOUGH = 8192 }; /* vertices */
    if (c->n_waiting == c->room_waiting) {
        size_t before = c->room_waiting;
        c->waits = grow(c->waits, &c->room_waiting, c->n_waiting + 1, sizeof *c->waits);
        memset(c->waits + before, 0, (c->room_waiting - before) * sizeof *c->waits);
    }
    waiting *w = &c->waits[c->n_waiting++];
    exchange(c, w);
    w->object = c->object;
    w->n_without = n_without;
    w->whole = whole;
    for (size_t l = 0; l < w->n_lines; l++)
        c->n_vertices += w->lines[l].n;
    return c->n_vertices < ENOUGH || geo_flush(c);
}

bool geo_flush_before(carriage *c)
{
    if (c->n_waiting == 0)
        return true;
    return geo_flush(c) && geo_take_shape(c);
}

void geo_waits_free(carriage *c)
{
    for (size_t i = 0; i < c->room_waiting; i++) {
        waiting *w = &c->waits[i];
        for (size_t l = 0; l < w->room_lines; l++)
            polyline_free(&w->lines[l]);
        free(w->lines);
        geo_shape_free(&w->read);
    }
    free(c->waits);
}
