/* Converts between doubles and decimal text, with the same bytes and the same numbers as printf()
 * and strtod(), but several times as fast. */
#ifndef DECIMAL_H
#define DECIMAL_H

#include <stdbool.h>
#include <stddef.h>

enum { DECIMAL_ROOM = 40 }; /* bytes for any number and its '\0', and to write it in blocks */

/* Writes a number as printf("%.17g"). Returns the length. */
size_t decimal_write(char text[DECIMAL_ROOM], double value);

/* The same with 15 digits if these read back as the same number. */
size_t decimal_write_short(char text[DECIMAL_ROOM], double value);

/* Reads a number of usual form, -?digits[.[digits]], and finds its end, where no further part of a
 * number may follow. False if it has another form or many digits; try decimal_read(). */
bool decimal_read_plain(const char *p, const char **end, double *value);

/* Reads the number at p as strtod(p, NULL). */
double decimal_read(const char *p);

#endif
