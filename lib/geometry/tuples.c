/* Sorts tuples by counting sort on each vertex in turn (D. E. Knuth, The Art of Computer
 * Programming 3, section 5.2.5). Time is linear for every input. */
#include "geometry/tuples.h"

#include <string.h>

icc_status iccp_tuples_create(iccp_tuples *tuples, size_t n, size_t width, size_t n_vertices,
                              const iccp_memory *memory)
{
    iccp_tuples *t = tuples;
    *t = (iccp_tuples){.memory = *memory, .n = n, .width = width, .n_vertices = n_vertices};
    t->vertices = iccp_alloc(memory, n, width * sizeof *t->vertices);
    t->order = iccp_alloc(memory, n, sizeof *t->order);
    t->work = iccp_alloc(memory, n, sizeof *t->work);
    t->count = iccp_alloc(memory, n_vertices + 1, sizeof *t->count);
    if (t->vertices != NULL && t->order != NULL && t->work != NULL && t->count != NULL)
        return ICC_OK;
    iccp_tuples_free(t);
    return ICC_ERR_MEMORY;
}

void iccp_tuples_free(iccp_tuples *tuples)
{
    iccp_free(&tuples->memory, tuples->vertices);
    iccp_free(&tuples->memory, tuples->order);
    iccp_free(&tuples->memory, tuples->work);
    iccp_free(&tuples->memory, tuples->count);
    *tuples = (iccp_tuples){.memory = tuples->memory};
}

static void sort_by(iccp_tuples *t, size_t column)
{
    const uint32_t *key = t->vertices + column;
    memset(t->count, 0, (t->n_vertices + 1) * sizeof *t->count);
    for (size_t i = 0; i < t->n; ++i)
        ++t->count[key[t->width * i] + 1];
    for (size_t v = 0; v < t->n_vertices; ++v)
        t->count[v + 1] += t->count[v];
    for (size_t k = 0; k < t->n; ++k) {
        const uint32_t i = t->order[k];
        t->work[t->count[key[t->width * i]]++] = i;
    }
    uint32_t *swap = t->order;
    t->order = t->work;
    t->work = swap;
}

void iccp_tuples_sort(iccp_tuples *tuples)
{
    for (uint32_t i = 0; i < tuples->n; ++i)
        tuples->order[i] = i;
    for (size_t column = tuples->width; column-- > 0;)
        sort_by(tuples, column);
}

size_t iccp_tuples_end(const iccp_tuples *tuples, size_t begin)
{
    const size_t width = tuples->width;
    const uint32_t *first = tuples->vertices + width * tuples->order[begin];
    size_t end = begin + 1;
    for (; end < tuples->n; ++end) {
        const uint32_t *other = tuples->vertices + width * tuples->order[end];
        size_t same = 0;
        while (same < width && first[same] == other[same])
            ++same;
        if (same < width)
            break;
    }
    return end;
}
