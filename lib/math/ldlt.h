/* Sparse LDL^T factorisation of a symmetric matrix by supernodes. The matrix is positive definite
 * or quasi-definite. */
#ifndef ICCP_LDLT_H
#define ICCP_LDLT_H

#include "base/env.h"
#include "math/scaled.h"
#include "math/subtrees.h"
#include "math/symmetric.h"

#include <stdbool.h>

typedef struct iccp_ldlt {
    iccp_memory memory;
    size_t n;
    uint32_t *order;    /* the row that is eliminated k-th */
    uint32_t *position; /* the step in which a row is eliminated */
    iccp_supernodes nodes;
    size_t n_entries; /* entries of L below the diagonal */
    double work;      /* multiplications of one factorisation, except those by stored zeros */
    double *value;    /* panels of L; NULL before the first factorisation */
    double *pivot;    /* D */
    /* Set by the first factorisation with threads: subtrees that run at the same time. The small
     * ones lie inside large ones and run first. */
    iccp_subtrees large, small;
    bool borrows; /* everything except these, L and D belongs to another factor */
} iccp_ldlt;

/* Orders and analyses a matrix by its pattern alone. Rows come in groups of `block` with the same
 * pattern, and the groups are ordered. Afterwards `work`, `n_entries` and iccp_ldlt_bytes() are
 * known. On failure nothing stays allocated. */
icc_status iccp_ldlt_analyse(iccp_ldlt *factor, const iccp_symmetric *matrix, size_t block,
                             const iccp_env *env);

/* Like iccp_ldlt_analyse(), with the caller's order: order[k] is eliminated k-th, or at another
 * time that gives the same factor. */
icc_status iccp_ldlt_analyse_ordered(iccp_ldlt *factor, const iccp_symmetric *matrix,
                                     const uint32_t *order, const iccp_env *env);

/* Reuses an analysis for a matrix of the same pattern. `analysed` must live longer; it is only
 * read, so several factors may share it. */
void iccp_ldlt_share(iccp_ldlt *factor, const iccp_ldlt *analysed, const iccp_memory *memory);

/* Bytes of L and D. A factorisation needs only a few words per row more, and 36 doubles per column
 * of the widest supernode. */
double iccp_ldlt_bytes(const iccp_ldlt *factor);

/* Factorises a matrix with the analysed pattern. Reads only entries in the earlier of two rows, in
 * order of elimination; the others may be left out. The first call allocates the memory. Returns
 * ICC_ERR_SOLVER if a pivot is not positive: the matrix is not positive definite to working
 * precision. The cost is proportional to the sum of the squared column counts of L. Every processor
 * gives the same bits. */
icc_status iccp_ldlt_factorise(iccp_ldlt *factor, const iccp_symmetric *matrix,
                               const iccp_env *env);

/* Like iccp_ldlt_factorise(), for a quasi-definite matrix. sign[i] is 1 or -1, the sign of row i's
 * pivot. Returns ICC_ERR_SOLVER if a pivot has another sign. */
icc_status iccp_ldlt_factorise_signed(iccp_ldlt *factor, const iccp_symmetric *matrix,
                                      const int8_t *sign, const iccp_env *env);

/* Accepts a factor that was freed, or never analysed (all zeros except its memory). */
void iccp_ldlt_free(iccp_ldlt *factor);

/* Solves for n_rhs right-hand sides at once. Entry i of column r is b[i * n_rhs + r] and is
 * replaced by the solution. `work` has room for n * n_rhs doubles. */
void iccp_ldlt_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work);

/* Like iccp_ldlt_solve(), with the same bits, on all threads of `env`. */
void iccp_ldlt_solve_at_once(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work,
                             const iccp_env *env);

/* Marks the supernodes that solutions at the given rows depend on, and that right-hand sides there
 * reach. `needed` has factor->nodes.n entries. Earlier marks stay. */
void iccp_ldlt_mark(const iccp_ldlt *factor, size_t n, const uint32_t *rows, uint8_t *needed);

/* Lists all marked rows in rising order and returns their number. `rows` has room for n. */
size_t iccp_ldlt_marked(const iccp_ldlt *factor, const uint8_t *needed, uint32_t *rows);

/* Like iccp_ldlt_solve(), if b is 0 except at marked rows. Solves only at marked rows, in time that
 * depends on their number. Does not look at other rows. */
void iccp_ldlt_solve_marked(const iccp_ldlt *factor, const uint8_t *needed, size_t n_rhs, double *b,
                            double *work);

/* Right-hand sides that iccp_ldlt_forms() takes at once. */
enum { ICCP_LDLT_FORMS = 4 };

/* Computes form[c] = b_c' A^-1 b_c for ICCP_LDLT_FORMS sparse right-hand sides b_c. `rows` lists
 * the n rows where one of them is not 0, possibly several times. values[ICCP_LDLT_FORMS k + c] is
 * added to entry rows[k] of b_c. Only supernodes that the rows reach are visited.
 *
 * `work` has ICCP_LDLT_FORMS * factor->n doubles and `needed` has factor->nodes.n entries. All of
 * them are 0 before and after the call. `path` has room for factor->nodes.n numbers. */
void iccp_ldlt_forms(const iccp_ldlt *factor, size_t n, const uint32_t *rows, const double *values,
                     double form[ICCP_LDLT_FORMS], double *work, uint8_t *needed, uint32_t *path);

/* Solves for one right-hand side of normalised numbers, without underflow or overflow. `work` has
 * room for n of them. Returns ICC_OK or ICC_ERR_CANCELLED.
 *
 * If the matrix is an M-matrix and the right-hand side is not negative, nothing cancels. Then every
 * component of the solution is right to its last few digits, unless entries of L itself underflow.
 * Underflow happens if the order joins rows directly whose numbers differ by 10^150. Orders by
 * degree do so in long loops, but not at dead ends of corridors. An order by falling distance from
 * the source never does. */
icc_status iccp_ldlt_solve_scaled(const iccp_ldlt *factor, const iccp_scaled *b,
                                  const iccp_scaled *work, const iccp_env *env);

#endif
