/* Tables of points: with commas, semicolons or white space, and the tables of 3D Slicer (.fcsv). */
#include "solid/marks.h"

#include "base/allocate.h"
#include "base/columns.h"
#include "base/number.h"

#include <string.h>

/* Cells of a row, of which more than these are no table of points. */
enum { MOST_CELLS = 64 };

typedef struct row {
    cell cells[MOST_CELLS];
    size_t n, line;
} row;

/* Goes to the next row that is not empty and no comment, and divides it. */
static bool next_row(row *r, const char **text, size_t *line, char separator)
{
    for (; **text != '\0'; (*line)++) {
        const char *p = *text, *end = p + strcspn(p, "\r\n");
        size_t n = strcspn(p, "\n");
        *text = p + n + (p[n] == '\n');
        p += strspn(p, " \t");
        if (p >= end || *p == '#')
            continue;
        r->n = 0;
        r->line = (*line)++;
        if (separator != '\0') {
            for (; p != NULL && r->n < MOST_CELLS; r->n++)
                p = columns_cell(&r->cells[r->n], p, end, separator);
            return true;
        }
        while (p < end && r->n < MOST_CELLS) {
            size_t length = strcspn(p, " \t\r\n");
            r->cells[r->n++] = (cell){p, p + length};
            p += length;
            p += strspn(p, " \t");
        }
        return true;
    }
    return false;
}

static bool cell_number(const cell *c, double *value)
{
    const char *p = c->begin;
    return c->begin < c->end && number_read(&p, value) == NUMBER_OK && p == c->end;
}

/* Adds a point to one side of a mark. */
static void put(mark *m, int side, const double at[3])
{
    m->points[side] = need(1, 3 * sizeof *m->points[side]);
    memcpy(m->points[side], at, 3 * sizeof *at);
    m->n[side] = 1;
}

/* The number of cells decides what they are: a name comes before 3 or 6 numbers. */
static bool add_row(marks *out, const row *r, problem *wrong)
{
    double numbers[6];
    bool named = r->n == 4 || r->n == 7;
    size_t n = r->n - named;
    if (n != 3 && n != 6)
        return spoilt(
            wrong, r->line,
            "%zu columns; a point is `x y z` or `name,x,y,z`, and its place in the target "
            "may follow",
            r->n);
    for (size_t k = 0; k < n; k++) {
        char shown[32];
        if (!cell_number(&r->cells[named + k], &numbers[k]))
            return spoilt(wrong, r->line, "'%s' is not a finite number",
                          quoted(shown, r->cells[named + k].begin));
    }
    const cell *name = &r->cells[0];
    mark *m = marks_add(out, name->begin, named ? (size_t)(name->end - name->begin) : 0, r->line);
    put(m, 0, numbers);
    if (n == 6)
        put(m, 1, numbers + 3);
    return true;
}

/* A heading has no number. */
static bool is_heading(const row *r)
{
    double value;
    for (size_t k = 0; k < r->n; k++)
        if (cell_number(&r->cells[k], &value))
            return false;
    return true;
}

bool marks_read_table(marks *out, const char *text, problem *wrong)
{
    row r;
    size_t line = 1, first = 1;
    const char *p = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text, *at = p;
    char separator = '\0';
    if (next_row(&r, &at, &first, '\0'))
        separator = columns_separator(r.cells[0].begin,
                                      r.cells[0].begin + strcspn(r.cells[0].begin, "\r\n"));
    for (bool begins = true; next_row(&r, &p, &line, separator); begins = false)
        if (!(begins && is_heading(&r)) && !add_row(out, &r, wrong))
            return false;
    return true;
}

/* ---- 3D Slicer ---- */

/* Finds the text behind `# NAME = ` in a comment. NULL: there is none. */
static const char *comment_value(const char *text, const char *name)
{
    for (const char *p = text; *p == '#'; p += strcspn(p, "\n") + 1) {
        const char *q = p + 1 + strspn(p + 1, " ");
        size_t n = strlen(name);
        if (strncmp(q, name, n) == 0) {
            q += n + strspn(q + n, " ");
            if (*q == '=')
                return q + 1 + strspn(q + 1, " ");
        }
        if (p[strcspn(p, "\n")] == '\0')
            break;
    }
    return NULL;
}

/* The column with this name in the list of columns, or `otherwise`. */
static size_t find_column(const char *list, const char *name, size_t otherwise)
{
    if (list == NULL)
        return otherwise;
    const char *end = list + strcspn(list, "\r\n");
    size_t i = 0;
    for (const char *p = list; p != NULL; i++) {
        cell c;
        p = columns_cell(&c, p, end, ',');
        if (columns_is_name(&c, name))
            return i;
    }
    return otherwise;
}

/* Older versions write numbers for the system of axes. */
static void take_axes(marks *out, const char *system)
{
    static const char *const names[][2] = {
        {"LPS", "LPS"}, {"RAS", "RAS"}, {"1", "LPS"}, {"0", "RAS"}};
    for (size_t i = 0; system != NULL && i < 4; i++)
        if (strncmp(system, names[i][0], strlen(names[i][0])) == 0)
            memcpy(out->axes, names[i][1], 4);
}

bool marks_read_fcsv(marks *out, const char *text, problem *wrong)
{
    const char *p = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
    const char *list = comment_value(p, "columns");
    const size_t x = find_column(list, "x", 1), label = find_column(list, "label", 11);
    size_t line = 1;
    row r;
    take_axes(out, comment_value(p, "CoordinateSystem"));
    while (next_row(&r, &p, &line, ',')) {
        double at[3];
        for (size_t k = 0; k < 3; k++)
            if (x + k >= r.n || !cell_number(&r.cells[x + k], &at[k]))
                return spoilt(wrong, r.line, "the point has no three numbers x, y and z");
        const cell *name = label < r.n ? &r.cells[label] : NULL;
        put(marks_add(out, name != NULL ? name->begin : "",
                      name != NULL ? (size_t)(name->end - name->begin) : 0, r.line),
            0, at);
    }
    return true;
}
