/* Argument checks that several functions share, and how a call begins and ends.
 *
 * Words of this folder
 * - api_*.c: one file for each group of exported functions. It checks arguments, calls lib/ and
 *   writes results.
 * - begin, end: iccp_begin() reads the environment, iccp_end_*() makes the last progress report.
 * - struct of the caller's version: a struct with `size`, read and written by base/options.h.
 * - missing: the name of the first required argument that is NULL.
 *
 * Invariants: every exported function that computes starts with ICCP_ENTER (base/fpenv.h).
 * Checks of plain arguments (NULL, ranges, struct sizes) stand here, and functions below rely on
 * them. Checks of geometry stand with the algorithms, and no algorithm stands here. A failed call
 * that makes an object sets it to NULL.
 *
 * Begin with the api_*.c file of your function. include/icc has the contracts. */
#ifndef ICCP_CHECK_H
#define ICCP_CHECK_H

#include "base/env.h"
#include "base/error.h"
#include "base/fpenv.h"
#include "icc/stages.h"

/* Reads the caller's options, which may be NULL. Members that are not given stay 0. */
icc_status iccp_read_chart_options(icc_chart_options *full, const icc_chart_options *options,
                                   int32_t dim, icc_error *err);

/* Checks how a function is made. The options of a function and of a chart both say it. `name` is
 * the name of the options' struct in messages. */
icc_status iccp_check_function(const icc_function_options *options, const char *name,
                               icc_error *err);

/* Checks that the order is a permutation of the dim axes. NULL stands for the usual order. */
icc_status iccp_check_axis_order(const int32_t *order, int32_t dim, icc_error *err);

/* Checks a maximum that the caller wants. NULL is accepted. */
icc_status iccp_check_maximum(const double *maximum, int32_t dim, icc_error *err);

/* Checks the arrays of a boundary, but not what stands in them. `facets` may be NULL. */
icc_status iccp_check_counts(size_t n_vertices, const double *vertices, size_t n_facets,
                             const uint32_t *facets, icc_error *err);

/* Reads the caller's mesh, in which only simplices are supported. Checks the struct itself, but no
 * vertex and no index. */
icc_status iccp_read_mesh(icc_mesh *full, const icc_mesh *mesh, icc_error *err);

/* Like iccp_read_mesh(). In space the mesh may have regions. */
icc_status iccp_read_solid_mesh(icc_mesh *full, const icc_mesh *mesh, icc_error *err);

/* Like iccp_read_mesh(). In the plane the mesh may have quadrilaterals, too. */
icc_status iccp_read_faces(icc_mesh *full, const icc_mesh *mesh, icc_error *err);

/* Finds the arrays of a mesh that the caller has room for; NULL where nothing is to be filled. Sets
 * the numbers of the caller's struct. ICC_ERR_ARGUMENT if there is too little room. */
icc_status iccp_size_mesh(double **vertices, uint32_t **cells, icc_mesh *mesh, int32_t dim,
                          size_t n_vertices, size_t n_cells);

/* Begins a call: reads the caller's environment. `missing` is the name of the first argument
 * that is NULL, or NULL if none is. */
icc_status iccp_begin(iccp_env *full, const icc_env *env, const char *missing, icc_error *err);

/* Ends a call that makes an object with its last progress report. A caller that cancels even
 * then gets no object. */
#define ICCP_END(type)                                                                             \
    static inline icc_status iccp_end_##type(icc_status status, icc_##type **out,                  \
                                             const iccp_env *env, icc_error *err)                  \
    {                                                                                              \
        const icc_status end = iccp_finish(env, status);                                           \
        if (status == ICC_OK && end != ICC_OK) {                                                   \
            iccp_##type##_release(*out);                                                           \
            *out = NULL;                                                                           \
        }                                                                                          \
        return status == ICC_OK ? iccp_explain(err, end) : status;                                 \
    }

#endif
