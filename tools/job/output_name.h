/* Names of outputs: a name with the extension of another format is refused. */
#ifndef OUTPUT_NAME_H
#define OUTPUT_NAME_H

#include "job/args.h"

/* The formats of pictures, for output_fits(). */
#define PICTURES "PNG, JPEG, PNM, PGM, PPM, PAM, NumPy"
#define SURFACES "OBJ, OFF, PLY, STL"

/* The format of a file name's extension. NULL if there is no extension or it is unknown. */
const char *output_format(const char *name);

/* True if the name ends in .geojson or .json. */
bool output_is_json(const char *name);

/* Checks that a result of the command `of` may be written to a file of that name. Its extension
 * must be unknown or that of one of `formats`, which are names of output_format() separated by
 * commas. DONE, or MISUSED with a message on stderr. `name` may be NULL. */
int output_fits(const char *of, const char *name, const char *formats);

/* Checks all outputs of a command, as far as the options name them. */
int output_names_check(const args *a, const command *c);

#endif
