/* JSON text, piece by piece, checked against the whole grammar of RFC 8259. Nothing is converted: a
 * piece is where it stands in the text. The depth is limited by memory only. */
#ifndef JSON_SCAN_H
#define JSON_SCAN_H

#include <stdbool.h>
#include <stddef.h>

typedef enum json_kind {
    JSON_OBJECT, /* { */
    JSON_LIST,   /* [ */
    JSON_CLOSE,  /* } or ] */
    JSON_NAME,   /* of a member; the colon behind it has been read */
    JSON_STRING,
    JSON_NUMBER,
    JSON_WORD, /* true, false, null */
    JSON_END,  /* of the text, behind one value */
    JSON_BAD   /* see `why`; `begin` is where */
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

/* Scans text[0..n), with text[n] == '\0'; a byte order mark in front is passed over. */
void json_scan_start(json_scan *s, const char *text, size_t n);
json_kind json_scan_next(json_scan *s);

/* The blanks and record separators between two texts of a sequence: how many there are. *apart:
 * whether another text may follow, on a line of its own or behind a record separator (RFC 8142). */
size_t json_scan_gap(const char *p, bool *apart);

/* Behind a value that stands in no other: whether another object follows in such a sequence. */
bool json_scan_more(json_scan *s);

/* Passes over the rest of a value that began with a piece of this kind; JSON_BAD, or the kind. */
json_kind json_scan_skip(json_scan *s, json_kind kind);
void json_scan_end(json_scan *s);

/* Whether a string, with its quotes, is this word of ASCII letters, also with escapes. */
bool json_string_is(const char *begin, const char *end, const char *word);

#endif
