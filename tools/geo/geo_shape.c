/* Reads nested lists of positions without recursion. */
#include "geo/geo_shape.h"

#include "base/allocate.h"
#include "base/decimal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *skip_blanks(const char *p)
{
    while (*p == ' ' || *p == '\n' || *p == '\r' || *p == '\t')
        p++;
    return p;
}

const char *geo_next_number(const char *p, const char **end)
{
    p = skip_blanks(p);
    p = *p == ',' || *p == '[' ? skip_blanks(p + 1) : p;
    if (*p != '-' && !(*p >= '0' && *p <= '9'))
        return NULL;
    const char *e = p + 1;
    while ((*e >= '0' && *e <= '9') || *e == '.' || *e == 'e' || *e == 'E' || *e == '+' ||
           *e == '-')
        e++;
    *end = e;
    return p;
}

/* Reads the number at p and finds its end. */
static double read_number(const char *p, const char **end)
{
    double value;
    if (decimal_read_plain(p, end, &value))
        return value;
    geo_next_number(p, end);
    return decimal_read(p);
}

/* Reads the numbers of a position, from the bracket at p to the one at its end, which is returned.
 * NULL if these are not two finite numbers, and any further numbers. */
static const char *read_numbers(const char *p, double xy[2])
{
    const char *end;
    xy[0] = xy[1] = NAN;
    p = skip_blanks(p + 1);
    for (size_t k = 0; k < 2 && (*p == '-' || (*p >= '0' && *p <= '9')); k++) {
        xy[k] = read_number(p, &end);
        p = skip_blanks(end);
        p = *p == ',' && k == 0 ? skip_blanks(p + 1) : p;
    }
    while (geo_next_number(p, &end) != NULL)
        p = end;
    p = skip_blanks(p);
    return *p == ']' && isfinite(xy[0]) && isfinite(xy[1]) ? p : NULL;
}

/* Reads a position at *cursor. */
static bool read_position(geo_shape *out, const char *text, const char **cursor,
                          const double *known)
{
    const char *begin = skip_blanks(*cursor), *end = NULL;
    double xy[2];
    if (*begin == '[' && known != NULL) {
        memcpy(xy, known + 2 * out->n, sizeof xy);
        end = strchr(begin, ']');
    } else if (*begin == '[')
        end = read_numbers(begin, xy);
    if (end == NULL)
        return false;
    *cursor = end + 1;
    out->spans = grow(out->spans, &out->room_spans, out->n + 1, sizeof *out->spans);
    out->points = grow(out->points, &out->room_points, 2 * (out->n + 1), sizeof *out->points);
    out->spans[out->n] = (geo_span){(size_t)(begin - text), (size_t)(end + 1 - text)};
    memcpy(out->points + 2 * out->n++, xy, sizeof xy);
    return true;
}

static void open_path(geo_shape *out)
{
    out->paths = grow(out->paths, &out->room_paths, out->n_paths + 1, sizeof *out->paths);
    out->paths[out->n_paths++] = (geo_path){out->n, 0, out->n_parts};
}

/* Reads lists of lists of positions, `levels` deep, without recursion. */
static bool read_lists(geo_shape *out, const char *text, const char **cursor, int levels,
                       const double *known)
{
    int level = levels;
    const char *p = *cursor;
    do {
        p = skip_blanks(p);
        if (*p == ',')
            p++;
        else if (*p == ']') {
            p++;
            out->n_parts += level == 1 && levels == 3;
            level++;
        } else if (level > 0) {
            if (*p != '[') {
                *cursor = p;
                return false;
            }
            p++;
            if (--level == 0)
                open_path(out);
        } else {
            *cursor = p;
            if (!read_position(out, text, cursor, known))
                return false;
            p = *cursor;
            out->paths[out->n_paths - 1].n++;
        }
    } while (level < levels);
    *cursor = p;
    return true;
}

bool geo_shape_read(geo_shape *out, const geo_object *object, const char *text, const double *known,
                    problem *wrong)
{
    static const int levels[] = {0, 1, 1, 2, 2, 3};
    const char *p = text + object->coordinates.begin;
    out->type = object->type;
    out->n = out->n_paths = out->n_parts = 0;
    bool list = *p == '[';
    bool empty = list && *skip_blanks(p + 1) == ']';
    if (!list)
        return spoilt(wrong, line_of(text, p), "a '%s' has no coordinates",
                      geo_type_names[object->type]);
    if (empty)
        return true;
    if (object->type == GEO_POINT)
        open_path(out);
    bool good = object->type == GEO_POINT ? read_position(out, text, &p, known)
                                          : read_lists(out, text, &p, levels[object->type], known);
    if (object->type == GEO_POINT)
        out->paths[0].n = out->n;
    return good || spoilt(wrong, line_of(text, p),
                          "position %zu, in a %s, is not a list of finite numbers, at least two",
                          out->n, geo_type_names[object->type]);
}

void geo_shape_free(geo_shape *shape)
{
    free(shape->spans);
    free(shape->points);
    free(shape->paths);
    *shape = (geo_shape){0};
}
