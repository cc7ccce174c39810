/* Reads the tags of an XML text, such as SVG, one after the other. */
#ifndef XML_TAGS_H
#define XML_TAGS_H

#include <stdbool.h>
#include <stddef.h>

/* A tag between '<' and '>': its name, and its attributes after it. */
typedef struct tag {
    const char *name, *end;
    size_t n_name;
    bool closes, stands_alone;
} tag;

/* Finds the next tag from p on, skipping comments and declarations. False at the end of the
 * file. */
bool tag_next(tag *out, const char *p);

bool tag_is(const tag *t, const char *name);

/* The value of an attribute whose name has n characters: from the result up to *end. NULL if the
 * tag does not have it. */
const char *tag_attribute(const tag *t, const char *name, size_t n, const char **end);

/* True if the attribute has the value `wanted`. */
bool tag_has(const tag *t, const char *name, size_t n, const char *wanted);

#endif
