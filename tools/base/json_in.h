/* JSON that is read: lists of points and the like, with the entry at fault named. `where` is what a
 * list is called in messages, like "handles" or "rigid[2].region". All return false with `wrong`
 * filled in. */
#ifndef JSON_IN_H
#define JSON_IN_H

#include "base/say.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Parses text[0..n), with text[n] == '\0'. NULL: see `wrong`. */
cJSON *json_parse(const char *text, size_t n, problem *wrong);

/* Parses one value, or a sequence of them, each on a line of its own or behind a record separator
 * (RFC 8142): a list of them all, to be deleted. NULL: see `wrong`. */
cJSON *json_parse_sequence(const char *text, size_t n, problem *wrong);

const cJSON *json_get(const cJSON *object, const char *name);

/* Whether it is an object with no other members than those of `names`, which ends with NULL. */
bool json_is_object(const cJSON *item, const char *where, const char *const *names, problem *wrong);

/* One finite number; exactly n; a list of n such lists, made with need(), which may be empty. */
bool json_real(const cJSON *item, const char *where, double *out, problem *wrong);
bool json_reals(const cJSON *item, const char *where, size_t n, double *out, problem *wrong);
bool json_points(const cJSON *item, const char *where, size_t dim, size_t *n, double **points,
                 problem *wrong);

/* A whole number below `limit`; a list of pairs of such. `what` is what is numbered. */
bool json_index(const cJSON *item, const char *where, const char *what, size_t limit, uint32_t *out,
                problem *wrong);
bool json_pairs(const cJSON *item, const char *where, const char *what, size_t limit, size_t *n,
                uint32_t **pairs, problem *wrong);

/* Whether it is a list (or not there at all, which counts as empty); how long. */
bool json_list(const cJSON *item, const char *where, size_t *n, problem *wrong);

#endif
