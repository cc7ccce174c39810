/* Points in, points out. */
#ifndef POINT_FILE_H
#define POINT_FILE_H

#include "base/table.h"
#include "job/job.h"

/* Rows of points, and of integral curve coordinates. */
table_form rows_of_points(size_t dim);
table_form rows_of_coordinates(size_t dim);

/* Reads rows from a file. Returns DONE, or FAILED with a line on stderr. Free the table then. */
int rows_read(table *out, const char *name, const table_form *form);

/* Writes rows of numbers as %.17g, with "nan" for whatever is not a number. */
int rows_write(const char *name, size_t n, size_t columns, const double *values);

#endif
