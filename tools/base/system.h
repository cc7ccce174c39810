/* Functions of the operating system that ISO C lacks. system_posix.c and system_windows.c each
 * implement all of them. Nothing else in tools/ depends on the system. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Call this before anything is read or written. Bytes then go through standard input and output
 * unchanged. */
void system_begin(void);

/* ---- files; names are UTF-8 or the system's encoding. errno tells why a function failed. */

/* The last part of a name, after the last separator of folders. */
const char *system_last_part(const char *name);

bool system_exists(const char *name);

/* True if both names mean one plain file, also through a link. NULL: standard input or output. */
bool system_is_same(const char *input, const char *output);

/* The place of a plain file with this name, existing or not, with links followed; free() it. NULL
 * for devices, pipes and broken links. */
char *system_place(const char *name);

/* Makes a file beside that place. NULL if that fails; *name is set even then, and the caller
 * free()s it. */
FILE *system_open_beside(const char *place, char **name);

/* Replaces one file by another in a single step. */
bool system_replace(const char *name, const char *place);

bool system_make_folder(const char *name);

/* Makes a private temporary folder that nobody else can read; free() its name. The caller removes
 * it when it is empty. NULL if that fails. */
char *system_make_temporary_folder(void);
void system_remove_folder(const char *name);

/* A stream whose bytes are collected, in memory or in a file without a name. */
typedef struct collector {
    FILE *stream;
    char *bytes; /* after the end; free() them */
    size_t n;
} collector;

/* False if there is no room. */
bool collector_begin(collector *c);
bool collector_end(collector *c);

/* ---- time, processors, the terminal */

/* Seconds on a clock that only goes forward. */
double seconds_now(void);

size_t system_processors(void); /* at least 1 */

/* The number of columns if stderr is a terminal, else 0. */
int system_columns(void);

/* ---- words */

/* Prints a word on stdout, quoted for the system's shell where it needs quotes. */
void system_print_word(const char *text);

#endif
