/* Based on: J.-D. Boissonnat, C. Maria, The Simplex Tree, 2014. A face is known by the face without its last
 * vertex, and that vertex; the children of all nodes of the tree are in one hash table. */
#include "shelling/faces.h"

#include <stdbool.h>

static const size_t SIMPLICES_PER_REPORT = 1 << 14;

typedef struct child {
    uint32_t parent, vertex;
    uint32_t number; /* 0: nothing here, as the face 0 is a vertex */
} child;

typedef struct table {
    const iccp_memory *memory;
    size_t n, mask; /* children; slots less 1, a power of 2 */
    child *slot;
} table;

static child *find(const table *t, uint32_t parent, uint32_t vertex)
{
    uint64_t h = ((uint64_t)parent << 32 | vertex) * 0x9e3779b97f4a7c15u;
    size_t at = (size_t)(h ^ h >> 32) & t->mask;
    while (t->slot[at].number != 0 && (t->slot[at].parent != parent || t->slot[at].vertex != vertex))
        at = (at + 1) & t->mask;
    return &t->slot[at];
}

static bool enlarge(table *t)
{
    const table old = *t;
    t->mask = 2 * t->mask + 1;
    t->slot = t->mask < UINT32_MAX / 2 ? iccp_alloc_zero(t->memory, t->mask + 1, sizeof *t->slot) : NULL;
    if (t->slot == NULL) {
        *t = old;
        return false;
    }
    for (size_t i = 0; i <= old.mask; ++i)
        if (old.slot[i].number != 0)
            *find(t, old.slot[i].parent, old.slot[i].vertex) = old.slot[i];
    iccp_free(t->memory, old.slot);
    return true;
}

/* The number of a face, a new one if need be; 0 when there is no memory. */
static uint32_t number_child(table *t, uint32_t parent, uint32_t vertex, size_t *n_faces)
{
    child *c = find(t, parent, vertex);
    if (c->number != 0)
        return c->number;
    if (2 * t->n > t->mask) {
        if (!enlarge(t))
            return 0;
        c = find(t, parent, vertex);
    }
    ++t->n;
    *c = (child){parent, vertex, (uint32_t)(*n_faces)++};
    return c->number;
}

/* Corners in the order of their vertices' numbers. */
static void sort_corners(const uint32_t *corners, size_t n, unsigned *sorted)
{
    for (size_t i = 0; i < n; ++i) {
        size_t at = i;
        for (; at > 0 && corners[sorted[at - 1]] > corners[i]; --at)
            sorted[at] = sorted[at - 1];
        sorted[at] = (unsigned)i;
    }
}

/* `set` runs over sets of corners as sorted, parents first; `corners` is the same as they are in the mesh. */
static bool number_simplex(iccp_faces *faces, table *t, const uint32_t *vertex, uint32_t *number)
{
    unsigned sorted[ICC_MAX_DIM + 1], corners[2 << ICC_MAX_DIM] = {0};
    sort_corners(vertex, faces->dim + 1, sorted);
    unsigned last = 0;
    for (unsigned set = 1; set < 2u << faces->dim; ++set) {
        if (set == 2u << last)
            ++last;
        const unsigned parent = set - (1u << last);
        corners[set] = corners[parent] | 1u << sorted[last];
        if (iccp_set_size(set) >= faces->dim)
            continue;
        uint32_t *face = &number[faces->place[corners[set]]];
        *face = vertex[sorted[last]];
        if (parent == 0)
            continue;
        *face = number_child(t, number[faces->place[corners[parent]]], *face, &faces->n_faces);
        if (*face == 0)
            return false;
    }
    return true;
}

static icc_status number_all(iccp_faces *faces, table *t, const iccp_simplices *mesh, const iccp_env *env)
{
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        if (s % SIMPLICES_PER_REPORT == 0 &&
            iccp_progress(env, "faces", (double)s / (double)mesh->n_simplices) != ICC_OK)
            return ICC_ERR_CANCELLED;
        if (!number_simplex(faces, t, mesh->corners + (mesh->dim + 1) * s,
                            faces->number + faces->per_simplex * s))
            return ICC_ERR_MEMORY;
    }
    return ICC_OK;
}

icc_status iccp_faces_create(iccp_faces *faces, const iccp_simplices *mesh, const iccp_env *env)
{
    *faces = (iccp_faces){.memory = env->memory, .dim = mesh->dim, .n_faces = mesh->n_points};
    for (unsigned set = 1; set < 2u << mesh->dim; ++set)
        if (iccp_set_size(set) < mesh->dim)
            faces->place[set] = (uint8_t)faces->per_simplex++;
    table t = {.memory = &env->memory, .mask = 1023};
    while (t.mask < 8 * mesh->n_points)
        t.mask = 2 * t.mask + 1;
    faces->number = iccp_alloc(&env->memory, mesh->n_simplices, faces->per_simplex * sizeof(uint32_t));
    t.slot = iccp_alloc_zero(&env->memory, t.mask + 1, sizeof *t.slot);
    icc_status status = ICC_ERR_MEMORY;
    if (faces->number != NULL && t.slot != NULL)
        status = number_all(faces, &t, mesh, env);
    iccp_free(&env->memory, t.slot);
    if (status != ICC_OK)
        iccp_faces_free(faces);
    return status;
}

void iccp_faces_free(iccp_faces *faces)
{
    iccp_free(&faces->memory, faces->number);
    faces->number = NULL;
}
