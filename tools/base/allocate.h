/* Allocates memory or ends the program, because a command cannot go on without it. */
#ifndef ALLOCATE_H
#define ALLOCATE_H

#include <stddef.h>

/* Allocates n * size bytes, all zero; free() them. Never returns NULL: if there is no memory, it
 * prints a message and exits with 1. */
void *need(size_t n, size_t size);

/* Makes room for at least `wanted` items in an array of *capacity items. The capacity at least
 * doubles. */
void *grow(void *array, size_t *capacity, size_t wanted, size_t size);

#endif
