/* Reads moves. Lines of three words are about numbered vertices, else the file has control points. */
#include "fit/moves_file.h"

#include "base/allocate.h"
#include "base/file.h"
#include "base/number.h"
#include "control/control_read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t\r,;";

/* The first line that is neither empty nor a comment. */
static const char *first_row(const char *p)
{
    p += strncmp(p, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    for (p += strspn(p, " \t\r\n"); *p == '#'; p += strspn(p, " \t\r\n"))
        p += strcspn(p, "\n");
    return p;
}

/* True if the first row begins with a number and has two or three words. */
static bool has_numbers(const char *text)
{
    const char *p = first_row(text), *end = p + strcspn(p, "\n");
    double value;
    const char *word = p;
    size_t n = 0;
    if (number_read(&word, &value) != NUMBER_OK)
        return false;
    for (p += strspn(p, blanks); p < end; p += strspn(p, blanks)) {
        p += strcspn(p, " \t\r,;\n");
        n++;
    }
    return n == 2 || n == 3;
}

static void add(moves *m, uint32_t vertex, const double to[2], size_t line)
{
    m->vertices = grow(m->vertices, &m->room_vertices, m->n + 1, sizeof *m->vertices);
    m->to = grow(m->to, &m->room_to, 2 * (m->n + 1), sizeof *m->to);
    m->lines = grow(m->lines, &m->room_lines, m->n + 1, sizeof *m->lines);
    m->vertices[m->n] = vertex;
    memcpy(m->to + 2 * m->n, to, 2 * sizeof *to);
    m->lines[m->n++] = line;
}

static bool is_end(const char *p)
{
    return *p == '\0' || *p == '\n';
}

/* Reads `x y` or `slide` up to the line's end. */
static bool read_place(const char *p, double to[2])
{
    p += strspn(p, blanks);
    if (strncmp(p, "slide", 5) == 0) {
        to[0] = to[1] = (double)NAN;
        return is_end(p + 5 + strspn(p + 5, blanks));
    }
    for (size_t k = 0; k < 2; k++) {
        p += strspn(p, blanks);
        if (number_read(&p, &to[k]) != NUMBER_OK)
            return false;
    }
    return is_end(p + strspn(p, blanks));
}

static bool read_row(moves *out, const char *p, size_t line, size_t n_vertices, problem *wrong)
{
    double number, to[2];
    char shown[32];
    const char *word = p;
    if (number_read(&p, &number) != NUMBER_OK || strchr(" \t\r,;", *p) == NULL ||
        !read_place(p, to))
        return spoilt(wrong, line, "a move is `vertex x y` or `vertex slide`");
    if (!(number >= 0 && number < (double)n_vertices) || floor(number) < number)
        return spoilt(wrong, line, "'%s' is no vertex; the mesh has %zu, counted from 0",
                      quoted(shown, word), n_vertices);
    add(out, (uint32_t)number, to, line);
    return true;
}

static bool read_rows(moves *out, const char *text, size_t n_vertices, problem *wrong)
{
    const char *p = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
    bool good = true;
    for (size_t line = 1; *p != '\0' && good; line++) {
        p += strspn(p, " \t\r");
        if (!is_end(p) && *p != '#')
            good = read_row(out, p, line, n_vertices, wrong);
        p += strcspn(p, "\n");
        p += *p == '\n';
    }
    return good;
}

/* Names the second of two rows about one vertex. */
static bool check_repeats(const moves *m, size_t n_vertices, problem *wrong)
{
    size_t *seen = need(n_vertices, sizeof *seen);
    bool good = true;
    for (size_t i = 0; i < m->n && good; i++) {
        size_t before = seen[m->vertices[i]];
        good = before == 0 || spoilt(wrong, m->lines[i], "vertex %u is in line %zu already",
                                     (unsigned)m->vertices[i], before);
        seen[m->vertices[i]] = m->lines[i];
    }
    free(seen);
    return good;
}

bool moves_decode(moves *out, const char *text, size_t n, size_t n_vertices, problem *wrong)
{
    *out = (moves){.n = 0};
    if (strlen(text) != n || !has_numbers(text))
        return control_decode(&out->points, text, n, wrong);
    return read_rows(out, text, n_vertices, wrong) && check_repeats(out, n_vertices, wrong);
}

int moves_read(moves *out, const char *name, size_t n_vertices)
{
    size_t n;
    problem wrong;
    char *text = file_read(name, &n);
    *out = (moves){.n = 0};
    if (text == NULL)
        return FAILED;
    bool good = moves_decode(out, text, n, n_vertices, &wrong);
    free(text);
    if (good && out->n + out->points.n == 0)
        return failed(name, 0, "there are no moves, lines `vertex x y` or `x y to_x to_y`");
    return good ? DONE : failed(name, wrong.line, "%s", wrong.text);
}

void moves_free(moves *m)
{
    free(m->vertices);
    free(m->to);
    free(m->lines);
    control_free(&m->points);
    *m = (moves){.n = 0};
}
