/* Sorts the directions of both drawings, and finds equal ones. */
#include "match/common_mesh/shared_vertices.h"

#include "base/sort.h"

#include <string.h>

typedef struct place {
    double p[3];
    uint32_t number; /* in the numbers of both drawings; within one drawing no two directions are
                        equal */
} place;

static int by_direction(const void *a, const void *b)
{
    const place *const p = a, *const q = b;
    for (int k = 0; k < 3; ++k)
        if (p->p[k] < q->p[k] || p->p[k] > q->p[k])
            return p->p[k] < q->p[k] ? -1 : 1;
    return (p->number > q->number) - (p->number < q->number);
}

static bool is_same(const place *a, const place *b)
{
    return !(a->p[0] < b->p[0] || a->p[0] > b->p[0] || a->p[1] < b->p[1] || a->p[1] > b->p[1] ||
             a->p[2] < b->p[2] || a->p[2] > b->p[2]);
}

/* Lists the present vertices of both drawings in the order of their directions. */
static size_t list_places(const iccp_drawing drawing[2], place *places)
{
    size_t n = 0;
    for (int side = 0; side < 2; ++side)
        for (uint32_t v = 0; v < drawing[side].m->n_vertices; ++v)
            if (drawing[side].m->degree[v] > 0) {
                places[n].number = drawing[side].number[v];
                memcpy(places[n++].p, drawing[side].directions + 3 * (size_t)v, 3 * sizeof(double));
            }
    iccp_sort(places, n, sizeof *places, by_direction);
    return n;
}

icc_status iccp_shared_vertices_find(iccp_drawing drawing[2], size_t *n_different,
                                     const iccp_memory *memory)
{
    const size_t n_first = drawing[0].m->n_vertices, n_all = n_first + drawing[1].m->n_vertices;
    place *const places = iccp_alloc(memory, n_all, sizeof *places);
    bool has_memory = places != NULL;
    for (int side = 0; side < 2; ++side) {
        const size_t n = drawing[side].m->n_vertices, before = side == 0 ? 0 : n_first;
        drawing[side].number = iccp_alloc(memory, n, sizeof *drawing[side].number);
        drawing[side].partner = iccp_alloc(memory, n, sizeof *drawing[side].partner);
        has_memory = has_memory && drawing[side].number != NULL && drawing[side].partner != NULL;
        for (size_t v = 0; v < n && has_memory; ++v) {
            drawing[side].number[v] = (uint32_t)(before + v);
            drawing[side].partner[v] = ICCP_NO_EDGE;
        }
    }
    if (has_memory) {
        *n_different = list_places(drawing, places);
        for (size_t k = 1, n = *n_different; k < n; ++k) {
            const uint32_t a = places[k - 1].number, b = places[k].number;
            if (!is_same(&places[k - 1], &places[k]))
                continue;
            drawing[0].partner[a] = b - (uint32_t)n_first;
            drawing[1].partner[b - n_first] = a;
            drawing[1].number[b - n_first] = a;
            --*n_different;
        }
    }
    iccp_free(memory, places);
    return has_memory ? ICC_OK : ICC_ERR_MEMORY;
}
