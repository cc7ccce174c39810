/* Writes positions with the original's brackets, blanks and further numbers. */
#include "geo/geo_write.h"

#include "base/decimal.h"
#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

geo_box geo_box_empty(void)
{
    return (geo_box){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
}

void geo_box_add(geo_box *box, const double lower[2], const double upper[2])
{
    for (size_t k = 0; k < 2; k++) {
        box->lower[k] = lesser(box->lower[k], lower[k]);
        box->upper[k] = greater(box->upper[k], upper[k]);
    }
}

/* Copies text that does not change. */
static void copy(geo_writer *w, const char *begin, const char *end)
{
    edits_put(w->edits, (size_t)(end - begin), begin);
}

/* Writes the third and further numbers of a place between two positions. A number that both share
 * is copied, and others are interpolated. There are as many as both positions have. */
static void write_heights(geo_writer *w, const char *p, const char *q, double along)
{
    const char *a, *a_end, *b, *b_end;
    while ((a = geo_next_number(p, &a_end)) != NULL && (b = geo_next_number(q, &b_end)) != NULL) {
        size_t n = (size_t)(a_end - a);
        double height = (1 - along) * strtod(a, NULL) + along * strtod(b, NULL);
        bool same = n == (size_t)(b_end - b) && memcmp(a, b, n) == 0;
        if (!same && !isfinite(height))
            return;
        copy(w, p, a);
        if (same)
            copy(w, a, a_end);
        else
            edits_put_number(w->edits, height);
        p = a_end;
        q = b_end;
    }
}

/* The end of the last number from p on. */
static const char *last_number_end(const char *p)
{
    const char *end;
    while (geo_next_number(p, &end) != NULL)
        p = end;
    return p;
}

static char *append(char *at, const char *begin, const char *end)
{
    size_t n = (size_t)(end - begin);
    memcpy(at, begin, n);
    return at + n;
}

/* Writes a position in the layout of the position that it is or follows. */
static void write_position(geo_writer *w, const vertex *v)
{
    geo_span span = w->shape->spans[v->from];
    const char *begin = w->text + span.begin, *end = w->text + span.end, *x_end, *y_end;
    const char *x = geo_next_number(begin, &x_end), *y = geo_next_number(x_end, &y_end);
    char *at = edits_room(w->edits, span.end - span.begin + 2 * DECIMAL_ROOM);
    at = append(at, begin, x);
    at += decimal_write_short(at, v->image[0]);
    at = append(at, x_end, y);
    at += decimal_write_short(at, v->image[1]);
    at = v->position ? append(at, y_end, end) : at;
    edits_end(w->edits, at);
    if (!v->position) {
        size_t next = v->from + 1 < w->shape->n ? v->from + 1 : v->from;
        const char *q_end, *q = w->text + w->shape->spans[next].begin;
        geo_next_number(q, &q_end);
        geo_next_number(q_end, &q_end);
        write_heights(w, y_end, q_end, v->along);
        copy(w, last_number_end(y_end), end);
    }
    geo_box_add(w->box, v->image, v->image);
}

static bool has_image(const vertex *v)
{
    return !isnan(v->image[0]);
}

void geo_write_in_place(geo_writer *w, geo_span coordinates, size_t n_lines, const polyline *lines)
{
    const geo_shape *s = w->shape;
    const char *at = w->text + coordinates.begin;
    edits_replace(w->edits, coordinates.begin, coordinates.end);
    for (size_t l = 0; l < n_lines; l++)
        for (size_t i = 0; i < lines[l].n; i++) {
            const vertex *v = &lines[l].vertices[i];
            const char *begin = w->text + s->spans[v->from].begin,
                       *end = w->text + s->spans[v->from].end;
            if (v->position) {
                copy(w, at, begin);
                at = end;
            } else if (has_image(v))
                copy(w, end, w->text + s->spans[v->from + 1].begin);
            if (has_image(v))
                write_position(w, v);
            else if (v->position) {
                copy(w, begin, end);
                geo_box_add(w->box, v->point, v->point);
            }
        }
    copy(w, at, w->text + coordinates.end);
}

void geo_write_list(geo_writer *w, const polyline *line, size_t first, size_t end)
{
    edits_put_text(w->edits, "[");
    for (size_t i = first; i < end; i++) {
        if (i > first)
            edits_put_text(w->edits, ", ");
        write_position(w, &line->vertices[i]);
    }
    edits_put_text(w->edits, "]");
}
