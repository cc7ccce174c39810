/* Reads and writes tables of points. */
#include "job/point_file.h"

#include "base/decimal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

table_form rows_of_points(size_t dim)
{
    static const char *const forms[ICC_MAX_DIM + 1] = {"",
                                                       "a point is `x`, one per line",
                                                       "a point is `x y`, one per line",
                                                       "a point is `x y z`, one per line",
                                                       "a point is 4 numbers, one point per line",
                                                       "a point is 5 numbers, one point per line",
                                                       "a point is 6 numbers, one point per line"};
    return (table_form){.columns = dim, .axes = dim, .special = true, .what = forms[dim]};
}

table_form rows_of_coordinates(size_t dim)
{
    static const char *const forms[ICC_MAX_DIM + 1] = {
        "",
        "coordinates are `facet b0 t`, one row per line",
        "coordinates are `facet b0 b1 t`, one row per line",
        "coordinates are `facet b0 b1 b2 t`, one row per line",
        "coordinates are `facet b0 .. b3 t`, one row per line",
        "coordinates are `facet b0 .. b4 t`, one row per line",
        "coordinates are `facet b0 .. b5 t`, one row per line"};
    return (table_form){.columns = dim + 2, .special = true, .what = forms[dim]};
}

int rows_read(table *out, const char *name, const table_form *form)
{
    size_t n;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    problem wrong;
    bool good = table_read(out, text, n, form, &wrong);
    free(text);
    if (good)
        return DONE;
    table_free(out);
    return failed(name, wrong.line, "%s", wrong.text);
}

int rows_write(const char *name, size_t n, size_t columns, const double *values)
{
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    char block[16384];
    size_t used = 0;
    for (size_t i = 0; i < n * columns; i++) {
        if (sizeof block - used < DECIMAL_ROOM + 1) {
            fwrite(block, 1, used, file.stream);
            used = 0;
        }
        if (isnan(values[i])) {
            memcpy(block + used, "nan", 3);
            used += 3;
        } else
            used += decimal_write(block + used, values[i]);
        block[used++] = (i + 1) % columns == 0 ? '\n' : ' ';
    }
    fwrite(block, 1, used, file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}
