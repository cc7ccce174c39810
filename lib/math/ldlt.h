/* Sparse LDL^T factorisation of a symmetric matrix, positive definite or quasi-definite, by
 * supernodes. */
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
    uint32_t *position; /* when a row is eliminated */
    iccp_supernodes nodes;
    size_t n_entries; /* of L, below the diagonal */
    double work;      /* multiplications of one factorisation, without those by stored zeros */
    double *value;    /* the panels of L; NULL before the first factorisation */
    double *pivot;    /* D */
    iccp_subtrees large, small; /* with threads, from the first factorisation on: what can be done
                                   at the same time, and before that, inside those */
    bool borrows;               /* everything but these, L and D belongs to another one */
} iccp_ldlt;

/* Orders and analyses a matrix by its pattern alone. Rows come in groups of `block` with the same
 * pattern; the groups are ordered. From then on `work`, `n_entries` and what the panels will take,
 * iccp_ldlt_bytes(), are known. On failure nothing is left allocated. */
icc_status iccp_ldlt_analyse(iccp_ldlt *factor, const iccp_symmetric *matrix, size_t block,
                             const iccp_env *env);

/* The same with an order that the caller has: order[k] is eliminated k-th, or at another time when
 * that makes no difference to the factor. */
icc_status iccp_ldlt_analyse_ordered(iccp_ldlt *factor, const iccp_symmetric *matrix,
                                     const uint32_t *order, const iccp_env *env);

/* For a matrix of the same pattern as the one that `analysed` is for, which must live longer; it is
 * only read, and several may share it. */
void iccp_ldlt_share(iccp_ldlt *factor, const iccp_ldlt *analysed, const iccp_memory *memory);

/* Bytes of L and D: all that a factorisation takes but for a few words per row and 36 doubles per
 * column of the widest supernode. */
double iccp_ldlt_bytes(const iccp_ldlt *factor);

/* Factorises a matrix with the analysed pattern, into the memory that the first call allocates.
 * ICC_ERR_SOLVER when a pivot is not positive: the matrix is not positive definite to working
 * precision. Cost: proportional to the sum of the squared column counts of L. The same bits on
 * every processor. */
icc_status iccp_ldlt_factorise(iccp_ldlt *factor, const iccp_symmetric *matrix,
                               const iccp_env *env);

/* The same for a quasi-definite matrix: sign[i], 1 or -1, is that of the pivot of row i.
 * ICC_ERR_SOLVER when a pivot has another sign. */
icc_status iccp_ldlt_factorise_signed(iccp_ldlt *factor, const iccp_symmetric *matrix,
                                      const int8_t *sign, const iccp_env *env);

/* Accepts what was never analysed (zeroed but for its memory) or freed. */
void iccp_ldlt_free(iccp_ldlt *factor);

/* Solves for n_rhs right-hand sides at once: entry i of column r at b[i * n_rhs + r], replaced
 * by the solution. `work` has room for n * n_rhs doubles. */
void iccp_ldlt_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work);

/* The same on all threads of `env`, and the same bits. */
void iccp_ldlt_solve_at_once(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work,
                             const iccp_env *env);

/* Marks what solutions at some rows depend on, and what right-hand sides there reach: in `needed`,
 * which has factor->nodes.n entries, those of marks before included. */
void iccp_ldlt_mark(const iccp_ldlt *factor, size_t n, const uint32_t *rows, uint8_t *needed);

/* Lists all rows that are marked, rising; room for n of them. Returns how many there are. */
size_t iccp_ldlt_marked(const iccp_ldlt *factor, const uint8_t *needed, uint32_t *rows);

/* As iccp_ldlt_solve() where b is 0 but for marked rows: it is solved for at those only, and in
 * time that depends on them. Others are not looked at. */
void iccp_ldlt_solve_marked(const iccp_ldlt *factor, const uint8_t *needed, size_t n_rhs, double *b,
                            double *work);

/* The same for one right-hand side of normalised numbers, without under- or overflow. `work` has
 * room for n of them. ICC_OK, or ICC_ERR_CANCELLED. The solution of an M-matrix with a
 * right-hand side that is not negative is right to the last few digits in every component, since
 * nothing cancels, unless entries of L itself underflow: orders that join rows directly whose
 * numbers differ by 10^150 lose them. Orders by degree do that in long loops, not where
 * corridors end; an order by falling distance from the source never does. */
icc_status iccp_ldlt_solve_scaled(const iccp_ldlt *factor, const iccp_scaled *b,
                                  const iccp_scaled *work, const iccp_env *env);

#endif
