/* Whole files in, whole files out. "-" is standard input or output. */
#ifndef FILE_H
#define FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The content of a file and a '\0' behind it; free() it. NULL: said why on stderr. */
char *file_read(const char *name, size_t *n);

/* A file that is written beside its final name and takes its place only when all is well. */
typedef struct outfile {
    FILE *stream;
    const char *name;
    char *temporary; /* NULL: written directly (standard output, devices) */
} outfile;

/* False: said why on stderr. */
bool outfile_open(outfile *out, const char *name);

/* Ends the file and puts it in place. False: said why, and nothing is left behind. */
bool outfile_close(outfile *out);

/* Gives the file up; whatever stood at its name is untouched. */
void outfile_abandon(outfile *out);

#endif
