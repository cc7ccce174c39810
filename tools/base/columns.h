/* How the lines of a table are divided: by white space, or by commas or semicolons as spreadsheets
 * write them, with or without a heading. */
#ifndef COLUMNS_H
#define COLUMNS_H

#include "base/table.h"

enum { MAX_NUMBERS = 16 };

typedef struct columns {
    char separator;           /* '\0' stands for white space */
    size_t n_cells;           /* that each separated row must have */
    size_t cell[MAX_NUMBERS]; /* the column of each number in a separated row */
} columns;

/* A cell without the blanks and the quotes around it. */
typedef struct cell {
    const char *begin, *end;
} cell;

/* Finds the cell at p of a row that ends at `end`. Returns where the next cell begins, or NULL
 * after the last one. */
const char *columns_cell(cell *out, const char *p, const char *end, char separator);

/* The separator of a row: a semicolon if it has one, else a comma, else '\0'. */
char columns_separator(const char *p, const char *end);

/* True if a cell has this name, which is in lower case, whatever its case. */
bool columns_is_name(const cell *c, const char *name);

/* The axis that a cell of a heading names: 0 for x, 1 for y, 2 for z, else N_AXES. */
enum { N_AXES = 3 };
size_t columns_axis(const cell *c);

/* Learns from the first line that is not empty how all lines are divided, and whether it is a
 * heading. If a heading names columns x, y and z, or the like, they are taken in this order and
 * other columns are ignored. False: see `wrong`. */
bool columns_learn(columns *out, bool *is_heading, const char *line, const table_form *form,
                   problem *wrong);

#endif
