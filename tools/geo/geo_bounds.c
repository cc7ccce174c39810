/* Bounding boxes of carried objects. */
#include "geo/geo_carriage.h"

#include <string.h>

/* Removes a member, together with the comma that would be left over. */
static void drop_member(carriage *c, geo_span value)
{
    const char *text = c->text, *blanks = " \t\r\n";
    size_t begin = value.begin, end = value.end;
    while (text[begin - 1] != '"')
        begin--;
    for (begin--; text[begin - 1] != '"';)
        begin--;
    begin--;
    end += strspn(text + end, blanks);
    if (text[end] == ',') {
        end++;
        end += strspn(text + end, blanks);
    } else {
        end = value.end;
        while (text[begin] != ',')
            begin--;
    }
    edits_replace(&c->out->edits, begin, end);
}

/* Replaces the first two numbers in each half of a bounding box. Heights stay. */
static bool set_box(carriage *c, geo_span span, const geo_box *box)
{
    const char *p = c->text + span.begin, *number, *end = p;
    size_t n = 0, k = 0;
    for (const char *q = p; *q == '[' || *q == ','; n++) {
        number = geo_next_number(q, &end);
        if (number == NULL)
            break;
        q = end + strspn(end, " \t\r\n");
    }
    const char *last = n > 0 ? end + strspn(end, " \t\r\n") : p;
    if (*last != ']' || n < 4 || n % 2 != 0)
        return spoilt(c->wrong, line_of(c->text, p), "this bbox is not a list of 4 numbers, or 6");
    if (box->lower[0] > box->upper[0]) {
        drop_member(c, span);
        return true;
    }
    edits_replace(&c->out->edits, span.begin, span.end);
    for (; (number = geo_next_number(p, &end)) != NULL; k++, p = end) {
        size_t axis = k % (n / 2);
        edits_put(&c->out->edits, (size_t)(number - p), p);
        if (axis < 2)
            edits_put_number(&c->out->edits, (k < n / 2 ? box->lower : box->upper)[axis]);
        else
            edits_put(&c->out->edits, (size_t)(end - number), number);
    }
    edits_put(&c->out->edits, (size_t)(c->text + span.end - p), p);
    return true;
}

bool geo_set_boxes(carriage *c)
{
    for (size_t i = c->index.n; i-- > 0;) {
        const geo_object *o = &c->index.objects[i];
        const geo_box *box = &c->boxes[i];
        if (!o->live)
            continue;
        if (o->parent != GEO_NOWHERE)
            geo_box_add(&c->boxes[o->parent], box->lower, box->upper);
        if (geo_has(o->bbox) && c->text[o->bbox.begin] != 'n' && !set_box(c, o->bbox, box))
            return false;
    }
    return true;
}
