/* Masks from NumPy's .npy files. Axis k of the array is coordinate k. */
#include "cage/cage_readers.h"

#include "base/allocate.h"
#include "base/npy.h"

#include <stdlib.h>
#include <string.h>

/* Bytes of a cell for integers and truth values of any size and byte order, or 0 for other
 * types. */
static size_t cell_size(const char *type)
{
    const char *p = type + (*type != '\0' && strchr("|<>=", *type) != NULL);
    bool known = *p != '\0' && strchr("bui", *p) != NULL && p[1] != '\0' &&
                 strchr("1248", p[1]) != NULL && p[2] == '\0' && (*p != 'b' || p[1] == '1');
    return known ? (size_t)(p[1] - '0') : 0;
}

/* Visits the cells in the order of the file. `at` are the indices of the current cell. */
static void take_cells(cage *c, const npy *a, size_t n, size_t size)
{
    size_t at[ICC_MAX_DIM] = {0}, dim = c->dim;
    c->cells = need(n, 1);
    for (size_t i = 0; i < n; i++) {
        size_t index = 0;
        for (size_t k = dim; k-- > 0;)
            index = index * c->shape[k] + at[k];
        for (size_t b = 0; b < size; b++)
            c->cells[index] |= a->data[i * size + b] != 0;
        for (size_t k = 0; k < dim; k++) {
            size_t axis = a->is_fortran ? k : dim - 1 - k;
            if (++at[axis] < c->shape[axis])
                break;
            at[axis] = 0;
        }
    }
}

bool cage_read_npy(cage *out, const char *text, size_t n, problem *wrong)
{
    npy a;
    if (!npy_read(&a, text, n, wrong))
        return false;
    size_t size = cell_size(a.type);
    if (size == 0)
        return spoilt(wrong, 0,
                      "the cells are of type '%s'; a mask has whole numbers or truth values: save "
                      "(array > 0)",
                      a.type);
    size_t n_cells = npy_cells(&a, size, wrong);
    if (n_cells == 0)
        return false;
    out->dim = a.dim;
    memcpy(out->shape, a.shape, a.dim * sizeof *a.shape);
    take_cells(out, &a, n_cells, size);
    return true;
}
