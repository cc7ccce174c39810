/* Gives meshes of their own to nodes of a glTF scene that draw one mesh at several places, because its
 * images differ. The first place keeps the mesh. Each further one gets a copy of it, with copies of the
 * positions, directions and morph targets at the end of the bytes. */
#include "base/allocate.h"
#include "base/bytes.h"
#include "base/gltf_pack.h"
#include "base/json_in.h"
#include "mesh/glb_nodes.h"

#include <stdlib.h>
#include <string.h>

enum { N_CHUNK = 8, MOST_BYTES = 0x7fffffff };

/* A mesh at one of its places. */
typedef struct variant {
    double matrix[12];
    size_t mesh; /* the number of this copy */
    size_t next; /* of the same mesh, or SIZE_MAX */
} variant;

typedef struct splitter {
    const glb *g;
    edits *e;
    problem *wrong;
    const json_item **meshes;
    size_t *first; /* of each mesh: its first variant, or SIZE_MAX */
    size_t n, room;
    variant *variants;
    double (*owners)[12]; /* of each set: the place that keeps it */
    bool *owned;
    size_t n_meshes, n_accessors, n_views; /* with the copies */
    size_t *copies; /* of each accessor: its copy in the mesh at hand, or 0 */
    char *chunk;    /* the bytes, with their head */
    size_t n_chunk, room_chunk;
} splitter;

static size_t *variant_at(splitter *s, size_t mesh, const double matrix[12])
{
    size_t *at = &s->first[mesh];
    while (*at != SIZE_MAX && memcmp(s->variants[*at].matrix, matrix, 12 * sizeof *matrix) != 0)
        at = &s->variants[*at].next;
    return at;
}

/* True if the mesh itself may stand at a place: all its positions are free, or are there already. */
static bool is_free(const splitter *s, size_t mesh, const double matrix[12])
{
    bool free = s->first[mesh] == SIZE_MAX;
    for (size_t i = s->g->starts[mesh]; free && i < s->g->starts[mesh + 1]; i++) {
        size_t set = glb_set_of(s->g, s->g->primitives[i]);
        free = !s->owned[set] || memcmp(s->owners[set], matrix, sizeof *s->owners) == 0;
    }
    return free;
}

static void own_sets(splitter *s, size_t mesh, const double matrix[12])
{
    for (size_t i = s->g->starts[mesh]; i < s->g->starts[mesh + 1]; i++) {
        size_t set = glb_set_of(s->g, s->g->primitives[i]);
        memcpy(s->owners[set], matrix, sizeof *s->owners);
        s->owned[set] = true;
    }
}

/* -------------------------------------------------------------------- copy */

/* Begins to add an item at the end of a list of the JSON. */
static void append(splitter *s, const char *list)
{
    size_t end = json_get(s->g->json, list)->end - 1;
    edits_replace(s->e, end, end);
    edits_put_text(s->e, ",");
}

/* Adds a piece of the JSON with edits of its own. */
static void append_piece(splitter *s, const char *list, const json_item *piece, edits *own)
{
    size_t n = piece->end - piece->begin;
    char *text = edits_apply(own, s->g->text + s->g->json_at + piece->begin, &n, NULL, 0);
    append(s, list);
    edits_put(s->e, n, text);
    free(text);
}

static void replace_number(edits *own, const json_item *piece, const json_item *number,
                           size_t value)
{
    if (number == NULL)
        return;
    edits_replace(own, number->begin - piece->begin, number->end - piece->begin);
    edits_put_number(own, (double)value);
}

/* Adds the items without gaps, and a view of them. */
static void copy_items(splitter *s, const glb_items *items)
{
    const size_t n = items->n * items->size;
    append(s, "bufferViews");
    edits_put_text(s->e, "{\"buffer\":0,\"byteOffset\":");
    edits_put_number(s->e, (double)(s->n_chunk - N_CHUNK));
    edits_put_text(s->e, ",\"byteLength\":");
    edits_put_number(s->e, (double)n);
    edits_put_text(s->e, "}");
    s->chunk = grow(s->chunk, &s->room_chunk, s->n_chunk + n, 1);
    for (size_t i = 0; i < items->n; i++)
        memcpy(s->chunk + s->n_chunk + i * items->size, s->g->text + items->at + i * items->stride,
               items->size);
    s->n_chunk += n;
    s->n_views++;
}

/* The copy of an accessor of 3 or 4 floats. Others are shared by all copies of a mesh. */
static size_t copy_accessor(splitter *s, const json_item *index, glb_kind kind)
{
    glb_items items;
    problem none;
    size_t accessor;
    edits own = {0};
    if (!glb_find_items(s->g, index, "a copy", kind, &accessor, &items, &none))
        return (size_t)index->number;
    if (s->copies[accessor] > 0)
        return s->copies[accessor];
    const json_item *json = s->g->accessors[accessor];
    replace_number(&own, json, json_get(json, "bufferView"), s->n_views);
    replace_number(&own, json, json_get(json, "byteOffset"), 0);
    append_piece(s, "accessors", json, &own);
    copy_items(s, &items);
    edits_free(&own);
    s->copies[accessor] = s->n_accessors;
    return s->n_accessors++;
}

/* Copies what changes among the attributes of a primitive or of a morph target. */
static void copy_attributes(splitter *s, edits *own, const json_item *mesh,
                            const json_item *attributes)
{
    static const char *const names[] = {"POSITION", "NORMAL", "TANGENT"};
    for (size_t k = 0; k < 3; k++) {
        const json_item *index = json_get(attributes, names[k]);
        problem none;
        size_t accessor;
        glb_items items;
        bool four = glb_find_items(s->g, index, names[k], GLB_FOUR, &accessor, &items, &none);
        if (json_is(index, JSON_NUMBER))
            replace_number(own, mesh, index, copy_accessor(s, index, four ? GLB_FOUR : GLB_THREE));
    }
}

static size_t copy_mesh(splitter *s, size_t mesh)
{
    const json_item *json = s->meshes[mesh];
    edits own = {0};
    memset(s->copies, 0, s->g->n_accessors * sizeof *s->copies);
    const json_item *x = json_first(json_get(json, "primitives"));
    for (; x != NULL; x = json_next(x)) {
        const json_item *target = json_first(json_get(x, "targets"));
        copy_attributes(s, &own, json, json_get(x, "attributes"));
        for (; target != NULL; target = json_next(target))
            copy_attributes(s, &own, json, target);
    }
    append_piece(s, "meshes", json, &own);
    edits_free(&own);
    return s->n_meshes++;
}

/* -------------------------------------------------------------------- split */

static bool split_node(splitter *s, const glb_nodes *nodes, const glb_skin *skins, size_t i)
{
    const json_item *number = json_get(nodes->list[i].json, "mesh");
    uint32_t mesh;
    variant v = {.next = SIZE_MAX};
    if (number == NULL)
        return true;
    if (!json_index(number, "mesh", "glTF mesh", s->g->n_meshes, &mesh, s->wrong) ||
        !glb_place_node(nodes, skins, i, v.matrix, s->wrong))
        return false;
    size_t *at = variant_at(s, mesh, v.matrix);
    if (*at == SIZE_MAX) {
        v.mesh = is_free(s, mesh, v.matrix) ? mesh : copy_mesh(s, mesh);
        if (v.mesh == mesh)
            own_sets(s, mesh, v.matrix);
        *at = s->n;
        s->variants = grow(s->variants, &s->room, s->n + 1, sizeof v);
        s->variants[s->n++] = v;
        at = NULL;
    }
    size_t which = at == NULL ? s->n - 1 : *at;
    if (s->variants[which].mesh != mesh) {
        edits_replace(s->e, number->begin, number->end);
        edits_put_number(s->e, (double)s->variants[which].mesh);
    }
    return s->n_chunk + s->e->n_bytes <= MOST_BYTES ||
           spoilt(s->wrong, 0,
                  "a mesh for each place where nodes draw one is more than a glTF file can hold");
}

/* Copies the bytes of the scene, and has all numbers begin at multiples of four bytes. */
static void begin_chunk(splitter *s)
{
    size_t padded = (s->g->bin_n + 3) / 4 * 4;
    s->n_chunk = N_CHUNK + padded;
    s->chunk = grow(s->chunk, &s->room_chunk, s->n_chunk, 1);
    memset(s->chunk, 0, s->n_chunk);
    if (s->g->bin_n > 0)
        memcpy(s->chunk + N_CHUNK, s->g->text + s->g->bin_at, s->g->bin_n);
}

static char *join(splitter *s, size_t *n)
{
    const json_item *buffer = json_first(json_get(s->g->json, "buffers"));
    const json_item *length = json_get(buffer, "byteLength");
    if (length != NULL) {
        edits_replace(s->e, length->begin, length->end);
        edits_put_number(s->e, (double)(s->n_chunk - N_CHUNK));
    }
    put_little_endian((unsigned char *)s->chunk, (uint32_t)(s->n_chunk - N_CHUNK));
    memcpy(s->chunk + 4, "BIN", 4);
    return gltf_join(s->e, s->g->text + s->g->json_at, s->g->json->end, s->chunk, s->n_chunk, n);
}

static void list_meshes(splitter *s)
{
    size_t i = 0;
    const json_item *mesh = json_first(json_get(s->g->json, "meshes"));
    s->meshes = need(s->n_meshes, sizeof *s->meshes);
    s->first = need(s->n_meshes, sizeof *s->first);
    for (; mesh != NULL; mesh = json_next(mesh), i++) {
        s->meshes[i] = mesh;
        s->first[i] = SIZE_MAX;
    }
}

bool glb_split(const glb *g, char **text, size_t *n, size_t *n_copies, problem *wrong)
{
    edits e = {0};
    glb_nodes nodes = {0};
    glb_skin *skins = NULL;
    size_t n_skins = 0;
    splitter s = {.g = g,
                  .e = &e,
                  .wrong = wrong,
                  .owners = need(g->n_sets, sizeof *s.owners),
                  .owned = need(g->n_sets, sizeof *s.owned),
                  .n_meshes = g->n_meshes,
                  .n_accessors = g->n_accessors,
                  .n_views = g->n_views,
                  .copies = need(g->n_accessors, sizeof *s.copies)};
    list_meshes(&s);
    begin_chunk(&s);
    bool good =
        glb_nodes_read(&nodes, g, wrong) && glb_skins_read(&skins, &n_skins, g, &nodes, wrong);
    for (size_t i = 0; good && i < nodes.n; i++)
        good = split_node(&s, &nodes, skins, i);
    *n_copies = s.n_meshes - g->n_meshes;
    *text = good && *n_copies > 0 ? join(&s, n) : NULL;
    glb_nodes_free(&nodes);
    glb_skins_free(skins, n_skins);
    edits_free(&e);
    free(s.meshes);
    free(s.first);
    free(s.variants);
    free(s.owners);
    free(s.owned);
    free(s.copies);
    free(s.chunk);
    return good;
}
