/* Allocates through the caller's functions. */
#include "base/memory.h"

#include <assert.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static void *default_alloc(void *user, size_t size)
{
    (void)user;
    return malloc(size);
}

static void default_dealloc(void *user, void *memory)
{
    (void)user;
    free(memory);
}

const iccp_memory iccp_memory_default = {NULL, default_alloc, default_dealloc};

static size_t bytes_of(size_t n, size_t size)
{
    const size_t bytes = (n > 0 ? n : 1) * size;
    return bytes > 0 ? bytes : 1;
}

void *iccp_alloc(const iccp_memory *memory, size_t n, size_t size)
{
    if (size > 0 && n > SIZE_MAX / 2 / size)
        return NULL;
    return memory->alloc(memory->user, bytes_of(n, size));
}

void *iccp_alloc_zero(const iccp_memory *memory, size_t n, size_t size)
{
    void *pointer = iccp_alloc(memory, n, size);
    if (pointer != NULL)
        memset(pointer, 0, bytes_of(n, size));
    return pointer;
}

void *iccp_grow(const iccp_memory *memory, void *old, size_t n_old, size_t n_new, size_t size)
{
    assert(n_new >= n_old);
    void *pointer = iccp_alloc(memory, n_new, size);
    if (pointer == NULL)
        return NULL;
    if (old != NULL) {
        memcpy(pointer, old, n_old * size);
        iccp_free(memory, old);
    }
    return pointer;
}

bool iccp_enlarge(const iccp_memory *memory, void *array, size_t n_old, size_t n_new, size_t size)
{
    void *old;
    memcpy(&old, array, sizeof old);
    void *larger = iccp_grow(memory, old, n_old, n_new, size);
    if (larger != NULL)
        memcpy(array, &larger, sizeof larger);
    return larger != NULL;
}

void iccp_free(const iccp_memory *memory, void *pointer)
{
    if (pointer != NULL)
        memory->dealloc(memory->user, pointer);
}
