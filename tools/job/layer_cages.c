/* Reads two layers of GeoJSON, each a FeatureCollection of Polygons and MultiPolygons. The value of
 * one property is the name of a region. The library works with numbers: the places of the names in
 * their alphabetical order. Its messages get the names back. */
#include "job/layer_cages.h"

#include "base/allocate.h"
#include "base/file.h"
#include "base/json_tree.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct layer {
    json_tree tree;
    char *text;
    size_t n_rings, n, room, room_first, room_names, room_holes;
    size_t *first;
    double *vertices;
    char **names; /* of each ring */
    int64_t *ids;
    uint8_t *holes;
} layer;

typedef struct layers {
    layer side[2];
    char **names; /* different ones, sorted */
    size_t n_names;
} layers;

static void layers_free(layers *l)
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

static bool read_layer(layer *l, size_t n, const char *by, problem *wrong)
{
    if (!json_tree_read(&l->tree, l->text, n, wrong))
        return false;
    if (!json_has_type(l->tree.root, "FeatureCollection"))
        return spoilt(wrong, 0, "--by needs a FeatureCollection of GeoJSON");
    size_t k = 0;
    const json_item *all = json_get(l->tree.root, "features");
    for (const json_item *f = json_first(all); f != NULL; f = json_next(f))
        if (!add_feature(l, f, k++, by, wrong))
            return false;
    return l->n_rings > 0 || spoilt(wrong, 0, "there are no polygons");
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Numbers the names of both layers. */
static void number_names(layers *l)
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

/* Copies a message of the library, with names instead of the numbers behind "region". */
static void with_names(char *out, size_t room, const layers *l, const char *message)
{
    size_t n = 0;
    bool is_number = false;
    while (*message != '\0' && n + 1 < room) {
        if (strncmp(message, "region ", 7) == 0 || strncmp(message, "regions ", 8) == 0)
            is_number = true;
        char *end = NULL;
        size_t k = is_number && isdigit((unsigned char)*message) ? strtoul(message, &end, 10) : 0;
        if (end != NULL && k < l->n_names) {
            n += (size_t)snprintf(out + n, room - n, "\"%.60s\"", l->names[k]);
            n = n < room ? n : room - 1;
            is_number = strncmp(end, " and ", 5) == 0 && isdigit((unsigned char)end[5]);
            message = end;
        } else
            out[n++] = *message++;
    }
    out[n] = '\0';
}

/* Makes the cage of one side from features. */
static void take_cage(cage *c, size_t n, const icc_feature *features, const int64_t *ids)
{
    *c = (cage){.dim = 2, .n_features = n};
    c->points = need(1, sizeof *c->points);
    c->features = need(n, sizeof *c->features);
    for (size_t f = 0; f < n; f++) {
        const icc_feature *from = &features[f];
        const cage_feature *before = f > 0 && ids[f] == ids[f - 1] ? &c->features[f - 1] : NULL;
        cage_feature *to = &c->features[f];
        *to = (cage_feature){.kind = from->kind,
                             .number = ids[f] + 1,
                             .ring = before != NULL ? before->ring + 1 : 0,
                             .n = from->n_vertices};
        to->points = need(to->n, 2 * sizeof *to->points);
        memcpy(to->points, from->vertices, to->n * 2 * sizeof *to->points);
    }
}

static void take_cages(job *j, const icc_coverage *coverage, size_t n)
{
    const icc_feature *features[2];
    int64_t *ids = need(n, sizeof *ids);
    icc_coverage_get_features(coverage, &features[0], &features[1]);
    icc_coverage_get_ids(coverage, ids);
    for (int side = 0; side < 2; side++)
        take_cage(&j->cages[side], n, features[side], ids);
    free(ids);
}

/* Prints a table of what was done. */
static void tell(const job *j, const layers *l, const icc_coverage *coverage)
{
    icc_coverage_info info = {.size = sizeof info};
    icc_coverage_get_info(coverage, &info);
    if (j->args->quiet)
        return;
    note("%zu regions, %zu nodes, %zu borders, %zu islands, %zu common vertices (%zu of both "
         "layers)",
         info.n_regions, info.n_nodes, info.n_sides, info.n_islands, info.n_vertices,
         info.n_joined);
    for (int side = 0; side < 2; side++) {
        note("%s: %zu vertices, %zu welded, %zu put into sides; moved by %.3g at most, %.3g apart "
             "at least",
             side == 0 ? "source" : "target", info.n_given[side], info.n_welded[side],
             info.n_inserted[side], info.most_moved[side], info.least_apart[side]);
        if (info.n_chains[side] > 0)
            note("%s: %zu vertices would chain, one near (%.6g, %.6g): --weld is too long or too "
                 "short",
                 side == 0 ? "source" : "target", info.n_chains[side], info.chain[2 * side],
                 info.chain[2 * side + 1]);
    }
    for (size_t k = 0; k < info.n_differences; k++) {
        icc_coverage_difference d = {.size = sizeof d};
        icc_coverage_get_difference(coverage, k, &d);
        note("%s only: the %s of \"%.60s\"%s%.60s%s near (%.6g, %.6g)",
             d.side == 1 ? "source" : "target",
             d.kind == ICC_DIFFERENCE_REGION ? "whole" : "border", l->names[d.ids[0]],
             d.n_ids > 1 ? " and \"" : "", d.n_ids > 1 ? l->names[d.ids[1]] : "",
             d.n_ids > 1 ? "\"" : "", d.place[0], d.place[1]);
    }
}

/* Makes the coverage, and cages from it. */
static int make(job *j, const layers *l)
{
    const args *a = j->args;
    icc_layer given[2];
    icc_coverage *coverage;
    icc_error err = {.size = sizeof err, .index = -1};
    const icc_coverage_options options = {.size = sizeof options,
                                          .weld = {a->weld, a->weld},
                                          .unmatched = a->leaves_out ? ICC_UNMATCHED_LEAVE_OUT : 0};
    for (int side = 0; side < 2; side++) {
        const layer *at = &l->side[side];
        given[side] = (icc_layer){.size = sizeof given[side],
                                  .n_rings = at->n_rings,
                                  .first = at->first,
                                  .vertices = at->vertices,
                                  .ids = at->ids,
                                  .holes = at->holes};
    }
    icc_status status =
        icc_coverage_create(&coverage, &given[0], &given[1], &options, &j->env, &err);
    if (status != ICC_OK) {
        char text[sizeof err.message];
        progress_end(&j->bar);
        with_names(text, sizeof text, l, job_message(&err));
        return failed(err.side != 0 ? job_file(j, err.side) : NULL, 0, "%s", text);
    }
    icc_coverage_info info = {.size = sizeof info};
    icc_coverage_get_info(coverage, &info);
    take_cages(j, coverage, info.n_features);
    tell(j, l, coverage);
    icc_coverage_free(coverage);
    return DONE;
}

int layer_cages(job *j)
{
    layers l = {0};
    int result = DONE;
    for (int side = 0; side < 2 && result == DONE; side++) {
        problem wrong;
        size_t n;
        layer *at = &l.side[side];
        at->text = file_read(job_file(j, side + 1), &n);
        if (at->text == NULL)
            result = FAILED;
        else if (!read_layer(at, n, j->args->by, &wrong))
            result = failed(job_file(j, side + 1), wrong.line, "%s", wrong.text);
    }
    if (result == DONE) {
        number_names(&l);
        result = make(j, &l);
    }
    layers_free(&l);
    return result;
}
