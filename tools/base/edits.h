/* A text in which some pieces are replaced. The rest stays as it is, byte for byte. */
#ifndef EDITS_H
#define EDITS_H

#include <stddef.h>
#include <stdio.h>

typedef struct edit {
    size_t begin, end; /* the replaced piece, in the text */
    size_t from, to;   /* the replacement, in the bytes */
} edit;

typedef struct edits {
    edit *list;
    size_t n, room;
    char *bytes;
    size_t n_bytes, room_bytes;
} edits;

/* Begins to replace a piece of the text. Pieces may come in any order. One that lies inside another
 * is lost with it. Replacements of the same place, which may be empty, come one after another. */
void edits_replace(edits *e, size_t begin, size_t end);

/* Adds to the last replacement: bytes, or a number that reads back as the same number. */
void edits_put(edits *e, size_t n, const char *bytes);
void edits_put_text(edits *e, const char *text);
void edits_put_number(edits *e, double value);

/* The place for the next bytes of the last replacement, with room for n. edits_end() then tells where
 * those that were written end. */
char *edits_room(edits *e, size_t n);
void edits_end(edits *e, const char *end);

/* Writes the text with its edits and returns the number of bytes. With NULL as the stream it only
 * counts them. */
size_t edits_write(edits *e, const char *text, size_t n, FILE *stream);

/* Returns the text with its edits and a '\0'; free() it. *n becomes its length. Places in the text,
 * in rising order, move with it. None may lie inside a replaced piece. */
char *edits_apply(edits *e, const char *text, size_t *n, size_t *places, size_t n_places);
void edits_free(edits *e);

#endif
