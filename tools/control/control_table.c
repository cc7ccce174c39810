/* Tables of control points: x y to_x to_y, and perhaps a tolerance. A name may stand in front. A
 * heading may name the columns; then they may stand in any order, and others are ignored. */
#include "control/control_readers.h"

#include "base/columns.h"
#include "base/number.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { FROM_X, FROM_Y, TO_X, TO_Y, TOLERANCE, NAME, ENABLED, N_ROLES, MAX_CELLS = 64 };
static const size_t NONE = SIZE_MAX;
static const char FORM[] = "a control point is `x y to_x to_y`, or `x y to_x to_y tolerance`";

/* The names of columns in lower case. Those of columns.c, such as x or longitude, may stand for
 * either side. */
static const char *const names[N_ROLES][12] = {
    {"from_x", "source_x", "sourcex", "pixel", "pixelx", "pixel_x", "col", "column", "image_x",
     "x1"},
    {"from_y", "source_y", "sourcey", "line", "pixely", "pixel_y", "row", "image_y", "y1"},
    {"to_x", "target_x", "targetx", "mapx", "map_x", "x2", "x'"},
    {"to_y", "target_y", "targety", "mapy", "map_y", "y2", "y'"},
    {"tolerance", "sigma", "accuracy"},
    {"id", "name", "label", "point", "gcp"},
    {"enable", "enabled"}};
enum { N_NAMES = sizeof *names / sizeof **names };

typedef struct layout {
    char separator; /* '\0' stands for white space */
    size_t n_cells;
    size_t column[N_ROLES]; /* or NONE */
} layout;

static const char *skip_blanks(const char *p, const char *end)
{
    while (p < end && (*p == ' ' || *p == '\t' || *p == '\r'))
        p++;
    return p;
}

/* Divides a row at white space. Returns where the next cell begins, or NULL after the last one. */
static const char *next_word(cell *out, const char *p, const char *end)
{
    const char *stop = p = skip_blanks(p, end);
    while (stop < end && *stop != ' ' && *stop != '\t' && *stop != '\r')
        stop++;
    *out = (cell){p, stop};
    return skip_blanks(stop, end) < end ? stop : NULL;
}

/* Finds the cells of a row, and returns their number. Only the first MAX_CELLS are kept. */
static size_t split(cell cells[MAX_CELLS], const char *p, const char *end, char separator)
{
    size_t n = 0;
    while (p != NULL) {
        cell c;
        p = separator == '\0' ? next_word(&c, p, end) : columns_cell(&c, p, end, separator);
        if (n < MAX_CELLS)
            cells[n] = c;
        n++;
    }
    return n;
}

static bool is_empty(const cell *c)
{
    return c->begin == c->end;
}

static bool is_number(const cell *c, double *value)
{
    const char *after = c->begin;
    return !is_empty(c) && number_read(&after, value) == NUMBER_OK && after == c->end;
}

static bool are_empty(size_t n, const cell *cells)
{
    bool all = true;
    for (size_t i = 0; i < n && i < MAX_CELLS; i++)
        all = all && is_empty(&cells[i]);
    return all;
}

static bool is_heading(size_t n, const cell *cells)
{
    bool all = true;
    double value;
    for (size_t i = 0; i < n && i < MAX_CELLS; i++)
        all = all && !is_empty(&cells[i]) && !is_number(&cells[i], &value);
    return all;
}

static size_t role_of(const cell *c)
{
    for (size_t role = 0; role < N_ROLES; role++)
        for (size_t i = 0; i < N_NAMES && names[role][i] != NULL; i++)
            if (columns_is_name(c, names[role][i]))
                return role;
    return N_ROLES;
}

/* Gives columns that may stand for either side to the side that lacks them, the source first. */
static void take_either(layout *out, size_t axis, size_t n, const cell *cells)
{
    for (size_t i = 0; i < n; i++)
        if (role_of(&cells[i]) == N_ROLES && columns_axis(&cells[i]) == axis) {
            size_t role = out->column[FROM_X + axis] == NONE ? FROM_X + axis : TO_X + axis;
            if (out->column[role] == NONE)
                out->column[role] = i;
        }
}

/* Takes columns by their names. If none is known, takes four columns in their order. */
static bool learn_heading(layout *out, size_t n, const cell *cells, problem *wrong)
{
    n = n < MAX_CELLS ? n : MAX_CELLS;
    for (size_t i = 0; i < n; i++) {
        size_t role = role_of(&cells[i]);
        if (role == N_ROLES)
            continue;
        if (out->column[role] != NONE)
            return spoilt(wrong, 0, "two columns are called %s or the like", names[role][0]);
        out->column[role] = i;
    }
    take_either(out, 0, n, cells);
    take_either(out, 1, n, cells);
    size_t n_found = 0;
    for (size_t role = FROM_X; role <= TO_Y; role++)
        n_found += out->column[role] != NONE;
    for (size_t k = 0; k < 4 && n_found == 0 && n == 4; k++)
        out->column[k] = k;
    return n_found == 4 || (n_found == 0 && n == 4) ||
           spoilt(wrong, 0,
                  "the heading lacks columns; call them x, y, to_x and to_y, or remove it");
}

/* Learns the columns from the first row, which is no heading. */
static bool learn_row(layout *out, size_t n, const cell *cells, problem *wrong)
{
    double value;
    size_t first = n > 4 && !is_number(&cells[0], &value);
    if (n - first != 4 && n - first != 5)
        return spoilt(wrong, 0, "%zu column%s in this line; %s", n, n == 1 ? "" : "s", FORM);
    out->column[NAME] = first ? 0 : NONE;
    for (size_t k = 0; k < n - first; k++)
        out->column[k] = first + k;
    return true;
}

static bool learn(layout *out, bool *heads, const char *p, const char *end, problem *wrong)
{
    cell cells[MAX_CELLS];
    *out = (layout){.separator = columns_separator(p, end)};
    for (size_t role = 0; role < N_ROLES; role++)
        out->column[role] = NONE;
    out->n_cells = split(cells, p, end, out->separator);
    *heads = is_heading(out->n_cells, cells);
    return *heads ? learn_heading(out, out->n_cells, cells, wrong)
                  : learn_row(out, out->n_cells, cells, wrong);
}

static bool bad_cell(const cell *c, size_t line, problem *wrong)
{
    int n = (int)(c->end - c->begin < 24 ? c->end - c->begin : 24);
    char shown[32];
    snprintf(shown, sizeof shown, "%.*s", n, c->begin);
    for (char *letter = shown; *letter != '\0'; letter++)
        *letter = (char)(*letter < ' ' || *letter > '~' ? '?' : *letter);
    return spoilt(wrong, line, "'%s' is not a finite number; %s", shown, FORM);
}

/* Reads the number of a role. A cell that may be empty leaves *value as it is. */
static bool read_number(const layout *of, size_t role, const cell *cells, double *value)
{
    const cell *c = &cells[of->column[role]];
    bool may_be_empty = role > TO_Y;
    return (may_be_empty && is_empty(c)) || is_number(c, value);
}

static bool read_row(control_points *out, const layout *of, const cell *cells, size_t line,
                     problem *wrong)
{
    double values[N_ROLES] = {[ENABLED] = 1};
    for (size_t role = 0; role < N_ROLES; role++)
        if (role != NAME && of->column[role] != NONE &&
            !read_number(of, role, cells, &values[role]))
            return bad_cell(&cells[of->column[role]], line, wrong);
    if (values[TOLERANCE] < 0)
        return spoilt(wrong, line, "the tolerance is below 0");
    if (!(values[ENABLED] > 0)) {
        out->n_disabled++;
        return true;
    }
    control_add(out, values + FROM_X, values + TO_X, line);
    control_tolerance(out, values[TOLERANCE]);
    if (of->column[NAME] != NONE) {
        const cell *c = &cells[of->column[NAME]];
        control_name(out, c->begin, (size_t)(c->end - c->begin));
    }
    return true;
}

bool control_read_table(control_points *out, const char *text, size_t n, problem *wrong)
{
    const char *p = n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
    const char *stop = text + n, *end;
    layout rows = {0};
    bool is_learnt = false, heads = false;
    out->format = "a table of control points";
    for (size_t line = 1; p < stop; line++, p = end + (end < stop)) {
        cell cells[MAX_CELLS];
        end = p + strcspn(p, "\n");
        if (skip_blanks(p, end) == end || *skip_blanks(p, end) == '#')
            continue;
        if (!is_learnt && !learn(&rows, &heads, p, end, wrong)) {
            wrong->line = line;
            return false;
        }
        bool is_first = !is_learnt;
        is_learnt = true;
        size_t n_cells = split(cells, p, end, rows.separator);
        if ((is_first && heads) || are_empty(n_cells, cells))
            continue;
        if (n_cells != rows.n_cells)
            return spoilt(wrong, line, "%zu column%s in this line, not %zu; %s", n_cells,
                          n_cells == 1 ? "" : "s", rows.n_cells, FORM);
        if (!read_row(out, &rows, cells, line, wrong))
            return false;
    }
    return true;
}
