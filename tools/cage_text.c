/* Cages as text: one vertex `x y` per line. */
#include "cage.h"

#include "table.h"

bool cage_read_text(cage *out, const char *text, size_t n, problem *wrong)
{
    static const table_form form = {.columns = 2, .what = "a vertex is `x y`, one per line"};
    table rows;
    bool good = table_read(&rows, text, n, &form, wrong);
    for (size_t i = 0; good && i < rows.n; i++)
        cage_add(out, rows.values[2 * i], rows.values[2 * i + 1], rows.lines[i]);
    table_free(&rows);
    cage_open_ring(out);
    return good;
}
