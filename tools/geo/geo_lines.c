/* Makes the lines of a geometry of the nodes of its paths, and refines them. */
#include "geo/geo_carriage.h"

#include "base/allocate.h"

#include <math.h>
#include <string.h>

polyline *geo_add_line(carriage *c)
{
    if (c->n_lines == c->room_lines) {
        size_t before = c->room_lines;
        c->lines = grow(c->lines, &c->room_lines, c->n_lines + 1, sizeof *c->lines);
        memset(c->lines + before, 0, (c->room_lines - before) * sizeof *c->lines);
    }
    c->lines[c->n_lines].n = 0;
    return &c->lines[c->n_lines++];
}

vertex geo_vertex_of(const carriage *c, const geo_node *node)
{
    vertex v = {.point = {node->at[0], node->at[1]},
                .image = {NAN, NAN},
                .from = node->from,
                .on_cage = node->place == GEO_ON_CAGE,
                .open = node->in};
    if (node->from != SIZE_MAX) {
        const origin *o = &c->origins[node->from];
        bool same = node->from + 1 < c->shape.n && o[1].from == o->from;
        v.position = node->vertex && o->position;
        v.from = o->from;
        v.along = o->along + node->along * ((same ? o[1].along : 1) - o->along);
    }
    bool mapped = node->vertex && c->status[node->from] == ICC_OK;
    if (mapped)
        memcpy(v.image, c->images + 2 * node->from, sizeof v.image);
    else if (node->place == GEO_ON_CAGE)
        carrier_facet_point(c->cage, 1, node->facet, (double[2]){1 - node->share, node->share},
                            v.image);
    return v;
}

void geo_close_on_cage(carriage *c, polyline *line)
{
    for (size_t i = 0; i + 1 < line->n; i++) {
        vertex *v = &line->vertices[i];
        double share[2];
        if (v->open && v[0].on_cage && v[1].on_cage)
            v->open = noding_common_edge(&c->noding, v[0].point, v[1].point, &share[0],
                                         &share[1]) == GEO_NOWHERE;
    }
}

bool geo_refine_line(carriage *c, polyline *line)
{
    geo_close_on_cage(c, line);
    if (c->edges == NULL)
        return polylines_densify(1, &line, c->cage, c->options->tolerance, c->wrong) == DONE;
    polyline_cut(line, c->edges, c->options->drop);
    return true;
}

/* Adds the path that was noded last as a line, with all nodes or only with its vertices. */
static void add_noded(carriage *c, bool all)
{
    polyline *line = geo_add_line(c);
    for (size_t i = 0; i < c->noding.n; i++) {
        vertex v = geo_vertex_of(c, &c->noding.nodes[i]);
        v.open = all ? v.open : i + 1 < c->noding.n;
        if (all || c->noding.nodes[i].vertex)
            polyline_add(line, &v);
    }
    for (size_t i = 0; i < line->n; i++)
        line->vertices[i].open = line->vertices[i].open && i + 1 < line->n &&
                                 !isnan(line->vertices[i].image[0]) &&
                                 !isnan(line->vertices[i + 1].image[0]);
}

/* Adds a path that meets no edge of the cage as a line. */
static void add_free(carriage *c, size_t path)
{
    polyline *line = geo_add_line(c);
    const geo_path *p = &c->shape.paths[path];
    line->vertices = grow(line->vertices, &line->room, p->n, sizeof *line->vertices);
    line->n = p->n;
    for (size_t k = 0; k < p->n; k++) {
        size_t i = p->first + k;
        const origin *o = &c->origins[i];
        vertex *v = &line->vertices[k];
        *v = (vertex){
            .position = o->position, .from = o->from, .along = o->along, .open = k + 1 < p->n};
        memcpy(v->point, c->shape.points + 2 * i, sizeof v->point);
        memcpy(v->image, c->images + 2 * i, sizeof v->image);
    }
}

bool geo_has_gap(const polyline *line)
{
    for (size_t i = 0; i < line->n; i++)
        if (isnan(line->vertices[i].image[0]))
            return true;
    return false;
}

bool geo_take_paths(carriage *c)
{
    bool whole = true;
    c->n_lines = 0;
    for (size_t p = 0; p < c->shape.n_paths && (whole || c->options->policy == GEO_KEEP); p++) {
        if (noding_is_free(&c->noding, &c->shape, p, c->status, c->snapped)) {
            add_free(c, p);
            continue;
        }
        whole = noding_path(&c->noding, &c->shape, p, c->status, c->snapped) && whole;
        add_noded(c, c->options->policy == GEO_KEEP || c->edges != NULL);
    }
    return whole;
}

bool geo_take_points(carriage *c)
{
    bool whole = true;
    c->n_lines = 0;
    polyline *line = geo_add_line(c);
    for (size_t i = 0; i < c->shape.n; i++) {
        geo_node node = {.at = {c->shape.points[2 * i], c->shape.points[2 * i + 1]},
                         .place = GEO_INSIDE,
                         .vertex = true,
                         .from = i};
        vertex v = geo_vertex_of(c, &node);
        polyline_add(line, &v);
        whole = whole && c->status[i] == ICC_OK;
    }
    return whole;
}
