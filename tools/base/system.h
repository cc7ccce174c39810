/* What the command asks of the operating system and ISO C does not have. system_posix.c and
 * system_windows.c each answer all of it; nothing else in tools/ knows which system it runs on. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Before anything is read or written: bytes go through standard input and output as they are. */
void system_begin(void);

/* ---- files; names are UTF-8 or whatever the system has. errno says why where one fails. */

/* Where the last part of a name begins: behind what separates folders. */
const char *system_last_part(const char *name);

bool system_exists(const char *name);

/* Whether the two are one plain file, be it through a link. NULL: standard input or output. */
bool system_is_same(const char *input, const char *output);

/* Where a plain file of this name is or will be, with links followed; free() it. NULL for devices,
 * pipes and links to nowhere. */
char *system_place(const char *name);

/* Makes a file beside that place. NULL: it cannot; *name, to be free()d, is set even so. */
FILE *system_open_beside(const char *place, char **name);

/* Puts a file in the place of another, at once. */
bool system_replace(const char *name, const char *place);

bool system_make_folder(const char *name);

/* A folder of one's own among temporary ones, readable for nobody else; free() its name. It is
 * removed when it is empty. NULL: none can be made. */
char *system_make_temporary_folder(void);
void system_remove_folder(const char *name);

/* A stream whose bytes are collected: in memory, or in a file without a name. */
typedef struct collector {
    FILE *stream;
    char *bytes; /* after the end; free() them */
    size_t n;
} collector;

/* False: there is no room. */
bool collector_begin(collector *c);
bool collector_end(collector *c);

/* ---- time, processors, the terminal */

/* Seconds on a clock that only goes forward. */
double seconds_now(void);

size_t system_processors(void); /* at least 1 */

/* How many columns the terminal has that stderr is; 0: it is none. */
int system_columns(void);

/* ---- this program, and others */

/* A word that calls this program again from any folder: the name by which it was called, if that is
 * searched in PATH, otherwise its full name. free() it. */
char *system_program(const char *called);

bool system_has_program(const char *name);

/* Runs a program without a shell, so that no argument is taken for a command, and without its
 * output. `arguments` begin with its name and end with NULL. Its exit status; -1: see errno. */
int system_run(char *const *arguments);

#endif
