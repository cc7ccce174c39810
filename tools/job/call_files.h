/* The files that a call reads and writes, and checks that it overwrites none of them. */
#ifndef CALL_FILES_H
#define CALL_FILES_H

#include "job/args.h"

/* A file that a call reads or writes; the name is NULL where it was not given. */
typedef struct call_file {
    const char *name, *role; /* the option that names it, or IN, OUT .. */
    const char *formats;     /* of outputs, for output_fits(); NULL: any */
} call_file;

/* Whether a pose takes its points from a binding, and so needs no file with them. */
bool has_bound(const args *a, const command *c);

/* The output at place `i`, with the last operand as it was given; false: there are not so many. */
bool call_output(call_file *out, const args *a, const command *c, size_t i);

/* Refuses two inputs that are both standard input. */
int call_inputs_check(const args *a, const command *c);

/* Refuses an output that is also an input, by whatever name, or another output. Nobody asks for that
 * on purpose, and the file may be the only copy. Only `map` may replace its own points or layer, and
 * does so only if all of it has an image. */
int call_outputs_check(const args *a, const command *c);

/* The name of a frame of `animate`: OUT with a number before its extension. free() it. */
char *frame_name(const char *out, size_t frame);

/* How many frames `animate` writes. */
size_t frames_count(const args *a);

#endif
