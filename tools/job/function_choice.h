/* The functions of method gradient: what --function asks for, and what the library made. */
#ifndef FUNCTION_CHOICE_H
#define FUNCTION_CHOICE_H

#include "base/json.h"
#include "base/say.h"

#include <icc/stages.h>
#include <stdint.h>

enum { MAX_FUNCTIONS = 8 };

typedef struct function_choice {
    int32_t function;    /* ICC_FUNCTION_*; 0: the library's choice */
    int32_t constraints; /* ICC_CONSTRAINTS_*; 0: not given */
} function_choice;

/* Reads NAME[:constrained|:unconstrained], several with commas between. Returns their number. 0:
 * see `wrong`. */
size_t functions_parse(function_choice out[MAX_FUNCTIONS], const char *text, problem *wrong);

/* True if a function solves an equation. Only such functions have constraints and a solver. */
bool function_solves(int32_t function);

/* Its name, as in "laplace, unconstrained". */
const char *function_label(char text[48], const icc_function_info *info);

/* Writes the members of the report that tell how it was made. */
void function_report(json *j, const icc_function_info *info, const icc_solver_report *made);

#endif
