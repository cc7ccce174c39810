/* Masks of bytes from NumPy's .npy files. */
#ifndef TESTS_NPY_H
#define TESTS_NPY_H

#include "icc/base.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct npy {
    int32_t dim;
    size_t shape[ICC_MAX_DIM];
    uint8_t *cells; /* the first axis fastest; free()d by the caller */
} npy;

/* Turns an array whose last axis runs fastest round. */
static inline void npy_turn(npy *a, const uint8_t *from)
{
    size_t at[ICC_MAX_DIM] = {0};
    for (size_t i = 0;; ++i) {
        size_t index = 0;
        for (int32_t k = a->dim; k-- > 0;)
            index = index * a->shape[k] + at[k];
        a->cells[index] = from[i];
        int32_t k = a->dim - 1;
        while (k >= 0 && ++at[k] == a->shape[k])
            at[k--] = 0;
        if (k < 0)
            return;
    }
}

/* False unless the file is there and holds bytes, the last axis fastest. */
static inline bool npy_read(npy *a, const char *path)
{
    FILE *file = fopen(path, "rb");
    char header[1024] = {0}, *at = NULL;
    unsigned char start[10];
    bool good = file != NULL && fread(start, 1, 10, file) == 10;
    const size_t length = good ? start[8] + 256u * start[9] : 0;
    good = good && length < sizeof header && fread(header, 1, length, file) == length &&
           strstr(header, "|u1") != NULL && strstr(header, "False") != NULL &&
           (at = strstr(header, "shape': (")) != NULL;
    *a = (npy){0};
    size_t n = 1;
    for (at = good ? at + 9 : header; good && *at != ')' && a->dim < ICC_MAX_DIM;) {
        char *end;
        a->shape[a->dim] = strtoul(at, &end, 10);
        n *= end > at ? a->shape[a->dim++] : 1;
        at = end > at ? end : at + 1;
    }
    uint8_t *raw = malloc(n + 1);
    a->cells = malloc(n + 1);
    good = good && raw != NULL && a->cells != NULL && fread(raw, 1, n, file) == n;
    if (good && n > 0)
        npy_turn(a, raw);
    free(raw);
    if (file != NULL)
        (void)fclose(file);
    return good;
}

#endif
