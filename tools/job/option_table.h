/* The options of the command: one table for reading and for documenting them. */
#ifndef OPTION_TABLE_H
#define OPTION_TABLE_H

#include "job/args.h"

typedef enum option_kind {
    OPTION_FLAG,   /* bool */
    OPTION_TEXT,   /* const char * */
    OPTION_FILES,  /* file_list: the option may be repeated */
    OPTION_COUNT,  /* int32_t between low and high */
    OPTION_LENGTH, /* double above 0 (or 0 with `zero`), and at most `most` unless that is 0 */
    OPTION_CHOICE, /* int32_t, by name */
    OPTION_FUNCTIONS,
    OPTION_POINT,       /* double[ICC_MAX_DIM], and a size_t for their number */
    OPTION_COLOUR,      /* unsigned char[4], and a bool that is true if it is given */
    OPTION_REPORT,      /* bool, and a const char * if =FILE follows */
    OPTION_WITH_LENGTH, /* bool, and a double if =LENGTH follows */
    OPTION_WITH_CHOICE, /* bool, and an int32_t if =NAME follows */
    OPTION_HELP         /* `low`: which of the two helps */
} option_kind;

/* The groups in which the help lists options. */
typedef enum option_group {
    OPTIONS_USUAL,
    OPTIONS_RARE,
    OPTIONS_PAPERS /* only --help-all lists these */
} option_group;

/* A name that an option accepts. Value 0: known, but not in this version. */
typedef struct choice {
    const char *name;
    int32_t value;
} choice;

typedef struct option {
    const char *name, *former; /* former: an older spelling that is still accepted, or NULL */
    char letter;
    option_kind kind;
    unsigned commands;
    size_t offset, present; /* in args */
    int32_t low, high;
    double most;
    bool zero;
    bool quiet_letter; /* the letter works, but the help does not list it */
    option_group group;
    const choice *choices;
    const char *value, *help;
} option;

extern const choice methods[], maps[], functions[], solvers[], trees[], samplings[], weightings[],
    kernels[], initials[], outsides[], turnings[], sides[], requirements[], fallbacks[], slidings[];

/* The name of a value that the library returned. */
const char *choice_name(const choice *choices, int32_t value);

/* True if the value is a file, or may be one. */
static inline bool option_is_file(const option *o)
{
    return o->kind == OPTION_TEXT || o->kind == OPTION_FILES;
}

/* True if a value follows as a separate word. */
bool option_takes_word(const option *o);

extern const option options[];
extern const size_t n_options;

#endif
