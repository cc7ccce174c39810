/* NumPy's .npy files. */
#ifndef NPY_H
#define NPY_H

#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>

enum { NPY_MOST_AXES = 6, NPY_WORD = 24 };

typedef struct npy {
    char type[NPY_WORD];              /* as written in the header: "<f4" */
    bool is_fortran;                  /* the first axis runs fastest */
    size_t dim, shape[NPY_MOST_AXES]; /* at least 1 each */
    const char *data;                 /* borrowed: the bytes that were read */
    size_t n_bytes;
} npy;

/* True if the first bytes are those of a .npy file. */
bool npy_told(const char *bytes, size_t n);

/* Reads the header of such a file. False: see `wrong`. */
bool npy_read(npy *out, const char *bytes, size_t n, problem *wrong);

/* The number of cells of `size` bytes. 0: see `wrong`, the data do not have the length that the
 * shape requires. */
size_t npy_cells(const npy *a, size_t size, problem *wrong);

#endif
