#include "rows.h"

#include <math.h>
#include <stdlib.h>

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
    for (size_t i = 0; i < n * columns; i++) {
        if (isnan(values[i]))
            fputs("nan", file.stream);
        else
            fprintf(file.stream, "%.17g", values[i]);
        fputc((i + 1) % columns == 0 ? '\n' : ' ', file.stream);
    }
    return outfile_close(&file) ? DONE : FAILED;
}
