/* Any bytes at all must give points and lines of finite numbers inside a solid, or a reason. */
#include "fuzz.h"
#include "solid/marks.h"

#include <math.h>

static void check_mark(const mark *m, mark_kind kind, size_t size)
{
    require(m->line <= size + 1);
    require(m->n[0] >= (kind == MARK_POINT ? 1 : 2));
    require(m->n[1] == 0 || m->n[1] == m->n[0]);
    require(kind == MARK_LINE || m->n[0] == 1);
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; i < 3 * m->n[side]; i++)
            require(isfinite(m->points[side][i]));
}

static void try_marks(const char *text, size_t size, mark_kind kind)
{
    marks m;
    problem wrong = {.text = ""};
    if (marks_read(&m, kind, text, size, &wrong)) {
        require(m.n > 0);
        for (size_t i = 0; i < m.n; i++)
            check_mark(&m.items[i], kind, size);
    } else {
        require(wrong.text[0] != '\0' && strlen(wrong.text) < sizeof wrong.text);
    }
    marks_free(&m);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = text_of(data, size);
    if (text == NULL)
        return 0;
    try_marks(text, size, MARK_POINT);
    try_marks(text, size, MARK_LINE);
    free(text);
    return 0;
}
