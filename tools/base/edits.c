/* Sorts the edits by place and writes them between copied pieces of the text. */
#include "base/edits.h"

#include "base/allocate.h"
#include "base/decimal.h"

#include <stdlib.h>
#include <string.h>

void edits_replace(edits *e, size_t begin, size_t end)
{
    e->list = grow(e->list, &e->room, e->n + 1, sizeof *e->list);
    e->list[e->n++] = (edit){begin, end, e->n_bytes, e->n_bytes};
}

void edits_put(edits *e, size_t n, const char *bytes)
{
    if (n == 0)
        return;
    e->bytes = grow(e->bytes, &e->room_bytes, e->n_bytes + n, 1);
    memcpy(e->bytes + e->n_bytes, bytes, n);
    e->n_bytes += n;
    e->list[e->n - 1].to = e->n_bytes;
}

void edits_put_text(edits *e, const char *text)
{
    edits_put(e, strlen(text), text);
}

void edits_put_number(edits *e, double value)
{
    char *at = edits_room(e, DECIMAL_ROOM);
    edits_end(e, at + decimal_write_short(at, value));
}

char *edits_room(edits *e, size_t n)
{
    e->bytes = grow(e->bytes, &e->room_bytes, e->n_bytes + n, 1);
    return e->bytes + e->n_bytes;
}

void edits_end(edits *e, const char *end)
{
    e->n_bytes = (size_t)(end - e->bytes);
    e->list[e->n - 1].to = e->n_bytes;
}

static int by_begin(const void *a, const void *b)
{
    const edit *p = a, *q = b;
    if (p->begin != q->begin)
        return p->begin < q->begin ? -1 : 1;
    return p->end != q->end ? (p->end > q->end ? -1 : 1)
                            : (p->from > q->from) - (p->from < q->from);
}

/* Sorts the edits, which are often in order. */
static void sort(edits *e)
{
    size_t i = 1;
    while (i < e->n && by_begin(&e->list[i - 1], &e->list[i]) <= 0)
        i++;
    if (i < e->n)
        qsort(e->list, e->n, sizeof *e->list, by_begin);
}

static size_t put(const char *bytes, size_t n, FILE *stream)
{
    if (n > 0 && stream != NULL)
        fwrite(bytes, 1, n, stream);
    return n;
}

size_t edits_write(edits *e, const char *text, size_t n, FILE *stream)
{
    size_t at = 0, written = 0;
    sort(e);
    for (size_t i = 0; i < e->n; i++) {
        const edit *one = &e->list[i];
        if (one->begin < at)
            continue;
        written += put(text + at, one->begin - at, stream);
        if (one->to > one->from)
            written += put(e->bytes + one->from, one->to - one->from, stream);
        at = one->end;
    }
    return written + put(text + at, n - at, stream);
}

char *edits_apply(edits *e, const char *text, size_t *n, size_t *places, size_t n_places)
{
    size_t n_new = edits_write(e, text, *n, NULL), at = 0, k = 0;
    char *out = need(n_new + 1, 1), *to = out;
    for (size_t i = 0; i <= e->n; i++) {
        const edit last = {*n, *n, 0, 0}, *one = i < e->n ? &e->list[i] : &last;
        if (one->begin < at)
            continue;
        for (; k < n_places && places[k] <= one->begin; k++)
            places[k] = (size_t)(to - out) + (places[k] - at);
        memcpy(to, text + at, one->begin - at);
        to += one->begin - at;
        if (one->to > one->from)
            memcpy(to, e->bytes + one->from, one->to - one->from);
        to += one->to - one->from;
        at = one->end;
    }
    *n = n_new;
    return out;
}

void edits_free(edits *e)
{
    free(e->list);
    free(e->bytes);
    *e = (edits){0};
}
