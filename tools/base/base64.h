/* Bytes as text in base64 (Josefsson, RFC 4648, 2006: section 4). */
#ifndef BASE64_H
#define BASE64_H

#include <stdbool.h>
#include <stddef.h>

/* The text of n bytes, with a '\0' behind it; free() it. *n_text is its length. */
char *base64_encode(const void *bytes, size_t n, size_t *n_text);

/* Decodes a text of n characters into `out`, which needs n / 4 * 3 + 3 bytes. The '=' at the end may
 * be missing. False if the text is not base64. */
bool base64_decode(const char *text, size_t n, char *out, size_t *n_out);

#endif
