/* Writes a glTF scene with other positions. They go back through the nodes that place them, and
 * their bounds in the JSON are updated. In JSON, the bytes stand inside as a data: URI. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "base/base64.h"
#include "base/bytes.h"
#include "base/edits.h"
#include "base/gltf_pack.h"
#include "mesh/affine_map.h"
#include "mesh/glb.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_same(size_t dim, const double *a, const double *b)
{
    for (size_t k = 0; k < dim; k++)
        if (!(a[k] <= b[k] && a[k] >= b[k]))
            return false;
    return true;
}

/* Converts a point of the scene to its coordinates in the file. */
static void take_in(double out[3], const mesh_file *m, const mesh_place *place, const double *point)
{
    if (place != NULL)
        affine_apply(out, place->in, point);
    else
        memcpy(out, point, m->dim * sizeof *point);
}

/* Rounds a point's coordinates in the file to floats. A point that has not moved keeps the bits
 * that were read. */
static bool round_point(const mesh_file *m, const mesh_place *place, size_t i, double *point)
{
    double own[3];
    if (is_same(m->dim, point, m->points + m->dim * i))
        return true;
    take_in(own, m, place, point);
    for (size_t k = 0; k < m->dim; k++) {
        if (isfinite(point[k]) && !(fabs(own[k]) <= (double)FLT_MAX))
            return false;
        own[k] = (double)(float)own[k];
    }
    if (place != NULL)
        affine_apply(point, place->out, own);
    else
        memcpy(point, own, m->dim * sizeof *own);
    return true;
}

bool glb_round(const mesh_file *m, double *points, size_t *beyond)
{
    const mesh_place *place = m->places, *end = place + m->n_places;
    for (size_t i = 0; i < m->n_vertices; i++) {
        *beyond = i;
        while (place < end && i >= place->first + place->n)
            place++;
        if (!round_point(m, place < end && i >= place->first ? place : NULL, i,
                         points + m->dim * i))
            return false;
    }
    return true;
}

static void put_positions(char *text, const mesh_file *m, const glb_positions *set,
                          const double *points)
{
    const mesh_place *place = glb_place(m, set->first);
    for (size_t i = 0; i < set->items.n; i++) {
        size_t at = m->dim * (set->first + i);
        double own[3];
        if (is_same(m->dim, points + at, m->points + at))
            continue;
        take_in(own, m, place, points + at);
        for (size_t k = 0; k < m->dim; k++)
            put_little_endian_float(text + set->items.at + i * set->items.stride + 4 * k,
                                    (float)own[k]);
    }
}

/* Adds the least or the greatest of a coordinate, which is 0 if no vertex has an image. */
static void put_bound(edits *e, const char *text, const glb_items *items, size_t k, bool greatest)
{
    double bound = 0;
    bool any = false;
    for (size_t i = 0; i < items->n; i++) {
        double x = (double)little_endian_float(text + items->at + i * items->stride + 4 * k);
        if (isfinite(x) && (!any || (greatest ? x > bound : x < bound))) {
            bound = x;
            any = true;
        }
    }
    edits_put_number(e, bound);
}

void glb_set_bounds(edits *e, const json_item *accessor, const char *text, const glb_items *items)
{
    static const char *const names[] = {"min", "max"}, *const added[] = {",\"min\":", ",\"max\":"};
    for (size_t side = 0; side < 2; side++) {
        const json_item *bounds = json_get(accessor, names[side]);
        size_t end = accessor->end - 1;
        edits_replace(e, bounds != NULL ? bounds->begin : end, bounds != NULL ? bounds->end : end);
        edits_put_text(e, bounds != NULL ? "" : added[side]);
        for (size_t k = 0; k < items->size / 4; k++) {
            edits_put_text(e, k == 0 ? "[" : ",");
            put_bound(e, text, items, k, side == 1);
        }
        edits_put_text(e, "]");
    }
}

/* Updates the bounds of positions, and of vectors that were carried and whose bounds are stated. */
static void update_bounds(edits *e, const mesh_file *m, const glb *g, const char *text)
{
    problem none;
    bool other;
    size_t n_vectors = 0;
    glb_vectors *vectors = m->carried ? glb_find_vectors(g, &n_vectors, &other, &none) : NULL;
    const glb_items **items = need(g->n_accessors, sizeof *items);
    for (size_t s = 0; s < g->n_sets; s++)
        items[g->sets[s].accessor] = &g->sets[s].items;
    for (size_t v = 0; v < n_vectors; v++)
        if (json_get(g->accessors[vectors[v].accessor], "min") != NULL)
            items[vectors[v].accessor] = &vectors[v].items;
    for (size_t i = 0; i < g->n_accessors; i++)
        if (items[i] != NULL)
            glb_set_bounds(e, g->accessors[i], text, items[i]);
    free(vectors);
    free(items);
}

bool glb_is_json(const char *name)
{
    static const char end[] = ".gltf";
    size_t n = strlen(name), k = 0;
    const char *tail = name + (n < sizeof end ? n : n - (sizeof end - 1));
    while (end[k] != '\0' && (tail[k] | 0x20) == (end[k] | 0x20))
        k++;
    return end[k] == '\0';
}

/* Puts the bytes of the binary chunk into the JSON. */
static void embed(edits *e, const glb *g, const char *text)
{
    const json_item *buffer = json_first(json_get(g->json, "buffers"));
    const json_item *length = json_get(buffer, "byteLength");
    size_t n = g->bin_n, n_digits;
    if (g->bin_at == 0 || !json_is(buffer, JSON_OBJECT) || json_get(buffer, "uri") != NULL)
        return;
    if (json_is(length, JSON_NUMBER) && length->number >= 0 && length->number < (double)n)
        n = (size_t)length->number;
    char *digits = base64_encode(text + g->bin_at, n, &n_digits);
    edits_replace(e, buffer->end - 1, buffer->end - 1);
    edits_put_text(e, ",\"uri\":\"data:application/octet-stream;base64,");
    edits_put(e, n_digits, digits);
    edits_put_text(e, "\"");
    free(digits);
}

static void write_form(edits *e, const mesh_file *m, const glb *g, const char *text, bool as_json,
                       FILE *stream)
{
    const char *json = text + g->json_at;
    if (as_json) {
        embed(e, g, text);
        edits_write(e, json, g->json->end, stream);
        fputs("\n", stream);
        return;
    }
    size_t n;
    char *whole = gltf_join(e, json, g->json->end, text + g->json_end, m->n_text - g->json_end, &n);
    fwrite(whole, 1, n, stream);
    free(whole);
}

void glb_write(const mesh_file *m, const double *points, bool as_json, FILE *stream)
{
    problem none;
    glb g;
    edits e = {0};
    glb_open(&g, m->text, m->n_text, &none); /* this succeeded before */
    char *text = need(m->n_text, 1);
    memcpy(text, m->text, m->n_text);
    for (size_t s = 0; s < g.n_sets; s++)
        put_positions(text, m, &g.sets[s], points);
    update_bounds(&e, m, &g, text);
    write_form(&e, m, &g, text, as_json, stream);
    edits_free(&e);
    free(text);
    glb_close(&g);
}
