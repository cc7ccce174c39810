/* Memory that is there, or the program ends: a command has nothing better to do without it. */
#ifndef ALLOCATE_H
#define ALLOCATE_H

#include <stddef.h>

/* n * size bytes, all zero; never NULL, free() it. Says so and exits 1 when there is no memory. */
void *need(size_t n, size_t size);

/* Makes room for at least `wanted` items in an array of *capacity, which at least doubles. */
void *grow(void *array, size_t *capacity, size_t wanted, size_t size);

#endif
