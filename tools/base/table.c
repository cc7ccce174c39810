#include "base/table.h"

#include "base/allocate.h"
#include "base/foreign.h"
#include "base/number.h"

#include <stdlib.h>
#include <string.h>

static const char *skip_blanks(const char *p)
{
    while (*p == ' ' || *p == '\t' || *p == '\r')
        p++;
    return p;
}

static bool is_blank_or_end(const char *p, const char *end)
{
    return p == end || *p == ' ' || *p == '\t' || *p == '\r' || *p == '\n';
}

static bool bad_word(const char *word, size_t line, const table_form *form, problem *wrong)
{
    char shown[32];
    if (*word == '\0')
        return spoilt(wrong, line, "there is a zero byte; this is not text");
    if (strchr(quoted(shown, word), ',') != NULL)
        return spoilt(wrong, line,
                      "'%s' has a comma; separate numbers by spaces and write the "
                      "decimal sign as a point",
                      shown);
    return spoilt(wrong, line, "'%s' is not a number; %s", shown, form->what);
}

/* One row between p and the line's end. *filled: whether there was one. */
static bool read_row(const char *p, const char *end, size_t line, const table_form *form,
                     double *row, bool *filled, problem *wrong)
{
    size_t n = 0;
    *filled = false;
    for (p = skip_blanks(p); p < end && !(n == 0 && *p == '#'); p = skip_blanks(p)) {
        double value;
        const char *word = p;
        number_kind kind = number_read(&p, &value);
        if (kind == NUMBER_BAD || !is_blank_or_end(p, end))
            return bad_word(word, line, form, wrong);
        char shown[32];
        if (kind == NUMBER_NOT_FINITE && !form->special)
            return spoilt(wrong, line, "'%s' is not a finite number", quoted(shown, word));
        if (n < form->columns)
            row[n] = value;
        n++;
    }
    if (n != 0 && n != form->columns)
        return spoilt(wrong, line, "%zu number%s in this line; %s", n, n == 1 ? "" : "s",
                      form->what);
    *filled = n > 0;
    return true;
}

double *table_add_row(table *t, size_t line)
{
    t->values = grow(t->values, &t->room_values, (t->n + 1) * t->columns, sizeof *t->values);
    t->lines = grow(t->lines, &t->room_lines, t->n + 1, sizeof *t->lines);
    t->lines[t->n] = line;
    return t->values + t->n * t->columns;
}

bool table_read(table *out, const char *text, size_t n, const table_form *form, problem *wrong)
{
    *out = (table){.columns = form->columns};
    const char *end = text + n, *p = text;
    if (foreign_told(text, n, wrong))
        return false;
    if (n >= 3 && memcmp(p, "\xef\xbb\xbf", 3) == 0)
        p += 3;
    for (size_t line = 1; p < end; line++) {
        const char *stop = memchr(p, '\n', (size_t)(end - p));
        if (stop == NULL)
            stop = end;
        bool filled;
        if (!read_row(p, stop, line, form, table_add_row(out, line), &filled, wrong))
            return false;
        out->n += filled;
        p = stop + (stop < end);
    }
    return true;
}

void table_free(table *t)
{
    free(t->values);
    free(t->lines);
    *t = (table){0};
}
