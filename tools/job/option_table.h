/* The options of the command: one table for reading them and for telling about them. */
#ifndef OPTION_TABLE_H
#define OPTION_TABLE_H

#include "job/args.h"

typedef enum option_kind {
    OPTION_FLAG,   /* bool */
    OPTION_TEXT,   /* const char * */
    OPTION_COUNT,  /* int32_t between low and high */
    OPTION_LENGTH, /* double above 0 (or 0 with `zero`), and at most `most` unless that is 0 */
    OPTION_CHOICE, /* int32_t, by name */
    OPTION_FUNCTIONS,
    OPTION_POINT,       /* double[ICC_MAX_DIM], and a size_t: how many there are */
    OPTION_COLOUR,      /* unsigned char[4], and a bool that it is there */
    OPTION_REPORT,      /* bool, and a const char * when =FILE follows */
    OPTION_WITH_LENGTH, /* bool, and a double when =LENGTH follows */
    OPTION_WITH_CHOICE, /* bool, and an int32_t when =NAME follows */
    OPTION_HELP
} option_kind;

/* A name that an option takes; value 0: known, but not in this version. */
typedef struct choice {
    const char *name;
    int32_t value;
} choice;

typedef struct option {
    const char *name, *former; /* former: a spelling that is still taken, or NULL */
    char letter;
    option_kind kind;
    unsigned commands;
    size_t offset, present; /* in args */
    int32_t low, high;
    double most;
    bool zero;
    bool quiet_letter; /* the letter works, but help does not list it */
    bool papers;       /* of the papers' method alone, listed after the others */
    const choice *choices;
    const char *value, *help;
} option;

extern const choice methods[], maps[], functions[], solvers[], trees[], meshers[], samplings[],
    weightings[], kernels[], initials[], outsides[], turnings[], sides[], requirements[];

/* The name of a value that the library gave. */
const char *choice_name(const choice *choices, int32_t value);

/* Whether a value follows as a word of its own. */
bool option_takes_word(const option *o);

extern const option options[];
extern const size_t n_options;

#endif
