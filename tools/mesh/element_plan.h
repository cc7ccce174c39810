/* Plans for the elements of one kind. A plan computes the Bernstein coefficients of the Jacobian
 * determinant from the nodes, and subdivides them. */
#ifndef ELEMENT_PLAN_H
#define ELEMENT_PLAN_H

#include "mesh/element_sign.h"

#include <stdbool.h>

/* Exponents of three factors with two vertices each, or of fewer with more. */
enum { N_EXPONENTS = 6, MOST_ROWS = 18, MOST_PAIRS = 6, MOST_DEGREE = 5 };

/* Limits of subdivision: bisections in a row, and parts in all. Larger limits only help for
 * elements whose determinant is nearly 0 somewhere. */
enum { DEEPEST = 24, MOST_PARTS = 256 };

/* Coefficient `to` gets `weight` times the determinant of rows a, b, c of the three derivatives. */
typedef struct term {
    unsigned short a, b, c, to;
    double weight;
} term;

/* The n + 1 coefficients along an edge of a factor, whose other exponents are the same. */
typedef struct bernstein_line {
    unsigned short n, at[MOST_DEGREE + 1];
} bernstein_line;

struct element_plan {
    const element_kind *kind;
    const element_product *product;
    size_t dim, n_nodes;
    size_t first[4]; /* the first exponent of each factor, then the number of exponents */
    size_t n_rows[3];
    double *rows[3]; /* derivatives along each direction: n_rows * n_nodes shares of the nodes */
    size_t n_terms, n_coefficients;
    term *terms;
    double *rounding; /* of each coefficient, in units of its size */
    size_t n_corners;
    unsigned short corners[8]; /* coefficients that are the values at corners */
    size_t n_pairs, n_lines[MOST_PAIRS];
    bernstein_line *lines[MOST_PAIRS];
    double *work; /* (DEEPEST + 2) * 2 * n_coefficients: lower and upper bounds */
};

/* True if the signs at the corners decide alone. Then a plan has no coefficients. */
bool element_corners_decide(const element_kind *k);

#endif
