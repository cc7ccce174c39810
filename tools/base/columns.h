/* How the lines of a table are divided: by white space, or by commas or semicolons, as spreadsheets
 * write them, with a heading or without. */
#ifndef COLUMNS_H
#define COLUMNS_H

#include "base/table.h"

enum { MAX_NUMBERS = 16 };

typedef struct columns {
    char separator;           /* '\0': white space */
    size_t n_cells;           /* that each separated row must have */
    size_t cell[MAX_NUMBERS]; /* where each number of a separated row stands */
} columns;

/* A cell without the blanks and the quotes around it. */
typedef struct cell {
    const char *begin, *end;
} cell;

/* The cell at p of a row that ends at `end`. Returns where the next one begins; NULL: this was the
 * last. */
const char *columns_cell(cell *out, const char *p, const char *end, char separator);

/* Learns from the first line that is not empty how all lines are divided, and whether it is a
 * heading. Columns that a heading calls x, y and z, or the like, are taken in this order, and others
 * are left out. False: see `wrong`. */
bool columns_learn(columns *out, bool *is_heading, const char *line, const table_form *form,
                   problem *wrong);

#endif
