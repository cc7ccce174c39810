/* Allocation through the caller's functions. Objects keep an iccp_memory and nothing else of
 * the environment that they were made with. */
#ifndef ICCP_MEMORY_H
#define ICCP_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

typedef struct iccp_memory {
    void *user;
    void *(*alloc)(void *user, size_t size);
    void (*dealloc)(void *user, void *memory);
} iccp_memory;

/* malloc and free. */
extern const iccp_memory iccp_memory_default;

/* n elements of the given size, uninitialised; NULL when the product overflows or there is no
 * memory. n == 0, or size == 0, gives a valid pointer, so that NULL always means failure. */
void *iccp_alloc(const iccp_memory *memory, size_t n, size_t size);

/* The same, all bytes zero. */
void *iccp_alloc_zero(const iccp_memory *memory, size_t n, size_t size);

/* Moves an array of n_old elements into a new one of n_new >= n_old and frees the old one (which
 * may be NULL). On failure returns NULL and leaves the old one as it was. */
void *iccp_grow(const iccp_memory *memory, void *old, size_t n_old, size_t n_new, size_t size);

/* The same for the pointer to an array that `array` points to. Whether there is memory. */
bool iccp_enlarge(const iccp_memory *memory, void *array, size_t n_old, size_t n_new, size_t size);

/* NULL is a no-op. */
void iccp_free(const iccp_memory *memory, void *pointer);

#endif
