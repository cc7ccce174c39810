/* Allocates through the caller's functions. An object keeps an iccp_memory and nothing else of the
 * environment that made it. */
#ifndef ICCP_MEMORY_H
#define ICCP_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

typedef struct iccp_memory {
    void *user;
    void *(*alloc)(void *user, size_t size);
    void (*dealloc)(void *user, void *memory);
} iccp_memory;

/* Uses malloc() and free(). */
extern const iccp_memory iccp_memory_default;

/* Allocates n elements of the given size, uninitialised. Returns NULL if the product overflows or
 * there is no memory. If n or size is 0, the pointer is valid, so NULL always means failure. */
void *iccp_alloc(const iccp_memory *memory, size_t n, size_t size);

/* Like iccp_alloc(), with all bytes zero. */
void *iccp_alloc_zero(const iccp_memory *memory, size_t n, size_t size);

/* Moves an array of n_old elements into a new one of n_new >= n_old and frees the old one, which
 * may be NULL. On failure returns NULL and keeps the old array. */
void *iccp_grow(const iccp_memory *memory, void *old, size_t n_old, size_t n_new, size_t size);

/* Like iccp_grow(), for the array pointer that `array` points to. Returns false if there is no
 * memory. */
bool iccp_enlarge(const iccp_memory *memory, void *array, size_t n_old, size_t n_new, size_t size);

/* NULL does nothing. */
void iccp_free(const iccp_memory *memory, void *pointer);

#endif
