/* Reads files of control points. */
#ifndef CONTROL_READ_H
#define CONTROL_READ_H

#include "control/control_points.h"

/* Reads text[0..n), with text[n] == '\0', in any format. False: see `wrong`. Free it in either
 * case. */
bool control_decode(control_points *out, const char *text, size_t n, problem *wrong);

/* Reads a file. Returns DONE, or FAILED with a message on stderr. Free it in either case. */
int control_read(control_points *out, const char *name);

#endif
