/* Points in, points out. */
#ifndef ROWS_H
#define ROWS_H

#include "job.h"
#include "table.h"

/* Reads rows from a file. Returns DONE, or FAILED with a line on stderr. Free the table then. */
int rows_read(table *out, const char *name, const table_form *form);

/* Writes rows of numbers as %.17g, with "nan" for whatever is not a number. */
int rows_write(const char *name, size_t n, size_t columns, const double *values);

#endif
