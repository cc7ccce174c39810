/* Bytes as text in base64 (Josefsson, RFC 4648, 2006: section 4). */
#ifndef BASE64_H
#define BASE64_H

#include <stdbool.h>
#include <stddef.h>

/* The text of n bytes, with a '\0' behind it; free() it. *n_text is its length. */
char *base64_encode(const void *bytes, size_t n, size_t *n_text);

/* Decodes a text of n characters into `out`, which needs n / 4 * 3 + 3 bytes. The '=' at the end
 * may be missing. False if the text is not base64. */
bool base64_decode(const char *text, size_t n, char *out, size_t *n_out);

/* A text that is decoded step by step. Begin with {text, end}. */
typedef struct base64 {
    const char *at, *end;
    char group[3]; /* decoded bytes, of which the last n_left are not taken */
    size_t n_group, n_left;
} base64;

/* Takes the next n bytes. White space is skipped. The text may have several parts, each with its
 * own '='. False if it ends early, or has a character that does not belong to it. */
bool base64_take(base64 *b, char *out, size_t n);

#endif
