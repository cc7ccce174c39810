/* Landmarks: pairs of corresponding points, one pair in a line. */
#ifndef LANDMARK_FILE_H
#define LANDMARK_FILE_H

#include "base/table.h"

/* Reads rows of a point and its partner, of `dim` coordinates each, from text[0..n), with text[n]
 * == '\0'. In the plane it reads all files of control points (control/control_read.h). False: see
 * `wrong`. Free the table in either case. */
bool landmarks_decode(table *out, const char *text, size_t n, size_t dim, problem *wrong);

/* Reads a file. If it is DONE, free the table; otherwise a message is on stderr. */
int landmarks_read(table *out, const char *name, size_t dim);

#endif
