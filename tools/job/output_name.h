/* What the names of outputs promise: a name with another format's extension is refused. */
#ifndef OUTPUT_NAME_H
#define OUTPUT_NAME_H

#include "job/args.h"

/* The formats of pictures, for output_fits(). */
#define PICTURES "PNG, JPEG, PNM, PGM, PPM, PAM, NumPy"
#define SURFACES "OBJ, OFF, PLY, STL"

/* The format that the extension of a file's name stands for; NULL: none, or none that is known. */
const char *output_format(const char *name);

/* Whether the name is one for GeoJSON: .geojson or .json. */
bool output_is_json(const char *name);

/* Whether a result of the command `of` may go to a file of that name: its extension is unknown or
 * that of one of `formats`, which are names of output_format() with commas between. DONE, or
 * MISUSED with a line on stderr; `name` may be NULL. */
int output_fits(const char *of, const char *name, const char *formats);

/* The same for all outputs of a command, as far as the options say. */
int output_names_check(const args *a, const command *c);

#endif
