/* Reads the transforms of SVG. */
#ifndef SVG_TRANSFORM_H
#define SVG_TRANSFORM_H

#include <stdbool.h>

/* Maps (x, y) to (m[0] x + m[2] y + m[4], m[1] x + m[3] y + m[5]). */
typedef struct transform {
    double m[6];
} transform;

transform transform_none(void);

/* Reads a list of transforms up to `end`. Each applies before those on its left, and all before
 * `after`. False if it is not such a list. */
bool transform_read(transform *out, const transform *after, const char *list, const char *end);

/* The largest factor by which it stretches a line. */
double transform_stretch(const transform *t);

void transform_apply(const transform *t, double point[2]);

#endif
