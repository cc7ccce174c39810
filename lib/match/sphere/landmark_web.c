/* Shortest paths from one sector of a landmark to other sectors, based on: E. W. Dijkstra, A Note
 * on Two Problems in Connexion with Graphs, 1959. */
#include "match/sphere/landmark_web.h"

#include "base/minmax.h"
#include "math/vec.h"

static bool is_landmark(uint32_t holder)
{
    return holder != ICCP_NO_EDGE && holder >= ICCP_LANDMARK;
}

uint32_t iccp_web_landmark_of(const iccp_landmark_web *w, uint32_t sector)
{
    return sector < 2 * w->most_paths ? w->ends[sector / 2][sector % 2]
                                      : sector - (uint32_t)(2 * w->most_paths);
}

/* The sector that contains a half-edge from a landmark. It is named by the path before it,
 * clockwise. */
static uint32_t sector_at(const iccp_landmark_web *w, int side, uint32_t h)
{
    const iccp_split_surface *const s = &w->s[side];
    const uint32_t k = s->holder[s->origin[h]] - ICCP_LANDMARK;
    if (!w->is_in[k])
        return (uint32_t)(2 * w->most_paths) + k;
    while (s->path[h] == ICCP_NO_EDGE)
        h = iccp_split_turn_back(s, h);
    return 2 * s->path[h] + (w->ends[s->path[h]][1] == k);
}

bool iccp_web_make_room(iccp_landmark_web *w, size_t n, const iccp_memory *memory)
{
    if (n <= w->room)
        return true;
    const size_t room = n + n / 2;
    iccp_heap_free(&w->heap, memory);
    iccp_free(memory, w->distance);
    iccp_free(memory, w->via);
    w->distance = iccp_alloc(memory, room, sizeof *w->distance);
    w->via = iccp_alloc(memory, room, sizeof *w->via);
    w->room = room;
    return iccp_heap_create(&w->heap, room, memory) && w->distance != NULL && w->via != NULL;
}

static double length_of(const iccp_split_surface *s, uint32_t h)
{
    return iccp_vec_distance(3, s->x + 3 * (size_t)s->origin[h],
                             s->x + 3 * (size_t)iccp_split_end(s, h));
}

/* Reaches the end of half-edge h. `before` is the distance to its start. */
static void reach(iccp_landmark_web *w, int side, uint32_t h, double before)
{
    const iccp_split_surface *const s = &w->s[side];
    const uint32_t end = iccp_split_end(s, h);
    if (s->holder[end] == ICCP_NO_EDGE && w->distance[end] <= before)
        return;
    const double at = before + length_of(s, h);
    if (s->holder[end] == ICCP_NO_EDGE && at < w->distance[end]) {
        w->distance[end] = at;
        w->via[end] = h;
        iccp_heap_put(&w->heap, end, at);
    } else if (is_landmark(s->holder[end])) {
        const uint32_t sector = sector_at(w, side, s->twin[h]);
        if (at < w->arrival[sector]) {
            w->arrival[sector] = at;
            w->entered[sector] = h;
        }
    }
}

void iccp_web_search(iccp_landmark_web *w, int side, uint32_t from, double most)
{
    const iccp_split_surface *const s = &w->s[side];
    const uint32_t start = w->vertices[side][iccp_web_landmark_of(w, from)];
    for (size_t v = 0; v < s->n_vertices; ++v)
        w->distance[v] = HUGE_VAL;
    for (size_t k = 0; k < w->n_sectors; ++k)
        w->arrival[k] = HUGE_VAL;
    iccp_heap_clear(&w->heap);
    uint32_t h = s->out[start];
    do {
        if (s->path[h] == ICCP_NO_EDGE && sector_at(w, side, h) == from)
            reach(w, side, h, 0);
        h = iccp_split_turn(s, h);
    } while (h != s->out[start]);
    while (w->heap.n_entries > 0 && !(w->scale[side] * w->heap.entry[0].key > most)) {
        const uint32_t v = iccp_heap_pop(&w->heap);
        const uint32_t first = h = s->out[v];
        do {
            reach(w, side, h, w->distance[v]);
            h = iccp_split_turn(s, h);
        } while (h != first);
    }
}

void iccp_web_find_costs(iccp_landmark_web *w, uint32_t from, double most)
{
    double *const row = w->cost + w->n_sectors * from;
    iccp_web_search(w, 0, from, most);
    for (size_t k = 0; k < w->n_sectors; ++k)
        row[k] = w->scale[0] * w->arrival[k];
    iccp_web_search(w, 1, from, most);
    for (size_t k = 0; k < w->n_sectors; ++k) {
        const double first = row[k], second = w->scale[1] * w->arrival[k];
        row[k] += second;
        if (w->is_even && row[k] < HUGE_VAL) {
            const double ratio = iccp_max(first, second) / iccp_min(first, second);
            row[k] *= ratio * ratio;
        }
        w->cost[w->n_sectors * k + from] = row[k];
    }
}
