/* Allocation that ends the program when memory runs out. */
#include "base/allocate.h"

#include "base/say.h"

#include <stdint.h>
#include <stdlib.h>

void *need(size_t n, size_t size)
{
    void *memory = calloc(n > 0 ? n : 1, size);
    if (memory == NULL)
        exit(failed(NULL, 0, "not enough memory for %zu items of %zu bytes", n, size));
    return memory;
}

void *grow(void *array, size_t *capacity, size_t wanted, size_t size)
{
    if (wanted <= *capacity)
        return array;
    size_t n = *capacity < 32 ? 64 : *capacity * 2;
    if (n < wanted)
        n = wanted;
    void *memory = n <= SIZE_MAX / size ? realloc(array, n * size) : NULL;
    if (memory == NULL)
        exit(failed(NULL, 0, "not enough memory for %zu items of %zu bytes", n, size));
    *capacity = n;
    return memory;
}
