/* Reads and writes whole files. "-" is standard input or output. */
#ifndef FILE_H
#define FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The name of "-" in messages about output. say.h has the name for input. */
#define STANDARD_OUTPUT "standard output"

/* Reads a file and puts a '\0' after its content; free() it. NULL: a message is on stderr. */
char *file_read(const char *name, size_t *n);

/* Does the same for a file that may be a mesh or a cage. A scene of glTF in JSON comes as one binary
 * file (gltf_pack.h). */
char *file_read_shape(const char *name, size_t *n);

/* Reads a shape named by `FILE#CHOICE`. *choice is the text after the first # that follows the name of
 * an existing file. It is NULL if the whole name is that of a file, or if there is no such file. */
char *file_read_chosen(const char *name, size_t *n, const char **choice);

/* The name of the file that file_read_chosen() reads, without the choice. free() it. */
char *file_chosen_name(const char *name);

/* True if two names mean one plain file, also through a link. "-" is standard input as the input
 * and standard output as the output. */
bool file_is_same(const char *input, const char *output);

/* A file that is written beside its final place and moved there when it is complete. */
typedef struct outfile {
    FILE *stream;
    const char *name; /* for messages */
    char *temporary;  /* NULL if it is written directly (standard output, devices) */
    char *place;      /* the final place: `name` with its links followed */
} outfile;

/* The text of errno after a failed flush. It is empty (0) if the stream had failed before. */
const char *file_write_error(int why);

/* False: a message is on stderr. */
bool outfile_open(outfile *out, const char *name);

/* Ends the file and puts it in place. False: a message is on stderr, and nothing is left behind. */
bool outfile_close(outfile *out);

/* Gives the file up. An older file of the same name stays as it was, unless files are written
 * directly there. */
void outfile_abandon(outfile *out);

#endif
