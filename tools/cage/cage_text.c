/* Cages as text: one vertex per line. In the plane a line may be `slide` instead: the vertex may
 * slide along its wall. */
#include "cage/cage_features.h"
#include "cage/cage_readers.h"

#include "base/table.h"

#include <math.h>

bool cage_read_text(cage *out, size_t dim, bool may_slide, const char *text, size_t n,
                    problem *wrong)
{
    static const char *const forms[ICC_MAX_DIM + 1] = {
        "",
        "a vertex is `x`, one per line",
        "a vertex is `x y`, one per line",
        "a vertex is `x y z`, one per line",
        "a vertex is 4 numbers, one vertex per line",
        "a vertex is 5 numbers, one vertex per line",
        "a vertex is 6 numbers, one vertex per line"};
    const table_form form = {.columns = dim,
                             .axes = dim,
                             .what = forms[dim],
                             .word = dim == 2 && may_slide ? "slide" : NULL};
    table rows;
    bool good = table_read(&rows, text, n, &form, wrong);
    for (size_t i = 0; good && i < rows.n; i++) {
        cage_add_point(out, rows.values + dim * i, rows.lines[i]);
        out->n_sliding += isnan(rows.values[dim * i]) ? 1 : 0;
    }
    table_free(&rows);
    return good && (dim != 2 || cage_end_ring(out, 0, wrong));
}
