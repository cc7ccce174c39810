/* Builds the tree from the pieces that the scanner finds. Strings are converted in place, in a copy of
 * the text. The scanner has passed a string when it is converted. */
#include "base/json_tree.h"

#include "base/allocate.h"
#include "base/json_decode.h"
#include "base/number.h"

#include <stdlib.h>
#include <string.h>

/* A list or an object that is still open, and the last of its values. */
typedef struct level {
    size_t item, last;
} level;

typedef struct builder {
    json_scan scan;
    json_item *items;
    level *levels;
    const json_item **members; /* of one object, to find repeated names */
    size_t n_items, room_items, depth, room_levels, room_members;
    const char *why; /* a fault that the scanner does not find; it is at scan.begin */
} builder;

static json_item *add(builder *b, json_kind kind, const char *name)
{
    b->items = grow(b->items, &b->room_items, b->n_items + 1, sizeof *b->items);
    size_t i = b->n_items++;
    if (b->depth > 0) {
        level *top = &b->levels[b->depth - 1];
        if (b->items[top->item].n++ > 0)
            b->items[top->last].next = i - top->last;
        top->last = i;
    }
    b->items[i] =
        (json_item){.kind = kind, .name = name, .begin = b->scan.begin, .end = b->scan.end};
    if (kind == JSON_OBJECT || kind == JSON_LIST) {
        b->levels = grow(b->levels, &b->room_levels, b->depth + 1, sizeof *b->levels);
        b->levels[b->depth++] = (level){i, i};
    }
    return &b->items[i];
}

/* Converts the string that was scanned last. NULL: see `why`. */
static const char *take_string(builder *b, char *strings)
{
    char *begin = strings + b->scan.begin;
    b->why = json_decode(begin, begin, strings + b->scan.end);
    return b->why == NULL ? begin : NULL;
}

static int by_name(const void *a, const void *b)
{
    const json_item *p = *(const json_item *const *)a, *q = *(const json_item *const *)b;
    int order = strcmp(p->name, q->name);
    return order != 0 ? order : (p > q) - (p < q);
}

/* Finds a member of an object that has the name of an earlier one, or NULL. */
static const json_item *find_twin(builder *b, const json_item *object)
{
    size_t n = 0;
    b->members = grow(b->members, &b->room_members, object->n, sizeof *b->members);
    for (const json_item *x = json_first_member(object); x != NULL; x = json_next(x))
        b->members[n++] = x;
    if (n > 1)
        qsort(b->members, n, sizeof *b->members, by_name);
    for (size_t i = 1; i < n; i++)
        if (strcmp(b->members[i - 1]->name, b->members[i]->name) == 0)
            return b->members[i];
    return NULL;
}

static bool close_level(builder *b)
{
    json_item *item = &b->items[b->levels[--b->depth].item];
    item->end = b->scan.end;
    const json_item *twin = find_twin(b, item);
    if (twin == NULL)
        return true;
    b->scan.begin = twin->begin;
    b->why = "an earlier member of this object has the same name";
    return false;
}

static bool add_value(builder *b, json_kind kind, const char *name, char *strings)
{
    json_item *item = add(b, kind, name);
    const char *text = strings + b->scan.begin;
    if (kind == JSON_NUMBER)
        number_read(&text, &item->number);
    if (kind == JSON_STRING)
        item->string = take_string(b, strings);
    return b->why == NULL;
}

/* Adds one value with all its contents. */
static bool add_text(builder *b, char *strings)
{
    size_t outside = b->depth;
    do {
        json_kind kind = json_scan_next(&b->scan);
        const char *name = NULL;
        if (kind == JSON_NAME) {
            name = take_string(b, strings);
            kind = name != NULL ? json_scan_next(&b->scan) : JSON_BAD;
        }
        if (kind == JSON_BAD ||
            !(kind == JSON_CLOSE ? close_level(b) : add_value(b, kind, name, strings)))
            return false;
    } while (b->depth > outside);
    return true;
}

/* The root is the first item, a list of texts. */
static bool read_texts(json_tree *out, bool sequence, const char *text, size_t n, problem *wrong)
{
    builder b = {.n_items = 0};
    out->strings = need(n + 1, 1);
    memcpy(out->strings, text, n);
    json_scan_start(&b.scan, out->strings, n);
    add(&b, JSON_LIST, NULL);
    if (sequence)
        json_scan_more(&b.scan);
    bool good = add_text(&b, out->strings);
    while (good && sequence && json_scan_more(&b.scan))
        good = add_text(&b, out->strings);
    good = good && json_scan_next(&b.scan) == JSON_END;
    if (!good)
        json_fault(text, b.scan.begin, b.why != NULL ? b.why : b.scan.why, wrong);
    out->root = out->items = b.items;
    json_scan_end(&b.scan);
    free(b.levels);
    free(b.members);
    return good;
}

bool json_tree_read(json_tree *out, const char *text, size_t n, problem *wrong)
{
    bool good = read_texts(out, false, text, n, wrong);
    out->root = good ? json_first(out->items) : NULL;
    return good;
}

bool json_tree_read_sequence(json_tree *out, const char *text, size_t n, problem *wrong)
{
    return read_texts(out, true, text, n, wrong);
}

void json_tree_free(json_tree *tree)
{
    free(tree->items);
    free(tree->strings);
    *tree = (json_tree){0};
}

const json_item *json_get(const json_item *object, const char *name)
{
    const json_item *member = json_first_member(object);
    while (member != NULL && strcmp(member->name, name) != 0)
        member = json_next(member);
    return member;
}

bool json_is(const json_item *item, json_kind kind)
{
    return item != NULL && item->kind == kind;
}

const char *json_string_of(const json_item *item)
{
    return item != NULL ? item->string : NULL;
}

bool json_has_type(const json_item *object, const char *type)
{
    const char *own = json_string_of(json_get(object, "type"));
    return own != NULL && strcmp(own, type) == 0;
}

size_t json_size(const json_item *list)
{
    return json_is(list, JSON_LIST) ? list->n : 0;
}

const json_item *json_first(const json_item *list)
{
    return json_size(list) > 0 ? list + 1 : NULL;
}

const json_item *json_first_member(const json_item *object)
{
    return json_is(object, JSON_OBJECT) && object->n > 0 ? object + 1 : NULL;
}

const json_item *json_next(const json_item *item)
{
    return item != NULL && item->next > 0 ? item + item->next : NULL;
}
