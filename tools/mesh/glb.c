/* Khronos Group, glTF 2.0 Specification, 2021: sections 3.6 (accessors) and 4 (the binary form). */
#include "mesh/glb.h"

#include "base/allocate.h"
#include "base/bytes.h"
#include "base/json_in.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N_HEAD = 12, N_CHUNK = 8 };
enum { NO_SET = 0, BYTES = 5121, SHORTS = 5123, WORDS = 5125, FLOATS = 5126 };

/* ------------------------------------------------------------------ chunks */

/* Takes the chunk at *at, which is moved after it: the beginning and length of its data. */
static bool take_chunk(const char *text, size_t n, size_t *at, const char *type, size_t *begin,
                       size_t *length, problem *wrong)
{
    if (n - *at < N_CHUNK)
        return spoilt(wrong, 0, "byte %zu: this glTF file ends before its part %.4s", *at, type);
    if (memcmp(text + *at + 4, type, 4) != 0)
        return spoilt(wrong, 0, "byte %zu: this is not the part %.4s of a glTF file", *at, type);
    *length = little_endian(text + *at, 4);
    if (*length > n - *at - N_CHUNK)
        return spoilt(wrong, 0, "byte %zu: the part %.4s has %zu bytes, but %zu are left", *at,
                      type, *length, n - *at - N_CHUNK);
    *begin = *at + N_CHUNK;
    *at = *begin + *length;
    return true;
}

static bool read_json(glb *g, size_t n, problem *wrong)
{
    bool good = json_tree_read(&g->tree, g->text + g->json_at, n, wrong);
    g->json = g->tree.root;
    wrong->line = 0;
    return good;
}

static bool read_chunks(glb *g, size_t n, problem *wrong)
{
    size_t at = N_HEAD, length;
    if (n < N_HEAD)
        return spoilt(wrong, 0, "the file ends early");
    unsigned version = little_endian(g->text + 4, 4), total = little_endian(g->text + 8, 4);
    if (version != 2)
        return spoilt(wrong, 0, "byte 4: this is glTF version %u; libicc reads version 2", version);
    if (total != n)
        return spoilt(wrong, 0, "byte 8: the file should have %u bytes, but it has %zu", total, n);
    if (!take_chunk(g->text, n, &at, "JSON", &g->json_at, &length, wrong) ||
        !read_json(g, length, wrong))
        return false;
    g->json_end = at;
    return at == n || take_chunk(g->text, n, &at, "BIN", &g->bin_at, &g->bin_n, wrong);
}

/* --------------------------------------------------------------- accessors */

static const json_item **list_items(const json_item *array, size_t *n)
{
    *n = json_size(array);
    const json_item **items = need(*n, sizeof *items);
    size_t i = 0;
    for (const json_item *item = json_first(array); item != NULL; item = json_next(item))
        items[i++] = item;
    return items;
}

static void list_primitives(glb *g)
{
    const json_item *meshes = json_get(g->json, "meshes");
    size_t room = 0;
    g->starts = need(json_size(meshes) + 1, sizeof *g->starts);
    for (const json_item *mesh = json_first(meshes); mesh != NULL; mesh = json_next(mesh)) {
        const json_item *x = json_first(json_get(mesh, "primitives"));
        for (; x != NULL; x = json_next(x)) {
            g->primitives = grow(g->primitives, &room, g->n_primitives + 1, sizeof *g->primitives);
            g->primitives[g->n_primitives++] = x;
        }
        g->starts[++g->n_meshes] = g->n_primitives;
    }
}

/* Reads an integer of an object. `missing` is the value if it is absent. */
static bool take_count(const json_item *object, const char *where, const char *name, size_t missing,
                       size_t *out, problem *wrong)
{
    const json_item *item = json_get(object, name);
    char place[80];
    uint32_t value;
    *out = missing;
    if (item == NULL)
        return true;
    snprintf(place, sizeof place, "%s.%s", where, name);
    if (!json_index(item, place, "number", UINT32_MAX, &value, wrong))
        return false;
    *out = value;
    return true;
}

/* Finds the bytes of a view, which must lie in the binary part. */
static bool find_view(const glb *g, size_t index, size_t *at, size_t *n, size_t *stride,
                      problem *wrong)
{
    const json_item *view = g->views[index];
    char where[40];
    size_t buffer;
    snprintf(where, sizeof where, "bufferViews[%zu]", index);
    const json_item *extensions = json_get(view, "extensions");
    if (extensions != NULL && json_get(extensions, "EXT_meshopt_compression") != NULL)
        return spoilt(wrong, 0, "%s is compressed; save without compression", where);
    if (!take_count(view, where, "buffer", 0, &buffer, wrong) ||
        !take_count(view, where, "byteOffset", 0, at, wrong) ||
        !take_count(view, where, "byteLength", 0, n, wrong) ||
        !take_count(view, where, "byteStride", 0, stride, wrong))
        return false;
    if (buffer != 0 || g->bin_at == 0)
        return spoilt(wrong, 0, "%s is not in the file; save as one file (.glb)", where);
    if (*at > g->bin_n || *n > g->bin_n - *at)
        return spoilt(wrong, 0, "%s has bytes %zu to %zu of %zu", where, *at, *at + *n, g->bin_n);
    *at += g->bin_at;
    return true;
}

/* The bytes of an item, or 0 if it is not of that kind. */
static size_t item_size(const json_item *accessor, glb_kind kind)
{
    static const char *const types[] = {"SCALAR", "VEC3", "VEC4", "MAT4"};
    const char *type = json_string_of(json_get(accessor, "type"));
    const json_item *component = json_get(accessor, "componentType");
    double number = component != NULL ? component->number : 0;
    if (type == NULL || strcmp(type, types[kind]) != 0)
        return 0;
    if (kind != GLB_INDICES)
        return number != FLOATS ? 0 : kind == GLB_THREE ? 12 : kind == GLB_FOUR ? 16 : 64;
    return number == BYTES ? 1 : number == SHORTS ? 2 : number == WORDS ? 4 : 0;
}

static bool fits(const glb_items *items, size_t offset, size_t n_view)
{
    uint64_t last = (uint64_t)(items->n - 1) * items->stride + items->size;
    return offset <= n_view && last <= n_view - offset;
}

bool glb_find_items(const glb *g, const json_item *index, const char *of, glb_kind kind,
                    size_t *accessor, glb_items *out, problem *wrong)
{
    uint32_t which, view;
    char where[40];
    size_t offset, n_view = 0;
    if (!json_index(index, of, "glTF accessor", (uint32_t)g->n_accessors, &which, wrong))
        return false;
    *accessor = which;
    const json_item *object = g->accessors[which];
    snprintf(where, sizeof where, "accessors[%u]", (unsigned)which);
    out->size = item_size(object, kind);
    if (out->size == 0)
        return spoilt(wrong, 0, "%s, for %s, is not of %s", where, of,
                      kind == GLB_THREE    ? "three floats; save without quantization"
                      : kind == GLB_FOUR   ? "four floats; save without quantization"
                      : kind == GLB_MATRIX ? "matrices of floats"
                                           : "whole numbers without a sign");
    if (json_get(object, "sparse") != NULL || json_get(object, "bufferView") == NULL)
        return spoilt(wrong, 0, "%s, for %s, is sparse or compressed; save without that", where,
                      of);
    if (!take_count(object, where, "count", 0, &out->n, wrong) ||
        !take_count(object, where, "byteOffset", 0, &offset, wrong) ||
        !json_index(json_get(object, "bufferView"), where, "glTF view", (uint32_t)g->n_views, &view,
                    wrong) ||
        !find_view(g, view, &out->at, &n_view, &out->stride, wrong))
        return false;
    out->stride = out->stride > 0 ? out->stride : out->size;
    if (out->n == 0 || out->stride < out->size || !fits(out, offset, n_view))
        return spoilt(wrong, 0, "%s has %zu items from byte %zu on, which bufferViews[%u] has not",
                      where, out->n, offset, (unsigned)view);
    out->at += offset;
    return true;
}

/* --------------------------------------------------------------- positions */

static bool add_positions(glb *g, const json_item *primitive, problem *wrong)
{
    const json_item *index = json_get(json_get(primitive, "attributes"), "POSITION");
    glb_positions set = {.first = 0};
    if (index == NULL)
        return spoilt(wrong, 0, "a primitive has no POSITION");
    if (json_get(json_get(primitive, "extensions"), "KHR_draco_mesh_compression") != NULL)
        return spoilt(wrong, 0, "a mesh is compressed (Draco); save without compression");
    if (!glb_find_items(g, index, "POSITION", GLB_THREE, &set.accessor, &set.items, wrong))
        return false;
    if (g->set_of[set.accessor] != NO_SET)
        return true;
    g->set_of[set.accessor] = 1;
    g->sets = grow(g->sets, &g->room, g->n_sets + 1, sizeof *g->sets);
    g->sets[g->n_sets++] = set;
    return true;
}

static int by_place(const void *a, const void *b)
{
    const glb_positions *p = a, *q = b;
    return (p->items.at > q->items.at) - (p->items.at < q->items.at);
}

/* Numbers the vertices in the order of the file. */
static bool number_sets(glb *g, problem *wrong)
{
    size_t first = 0, end = 0;
    if (g->n_sets > 0)
        qsort(g->sets, g->n_sets, sizeof *g->sets, by_place);
    for (size_t i = 0; i < g->n_sets; i++) {
        glb_positions *set = &g->sets[i];
        if (set->items.at < end)
            return spoilt(wrong, 0, "accessors[%zu] and accessors[%zu] overlap",
                          g->sets[i - 1].accessor, set->accessor);
        end = set->items.at + (set->items.n - 1) * set->items.stride + set->items.size;
        set->first = first;
        g->set_of[set->accessor] = i;
        first += set->items.n;
    }
    return true;
}

static bool find_positions(glb *g, problem *wrong)
{
    for (size_t i = 0; i < g->n_primitives; i++)
        if (!add_positions(g, g->primitives[i], wrong))
            return false;
    return number_sets(g, wrong);
}

size_t glb_set_of(const glb *g, const json_item *primitive)
{
    const json_item *attributes = json_get(primitive, "attributes");
    return g->set_of[(size_t)json_get(attributes, "POSITION")->number];
}

bool glb_open(glb *out, const char *text, size_t n, problem *wrong)
{
    *out = (glb){.text = text};
    if (!read_chunks(out, n, wrong))
        return false;
    out->accessors = list_items(json_get(out->json, "accessors"), &out->n_accessors);
    out->views = list_items(json_get(out->json, "bufferViews"), &out->n_views);
    list_primitives(out);
    out->set_of = need(out->n_accessors, sizeof *out->set_of);
    return find_positions(out, wrong);
}

void glb_close(glb *g)
{
    json_tree_free(&g->tree);
    free(g->accessors);
    free(g->views);
    free(g->primitives);
    free(g->starts);
    free(g->set_of);
    free(g->sets);
    *g = (glb){0};
}
