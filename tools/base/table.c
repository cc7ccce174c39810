/* Reads tables line by line. */
#include "base/table.h"

#include "base/allocate.h"
#include "base/columns.h"
#include "base/foreign.h"
#include "base/number.h"

#include <math.h>
#include <stdio.h>
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

static bool read_cell(const cell *c, const table_form *form, double *value)
{
    const char *after = c->begin;
    number_kind kind = number_read(&after, value);
    return after == c->end && kind != NUMBER_BAD && (kind == NUMBER_OK || form->special);
}

static bool has_blank(const cell *c)
{
    size_t n = (size_t)(c->end - c->begin);
    return n > 0 && (memchr(c->begin, ' ', n) != NULL || memchr(c->begin, '\t', n) != NULL);
}

static bool bad_cell(const cell *c, size_t line, const table_form *form, problem *wrong)
{
    int n = (int)(c->end - c->begin < 24 ? c->end - c->begin : 24);
    char shown[32];
    snprintf(shown, sizeof shown, "%.*s", n, c->begin);
    for (char *letter = shown; *letter != '\0'; letter++)
        *letter = (char)(*letter < ' ' || *letter > '~' ? '?' : *letter);
    return spoilt(wrong, line, "'%s' is not a finite number; %s", shown, form->what);
}

/* Reads a separated row, which is blank if all cells are empty. If a comma may be meant as a decimal
 * sign, the message names the first word of the row. */
static bool read_cells(const char *p, const char *end, size_t line, const columns *layout,
                       const table_form *form, double *row, bool *filled, problem *wrong)
{
    const char *first = skip_blanks(p);
    size_t n = 0;
    bool has_blanks = false;
    cell bad = {0};
    *filled = false;
    for (; p != NULL; n++) {
        cell c;
        p = columns_cell(&c, p, end, layout->separator);
        *filled = *filled || c.begin < c.end;
        has_blanks = has_blanks || has_blank(&c);
        for (size_t k = 0; k < form->columns; k++)
            if (layout->cell[k] == n && !read_cell(&c, form, &row[k]) && bad.begin == NULL)
                bad = c;
    }
    if (!*filled || (n == layout->n_cells && bad.begin == NULL))
        return true;
    bool is_decimal = bad.begin != NULL && memchr(bad.begin, ',', (size_t)(bad.end - bad.begin));
    if (is_decimal || (layout->separator == ',' && (has_blanks || n == 2 * layout->n_cells)))
        return bad_word(first, line, form, wrong);
    if (n != layout->n_cells)
        return spoilt(wrong, line, "%zu columns in this line, not %zu; %s", n, layout->n_cells,
                      form->what);
    return bad_cell(&bad, line, form, wrong);
}

/* Reads one row between p and the line's end. *filled tells if there was one. */
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

/* True if a line is only the word of the form, perhaps with empty cells after it. */
static bool is_word(const char *p, const char *end, const table_form *form)
{
    size_t n = form->word != NULL ? strlen(form->word) : 0;
    p = skip_blanks(p);
    if (n == 0 || (size_t)(end - p) < n || strncmp(p, form->word, n) != 0)
        return false;
    p += n;
    p += strspn(p, " \t\r,;");
    return p >= end || *p == '\n';
}

/* The first line from p on that is neither empty, nor a comment, nor the word of the form; or
 * NULL. */
static const char *first_row(const char *p, const char *end, const table_form *form)
{
    while (p < end && (skip_blanks(p) == end || *skip_blanks(p) == '\n' || *skip_blanks(p) == '#' ||
                       is_word(p, end, form))) {
        const char *stop = memchr(p, '\n', (size_t)(end - p));
        p = stop != NULL ? stop + 1 : end;
    }
    return p < end ? p : NULL;
}

bool table_read(table *out, const char *text, size_t n, const table_form *form, problem *wrong)
{
    *out = (table){.columns = form->columns};
    const char *end = text + n, *p = text;
    columns layout = {0};
    bool has_heading = false;
    if (foreign_told(text, n, wrong))
        return false;
    if (n >= 3 && memcmp(p, "\xef\xbb\xbf", 3) == 0)
        p += 3;
    const char *first = first_row(p, end, form);
    if (first != NULL && !columns_learn(&layout, &has_heading, first, form, wrong)) {
        wrong->line = line_of(text, first);
        return false;
    }
    for (size_t line = 1; p < end; line++) {
        const char *stop = memchr(p, '\n', (size_t)(end - p));
        if (stop == NULL)
            stop = end;
        bool filled = false, is_row = !(p == first && has_heading);
        double *row = table_add_row(out, line);
        if (is_row && is_word(p, stop, form)) {
            filled = true;
            for (size_t k = 0; k < form->columns; k++)
                row[k] = (double)NAN;
        } else if (is_row && !(layout.separator == '\0' || *skip_blanks(p) == '#'
                                   ? read_row(p, stop, line, form, row, &filled, wrong)
                                   : read_cells(p, stop, line, &layout, form, row, &filled, wrong)))
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
