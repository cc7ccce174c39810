/* Cages as SVG: the outline of a <path>, a <polygon> or another basic shape, in the units of the
 * outermost <svg>. y points downwards, as in every picture.
 *
 * The element with the id or the inkscape:label "source" or "target" is chosen by the role of the
 * cage. A name chooses any element, also by its number, from 1 in the order of the file. Without
 * either, the file must have only one path or polygon, or without these only one other shape. */
#include "cage/cage_readers.h"

#include "base/allocate.h"
#include "base/number.h"
#include "base/xml_tags.h"
#include "cage/cage_features.h"
#include "cage/svg_transform.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The transform of a group, for everything inside it. */
typedef struct frame {
    transform all;
    bool unclear; /* a transform that cannot be read */
} frame;

typedef struct shape {
    tag tag;
    frame frame;
    size_t n;
} shape;

/* Counts and first examples of paths and polygons, of other shapes, of shapes with the wanted name, and
 * of the shape with the wanted number. */
typedef struct shapes {
    shape outlines, others, chosen, numbered;
    size_t n;
} shapes;

/* True if the element is chosen: by its id or the label that Inkscape's list of objects shows, or
 * by the given name. */
static bool is_chosen(const tag *t, const cage_choice *choice)
{
    const char *key = choice->named, *value = cage_role_name(choice->role);
    size_t n = key != NULL ? strcspn(key, "=") : 0;
    if (key != NULL && key[n] == '=')
        return tag_has(t, key, n, key + n + 1);
    value = key != NULL ? key : value;
    return tag_has(t, "id", 2, value) || tag_has(t, "inkscape:label", 14, value);
}

/* True if the name wanted is this number. */
static bool is_number(const char *named, size_t number)
{
    char digits[24];
    snprintf(digits, sizeof digits, "%zu", number);
    return named != NULL && strcmp(named, digits) == 0;
}

static void note_shape(shape *s, const tag *t, const frame *f)
{
    if (s->n++ > 0)
        return;
    s->tag = *t;
    s->frame = *f;
}

static void note_tag(shapes *found, const tag *t, const frame *f, const cage_choice *choice)
{
    bool outline = tag_is(t, "path") || tag_is(t, "polygon");
    bool other =
        tag_is(t, "polyline") || tag_is(t, "rect") || tag_is(t, "circle") || tag_is(t, "ellipse");
    if (!outline && !other)
        return;
    note_shape(outline ? &found->outlines : &found->others, t, f);
    if (is_chosen(t, choice))
        note_shape(&found->chosen, t, f);
    if (is_number(choice->named, ++found->n))
        note_shape(&found->numbered, t, f);
}

static frame frame_of(const tag *t, const frame *around)
{
    const char *end, *list = tag_attribute(t, "transform", 9, &end);
    frame inner = *around;
    if (list != NULL && !transform_read(&inner.all, &around->all, list, end))
        inner.unclear = true;
    return inner;
}

/* Tags are nested. A stack has the frames of the open ones. */
static shapes find_shapes(const char *text, const cage_choice *choice)
{
    shapes found = {.chosen = {.n = 0}};
    frame *frames = NULL;
    size_t depth = 0, room = 0;
    tag t;
    for (const char *p = text; tag_next(&t, p); p = t.end + 1) {
        const frame none = {.all = transform_none()};
        if (t.closes) {
            depth -= depth > 0;
            continue;
        }
        frame inner = frame_of(&t, depth > 0 ? &frames[depth - 1] : &none);
        note_tag(&found, &t, &inner, choice);
        if (t.stands_alone)
            continue;
        frames = grow(frames, &room, depth + 1, sizeof *frames);
        frames[depth++] = inner;
    }
    free(frames);
    return found;
}

/* ------------------------------------------------------------------ shapes */

/* The `points` of a polygon: pairs of numbers, separated by commas or spaces. The last vertex
 * joins the first. */
static bool read_points(cage *out, const char *p, const char *end, size_t line, problem *wrong)
{
    double xy[2];
    size_t n = 0;
    for (;;) {
        p += strspn(p, " \t\r\n,");
        if (p >= end)
            break;
        char shown[32];
        const char *word = p;
        if (number_read(&p, &xy[n % 2]) != NUMBER_OK)
            return spoilt(wrong, line, "'%s' in the polygon's points is not a finite number",
                          quoted(shown, word));
        if (n++ % 2 == 1)
            cage_add(out, xy[0], xy[1], line);
    }
    if (n % 2 == 1)
        return spoilt(wrong, line, "the polygon's last vertex lacks its y");
    return cage_end_ring(out, 0, wrong);
}

/* Reads a length in the units of the drawing, or `missing` if there is none. */
static bool read_length(const tag *t, const char *name, double missing, double *out, size_t line,
                        problem *wrong)
{
    const char *end, *value = tag_attribute(t, name, strlen(name), &end);
    char shown[32];
    *out = missing;
    if (value == NULL || strncmp(value, "auto", 4) == 0)
        return true;
    const char *p = value + strspn(value, " \t\r\n");
    bool good = number_read(&p, out) == NUMBER_OK;
    p += strncmp(p, "px", 2) == 0 ? 2 : 0;
    p += strspn(p, " \t\r\n");
    return (good && p == end) || spoilt(wrong, line, "%s is '%s'; only plain numbers are read",
                                        name, quoted(shown, value));
}

/* Reads an ellipse as its four quarters, clockwise on the screen. */
static bool read_ellipse(cage *out, const tag *t, size_t line, const flattening *flat,
                         problem *wrong)
{
    bool circle = tag_is(t, "circle");
    double x, y, rx, ry;
    char path[800];
    if (!read_length(t, "cx", 0, &x, line, wrong) || !read_length(t, "cy", 0, &y, line, wrong) ||
        !read_length(t, circle ? "r" : "rx", 0, &rx, line, wrong) ||
        !read_length(t, circle ? "r" : "ry", 0, &ry, line, wrong))
        return false;
    if (!(rx > 0 && ry > 0))
        return spoilt(wrong, line, "the %s has no radius", circle ? "circle" : "ellipse");
    snprintf(path, sizeof path,
             "M%.17g,%.17gA%.17g,%.17g 0 0 1 %.17g,%.17gA%.17g,%.17g 0 0 1 %.17g,%.17g"
             "A%.17g,%.17g 0 0 1 %.17g,%.17gA%.17g,%.17g 0 0 1 %.17g,%.17gZ",
             x + rx, y, rx, ry, x, y + ry, rx, ry, x - rx, y, rx, ry, x, y - ry, rx, ry, x + rx, y);
    return cage_read_path(out, path, path + strlen(path), line, flat, wrong);
}

/* If only one radius is given, it is used for both. Radii are at most half the sides. */
static bool read_rectangle(cage *out, const tag *t, size_t line, const flattening *flat,
                           problem *wrong)
{
    double x, y, w, h, rx, ry;
    char path[800];
    if (!read_length(t, "x", 0, &x, line, wrong) || !read_length(t, "y", 0, &y, line, wrong) ||
        !read_length(t, "width", 0, &w, line, wrong) ||
        !read_length(t, "height", 0, &h, line, wrong) ||
        !read_length(t, "rx", -1, &rx, line, wrong) || !read_length(t, "ry", -1, &ry, line, wrong))
        return false;
    if (!(w > 0 && h > 0))
        return spoilt(wrong, line, "the rectangle has no width or no height");
    rx = fmin(fmax(rx < 0 ? ry : rx, 0), w / 2);
    ry = fmin(fmax(ry < 0 ? rx : ry, 0), h / 2);
    if (rx > 0 && ry > 0)
        snprintf(path, sizeof path,
                 "M%.17g,%.17gH%.17gA%.17g,%.17g 0 0 1 %.17g,%.17gV%.17gA%.17g,%.17g 0 0 1 "
                 "%.17g,%.17gH%.17gA%.17g,%.17g 0 0 1 %.17g,%.17gV%.17gA%.17g,%.17g 0 0 1 "
                 "%.17g,%.17gZ",
                 x + rx, y, x + w - rx, rx, ry, x + w, y + ry, y + h - ry, rx, ry, x + w - rx,
                 y + h, x + rx, rx, ry, x, y + h - ry, y + ry, rx, ry, x + rx, y);
    else
        snprintf(path, sizeof path, "M%.17g,%.17gH%.17gV%.17gH%.17gZ", x, y, x + w, y + h, x);
    return cage_read_path(out, path, path + strlen(path), line, flat, wrong);
}

static bool read_shape(cage *out, const tag *t, const char *text, const flattening *flat,
                       problem *wrong)
{
    bool path = tag_is(t, "path"), points = tag_is(t, "polygon") || tag_is(t, "polyline");
    const char *end = NULL;
    const char *data = path     ? tag_attribute(t, "d", 1, &end)
                       : points ? tag_attribute(t, "points", 6, &end)
                                : t->name;
    size_t line = line_of(text, data != NULL ? data : t->name);
    if (data == NULL)
        return spoilt(wrong, line, "the shape has no outline");
    return path                ? cage_read_path(out, data, end, line, flat, wrong)
           : points            ? read_points(out, data, end, line, wrong)
           : tag_is(t, "rect") ? read_rectangle(out, t, line, flat, wrong)
                               : read_ellipse(out, t, line, flat, wrong);
}

/* -------------------------------------------------------------------- file */

static bool move(size_t n, double *points, const transform *t)
{
    for (size_t i = 0; i < n; i++) {
        transform_apply(t, points + 2 * i);
        if (!isfinite(points[2 * i]) || !isfinite(points[2 * i + 1]))
            return false;
    }
    return true;
}

static bool move_all(cage *c, const transform *t)
{
    bool good = move(c->n, c->points, t);
    for (size_t i = 0; good && i < c->n_features; i++)
        good = move(c->features[i].n, c->features[i].points, t);
    return good;
}

bool cage_svg_has(cage_role role, const char *text)
{
    return find_shapes(text, &(cage_choice){.role = role}).chosen.n > 0;
}

/* The shape to read, or NULL. */
static const shape *choose(const shapes *found, const cage_choice *choice, problem *wrong)
{
    const shape *only = found->outlines.n > 0 ? &found->outlines : &found->others;
    char shown[64], called[64], number[80] = "";
    snprintf(called, sizeof called, "the id or label \"%s\"", cage_role_name(choice->role));
    if (found->n > 1)
        snprintf(number, sizeof number,
                 "; exactly one must, or choose by number: FILE#1 to FILE#%zu", found->n);
    if (found->n == 0)
        spoilt(wrong, 0, "there is no complete <path>, <polygon> or other shape in this SVG");
    else if (found->chosen.n == 1)
        return &found->chosen;
    else if (found->chosen.n == 0 && found->numbered.n == 1)
        return &found->numbered;
    else if (found->chosen.n == 0 && only->n == 1 && choice->named == NULL)
        return only;
    else if (found->n == 1)
        spoilt(wrong, 0, "the only shape does not have %s; leave #.. out",
               choice_text(shown, choice->named));
    else
        spoilt(wrong, 0, "%zu of the %zu shapes have %s%s", found->chosen.n, found->n,
               choice->named != NULL ? choice_text(shown, choice->named) : called, number);
    return NULL;
}

bool cage_read_svg(cage *out, const cage_choice *choice, const char *text, size_t n, problem *wrong)
{
    (void)n;
    shapes found = find_shapes(text, choice);
    const shape *s = choose(&found, choice, wrong);
    if (s == NULL)
        return false;
    size_t line = line_of(text, s->tag.name);
    if (s->frame.unclear)
        return spoilt(wrong, line, "the shape has, or is in, a transform that SVG does not have");
    flattening flat = choice->flat;
    flat.length /= transform_stretch(&s->frame.all);
    return read_shape(out, &s->tag, text, &flat, wrong) &&
           (move_all(out, &s->frame.all) ||
            spoilt(wrong, line, "the transform takes the shape beyond the range of numbers"));
}
