/* Landmarks are control points in the plane (control/control_read.h), and rows of numbers in
 * space. */
#include "job/landmark_file.h"

#include "base/file.h"
#include "control/control_read.h"

#include <stdlib.h>
#include <string.h>

static void take_points(table *out, const control_points *c)
{
    for (size_t i = 0; i < c->n; i++) {
        double *row = table_add_row(out, c->lines[i]);
        memcpy(row, c->from + 2 * i, 2 * sizeof *row);
        memcpy(row + 2, c->to + 2 * i, 2 * sizeof *row);
        out->n++;
    }
}

bool landmarks_decode(table *out, const char *text, size_t n, size_t dim, problem *wrong)
{
    static const table_form form = {.columns = 6,
                                    .what = "landmarks are `x y z x' y' z'`, one pair per line"};
    if (dim != 2)
        return table_read(out, text, n, &form, wrong);
    control_points c;
    *out = (table){.columns = 4};
    bool good = control_decode(&c, text, n, wrong);
    if (good)
        take_points(out, &c);
    control_free(&c);
    return good;
}

int landmarks_read(table *out, const char *name, size_t dim)
{
    size_t n;
    problem wrong;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    bool good = landmarks_decode(out, text, n, dim, &wrong);
    free(text);
    if (good)
        return DONE;
    table_free(out);
    return failed(name, wrong.line, "%s", wrong.text);
}
