/* Whole files in, whole files out. "-" is standard input or output. */
#ifndef FILE_H
#define FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* What "-" is called in messages about output; say.h calls it standard input. */
#define STANDARD_OUTPUT "standard output"

/* The content of a file and a '\0' behind it; free() it. NULL: said why on stderr. */
char *file_read(const char *name, size_t *n);

/* The same for `FILE#CHOICE`: *choice is what stands behind the first # before which a file is named;
 * NULL: the whole name is that of a file, or of none. */
char *file_read_chosen(const char *name, size_t *n, const char **choice);

/* The name of the file that file_read_chosen() reads, without the choice. free() it. */
char *file_chosen_name(const char *name);

/* Whether two names, "-" for the input being standard input, for the output standard output, are
 * those of one plain file, be it through a link. */
bool file_is_same(const char *input, const char *output);

/* A file that is written beside its final place and takes that only when all is well. */
typedef struct outfile {
    FILE *stream;
    const char *name; /* for messages */
    char *temporary;  /* NULL: written directly (standard output, devices) */
    char *place;      /* where the temporary file goes: `name` with its links followed */
} outfile;

/* What errno says of a failed flush; it says nothing (0) when the stream had failed before. */
const char *file_write_error(int why);

/* False: said why on stderr. */
bool outfile_open(outfile *out, const char *name);

/* Ends the file and puts it in place. False: said why, and nothing is left behind. */
bool outfile_close(outfile *out);

/* Gives the file up; whatever stood at its name is untouched, unless it is written directly. */
void outfile_abandon(outfile *out);

#endif
