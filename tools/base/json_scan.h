/* Scans JSON text piece by piece and checks it against the whole grammar of RFC 8259. Nothing is
 * converted: a piece is a place in the text. Only memory limits the depth. */
#ifndef JSON_SCAN_H
#define JSON_SCAN_H

#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum json_kind {
    JSON_OBJECT, /* { */
    JSON_LIST,   /* [ */
    JSON_CLOSE,  /* } or ] */
    JSON_NAME,   /* of a member; the colon after it has been read */
    JSON_STRING,
    JSON_NUMBER,
    JSON_TRUE,
    JSON_FALSE,
    JSON_NULL,
    JSON_END, /* of the text, after one value */
    JSON_BAD  /* see `why`; `begin` is the place */
} json_kind;

typedef struct json_scan {
    const char *text;
    size_t n;
    size_t begin, end; /* of the last piece; strings with their quotes */
    const char *why;
    size_t at, depth, room;
    char *open; /* depth brackets */
    int expected;
} json_scan;

/* Begins to scan text[0..n), with text[n] == '\0'. A byte order mark in front is skipped. */
void json_scan_start(json_scan *s, const char *text, size_t n);
json_kind json_scan_next(json_scan *s);

/* Counts the blanks and record separators between two texts of a sequence. *apart tells if another
 * text may follow: on its own line or after a record separator (RFC 8142). */
size_t json_scan_gap(const char *p, bool *apart);

/* After an outermost value: true if another object follows in such a sequence. */
bool json_scan_more(json_scan *s);

/* Skips the rest of a value that began with a piece of this kind. Returns the kind, or JSON_BAD. */
json_kind json_scan_skip(json_scan *s, json_kind kind);
void json_scan_end(json_scan *s);

/* Fills in `wrong` with a fault at text[at]. Returns false. */
int json_fault(const char *text, size_t at, const char *why, problem *wrong);

/* True if a string, with its quotes, is this word of ASCII letters. The letters may be escaped. */
bool json_string_is(const char *begin, const char *end, const char *word);

#endif
