/* Reads lines of numbers: text cages, points, coordinates. */
#ifndef TABLE_H
#define TABLE_H

#include "base/say.h"

#include <stdbool.h>

typedef struct table {
    size_t n;       /* rows */
    size_t columns; /* numbers in a row */
    double *values; /* n * columns */
    size_t *lines;  /* line of each row, from 1 */
    size_t room_values, room_lines;
} table;

/* The form that the rows must have. */
typedef struct table_form {
    size_t columns;
    size_t axes;      /* how many of the first numbers are coordinates, which a heading may name */
    bool special;     /* nan and inf are allowed (a point that already has no image) */
    const char *what; /* for messages: "a point is `x y`" */
    const char *word; /* a row that is only this word has nan for all its numbers; or NULL */
} table_form;

/* Reads rows of numbers from text[0..n), with text[n] == '\0'. Numbers are separated by white
 * space, or in all rows by commas or semicolons. A table of the latter kind may have a heading
 * (columns.h). A byte order mark, CR LF, blank lines and lines that begin with '#' are accepted.
 * False: see `wrong`. Free the table in either case. */
bool table_read(table *out, const char *text, size_t n, const table_form *form, problem *wrong);

/* Returns room for one more row. The caller increases `n` to keep it. */
double *table_add_row(table *t, size_t line);

void table_free(table *t);

#endif
