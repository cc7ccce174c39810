/* Sorts the crossings of both walks by their edges, and compares them. */
#include "match/common_mesh/paired_crossings.h"

#include "base/error.h"
#include "base/sort.h"

typedef struct key {
    uint32_t edge[2]; /* half-edges, the smaller one of each edge */
    uint32_t place;   /* among the crossings of a walk */
} key;

static int by_edges(const void *a, const void *b)
{
    const key *const k = a, *const l = b;
    const int first = (k->edge[0] > l->edge[0]) - (k->edge[0] < l->edge[0]);
    return first != 0 ? first : (k->edge[1] > l->edge[1]) - (k->edge[1] < l->edge[1]);
}

static uint32_t edge_number(const iccp_half_edges *m, uint32_t h)
{
    return h < m->twin[h] ? h : m->twin[h];
}

/* Lists the crossings of a walk in the order of their edges. */
static void list_crossings(iccp_paired_crossings *paired, const iccp_drawing drawing[2],
                           const iccp_arc_walk walks[2], int side, key *keys)
{
    const iccp_arc_walk *const walk = &walks[side];
    const iccp_half_edges *const m = drawing[side].m, *const other = drawing[1 - side].m;
    for (uint32_t h = 0; h < 3 * m->n_faces; ++h)
        for (uint32_t k = 0; walk->begin[h] != ICCP_NO_EDGE && k < walk->n[h]; ++k) {
            const uint32_t place = walk->begin[h] + k;
            paired->edge_of[side][place] = h;
            keys[place].edge[side] = edge_number(m, h);
            keys[place].edge[1 - side] = edge_number(other, walk->crossed[place]);
            keys[place].place = place;
        }
    iccp_sort(keys, walk->n_crossed, sizeof *keys, by_edges);
}

/* Pairs the crossings of both walks. Returns false if they differ, if two belong to the same edges,
 * or if they cross in different directions. */
static bool pair_crossings(iccp_paired_crossings *paired, const iccp_arc_walk walk[2], const key *a,
                           const key *b)
{
    const size_t n = walk[0].n_crossed;
    if (n != walk[1].n_crossed)
        return false;
    for (size_t k = 0; k < n; ++k) {
        const uint32_t p = a[k].place, q = b[k].place;
        if (by_edges(&a[k], &b[k]) != 0 || (k > 0 && by_edges(&a[k - 1], &a[k]) == 0))
            return false;
        /* If one edge crosses the other from the left, that one crosses it from the right. */
        const bool forward = walk[0].crossed[p] == paired->edge_of[1][q];
        if (forward == (walk[1].crossed[q] == paired->edge_of[0][p]))
            return false;
        paired->place[p] = q;
    }
    return true;
}

icc_status iccp_paired_crossings_create(iccp_paired_crossings *paired,
                                        const iccp_drawing drawing[2], const iccp_arc_walk walk[2],
                                        const iccp_env *env, icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    key *const keys[2] = {iccp_alloc(memory, walk[0].n_crossed, sizeof(key)),
                          iccp_alloc(memory, walk[1].n_crossed, sizeof(key))};
    for (int side = 0; side < 2; ++side)
        paired->edge_of[side] = iccp_alloc(memory, walk[side].n_crossed, sizeof *paired->place);
    paired->place = iccp_alloc(memory, walk[0].n_crossed, sizeof *paired->place);
    icc_status status = ICC_OK;
    if (keys[0] == NULL || keys[1] == NULL || paired->edge_of[0] == NULL ||
        paired->edge_of[1] == NULL || paired->place == NULL) {
        status = iccp_fail_memory(err);
    } else {
        for (int side = 0; side < 2; ++side)
            list_crossings(paired, drawing, walk, side, keys[side]);
        if (!pair_crossings(paired, walk, keys[0], keys[1]))
            status = iccp_fail(err, ICC_ERR_CERTIFICATE,
                               "two drawings on the sphere cross %zu times seen from one, and %zu "
                               "times or elsewhere seen from the other",
                               walk[0].n_crossed, walk[1].n_crossed);
    }
    iccp_free(memory, keys[0]);
    iccp_free(memory, keys[1]);
    return status;
}

void iccp_paired_crossings_free(iccp_paired_crossings *paired, const iccp_memory *memory)
{
    iccp_free(memory, paired->place);
    iccp_free(memory, paired->edge_of[0]);
    iccp_free(memory, paired->edge_of[1]);
    *paired = (iccp_paired_crossings){0};
}
