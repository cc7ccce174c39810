/* Reads lists of points and similar values from JSON, and names the entry at fault. `where` is the
 * name of a list in messages, like "handles" or "rigid[2].region". All functions return false with
 * `wrong` filled in. */
#ifndef JSON_IN_H
#define JSON_IN_H

#include "base/json_tree.h"
#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* True if it is an object with no members except those in `names`, which ends with NULL. */
bool json_is_object(const json_item *item, const char *where, const char *const *names,
                    problem *wrong);

/* Read one finite number, exactly n numbers, and a list of n such lists. The list is made with
 * need() and may be empty. */
bool json_real(const json_item *item, const char *where, double *out, problem *wrong);
bool json_reals(const json_item *item, const char *where, size_t n, double *out, problem *wrong);
bool json_points(const json_item *item, const char *where, size_t dim, size_t *n, double **points,
                 problem *wrong);

/* Read an integer below `limit`, and a list of pairs of them. `what` names the things that are
 * numbered. */
bool json_index(const json_item *item, const char *where, const char *what, size_t limit,
                uint32_t *out, problem *wrong);
bool json_pairs(const json_item *item, const char *where, const char *what, size_t limit, size_t *n,
                uint32_t **pairs, problem *wrong);

/* True if it is a list, or missing, which counts as an empty list. *n is its length. */
bool json_list(const json_item *item, const char *where, size_t *n, problem *wrong);

#endif
