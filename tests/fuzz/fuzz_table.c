/* Any bytes at all must give whole rows of numbers, or a reason; finite ones, unless points without an
 * image are legal. */
#include "base/table.h"
#include "fuzz.h"

#include <math.h>

static void try_table(const char *text, size_t size, const table_form *form)
{
    table t = {0};
    problem wrong = {.text = ""};
    if (table_read(&t, text, size, form, &wrong)) {
        require(t.n == 0 || t.columns == form->columns);
        for (size_t i = 0; i < t.n * t.columns; i++)
            require(form->special || isfinite(t.values[i]));
        for (size_t i = 0; i < t.n; i++)
            require(t.lines[i] > (i > 0 ? t.lines[i - 1] : 0) && t.lines[i] <= size + 1);
    } else {
        require(wrong.text[0] != '\0' && strpbrk(wrong.text, "\r\n") == NULL);
        require(strlen(wrong.text) < sizeof wrong.text);
    }
    table_free(&t);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const table_form points = {.columns = 2, .special = true, .what = "a point is `x y`"};
    const table_form cage = {.columns = 3, .what = "a vertex is `x y z`"};
    char *text = text_of(data, size);
    if (text == NULL)
        return 0;
    try_table(text, size, &points);
    try_table(text, size, &cage);
    free(text);
    return 0;
}
