/* Writes other numbers into a VTU file's arrays. */
#include "mesh/vtu.h"

#include "base/allocate.h"
#include "base/base64.h"
#include "base/xml_tags.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static const char blanks[] = " \t\r\n";

/* ----------------------------------------------------------------------- tags */

static tag tag_of(const vtu *v, const vtu_array *a)
{
    tag t = {.name = v->text + a->tag, .end = v->text + a->tag_end - 1};
    t.n_name = strcspn(t.name, " \t\r\n/>");
    return t;
}

/* Removes an attribute with the blanks before it. */
static void cut_attribute(edits *e, const vtu *v, const tag *t, const char *name)
{
    const char *end, *value = tag_attribute(t, name, strlen(name), &end);
    if (value == NULL)
        return;
    const char *p = value - 1; /* the quote */
    while (strchr(" \t\r\n=", p[-1]) != NULL)
        p--;
    p -= strlen(name);
    while (strchr(blanks, p[-1]) != NULL)
        p--;
    edits_replace(e, (size_t)(p - v->text), (size_t)(end + 1 - v->text));
}

/* Removes what the file says about the old numbers: their range, in attributes and in notes. */
static void cut_notes(edits *e, const vtu *v, const vtu_array *a, const tag *t)
{
    cut_attribute(e, v, t, "RangeMin");
    cut_attribute(e, v, t, "RangeMax");
    const char *note = memchr(v->text + a->tag_end, '<', a->end - a->tag_end);
    if (note != NULL)
        edits_replace(e, (size_t)(note - v->text), a->end);
}

static void put_type(edits *e, const vtu *v, const tag *t)
{
    const char *end, *value = tag_attribute(t, "type", 4, &end);
    if (value == NULL || tag_has(t, "type", 4, "Float64"))
        return;
    edits_replace(e, (size_t)(value - v->text), (size_t)(end - v->text));
    edits_put_text(e, "Float64");
}

/* ---------------------------------------------------------------------- content */

static bool is_same(double a, double b)
{
    return !(a < b || a > b);
}

static void put_text(edits *e, const vtu *v, const vtu_array *a, const double *values)
{
    const char *p = v->text + a->at, *done = p;
    edits_replace(e, a->at, a->at_end);
    for (size_t i = 0; i < a->n; i++) {
        p += strspn(p, blanks);
        const char *end = p + strcspn(p, " \t\r\n<");
        if (!is_same(values[i], a->values[i])) {
            edits_put(e, (size_t)(p - done), done);
            edits_put_number(e, values[i]);
            done = end;
        }
        p = end;
    }
    edits_put(e, (size_t)(p - done), done);
}

/* The n lowest bytes of a number, in the order of the file. */
static void put_whole(const vtu *v, char *out, uint64_t bits, size_t n)
{
    for (size_t i = 0; i < n; i++)
        out[v->is_little ? i : n - 1 - i] = (char)(bits >> 8 * i & 255);
}

static void put_number(const vtu *v, char *out, double value, size_t width)
{
    float single = (float)value;
    uint64_t bits;
    uint32_t half;
    memcpy(&half, &single, 4);
    memcpy(&bits, &value, 8);
    put_whole(v, out, width == 4 ? half : bits, width);
}

/* Adds bytes as they are or as text. */
static void put_bytes(edits *e, bool is_coded, const char *bytes, size_t n)
{
    if (!is_coded) {
        edits_put(e, n, bytes);
        return;
    }
    char *text = base64_encode(bytes, n, &n);
    edits_put(e, n, text);
    free(text);
}

/* `bytes` begins with room for the number of its bytes. */
static void put_plain(edits *e, const vtu *v, bool is_coded, char *bytes, size_t n)
{
    put_whole(v, bytes, n, v->n_word);
    put_bytes(e, is_coded, bytes, v->n_word + n);
}

/* Blocks hold whole numbers, and are as long as those of the file. */
static void put_zipped(edits *e, const vtu *v, const vtu_array *a, bool is_coded, const char *bytes,
                       size_t n)
{
    size_t block = a->block < n ? (size_t)a->block : n;
    block = block < 8 ? 8 : block - block % 8;
    size_t n_blocks = (n + block - 1) / block, n_made = 0, n_head = (3 + n_blocks) * v->n_word;
    char *head = need(n_head, 1), *made = need(n_blocks, compressBound((uLong)block));
    put_whole(v, head, n_blocks, v->n_word);
    put_whole(v, head + v->n_word, block, v->n_word);
    put_whole(v, head + 2 * v->n_word, n % block, v->n_word);
    for (size_t i = 0; i < n_blocks; i++) {
        size_t size = n - block * i < block ? n - block * i : block;
        uLongf packed = compressBound((uLong)block);
        compress((Bytef *)made + n_made, &packed, (const Bytef *)bytes + block * i, (uLong)size);
        put_whole(v, head + (3 + i) * v->n_word, packed, v->n_word);
        n_made += packed;
    }
    put_bytes(e, is_coded, head, n_head);
    put_bytes(e, is_coded, made, n_made);
    free(head);
    free(made);
}

void vtu_put(edits *e, const vtu *v, const vtu_array *a, const double *values, bool as_doubles)
{
    tag t = tag_of(v, a);
    if (a->n == 0)
        return;
    cut_notes(e, v, a, &t);
    if (as_doubles)
        put_type(e, v, &t);
    if (a->is_text) {
        put_text(e, v, a, values);
        return;
    }
    size_t width = as_doubles ? 8 : a->width, n = a->n * width;
    bool is_coded = !a->is_appended || v->is_coded;
    char *bytes = need(v->n_word + n, 1);
    for (size_t i = 0; i < a->n; i++)
        put_number(v, bytes + v->n_word + width * i, values[i], width);
    edits_replace(e, a->at, a->at_end);
    if (v->is_zipped)
        put_zipped(e, v, a, is_coded, bytes + v->n_word, n);
    else
        put_plain(e, v, is_coded, bytes, n);
    free(bytes);
}

/* ----------------------------------------------------------------------- offsets */

bool vtu_is_apart(const vtu *v, const vtu_array *a, problem *wrong)
{
    char name[32], other[32];
    if (!a->is_appended)
        return true;
    for (const vtu_array *b = v->arrays; b < v->arrays + v->n_arrays; b++)
        if (b != a && b->is_appended && v->data + b->offset >= a->at &&
            v->data + b->offset < a->at_end)
            return spoilt(wrong, 0, "the arrays '%s' and '%s' share their bytes",
                          vtu_name(v, a, name), vtu_name(v, b, other));
    return true;
}

/* A change in the appended block, and by how many bytes the text up to it grows and shrinks. */
typedef struct growth {
    size_t at, grown, shrunk;
} growth;

static int by_place(const void *a, const void *b)
{
    const growth *p = a, *q = b;
    return (p->at > q->at) - (p->at < q->at);
}

/* Changes in the appended block, in rising order, each with the sums up to it. */
static growth *find_growth(const edits *e, const vtu *v, size_t *n)
{
    growth *out = need(e->n, sizeof *out);
    *n = 0;
    for (size_t i = 0; i < e->n; i++) {
        const edit *one = &e->list[i];
        if (one->begin >= v->data)
            out[(*n)++] = (growth){one->begin, one->to - one->from, one->end - one->begin};
    }
    if (*n > 0)
        qsort(out, *n, sizeof *out, by_place);
    for (size_t i = 1; i < *n; i++) {
        out[i].grown += out[i - 1].grown;
        out[i].shrunk += out[i - 1].shrunk;
    }
    return out;
}

static size_t new_offset(size_t offset, size_t at, const growth *changes, size_t n)
{
    size_t low = 0, high = n;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (changes[middle].at < at)
            low = middle + 1;
        else
            high = middle;
    }
    return low == 0 ? offset : offset + changes[low - 1].grown - changes[low - 1].shrunk;
}

void vtu_put_offsets(edits *e, const vtu *v)
{
    if (v->data == 0)
        return;
    size_t n;
    growth *changes = find_growth(e, v, &n);
    for (size_t i = 0; i < v->n_arrays; i++) {
        const vtu_array *a = &v->arrays[i];
        tag t = tag_of(v, a);
        char digits[32];
        const char *end, *value = a->is_appended ? tag_attribute(&t, "offset", 6, &end) : NULL;
        size_t offset = new_offset(a->offset, v->data + a->offset, changes, n);
        if (value == NULL || offset == a->offset)
            continue;
        value += strspn(value, blanks);
        edits_replace(e, (size_t)(value - v->text),
                      (size_t)(value + strcspn(value, " \t\r\n\"'") - v->text));
        snprintf(digits, sizeof digits, "%zu", offset);
        edits_put_text(e, digits);
    }
    free(changes);
}
