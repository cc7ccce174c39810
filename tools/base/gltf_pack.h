/* A scene of glTF has two forms. One is a binary file (.glb), the other JSON, whose bytes stand inside
 * as data: URIs or in files beside it. Readers know the binary form, so the other is made one. */
#ifndef GLTF_PACK_H
#define GLTF_PACK_H

#include "base/edits.h"
#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>

/* True if text[0..n), with text[n] == '\0', is a scene in JSON. */
bool gltf_told(const char *text, size_t n);

/* Makes one binary file of a scene in JSON, with a '\0' behind it; free() it. `name` is the scene's
 * file, beside which its other files stand. NULL: see `wrong`. If its text is empty, a message is
 * on stderr. */
char *gltf_pack(const char *name, const char *text, size_t n, size_t *n_packed, problem *wrong);

/* Puts a binary file together: JSON with edits, padded to a multiple of four bytes, and the chunks
 * behind it, with a '\0' behind them; free() it. */
char *gltf_join(edits *e, const char *json, size_t n_json, const char *rest, size_t n_rest,
                size_t *n);

#endif
