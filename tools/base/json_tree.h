/* Reads JSON as a tree of values. The grammar is that of RFC 8259, and strings must be UTF-8. An object
 * may not have two members of one name, because readers disagree which of them counts.
 *
 * All values stand in one array in the order of the text, so nothing recurses and only memory limits
 * the depth. The functions that look at an item accept NULL, which is a value that is missing. */
#ifndef JSON_TREE_H
#define JSON_TREE_H

#include "base/json_scan.h"
#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct json_item {
    json_kind kind;     /* a value: no JSON_CLOSE, JSON_NAME, JSON_END, JSON_BAD */
    const char *name;   /* of a member of an object, else NULL */
    const char *string; /* of a JSON_STRING, else NULL */
    double number;      /* of a JSON_NUMBER, else 0; too large a number is infinite */
    size_t n;           /* the values of a list, or the members of an object */
    size_t next;       /* how far behind this item the next of its list stands; 0: it is the last */
    size_t begin, end; /* the value's place in the text */
} json_item;

typedef struct json_tree {
    const json_item *root;
    json_item *items;
    char *strings;
} json_tree;

/* Reads text[0..n), which need not end with a '\0'. False: see `wrong`. Free it in either case. */
bool json_tree_read(json_tree *out, const char *text, size_t n, problem *wrong);

/* Reads one value, or a sequence of objects, each on its own line or after a record separator (RFC
 * 8142). The root is a list of them all. */
bool json_tree_read_sequence(json_tree *out, const char *text, size_t n, problem *wrong);
void json_tree_free(json_tree *tree);

/* The member of an object, or NULL. */
const json_item *json_get(const json_item *object, const char *name);

bool json_is(const json_item *item, json_kind kind);

/* NULL unless it is a string. */
const char *json_string_of(const json_item *item);

/* True for an object whose member "type" is this text. */
bool json_has_type(const json_item *object, const char *type);

/* The number of values of a list, the first of them, and the first member of an object. */
size_t json_size(const json_item *list);
const json_item *json_first(const json_item *list);
const json_item *json_first_member(const json_item *object);

/* The next value of the same list, or member of the same object. */
const json_item *json_next(const json_item *item);

#endif
