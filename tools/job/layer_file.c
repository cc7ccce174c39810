/* Reads FeatureCollections of Polygons and MultiPolygons. The value of one property is the name of
 * a region. The library works with numbers: the places of the names in their alphabetical order. */
#include "job/layer_file.h"

#include "base/allocate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void layers_free(layers *l)
{
    for (int side = 0; side < 2; side++) {
        layer *at = &l->side[side];
        for (size_t r = 0; r < at->n_rings; r++)
            free(at->names[r]);
        json_tree_free(&at->tree);
        free(at->text);
        free(at->first);
        free(at->vertices);
        free(at->names);
        free(at->ids);
        free(at->holes);
    }
    free(l->names);
    *l = (layers){0};
}

static bool add_ring(layer *l, const json_item *ring, const char *name, bool is_hole,
                     problem *wrong)
{
    size_t begin = l->n, n = 0;
    for (const json_item *at = json_first(ring); at != NULL; at = json_next(at), n++) {
        const json_item *x = json_first(at), *y = json_next(x);
        if (!json_is(x, JSON_NUMBER) || !json_is(y, JSON_NUMBER) || !isfinite(x->number) ||
            !isfinite(y->number))
            return spoilt(wrong, 0, "vertex %zu of a ring of \"%.60s\" is not a pair of numbers", n,
                          name);
        l->vertices = grow(l->vertices, &l->room, l->n + 1, 2 * sizeof *l->vertices);
        l->vertices[2 * l->n] = x->number;
        l->vertices[2 * l->n++ + 1] = y->number;
    }
    if (n > 1) {
        const double *p = l->vertices + 2 * begin, *q = l->vertices + 2 * (l->n - 1);
        if (p[0] == q[0] && p[1] == q[1])
            l->n--;
    }
    if (l->n - begin < 3)
        return spoilt(wrong, 0, "a ring of \"%.60s\" has fewer than 3 vertices", name);
    l->names = grow(l->names, &l->room_names, l->n_rings + 1, sizeof *l->names);
    l->holes = grow(l->holes, &l->room_holes, l->n_rings + 1, 1);
    l->first = grow(l->first, &l->room_first, l->n_rings + 2, sizeof *l->first);
    l->holes[l->n_rings] = is_hole;
    l->names[l->n_rings] = need(strlen(name) + 1, 1);
    memcpy(l->names[l->n_rings], name, strlen(name) + 1);
    l->first[l->n_rings] = begin;
    l->first[++l->n_rings] = l->n;
    return true;
}

static bool add_polygon(layer *l, const json_item *rings, const char *name, problem *wrong)
{
    bool is_hole = false;
    for (const json_item *ring = json_first(rings); ring != NULL; ring = json_next(ring)) {
        if (!add_ring(l, ring, name, is_hole, wrong))
            return false;
        is_hole = true;
    }
    return true;
}

/* Adds one feature of the file, number `k` from 0. */
static bool add_feature(layer *l, const json_item *feature, size_t k, const char *by,
                        problem *wrong)
{
    char number[40];
    const json_item *value = json_get(json_get(feature, "properties"), by);
    const json_item *shape = json_get(feature, "geometry");
    const char *name = json_string_of(value);
    if (name == NULL && json_is(value, JSON_NUMBER)) {
        snprintf(number, sizeof number, "%.15g", value->number);
        name = number;
    }
    if (name == NULL)
        return spoilt(wrong, 0, "feature %zu has no property \"%.60s\" that is a text or a number",
                      k + 1, by);
    const json_item *coordinates = json_get(shape, "coordinates");
    if (json_has_type(shape, "Polygon"))
        return add_polygon(l, coordinates, name, wrong);
    if (!json_has_type(shape, "MultiPolygon"))
        return spoilt(wrong, 0, "feature %zu, \"%.60s\", is neither Polygon nor MultiPolygon",
                      k + 1, name);
    for (const json_item *p = json_first(coordinates); p != NULL; p = json_next(p))
        if (!add_polygon(l, p, name, wrong))
            return false;
    return true;
}

bool layers_read(layers *l, int side, char *text, size_t n, const char *by, problem *wrong)
{
    layer *at = &l->side[side];
    at->text = text;
    if (!json_tree_read(&at->tree, text, n, wrong))
        return false;
    if (!json_has_type(at->tree.root, "FeatureCollection"))
        return spoilt(wrong, 0, "--by needs a FeatureCollection of GeoJSON");
    size_t k = 0;
    const json_item *all = json_get(at->tree.root, "features");
    for (const json_item *f = json_first(all); f != NULL; f = json_next(f))
        if (!add_feature(at, f, k++, by, wrong))
            return false;
    return at->n_rings > 0 || spoilt(wrong, 0, "there are no polygons");
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

void layers_number(layers *l)
{
    size_t n = l->side[0].n_rings + l->side[1].n_rings, kept = 0;
    l->names = need(n, sizeof *l->names);
    for (int side = 0; side < 2; side++)
        for (size_t r = 0; r < l->side[side].n_rings; r++)
            l->names[l->n_names++] = l->side[side].names[r];
    qsort(l->names, n, sizeof *l->names, by_name);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || strcmp(l->names[k], l->names[k - 1]) != 0)
            l->names[kept++] = l->names[k];
    l->n_names = kept;
    for (int side = 0; side < 2; side++) {
        layer *at = &l->side[side];
        at->ids = need(at->n_rings, sizeof *at->ids);
        for (size_t r = 0; r < at->n_rings; r++) {
            char **found = bsearch(&at->names[r], l->names, kept, sizeof *l->names, by_name);
            at->ids[r] = found - l->names;
        }
    }
}

icc_layer layers_side(const layers *l, int side)
{
    const layer *at = &l->side[side];
    return (icc_layer){.size = sizeof(icc_layer),
                       .n_rings = at->n_rings,
                       .first = at->first,
                       .vertices = at->vertices,
                       .ids = at->ids,
                       .holes = at->holes};
}
