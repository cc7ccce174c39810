/* Points and lines in JSON: a list of objects with places in the source and in the target, and the
 * markups of 3D Slicer (.mrk.json), which have one side.
 * https://github.com/Slicer/Slicer, Modules/Loadable/Markups/Resources/Schema */
#include "solid/marks.h"

#include "base/allocate.h"
#include "base/json_in.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads a point, or a list of points. */
static bool read_side(mark *m, int side, mark_kind kind, const json_item *item, const char *where,
                      problem *wrong)
{
    if (kind == MARK_LINE || json_is(json_first(item), JSON_LIST))
        return json_points(item, where, 3, &m->n[side], &m->points[side], wrong);
    m->points[side] = need(1, 3 * sizeof *m->points[side]);
    m->n[side] = 1;
    return json_reals(item, where, 3, m->points[side], wrong);
}

/* Points and lines have their least numbers of vertices. */
static bool check_count(const mark *m, mark_kind kind, const char *where, problem *wrong)
{
    if (kind == MARK_POINT && m->n[0] != 1)
        return spoilt(wrong, m->line, "%s has %zu points instead of one", where, m->n[0]);
    return kind == MARK_POINT || m->n[0] >= 2 ||
           spoilt(wrong, m->line, "%s has %zu %s; a line has at least 2", where, m->n[0],
                  m->n[0] == 1 ? "vertex" : "vertices");
}

static bool read_list(marks *out, mark_kind kind, const json_item *list, const char *text,
                      problem *wrong)
{
    static const char *const members[] = {"name", "source", "target", NULL};
    size_t i = 0;
    for (const json_item *item = json_first(list); item != NULL; item = json_next(item), i++) {
        char where[40], member[80];
        snprintf(where, sizeof where, "%s %zu", kind == MARK_POINT ? "point" : "line", i);
        if (!json_is_object(item, where, members, wrong))
            return false;
        const char *name = json_string_of(json_get(item, "name"));
        mark *m = marks_add(out, name != NULL ? name : "", name != NULL ? strlen(name) : 0,
                            line_of(text, text + item->begin));
        for (int side = 0; side < 2; side++) {
            const json_item *points = json_get(item, members[1 + side]);
            snprintf(member, sizeof member, "%s.%s", where, members[1 + side]);
            if ((side == 0 || points != NULL) && !read_side(m, side, kind, points, member, wrong))
                return false;
        }
        if (!check_count(m, kind, where, wrong))
            return false;
    }
    return true;
}

/* ---- 3D Slicer ---- */

/* True for a curve or a straight line. Other markups are lists of points. */
static bool is_curve(const json_item *markup)
{
    return json_has_type(markup, "Curve") || json_has_type(markup, "ClosedCurve") ||
           json_has_type(markup, "Line");
}

/* Both systems in one file would mix coordinates. */
static bool take_axes(marks *out, const json_item *markup, size_t line, problem *wrong)
{
    const char *system = json_string_of(json_get(markup, "coordinateSystem"));
    if (system == NULL)
        return true;
    char axes[8];
    snprintf(axes, sizeof axes, "%s", system);
    if (out->axes[0] != '\0' && strcmp(axes, out->axes) != 0)
        return spoilt(wrong, line, "markups in %s and in %s; they must have one system of axes",
                      out->axes, axes);
    memcpy(out->axes, axes, sizeof axes);
    return true;
}

/* Appends a vertex. */
static void append(mark *m, const double at[3])
{
    double *points = need(m->n[0] + 1, 3 * sizeof *points);
    if (m->n[0] > 0)
        memcpy(points, m->points[0], 3 * m->n[0] * sizeof *points);
    memcpy(points + 3 * m->n[0]++, at, 3 * sizeof *at);
    free(m->points[0]);
    m->points[0] = points;
}

static bool read_markup(marks *out, mark_kind kind, const json_item *markup, const char *text,
                        problem *wrong)
{
    const json_item *list = json_get(markup, "controlPoints");
    const bool closed = json_has_type(markup, "ClosedCurve");
    const char *name = json_string_of(json_get(markup, "name"));
    mark *line = NULL;
    size_t i = 0;
    if (!take_axes(out, markup, line_of(text, text + markup->begin), wrong))
        return false;
    for (const json_item *item = json_first(list); item != NULL; item = json_next(item), i++) {
        const char *label = json_string_of(json_get(item, "label"));
        char where[48];
        double at[3];
        snprintf(where, sizeof where, "controlPoints[%zu].position", i);
        if (!json_reals(json_get(item, "position"), where, 3, at, wrong))
            return false;
        if (kind == MARK_POINT)
            append(marks_add(out, label != NULL ? label : "", label != NULL ? strlen(label) : 0,
                             line_of(text, text + item->begin)),
                   at);
        else if (i == 0)
            line = marks_add(out, name != NULL ? name : "", name != NULL ? strlen(name) : 0,
                             line_of(text, text + markup->begin));
        if (line != NULL)
            append(line, at);
    }
    if (line != NULL && closed)
        append(line, line->points[0]);
    return line == NULL || check_count(line, kind, "the curve", wrong);
}

static bool read_markups(marks *out, mark_kind kind, const json_item *list, const char *text,
                         problem *wrong)
{
    for (const json_item *item = json_first(list); item != NULL; item = json_next(item))
        if (is_curve(item) == (kind == MARK_LINE) && !read_markup(out, kind, item, text, wrong))
            return false;
    return true;
}

bool marks_read_json(marks *out, mark_kind kind, const json_tree *tree, const char *text,
                     problem *wrong)
{
    const json_item *markups = json_get(tree->root, "markups");
    if (json_is(tree->root, JSON_LIST))
        return read_list(out, kind, tree->root, text, wrong);
    return json_is(markups, JSON_LIST)
               ? read_markups(out, kind, markups, text, wrong)
               : spoilt(wrong, 0,
                        "this is neither a list of objects with \"source\" and \"target\" "
                        "nor a file of markups of 3D Slicer");
}
