/* What the readers of cages share, and which of them a file is for. */
#include "cage.h"

#include "memory.h"

#include <stdlib.h>
#include <string.h>

void cage_add(cage *c, double x, double y, size_t line)
{
    c->points = grow(c->points, &c->room_points, 2 * (c->n + 1), sizeof *c->points);
    c->lines = grow(c->lines, &c->room_lines, c->n + 1, sizeof *c->lines);
    c->points[2 * c->n] = x;
    c->points[2 * c->n + 1] = y;
    c->lines[c->n++] = line;
}

void cage_open_ring(cage *c)
{
    if (c->n < 2)
        return;
    const double *last = c->points + 2 * (c->n - 1);
    if (last[0] == c->points[0] && last[1] == c->points[1])
        c->n--;
}

void cage_free(cage *c)
{
    free(c->points);
    free(c->lines);
    *c = (cage){0};
}

const char *cage_role_name(cage_role role)
{
    return role == CAGE_SOURCE ? "source" : "target";
}

size_t cage_line(const char *text, const char *at)
{
    size_t line = 1;
    for (const char *p = text; p < at; p++)
        line += *p == '\n';
    return line;
}

static bool begins_with(const char *text, const char *word)
{
    for (; *word != '\0'; text++, word++)
        if ((*text >= 'a' && *text <= 'z' ? *text - 32 : *text) != *word)
            return false;
    return true;
}

static bool is_wkt(const char *text)
{
    static const char *const words[] = {"SRID=", "POLYGON", "MULTIPOLYGON",       "POINT",
                                        "LINES", "MULTILI", "GEOMETRYCOLLECTION", "CURVEPOLYGON"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (begins_with(text, words[i]))
            return true;
    return false;
}

/* Formats of other kinds of domains, to say more than "not a number". */
static bool is_known_stranger(const char *text, problem *wrong)
{
    static const struct {
        const char *magic, *name;
    } strangers[] = {
        {"\x93NUMPY", "a .npy mask"}, {"\x89PNG", "a PNG picture"}, {"PLY\n", "a PLY surface"},
        {"PLY\r", "a PLY surface"},   {"OFF\n", "an OFF surface"},  {"OFF\r", "an OFF surface"},
    };
    for (size_t i = 0; i < sizeof strangers / sizeof *strangers; i++)
        if (begins_with(text, strangers[i].magic)) {
            spoilt(wrong, 0,
                   "this is %s; this version takes cages in the plane: text, GeoJSON, WKT or "
                   "SVG",
                   strangers[i].name);
            return true;
        }
    return false;
}

static bool read_any(cage *out, cage_role role, const char *text, size_t n, problem *wrong)
{
    const char *p = text;
    if (n >= 3 && memcmp(p, "\xef\xbb\xbf", 3) == 0)
        p += 3;
    p += strspn(p, " \t\r\n");
    if (*p == '{' || *p == '[')
        return cage_read_geojson(out, role, text, n, wrong);
    if (*p == '<')
        return cage_read_svg(out, role, text, n, wrong);
    if (is_wkt(p))
        return cage_read_wkt(out, text, n, wrong);
    return !is_known_stranger(p, wrong) && cage_read_text(out, text, n, wrong);
}

bool cage_read(cage *out, cage_role role, const char *text, size_t n, problem *wrong)
{
    *out = (cage){0};
    bool good = read_any(out, role, text, n, wrong);
    if (good && out->n < 3)
        good = spoilt(wrong, 0, "%zu %s; a cage has at least 3", out->n,
                      out->n == 1 ? "vertex" : "vertices");
    if (!good)
        cage_free(out);
    return good;
}
