/* A text with some pieces replaced; all others stay as they are, byte for byte. */
#ifndef EDITS_H
#define EDITS_H

#include <stddef.h>
#include <stdio.h>

typedef struct edit {
    size_t begin, end; /* of what is replaced, in the text */
    size_t from, to;   /* of what replaces it, in the bytes */
} edit;

typedef struct edits {
    edit *list;
    size_t n, room;
    char *bytes;
    size_t n_bytes, room_bytes;
} edits;

/* Begins to replace a piece of the text. Pieces may come in any order; one that lies within another
 * is lost with it. */
void edits_replace(edits *e, size_t begin, size_t end);

/* Adds to what replaces the last one: bytes, or a number that reads as the same again. */
void edits_put(edits *e, size_t n, const char *bytes);
void edits_put_text(edits *e, const char *text);
void edits_put_number(edits *e, double value);

/* Writes the text with its edits. */
void edits_write(edits *e, const char *text, size_t n, FILE *stream);
void edits_free(edits *e);

#endif
