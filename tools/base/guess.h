/* The known word that somebody may have meant. */
#ifndef GUESS_H
#define GUESS_H

#include <stddef.h>

typedef struct guess {
    const char *name; /* NULL: none is near */
    size_t distance;  /* letters that are changed, left out, added, or swapped with the next */
} guess;

/* Takes `name` if it is nearer to word[0..n) than what was taken before, and near at all: a third of the
 * word's letters may be wrong, or letters missing at its end. */
void guess_try(guess *g, const char *word, size_t n, const char *name);

/* "; did you mean PREFIXNAME?", or nothing. Returns `out`. */
typedef char guess_text[64];
const char *guess_say(guess_text out, const guess *g, const char *prefix);

#endif
