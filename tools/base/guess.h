/* Finds the known word that a user may have meant. */
#ifndef GUESS_H
#define GUESS_H

#include <stddef.h>

typedef struct guess {
    const char *name; /* NULL: none is near */
    size_t distance;  /* number of letters changed, left out, added, or swapped with the next */
} guess;

/* Takes `name` if it is closer to word[0..n) than the best name before, and close enough. A third
 * of the word's letters may be wrong, or letters may be missing at its end. */
void guess_try(guess *g, const char *word, size_t n, const char *name);

/* "; did you mean PREFIXNAME?", or nothing. Returns `out`. */
typedef char guess_text[64];
const char *guess_say(guess_text out, const guess *g, const char *prefix);

#endif
