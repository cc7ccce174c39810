/* Priority queue. Based on J. W. J. Williams, Algorithm 232: Heapsort, 1964. Nodes have four
 * children, as in D. B. Johnson, Priority Queues with Update and Finding Minimum Spanning Trees,
 * 1975. So there are fewer levels and fewer cache lines. */
#include "base/heap.h"

#include <string.h>

enum { CHILDREN = 4 };

bool iccp_heap_create(iccp_heap *heap, size_t n, const iccp_memory *memory)
{
    heap->n_entries = 0;
    heap->entry = iccp_alloc(memory, n, sizeof *heap->entry);
    heap->place = iccp_alloc(memory, n, sizeof *heap->place);
    if (heap->place != NULL)
        memset(heap->place, 0xff, n * sizeof *heap->place);
    return heap->entry != NULL && heap->place != NULL;
}

void iccp_heap_free(iccp_heap *heap, const iccp_memory *memory)
{
    iccp_free(memory, heap->entry);
    iccp_free(memory, heap->place);
    heap->entry = NULL;
    heap->place = NULL;
}

void iccp_heap_clear(iccp_heap *heap)
{
    while (heap->n_entries > 0)
        heap->place[heap->entry[--heap->n_entries].number] = UINT32_MAX;
}

static bool comes_before(iccp_heap_entry a, iccp_heap_entry b)
{
    return a.key < b.key || (!(b.key < a.key) && a.number < b.number);
}

static void set(iccp_heap *heap, size_t at, iccp_heap_entry entry)
{
    heap->entry[at] = entry;
    heap->place[entry.number] = (uint32_t)at;
}

static void rise(iccp_heap *heap, size_t at, iccp_heap_entry entry)
{
    while (at > 0 && comes_before(entry, heap->entry[(at - 1) / CHILDREN])) {
        set(heap, at, heap->entry[(at - 1) / CHILDREN]);
        at = (at - 1) / CHILDREN;
    }
    set(heap, at, entry);
}

static void sink(iccp_heap *heap, size_t at, iccp_heap_entry entry)
{
    for (;;) {
        const size_t first = CHILDREN * at + 1;
        const size_t end = first + CHILDREN < heap->n_entries ? first + CHILDREN : heap->n_entries;
        size_t least = first;
        for (size_t i = first + 1; i < end; ++i)
            if (comes_before(heap->entry[i], heap->entry[least]))
                least = i;
        if (first >= end || !comes_before(heap->entry[least], entry))
            break;
        set(heap, at, heap->entry[least]);
        at = least;
    }
    set(heap, at, entry);
}

void iccp_heap_put(iccp_heap *heap, uint32_t number, double key)
{
    const iccp_heap_entry entry = {key, number};
    size_t at = heap->place[number];
    if (at == UINT32_MAX)
        at = heap->n_entries++;
    else if (comes_before(heap->entry[at], entry)) {
        sink(heap, at, entry);
        return;
    }
    rise(heap, at, entry);
}

uint32_t iccp_heap_pop(iccp_heap *heap)
{
    const uint32_t number = heap->entry[0].number;
    heap->place[number] = UINT32_MAX;
    if (--heap->n_entries > 0)
        sink(heap, 0, heap->entry[heap->n_entries]);
    return number;
}
