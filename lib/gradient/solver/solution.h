/* The facts about a function that a solver has found. icc_function_info and icc_solver_report are
 * filled in from them. */
#ifndef ICCP_SOLUTION_H
#define ICCP_SOLUTION_H

#include "icc/stages.h"

/* Largest error of a component, relative to the component. It is far above the 1e-15 of correct
 * solutions and far below the 1 of wrong ones. */
#define ICCP_MOST_ERROR 1e-6

typedef struct iccp_solution {
    int32_t function, constrained, solver, beside;
    size_t n_unknowns, n_violated, n_active;
    size_t n_iterations, n_inner;
    double work, residual_before, residual, least_log;
    double seconds_setup, seconds_order, seconds_factor, seconds_solve, seconds_verify;
    double excess;
    uint32_t highest;
} iccp_solution;

#endif
