/* The optimal string alignment distance: R. Lowrance and R. A. Wagner, An extension of the string-to-string
 * correction problem, 1975, without edits inside a swapped pair. */
#include "base/guess.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 32 };

static size_t lesser(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t distance(const char *a, size_t n, const char *b, size_t m)
{
    size_t d[MOST + 1][MOST + 1];
    for (size_t i = 0; i <= n; i++)
        d[i][0] = i;
    for (size_t k = 0; k <= m; k++)
        d[0][k] = k;
    for (size_t i = 1; i <= n; i++) {
        for (size_t k = 1; k <= m; k++) {
            d[i][k] = lesser(lesser(d[i - 1][k], d[i][k - 1]) + 1,
                             d[i - 1][k - 1] + (a[i - 1] != b[k - 1]));
            if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
                d[i][k] = lesser(d[i][k], d[i - 2][k - 2] + 1);
        }
    }
    return d[n][m];
}

void guess_try(guess *g, const char *word, size_t n, const char *name)
{
    size_t m = name != NULL ? strlen(name) : 0;
    if (n < 2 || n > MOST || m < 2 || m > MOST)
        return;
    bool begins = n >= 3 && m > n && strncmp(word, name, n) == 0;
    size_t most = n < 3 ? 1 : n / 3, d = begins ? 1 : distance(word, n, name, m);
    if (d <= most && (g->name == NULL || d < g->distance))
        *g = (guess){name, d};
}

const char *guess_say(guess_text out, const guess *g, const char *prefix)
{
    out[0] = '\0';
    if (g->name != NULL)
        snprintf(out, sizeof(guess_text), "; did you mean %s%s?", prefix, g->name);
    return out;
}
