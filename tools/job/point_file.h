/* Reads and writes points. */
#ifndef POINT_FILE_H
#define POINT_FILE_H

#include "base/table.h"
#include "job/job.h"

/* The forms of rows of points, and of integral curve coordinates. */
table_form rows_of_points(size_t dim);
table_form rows_of_coordinates(size_t dim);

/* Reads rows from a file. Returns DONE, or FAILED with a message on stderr. Free the table if it is
 * DONE. */
int rows_read(table *out, const char *name, const table_form *form);

/* Writes rows of numbers as %.17g, and "nan" for values that are not numbers. */
int rows_write(const char *name, size_t n, size_t columns, const double *values);

#endif
