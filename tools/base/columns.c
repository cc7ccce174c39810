/* Divides lines of tables into cells, and recognises headings. */
#include "base/columns.h"

#include "base/number.h"

#include <string.h>

/* Names of axes in lower case. */
static const char *const names[N_AXES][10] = {
    {"x", "lon", "long", "longitude", "lng", "easting", "east", "point_x", "x_coord", "xcoord"},
    {"y", "lat", "latitude", "northing", "north", "point_y", "y_coord", "ycoord"},
    {"z", "height", "elevation", "altitude", "point_z", "z_coord", "zcoord"}};
enum { N_NAMES = sizeof *names / sizeof **names };

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Returns the end of the character at p, or of the quoted text that begins there. */
static const char *pass(const char *p, const char *end)
{
    const char *close = *p == '"' ? memchr(p + 1, '"', (size_t)(end - p - 1)) : NULL;
    return (close != NULL ? close : p) + 1;
}

const char *columns_cell(cell *out, const char *p, const char *end, char separator)
{
    const char *stop = p;
    while (stop < end && *stop != separator)
        stop = pass(stop, end);
    *out = (cell){p, stop};
    while (out->begin < out->end && is_blank(*out->begin))
        out->begin++;
    while (out->begin < out->end && is_blank(out->end[-1]))
        out->end--;
    if (out->end - out->begin >= 2 && *out->begin == '"' && out->end[-1] == '"')
        *out = (cell){out->begin + 1, out->end - 1};
    return stop < end ? stop + 1 : NULL;
}

char columns_separator(const char *p, const char *end)
{
    char separator = '\0';
    for (; p < end && separator != ';'; p = pass(p, end))
        separator = *p == ';' || *p == ',' ? *p : separator;
    return separator;
}

bool columns_is_name(const cell *c, const char *name)
{
    size_t n = strlen(name);
    bool same = (size_t)(c->end - c->begin) == n;
    for (size_t i = 0; same && i < n; i++) {
        char letter = c->begin[i];
        same = (letter >= 'A' && letter <= 'Z' ? letter + 32 : letter) == name[i];
    }
    return same;
}

size_t columns_axis(const cell *c)
{
    for (size_t axis = 0; axis < N_AXES; axis++)
        for (size_t i = 0; i < N_NAMES && names[axis][i] != NULL; i++)
            if (columns_is_name(c, names[axis][i]))
                return axis;
    return N_AXES;
}

/* Takes columns by the names in a heading. If no name is that of an axis, it takes them in their
 * order. */
static bool take_heading(columns *out, const char *p, const char *end, const table_form *form,
                         problem *wrong)
{
    bool has[N_AXES] = {false};
    size_t n_found = 0, n_wanted = form->axes < N_AXES ? form->axes : N_AXES;
    for (size_t i = 0; p != NULL; i++) {
        cell c;
        p = columns_cell(&c, p, end, out->separator);
        size_t axis = columns_axis(&c);
        if (axis >= n_wanted)
            continue;
        if (has[axis])
            return spoilt(wrong, 0, "two columns are called %s or the like", names[axis][0]);
        has[axis] = true;
        out->cell[axis] = i;
        n_found++;
    }
    if (n_wanted > 0 && n_found == n_wanted && n_wanted == form->columns)
        return true;
    for (size_t k = 0; k < form->columns; k++)
        out->cell[k] = k;
    return (n_found == 0 && out->n_cells == form->columns) ||
           spoilt(wrong, 0,
                  "the heading has %zu columns; %s: call them x, y and so on, or leave others out",
                  out->n_cells, form->what);
}

bool columns_learn(columns *out, bool *is_heading, const char *line, const table_form *form,
                   problem *wrong)
{
    const char *end = line + strcspn(line, "\n");
    *out = (columns){.separator = columns_separator(line, end)};
    *is_heading = out->separator != '\0';
    for (const char *p = line; out->separator != '\0' && p != NULL; out->n_cells++) {
        cell c;
        double number;
        p = columns_cell(&c, p, end, out->separator);
        const char *after = c.begin;
        *is_heading = *is_heading && c.begin < c.end && number_read(&after, &number) == NUMBER_BAD;
    }
    if (*is_heading)
        return take_heading(out, line, end, form, wrong);
    for (size_t k = 0; k < form->columns; k++)
        out->cell[k] = k;
    out->n_cells = form->columns;
    return true;
}
