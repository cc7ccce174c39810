/* Reads lists of points and similar values from JSON, and names the entry at fault. `where` is the
 * name of a list in messages, like "handles" or "rigid[2].region". All functions return false with
 * `wrong` filled in. */
#ifndef JSON_IN_H
#define JSON_IN_H

#include "base/say.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Parses text[0..n), with text[n] == '\0'. NULL: see `wrong`. */
cJSON *json_parse(const char *text, size_t n, problem *wrong);

/* Parses one value, or a sequence of values, each on its own line or after a record separator (RFC
 * 8142). Returns a list of them all, which the caller deletes. NULL: see `wrong`. */
cJSON *json_parse_sequence(const char *text, size_t n, problem *wrong);

const cJSON *json_get(const cJSON *object, const char *name);

/* True if it is an object with no members except those in `names`, which ends with NULL. */
bool json_is_object(const cJSON *item, const char *where, const char *const *names, problem *wrong);

/* Read one finite number, exactly n numbers, and a list of n such lists. The list is made with
 * need() and may be empty. */
bool json_real(const cJSON *item, const char *where, double *out, problem *wrong);
bool json_reals(const cJSON *item, const char *where, size_t n, double *out, problem *wrong);
bool json_points(const cJSON *item, const char *where, size_t dim, size_t *n, double **points,
                 problem *wrong);

/* Read an integer below `limit`, and a list of pairs of them. `what` names the things that are
 * numbered. */
bool json_index(const cJSON *item, const char *where, const char *what, size_t limit, uint32_t *out,
                problem *wrong);
bool json_pairs(const cJSON *item, const char *where, const char *what, size_t limit, size_t *n,
                uint32_t **pairs, problem *wrong);

/* True if it is a list, or missing, which counts as an empty list. *n is its length. */
bool json_list(const cJSON *item, const char *where, size_t *n, problem *wrong);

#endif
