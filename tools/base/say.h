/* Messages: one line on stderr about a failure.
 *
 * Conventions of tools/
 * - A function that returns bool fills in a `problem` named `wrong` when it returns false.
 * - A function that returns int returns DONE, or FAILED or MISUSED after one message on stderr.
 * - Memory comes from need() and grow() (allocate.h), which end the program when there is none.
 * - Only system_posix.c and system_windows.c depend on the operating system (system.h).
 *
 * Words of this folder
 * - problem: what is wrong with an input, and in which line.
 * - column, table: numbers in the lines of a text (columns.h, table.h).
 * - foreign: a file of a format that the command cannot read (foreign.h).
 * - piece, tree: JSON as places in a text (json_scan.h), and as values (json_tree.h).
 *
 * Ways
 * - In: file.h reads bytes, foreign.h refuses other formats (the list: foreign_table.c), number.h,
 *   table.h, npy.h, json_in.h on json_tree.h (strings: json_decode.h). guess.h finds a mistyped
 *   word. xml_tags.h: XML.
 * - Out: json.h reports, edits.h changes a text in place, progress.h draws the bar. bytes.h:
 *   binary. base64.h: binary as text.
 * - degrees.h: longitudes. orientation.h: exact signs.
 *
 * Begin with table.h, which shows all of these. */
#ifndef SAY_H
#define SAY_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__MINGW32__) &&                                                                        \
    !defined(__clang__) /* C99's conversions, not the old system library's */
#define SAY_FORMAT(string, first) __attribute__((format(gnu_printf, string, first)))
#elif defined(__GNUC__)
#define SAY_FORMAT(string, first) __attribute__((format(printf, string, first)))
#else
#define SAY_FORMAT(string, first)
#endif

/* The exit codes of the command. */
enum {
    DONE = 0,    /* all is well */
    FAILED = 1,  /* the input or the computation failed */
    MISUSED = 2, /* wrong usage */
    PARTIAL = 4  /* done, but some points have no image or some elements are inverted */
};

/* What is wrong with an input, and where. `line` counts from 1; 0 means no particular line. */
typedef struct problem {
    size_t line;
    char text[240];
} problem;

/* Fills in a problem and returns false, so that a reader can `return spoilt(...)`. */
int spoilt(problem *out, size_t line, const char *format, ...) SAY_FORMAT(3, 4);

/* Prints `libicc: FILE:LINE: message` and returns FAILED. `file` may be NULL and `line` 0. */
int failed(const char *file, size_t line, const char *format, ...) SAY_FORMAT(3, 4);

/* Prints `libicc: message (see 'libicc COMMAND --help')` and returns MISUSED. */
int misused(const char *command, const char *format, ...) SAY_FORMAT(2, 3);

/* Prints `libicc: message`. */
void note(const char *format, ...) SAY_FORMAT(1, 2);

/* Copies the word at `word` for use in a message: at most 24 characters, up to white space, with
 * anything unprintable shown as '?'. Returns `out`. */
const char *quoted(char out[32], const char *word);

/* The line that `at` stands on, from 1. */
size_t line_of(const char *text, const char *at);

/* The name of the elements of a mesh: "triangles", "tetrahedra", or in more than 3 dimensions
 * "simplices". */
const char *elements_name(int32_t dim);

#endif
