/* Lists the files that a call reads and writes, and checks that it overwrites none of them. */
#ifndef CALL_FILES_H
#define CALL_FILES_H

#include "job/args.h"

/* A file that a call reads or writes. The name is NULL if it was not given. */
typedef struct call_file {
    const char *name, *role; /* the option or operand that names it, such as IN or OUT */
    const char *formats;     /* of outputs, for output_fits(); NULL: any */
} call_file;

/* True if a pose takes its points from a binding, and so needs no file of points. */
bool has_bound(const args *a, const command *c);

/* The output at place `i`, with the last operand as given. False if there are not so many. */
bool call_output(call_file *out, const args *a, const command *c, size_t i);

/* Refuses two inputs that are both standard input. */
int call_inputs_check(const args *a, const command *c);

/* Refuses an output that is also an input, under any name, or another output. Nobody wants that,
 * and the file may be the only copy. Only `map` may replace its own points or layer, and only if
 * all of it has an image. */
int call_outputs_check(const args *a, const command *c);

/* True if frames become one film: OUT is named .apng. */
bool is_film(const char *out);

/* The name of a frame: OUT with a number before its extension, or OUT for a film.
 * free() it. */
char *frame_name(const char *out, size_t frame);

/* The number of frames that `animate` or `pose --frames` writes, and how many of them a film shows in
 * a second. */
size_t frames_count(const args *a);
uint32_t frames_rate(const args *a);

#endif
