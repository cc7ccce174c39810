/* Recognises files of formats that this program cannot read, and names a command that makes a
 * readable file. Every reader asks this before it reads. */
#ifndef FOREIGN_H
#define FOREIGN_H

#include "base/say.h"

#include <stdbool.h>

/* True if text[0..n), with text[n] == '\0', begins like a file of a known format that cannot be
 * read here, or only as a picture or a mask. Then `wrong` says so and names the remedy. */
bool foreign_told(const char *text, size_t n, problem *wrong);

/* Does the same where JSON is expected but the file is a table. */
bool foreign_table_told(const char *text, problem *wrong);

/* Fills in `wrong` with what a file is, beginning with its article, and the remedy for vector data.
 * Returns false. */
int foreign_vector(problem *wrong, size_t line, const char *what);

#endif
