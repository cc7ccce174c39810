/* Paths of least cost through a lattice of pairs of samples, open and cyclic. */
#ifndef ICCP_LATTICE_PATH_H
#define ICCP_LATTICE_PATH_H

#include "base/env.h"

/* A path from (0, j) to (n, j + n): its points, in pairs. */
typedef struct iccp_lattice_path {
    int32_t n_points; /* 0 if there is no path */
    int32_t *points;  /* room for 2 n + 1 pairs */
    double cost;      /* for each sample */
} iccp_lattice_path;

/* Memory for searches in lattices of at most n + 1 rows, in which paths advance n columns. */
typedef struct iccp_lattice {
    int32_t n;
    int32_t *low, *high; /* n + 1: the columns of each row that a path may use, of 0 to 2 n; the
                            caller sets them */
    size_t *row;         /* n + 2 */
    float *best;         /* (n + 1) (2 n + 1) */
    unsigned char *from; /* the same number */
    int32_t *step;       /* 2 n + 1 */
} iccp_lattice;

icc_status iccp_lattice_create(iccp_lattice *lattice, int32_t n, const iccp_memory *memory);
/* Accepts a struct of zeros. */
void iccp_lattice_free(iccp_lattice *lattice, const iccp_memory *memory);

/* Finds the path of least cost from (0, first) to (n, first + n) within the rows' columns. The cost
 * of a pair is in row i, column j of an array with `width` columns. */
void iccp_lattice_search(iccp_lattice_path *path, iccp_lattice *lattice, int32_t n,
                         const float *cost, size_t width, int32_t first);

/* Finds paths from every `stride`-th column of a cyclic lattice: n / stride paths. `cost` has n + 1
 * rows of 2 n + 1 columns. n and stride are powers of two. */
icc_status iccp_lattice_cyclic(iccp_lattice_path *paths, iccp_lattice *lattice, int32_t n,
                               const float *cost, int32_t stride, const iccp_env *env);

#endif
